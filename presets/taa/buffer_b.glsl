// The history, and this frame in it. Channel 0 is Buffer A, channel 1 this buffer in the last frame, channel 2 Buffer
// C, which remembers the last frame's objects and time. Alpha is the age: for how many frames nothing has come between
// this place and its history, this frame counted in; 0 where there is none.

#iUniform float gamma = 0.75 in { 0.25, 4.0 }   // half the clamp's box, in sigma, where something moves or has moved
#iUniform float relaxed = 2.5 in { 0.25, 8.0 }  // the same where the history has proved true
#iUniform float blend = 0.1 in { 0.02, 1.0 }    // weight of the new frame
#iUniform bool motionVectors = true
#iUniform bool catmullRom = true                // false: the history is looked up by a linear filter

const float YOUNG = 8.0, OLD = 24.0; // ages between which the box grows from gamma to relaxed
const float PARTED = 0.05;           // pixels a frame by which things move differently

bool isFinite(vec4 q) {
    return all(lessThan(floatBitsToUint(q) & uvec4(0x7f800000u), uvec4(0x7f800000u)));
}

// H. Malvar, G. Sullivan, "YCoCg-R", JVT-I014, 2003: the lossy form, whose coefficients are powers of two.
vec3 toYCoCg(vec3 c) {
    return vec3(0.25 * c.r + 0.5 * c.g + 0.25 * c.b, 0.5 * c.r - 0.5 * c.b, -0.25 * c.r + 0.5 * c.g - 0.25 * c.b);
}

vec3 fromYCoCg(vec3 c) {
    return vec3(c.x + c.y - c.z, c.x + c.z, c.x - c.y - c.z);
}

// Catmull-Rom by nine linear fetches instead of sixteen: the two middle texels of an axis share one.
vec3 historyAt(vec2 at) {
    if (!catmullRom) return textureLod(iChannel1, at / iResolution.xy, 0.0).rgb;
    vec2 middle = floor(at - 0.5) + 0.5, f = at - middle;
    vec2 w0 = f * (-0.5 + f * (1.0 - 0.5 * f));
    vec2 w1 = 1.0 + f * f * (-2.5 + 1.5 * f);
    vec2 w3 = f * f * (-0.5 + 0.5 * f);
    vec2 w12 = 1.0 - w0 - w3;
    vec2 weight[3] = vec2[3](w0, w12, w3);
    vec2 place[3] = vec2[3](middle - 1.0, middle + 1.0 - w1 / w12, middle + 2.0);
    vec3 sum = vec3(0.0);
    for (int y = 0; y < 3; y++) {
        for (int x = 0; x < 3; x++) {
            sum += weight[x].x * weight[y].y
                * textureLod(iChannel1, vec2(place[x].x, place[y].y) / iResolution.xy, 0.0).rgb;
        }
    }
    return clamp(sum, 0.0, 1.0); // the filter overshoots, and a screen has no more than 1
}

// How an object moved between the last frame and this one, at a place, in pixels from now to then.
vec2 wayBack(int id, vec2 fragCoord, float then) {
    vec2 here = (fragCoord - 0.5 * iResolution.xy) / unit(iResolution.xy);
    return (fromObject(id, toObject(id, here, speed * iTime), speed * then) - here) * unit(iResolution.xy);
}

void mainImage(out vec4 resolved, in vec2 fragCoord) {
    ivec2 p = ivec2(fragCoord), last = ivec2(iResolution.xy) - 1;
    vec4 now = texelFetch(iChannel0, p, 0);
    resolved = vec4(now.rgb, 1.0);

    vec4 before = texelFetch(iChannel1, p, 0), memory = texelFetch(iChannel2, p, 0);
    // no history here yet, or a broken one
    if (iFrame == 0 || !isFinite(before) || before.a < 1.0 || memory.y < 1.0) return;

    vec2 ways[OBJECTS] = vec2[OBJECTS](vec2(0.0), vec2(0.0), vec2(0.0));
    for (int id = 0; id < OBJECTS && motionVectors; id++) ways[id] = wayBack(id, fragCoord, memory.y - 1.0);
    vec2 own = ways[int(now.a + 0.5)], from = fragCoord + own;
    if (any(lessThan(from, vec2(0.0))) || any(greaterThan(from, iResolution.xy))) return; // it came in over the edge

    vec3 mean = vec3(0.0), square = vec3(0.0);
    int others = 0; // texels of the history that moved differently from what is here
    float shear = 0.0; // how differently things around here move, and those that were there: pixels a frame
    for (int y = -1; y <= 1; y++) {
        for (int x = -1; x <= 1; x++) {
            vec4 q = texelFetch(iChannel0, clamp(p + ivec2(x, y), ivec2(0), last), 0);
            int was = int(texelFetch(iChannel2, clamp(ivec2(from) + ivec2(x, y), ivec2(0), last), 0).x + 0.5);
            float parts = length(ways[was] - own);
            if (parts > PARTED) others++;
            vec3 c = toYCoCg(q.rgb);
            mean += c / 9.0;
            square += c * c / 9.0;
            shear = max(shear, max(length(ways[int(q.a + 0.5)] - own), parts));
        }
    }
    // Most of what was there has gone elsewhere: this place was hidden, and has no history. The clamp alone would keep
    // of it what is within its box, for as long as that is wide.
    if (others > 4) return;
    vec4 history = vec4(historyAt(from), 1.0);
    if (!isFinite(history)) return;

    // Where things part the history may show what is not there any more. The clamp is narrow until it has had the time
    // to take that away; from then on it may be wide, for what it would take away now is detail.
    vec3 sigma = sqrt(max(square - mean * mean, 0.0)), old = toYCoCg(history.rgb);
    float age = shear > PARTED ? min(before.a, 3.0) : before.a,
        trust = motionVectors ? smoothstep(YOUNG, OLD, age) : 0.0;
    vec3 reach = mix(gamma, max(relaxed, gamma), trust) * sigma, held = clamp(old, mean - reach, mean + reach);
    // A history that is out of even this box was not true: something changed that no motion tells of.
    if (length(old - held) > 0.1) age = 1.0;
    // A young history is the plain mean of what there is; one that rests may have more samples than one that moves,
    // which is blurred a little in every frame.
    float least = length(own) < 0.01 ? pow(blend, 1.0 + 0.4 * trust) : blend;
    // Corners of the box, which is one of Y, Co and Cg, are no colours of a screen.
    vec3 kept = clamp(fromYCoCg(held), 0.0, 1.0);
    resolved.rgb = mix(kept, now.rgb, max(least, 1.0 / (age + 1.0)));
    resolved.a = min(age + 1.0, 255.0);
}
