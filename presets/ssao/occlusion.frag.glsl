// The part of the kernel that is hidden. Channel 0 has the world's normals, channel 1 its positions and depths, channel
// 2 the kernels, channel 3 how far behind the camera's plane the nearest back of a thing is.

#iUniform float radius = 0.6 in { 0.02, 2.0 } // of the hemisphere, in units of the scene
#iUniform float bias = 0.01 in { 0.0, 0.1 }   // nearer than this to a sample, or to the surface itself, nothing hides
#iUniform int samples = 64 in { 1, 64 }

// 0: along rays of the hemisphere, four samples each; from the first that is inside of something on the ray is blocked.
// 1: points of the hemisphere, each for itself: a ray that goes through a thing and out again is open behind it. 2:
// points of the whole sphere, with a hard radius and no thickness, as in Mittring 2007: half of them lie below an open
// plane, so only what is hidden beyond that half counts, twice.
#iUniform int method = 0 in { 0, 2 }

out float occluded;

// From the camera to texels. A perspective needs no more of the matrix than these.
ivec2 texelOf(vec3 point) {
    vec2 scale = 0.5 * iResolution.xy * fit(iResolution.xy) * vec2(iProjection[0][0], iProjection[1][1]);
    return ivec2(floor(0.5 * iResolution.xy - scale * point.xy / point.z));
}

bool isOutside(ivec2 q) {
    return any(lessThan(q, ivec2(0))) || any(greaterThanEqual(q, ivec2(iResolution.xy)));
}

// Whether a point is inside of what the camera sees there: between its front and its back. What is on the surface's own
// plane does not hide it, at however low an angle that is seen. `point` is as the camera sees it, the surface in the
// world.
bool isInside(vec3 point, vec3 surface, vec3 normal) {
    if (point.z > -1e-3) return false;
    ivec2 q = texelOf(point);
    if (isOutside(q)) return false;
    vec4 there = texelFetch(iChannel1, q, 0);
    if (there.w == 0.0 || -there.w < point.z + bias || dot(there.xyz - surface, normal) < bias) return false;
    float back = texelFetch(iChannel3, q, 0).x; // 0 where there is none: the room has no other side
    return back == 0.0 || back > -there.w || point.z > back;
}

void main() {
    ivec2 p = ivec2(gl_FragCoord.xy);
    vec4 surface = texelFetch(iChannel1, p, 0);
    occluded = 0.0;
    if (surface.w == 0.0) return;
    vec3 worldNormal = normalize(texelFetch(iChannel0, p, 0).xyz);
    vec3 here = (iView * vec4(surface.xyz, 1.0)).xyz, normal = normalize(mat3(iView) * worldNormal);

    // A frame about the normal (J. Frisvad 2012, without its pole: T. Duff et al., "Building an Orthonormal Basis,
    // Revisited", JCGT 6, 2017), turned by one of 16 angles. Neighbours in the square of 4 x 4 texels are far apart in
    // angle.
    float s = normal.z >= 0.0 ? 1.0 : -1.0, a = -1.0 / (s + normal.z), b = normal.x * normal.y * a;
    vec3 t0 = vec3(1.0 + s * normal.x * normal.x * a, s * b, -s * normal.x);
    vec3 b0 = vec3(b, s + normal.y * normal.y * a, -normal.y);
    vec2 turn = texelFetch(iChannel2, ivec2((p.x & 3) * 4 + ((p.y + 2 * p.x) & 3), 1), 0).xy;
    mat3 frame = radius * mat3(turn.x * t0 + turn.y * b0, turn.x * b0 - turn.y * t0, normal);

    // The kernels' lengths run through them in no order, so that any beginning of one is a smaller kernel.
    float sum = 0.0;
    if (method == 0) {
        int rays = max(samples / 4, 1);
        for (int i = 0; i < rays; i++) {
            for (int j = 0; j < 4; j++) {
                vec3 point = here + frame * texelFetch(iChannel2, ivec2((i * 5 & 15) * 4 + j, 3), 0).xyz;
                if (!isInside(point, surface.xyz, worldNormal)) continue;
                sum += float(4 - j);
                break;
            }
        }
        occluded = sum / float(4 * rays);
        return;
    }
    for (int i = 0; i < samples; i++) {
        vec3 point = here + frame * texelFetch(iChannel2, ivec2(i * 37 & 63, method == 1 ? 0 : 2), 0).xyz;
        if (method == 1) {
            sum += isInside(point, surface.xyz, worldNormal) ? 1.0 : 0.0;
        } else if (point.z < -1e-3 && !isOutside(texelOf(point))) {
            vec4 there = texelFetch(iChannel1, texelOf(point), 0);
            sum += there.w > 0.0 && -there.w > point.z && surface.w - there.w < radius ? 1.0 : 0.0;
        }
    }
    occluded = sum / float(max(samples, 1));
    if (method == 2) occluded = max(2.0 * occluded - 1.0, 0.0);
}
