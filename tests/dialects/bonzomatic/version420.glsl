#version 420 core
uniform float fGlobalTime;
uniform vec2 v2Resolution;
layout(location = 0) out vec4 out_color;
const float steps[4] = { 0.1, 0.2, 0.4, 0.8 };

void main(void)
{
  vec2 uv = gl_FragCoord.xy / v2Resolution;
  int n = int(uv.x * 4);
  out_color = vec4(steps[n], uv.y, fGlobalTime * 2, 1).xyzw;
}
