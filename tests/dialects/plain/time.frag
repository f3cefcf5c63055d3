#version 300 es
precision highp float;
// The names for time and the number of the frame, which counts from 0.
uniform float uTime, iTime, iGlobalTime, iTimeDelta;
uniform int uFrame, iFrame;
uniform vec2 uResolution;
out vec4 color;

void main() {
    vec2 at = gl_FragCoord.xy / uResolution;
    color = vec4(uTime * 4.0, iTime * 5.0, iGlobalTime * 6.0, 1.0);
    if (at.x > 0.33) color = vec4(iTimeDelta * 30.0, float(uFrame) / 16.0, at.y, 1.0);
    if (at.x > 0.66) color = vec4(float(iFrame) / 8.0, at, 1.0);
}
