// Floor and walls.

#include "gbuffer.glsl"

void main() {
    bool isFloor = normalize(vNormal).y > 0.5;
    write(isFloor ? vec3(0.70, 0.50, 0.32) : vec3(0.50, 0.60, 0.60), 0.0);
}
