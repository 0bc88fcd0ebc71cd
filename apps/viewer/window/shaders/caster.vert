// Depth alone, from the sun. Turned and placed as body.vert does.
uniform mat4 viewProjection;
in vec4 vertex;
in vec4 uv1, uv2, uv3;
void main() {
  vec4 local = vec4(vertex.xyz, 1.0);
  gl_Position = viewProjection * vec4(dot(uv1, local), dot(uv2, local), dot(uv3, local), 1.0);
}
