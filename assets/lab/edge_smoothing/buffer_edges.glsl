// Jimenez, Echevarria, Sousa and Gutierrez, SMAA: Enhanced Subpixel Morphological Antialiasing, Eurographics 2012, section 4.2:
// edges to the left and below, but for those beside one of twice the contrast.
const float THRESHOLD = 0.05;

void mainImage(out vec4 edges, in vec2 fragCoord) {
    ivec2 p = ivec2(fragCoord), x = ivec2(1, 0), y = ivec2(0, 1);
    float middle = luma(iChannel0, p), left = luma(iChannel0, p - x), below = luma(iChannel0, p - y);
    vec2 contrast = abs(middle - vec2(left, below));
    float other = max(abs(middle - luma(iChannel0, p + x)), abs(middle - luma(iChannel0, p + y)));
    other = max(other, max(abs(left - luma(iChannel0, p - 2 * x)), abs(below - luma(iChannel0, p - 2 * y))));
    float strongest = max(other, max(contrast.x, contrast.y));
    edges = vec4(step(max(vec2(THRESHOLD), 0.5 * strongest), contrast), 0.0, 0.0);
}
