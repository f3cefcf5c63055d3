// A buffer of floats: it counts beyond 1 and below 0, which 8 bits would not hold. The first frame is 1.
uniform sampler2D u_doubleBuffer0;
uniform vec2 u_resolution;
uniform int u_frame;
varying vec2 v_texcoord;

void main() {
    vec4 before = texture2D(u_doubleBuffer0, v_texcoord);
#if defined(DOUBLE_BUFFER_0)
    gl_FragColor = u_frame <= 1 ? vec4(v_texcoord, 0.0, 0.0) : before + vec4(0.4 * v_texcoord.x, 0.3, -0.25, 0.05);
#else
    gl_FragColor = vec4(before.x / 4.0, before.y / 4.0, -before.z / 2.0, 1.0);
    if (v_texcoord.y > 0.75) gl_FragColor = vec4(vec3(before.a), 1.0);
#endif
}
