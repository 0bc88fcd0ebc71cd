uniform sampler2D font;
in vec2 place;
in vec4 tint;
out vec4 pixel;
void main() { pixel = tint * texture(font, place); }
