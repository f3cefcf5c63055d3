#version 300 es
precision highp float;
// mouse: 20,5
uniform vec2 uMouse;
uniform vec2 uResolution;
out vec4 color;

void main() {
    float near = 1.0 - distance(gl_FragCoord.xy, uMouse) / 40.0;
    color = vec4(uMouse / uResolution, near, 1.0);
}
