// One triangle over the whole picture; the fragment's way is found from its place on the screen.
uniform mat4 inverseViewProjection;
in vec4 vertex;
out vec4 farPoint, nearPoint;
void main() {
  farPoint = inverseViewProjection * vec4(vertex.xy, 0.9, 1.0);
  nearPoint = inverseViewProjection * vec4(vertex.xy, -0.9, 1.0);
  gl_Position = vec4(vertex.xy, 0.0, 1.0);
}
