// date: 2026-11-29T18:30:12
// Months count from 0.
uniform vec4 u_date;
uniform vec2 u_resolution;

void main() {
    vec2 at = gl_FragCoord.xy / u_resolution;
    gl_FragColor = vec4((u_date.x - 2000.0) / 50.0, u_date.y / 12.0, u_date.z / 31.0, 1.0);
    if (at.x > 0.5) gl_FragColor = vec4(u_date.w / 86400.0, mod(u_date.w, 60.0) / 60.0, at.y, 1.0);
}
