// The filters. Both weigh the texels of a window about a texel by how alike they are.

vec3 at(ivec2 texel) {
    return texelFetch(iChannel0, clamp(texel, ivec2(0), ivec2(iResolution.xy) - 1), 0).rgb;
}

// C. Tomasi, R. Manduchi, "Bilateral Filtering for Gray and Color Images", ICCV 1998: likeness of two texels.
vec3 bilateral(ivec2 here, float sigma) {
    vec3 middle = at(here), sum = vec3(0.0);
    float weights = 0.0, space = 0.5 / (0.25 * float(radius * radius)), range = 0.5 / (9.0 * sigma * sigma);
    for (int y = -radius; y <= radius; y++) {
        for (int x = -radius; x <= radius; x++) {
            vec3 there = at(here + ivec2(x, y)), d = there - middle;
            float weight = exp(-float(x * x + y * y) * space - dot(d, d) * range);
            sum += weight * there;
            weights += weight;
        }
    }
    return sum / weights;
}

// A. Buades, B. Coll, J.-M. Morel, "A non-local algorithm for image denoising", CVPR 2005: likeness of two patches of 3x3,
// less what noise alone makes of it ("Non-Local Means Denoising", IPOL 2011).
vec3 nonLocalMeans(ivec2 here, float sigma) {
    vec3 own[9];
    for (int i = 0; i < 9; i++) own[i] = at(here + ivec2(i % 3 - 1, i / 3 - 1));
    vec3 sum = vec3(0.0);
    float weights = 0.0, largest = 0.0, scale = 1.0 / (0.30 * sigma * sigma);
    for (int y = -radius; y <= radius; y++) {
        for (int x = -radius; x <= radius; x++) {
            if (x == 0 && y == 0) continue;
            ivec2 there = here + ivec2(x, y);
            float apart = 0.0;
            for (int i = 0; i < 9; i++) {
                vec3 d = own[i] - at(there + ivec2(i % 3 - 1, i / 3 - 1));
                apart += dot(d, d);
            }
            float weight = exp(-max(apart / 27.0 - 2.0 * sigma * sigma, 0.0) * scale);
            largest = max(largest, weight);
            sum += weight * at(there);
            weights += weight;
        }
    }
    // The texel itself counts as much as the one that is most alike.
    largest = max(largest, 1e-3);
    return (sum + largest * own[4]) / (weights + largest);
}

void mainImage(out vec4 fragColor, in vec2 fragCoord) {
    ivec2 here = ivec2(fragCoord);
    float sigma = max(noise, 0.01) * strength;
    vec3 colour = method == 0 ? at(here) : method == 1 ? bilateral(here, sigma) : nonLocalMeans(here, sigma);
    fragColor = vec4(colour, 1.0);
}
