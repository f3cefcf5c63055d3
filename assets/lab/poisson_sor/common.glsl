// Best is 2 / (1 + sqrt(1 - r^2)), where r = cos^2(pi / N) is the factor of Jacobi's iteration for the slowest wave of a torus.
#iUniform float relaxation = 1.9 in { 1.0, 2.0 }
#include "solved.glsl"
