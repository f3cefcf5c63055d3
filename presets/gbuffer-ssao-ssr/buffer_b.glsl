// Ambient occlusion: the cosine-weighted part of the sky that is hidden. Channel 0 is the G-buffer.
//
// Method: J. Jimenez, X. Wu, A. Pesce, A. Jarabo, "Practical Realtime Strategies for Accurate Indirect Occlusion", SIGGRAPH
// 2016 courses ("GTAO"). The hemisphere is cut into slices through the line of sight; in each the two horizons are found
// by looking along the picture, and what lies between them is integrated in closed form. So the weighting is exact, and
// what is left is noise (few slices, few steps) and what no depth buffer knows: the far side of things.

#iUniform float radius = 0.8 in { 0.05, 4.0 } // how far away something may be to hide the sky, in units of the scene
#iUniform int slices = 2 in { 1, 8 }
#iUniform int steps = 3 in { 2, 16 }          // on either side of a slice

// The sine over a surface's plane below which a point counts as part of it: the rounding of depths to texels would else make a
// plane hide a little of its own sky. It is also what the walls of a corner lose: 2 degrees.
const float BIAS = 0.035;
const float HALF_PI = 1.57079633;

vec3 pointAt(ivec2 p) {
    return viewFromPixel(vec2(p) + 0.5, texelFetch(iChannel0, p, 0).z, iChannelResolution[0].xy);
}

void mainImage(out vec4 occluded, in vec2 fragCoord) {
    vec2 canvas = iChannelResolution[0].xy;
    ivec2 p = ivec2(fragCoord), size = ivec2(canvas), full = fullTexel(p, iResolution.xy, canvas);
    vec2 pixel = vec2(full) + 0.5;
    vec4 g = texelFetch(iChannel0, full, 0);
    occluded = vec4(0.0, 0.0, 0.0, 1.0);
    if (isNothing(g)) return;
    vec3 at = viewFromPixel(pixel, g.z, canvas), normal = unpackNormal(g.xy), view = normalize(-at);
    float pixels = min(radius * FOCAL * unit(canvas) / g.z, canvas.y);
    if (pixels < 2.0) return; // the radius is smaller than what a pixel shows

    // 16 directions and 4 distances in a square of 4 x 4 texels, each once: the blur of Buffer C sees them all.
    int turn = (p.x & 3) * 4 + ((p.y * 5 + (p.x & 3)) & 3), step_ = (p.x + 2 * p.y) & 3;
    // Two directions at right angles to the line of sight: slices are to be spread evenly around it, and not around the
    // camera's axis, or a plane at the picture's edge would not come out fully open.
    vec3 right = normalize(cross(vec3(0.0, 1.0, 0.0), view)), up = cross(view, right);
    float seen = 0.0;
    for (int i = 0; i < slices; i++) {
        float phi = 2.0 * HALF_PI * (float(i) + (float(turn) + 0.5) / 16.0) / float(slices);
        vec3 ahead = cos(phi) * right + sin(phi) * up, across = cross(ahead, view);
        vec2 along = normalize(at.xy * ahead.z - at.z * ahead.xy); // the slice, as a line in the picture
        vec3 inSlice = normal - across * dot(normal, across); // the normal as this slice sees it
        float share = length(inSlice);
        float n = sign(dot(ahead, inSlice)) * acos(clamp(dot(inSlice, view) / max(share, 1e-5), -1.0, 1.0));
        for (int side = -1; side <= 1; side += 2) {
            float low = cos(n + float(side) * HALF_PI), horizon = low;
            for (int j = 0; j < steps; j++) {
                float s = (float(j) + (float(step_) + 0.5) / 4.0) / float(steps);
                ivec2 q = ivec2(floor(pixel + float(side) * along * max(s * s * pixels, float(j) + 1.0)));
                if (any(lessThan(q, ivec2(0))) || any(greaterThanEqual(q, size))) break;
                vec3 delta = pointAt(q) - at;
                float far = max(length(delta), 1e-5);
                if (dot(delta, normal) < BIAS * far) continue;
                float weight = clamp((radius - far) / (0.4 * radius), 0.0, 1.0); // what is far hides less, then nothing
                horizon = max(horizon, mix(low, dot(delta, view) / far, weight));
            }
            float h = float(side) * acos(clamp(horizon, -1.0, 1.0));
            h = n + clamp(h - n, -HALF_PI, HALF_PI);
            seen += share * 0.25 * (cos(n) + 2.0 * h * sin(n) - cos(2.0 * h - n));
        }
    }
    occluded.r = 1.0 - seen / float(slices); // of one slice, below zero too: only the mean over all is a part of the sky
}
