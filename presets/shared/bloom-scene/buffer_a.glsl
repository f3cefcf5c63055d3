// The picture, in linear light without limit.

#include "scene.glsl"

void mainImage(out vec4 light, in vec2 fragCoord) {
    float unit = min(iResolution.y, 0.62 * iResolution.x); // all of the scene is seen on a narrow canvas too
    light = vec4(scene((fragCoord - 0.5 * iResolution.xy) / unit, 1.0 / unit, iTime), 1.0);
}
