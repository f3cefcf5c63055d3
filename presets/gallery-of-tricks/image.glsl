// Eight panels in two rows: each column is a trick. The upper row shows what breaks without it, the lower row the trick
// at work. The left half of each buffer holds the state of the upper panel, the right half that of the lower one.
//
//   column  panel     channel
//   0       data      0: the balls drawn by a pass that discards; 1: their state in a region
//   1       water     2: the height of the waves in x
//   2       sky       3: the sum of the cloud's octaves so far in x, their number in w
//   3       pattern   2: the pattern in z

const vec2 PANELS = vec2(4.0, 2.0);
const float TAU = 6.2832;

// Blends three colours along t from 0 to 1.
vec3 ramp(float t, vec3 low, vec3 middle, vec3 high) {
    if (t < 0.5) return mix(low, middle, smoothstep(0.0, 0.5, t));
    return mix(middle, high, smoothstep(0.5, 1.0, t));
}

// Where a place of a panel lies in the buffer: in its left half above, in its right half below.
vec2 half_of_buffer(vec2 uv, bool works) {
    return vec2(0.5 * uv.x + (works ? 0.5 : 0.0), uv.y);
}

// The same, at least a texel from the buffer's edges: the linear filter must not reach into the other half.
vec2 half_of_buffer_inside(vec2 uv, bool works, vec2 texel) {
    return half_of_buffer(clamp(uv, texel, 1.0 - texel), works);
}

// How much of a pixel a shape covers, whose edge is `distance` away (positive inside).
float coverage(float distance, float pixel) {
    return clamp(distance / pixel + 0.5, 0.0, 1.0);
}

// -------------------------------------------------------------------------------------------------- data region

const float DISC_RADIUS = 0.036;
const float RING_RADIUS = 0.042;

// A picture that was drawn once and kept by discard: it flickers, since only one of the buffer's two textures has it.
vec3 kept_by_discard(vec2 uv) {
    // The first row of texels is the balls' state and no picture.
    float above_state = 1.5 / float(textureSize(iChannel0, 0).y);
    vec2 kept = texture(iChannel0, vec2(0.5 * uv.x, max(uv.y, above_state))).xy;
    return vec3(0.05, 0.05, 0.07) + kept.x * vec3(0.85, 0.20, 0.10) + kept.y * vec3(0.35, 0.10, 0.05);
}

// A disc for each ball of the region, a ring for each of the pass that discards. They lie on each other, since both
// passes compute the same state.
vec3 balls(vec2 uv, float pixel) {
    vec2 trail = texture(iChannel0, vec2(0.5 + 0.5 * uv.x, max(uv.y, 0.04))).xy;
    vec3 light = vec3(0.035, 0.050, 0.060) + trail.x * vec3(0.02, 0.09, 0.09);
    for (int i = 0; i < BALLS; i++) {
        vec2 in_region = texelFetch(iChannel1, ivec2(i, 0), 0).xy;
        vec2 by_discard = texelFetch(iChannel0, ivec2(i, 0), 0).xy;
        float hue = float(i) / float(BALLS) * 0.35 + 0.45;
        vec3 colour = 0.5 + 0.45 * cos(TAU * (hue + vec3(0.0, 0.33, 0.67)));
        light = mix(light, colour, coverage(DISC_RADIUS - length(uv - in_region), pixel));
        light += 0.5 * clamp(1.0 - abs(length(uv - by_discard) - RING_RADIUS) / pixel, 0.0, 1.0);
    }
    return light;
}

vec3 data(vec2 uv, bool works, float pixel) {
    return works ? balls(uv, pixel) : kept_by_discard(uv);
}

// ------------------------------------------------------------------------------------------------ soft boundary

// Waves coloured by their height, with a highlight where their slope mirrors the light.
vec3 water(vec2 uv, bool works) {
    vec2 texel = 1.0 / vec2(textureSize(iChannel2, 0));
    vec2 right = vec2(texel.x, 0.0), up = vec2(0.0, texel.y);
    // Slopes reach a texel further; a panel is half as many texels wide as the buffer.
    vec2 at = half_of_buffer_inside(uv, works, vec2(3.0, 1.5) * texel);
    float height = texture(iChannel2, at).x;
    vec2 slope = vec2(texture(iChannel2, at + right).x - texture(iChannel2, at - right).x,
                      texture(iChannel2, at + up).x - texture(iChannel2, at - up).x);
    vec3 normal = normalize(vec3(-14.0 * slope, 1.0));
    vec3 halfway = normalize(vec3(-0.4, 0.5, 1.1));
    float highlight = pow(max(dot(normal, halfway), 0.0), 40.0);
    float depth = clamp(0.5 + 2.5 * height, 0.0, 1.0);
    vec3 body = ramp(depth, vec3(0.010, 0.035, 0.075), vec3(0.020, 0.100, 0.150), vec3(0.10, 0.32, 0.36));
    return body + 0.5 * highlight * vec3(0.8, 0.95, 1.0);
}

