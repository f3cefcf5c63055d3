/*{
    "ISFVSN": "2",
    "INPUTS": [
        {"NAME": "texture", "TYPE": "float", "DEFAULT": 0.25, "MIN": 0.0, "MAX": 1.0},
        {"NAME": "filter", "TYPE": "float", "DEFAULT": 0.5, "MIN": 0.0, "MAX": 1.0},
        {"NAME": "active", "TYPE": "bool", "DEFAULT": true},
        {"NAME": "patch", "TYPE": "color", "DEFAULT": [0.5, 1.0, 0.75, 1.0]}
    ],
    "IMPORTED": {"picture": {"PATH": "data/four.png"}}
}*/
// Names that later versions of GLSL use are free.
void main() {
    vec4 color = IMG_THIS_PIXEL(picture) * patch;
    if (active) color.rg = vec2(texture, filter) * (0.5 + 0.5 * isf_FragNormCoord);
    gl_FragColor = vec4(color.rgb, 1.0);
}
