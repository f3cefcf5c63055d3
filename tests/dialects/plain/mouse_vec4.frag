#version 300 es
precision highp float;
// mouse: 11,14
uniform vec4 iMouse;
uniform vec3 iResolution;
out vec4 color;

void main() {
    color = vec4(iMouse.xy / iResolution.xy, gl_FragCoord.x / iResolution.x, 1.0);
}
