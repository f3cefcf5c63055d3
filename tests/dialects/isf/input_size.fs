/*{
    "ISFVSN": "2",
    "INPUTS": [{"NAME": "inputImage", "TYPE": "image"}]
}*/
// A filter gets an image of the size that it draws.
void main() {
    vec2 size = IMG_SIZE(inputImage);
    vec4 own = IMG_PIXEL(inputImage, gl_FragCoord.xy) - IMG_THIS_PIXEL(inputImage);
    gl_FragColor = vec4(size / 64.0, isf_FragNormCoord.y + length(own.rgb), 1.0);
}
