/*{
    "ISFVSN": "2",
    "INPUTS": [{"NAME": "rate", "TYPE": "float", "DEFAULT": 0.5, "MIN": 0.0, "MAX": 1.0}]
}*/
// Macros of built-ins, and one in place of a built-in.
#define SLOW (TIME * rate)
#define time TIME
float slowed() { return SLOW * 4.0 + time; }
#define TIME (0.25 + 0.5 * isf_FragNormCoord.y)

void main() {
    gl_FragColor = vec4(TIME, isf_FragNormCoord.x, slowed(), 1.0);
}
