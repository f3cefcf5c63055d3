/*{
    "ISFVSN": "2",
    "INPUTS": []
}*/
void main() {
    vec2 at = gl_FragCoord.xy / RENDERSIZE;
    vec3 color = vec3(TIME * 5.0, TIMEDELTA * 30.0, float(FRAMEINDEX) / 16.0);
    if (at.x > 0.5) color = vec3(RENDERSIZE / 64.0, float(PASSINDEX) + 0.25);
    gl_FragColor = vec4(color * (0.5 + 0.5 * at.y), 1.0);
}
