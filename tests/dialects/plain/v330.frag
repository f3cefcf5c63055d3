#version 330 core
uniform vec2 iResolution;
uniform float iTime;
uniform int iFrame;
in vec2 vUv;
layout(location = 0) out vec4 fragColor;

struct Wave { float rate; vec2 at; };

float of(Wave wave) { return 0.5 + 0.5 * sin(wave.rate * wave.at.x + wave.at.y); }

void main() {
    Wave waves[2] = Wave[2](Wave(3.0, vUv), Wave(5.0, vUv.yx));
    float level = 0.0;
    for (int i = 0; i < waves.length(); i++) level += of(waves[i]) * 0.5;
    fragColor = vec4(level, float(iFrame) / 16.0, iTime * 4.0, 1.0);
}
