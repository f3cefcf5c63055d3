#version 300 es
precision highp float;
uniform vec2 uResolution;
uniform float uTime;
in vec2 vUv;
layout(location = 0) out vec4 fragColor;

float wave(float x) { return 0.5 + 0.5 * sin(x); }

void main() {
    vec2 at = gl_FragCoord.xy / uResolution;
    uint bits = uint(at.y * 8.0) << 1;
    fragColor = vec4(at.x, float(bits) / 16.0, wave(6.0 * vUv.x + uTime), 1.0);
}
