/*{
    "ISFVSN": "2",
    "PASSES": [{"TARGET": "first"}, {}, {"TARGET": "last", "FLOAT": true}]
}*/
// A pass without a target that is not the last is not shown. PASSINDEX counts it.
void main() {
    if (PASSINDEX == 0) gl_FragColor = vec4(isf_FragNormCoord, 0.25, 1.0);
    else if (PASSINDEX == 1) gl_FragColor = vec4(1.0);
    else gl_FragColor = vec4(IMG_THIS_PIXEL(first).rg * 0.5, float(PASSINDEX) / 4.0, 1.0);
}
