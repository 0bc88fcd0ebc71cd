uniform mat4 projection;
in vec4 vertex;
in vec2 uv0;
in vec4 colour;
out vec2 place;
out vec4 tint;
void main() {
  place = uv0;
  tint = colour;
  gl_Position = projection * vec4(vertex.xy, 0.0, 1.0);
}
