void mainImage(out vec4 o, in vec2 p) { o = vec4(iTime, iTimeDelta * 10.0, float(iFrame) * 0.1, iFrameRate / 100.0) + iDate / 100000.0; }
