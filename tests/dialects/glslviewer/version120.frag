#version 120
// From 1.20 on whole numbers become floats.
uniform vec2 u_resolution;
uniform float u_time;
varying vec2 v_texcoord;

void main() {
    float levels[2] = float[2](1, .5);
    vec3 color = vec3(v_texcoord * 2, 1) / 2;
    gl_FragColor = vec4(color * levels[1] + u_time, 1);
}
