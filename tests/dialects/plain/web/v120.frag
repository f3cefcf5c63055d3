#version 300 es
precision highp float;
uniform vec2 uResolution;
uniform float uTime;
const float levels[3] = float[3](0.25, 0.5, 1.0);
out vec4 color_;

vec3 scaled(vec3 color, float by) { return color * by; }

void main() {
    vec2 at = gl_FragCoord.xy / uResolution;
    float sum = 0.0;
    for (int i = 0; i < 3; ++i) sum += levels[i] / 2.0;
    mat2 turn = mat2(0, 1, -1, 0);
    vec2 turned = turn * (at - .5) + .5;
    mat3x2 wide = mat3x2(1, 0, 0, 1, 0, 0);
    vec2 narrow = wide * vec3(turned, 2);
    color_ = vec4(scaled(vec3(narrow, 1.0 - at.x), 1.0), 1) * sum;
}
