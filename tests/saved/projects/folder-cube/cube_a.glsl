void mainCubemap(out vec4 o, in vec2 p, in vec3 ro, in vec3 rd) { o = vec4(0.5 + 0.5 * rd, 1.0); }
