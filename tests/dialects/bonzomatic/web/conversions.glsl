#version 410 core
uniform float fGlobalTime;
uniform vec2 v2Resolution;
in vec2 out_texcoord;
layout(location = 0) out vec4 out_color;

float half_of(float x) { return x / 2.0; }

void main(void)
{
  float one = 1.0;
  int two = 2;
  vec3 color = vec3(out_texcoord * float(two), 0) * 0.5;
  color.z = half_of(float(two)) - 0.5 * out_texcoord.x * one;
  uint bits = uint(gl_FragCoord.y);
  color.x += float(bits) / 40.0;
  color = max(color, 0.125 * vec3(1, 2, 0)) / 1.0;
  float weights[3] = float[](1.0, 2.0, 3.0);
  color.y *= weights[two - 1] / 3.0;
  out_color = vec4(color, one);
}
