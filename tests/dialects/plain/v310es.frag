#version 310 es
precision highp float;
uniform vec2 uResolution;
in vec2 vUv;
layout(location = 0) out vec4 fragColor;

void main() {
    uint packed = packUnorm2x16(vUv);
    vec2 back = unpackUnorm2x16(packed);
    fragColor = vec4(back, float(__VERSION__) / 620.0, 1.0);
}
