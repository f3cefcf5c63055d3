// Buffers, a double buffer and the last pass together. Pixels that a buffer discards are 0.
uniform sampler2D u_buffer0; // 0.25
uniform sampler2D u_doubleBuffer0; // 16x9
uniform sampler2D u_scene;
uniform vec2 u_resolution;
uniform int u_frame;
varying vec2 v_texcoord;

void main() {
#if defined(BUFFER_0)
    if (v_texcoord.x > 0.5) discard;
    gl_FragColor = vec4(v_texcoord, u_resolution.y / 16.0, 1.0);
#elif defined(DOUBLE_BUFFER_0)
    vec4 before = texture2D(u_doubleBuffer0, v_texcoord);
    gl_FragColor = u_frame < 2 ? vec4(0.0) : before * 0.5 + texture2D(u_buffer0, v_texcoord);
#elif defined(POSTPROCESSING)
    vec4 scene = texture2D(u_scene, v_texcoord);
    gl_FragColor = vec4(scene.rgb * 0.5 + 0.25 * texture2D(u_doubleBuffer0, v_texcoord).rgb, 1.0);
#else
    gl_FragColor = vec4(texture2D(u_doubleBuffer0, v_texcoord).rgb * 0.5, 1.0);
#endif
}
