// ETD2 of Cox and Matthews, Exponential Time Differencing for Stiff Systems, Journal of Computational Physics 176 (2002),
// equation 6. The first step has no step before and is of the first order.

// The waves of two real fields a and b, from those of a + i b.
void unpack(vec2 here, vec2 mirrored, out vec2 a, out vec2 b) {
    vec2 conjugate = vec2(mirrored.x, -mirrored.y), d = 0.5 * (here - conjugate);
    a = 0.5 * (here + conjugate);
    b = vec2(d.y, -d.x);
}

void mainImage(out vec4 next, in vec2 fragCoord) {
    ivec2 size = ivec2(iResolution.xy), place = ivec2(fragCoord), mirror = (size - place) % size;
    vec4 here = texelFetch(iChannel0, place, 0), there = texelFetch(iChannel0, mirror, 0);
    vec4 before = texelFetch(iChannel1, place, 0), beforeThere = texelFetch(iChannel1, mirror, 0);
    if (before.z == 0.0) {
        before.xy = here.zw;
        beforeThere.xy = there.zw;
    }
    vec2 u, v, nu, nv, ou, ov;
    unpack(here.xy, there.xy, u, v);
    unpack(here.zw, there.zw, nu, nv);
    unpack(before.xy, beforeThere.xy, ou, ov);

    // Waves beyond half the texels are those that go the other way.
    vec2 wave = vec2(place - size * ivec2(greaterThan(2 * place, size))) / vec2(size) * 6.28318530718;
    vec2 z = -DIFFUSION * dot(wave, wave) * dt, decay = exp(z), one = dt * phi1(z), two = dt * phi2(z);
    u = decay.x * u + one.x * nu + two.x * (nu - ou);
    v = decay.y * v + one.y * nv + two.y * (nv - ov);
    // A transform and its inverse multiply by the number of texels.
    next = vec4(vec2(u.x - v.y, u.y + v.x) / float(size.x * size.y), 0.0, 1.0);
}
