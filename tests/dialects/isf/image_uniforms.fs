/*{
    "ISFVSN": "2",
    "IMPORTED": {"picture": {"PATH": "data/odd.png"}}
}*/
// The uniform with the size of an image, and the functions in each other's arguments.
void main() {
    vec2 size = _picture_imgSize;
    vec4 color = IMG_PIXEL(picture, isf_FragNormCoord * IMG_SIZE(picture));
    vec4 moved = IMG_NORM_PIXEL(picture, isf_FragNormCoord + 0.1 * IMG_NORM_PIXEL(picture, isf_FragNormCoord).rg);
    gl_FragColor = vec4(color.r, moved.g, size.x / 8.0, 1.0);
}
