// As coloured.glsl with red first, beginning with p = 0: f of iChannel0. On 2 x 2 texels this is the solution, but for a
// constant.
#ifndef F
#define F x
#endif

float source(ivec2 p) {
    ivec2 size = ivec2(iResolution.xy);
    return texelFetch(iChannel0, (p + size) % size, 0).F;
}

void mainImage(out vec4 swept, in vec2 fragCoord) {
    ivec2 p = ivec2(fragCoord);
    float f = source(p), red = -0.25 * f;
    float beside = source(p + ivec2(1, 0)) + source(p - ivec2(1, 0)) + source(p + ivec2(0, 1)) + source(p - ivec2(0, 1));
    swept = vec4(((p.x + p.y) & 1) == 0 ? red : 0.25 * (-0.25 * beside - f), f, 0.0, 1.0);
}
