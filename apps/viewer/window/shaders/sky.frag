uniform vec3 sun;
in vec4 farPoint, nearPoint;
out vec4 pixel;
void main() {
  vec3 towards = normalize(farPoint.xyz / farPoint.w - nearPoint.xyz / nearPoint.w);
  pixel = vec4(toPixel(skyLight(towards, sun)), 1.0);
}
