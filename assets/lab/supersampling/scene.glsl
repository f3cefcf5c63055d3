// A Siemens star and a hairline, which rest, and a disc before them, which moves by DISC_SPEED pixels a frame if MOVES is
// 1. Places are in pixels from the canvas's middle, where the canvas is 192 high; alpha is 2 on the disc.

#ifndef MOVES
#define MOVES 0
#endif
#ifndef DISC_SPEED
#define DISC_SPEED 2.37
#endif

vec2 discAt(float frame) {
    return vec2(-60.0 + DISC_SPEED * frame, -20.0);
}

vec4 scene(vec2 q, float frame) {
    vec2 d = q - discAt(frame);
    if (MOVES == 1 && dot(d, d) < 400.0) return vec4(0.95, 0.90, 0.80, 2.0);
    bool isRay = mod(floor(72.0 / 3.14159265 * atan(q.y, q.x)), 2.0) < 1.0 && dot(q, q) < 8100.0;
    bool isHair = abs(q.y - 0.3 * q.x - 82.56) < 0.5 * sqrt(1.0 + 0.3 * 0.3);
    return vec4(vec3(isRay || isHair ? 0.64 : 0.36), 0.0);
}
