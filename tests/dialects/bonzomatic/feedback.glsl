#version 410 core
// The last frame has 8 bits: 0.7 of a step is rounded to a whole one, 0.3 is lost, and it stops at 0 and 1.
uniform float fGlobalTime;
uniform vec2 v2Resolution;
uniform sampler2D texPreviousFrame; // screenshot of the previous frame
in vec2 out_texcoord;
layout(location = 0) out vec4 out_color;

void main(void)
{
  vec3 before = texture(texPreviousFrame, out_texcoord).rgb;
  if (fGlobalTime < 0.01) before = vec3(0.0);
  float part = out_texcoord.x < 0.5 ? 0.7 : 0.3;
  vec3 next = vec3(before.r + part / 255.0, before.g + 0.3, before.r * 30.0);
  if (before.g > 0.95) next.g = before.g - 0.5;
  if (out_texcoord.y > 0.5) next = vec3(before.r + 0.3 * out_texcoord.x, before.g, before.b > 0.5 ? before.b - 0.75 : 1.5);
  out_color = vec4(next, 1.0);
}
