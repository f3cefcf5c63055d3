// One step of the reaction; eddy.toml draws it several times a frame. Channel 0 is the state before, 1 the mouse,
// 2 the state blurred along its rows.

ivec2 last;

// Beyond the wall lies the cell inside it: nothing flows through, so every kernel that is symmetric and sums to 1 keeps
// the total to rounding.
vec2 cell(ivec2 p) {
    return texelFetch(iChannel0, clamp(p, ivec2(0), last), 0).xy;
}

// The second pass of the blur: along the columns of what Buffer rows has blurred along the rows.
vec2 blurred(ivec2 p, float h) {
    vec2 weight[TAPS + 1];
    gaussian(h, weight);
    vec2 here = texelFetch(iChannel2, p, 0).xy, sum = here;
    for (int i = 1; i <= TAPS; i++) {
        int low = p.y - i, high = p.y + i;
        low = max(low, -1 - low);
        high = min(high, 2 * last.y + 1 - high);
        sum += weight[i] * ((texelFetch(iChannel2, ivec2(p.x, clamp(low, 0, last.y)), 0).xy - here)
                          + (texelFetch(iChannel2, ivec2(p.x, clamp(high, 0, last.y)), 0).xy - here));
    }
    return sum;
}

// What reaction changes in a unit of time, where U is eaten at a rate of `most` at most.
vec2 reaction(vec2 q, vec2 rates, float most) {
    float eaten = (1.0 - q.x) * min(q.y * q.y, most);
    return vec2(eaten - rates.x * q.x, eaten - (rates.x + rates.y) * q.y);
}

void mainImage(out vec4 state, in vec2 fragCoord) {
    ivec2 p = ivec2(fragCoord);
    last = ivec2(iResolution.xy) - 1;
    vec2 q = cell(p), rates = recipe(fragCoord / iResolution.xy);
    float h = min(dt, longestStep());

    if (diffusion == 3) {
        q = blurred(p, h);
        int parts = int(ceil(h / LONGEST_STEP));
        for (int i = 0; i < parts; i++) q += h / float(parts) * reaction(q, rates, 1e6);
    } else {
        // Sums of differences from the cell in the middle: what is even stays so to the last bit.
        vec2 edges = (cell(p - ivec2(1, 0)) - q) + (cell(p + ivec2(1, 0)) - q)
                   + (cell(p - ivec2(0, 1)) - q) + (cell(p + ivec2(0, 1)) - q);
        vec2 spread; // what diffusion changes in this step
        float left = 0.0; // what it leaves of the wave of two cells, as a part of it
        if (diffusion == 0) {
            spread = h * RATE * edges;
            left = 1.0 - 8.0 * h * RATE.x;
        } else {
            vec2 corners = (cell(p - 1) - q) + (cell(p + 1) - q)
                         + (cell(p + ivec2(1, -1)) - q) + (cell(p + ivec2(-1, 1)) - q);
            if (diffusion == 1) {
                spread = h * RATE * (4.0 * edges + corners) / 6.0;
                left = 1.0 - 16.0 / 3.0 * h * RATE.x;
            } else {
                // (a, 1 - 2a, a) along each axis has the variance 2a = 2 D h of a diffusion over h.
                vec2 a = min(h * RATE, 0.5);
                spread = a * (1.0 - 2.0 * a) * edges + a * a * corners;
            }
        }
        // Where V is so dense that diffusion and reaction together turn that wave round and make it larger, less is
        // eaten: with dt = 1 where V is above 0.88 with nine points, as without any kill, and above 0.53 with five.
        q += spread + h * reaction(q, rates, max((1.0 + left) / max(h, 1e-6) - rates.x, 0.0));
    }

    // Seeds: all over at the start, the sower's while nobody draws, and the brush.
    float radius = brush_size * iResolution.y + 1.0;
    vec4 mouse = texelFetch(iChannel1, ivec2(0), 0);
    float near = 1e6;
    if (mouse.z > 0.0) {
        near = segmentDistance(fragCoord, mouse.xy, mouse.zw) / radius;
    } else if (sower > 0.0) {
        near = length(fragCoord - sowerAt(iTime, iResolution.xy)) / (0.012 * iResolution.y + 2.0) / sower;
        if (iFrame == 0) {
            // A seed in every square of 32 cells, at some place in it and of some size: what grows meets its neighbours
            // within some 2,000 steps on a canvas of any size.
            for (int i = 0; i < 9; i++) {
                ivec2 square = ivec2(floor(fragCoord / 32.0)) + ivec2(i % 3, i / 3) - 1;
                vec3 dice = hash(square);
                near = min(near, length(fragCoord - 32.0 * (vec2(square) + dice.xy)) / mix(4.0, 8.0, dice.z));
            }
        }
    }
    if (near < 1.0) q = max(q, vec2(0.5, 0.25));

    // A brush that overfills a cell, or a number that is none, leaves the cell in range or fed.
    q = clamp(q, 0.0, 1.0);
    state = isFinite(vec4(q, 0.0, 0.0)) ? vec4(q, 0.0, 0.0) : vec4(0.0);
}
