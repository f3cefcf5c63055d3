#version 300 es
precision highp float;
uniform vec2 uResolution;
uniform sampler2D picture; // data/four.png
in vec2 vUv;
out vec4 color_;

void main() {
    int n = 3;
    n <<= 1;
    color_ = vec4(texture(picture, vUv).rgb * float(n) / 6.0, 1);
}
