// Floor and walls.

#include "gbuffer.glsl"

void main() {
    bool isFloor = normalize(vNormal).y > 0.5;
    write(isFloor ? vec3(0.66, 0.50, 0.36) : vec3(0.60, 0.62, 0.58), 0.0);
}
