// A mesh at the place of each body: rows of its matrix, colour and what varies from body to body come once per instance.
uniform mat4 viewProjection;
uniform float faces;  // 1: a brick, whose edges are cut
uniform vec3 eye;
uniform float viewHeight;  // pixels
uniform float volumes;     // 1: shadows are volumes, cut as sharpenedAt (body_drawer.cpp) says
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
centroid out vec2 inFace;
out vec4 tint;
flat out float layer, glow, ball;

const float kChamfer = 0.0022;  // m, of the mesh

// A strip along an edge that is a pixel or two wide is seen as dots: the edge goes over into a sharp one. How much of that, for
// the edges between this vertex's face and those across x, y and z.
vec3 sharpness(vec3 corner, vec3 outwards) {
  vec4 depth = vec4(viewProjection[0].w, viewProjection[1].w, viewProjection[2].w, viewProjection[3].w);
  if (volumes > 0.5) return vec3(smoothstep(0.8, 2.2, dot(depth, vec4(uv1.w, uv2.w, uv3.w, 1.0))));
  // Strips are as wide as they are seen: nothing where they are turned away.
  vec3 place = vec3(dot(uv1, vec4(corner, 1.0)), dot(uv2, vec4(corner, 1.0)), dot(uv3, vec4(corner, 1.0)));
  vec3 away = normalize(eye - place), here = outwards * (uv1.xyz * away.x + uv2.xyz * away.y + uv3.xyz * away.z);
  float lens = length(vec3(viewProjection[0].y, viewProjection[1].y, viewProjection[2].y));
  float pixel = 2.0 * max(dot(depth, vec4(place, 1.0)), 0.01) / (lens * viewHeight);  // m
  return 1.0 - smoothstep(2.6, 3.0, kChamfer / pixel * (here + dot(here, abs(normal))));
}

void main() {
  vec4 local = vec4(vertex.xyz, 1.0);
  vec3 outwards = sign(vertex.xyz), toCorner = outwards * (1.0 - abs(normal)) * (kChamfer * faces);
  local.xyz += toCorner * sharpness(local.xyz + toCorner, outwards);
  worldPoint = vec3(dot(uv1, local), dot(uv2, local), dot(uv3, local));
  worldNormal = vec3(dot(uv1.xyz, normal), dot(uv2.xyz, normal), dot(uv3.xyz, normal));
  place = inFace = uv0.xy + uv6.xy;
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
