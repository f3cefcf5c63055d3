#version 410 core
// Texts from before 2022 have no out_texcoord, and an output may have any name.
uniform vec2 v2Resolution;
uniform float fGlobalTime;
layout(location = 0) out vec4 result;

void main(void)
{
  vec2 uv = vec2(gl_FragCoord.x / v2Resolution.x, gl_FragCoord.y / v2Resolution.y);
  result = vec4(uv, 0.5 + 0.5 * sin(fGlobalTime * 3.0 + uv.x * 2.0), 1.0);
}
