void mainImage(out vec4 source, in vec2 fragCoord) {
    vec2 q = fragCoord - 0.5 * iResolution.xy;
    q = mat2(0.92, 0.39, -0.39, 0.92) * q;
    source = vec4(vec3(step(max(abs(q.x), abs(q.y)), 0.3 * iResolution.y)), 1.0);
}
