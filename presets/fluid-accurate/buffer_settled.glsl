// The other half of the step's viscosity, along y. Channel 0 is the advected velocity, channel 1 the pace.
#include "heat.glsl"

void mainImage(out vec4 velocity, in vec2 fragCoord) {
    float amount = viscosityHere(0.5 * stepNow(iChannel1), iChannelResolution[0].y);
    velocity = vec4(spreadAlong(iChannel0, ivec2(fragCoord), ivec2(0, 1), amount), 0.0, 0.0);
}
