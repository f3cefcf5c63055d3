#version 410 core
// spectrum: 220,4
// The sum over frames is of a slightly averaged spectrum.
uniform float fGlobalTime;
uniform vec2 v2Resolution;
uniform sampler1D texFFTIntegrated;
in vec2 out_texcoord;
layout(location = 0) out vec4 out_color;

void main(void)
{
  float sum = texture(texFFTIntegrated, out_texcoord.x * 0.5 + 0.001).r;
  out_color = vec4(sum, out_texcoord.y, 0.25, 1.0);
}
