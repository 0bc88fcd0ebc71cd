// A fixed plane: packed earth with a faint grid of one metre, so that sizes can be judged.
uniform vec3 sun, eye;
uniform float flatColour;
in vec3 worldPoint, worldNormal, base;
in vec2 place;
in vec4 tint;
flat in float layer, glow;
out vec4 pixel;

float noiseAt(vec2 cell) { return fract(sin(dot(mod(cell, 289.0), vec2(12.9898, 78.233))) * 43758.5453); }

float smoothNoise(vec2 at) {
  vec2 cell = floor(at), within = fract(at);
  within = within * within * (3.0 - 2.0 * within);
  return mix(mix(noiseAt(cell), noiseAt(cell + vec2(1, 0)), within.x),
             mix(noiseAt(cell + vec2(0, 1)), noiseAt(cell + vec2(1, 1)), within.x), within.y);
}

void main() {
  if (flatColour > 0.5) {
    pixel = vec4(tint.rgb, 1.0);
    return;
  }
  vec3 normal = normalize(worldNormal);
  float far = distance(eye, worldPoint);
  float grain = smoothNoise(place * 0.45) * 0.5 + mix(smoothNoise(place * 3.1), 0.5, min(far / 30.0, 1.0)) * 0.3;
  grain += mix(smoothNoise(place * 23.0), 0.5, min(far / 9.0, 1.0)) * 0.2;
  vec2 line = abs(fract(place - 0.5) - 0.5) / (fwidth(place) + 0.004);
  float grid = (1.0 - min(min(line.x, line.y), 1.0)) * exp(-far * 0.07);
  vec3 albedo = base * (0.72 + 0.56 * grain) * (1.0 - 0.22 * grid);
  float facing = max(dot(normal, sun), 0.0);
#ifdef DEPTH_SHADOWS
  facing *= sunReaching();
#endif
  vec3 light = albedo * (ambientLight(normal) + kSunLight * facing);
  pixel = vec4(toPixel(withHaze(light, far)), 1.0);
}
