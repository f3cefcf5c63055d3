#version 410 core
uniform vec2 v2Resolution;
in vec2 out_texcoord;
layout(location = 0) out vec4 out_color;

void main(void)
{
  vec2 uv = out_texcoord - 0.5;
  uv /= vec2(v2Resolution.y / v2Resolution.x, 1.0);
  vec2 same = abs(out_texcoord - gl_FragCoord.xy / v2Resolution);
  out_color = vec4(out_texcoord, 0.9 - 0.8 * length(uv) * (1.0 - 100.0 * (same.x + same.y)), 1.0);
}
