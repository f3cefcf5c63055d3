/*{
    "ISFVSN": "2",
    "DESCRIPTION": "Months count from 1."
}*/
// date: 2026-11-29T18:30:12
void main() {
    vec2 at = isf_FragNormCoord;
    gl_FragColor = vec4((DATE.x - 2000.0) / 50.0, DATE.y / 12.0, DATE.z / 31.0, 1.0);
    if (at.x > 0.5) gl_FragColor = vec4(DATE.w / 86400.0, mod(DATE.w, 60.0) / 60.0, at.y, 1.0);
}
