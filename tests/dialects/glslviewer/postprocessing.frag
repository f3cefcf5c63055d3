// The scene has 8 bits: what is above 1 is lost. The last pass is not blended, whatever its alpha.
uniform sampler2D u_scene;
varying vec2 v_texcoord;

void main() {
#ifdef POSTPROCESSING
    gl_FragColor = vec4(texture2D(u_scene, v_texcoord.yx).rgb * 0.75, 0.5);
#else
    gl_FragColor = vec4(v_texcoord * 1.5, 0.4, 1.0);
#endif
}
