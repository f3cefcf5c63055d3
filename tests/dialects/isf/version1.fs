/*{
    "CREDIT": "Eddy",
    "INPUTS": [{"NAME": "level", "TYPE": "long", "DEFAULT": 3, "MIN": 0, "MAX": 9}],
    "IMPORTED": {"picture": {"PATH": "data/four.png"}}
}*/
// The names of version 1.
void main() {
    vec4 color = IMG_NORM_PIXEL(picture, vv_FragNormCoord);
    gl_FragColor = vec4(color.rg, float(level) / 9.0, 1.0);
}
