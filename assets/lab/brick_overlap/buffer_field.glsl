void mainImage(out vec4 state, in vec2 fragCoord) {
    ivec2 p = ivec2(fragCoord);
    vec4 ball = texelFetch(iChannel0, ivec2(0), 0);
    vec2 at = ball.xy + ball.zw, v = ball.zw;
    if (at.x < LOW.x || at.x > HIGH.x) v.x = -v.x;
    if (at.y < LOW.y || at.y > HIGH.y) v.y = -v.y;
    at = clamp(at, LOW, HIGH);
    ivec2 broken = ivec2(-1);
    for (int r = 0; r < BRICKS.y && broken.x < 0; r++) {
        for (int c = 0; c < BRICKS.x && broken.x < 0; c++) {
            vec2 depth = HALF - abs(at - centreOf(c, r));
            if (texelFetch(iChannel0, ivec2(c, 1 + r), 0).x < 0.5 || min(depth.x, depth.y) <= 0.0) continue;
            // The side that it is less deep behind is where it came in.
            if (depth.x < depth.y) v.x = -v.x;
            else v.y = -v.y;
            broken = ivec2(c, 1 + r);
        }
    }
    state = p == ivec2(0) ? vec4(at, v) : p == broken ? vec4(0.0) : texelFetch(iChannel0, p, 0);
}
