#version 410 core
// A picture by its texels: row 0 is the first one. The square root shows the linear colours almost as in the file.
uniform vec2 v2Resolution;
uniform sampler2D texTex1; // data/four.png
in vec2 out_texcoord;
layout(location = 0) out vec4 out_color;

void main(void)
{
  ivec2 size = textureSize(texTex1, 0);
  vec4 texel = texelFetch(texTex1, ivec2(out_texcoord * vec2(size)), 0);
  out_color = vec4(sqrt(texel.rgb), float(size.x) / 8.0);
}
