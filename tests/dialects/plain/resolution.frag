#version 300 es
precision highp float;
// The size as a vec2 and as a vec3.
uniform vec3 iResolution;
uniform vec2 uResolution;
out vec4 color;

void main() {
    vec2 at = gl_FragCoord.xy / iResolution.xy;
    color = vec4(at, iResolution.z * 0.5, 1.0);
    if (at.y > 0.5) color = vec4(uResolution / 64.0, at.x, 1.0);
}
