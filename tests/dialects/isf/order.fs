/*{
    "ISFVSN": "2",
    "PASSES": [
        {"TARGET": "a", "PERSISTENT": true, "FLOAT": true},
        {"TARGET": "b", "PERSISTENT": true, "FLOAT": true},
        {}
    ]
}*/
// A pass reads its own target and those of later passes as the last frame left them, and earlier ones of this frame.
void main() {
    float now = float(FRAMEINDEX) / 16.0;
    vec4 first = IMG_THIS_PIXEL(a), second = IMG_THIS_PIXEL(b);
    if (FRAMEINDEX == 0 && PASSINDEX == 0) first = second = vec4(0.0);
    if (PASSINDEX == 0) gl_FragColor = vec4(now, first.x, second.x, 1.0);
    else if (PASSINDEX == 1) gl_FragColor = vec4(now, first.x, FRAMEINDEX == 0 ? 0.0 : second.x, 1.0);
    else gl_FragColor = vec4(isf_FragNormCoord.x < 0.5 ? first.xyz : second.xyz, 1.0);
}
