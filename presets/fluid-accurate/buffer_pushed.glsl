// The other half of the step's viscosity, along x, and of the push of the pressure: the velocity whose divergence is
// still to go. Channel 0 is Buffer settled, which is drawn only with viscosity, channel 1 the velocity of the last frame,
// which has the pressure, channel 2 the pace, channel 3 Buffer advected.
#include "heat.glsl"
#define PRESSURE iChannel1
#define PACE iChannel2
#include "pressure.glsl"

void mainImage(out vec4 velocity, in vec2 fragCoord) {
    ivec2 p = ivec2(fragCoord);
    vec2 u = texelFetch(iChannel3, p, 0).xy;
    if (viscosity > 0.0) {
        float amount = viscosityHere(0.5 * stepNow(iChannel2), iChannelResolution[0].y);
        u = spreadAlong(iChannel0, p, ivec2(1, 0), amount);
    }
    u -= 0.5 * pressurePush(p);
    velocity = isFinite(vec4(u, 0.0, 0.0)) ? vec4(u, 0.0, 0.0) : vec4(0.0);
}
