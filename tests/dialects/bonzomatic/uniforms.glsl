#version 410 core

uniform float fGlobalTime; // in seconds
uniform vec2 v2Resolution; // viewport resolution (in pixels)
uniform float fFrameTime; // duration of the last frame, in seconds
uniform float fKnob; // of a MIDI device, which is not there

in vec2 out_texcoord; // 0..1, from the bottom left
layout(location = 0) out vec4 out_color; // out_color must be written in order to see anything

void main(void)
{
  vec3 color = vec3(fGlobalTime * 5.0, fGlobalTime, out_texcoord.x);
  if (out_texcoord.y > 0.33) color = vec3(v2Resolution / 64.0, out_texcoord.y);
  if (out_texcoord.y > 0.66) color = vec3(fFrameTime * 30.0, fFrameTime * 60.0 * out_texcoord.x, fKnob + 0.25);
  out_color = vec4(color, 1.0);
}
