// The flow, in units of V. Channel 0 is the paint of the last frame, repeating.

vec2 field(vec2 at) {
    return textureLod(iChannel0, at / iChannelResolution[0].xy, 0.0).xy;
}

void mainImage(out vec4 flow, in vec2 fragCoord) {
    const float STEP = 6.2831853 / float(ROT_NUM);
    const mat2 ROTATE = mat2(cos(STEP), sin(STEP), -sin(STEP), cos(STEP));
    vec2 canvas = iChannelResolution[0].xy;
    vec2 p = fragCoord * canvas / iResolution.xy;

    // The rings turn from frame to frame, and the next size by half a step against the last: no direction is preferred.
    float start = 2.399963 * float(iFrame & 1023);
    vec2 arm = vec2(cos(start), sin(start));
    vec2 sum = vec2(0.0);
    float radius = 2.0, weight = 1.0;
    for (int s = 0; s < MAX_SCALES; s++) {
        if (s >= scales || radius > REACH * canvas.y) break;
        vec2 towards = arm;
        for (int i = 0; i < ROT_NUM; i++) {
            vec2 centre = p + radius * towards;
            float turning = 0.0;
            vec2 spoke = arm;
            for (int j = 0; j < ROT_NUM; j++) {
                turning += dot(field(centre + radius * spoke), perp(spoke));
                spoke = ROTATE * spoke;
            }
            // `turning` is five times the radius times the angular velocity, and p lies at -radius * towards.
            sum -= weight * turning * perp(towards);
            towards = ROTATE * towards;
        }
        arm = vec2(arm.x * 0.809017 - arm.y * 0.587785, arm.x * 0.587785 + arm.y * 0.809017);
        radius *= growth;
        weight *= slope;
    }
    flow = vec4(sum / float(ROT_NUM * ROT_NUM), 0.0, 0.0);
    if (!isFinite(flow)) flow = vec4(0.0);
}