// -------------------------------------------------------------------------------------------------- progressive

// Clouds, darker where fewer of their eight octaves are done.
vec3 sky(vec2 uv, bool works) {
    vec2 texel = 1.0 / vec2(textureSize(iChannel3, 0));
    vec4 progress = texture(iChannel3, half_of_buffer_inside(uv, works, texel));
    float density = progress.x, done = clamp(progress.w / 8.0, 0.0, 1.0);
    vec3 blue = mix(vec3(0.16, 0.36, 0.62), vec3(0.05, 0.15, 0.38), uv.y);
    vec3 cloud = vec3(0.92, 0.90, 0.88) * (0.65 + 0.5 * density);
    vec3 light = mix(blue, cloud, smoothstep(0.46, 0.72, density));
    return mix(vec3(0.006), light, done);
}

// --------------------------------------------------------------------------------------------------- tiny noise

vec3 pattern(vec2 uv, bool works) {
    vec2 texel = 1.0 / vec2(textureSize(iChannel2, 0));
    float value = texture(iChannel2, half_of_buffer_inside(uv, works, texel)).z;
    return ramp(0.5 + 0.62 * value, vec3(0.17, 0.03, 0.13), vec3(0.50, 0.20, 0.16), vec3(0.98, 0.78, 0.42));
}

// -------------------------------------------------------------------------------------------------- the picture

float distance_to_segment(vec2 p, vec2 from, vec2 to) {
    vec2 along = to - from;
    return length(p - from - along * clamp(dot(p - from, along) / dot(along, along), 0.0, 1.0));
}

// A tick where the trick works, else a cross, of two strokes each; the middle is at 0.
float mark(vec2 p, bool works, float pixel) {
    const float HALF_WIDTH = 0.11;
    vec2 first_from = works ? vec2(-0.5, 0.0) : vec2(-0.4, -0.4), first_to = works ? vec2(-0.15, -0.4) : vec2(0.4, 0.4);
    vec2 second_from = works ? vec2(0.5, 0.45) : vec2(-0.4, 0.4), second_to = works ? first_to : vec2(0.4, -0.4);
    float first = distance_to_segment(p, first_from, first_to);
    float second = distance_to_segment(p, second_from, second_to);
    return coverage(HALF_WIDTH - min(first, second), pixel);
}

vec3 panel(int column, vec2 uv, bool works, float pixel) {
    if (column == 0) return data(uv, works, pixel);
    if (column == 1) return water(uv, works);
    if (column == 2) return sky(uv, works);
    return pattern(uv, works);
}

void mainImage(out vec4 fragColor, in vec2 fragCoord) {
    vec2 panels = fragCoord / iResolution.xy * PANELS;
    int column = int(panels.x);
    bool works = int(panels.y) == 0;

    // From the middle of the panel, in pixels. What is left of it inside the gaps between panels is the picture.
    vec2 size = iResolution.xy / PANELS;
    vec2 p = (fract(panels) - 0.5) * size;
    float gap = max(0.012 * iResolution.y, 0.5);
    vec2 inner = max(size - 2.0 * gap, 1.0);
    vec3 light = panel(column, clamp(p / inner + 0.5, 0.0, 1.0), works, 1.0 / inner.y);

    // The mark stands on a dark disc in the upper right corner.
    float corner = 0.10 * min(size.x, size.y);
    float radius = 0.55 * corner;
    vec2 from_mark = (p - 0.5 * inner + 0.9 * corner) / radius;
    float disc = clamp((1.05 - length(from_mark)) * radius + 0.5, 0.0, 1.0);
    vec3 mark_colour = works ? vec3(0.45, 0.95, 0.50) : vec3(1.00, 0.32, 0.28);
    light = mix(light, vec3(0.01), disc * 0.8);
    light = mix(light, mark_colour, mark(from_mark, works, 1.0 / max(radius, 1.0)));

    vec2 beyond = abs(p) - 0.5 * inner;
    light = mix(light, vec3(0.012, 0.013, 0.018), clamp(max(beyond.x, beyond.y) + 0.5, 0.0, 1.0));
    fragColor = vec4(sqrt(max(light, 0.0)), 1.0); // gamma 2
}
