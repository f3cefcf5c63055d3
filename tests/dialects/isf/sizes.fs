/*{
    "ISFVSN": "2",
    "INPUTS": [{"NAME": "part", "TYPE": "float", "DEFAULT": 0.5, "MIN": 0.0, "MAX": 1.0}],
    "PASSES": [
        {"TARGET": "line", "WIDTH": "$WIDTH", "HEIGHT": "1"},
        {"TARGET": "small", "WIDTH": "floor($WIDTH/4.0)", "HEIGHT": "floor($HEIGHT/3.0)", "FLOAT": true},
        {"TARGET": "dot", "WIDTH": 1, "HEIGHT": 1},
        {"TARGET": "scaled", "WIDTH": "max($WIDTH*$part, 1.0)", "HEIGHT": "$HEIGHT * $part"},
        {}
    ]
}*/
// The sizes of targets, and RENDERSIZE in their passes.
void main() {
    if (PASSINDEX < 4) {
        gl_FragColor = vec4(gl_FragCoord.xy / RENDERSIZE, (RENDERSIZE.x + RENDERSIZE.y) / 64.0, 1.0);
        return;
    }
    float row = floor(gl_FragCoord.y / 3.0);
    vec2 at = isf_FragNormCoord;
    gl_FragColor = IMG_NORM_PIXEL(line, at);
    if (row == 1.0) gl_FragColor = IMG_NORM_PIXEL(small, at);
    if (row == 2.0) gl_FragColor = IMG_NORM_PIXEL(dot, at);
    if (row == 3.0) gl_FragColor = IMG_NORM_PIXEL(scaled, at);
    if (row == 4.0) gl_FragColor = vec4(IMG_SIZE(small) / 16.0, IMG_SIZE(line).x / 64.0, 1.0);
    if (row == 5.0) gl_FragColor = vec4(IMG_SIZE(scaled) / 32.0, IMG_SIZE(dot).y / 4.0, 1.0);
}
