/*{"ISFVSN": "2", "INPUTS": []}*/
void main() {
    vec2 same = abs(isf_FragNormCoord - gl_FragCoord.xy / RENDERSIZE) + abs(isf_FragNormCoord - vv_FragNormCoord);
    gl_FragColor = vec4(isf_FragNormCoord, 0.5 + 100.0 * (same.x + same.y), 1.0);
}
