// The icon before a chequered ground, so that its edge is seen.
void mainImage(out vec4 fragColor, in vec2 fragCoord) {
    vec4 icon = texelFetch(iChannel0, ivec2(fragCoord), 0);
    vec2 cell = floor(fragCoord / 16.0);
    float ground = mod(cell.x + cell.y, 2.0) < 0.5 ? 0.55 : 0.65;
    fragColor = vec4(mix(vec3(ground), icon.rgb, icon.a), 1.0);
}
