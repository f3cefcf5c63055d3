/*{"ISFVSN": "2"}*/
// The colour is shown as it is.
void main() {
    gl_FragColor = vec4(0.9, isf_FragNormCoord, isf_FragNormCoord.x);
}
