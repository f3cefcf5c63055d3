void mainImage(out vec4 field, in vec2 fragCoord) {
    ivec2 here = ivec2(fragCoord), size = ivec2(iResolution.xy);
    vec4 w = texelFetch(iChannel0, here, 0), sums = texelFetch(iChannel3, ivec2(0), 0);
    vec2 means = sums.zw / float(size.x * size.y);
    float alpha = texelFetch(iChannel1, ivec2(0), 0).x, beta = texelFetch(iChannel1, ivec2(0), 0).y;
    float direction = u_at(iChannel2, here) - means.y + beta * w.z;
    float of_direction = laplacian(iChannel2, here) + beta * w.w;
    field = vec4(w.x + alpha * direction, w.y - means.x - alpha * of_direction, direction, of_direction);
}
