// What all surfaces share besides the light itself (apps/appearance/light.glsl): from the bytes of textures to light, and from light
// to a pixel. Polynomials and roots instead of exponentials: a processor that draws by itself feels the difference.
const vec3 kSunOnMatt = kSunLight / 3.14159265;

vec3 toLinear(vec3 pixel) { return pixel * (pixel * (pixel * 0.305306 + 0.682171) + 0.012523); }

vec3 toPixel(vec3 light) {
  vec3 root = sqrt(shownAs(light)), fourth = sqrt(root);
  return clamp(0.585122 * root + 0.783140 * fourth - 0.368263 * sqrt(fourth), 0.0, 1.0);
}
