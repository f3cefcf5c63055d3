// The hull's depth alone: what is drawn later leaves a gap around the mesh.

#include "clip.glsl"

#iUniform bool zOnly
#iUniform float outlineWidth

in vec2 vPlace;
out vec4 nothing;

void main() {
    if (!zOnly || outlineWidth <= 0.0 || isClipped(vPlace)) discard;
    nothing = vec4(0.0);
}
