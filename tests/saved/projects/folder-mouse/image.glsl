void mainImage(out vec4 o, in vec2 p) { o = vec4(abs(iMouse.xy) / iResolution.xy, step(0.0, iMouse.zw)); }
