#if METHOD == SMAA
// SMAA, section 4.4: the colours of neighbours across the stronger of the two directions.
void mainImage(out vec4 field, in vec2 fragCoord) {
    ivec2 p = ivec2(fragCoord), x = ivec2(1, 0), y = ivec2(0, 1);
    vec4 own = texel(iChannel1, p);
    vec2 vertical = vec2(own.x, texel(iChannel1, p + y).y), horizontal = vec2(own.z, texel(iChannel1, p + x).w);
    bool isVertical = max(vertical.x, vertical.y) >= max(horizontal.x, horizontal.y);
    vec2 weights = isVertical ? vertical : horizontal;
    ivec2 across = isVertical ? y : x;
    field = (1.0 - weights.x - weights.y) * texel(iChannel0, p) + weights.x * texel(iChannel0, p - across)
        + weights.y * texel(iChannel0, p + across);
}
#else
// Lottes, FXAA, NVIDIA 2009: across the edge that a pixel lies at, by how near the nearer end of the edge is, and by how much the
// pixel stands out from its neighbours.
const float CONTRAST = 0.125, DARK = 0.0312, SUBPIXEL = 0.75;

float lumaAt(ivec2 p) {
    return luma(iChannel0, p);
}

void mainImage(out vec4 field, in vec2 fragCoord) {
    ivec2 p = ivec2(fragCoord), x = ivec2(1, 0), y = ivec2(0, 1);
    mat3 around;
    for (int i = 0; i < 9; i++) around[i % 3][i / 3] = lumaAt(p + ivec2(i % 3 - 1, i / 3 - 1));
    float middle = around[1][1], left = around[0][1], right = around[2][1], below = around[1][0], over = around[1][2];
    float most = max(middle, max(max(left, right), max(below, over)));
    float range = most - min(middle, min(min(left, right), min(below, over)));
    field = texel(iChannel0, p);
    if (range < max(DARK, CONTRAST * most)) return;

    // What is thinner than a pixel stands out from the mean of all neighbours.
    float corners = around[0][0] + around[0][2] + around[2][0] + around[2][2];
    float mean = (2.0 * (left + right + below + over) + corners) / 12.0;
    float stands = smoothstep(0.0, 1.0, abs(mean - middle) / range);
    float thin = SUBPIXEL * stands * stands;

    // Second differences down the three columns and along the three rows.
    vec3 ends = vec3(1.0, -2.0, 1.0), weights = vec3(1.0, 2.0, 1.0);
    float down = dot(weights, abs(ends * around)), along = dot(weights, abs(around * ends));
    bool isLevel = down >= along;
    ivec2 across = isLevel ? y : x, line = isLevel ? x : y;
    float before = isLevel ? below : left, after = isLevel ? over : right;
    if (abs(before - middle) >= abs(after - middle)) across = -across;
    float other = abs(before - middle) >= abs(after - middle) ? before : after;

    // Between the two rows of pixels, until the mean of both is another one.
    float edge = 0.5 * (middle + other), enough = 0.25 * abs(other - middle);
    vec2 far = vec2(float(REACH)), change = vec2(0.0);
    for (int side = 0; side < 2; side++) {
        for (int i = 1; i <= REACH; i++) {
            ivec2 q = p + (2 * side - 1) * i * line;
            change[side] = 0.5 * (lumaAt(q) + lumaAt(q + across)) - edge;
            if (abs(change[side]) >= enough) {
                far[side] = float(i);
                break;
            }
        }
    }
    int nearer = far.x < far.y ? 0 : 1;
    bool isInside = (change[nearer] < 0.0) != (middle - edge < 0.0);
    float shift = isInside ? 0.5 - far[nearer] / (far.x + far.y) : 0.0;
    field = mix(field, texel(iChannel0, p + across), max(shift, thin));
}
#endif
