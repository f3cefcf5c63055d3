// The history, and this frame in it. Channel 0 is Buffer A, channel 1 this buffer in the last frame. Alpha is 1 + the time of
// that frame (0: there was none), so that what is drawn in a pause is not taken for having moved.

#iUniform float gamma = 0.75 in { 0.25, 4.0 }  // half the width of the clamp's box, in sigma; 4 lets nearly everything pass
#iUniform float blend = 0.1 in { 0.02, 1.0 }   // weight of the new frame
#iUniform bool motionVectors = true
#iUniform bool catmullRom = true               // false: the history is looked up by a linear filter

bool isFinite(vec4 q) {
    return all(lessThan(floatBitsToUint(q) & uvec4(0x7f800000u), uvec4(0x7f800000u)));
}

// H. Malvar, G. Sullivan, "YCoCg-R", JVT-I014, 2003: the lossy form, whose coefficients are powers of two.
vec3 toYCoCg(vec3 c) {
    return vec3(0.25 * c.r + 0.5 * c.g + 0.25 * c.b, 0.5 * c.r - 0.5 * c.b, -0.25 * c.r + 0.5 * c.g - 0.25 * c.b);
}

vec3 fromYCoCg(vec3 c) {
    return vec3(c.x + c.y - c.z, c.x + c.z, c.x - c.y - c.z);
}

// Catmull-Rom by nine linear fetches instead of sixteen: the two middle texels of an axis share one.
vec3 historyAt(vec2 at) {
    if (!catmullRom) return textureLod(iChannel1, at / iResolution.xy, 0.0).rgb;
    vec2 middle = floor(at - 0.5) + 0.5, f = at - middle;
    vec2 w0 = f * (-0.5 + f * (1.0 - 0.5 * f));
    vec2 w1 = 1.0 + f * f * (-2.5 + 1.5 * f);
    vec2 w3 = f * f * (-0.5 + 0.5 * f);
    vec2 w12 = 1.0 - w0 - w3;
    vec2 weight[3] = vec2[3](w0, w12, w3);
    vec2 place[3] = vec2[3](middle - 1.0, middle + 1.0 - w1 / w12, middle + 2.0);
    vec3 sum = vec3(0.0);
    for (int y = 0; y < 3; y++) {
        for (int x = 0; x < 3; x++) {
            sum += weight[x].x * weight[y].y * textureLod(iChannel1, vec2(place[x].x, place[y].y) / iResolution.xy, 0.0).rgb;
        }
    }
    return sum;
}

void mainImage(out vec4 resolved, in vec2 fragCoord) {
    ivec2 p = ivec2(fragCoord), last = ivec2(iResolution.xy) - 1;
    vec4 now = texelFetch(iChannel0, p, 0);
    resolved = vec4(now.rgb, 1.0 + iTime);

    vec4 before = texelFetch(iChannel1, p, 0);
    if (iFrame == 0 || !isFinite(before) || before.a < 1.0) return; // no history here yet, or a broken one

    vec2 from = fragCoord;
    if (motionVectors) {
        int id = int(now.a + 0.5);
        vec2 here = (fragCoord - 0.5 * iResolution.xy) / unit(iResolution.xy);
        vec2 there = fromObject(id, toObject(id, here, speed * iTime), speed * (before.a - 1.0));
        from += (there - here) * unit(iResolution.xy);
    }
    if (any(lessThan(from, vec2(0.0))) || any(greaterThan(from, iResolution.xy))) return; // it came in over the edge

    vec3 mean = vec3(0.0), square = vec3(0.0);
    for (int y = -1; y <= 1; y++) {
        for (int x = -1; x <= 1; x++) {
            vec3 c = toYCoCg(texelFetch(iChannel0, clamp(p + ivec2(x, y), ivec2(0), last), 0).rgb);
            mean += c / 9.0;
            square += c * c / 9.0;
        }
    }
    vec3 reach = gamma * sqrt(max(square - mean * mean, 0.0));
    vec4 history = vec4(historyAt(from), 1.0);
    if (!isFinite(history)) return;
    vec3 held = fromYCoCg(clamp(toYCoCg(history.rgb), mean - reach, mean + reach));
    resolved.rgb = mix(held, now.rgb, blend);
}
