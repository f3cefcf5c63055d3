// One component of a staggered field and its second differences, from which cubicAt() interpolates: itself, along x,
// along y, and along y of that along x. Channel 0 is the field. The text that includes this says which component: AXIS.
#include "staggered.glsl"

void mainImage(out vec4 curves, in vec2 fragCoord) {
    ivec2 p = ivec2(fragCoord), size = textureSize(iChannel0, 0);
    vec3 before, here, after; // columns; in each the row below, this one, and the row above
    Image l = imageX(p.x - 1, size.x, AXIS), r = imageX(p.x + 1, size.x, AXIS);
    for (int j = 0; j < 3; j++) {
        Image y = imageY(p.y + j - 1, size.y, AXIS);
        before[j] = l.sign * (y.lid + y.sign * texelFetch(iChannel0, ivec2(l.at, y.at), 0)[AXIS]);
        here[j] = y.lid + y.sign * texelFetch(iChannel0, ivec2(p.x, y.at), 0)[AXIS];
        after[j] = r.sign * (y.lid + y.sign * texelFetch(iChannel0, ivec2(r.at, y.at), 0)[AXIS]);
    }
    vec3 bend = (before - here) + (after - here);
    curves = vec4(here.y, bend.y, (here.x - here.y) + (here.z - here.y), (bend.x - bend.y) + (bend.z - bend.y));
    bool wall = walls != PERIODIC && (AXIS == 0 ? p.x : p.y) == 0;
    if (wall || !isFinite(curves)) curves = vec4(0.0);
}
