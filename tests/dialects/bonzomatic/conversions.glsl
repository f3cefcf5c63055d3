#version 410 core
// Whole numbers become floats without a constructor, and double exists as a suffix of floats.
uniform float fGlobalTime;
uniform vec2 v2Resolution;
in vec2 out_texcoord;
layout(location = 0) out vec4 out_color;

float half_of(float x) { return x / 2; }

void main(void)
{
  float one = 1;
  int two = 2;
  vec3 color = vec3(out_texcoord * two, 0) * 0.5f;
  color.z = half_of(two) - 0.5 * out_texcoord.x * one;
  uint bits = uint(gl_FragCoord.y);
  color.x += bits / 40.0;
  color = max(color, 0.125 * vec3(1, 2, 0)) / 1;
  float weights[3] = float[](1, 2, 3);
  color.y *= weights[two - 1] / 3;
  out_color = vec4(color, one);
}
