/*{
    "ISFVSN": "2",
    "PASSES": [
        {"TARGET": "third", "WIDTH": "floor($WIDTH/3.0)", "HEIGHT": "floor($HEIGHT/4.0)"},
        {}
    ]
}*/
// 32 / 3 and 18 / 4 are rounded down.
void main() {
    if (PASSINDEX == 0) gl_FragColor = vec4(RENDERSIZE / 16.0, 0.0, 1.0);
    else gl_FragColor = vec4(IMG_NORM_PIXEL(third, vec2(0.5)).rg, IMG_SIZE(third).x / 16.0, 1.0);
}
