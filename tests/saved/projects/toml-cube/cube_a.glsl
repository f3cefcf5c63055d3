void mainCubemap(out vec4 o, in vec2 p, in vec3 ro, in vec3 rd) { o = vec4(abs(rd), 1.0) * texture(iChannel0, p / iResolution.xy).x; }
