#version 410 core
// A picture is not turned over: v = 0 is its first row. Its colours are linear when they are read. It repeats.
uniform vec2 v2Resolution;
uniform sampler2D texTex1; // data/four.png
in vec2 out_texcoord;
layout(location = 0) out vec4 out_color;

void main(void)
{
  out_color = texture(texTex1, out_texcoord * 1.75 - 0.25);
}
