// The icon of Eddy: two streams that turn into each other, on a rounded square. Alpha is straight, as PNG has it.

const vec3 DEEP = vec3(0.035, 0.070, 0.150);
const vec3 SKY = vec3(0.070, 0.180, 0.330);
const vec3 COOL = vec3(0.200, 0.850, 0.900);
const vec3 WARM = vec3(1.000, 0.560, 0.240);

// Signed distance to a square of half size `h` with corners of radius `r`.
float rounded_square(vec2 p, float h, float r) {
    vec2 q = abs(p) - (h - r);
    return length(max(q, 0.0)) + min(max(q.x, q.y), 0.0) - r;
}

// The colour at `p`, in -1..1 across the icon.
vec4 icon(vec2 p) {
    // 1/24 of the size is left free around, as desktops expect.
    if (rounded_square(p, 0.93, 0.40) > 0.0) return vec4(0.0);
    vec3 color = mix(DEEP, SKY, 0.5 + 0.5 * dot(p, normalize(vec2(-0.4, 1.0))));
    float r = length(p);
    // Logarithmic spirals, which are what a vortex makes of a straight front. They turn faster at the centre.
    float turn = atan(p.y, p.x) + 2.3 * log(r + 0.10);
    float wave = cos(turn);
    // How far a stream is from its own middle, and its width, which grows outwards.
    float width = mix(0.30, 0.62, smoothstep(0.0, 0.8, r));
    float warm = smoothstep(1.0 - width - 0.12, 1.0 - width + 0.12, wave);
    float cool = smoothstep(1.0 - width - 0.12, 1.0 - width + 0.12, -wave);
    float inside = 1.0 - smoothstep(0.68, 0.80, r);
    // Light on the outer edge of each stream.
    float shade = 0.80 + 0.35 * sin(turn) * (wave > 0.0 ? 1.0 : -1.0);
    color = mix(color, WARM * shade, warm * inside);
    color = mix(color, COOL * shade, cool * inside);
    // The eye.
    float eye = 1.0 - smoothstep(0.05, 0.11, r);
    color = mix(color, vec3(1.0, 0.97, 0.92), eye);
    return vec4(color, 1.0);
}

// Samples per pixel along each side.
const int N = 6;

void mainImage(out vec4 fragColor, in vec2 fragCoord) {
    vec4 sum = vec4(0.0);
    for (int y = 0; y < N; y++) {
        for (int x = 0; x < N; x++) {
            vec2 at = floor(fragCoord) + (vec2(x, y) + 0.5) / float(N);
            vec4 c = icon(2.0 * at / iResolution.xy - 1.0);
            sum += vec4(c.rgb * c.a, c.a);
        }
    }
    fragColor = vec4(sum.rgb / max(sum.a, 1.0), sum.a / float(N * N));
}
