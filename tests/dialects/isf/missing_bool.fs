/*{
    "ISFVSN": "2",
    "DESCRIPTION": "A bool without a default is true.",
    "INPUTS": [{"NAME": "isOn", "TYPE": "bool"}]
}*/
void main() {
    gl_FragColor = vec4(isOn ? 0.75 : 0.25, isf_FragNormCoord, 1.0);
}
