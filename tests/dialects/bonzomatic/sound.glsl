#version 410 core
// spectrum: 220,4
// The spectrum in .r, bass first; texels are filtered and the texture repeats.
uniform float fGlobalTime;
uniform vec2 v2Resolution;
uniform sampler1D texFFT;
in vec2 out_texcoord;
layout(location = 0) out vec4 out_color;

void main(void)
{
  float at = out_texcoord.x * 0.5 + 0.001;
  float texel = texelFetch(texFFT, int(out_texcoord.x * 511.0), 0).r;
  out_color = vec4(8.0 * texture(texFFT, at).r, out_texcoord.x, 6.0 * texel, 1.0);
  if (out_texcoord.y > 0.5) out_color.g = 4.0 * texture(texFFT, at + 2.0).r;
}
