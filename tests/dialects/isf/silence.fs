/*{
    "ISFVSN": "2",
    "INPUTS": [
        {"NAME": "waves", "TYPE": "audio", "MAX": 64},
        {"NAME": "bins", "TYPE": "audioFFT", "MAX": 32}
    ]
}*/
// spectrum: 0,1
// The samples of silence are in the middle, and its spectrum is 0.
void main() {
    float at = isf_FragNormCoord.x;
    float wave = IMG_NORM_PIXEL(waves, vec2(at, 0.5)).r;
    float bin = IMG_NORM_PIXEL(bins, vec2(at, 0.5)).r;
    gl_FragColor = vec4(wave, bin + 0.25, at, 1.0);
    if (isf_FragNormCoord.y > 0.5) gl_FragColor = vec4(IMG_SIZE(waves).x / 128.0, IMG_SIZE(bins).x / 128.0, 0.0, 1.0);
}
