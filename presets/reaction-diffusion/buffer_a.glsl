// One step of the reaction; eddy.toml draws it several times a frame. Channel 0 is the state before, 1 the mouse.

ivec2 last;

// Beyond the wall lies the cell inside it: nothing flows through, so every kernel that is symmetric and sums to 1 keeps
// the total to rounding.
vec2 cell(ivec2 p) {
    return texelFetch(iChannel0, clamp(p, ivec2(0), last), 0).xy;
}

void mainImage(out vec4 state, in vec2 fragCoord) {
    ivec2 p = ivec2(fragCoord);
    last = ivec2(iResolution.xy) - 1;
    vec2 q = cell(p);
    vec2 edges = cell(p - ivec2(1, 0)) + cell(p + ivec2(1, 0)) + cell(p - ivec2(0, 1)) + cell(p + ivec2(0, 1));
    float h = min(dt, LONGEST_STEP);

    vec2 spread; // what diffusion changes in this step
    if (diffusion == 0) {
        spread = h * RATE * (edges - 4.0 * q);
    } else {
        vec2 corners = cell(p - 1) + cell(p + 1) + cell(p + ivec2(1, -1)) + cell(p + ivec2(-1, 1));
        if (diffusion == 1) {
            spread = h * RATE * (4.0 * edges + corners - 20.0 * q) / 6.0;
        } else {
            // (a, 1 - 2a, a) along each axis has the variance 2a = 2 D h of a diffusion over h.
            vec2 a = min(h * RATE, 0.5), b = 1.0 - 2.0 * a;
            spread = b * b * q + a * b * edges + a * a * corners - q;
        }
    }

    vec2 rates = recipe(fragCoord / iResolution.xy);
    float eaten = (1.0 - q.x) * q.y * q.y;
    q += spread + h * vec2(eaten - rates.x * q.x, eaten - (rates.x + rates.y) * q.y);

    // Seeds: a few at the start, the sower's while nobody draws, and the brush.
    float radius = brush_size * iResolution.y + 1.0;
    vec4 mouse = texelFetch(iChannel1, ivec2(0), 0);
    float near = 1e6;
    if (mouse.z > 0.0) {
        near = segmentDistance(fragCoord, mouse.xy, mouse.zw) / radius;
    } else if (sower > 0.0) {
        near = length(fragCoord - sowerAt(iTime, iResolution.xy)) / (0.012 * iResolution.y + 2.0) / sower;
        if (iFrame == 0) {
            for (int i = 0; i < 9; i++) {
                vec2 at = fract(vec2(0.7549, 0.5698) * float(i + 1)); // R2, M. Roberts 2018: even and without a grid
                near = min(near, length(fragCoord - at * iResolution.xy) / (0.02 * iResolution.y + 2.0));
            }
        }
    }
    if (near < 1.0) q = max(q, vec2(0.5, 0.25));

    // A brush that overfills a cell, or a number that is none, leaves the cell in range or fed.
    q = clamp(q, 0.0, 1.0);
    state = isFinite(vec4(q, 0.0, 0.0)) ? vec4(q, 0.0, 0.0) : vec4(0.0);
}
