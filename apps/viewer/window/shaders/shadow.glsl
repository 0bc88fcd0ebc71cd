// How much of the sun reaches a point, by the depth map. Four samples, each of them weighed by the sampler itself: edges are
// soft, and thin gaps between bricks do not flicker.
uniform sampler2DShadow shadowMap;
uniform float shadowTexel;  // one texel of the map, 0 .. 1
in vec4 shadowPlace;

float sunReaching() {
  vec3 place = vec3(shadowPlace.xy, 0.5 + 0.5 * shadowPlace.z);  // the map is straight: w is 1
  if (any(lessThan(place, vec3(0.0))) || any(greaterThan(place, vec3(1.0)))) return 1.0;
  float sum = 0.0;
  for (int i = 0; i < 4; i++) {
    vec2 aside = vec2(i & 1, i >> 1) * 1.5 - 0.75;
    sum += texture(shadowMap, place + vec3(aside * shadowTexel, 0.0));
  }
  return sum / 4.0;
}
