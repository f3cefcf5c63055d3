// What the pressure of the last step takes from a velocity in this one: its gradient on the faces. PRESSURE is the
// texture of the velocity, where z is the pressure times the step and w the step; PACE that of the pace.

vec2 pressurePush(ivec2 p) {
    ivec2 size = textureSize(PRESSURE, 0);
    vec4 here = texelFetch(PRESSURE, p, 0);
    ivec2 l = p - ivec2(1, 0), d = p - ivec2(0, 1);
    if (walls == PERIODIC) {
        if (l.x < 0) l.x += size.x;
        if (d.y < 0) d.y += size.y;
    }
    vec2 push = here.z - vec2(texelFetch(PRESSURE, max(l, ivec2(0)), 0).z, texelFetch(PRESSURE, max(d, ivec2(0)), 0).z);
    push *= stepRatio(here.w, stepNow(PACE));
    return isFinite(vec4(push, 0.0, 0.0)) ? push : vec2(0.0);
}
