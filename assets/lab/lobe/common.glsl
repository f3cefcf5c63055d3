// METHOD: MIRROR reads once, PLAIN reads level 0 in drawn directions, FILTERED the level that a direction's share covers.
#define MIRROR 0
#define PLAIN 1
#define FILTERED 2
#ifndef METHOD
#define METHOD FILTERED
#endif

#iUniform int samples = 16
#iUniform float alpha = 0.16
#iUniform bool even = false          // a sky that is 1 everywhere

const float PI = 3.14159265;
const float SIDE = 1024.0;
