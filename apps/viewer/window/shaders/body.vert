// A mesh at the place of each body: rows of its matrix, colour and what varies from body to body come once per instance.
uniform mat4 viewProjection;
#ifdef DEPTH_SHADOWS
uniform mat4 shadowMatrix;
out vec4 shadowPlace;
#endif
in vec4 vertex;
in vec3 normal;
in vec2 uv0;
in vec4 uv1, uv2, uv3;  // rows of the matrix
in vec4 uv4;            // colour; how much of it shows through the texture
in vec4 uv5;            // where in the texture, brightness, glow
out vec3 worldPoint, worldNormal;
out vec2 place;
out vec4 tint;
out vec2 shade;

void main() {
  vec4 local = vec4(vertex.xyz, 1.0);
  worldPoint = vec3(dot(uv1, local), dot(uv2, local), dot(uv3, local));
  worldNormal = vec3(dot(uv1.xyz, normal), dot(uv2.xyz, normal), dot(uv3.xyz, normal));
  place = uv0 + uv5.xy;
  tint = uv4;
  shade = uv5.zw;
#ifdef DEPTH_SHADOWS
  // A little out of the surface, so that it does not shadow itself.
  shadowPlace = shadowMatrix * vec4(worldPoint + normalize(worldNormal) * 0.004, 1.0);
#endif
  gl_Position = viewProjection * vec4(worldPoint, 1.0);
}
