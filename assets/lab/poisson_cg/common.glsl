// Conjugate gradients for lap p = f with h = 1 on a torus (Saad, Iterative Methods for Sparse Linear Systems, algorithms 6.18
// and 9.1), in the form of Chronopoulos and Gear (1989), which needs one reduction an iteration. lap is negative definite
// on fields of mean 0, as -lap is positive: only the signs of alpha and gamma differ from the books'.
//
// A texel of the field is (p, what is left of f, direction, lap of the direction).

// The component that holds u, the preconditioned rest, in the pass that is read for it: without a preconditioner the rest.
#ifndef U
#define U y
#endif

float u_at(sampler2D field, ivec2 p) {
    ivec2 size = textureSize(field, 0);
    return texelFetch(field, (p + size) % size, 0).U;
}

// Differences first: of a long wave the sum of four neighbours has few digits that differ from four times the middle.
float laplacian(sampler2D field, ivec2 p) {
    float c = u_at(field, p);
    float x = (u_at(field, p + ivec2(1, 0)) - c) + (u_at(field, p - ivec2(1, 0)) - c);
    float y = (u_at(field, p + ivec2(0, 1)) - c) + (u_at(field, p - ivec2(0, 1)) - c);
    return x + y;
}
