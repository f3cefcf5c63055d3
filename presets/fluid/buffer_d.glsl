// Paint carried by the fluid: rgb its colour times its thickness, a the thickness.
// Channel 0 is this frame's Buffer C (velocity), channel 1 this buffer in the last frame.

// Paint that is thinner has no colour that could be told.
const float NO_PAINT = 1e-4;

vec4 paint(ivec2 p) {
    vec4 q = texelFetch(iChannel1, nearestCell(p, ivec2(iResolution.xy)), 0);
    return isFinite(q) ? q : vec4(0.0);
}

vec2 velocity(vec2 at) {
    ivec2 size = ivec2(iResolution.xy), i = ivec2(floor(at));
    vec2 f = at - vec2(i);
    return mix(mix(CELL(iChannel0, i, size).xy, CELL(iChannel0, i + ivec2(1, 0), size).xy, f.x),
               mix(CELL(iChannel0, i + ivec2(0, 1), size).xy, CELL(iChannel0, i + ivec2(1, 1), size).xy, f.x), f.y);
}

// Weights of the four texels around a point at fraction f between the middle two. R. Keys, "Cubic Convolution
// Interpolation for Digital Image Processing", IEEE ASSP 29(6), 1981, with a = -1/2.
vec4 cubic(float f) {
    float f2 = f * f, f3 = f2 * f;
    return 0.5 * vec4(-f + 2.0 * f2 - f3, 2.0 - 5.0 * f2 + 3.0 * f3, f + 4.0 * f2 - 3.0 * f3, f3 - f2);
}

// Bicubic keeps filaments sharp where bilinear would blur them away in seconds. The overshoot of the thickness is cut to
// the range of the four nearest texels, and that of the colour to the range of their colours: cut by themselves, the
// products of the two would give colours that were not there, some brighter than white.
vec4 paintAt(vec2 at) {
    ivec2 i = ivec2(floor(at));
    vec4 wx = cubic(at.x - float(i.x)), wy = cubic(at.y - float(i.y));
    vec4 sum = vec4(0.0);
    vec2 thick = vec2(1e9, -1e9);
    vec3 low = vec3(1e9), high = vec3(-1e9);
    for (int y = 0; y < 4; y++) {
        for (int x = 0; x < 4; x++) {
            vec4 q = paint(i + ivec2(x - 1, y - 1));
            sum += wx[x] * wy[y] * q;
            if (x == 1 || x == 2) {
                if (y == 1 || y == 2) {
                    thick = vec2(min(thick.x, q.a), max(thick.y, q.a));
                    if (q.a > NO_PAINT) {
                        low = min(low, q.rgb / q.a);
                        high = max(high, q.rgb / q.a);
                    }
                }
            }
        }
    }
    float thickness = clamp(sum.a, thick.x, thick.y);
    if (thick.y <= NO_PAINT) return vec4(0.0);
    return thickness * vec4(clamp(sum.rgb / max(sum.a, NO_PAINT), low, high), 1.0);
}

const int PIGMENTS = 5;
const vec3 PIGMENT[PIGMENTS] = vec3[PIGMENTS](vec3(0.90, 0.16, 0.10), vec3(0.98, 0.62, 0.10), vec3(0.05, 0.52, 0.50),
                                              vec3(0.10, 0.16, 0.62), vec3(0.78, 0.12, 0.42));

// The pigments in a ring, blending from one to the next as t runs through 0..1.
vec3 ink(float t) {
    float at = fract(t) * float(PIGMENTS);
    int i = int(at) % PIGMENTS;
    return mix(PIGMENT[i], PIGMENT[(i + 1) % PIGMENTS], smoothstep(0.55, 1.0, fract(at)));
}

void mainImage(out vec4 dye, in vec2 fragCoord) {
    ivec2 size = ivec2(iResolution.xy), p = ivec2(fragCoord);
    vec4 before = texelFetch(iChannel1, MOUSE, 0);
    if (p.y == 0) {
        dye = p == MOUSE ? rememberMouse(before, iMouse, iTimeDelta) : vec4(0.0);
        return;
    }

    // Midpoint rule: look half a frame upstream for the velocity that carries the paint here.
    float frame = SUBSTEPS * dt;
    vec2 middle = upstream(p, velocity(vec2(p)), 0.5 * frame, size);
    dye = paintAt(upstream(p, velocity(middle), frame, size));
    dye *= exp(-iTimeDelta / fade_seconds);

    for (int i = 0; i < EMITTERS; i++) {
        vec4 nozzle = emitter(i, iTime, iResolution.xy);
        float w = emitterWeight(fragCoord, nozzle, iResolution.xy) * idleness(before) * nozzles;
        vec3 colour = ink(0.04 * iTime + float(i) / float(EMITTERS));
        dye = mix(dye, vec4(colour, 1.0), 0.5 * w);
    }
    float w = brush(fragCoord, before, iMouse, 0.8 * brushRadius(iResolution.xy));
    dye = mix(dye, vec4(ink(0.11 * iTime), 1.0), 0.9 * w);
}
