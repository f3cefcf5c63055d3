#version 330
// From 1.30 on the text declares its output.
uniform vec2 u_resolution;
uniform float u_time;
uniform sampler2D u_tex0; // data/four.png
in vec2 v_texcoord;
out vec4 fragColor;

void main() {
    uint bits = uint(gl_FragCoord.x) & 7u;
    vec2 texel = vec2(textureSize(u_tex0, 0));
    vec3 color = texelFetch(u_tex0, ivec2(v_texcoord * texel), 0).rgb;
    fragColor = vec4(mix(color, vec3(float(bits) / 7.0, u_time, v_texcoord.y), 0.5), 1.0);
}
