#define EULER 0
#define SEMI_IMPLICIT 1
#define VERLET 2
#define RUNGE_KUTTA 3
#ifndef METHOD
#define METHOD VERLET
#endif
// A flight: a constant pull down and a drag that grows with the velocity. An orbit: an inverse-square pull to the origin.
#define FLIGHT 0
#define ORBIT 1
#ifndef SCENE
#define SCENE FLIGHT
#endif
#iUniform float dt = 0.0166667 in { 0.0, 1.0 }
#iUniform float gravity = 0.45 in { 0.0, 2.0 }
#iUniform float drag = 0.15 in { 0.0, 4.0 }

vec2 pull(vec2 at) {
#if SCENE == ORBIT
    return -at / pow(dot(at, at), 1.5);
#else
    return vec2(0.0, -gravity);
#endif
}

float friction() {
#if SCENE == ORBIT
    return 0.0;
#else
    return drag;
#endif
}

vec2 acceleration(vec2 at, vec2 v) {
    return pull(at) - friction() * v;
}
