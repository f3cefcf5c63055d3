// Velocity (xy) that swirls: carried by itself, and pushed by a jet that turns.
void mainImage(out vec4 color, in vec2 at) {
    vec2 size = iResolution.xy, v = texture(iChannel0, at / size).xy;
    v = .999 * texture(iChannel0, (at - v) / size).xy;
    vec4 p = vec4(texture(iChannel1, (at + vec2(1, 0)) / size).x, texture(iChannel1, (at - vec2(1, 0)) / size).x,
                  texture(iChannel1, (at + vec2(0, 1)) / size).x, texture(iChannel1, (at - vec2(0, 1)) / size).x);
    v -= .5 * (p.xz - p.yw);
    vec2 away = (at - .5 * size) / size.y;
    v += .2 * exp(-80. * dot(away, away)) * vec2(cos(2. * iTime), sin(2. * iTime));
    color = vec4(v, 0, 1);
}
