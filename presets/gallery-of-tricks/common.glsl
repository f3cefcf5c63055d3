// Four small tricks of multipass shaders: below each one at work, above it what happens without.
//
//   data region     State fits into a few texels. A pass may draw the whole buffer and discard the rest, or be given a
//   region
//                   in eddy.toml; the region costs nothing elsewhere. Without: a picture drawn once, in frame 0, and
//                   kept by discard. A buffer is two textures in turn, so every other frame shows the one it was never
//                   drawn in.
//   soft boundary   Waves that run into a layer in which they die do not come back. Without: a hard wall, and a box
//   that
//                   rings for ever.
//   progressive     Each texel knows by itself how much of it is done, and does the next part each frame: no frame is
//   long,
//                   and texels that are new (after a resize, or erased) make up for it. Without: `iFrame == 0`.
//   tiny noise      A balance that nothing disturbs is kept for ever, stable or not; noise of 1/1000 finds out.
//   Without: zeros.
//
// Everything starts again every `restart` frames.

#iUniform int restart = 900 in { 120, 3600 }

bool isFinite(vec4 q) {
    return all(lessThan(floatBitsToUint(q) & uvec4(0x7f800000u), uvec4(0x7f800000u)));
}

float hash(vec2 p) {
    vec3 q = fract(vec3(p.xyx) * 0.1031);
    q += dot(q, q.yzx + 33.33);
    return fract((q.x + q.y) * q.z);
}

float noise(vec2 p) {
    vec2 i = floor(p), f = p - i;
    f = f * f * (3.0 - 2.0 * f);
    return mix(mix(hash(i), hash(i + vec2(1.0, 0.0)), f.x), mix(hash(i + vec2(0.0, 1.0)), hash(i + 1.0), f.x), f.y);
}

// ----------------------------------------------------------------------------------------------------- data region

const int BALLS = 24; // in texels (0, 0) to (23, 0): place and velocity in a box of size 1

// One ball a frame of 1/60 s later.
vec4 ballStep(vec4 ball, int i, bool first) {
    if (first || !isFinite(ball)) {
        float k = float(i);
        return vec4(0.15 + 0.7 * hash(vec2(k, 1.0)), 0.35 + 0.55 * hash(vec2(k, 2.0)),
                    0.012 * (hash(vec2(k, 3.0)) - 0.5), 0.0);
    }
    ball.w -= 2.2e-4;
    ball.xy += ball.zw;
    const float R = 0.045;
    if (ball.x < R || ball.x > 1.0 - R) ball.z = ball.x < R ? abs(ball.z) : -abs(ball.z);
    if (ball.y < R) ball.w = abs(ball.w);
    ball.xy = clamp(ball.xy, R, 1.0 - R);
    return ball;
}
