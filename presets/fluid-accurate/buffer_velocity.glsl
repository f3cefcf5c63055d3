// The velocity without its divergence, u - grad q, in xy; the pressure times the step in z, the step in w.
// Channel 0 is the velocity that the pressure of the last step has pushed, channel 1 the finest grid's q, channel 2
// this buffer, channel 3 the pace. q is what the pressure has changed by since.

// How much of q goes into the pressure that the next step begins with. With 2 it is the pressure at the end of the step
// and rings; with 1 it is that in its middle, and what changes is damped. Carried by a velocity that makes nothing
// longer, |u|^2 +
// |grad p|^2 / (2 GAIN) never grows for a GAIN up to 2, however long the step is.
const float PRESSURE_GAIN = 1.5;

// A project that studies the method may define INITIAL_VELOCITY(at) in Common, `at` in cells: a velocity without
// divergence.
#ifdef INITIAL_VELOCITY
#include "staggered.glsl"
#endif

float at(ivec2 p, ivec2 size) {
    if (walls == PERIODIC) p = ivec2(p.x < 0 ? p.x + size.x : p.x, p.y < 0 ? p.y + size.y : p.y);
    return texelFetch(iChannel1, max(p, ivec2(0)), 0).x;
}

void mainImage(out vec4 velocity, in vec2 fragCoord) {
    ivec2 p = ivec2(fragCoord), size = textureSize(iChannel1, 0);
    vec2 u = texelFetch(iChannel0, p, 0).xy;
    float q = at(p, size);
    u -= q - vec2(at(p - ivec2(1, 0), size), at(p - ivec2(0, 1), size));
    vec4 before = texelFetch(iChannel2, p, 0);
    float step = stepNow(iChannel3);
    // The mean of a pressure means nothing. What is taken here keeps it from wandering off.
    float pressure = 0.9999 * stepRatio(before.w, step) * before.z;
    velocity = vec4(u, (isFinite(vec4(pressure)) ? pressure : 0.0) + PRESSURE_GAIN * q, step);
#ifdef INITIAL_VELOCITY
    if (iFrame == 0) velocity = vec4(INITIAL_VELOCITY(faceAt(p, 0)).x, INITIAL_VELOCITY(faceAt(p, 1)).y, 0.0, 0.0);
#endif
    if (!isFinite(velocity)) velocity = vec4(0.0);
}
