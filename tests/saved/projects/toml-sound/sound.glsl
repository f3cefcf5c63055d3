vec2 mainSound(int samp, float time) { return texelFetch(iChannel0, ivec2(samp % 64, 3), 0).xy * 2.0 - 1.0; }
