// Bricks and all other bodies: sun, sky, the baked look of the material and the colour of the body.
uniform vec3 sun, eye;
uniform vec4 surface;      // roughness, metalness, bump, texture metres
uniform float flatColour;  // 1: no light, for the polygon view
uniform sampler2D look;
in vec3 worldPoint, worldNormal;
in vec2 place;
in vec4 tint;
in vec2 shade;
out vec4 pixel;

// The baked height tilts the normal: the frame of the surface is found from what neighbouring pixels see.
vec3 bumped(vec3 normal, vec2 at) {
  vec3 alongX = dFdx(worldPoint), alongY = dFdy(worldPoint);
  float height = texture(look, at).a * surface.z;
  float byX = dFdx(height), byY = dFdy(height);
  vec3 acrossX = cross(alongY, normal), acrossY = cross(normal, alongX);
  float area = dot(alongX, acrossX);
  vec3 slope = sign(area) * (byX * acrossX + byY * acrossY);
  return normalize(abs(area) * normal - slope + normal * 1e-12);
}

void main() {
  vec3 base = toLinear(tint.rgb);
  vec2 at = place / surface.w;
  vec3 albedo = mix(base, base * toLinear(texture(look, at).rgb) * shade.x, tint.a);
  if (flatColour > 0.5) {
    pixel = vec4(tint.rgb, 1.0);
    return;
  }
  vec3 normal = normalize(worldNormal);
  if (surface.z > 0.0) normal = bumped(normal, at);
  float facing = dot(normal, sun);
#ifdef DEPTH_SHADOWS
  float reaching = facing > 0.0 ? sunReaching() : 0.0;
#else
  float reaching = 1.0;
#endif
  vec3 towards = normalize(eye - worldPoint);
  vec3 ambient = ambientLight(normal);
  vec3 light = albedo * (ambient + kSunLight * max(facing, 0.0) * reaching) * (1.0 - 0.85 * surface.y);
  // What is mirrored: the sky in metal, the sun's spot on all.
  vec3 mirrored = reflect(-towards, normal);
  float rim = pow(1.0 - max(dot(normal, towards), 0.0), 5.0);
  vec3 strength = mix(vec3(0.04), albedo, surface.y);
  strength += (1.0 - strength) * rim * (1.0 - surface.x);
  light += strength * mix(skyLight(mirrored, vec3(0.0, -1.0, 0.0)), ambient, surface.x) * mix(0.35, 1.0, surface.y);
  float spot = pow(max(dot(mirrored, sun), 0.0), mix(160.0, 6.0, surface.x));
  light += strength * kSunLight * spot * (1.2 - surface.x) * 2.0 * step(0.0, facing) * reaching;
#ifndef DEPTH_SHADOWS
  // Modulative shadows darken the finished pixel, that of turned-away sides too: those are lit so that they come out right.
  light = max(light, albedo * ambient / kStencilLight);
#endif
  light += base * shade.y;
  pixel = vec4(toPixel(withHaze(light, distance(eye, worldPoint))), 1.0);
}
