/*{
    "ISFVSN": "2",
    "PASSES": [
        {"TARGET": "a", "PERSISTENT": true, "FLOAT": true}, {"TARGET": "b", "PERSISTENT": true, "FLOAT": true},
        {"TARGET": "c", "PERSISTENT": true, "FLOAT": true}, {"TARGET": "d", "PERSISTENT": true, "FLOAT": true},
        {"TARGET": "e", "PERSISTENT": true, "FLOAT": true}, {"TARGET": "f", "PERSISTENT": true, "FLOAT": true},
        {}
    ]
}*/
// A line of delays: each target takes what the one before it had in the last frame.
void main() {
    vec4 fresh = vec4(float(FRAMEINDEX) / 16.0, isf_FragNormCoord.x, 0.5, 1.0);
    if (PASSINDEX == 0) gl_FragColor = IMG_THIS_PIXEL(b);
    else if (PASSINDEX == 1) gl_FragColor = IMG_THIS_PIXEL(c);
    else if (PASSINDEX == 2) gl_FragColor = IMG_THIS_PIXEL(d);
    else if (PASSINDEX == 3) gl_FragColor = IMG_THIS_PIXEL(e);
    else if (PASSINDEX == 4) gl_FragColor = IMG_THIS_PIXEL(f);
    else if (PASSINDEX == 5) gl_FragColor = fresh;
    else gl_FragColor = isf_FragNormCoord.y < 0.5 ? IMG_THIS_PIXEL(a) : IMG_THIS_PIXEL(e) * 0.5 + IMG_THIS_PIXEL(f) * 0.5;
}
