// (cos, sin) of m / n of a turn, within the last bits of a float on every device: the angle is brought within an eighth of
// a turn, where their series are short. What devices give by themselves may be 5e-4 off.
vec2 turn(int m, int n) {
    int quarter = (8 * m + n) / (2 * n);
    float a = 1.57079632679 * float(4 * m - quarter * n) / float(n), b = a * a;
    float s = a * (1.0 - b / 6.0 * (1.0 - b / 20.0 * (1.0 - b / 42.0 * (1.0 - b / 72.0))));
    float c = 1.0 - b / 2.0 * (1.0 - b / 12.0 * (1.0 - b / 30.0 * (1.0 - b / 56.0 * (1.0 - b / 90.0))));
    vec2 w = (quarter & 1) == 0 ? vec2(c, s) : vec2(-s, c);
    return (quarter & 2) == 0 ? w : -w;
}

vec2 times(vec2 a, vec2 b) {
    return vec2(a.x * b.x - a.y * b.y, a.x * b.y + a.y * b.x);
}
