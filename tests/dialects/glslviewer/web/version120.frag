#version 300 es
precision highp float;
uniform vec2 u_resolution;
uniform float u_time;
in vec2 v_texcoord;
out vec4 color_;

void main() {
    float levels[2] = float[2](1.0, .5);
    vec3 color = vec3(v_texcoord * 2.0, 1) / 2.0;
    color_ = vec4(color * levels[1] + u_time, 1);
}
