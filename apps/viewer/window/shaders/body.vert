// A mesh at the place of each body: rows of its matrix, colour and what varies from body to body come once per instance.
uniform mat4 viewProjection;
uniform float faces;  // 1: a brick, whose edges are cut
#ifdef DEPTH_SHADOWS
uniform mat4 shadowMatrix;
out vec4 shadowPlace;
#endif
in vec4 vertex;
in vec3 normal;
in vec3 uv0;            // place in the texture, layer
in vec4 uv1, uv2, uv3;  // rows of the matrix
in vec4 uv4;            // colour; layer
in vec4 uv5;            // tint of the view; how much of it
in vec4 uv6;            // place in the texture; glow; 1: a ball
out vec3 worldPoint, worldNormal, base;
out vec2 place;
out vec4 tint;
flat out float layer, glow, ball;

const float kChamfer = 0.0022;  // m, of the mesh

void main() {
  vec4 local = vec4(vertex.xyz, 1.0);
  // From afar a cut edge is narrower than a pixel and glitters: it goes over into a sharp one.
  float far = dot(vec4(viewProjection[0].w, viewProjection[1].w, viewProjection[2].w, viewProjection[3].w),
                  vec4(uv1.w, uv2.w, uv3.w, 1.0));
  local.xyz += sign(vertex.xyz) * (1.0 - abs(normal)) * (kChamfer * faces * smoothstep(0.8, 2.2, far));
  worldPoint = vec3(dot(uv1, local), dot(uv2, local), dot(uv3, local));
  worldNormal = vec3(dot(uv1.xyz, normal), dot(uv2.xyz, normal), dot(uv3.xyz, normal));
  place = uv0.xy + uv6.xy;
  base = uv4.rgb;
  layer = uv0.z + uv4.a;
  tint = uv5;
  glow = uv6.z;
  ball = uv6.w;
#ifdef DEPTH_SHADOWS
  // A little out of the surface, so that it does not shadow itself.
  shadowPlace = shadowMatrix * vec4(worldPoint + normalize(worldNormal) * 0.004, 1.0);
#endif
  gl_Position = viewProjection * vec4(worldPoint, 1.0);
}
