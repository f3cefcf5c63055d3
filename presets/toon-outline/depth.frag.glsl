// The hull's depth alone: what is drawn later leaves a gap around the mesh; none where the hull is of no width.

#include "clip.glsl"

#iUniform bool zOnly

in vec2 vPlace;
out vec4 nothing;

void main() {
    if (!zOnly || isClipped(vPlace)) discard;
    nothing = vec4(0.0);
}
