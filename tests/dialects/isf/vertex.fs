/*{
    "ISFVSN": "2",
    "INPUTS": [{"NAME": "shift", "TYPE": "float", "DEFAULT": 0.125, "MIN": 0.0, "MAX": 1.0}],
    "IMPORTED": {"picture": {"PATH": "data/four.png"}}
}*/
varying vec2 right;
varying vec2 above;
varying float level;

void main() {
    vec4 sum = IMG_NORM_PIXEL(picture, right) + IMG_NORM_PIXEL(picture, above);
    gl_FragColor = vec4(sum.rg * 0.5, level, 1.0);
}
