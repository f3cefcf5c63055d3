// The picture, in linear light without limit.

#include "scene.glsl"

void mainImage(out vec4 light, in vec2 fragCoord) {
    light = vec4(scene((fragCoord - 0.5 * iResolution.xy) / iResolution.y, 1.0 / iResolution.y, iTime), 1.0);
}
