#version 300 es
precision highp float;
// The picture is shown without its alpha.
uniform vec2 uResolution;
out vec4 color;

void main() {
    vec2 at = gl_FragCoord.xy / uResolution;
    color = vec4(at.x, 0.9, 0.3, at.y);
}
