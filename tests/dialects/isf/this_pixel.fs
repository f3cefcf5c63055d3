/*{
    "ISFVSN": "2",
    "IMPORTED": {"picture": {"PATH": "data/odd.png"}},
    "PASSES": [{"TARGET": "first", "WIDTH": "$WIDTH/2", "HEIGHT": "$HEIGHT/2"}, {}]
}*/
void main() {
    if (PASSINDEX == 0) gl_FragColor = IMG_THIS_PIXEL(picture);
    else gl_FragColor = vec4(IMG_THIS_NORM_PIXEL(first).rg, IMG_THIS_PIXEL(picture).b, 1.0);
}
