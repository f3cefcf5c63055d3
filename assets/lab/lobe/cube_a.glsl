// A sky that brightens upwards, and a small sun: exp(-400 (1 - cos)) is half as bright 3.4 degrees from its middle.
void mainCubemap(out vec4 fragColor, in vec2 fragCoord, in vec3 rayOri, in vec3 rayDir) {
    vec3 sun = normalize(vec3(0.4, 0.5, 0.75));
    float light = 0.4 + 0.3 * rayDir.y + 8.0 * exp(400.0 * (dot(rayDir, sun) - 1.0));
    fragColor = vec4(even ? 1.0 : light);
}
