/*{ "ISFVSN": "2", "INPUTS": [], "PASSES": [ {"TARGET": "trail", "PERSISTENT": true, "FLOAT": true}, {} ] }*/
void main() { vec2 q = isf_FragNormCoord; if (PASSINDEX == 0) gl_FragColor = 0.9 * IMG_NORM_PIXEL(trail, q) + vec4(0.1 * q, 0.05, 1.0); else gl_FragColor = IMG_NORM_PIXEL(trail, q); }
