// The trails: x, y and w of the pens that draw by themselves, z of the mouse. Channel 0 is this buffer as the last
// frame left it.

// How far p is from the segment a-b.
float segmentDistance(vec2 p, vec2 a, vec2 b) {
    vec2 along = b - a;
    return length(p - a - along * clamp(dot(p - a, along) / max(dot(along, along), 1e-6), 0.0, 1.0));
}

// Ink that a pen moving from a to b leaves at p. The profile is a Gaussian, so that age() grows with the square of the
// distance from the stroke: as a trail fades it also narrows, to a tip, like a comet's tail.
float stroke(vec2 p, vec2 a, vec2 b) {
    float d = segmentDistance(p, a, b) / (0.013 * iResolution.y);
    return INK * exp(-d * d);
}

// The pens go round on Lissajous figures that never close.
vec2 pen(float i, float time) {
    vec2 turn = vec2(2.3, 3.1 + 0.17) * time + vec2(2.1, 1.4) * i;
    vec2 reach = vec2(min(0.45 * iResolution.x, 0.78 * iResolution.y), min(0.42 * iResolution.y, 0.78 * iResolution.x));
    return 0.5 * iResolution.xy + reach * sin(turn) * (0.80 + 0.20 * sin(0.7 * time + 2.0 * i));
}

void mainImage(out vec4 trail, in vec2 fragCoord) {
    ivec2 p = ivec2(fragCoord);
    vec4 mouseBefore = texelFetch(iChannel0, MOUSE, 0);
    bool held = iMouse.z > 0.0;
    if (p == MOUSE) {
        trail = vec4(iMouse.xy, held ? 1.0 : 0.0, iResolution.y);
        return;
    }

    // Initialisation guard: on the first frame there is nothing to fade. After a resize the buffer keeps what fits, and
    // is zero elsewhere, which is no trail; only the remembered mouse is of another canvas then, and is not joined up.
    trail = iFrame == 0 ? vec4(0.0) : kept(iResolution.y) * texelFetch(iChannel0, p, 0);
    if (!isFinite(trail)) trail = vec4(0.0); // it would never fade
    bool drawing = held && iFrame > 0 && mouseBefore.z > 0.0 && mouseBefore.w == iResolution.y;

    // The larger of the two, not the sum: ink on ink is still ink, and the age stays right.
    if (held) {
        vec2 to = iMouse.xy + 0.5;
        trail.z = max(trail.z, stroke(fragCoord, drawing ? mouseBefore.xy + 0.5 : to, to));
    } else {
        float before = iTime - iTimeDelta;
        trail.x = max(trail.x, stroke(fragCoord, pen(0.0, before), pen(0.0, iTime)));
        trail.y = max(trail.y, stroke(fragCoord, pen(1.0, before), pen(1.0, iTime)));
        trail.w = max(trail.w, stroke(fragCoord, pen(2.0, before), pen(2.0, iTime)));
    }
}
