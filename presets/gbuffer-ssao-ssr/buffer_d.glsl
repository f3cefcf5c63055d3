// Reflections: xy where in the picture (0 to 1) the mirrored ray meets something, z how much that is to be believed.
// Channel 0 is the G-buffer.
//
// Method: M. McGuire, M. Mara, "Efficient GPU Screen-Space Ray Tracing", JCGT 3(4), 2014: the ray is followed in the
// picture, where its inverse depth is a straight line, until it is behind what the G-buffer has there; then halved to
// the place. Strides are short at first: beside a thing's foot its mirror image begins within a pixel.

#iUniform int strides = 24 in { 4, 128 }

const float REACH = 7.0; // of a reflected ray, in units of the scene

void mainImage(out vec4 hit, in vec2 fragCoord) {
    ivec2 size = ivec2(iResolution.xy);
    vec4 g = texelFetch(iChannel0, ivec2(fragCoord), 0);
    hit = vec4(0.0);
    if (isNothing(g) || int(g.w) != TABLE_MATERIAL) return;
    vec3 at = viewFromPixel(fragCoord, g.z, iResolution.xy), normal = unpackNormal(g.xy);
    vec3 ray = reflect(normalize(at), normal);
    // Not through the plane of the camera, and no further than the picture goes.
    float reach = ray.z > 0.0 ? min(REACH, 0.95 * (at.z + 1e-3) / -ray.z) : REACH;
    vec3 end = at + max(reach, 0.0) * ray;
    vec2 from = fragCoord, to = pixelFromView(end, iResolution.xy);
    vec2 inside = max((iResolution.xy - from) / max(to - from, 1e-4), 0.0);
    vec2 below = max(from / max(from - to, 1e-4), 0.0);
    float most = min(min(min(inside.x, inside.y), min(below.x, below.y)), 1.0);
    float k0 = 1.0 / g.z, k1 = 1.0 / max(-end.z, 1e-4);

    float dither = fract(52.9829189 * fract(dot(fragCoord, vec2(0.06711056, 0.00583715)))); // J. Jimenez, SIGGRAPH 2014
    float before = 0.0, found = -1.0, least = 1.0 / max(length(to - from), 1.0); // a pixel
    for (int i = 0; i < strides; i++) {
        float part = (float(i) + 0.25 + 0.75 * dither) / float(strides);
        float t = max(most * part * sqrt(part), min(least * float(i + 1), most));
        vec2 q = mix(from, to, t);
        ivec2 texel = clamp(ivec2(q), ivec2(0), size - 1);
        float scene = texelFetch(iChannel0, texel, 0).z, depth = 1.0 / mix(k0, k1, t);
        float tolerance = thickness + max(depth - 1.0 / mix(k0, k1, before), 0.0);
        // What lies on the mirror's own plane is the mirror.
        float above = dot(viewFromPixel(vec2(texel) + 0.5, scene, iResolution.xy) - at, normal);
        if (above > 1e-3 * g.z && depth > scene && depth < scene + tolerance) {
            found = t;
            break;
        }
        before = t;
    }
    if (found < 0.0) return;
    for (int i = 0; i < 7; i++) {
        float t = 0.5 * (before + found);
        vec2 q = mix(from, to, t);
        ivec2 texel = clamp(ivec2(q), ivec2(0), size - 1);
        float scene = texelFetch(iChannel0, texel, 0).z;
        float above = dot(viewFromPixel(vec2(texel) + 0.5, scene, iResolution.xy) - at, normal);
        if (above > 1e-3 * g.z && 1.0 / mix(k0, k1, t) > scene) found = t;
        else before = t;
    }
    vec2 uv = mix(from, to, found) / iResolution.xy;
    vec4 there = texelFetch(iChannel0, clamp(ivec2(uv * iResolution.xy), ivec2(0), size - 1), 0);
    float front = smoothstep(0.05, -0.15, dot(unpackNormal(there.xy), ray)); // the back of a thing cannot be known
    vec2 edge = smoothstep(vec2(0.0), vec2(0.06), uv) * smoothstep(vec2(0.0), vec2(0.06), 1.0 - uv);
    hit = vec4(uv, isNothing(there) ? 0.0 : front * edge.x * edge.y * (1.0 - smoothstep(0.7, 1.0, found)), 1.0);
}
