#version 410 core
uniform vec2 uResolution;
uniform float uTime;
uniform Settings { vec4 tint; float level; };
in vec2 vUv;
layout(location = 0) out vec4 fragColor;

float wave(float x) { return 0.5 + 0.5 * sin(x); }

void main() {
    vec2 at = gl_FragCoord.xy / uResolution;
    uint bits = uint(at.y * 8) << 1;
    fragColor = vec4(at.x, bits / 16.0, wave(6 * vUv.x + uTime) + tint.x + level, bool(tint.w) ? 0 : 1);
}
