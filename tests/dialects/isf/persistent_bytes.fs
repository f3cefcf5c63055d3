/*{
    "ISFVSN": "2",
    "PASSES": [{"TARGET": "kept", "PERSISTENT": true}, {}]
}*/
// A buffer without FLOAT has 8 bits: 0.7 of a step is rounded to a whole one, 0.3 is lost, and it ends at 0 and 1.
void main() {
    vec4 before = IMG_THIS_PIXEL(kept);
    if (PASSINDEX == 0) {
        if (FRAMEINDEX == 0) before = vec4(0.0);
        float part = isf_FragNormCoord.x < 0.5 ? 0.7 : 0.3;
        gl_FragColor = vec4(before.r + part / 255.0, before.g + 0.3 * isf_FragNormCoord.x, before.b > 0.5 ? before.b - 0.75 : 1.5, 1.0);
    } else {
        gl_FragColor = vec4(before.r * 30.0, before.g, before.b, 1.0);
    }
}
