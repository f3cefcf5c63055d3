/*{
    "ISFVSN": "2",
    "INPUTS": [{"NAME": "shift", "TYPE": "float", "DEFAULT": 0.25, "MIN": 0.0, "MAX": 1.0}]
}*/
varying vec2 moved;
varying float corner_level;

void main() {
    gl_FragColor = vec4(moved, corner_level, 1.0);
}
