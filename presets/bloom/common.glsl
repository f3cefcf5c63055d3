// Bloom: what a lens and an eye do to a bright thing, in a picture that cannot be that bright.
//
// Every pixel spreads a small part of its light far around it: the picture is mixed with blurred copies of itself, each
// twice as wide as the one before. Nothing is cut off by a threshold and nothing is added, so light is neither made nor
// lost: a wall of one colour stays that colour. (J. Jimenez, "Next Generation Post Processing in Call of Duty: Advanced
// Warfare", SIGGRAPH 2014 courses, has the reasons; the packed pyramid is what four buffers of one size allow.)
//
// The pyramid lies in one texture: level k has the column of tiles that begins where level k - 1 ends, W / 2^k texels wide.
// A tile's outermost PAD texels repeat the picture's edge. A blur that reaches PAD texels thus needs no care at the border,
// and no level ever bleeds into the next.

#iUniform float strength = 0.35 in { 0.0, 1.0 } // the part of the light that is spread
#iUniform float spread = 1.15 in { 0.5, 2.0 }   // weight of each level against the one before
#iUniform float exposure = 0.0 in { -4.0, 4.0 } // in stops
#iUniform float white = 6.0 in { 1.0, 40.0 }    // the light that becomes paper white

const int PAD = 4;
const int LEVELS = 7;

struct Tile {
    int level;    // 0: none is here
    ivec2 from;   // bottom left, padding and all
    ivec2 size;
};

// Tiles too small to hold a texel inside of their padding are left out.
Tile tile(int level, ivec2 canvas) {
    int x = 0;
    for (int k = 1; k < level; k++) x += canvas.x >> k;
    ivec2 size = canvas >> level;
    bool fits = min(size.x, size.y) > 2 * PAD;
    return Tile(fits ? level : 0, ivec2(x, 0), size);
}

Tile tileAt(ivec2 p, ivec2 canvas) {
    for (int k = 1; k <= LEVELS; k++) {
        Tile t = tile(k, canvas);
        ivec2 q = p - t.from;
        if (t.level > 0 && all(greaterThanEqual(q, ivec2(0))) && all(lessThan(q, t.size))) return t;
    }
    return Tile(0, ivec2(0), ivec2(1));
}

// The nine weights 1 8 28 56 70 56 28 8 1: a row of Pascal's triangle, the nearest whole numbers have to a Gaussian. Their
// sum is 256, so the division is exact. Sigma is sqrt(2).
const float WEIGHT[5] = float[5](70.0 / 256.0, 56.0 / 256.0, 28.0 / 256.0, 8.0 / 256.0, 1.0 / 256.0);

// E. Reinhard et al., "Photographic Tone Reproduction for Digital Images", SIGGRAPH 2002, equation 4.
vec3 reinhard(vec3 light) {
    return light * (1.0 + light / (white * white)) / (1.0 + light);
}
