#define ROBERTS 0
#define SOBEL 1
#define LAPLACIAN 2
#ifndef METHOD
#define METHOD SOBEL
#endif
// At 1 a step of 2 % of the depth is a line, and a turn of the normal by 32 degrees.
#iUniform float sensitivity = 1.0 in { 0.0, 16.0 }
