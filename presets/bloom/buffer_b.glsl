// Packs the pyramid's first levels, each straight from the picture. Channel 0 is Buffer A.

// The most light that a component of a pixel may bring into the pyramid. Below it light is kept to rounding; what is
// above is left out, so that one wrong pixel of a million does not flash over the whole picture.
#iUniform float brightest = 64.0 in { 1.0, 10000.0 }

void mainImage(out vec4 packed, in vec2 fragCoord) {
    ivec2 p = ivec2(fragCoord), canvas = ivec2(iResolution.xy);
    Tile t = tileAt(p, canvas);
    packed = vec4(0.0);
    if (t.level == 0 || t.level > DIRECT) return;
    packed = gathered(iChannel0, ivec2(0), canvas, p - t.from, t.size, brightest);
}
