#define BOX 0
#define DUAL 1
#define TENT 2
#ifndef METHOD
#define METHOD DUAL
#endif

// A read beside the texel's centre, in texels of what is read.
vec4 at(sampler2D picture, vec2 uv, vec2 d) {
    return textureLod(picture, uv + d / vec2(textureSize(picture, 0)), 0.0);
}

#include "hash.glsl"
