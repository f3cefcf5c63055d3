#version 410 core
// The copy of the last frame has no alpha: it reads 1, whatever was written.
uniform vec2 v2Resolution;
uniform sampler2D texPreviousFrame;
in vec2 out_texcoord;
layout(location = 0) out vec4 out_color;

void main(void)
{
  float a = texture(texPreviousFrame, out_texcoord).a;
  out_color = vec4(a * out_texcoord, 0.5 * a, 0.25);
}
