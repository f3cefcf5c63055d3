#define NAIVE 0
#define BLEP 1
#define CLOSED 2
#define ADDITIVE 3
#ifndef METHOD
#define METHOD NAIVE
#endif

#iUniform int periods = 461          // in the whole field
#iUniform float setting = 1.0
