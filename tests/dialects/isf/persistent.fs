/*{
    "ISFVSN": "2",
    "PASSES": [{"TARGET": "sum", "PERSISTENT": true, "FLOAT": true}, {}]
}*/
// A buffer of floats counts beyond 1 and below 0.
void main() {
    vec4 before = IMG_THIS_PIXEL(sum);
    if (PASSINDEX == 0) {
        if (FRAMEINDEX == 0) before = vec4(0.0);
        gl_FragColor = before + vec4(0.4 * isf_FragNormCoord.x, 0.3, -0.25, 0.05);
    } else {
        gl_FragColor = vec4(before.x / 4.0, before.y / 4.0, -before.z / 2.0, 1.0);
        if (isf_FragNormCoord.y > 0.75) gl_FragColor = vec4(vec3(before.a), 1.0);
    }
}
