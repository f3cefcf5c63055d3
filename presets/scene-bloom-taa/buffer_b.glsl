// The history. Channel 0 is Buffer A, channel 1 this buffer in the last frame, channel 2 Buffer C, which remembers the
// last frame's distances and time. Alpha is the age: for how many frames nothing has come between this place and its
// history; 0 where there is none. What it does and why, the preset taa says; here the light has no limit, so the mean
// is taken of c / (1 + luminance): else one sample on a lamp's rim would outweigh a dozen beside it (B. Karis, SIGGRAPH
// 2014 courses).
//
// Against 64 samples a pixel, PSNR of that, 320 x 180, frame 60: 44.7 dB while the camera rests, 37.1 while it goes
// round, 35.9 at orbit = 1.

#iUniform float gamma = 1.0 in { 0.25, 4.0 }   // half the clamp's box, in sigma, where something has come or gone
#iUniform float relaxed = 2.5 in { 0.25, 8.0 } // the same where the history has proved true
#iUniform float blend = 0.1 in { 0.02, 1.0 }   // weight of the new frame

const float YOUNG = 8.0, OLD = 24.0; // ages between which the box grows from gamma to relaxed

vec3 compressed(vec3 c) {
    return c / (1.0 + dot(c, vec3(0.25, 0.5, 0.25)));
}

vec3 expanded(vec3 c) {
    return c / max(1.0 - dot(c, vec3(0.25, 0.5, 0.25)), 1e-3);
}

vec3 toYCoCg(vec3 c) {
    return vec3(0.25 * c.r + 0.5 * c.g + 0.25 * c.b, 0.5 * c.r - 0.5 * c.b, -0.25 * c.r + 0.5 * c.g - 0.25 * c.b);
}

vec3 fromYCoCg(vec3 c) {
    return vec3(c.x + c.y - c.z, c.x + c.z, c.x - c.y - c.z);
}

vec3 historyAt(vec2 at) {
    vec2 middle = floor(at - 0.5) + 0.5, f = at - middle;
    vec2 w0 = f * (-0.5 + f * (1.0 - 0.5 * f)), w1 = 1.0 + f * f * (-2.5 + 1.5 * f), w3 = f * f * (-0.5 + 0.5 * f);
    vec2 w12 = 1.0 - w0 - w3;
    vec2 weight[3] = vec2[3](w0, w12, w3), place[3] = vec2[3](middle - 1.0, middle + 1.0 - w1 / w12, middle + 2.0);
    vec3 sum = vec3(0.0);
    for (int y = 0; y < 3; y++) {
        for (int x = 0; x < 3; x++) {
            sum += weight[x].x * weight[y].y
                * textureLod(iChannel1, vec2(place[x].x, place[y].y) / iResolution.xy, 0.0).rgb;
        }
    }
    return max(sum, 0.0);
}

void mainImage(out vec4 resolved, in vec2 fragCoord) {
    ivec2 p = ivec2(fragCoord), last = ivec2(iResolution.xy) - 1;
    vec4 now = texelFetch(iChannel0, p, 0);
    resolved = vec4(now.rgb, 1.0);
    vec4 before = texelFetch(iChannel1, p, 0), memory = texelFetch(iChannel2, p, 0);
    if (iFrame == 0 || !isFinite(before) || before.a < 1.0 || memory.y < 1.0) return;

    vec3 mean = vec3(0.0), square = vec3(0.0);
    float far[9], t = 1e9; // of the nearest thing around: its edge moves with it
    for (int i = 0; i < 9; i++) {
        vec4 q = texelFetch(iChannel0, clamp(p + ivec2(i % 3 - 1, i / 3 - 1), ivec2(0), last), 0);
        vec3 c = toYCoCg(compressed(q.rgb));
        mean += c / 9.0;
        square += c * c / 9.0;
        far[i] = q.a;
        t = min(t, q.a);
    }
    // The mouse of the last frame is not known: while it turns the camera the clamp alone holds the history.
    Camera c = camera(iTime, iMouse, iResolution.xy), then = camera(memory.y - 1.0, iMouse, iResolution.xy);
    vec3 ray = rayThrough(c, fragCoord, iResolution.xy);
    vec2 from = pixelOf(then, c.from + t * ray, iResolution.xy), own = from - fragCoord;
    if (any(lessThan(from, vec2(0.0))) || any(greaterThan(from, iResolution.xy))) return;

    vec4 history = vec4(historyAt(from), 1.0);
    if (!isFinite(history)) return;

    // How differently what is around here moves, and what was there: pixels a frame.
    vec3 rayThen = rayThrough(then, from, iResolution.xy);
    float shear = 0.0;
    for (int i = 0; i < 9; i++) {
        float was = texelFetch(iChannel2, clamp(ivec2(from) + ivec2(i % 3 - 1, i / 3 - 1), ivec2(0), last), 0).x;
        vec2 here = pixelOf(then, c.from + far[i] * ray, iResolution.xy) - fragCoord;
        vec2 there = from - pixelOf(c, then.from + was * rayThen, iResolution.xy);
        shear = max(shear, max(length(here - own), length(there - own)));
    }
    float age = shear > 0.05 ? min(before.a, 3.0) : before.a, trust = smoothstep(YOUNG, OLD, age);
    vec3 old = toYCoCg(compressed(history.rgb));
    vec3 reach = mix(gamma, max(relaxed, gamma), trust) * sqrt(max(square - mean * mean, 0.0));
    vec3 held = clamp(old, mean - reach, mean + reach);
    if (length(old - held) > 0.1) age = 1.0; // something changed that no motion tells of
    float least = length(own) < 0.01 ? pow(blend, 1.0 + 0.4 * trust) : blend;
    vec3 mixed = mix(fromYCoCg(held), compressed(now.rgb), max(least, 1.0 / (age + 1.0)));
    resolved = vec4(max(expanded(mixed), 0.0), min(age + 1.0, 255.0));
}
