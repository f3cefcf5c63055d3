#version 150
// gl_FragCoord may count from the top left, and in whole numbers.
layout(origin_upper_left, pixel_center_integer) in vec4 gl_FragCoord;
uniform vec2 uResolution;
out vec4 color;

void main() {
    color = vec4(gl_FragCoord.xy / uResolution, 0.5, 1.0);
}
