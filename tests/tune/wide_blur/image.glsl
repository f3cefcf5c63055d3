void mainImage(out vec4 color, in vec2 at) {
    float scale = iResolution.y / 180.;
    vec4 sum = vec4(0);
    for (int i = -RADIUS; i <= RADIUS; i++) {
        float y = float(i) / float(RADIUS);
        sum += exp(-4. * y * y) * vec4(texture(iChannel0, (at + vec2(0, 24. * y * scale)) / iResolution.xy).rgb, 1);
    }
    color = sum / sum.w;
}
