/*{
    "ISFVSN": "2",
    "INPUTS": [
        {"NAME": "level", "TYPE": "float", "DEFAULT": 0.375, "MIN": 0.0, "MAX": 2.0},
        {"NAME": "place", "TYPE": "point2D", "DEFAULT": [0.25, 0.75], "MIN": [0.0, 0.0], "MAX": [1.0, 1.0]},
        {"NAME": "tint", "TYPE": "color", "DEFAULT": [1.0, 0.5, 0.25, 0.75]},
        {"NAME": "isOn", "TYPE": "bool", "DEFAULT": true},
        {"NAME": "isOff", "TYPE": "bool", "DEFAULT": 0},
        {"NAME": "choice", "TYPE": "long", "VALUES": [2, 5, 7], "LABELS": ["two", "five", "seven"], "DEFAULT": 5},
        {"NAME": "flash", "TYPE": "event"}
    ]
}*/
void main() {
    vec2 at = isf_FragNormCoord;
    vec3 color = vec3(level, place);
    if (at.y > 0.33) color = tint.rgb * tint.a;
    if (at.y > 0.66) color = vec3(isOn ? 0.75 : 0.0, isOff ? 1.0 : 0.25, float(choice) / 10.0);
    if (flash) color = vec3(1.0);
    gl_FragColor = vec4(color * (0.5 + 0.5 * at.x), 1.0);
}
