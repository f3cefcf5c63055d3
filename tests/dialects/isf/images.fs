/*{
    "ISFVSN": "2",
    "IMPORTED": {"picture": {"PATH": "data/four.png"}}
}*/
// An image: y up, filtered, edges continue; IMG_PIXEL counts its own pixels.
void main() {
    vec2 at = isf_FragNormCoord;
    vec4 color = IMG_NORM_PIXEL(picture, at * 1.5 - 0.25);
    if (at.x > 0.5) color = IMG_PIXEL(picture, vec2((at.x - 0.5) * 8.0, at.y * 5.0));
    if (at.y > 0.85) color = vec4(IMG_SIZE(picture) / 8.0, 0.5, 1.0);
    gl_FragColor = vec4(color.rgb, 1.0);
}
