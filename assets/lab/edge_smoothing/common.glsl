#define FXAA 0
#define SMAA 1
#ifndef METHOD
#define METHOD SMAA
#endif
// An edge is followed for so many pixels to each side.
#ifndef REACH
#define REACH 32
#endif

// A texel, or the nearest one there is.
vec4 texel(sampler2D picture, ivec2 p) {
    return texelFetch(picture, clamp(p, ivec2(0), textureSize(picture, 0) - 1), 0);
}

float luma(sampler2D picture, ivec2 p) {
    return dot(texel(picture, p).rgb, vec3(0.2126, 0.7152, 0.0722));
}
