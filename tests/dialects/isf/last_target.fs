/*{
    "ISFVSN": "2",
    "PASSES": [{"TARGET": "kept", "PERSISTENT": true, "FLOAT": true}]
}*/
// A last pass with a target is shown, and kept for the next frame.
void main() {
    vec4 before = FRAMEINDEX == 0 ? vec4(0.0) : IMG_THIS_PIXEL(kept);
    gl_FragColor = vec4(before.r + 0.1 * isf_FragNormCoord.x, before.g + 0.05, isf_FragNormCoord.y, 1.0);
}
