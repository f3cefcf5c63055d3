uniform vec2 u_resolution;
uniform float u_time;
void main() {
    vec2 place = gl_FragCoord.xy / u_resolution;
    gl_FragColor = vec4(place, abs(sin(u_time)), 1.0);
}
