#version 300 es
precision highp float;
uniform vec2 uResolution;
out vec4 color;

void main() {
    color = vec4((gl_FragCoord.x - 0.5) / uResolution.x, (uResolution.y - gl_FragCoord.y - 0.5) / uResolution.y, 0.5, 1.0);
}
