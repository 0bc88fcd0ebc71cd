// The light of every picture: sun, sky, haze, and how light becomes what a screen shows. One text for three programs: window and
// page put it into their shaders, the film has it as C++ (light.cpp). So it keeps to what both languages read: no other types than
// float, vec2 and vec3, an f behind each number, nothing but the functions that light.cpp offers.
// Light is linear. A matt surface of colour c sends c * (ambientLight + kSunLight / pi * cosine).

const vec3 kSunLight = vec3(4.9f, 4.25f, 3.4f);  // on a surface that faces it
const vec3 kZenith = vec3(0.25f, 0.37f, 0.56f);
const vec3 kHorizon = vec3(0.68f, 0.73f, 0.78f);
const vec3 kGlow = vec3(1.0f, 0.90f, 0.74f);  // around the sun
const vec3 kBelow = vec3(0.39f, 0.37f, 0.34f);  // what bare ground sends back
// The parts of ambientLight.
const vec3 kFromAbove = vec3(0.292f, 0.405f, 0.581f), kFromBelow = vec3(0.390f, 0.370f, 0.341f);
const vec3 kFromHorizon = vec3(0.055f, 0.051f, 0.039f), kFromSun = vec3(0.061f, 0.055f, 0.045f);
const float kExposure = 1.06f;
const float kShoulder = 0.62f;  // up to here tones are as they are; lower: softer highlights, a greyer picture

// The sun stands over the left shoulder of who looks along -back (level, unit): 40 degrees to the side, 42 high.
vec3 sunFrom(vec3 back) {
  return vec3(0.5692820f * back.x - 0.4776843f * back.z, 0.6691306f, 0.5692820f * back.z + 0.4776843f * back.x);
}

// From a direction (unit), without the sun's disc: brightest at the horizon, where the way through the air is longest, and around
// the sun. Below the horizon it is bare ground.
vec3 skyLight(vec3 towards, vec3 sun) {
  float clear = 1.0f - max(towards.y, 0.0f);
  float near = max(dot(towards, sun), 0.0f);
  float near2 = near * near, near4 = near2 * near2, near8 = near4 * near4;
  float near32 = near8 * near8 * near8 * near8;
  vec3 light = mix(kZenith, kHorizon, clear * clear * clear) + kGlow * (0.2f * near8 + 0.7f * near32 * near32);
  return mix(light, kBelow, smoothstep(0.0f, 0.12f, -towards.y));
}

// The mean of sky and ground over all that a surface faces, by a fit to skyLight: for who follows no rays.
vec3 ambientLight(vec3 normal, vec3 sun) {
  float side = 0.5f + 0.5f * dot(normal, sun);
  return mix(kFromBelow, kFromAbove, 0.5f + 0.5f * normal.y) + kFromHorizon * (1.0f - normal.y * normal.y) +
         kFromSun * (side * side);
}

// Share of the horizon's light in what is seen of the ground at a distance, m; and that light.
float hazeShare(float away) { return 1.0f - exp(-max(away - 5.0f, 0.0f) / 90.0f); }
vec3 hazeLight(vec3 towards, vec3 sun) { return skyLight(normalize(vec3(towards.x, 0.004f, towards.z)), sun); }

// Ground without end is a floor with a joint every metre, to judge sizes by, that fade before they could flicker. 0 .. 1;
// `width`: of a pixel, m.
float jointAt(float place, float width) {
  float line = 1.0f - smoothstep(0.0022f, 0.0022f + 1.5f * width, abs(fract(place - 0.5f) - 0.5f));
  return line * clamp(1.0f - 3.0f * width, 0.0f, 1.0f);
}
float floorShade(vec2 place, vec2 width) { return 1.0f - 0.2f * max(jointAt(place.x, width.x), jointAt(place.y, width.y)); }

// What is left of a brick's colour towards the edge of its face: little light falls into the crack between two bricks, and the edges
// themselves are not seen from afar. Near by it is left to relief and shadow. m, from the edge; width of a pixel. The page finds its
// joints by what lies beyond an edge, and is about as dark there.
float edgeShade(float toEdge, float pixel) {
  float crack = 0.0033f + 0.7f * pixel;
  float dark = smoothstep(0.0006f, 0.0025f, pixel) * 0.0033f / crack;
  return 1.0f - 0.55f * dark * (1.0f - smoothstep(0.25f * crack, 1.5f * crack, toEdge));
}

// Straight up to the shoulder, then towards 1 without ever reaching it.
float pressed(float v) {
  float over = max(v - kShoulder, 0.0f) / (1.0f - kShoulder);
  return min(v, kShoulder) + (1.0f - kShoulder) * (over / (1.0f + over));
}
// Half by each colour for itself (which bleaches), half by the brightest (which keeps the hue).
vec3 toneMapped(vec3 light) {
  vec3 lit = max(light, vec3(0.0f, 0.0f, 0.0f));
  float peak = max(max(lit.x, lit.y), max(lit.z, 0.000001f));
  return (vec3(pressed(lit.x), pressed(lit.y), pressed(lit.z)) + lit * (pressed(peak) / peak)) * 0.5f;
}
vec3 shownAs(vec3 light) { return toneMapped(light * kExposure); }
