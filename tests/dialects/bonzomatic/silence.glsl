#version 410 core
// spectrum: 0,1
// Silence: the spectra are 0, and have 1024 texels.
uniform float fGlobalTime;
uniform vec2 v2Resolution;
uniform sampler1D texFFT; // towards 1.0 is treble, towards 0.0 is bass
uniform sampler1D texFFTSmoothed; // this one has longer falloff
uniform sampler1D texFFTIntegrated; // this is continually increasing
in vec2 out_texcoord;
layout(location = 0) out vec4 out_color;

void main(void)
{
  float f = texture(texFFT, out_texcoord.x).r * 100.0;
  float smoothed = texelFetch(texFFTSmoothed, int(out_texcoord.x * 1023.0), 0).r * 100.0;
  float sum = texture(texFFTIntegrated, 0.25).r;
  float size = float(textureSize(texFFT, 0)) / 2048.0;
  out_color = vec4(out_texcoord.x + f, size + smoothed, 0.25 + sum, 1.0);
}
