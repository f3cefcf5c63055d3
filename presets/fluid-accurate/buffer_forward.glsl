// The first step of MacCormack: every face gets what was upstream, in xy. In zw the other component of the velocity at each of
// the two faces, which the second step needs again. Channel 0 is the drift, channel 1 what is carried.
#include "staggered.glsl"

float carriedTo(vec2 at, vec2 here, int axis, float cells) {
    return cubicAt(iChannel1, path(iChannel0, at, here, cells), axis);
}

void mainImage(out vec4 forward, in vec2 fragCoord) {
    ivec2 p = ivec2(fragCoord);
    float cells = speed * iTimeDelta * iChannelResolution[0].y;
    vec2 own = texelFetch(iChannel0, p, 0).xy, left = faceAt(p, 0), bottom = faceAt(p, 1);
    vec2 other = vec2(cubicAt(iChannel0, left, 1), cubicAt(iChannel0, bottom, 0));
    vec2 moved = vec2(carriedTo(left, vec2(own.x, other.x), 0, cells), carriedTo(bottom, vec2(other.y, own.y), 1, cells));
    if (walls != PERIODIC) moved *= vec2(greaterThan(p, ivec2(0)));
    forward = vec4(moved, other);
}
