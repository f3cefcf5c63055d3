void mainImage(out vec4 color, in vec2 at) {
    float scale = iChannelResolution[0].y / 180.;
    vec4 sum = vec4(0);
    for (int i = -RADIUS; i <= RADIUS; i++) {
        float x = float(i) / float(RADIUS);
        sum += exp(-4. * x * x) * vec4(texture(iChannel0, (at + vec2(24. * x * scale, 0)) / iResolution.xy).rgb, 1);
    }
    color = sum / sum.w;
}
