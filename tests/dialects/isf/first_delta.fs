/*{
    "ISFVSN": "2",
    "PASSES": [{"TARGET": "sum", "PERSISTENT": true, "FLOAT": true, "WIDTH": 1, "HEIGHT": 1}, {}]
}*/
// TIMEDELTA is 0 in the first frame: the sum is TIME.
void main() {
    float before = FRAMEINDEX == 0 && PASSINDEX == 0 ? 0.0 : IMG_NORM_PIXEL(sum, vec2(0.5)).r;
    if (PASSINDEX == 0) gl_FragColor = vec4(before + TIMEDELTA, 0.0, 0.0, 1.0);
    else gl_FragColor = vec4(before * 6.0, TIME * 6.0, isf_FragNormCoord.x, 1.0);
}
