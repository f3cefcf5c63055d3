#version 410 core
// What live coders write: rotation matrices, marching, swizzles that are written.
uniform float fGlobalTime;
uniform vec2 v2Resolution;
in vec2 out_texcoord;
layout(location = 0) out vec4 out_color;

mat2 rot(float a) { return mat2(cos(a), -sin(a), sin(a), cos(a)); }

float map(vec3 p)
{
  p.xz *= rot(fGlobalTime * 4.0);
  return length(p * vec3(1.0, 1.25, 0.75)) - 0.8;
}

void main(void)
{
  vec2 uv = (out_texcoord - 0.5) * v2Resolution / v2Resolution.y;
  vec3 from = vec3(0.0, 0.0, -3.0), to = normalize(vec3(uv, 2.0));
  float t = 0.0;
  for (int i = 0; i < 24; i++) t += 0.5 * max(map(from + t * to), 0.0);
  float far = clamp(1.0 - t / 6.0, 0.0, 1.0);
  vec3 color = vec3(0.0);
  color.zyx += vec3(far, far * far, uv.y + 0.5);
  out_color = vec4(color, 1.0);
}
