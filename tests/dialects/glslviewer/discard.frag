// Discarded pixels are black.
uniform vec2 u_resolution;
uniform int u_frame;

void main() {
    vec2 at = gl_FragCoord.xy / u_resolution;
    if (at.x > 0.5 && mod(float(u_frame), 4.0) < 1.5 || at.y > 0.7) discard;
    gl_FragColor = vec4(at, 0.5, 1.0);
}
