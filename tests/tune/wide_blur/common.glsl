#define RADIUS 24
