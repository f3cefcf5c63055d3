#version 430
// Arrays of arrays: `float[3] a[2]` has two arrays of three.
uniform vec2 uResolution;
out vec4 color;

struct Grid {
    vec2 origin;
    float[3] rows[2];
};

const float[3] steps[2] = {{0.0, 0.25, 0.5}, {0.5, 0.75, 1.0}};
float sums[2][3];
ivec2 bits[2][2][2];

float last(float[2][3] all, int row) {
    return all[row][all[row].length() - 1];
}

void turn(inout float[3] all[2]) {
    float[3] first = all[0];
    all[0] = all[1];
    all[1] = first;
}

float[2][2] corners(vec2 at) {
    return float[2][2](float[2](at.x, at.y), float[](1.0 - at.x, 1.0 - at.y));
}

void main() {
    vec2 at = gl_FragCoord.xy / uResolution;
    int row = int(at.y * 2.0), column = int(at.x * 3.0);
    for (int i = 0; i < sums.length() * sums[0].length(); ++i)
        sums[i / 3][i % 3] = (i % 3 > 0 ? sums[i / 3][i % 3 - 1] : 0.0) + steps[i / 3][i % 3] / 3.0;
    bits[row][0][1] = ivec2(column, 1);
    Grid grid = Grid(at, sums);
    turn(grid.rows);
    float red = steps[row][column];
    float green = grid.rows[row][column] * 0.5 + last(sums, row) * 0.25;
    float blue = corners(grid.origin)[row][column & 1] * 0.5;
    blue += grid.rows == sums ? 0.5 : float(bits[row][0][row ^ 1].x + bits[row][0][1].y) / 8.0;
    color = vec4(red, green, blue, 1.0);
}
