#version 300 es
precision highp float;
uniform vec2 uResolution;
out vec4 color;

const float steps[6] = float[6](0.0, 0.25, 0.5, 0.5, 0.75, 1.0);

void main() {
    vec2 at = gl_FragCoord.xy / uResolution;
    int row = int(at.y * 2.0), column = int(at.x * 3.0);
    float sums[6];
    for (int i = 0; i < 6; ++i) sums[i] = (i % 3 > 0 ? sums[i - 1] : 0.0) + steps[i] / 3.0;
    float corner = column == 1 ? at.y : at.x;
    float green = sums[3 * (1 - row) + column] * 0.5 + sums[3 * row + 2] * 0.25;
    float blue = (row == 1 ? 1.0 - corner : corner) * 0.5;
    blue += float((row == 0 ? column : 0) + 1) / 8.0;
    color = vec4(steps[3 * row + column], green, blue, 1.0);
}
