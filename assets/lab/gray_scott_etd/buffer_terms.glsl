// u + i v, and what the reaction does to both: two complex numbers, transformed together.
void mainImage(out vec4 terms, in vec2 fragCoord) {
    vec2 w = texelFetch(iChannel0, ivec2(fragCoord), 0).xy;
    terms = vec4(w, reaction(w));
}
