#version 300 es
#ifdef GL_ES
precision mediump float;
#endif
uniform vec2 u_resolution;
uniform float u_time;
in vec2 v_texcoord;
out vec4 fragColor;

void main() {
    uvec2 cell = uvec2(gl_FragCoord.xy) >> 2;
    fragColor = vec4(vec2(cell & 3u) / 4.0, v_texcoord.x * 0.5 + u_time, 1.0);
}
