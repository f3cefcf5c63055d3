// The part of the kernel that is hidden. Channel 0 has the world's normals, channel 1 positions as the camera sees them,
// channel 2 the kernel.

#iUniform float radius = 0.6 in { 0.02, 2.0 } // of the hemisphere, in units of the scene
#iUniform float bias = 0.01 in { 0.0, 0.1 }   // nearer than this to a sample, or to the surface itself, nothing hides
#iUniform int samples = 64 in { 1, 64 }

out float occluded;

void main() {
    ivec2 p = ivec2(gl_FragCoord.xy), size = ivec2(iResolution.xy);
    vec4 here = texelFetch(iChannel1, p, 0);
    occluded = 0.0;
    if (here.w == 0.0) return;
    vec3 normal = normalize(mat3(iView) * texelFetch(iChannel0, p, 0).xyz);

    // A frame about the normal (J. Frisvad 2012, without its pole: T. Duff et al., "Building an Orthonormal Basis, Revisited",
    // JCGT 6, 2017), turned by one of 16 angles. Neighbours in the square of 4 x 4 texels are far apart in angle.
    float s = normal.z >= 0.0 ? 1.0 : -1.0, a = -1.0 / (s + normal.z), b = normal.x * normal.y * a;
    vec3 t0 = vec3(1.0 + s * normal.x * normal.x * a, s * b, -s * normal.x);
    vec3 b0 = vec3(b, s + normal.y * normal.y * a, -normal.y);
    vec2 turn = texelFetch(iChannel2, ivec2((p.x & 3) * 4 + ((p.y + 2 * p.x) & 3), 1), 0).xy;
    mat3 frame = radius * mat3(turn.x * t0 + turn.y * b0, turn.x * b0 - turn.y * t0, normal);

    // From the camera to texels. A perspective needs no more of the matrix than these.
    vec2 scale = 0.5 * iResolution.xy * fit(iResolution.xy) * vec2(iProjection[0][0], iProjection[1][1]);
    vec2 centre = 0.5 * iResolution.xy;
    float sum = 0.0;
    for (int i = 0; i < samples; i++) {
        // The kernel's lengths run through it in no order, so that any beginning of it is a smaller kernel.
        vec3 point = here.xyz + frame * texelFetch(iChannel2, ivec2(i * 37 & 63, 0), 0).xyz;
        if (point.z > -1e-3) continue;
        ivec2 q = ivec2(floor(centre - scale * point.xy / point.z));
        if (any(lessThan(q, ivec2(0))) || any(greaterThanEqual(q, size))) continue;
        vec4 there = texelFetch(iChannel1, q, 0);
        if (there.w == 0.0 || there.z < point.z + bias) continue;
        // What is on the surface's own plane does not hide it, at however low an angle that is seen. And what is farther away
        // in depth than the radius is another thing, with air between: it fades, and is gone at twice the radius.
        if (dot(there.xyz - here.xyz, normal) < bias) continue;
        sum += 1.0 - smoothstep(1.0, 2.0, abs(here.z - there.z) / radius);
    }
    occluded = sum / float(max(samples, 1));
}
