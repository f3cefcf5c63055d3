// Places and velocities. Channel 0 is this buffer in the last frame, channel 1 this frame's ages, channel 2 the mouse,
// channel 3 anything as large
// as the canvas.

const float DRAG = 0.15;   // of a spark, a second
const float FASTEST = 3.0; // heights a second

// Wind without sources: a stream function's gradient, turned (R. Bridson, J. Hourihan, M. Nordenstam, "Curl-Noise for
// Procedural Fluid Flow", SIGGRAPH 2007), here of a few waves.
vec2 windAt(vec2 at, float time) {
    vec2 sum = vec2(0.0);
    for (int i = 0; i < 4; i++) {
        float k = 3.0 + 2.3 * float(i), a = 2.4 * float(i) + 0.13 * time;
        vec2 wave = k * vec2(cos(a), sin(a));
        float phase = dot(wave, at) + 0.6 * time + 1.9 * float(i);
        sum += vec2(wave.y, -wave.x) / k * cos(phase) / (1.0 + 0.5 * float(i));
    }
    return wind * sum;
}

void mainImage(out vec4 motion, in vec2 fragCoord) {
    ivec2 p = ivec2(fragCoord);
    int n = p.y * SIDE + p.x;
    vec4 life = texelFetch(iChannel1, p, 0);
    motion = texelFetch(iChannel0, p, 0);
    vec4 mouse = texelFetch(iChannel2, ivec2(0), 0);
    // iResolution is this buffer's own 32 x 32; Buffer light is as large as the canvas.
    vec2 canvas = iChannelResolution[3].xy;
    float aspect = canvas.x / canvas.y;
    float seconds = clamp(speed * iTimeDelta, 0.0, 0.5);
    vec2 light = lamp(mouse, iTime, canvas);

    bool born = life.x == 0.0 || iFrame == 0 || !isFinite(motion);
    if (born) {
        vec3 chance = hash(ivec3(n, int(life.w), 1)), more = hash(ivec3(n, int(life.w), 2));
        vec2 anywhere = vec2(aspect * (chance.x - 0.5), mix(FLOOR, 0.5, chance.y));
        if (life.z == DUST) {
            motion = vec4(anywhere, 0.0, 0.0);
        } else if (life.z == SPARK) {
            // Two fountains, and the hand.
            float side = more.x < 0.5 ? -1.0 : 1.0;
            vec2 from = mouse.z > 0.0 ? light : vec2(0.27 * aspect * side, FLOOR + 0.005);
            float up = 1.5708 - side * 0.28 * sin(0.9 * iTime) + 0.35 * (chance.x + chance.y - 1.0);
            vec2 fling = (0.50 + 0.25 * more.y) * vec2(cos(up), sin(up));
            // At the start they are under way already, each as far as its age has it.
            float t = life.x;
            motion = vec4(from + t * fling - vec2(0.0, 0.5 * gravity * t * t), fling - vec2(0.0, gravity * t));
            motion.y = max(motion.y, FLOOR);
        } else {
            motion = vec4(anywhere * 0.9, 0.3 * (more.xy - 0.5));
        }
        return;
    }

    vec2 at = motion.xy, before = motion.zw, v = before, go = vec2(0.0);
    if (life.z == DUST) {
        v = mix(windAt(at, iTime), v, exp(-3.0 * seconds));
        if (mouse.z > 0.0) { // the hand parts the dust
            vec2 off = at - light;
            v += seconds * 3.0 * off / (dot(off, off) + 0.01) * exp(-dot(off, off) / 0.02);
        }
    } else if (life.z == SPARK) {
        // The trapezoidal rule for gravity and drag, and the place goes with the mean of both velocities: second
        // order. With the
        // new velocity alone a spark was 1.5 % of its way off after .8 s at 60 steps a second; it is 1e-5 now.
        float half_ = 0.5 * DRAG * seconds;
        v = ((1.0 - half_) * before - vec2(0.0, gravity * seconds)) / (1.0 + half_);
        go = 0.5 * (before + v);
    } else {
        // A spring to the lamp, some turning about it, some drag.
        vec2 to = light - at;
        float turn = n % 16 < 8 ? 1.0 : -1.0;
        v += seconds * (pull * to / (0.12 + length(to)) + turn * 0.8 * vec2(-to.y, to.x) / (0.1 + length(to))
                        + 2.0 * windAt(3.0 * at, 2.0 * iTime));
        v *= exp(-1.1 * seconds);
    }
    v *= min(1.0, FASTEST / max(length(v), 1e-6));
    if (life.z != SPARK) go = v;
    at += seconds * go;
    if (at.y < FLOOR) { // back above the floor by as much as it went below
        at.y = FLOOR + bounce * (FLOOR - at.y);
        v = vec2(0.8, -bounce) * v;
    }
    // Past the sides dust and moths come in at the other one.
    if (life.z != SPARK) at.x -= aspect * round(at.x / aspect);
    motion = vec4(at, v);
    if (!isFinite(motion)) motion = vec4(0.0);
}
