// The other half of the step's viscosity, along x, and of the push of the pressure: the velocity whose divergence is
// still to go. Channel 0 is Buffer settled, channel 1 the velocity of the last frame, which has the pressure,
// channel 2 the pace.
#include "heat.glsl"
#define PRESSURE iChannel1
#define PACE iChannel2
#include "pressure.glsl"

void mainImage(out vec4 velocity, in vec2 fragCoord) {
    ivec2 p = ivec2(fragCoord);
    float amount = viscosityHere(0.5 * stepNow(iChannel2), iChannelResolution[0].y);
    vec2 u = spreadAlong(iChannel0, p, ivec2(1, 0), amount) - 0.5 * pressurePush(p);
    velocity = isFinite(vec4(u, 0.0, 0.0)) ? vec4(u, 0.0, 0.0) : vec4(0.0);
}
