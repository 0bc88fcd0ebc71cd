// A puff is thin at its edge and lit from the sun's side, as if it were a ball of dust.
uniform vec3 sun, right, up;
in vec2 corner;
in float left;
in vec3 colour;
in vec3 worldPoint;
out vec4 pixel;
void main() {
  float reach = dot(corner, corner);
  if (reach > 1.0) discard;
  vec3 towards = cross(right, up);
  vec3 normal = normalize(right * corner.x + up * corner.y + towards * sqrt(1.0 - reach));
  float lit = 0.55 + 0.45 * dot(normal, sun);
  float cover = (1.0 - reach) * (1.0 - reach) * left;
  vec3 light = colour * (ambientLight(normal, sun) + kSunOnMatt * lit);
  pixel = vec4(toPixel(light), cover);
}
