#version 300 es
precision highp float;
// Uniforms of the author's own are 0 until they are set.
uniform float strength;
uniform vec3 tint;
uniform int count;
uniform bool isOn;
uniform vec2 uResolution;
out vec4 color;

void main() {
    vec2 at = gl_FragCoord.xy / uResolution;
    color = vec4(at.x * (1.0 - strength), at.y + float(count), 0.5 + tint.z, 1.0);
    if (isOn) color = vec4(1.0);
}
