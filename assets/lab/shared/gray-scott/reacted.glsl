// Half a step of the reaction by the midpoint rule, second order.
vec2 reacted(vec2 w) {
    float h = 0.5 * dt;
    return w + h * reaction(w + 0.5 * h * reaction(w));
}
