uniform vec2 u_resolution;
varying vec2 v_texcoord;
varying vec4 v_position;

void main() {
    vec2 same = abs(v_texcoord - gl_FragCoord.xy / u_resolution);
    gl_FragColor = vec4(v_texcoord, 0.5 + 0.5 * v_position.x * v_position.y, v_position.w - 100.0 * (same.x + same.y));
}
