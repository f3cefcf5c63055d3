#version 330
// The name without a prefix, and the clock.
// date: 2026-11-29T18:30:12
uniform int frame;
uniform vec3 daytime;
uniform vec4 iDate;
uniform vec2 uResolution;
out vec4 color;

void main() {
    vec2 at = gl_FragCoord.xy / uResolution;
    color = vec4(float(frame) / 16.0, at, 1.0);
    if (at.x > 0.33) color = vec4(daytime / vec3(24.0, 60.0, 60.0), 1.0);
    if (at.x > 0.66) color = vec4((iDate.x - 2000.0) / 50.0, iDate.y / 12.0, iDate.z / 31.0, 1.0);
    if (at.x > 0.66 && at.y > 0.5) color = vec4(iDate.w / 86400.0, at, 1.0);
}
