// Half of the step's viscosity along one direction, exactly on the grid: the heat kernel's weights e^(-2a) I_n(2a) by
// Miller's recurrence (Abramowitz and Stegun, 9.12), where a = viscosity t. The differences from the middle are summed, so
// that an even velocity stays as it is.
vec2 spreadAlong(sampler2D field, ivec2 p, ivec2 direction) {
    vec2 centre = at(field, p), sum = vec2(0.0);
    float a = 0.5 * dt * viscosity, further = 0.0, weight = 1e-30, total = 0.0;
    if (a < 1e-7) return centre;
    for (int n = int(ceil(5.0 * sqrt(2.0 * a))) + 3; n > 0; --n) {
        sum += weight * ((at(field, p - n * direction) - centre) + (at(field, p + n * direction) - centre));
        total += 2.0 * weight;
        float nearer = further + float(n) / a * weight;
        further = weight;
        weight = nearer;
    }
    return centre + sum / (total + weight);
}
