// The pass before POSTPROCESSING is blended over transparent black.
uniform sampler2D u_scene;
varying vec2 v_texcoord;

void main() {
#if defined(POSTPROCESSING)
    vec4 scene = texture2D(u_scene, v_texcoord);
    gl_FragColor = vec4(v_texcoord.y < 0.5 ? scene.rgb : scene.aaa, 1.0);
#else
    gl_FragColor = vec4(0.8, 1.0 - v_texcoord.x, 0.3, v_texcoord.x);
#endif
}
