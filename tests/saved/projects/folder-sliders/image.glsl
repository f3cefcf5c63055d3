void mainImage(out vec4 o, in vec2 p) { float r = fract(float(rings) * length(p / iResolution.xy) * dent - speed * iTime); o = vec4(tint * r, 1.0) * gains; if (!wrapped) o = 1.0 - o; }
