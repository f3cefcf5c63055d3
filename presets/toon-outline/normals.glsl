// Normals baked in the tangent frame, as colours: the mesh's own (0, 0, 1), and for the cube those of a ball, so that
// its three normals at a corner become one.

void mainImage(out vec4 value, in vec2 fragCoord) {
    int page;
    vec2 uv = uvOfTexel(fragCoord, page);
    vec3 normal = page == 1 ? normalize(vec3(2.0 * uv - 1.0, 1.0)) : vec3(0.0, 0.0, 1.0);
    value = vec4(0.5 + 0.5 * normal, 1.0);
}
