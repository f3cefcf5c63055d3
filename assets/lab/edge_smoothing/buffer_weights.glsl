// SMAA, section 4.3: an edge is followed to both of its ends. What crosses it there says how the outline goes on, and the area
// between the outline and the edge is what each of the two pixels has of the other's colour. (The patterns of section 3 for
// corners and diagonals are left out.)

vec2 edgesAt(ivec2 p) {
    ivec2 size = textureSize(iChannel0, 0);
    if (any(lessThan(p, ivec2(0))) || any(greaterThanEqual(p, size))) return vec2(0.0);
    return texelFetch(iChannel0, p, 0).xy;
}

// The edge along `along` on the side of p that is towards -across: 1 or 0.
float edge(ivec2 p, ivec2 across) {
    vec2 edges = edgesAt(p);
    return across.x != 0 ? edges.x : edges.y;
}

// Follows the edge of p in a direction. Pixels to its end, and how high the outline is there: half a pixel towards what
// crosses it.
vec2 end(ivec2 p, ivec2 along, ivec2 across) {
    // The texel that has an edge across, at the end of a pixel, is the one towards positive coordinates.
    ivec2 ahead = max(along, ivec2(0)), axis = abs(along);
    for (int i = 0; i < REACH; i++) {
        ivec2 q = p + i * along;
        float above = edge(q + ahead, axis), below = edge(q + ahead - across, axis);
        if (above + below > 0.0) return vec2(float(i), 0.5 * (above - below));
        if (edge(q + along, across) == 0.0) return vec2(float(i), 0.0);
    }
    return vec2(float(REACH), 0.0);
}

// The mean over a width of what of a straight line from one height to another is above 0.
float above(float from, float to, float width) {
    if (from >= 0.0 && to >= 0.0) return 0.5 * (from + to) * width;
    float top = max(max(from, to), 0.0);
    return 0.5 * top * top / max(abs(from - to), 1e-6) * width;
}

vec2 sides(float from, float to, float width) {
    return vec2(above(from, to, width), above(-from, -to, width));
}

// The areas above and below an edge of this length, over its pixel that begins at `start`.
vec2 areas(float start, float length, vec2 heights) {
    float stop = start + 1.0, middle = 0.5 * length;
    if (heights.x * heights.y < 0.0) {
        return sides(mix(heights.x, heights.y, start / length), mix(heights.x, heights.y, stop / length), 1.0);
    }
    // The outline meets the edge in its middle.
    vec2 sum = vec2(0.0);
    if (start < middle) {
        float to = min(stop, middle);
        sum += sides(heights.x * (1.0 - start / middle), heights.x * (1.0 - to / middle), to - start);
    }
    if (stop > middle) {
        float from = max(start, middle);
        sum += sides(heights.y * (from / middle - 1.0), heights.y * (stop / middle - 1.0), stop - from);
    }
    return sum;
}

vec2 weightsOf(ivec2 p, ivec2 along, ivec2 across) {
    if (edge(p, across) == 0.0) return vec2(0.0);
    vec2 back = end(p, -along, across), ahead = end(p, along, across);
    return areas(back.x, back.x + ahead.x + 1.0, vec2(back.y, ahead.y));
}

void mainImage(out vec4 weights, in vec2 fragCoord) {
    ivec2 p = ivec2(fragCoord);
    weights = vec4(weightsOf(p, ivec2(1, 0), ivec2(0, 1)), weightsOf(p, ivec2(0, 1), ivec2(1, 0)));
}
