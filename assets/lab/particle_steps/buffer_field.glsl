// The derivative of (x, y, u, v).
vec4 rate(vec4 q) {
    return vec4(q.zw, acceleration(q.xy, q.zw));
}

void mainImage(out vec4 particle, in vec2 fragCoord) {
    vec4 q = texelFetch(iChannel0, ivec2(fragCoord), 0);
    vec2 at = q.xy, v = q.zw;
#if METHOD == EULER
    particle = q + dt * rate(q);
#elif METHOD == SEMI_IMPLICIT
    v += dt * acceleration(at, v);
    particle = vec4(at + dt * v, v);
#elif METHOD == VERLET
    // Half a kick, the drift, half a kick. The second takes the drag at its end, so that the step is its own mirror in time.
    v += 0.5 * dt * acceleration(at, v);
    at += dt * v;
    particle = vec4(at, (v + 0.5 * dt * pull(at)) / (1.0 + 0.5 * dt * friction()));
#else
    vec4 a = rate(q), b = rate(q + 0.5 * dt * a), c = rate(q + 0.5 * dt * b), d = rate(q + dt * c);
    particle = q + dt / 6.0 * (a + 2.0 * b + 2.0 * c + d);
#endif
}
