uniform mat4 viewProjection;
in vec4 vertex;
in vec4 colour;
out vec4 tint;
void main() {
  tint = colour;
  gl_Position = viewProjection * vec4(vertex.xyz, 1.0);
}
