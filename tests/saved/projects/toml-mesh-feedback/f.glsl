in vec3 vNormal;
out vec4 o;
void main() { o = vec4(abs(vNormal), 1.0) * (0.7 + texelFetch(iChannel0, ivec2(gl_FragCoord.xy), 0)); }
