// Ages. Channel 0 is this buffer in the last frame.

void mainImage(out vec4 life, in vec2 fragCoord) {
    ivec2 p = ivec2(fragCoord);
    int n = p.y * SIDE + p.x;
    life = texelFetch(iChannel0, p, 0);
    float type = typeOf(n);
    float span = type == DUST ? 9.0 : type == SPARK ? 2.6 : 14.0;
    bool broken = !isFinite(life) || life.y <= 0.0 || life.z != type || life.w < 1.0;
    if (broken) {
        // At the start they are of all ages, or they would all die together.
        vec3 chance = hash(ivec3(n, 0, 7));
        float lasts = span * lifetime * (0.6 + 0.8 * chance.x);
        life = vec4(lasts * chance.y, lasts, type, 1.0);
        return;
    }
    life.x += max(speed * iTimeDelta, 0.0);
    if (life.x >= life.y) {
        float births = life.w + 1.0;
        life = vec4(0.0, span * lifetime * (0.6 + 0.8 * hash(ivec3(n, int(births), 7)).x), type, births);
    }
}
