#version 410 core
// spectrum: 220,4
// The average over frames, which starts at 0.
uniform float fGlobalTime;
uniform vec2 v2Resolution;
uniform sampler1D texFFTSmoothed;
in vec2 out_texcoord;
layout(location = 0) out vec4 out_color;

void main(void)
{
  float smoothed = texture(texFFTSmoothed, out_texcoord.x * 0.5 + 0.001).r;
  out_color = vec4(10.0 * smoothed, out_texcoord.y, 0.25, 1.0);
}
