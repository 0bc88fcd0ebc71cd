// Sprites that face the camera: a corner each, placed by where the puff is and how large.
uniform mat4 viewProjection;
uniform vec3 right, up;
in vec4 vertex;  // place of the puff
in vec3 uv1;     // colour
in vec4 uv0;     // corner -1 .. 1, radius, how much is left
out vec2 corner;
out float left;
out vec3 colour;
out vec3 worldPoint;
void main() {
  corner = uv0.xy;
  left = uv0.w;
  colour = uv1;
  worldPoint = vertex.xyz + (right * uv0.x + up * uv0.y) * uv0.z;
  gl_Position = viewProjection * vec4(worldPoint, 1.0);
}
