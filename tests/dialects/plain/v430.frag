#version 430
// A desktop version with two outputs, of which the one at location 0 is shown.
uniform vec2 uResolution;
layout(location = 1) out vec4 second;
layout(location = 0) out vec4 first;

void main() {
    vec2 at = gl_FragCoord.xy / uResolution;
    first = vec4(at, 0.75, 1.0);
    second = vec4(1.0, 0.0, 0.0, 1.0);
}
