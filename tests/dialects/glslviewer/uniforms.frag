// Each row of three pixels shows a uniform.
uniform float u_time, u_delta, u_pixelDensity;
uniform int u_frame, u_play;
uniform vec2 u_resolution;
uniform vec3 u_model;
uniform bool u_resolutionChange;

void main() {
    vec2 at = gl_FragCoord.xy / u_resolution;
    float row = floor(gl_FragCoord.y / 3.0);
    vec3 color = vec3(u_resolution / 64.0, at.x);
    if (row == 1.0) color = vec3(u_time * 5.0, u_time, at.x);
    if (row == 2.0) color = vec3(u_delta * 30.0, u_delta * 60.0 * at.x, 0.0);
    if (row == 3.0) color = vec3(float(u_frame) / 16.0, float(u_play) * at.x, 0.5);
    if (row == 4.0) color = u_model * vec3(0.75, 0.5, at.x);
    if (row == 5.0) color = vec3(u_pixelDensity * 0.5, u_resolutionChange ? 1.0 : 0.25, at.y);
    gl_FragColor = vec4(color, 1.0);
}
