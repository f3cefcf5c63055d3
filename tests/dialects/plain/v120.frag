#version 120
// From 1.20 on whole numbers become floats, literals end in f, and arrays have constructors.
uniform vec2 uResolution;
uniform float uTime;
const float levels[3] = float[3](0.25, 0.5, 1.0);

vec3 scaled(vec3 color, float by) { return color * by; }

void main() {
    vec2 at = gl_FragCoord.xy / uResolution;
    float sum = 0;
    for (int i = 0; i < 3; ++i) sum += levels[i] / 2;
    mat2 turn = mat2(0, 1, -1, 0);
    vec2 turned = turn * (at - .5f) + .5;
    mat3x2 wide = mat3x2(1, 0, 0, 1, 0, 0);
    vec2 narrow = wide * vec3(turned, 2);
    gl_FragColor = vec4(scaled(vec3(narrow, 1 - at.x), 1), 1) * sum;
}
