void mainImage(out vec4 o, in vec2 p) {
    vec4 old = texelFetch(iChannel0, ivec2(p), 0);
    float d = length(p - iMouse.xy) / iResolution.y;
    o = old * 0.9 + vec4(0.3, 0.2, 0.1, 1.0) * smoothstep(0.3, 0.0, d);
}
