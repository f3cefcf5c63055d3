// A convex shape of straight sides: inside of a rectangle of these halves about a centre, turned.
bool inside(vec2 q, vec2 centre, vec2 halves, float angle) {
    vec2 d = q - centre, axis = vec2(cos(angle), sin(angle));
    return abs(dot(d, axis)) < halves.x && abs(dot(d, vec2(-axis.y, axis.x))) < halves.y;
}

// Four pictures of side h, in pixels from the bottom left.
float scene(vec2 p, float h) {
    vec2 q = p - h * step(h, p);
    if (p.x < h && p.y < h) {
        bool is = inside(q, vec2(0.27, 0.5) * h, vec2(0.16 * h), 0.4) || inside(q, vec2(0.73, 0.5) * h, vec2(0.16 * h), 0.02);
        return float(is);
    }
    if (p.y < h) {
        float lines = 0.0;
        for (int i = 0; i < 8; i++) {
            float angle = 0.05 + 0.7853981633974483 * float(i);
            vec2 centre = 0.5 * h + 0.29 * h * vec2(cos(angle), sin(angle));
            lines += float(inside(q, centre, vec2(0.18 * h, 0.2), angle));
        }
        return lines;
    }
    if (p.x < h) {
        float d = h - q.y;
        return 1.0 - mod(floor(3.0 * (q.x - 0.5 * h) / d) + floor(3.0 * h / d), 2.0);
    }
    return 0.5 + 0.5 * cos(3.141592653589793 / h * dot(q, q));
}
