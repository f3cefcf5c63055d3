#version 410 core
// The window is cleared to a dark green before each frame, which discarded pixels leave.
uniform vec2 v2Resolution;
uniform float fGlobalTime;
in vec2 out_texcoord;
layout(location = 0) out vec4 out_color;

void main(void)
{
  float frame = floor(fGlobalTime * 60.0 + 0.5);
  if (out_texcoord.x > 0.5 && mod(frame, 4.0) > 1.5) discard;
  out_color = vec4(out_texcoord, 0.5, 1.0);
}
