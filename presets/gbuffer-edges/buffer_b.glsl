// The lines: x by depth, y by normal, each 0 to 1. Channel 0 is the G-buffer.

#iUniform float depthSensitivity = 1.0 in { 0.0, 4.0 }  // at 1 a step of 2 % of the depth is half a line
#iUniform float normalSensitivity = 1.0 in { 0.0, 4.0 } // at 1 a crease of 32 degrees is half a line
#iUniform float thickness = 1.0 in { 1.0, 6.0 } step 1.0 // in texels, on a canvas up to 540 high; more on a higher one

struct Point {
    vec3 at, normal;
    float depth;
};

Point point(ivec2 p) {
    p = clamp(p, ivec2(0), ivec2(iResolution.xy) - 1);
    vec4 g = texelFetch(iChannel0, p, 0);
    return Point(viewFromPixel(vec2(p) + 0.5, g.z, iResolution.xy), unpackNormal(g.xy), g.z);
}

// Of one diagonal: the break in depth as a part of the depth, the turn of the normal as 1 - cos.
vec2 broken(Point a, Point b) {
    vec3 along = b.at - a.at;
    float off = min(abs(dot(along, a.normal)), abs(dot(along, b.normal)));
    // Two planes of unlike normals always have points off each other's plane; what is left once the distance across the
    // picture is taken away is a step.
    float step_ = max(off - length(along.xy), 0.0);
    return vec2(step_ / min(a.depth, b.depth), 1.0 - dot(a.normal, b.normal));
}

void mainImage(out vec4 lines, in vec2 fragCoord) {
    int wide = int(max(thickness * max(floor(iResolution.y / 540.0 + 0.5), 1.0), 1.0));
    ivec2 low = ivec2(fragCoord) - wide / 2, high = low + wide;
    vec2 first = broken(point(low), point(high));
    vec2 second = broken(point(ivec2(low.x, high.y)), point(ivec2(high.x, low.y)));
    vec2 cross_ = sqrt(first * first + second * second) * vec2(depthSensitivity / 0.02, normalSensitivity / 0.15);
    lines = vec4(smoothstep(0.4, 1.2, cross_), 0.0, 1.0);
}
