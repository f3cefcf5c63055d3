#version 410 core
// The last frame is filtered, and repeats.
uniform float fGlobalTime;
uniform sampler2D texPreviousFrame;
in vec2 out_texcoord;
layout(location = 0) out vec4 out_color;

void main(void)
{
  vec2 wave = 0.5 - 0.5 * cos(6.2831853 * out_texcoord);
  vec4 moved = texture(texPreviousFrame, out_texcoord + vec2(0.2578125, -0.25) + vec2(0.0, 0.5 / 18.0));
  out_color = fGlobalTime < 0.1 ? vec4(wave, out_texcoord.x, 1.0) : moved;
}
