// What all surfaces share: a sun, a sky, distance haze, and how light becomes a pixel. Light is linear until toPixel.
const vec3 kSunLight = vec3(1.95, 1.80, 1.52);
const vec3 kSkyLight = vec3(0.40, 0.47, 0.58);
const vec3 kGroundLight = vec3(0.22, 0.19, 0.16);
const vec3 kHorizon = vec3(0.62, 0.70, 0.78);
const vec3 kZenith = vec3(0.16, 0.32, 0.60);

// A gamma of 2 instead of 2.2, and fractions instead of exponentials: a processor that draws by itself feels the difference.
vec3 toLinear(vec3 pixel) { return pixel * pixel; }

vec3 toPixel(vec3 light) { return sqrt(clamp(light * (1.0 + light * 0.12) / (0.82 + light), 0.0, 1.0)); }

vec3 ambientLight(vec3 normal) { return mix(kGroundLight, kSkyLight, 0.5 + 0.5 * normal.y); }

vec3 skyLight(vec3 towards, vec3 sun) {
  float up = max(towards.y, 0.0);
  vec3 sky = mix(kHorizon, kZenith, sqrt(up));
  float near = max(dot(towards, sun), 0.0), glow = near * near;
  glow *= glow;
  glow *= glow;
  glow *= glow;
  sky += vec3(0.55, 0.42, 0.25) * glow * 0.35 + vec3(6.0, 5.2, 4.0) * smoothstep(0.9994, 0.9998, near);
  return towards.y < 0.0 ? mix(kHorizon, vec3(0.30, 0.29, 0.27), min(-towards.y * 6.0, 1.0)) : sky;
}

vec3 withHaze(vec3 light, float distance) { return mix(kHorizon, light, 1.0 / (1.0 + 0.008 * max(distance - 12.0, 0.0))); }
