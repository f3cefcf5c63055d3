// Tools of C and C++ look for such a file in folders of their own.
#include <lib/noise.glsl>
void mainImage(out vec4 fragColor, in vec2 fragCoord) { fragColor = vec4(noise(fragCoord)); }
