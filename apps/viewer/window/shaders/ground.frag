// A fixed plane: a trodden floor.
uniform vec3 sun, eye;
uniform float flatColour;
uniform sampler2DArray look;
uniform vec3 usual;  // linear: the mean of what was baked
in vec3 worldPoint, worldNormal, base;
in vec2 place;
in vec4 tint;
flat in float layer, glow;
out vec4 pixel;

void main() {
  if (flatColour > 0.5) {
    pixel = vec4(tint.rgb, 1.0);
    return;
  }
  vec3 normal = normalize(worldNormal);
  float far = distance(eye, worldPoint);
  // The baked patch at its own size and, turned, at forty times that: no repeat is to be seen.
  vec3 near = toLinear(texture(look, vec3(place * 2.0, layer)).rgb);
  vec3 wide = toLinear(texture(look, vec3(place.yx * vec2(0.047, -0.053), layer)).rgb);
  vec3 albedo = base * near * (0.45 + 0.55 * wide / max(usual, vec3(0.02))) * floorShade(place, fwidth(place));
  float facing = max(dot(normal, sun), 0.0);
#ifdef DEPTH_SHADOWS
  facing *= sunReaching();
#endif
  vec3 light = albedo * (ambientLight(normal, sun) + kSunOnMatt * facing);
  pixel = vec4(toPixel(mix(light, hazeLight((worldPoint - eye) / far, sun), hazeShare(far))), 1.0);
}
