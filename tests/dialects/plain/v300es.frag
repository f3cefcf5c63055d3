#version 300 es
precision mediump float;
precision highp int;
uniform vec2 uResolution;
uniform float uTime;
in highp vec2 vUv;
out vec4 fragColor;

void main() {
    ivec2 cell = ivec2(gl_FragCoord.xy) % 5;
    uvec2 mixed = uvec2(cell) ^ uvec2(3u);
    float rounded = round(vUv.x * 4.0 + 0.01) / 4.0;
    fragColor = vec4(vec2(mixed) / 8.0, rounded, 1.0);
    fragColor.g += uTime + 0.25 * trunc(vUv.y * 2.0);
}
