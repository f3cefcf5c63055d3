// The velocity without its divergence: u - grad q. Channel 0 is the advected velocity, channel 1 the finest grid's q.

void mainImage(out vec4 velocity, in vec2 fragCoord) {
    ivec2 p = ivec2(fragCoord);
    vec2 u = texelFetch(iChannel0, p, 0).xy;
    float q = texelFetch(iChannel1, p, 0).x;
    if (p.x > 0) u.x -= q - texelFetch(iChannel1, p - ivec2(1, 0), 0).x;
    if (p.y > 0) u.y -= q - texelFetch(iChannel1, p - ivec2(0, 1), 0).x;
    velocity = isFinite(vec4(u, 0.0, 0.0)) ? vec4(u, 0.0, 0.0) : vec4(0.0);
}
