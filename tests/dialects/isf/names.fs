/*{
    "ISFVSN": "2",
    "INPUTS": [
        {"NAME": "step", "TYPE": "float", "DEFAULT": 0.25, "MIN": 0.0, "MAX": 1.0},
        {"NAME": "smooth", "TYPE": "float", "DEFAULT": 0.5, "MIN": 0.0, "MAX": 1.0},
        {"NAME": "sample", "TYPE": "float", "DEFAULT": 0.75, "MIN": 0.0, "MAX": 1.0}
    ]
}*/
// Inputs named like functions and keywords, and locals and parameters named like built-ins.
float wave(float TIME) { return TIME * 0.5; }

vec2 half_of(vec2 RENDERSIZE) { return RENDERSIZE * 0.5; }

void main() {
    vec2 at = isf_FragNormCoord;
    gl_FragColor = vec4(step, smooth, sample, 1.0);
    if (at.x > 0.5) gl_FragColor = vec4(wave(0.5), half_of(at), 1.0);
    if (at.y > 0.66) {
        float TIME = 0.75;
        vec3 texture = vec3(at, TIME);
        gl_FragColor = vec4(texture, 1.0);
    }
}
