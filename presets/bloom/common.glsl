// Bloom: what a lens and an eye do to a bright thing, in a picture that cannot be that bright.
//
// Every pixel spreads a small part of its light far around it: the picture is mixed with blurred copies of itself, each
// twice as wide as the one before. Nothing is cut off by a threshold and nothing is added, so light is neither made nor
// lost: a wall of one colour stays that colour. (J. Jimenez, "Next Generation Post Processing in Call of Duty: Advanced
// Warfare", SIGGRAPH 2014 courses, has the reasons; the packed pyramid is what four buffers of one size allow.)
//
// The pyramid lies in one texture: level 1 at the bottom left, the others in a column beside it (above it, where the
// canvas is higher than wide). Level k has N = round(W / 2^k) texels across the whole picture, so a texel is W / N
// pixels wide, nearly 2^k. Beyond the picture lies its mirror image: light that a kernel sends over the edge comes
// back.
//
// What keeps the light where it is. On the way down each texel gives its light to the two nearest texels of the level
// by linear weights, along each axis. These weights sum to 1 and so do the places they stand for, at every phase and
// for any ratio of sizes; a box would move a texel by up to half of a coarse one. On the way up each level is drawn by
// cubic B-splines, which have both properties too and show no corners. Level k spreads a texel over sigma = 1.58 * 2^k
// pixels.
//
// Measured (tests/it/preset_bloom.rs, `eddy lab bloom`), strength 1, over the phases, at 640 x 360, 641 x 359, 333 x
// 187, 187 x 333: a spot's total is 0.993 to 1.001 of its light, also at the edges, and its centroid moves by 0.01
// pixels at most.

#iUniform float strength = 0.35 in { 0.0, 1.0 } // the part of the light that is spread
#iUniform float spread = 1.15 in { 0.5, 2.0 }   // weight of each level against the one before
#iUniform float exposure = 0.0 in { -4.0, 4.0 } // in stops
#iUniform float white = 6.0 in { 1.0, 40.0 }    // the light that becomes paper white

const int LEVELS = 7;
const int DIRECT = 2; // levels that are made from the picture itself; the others are made from the last of these
const int PAD = 2;    // texels of the mirror image around a tile: what a B-spline reads beyond the picture's edge

struct Tile {
    int level;    // 0: none is here
    ivec2 from;   // the bottom left texel of the picture, without padding
    ivec2 size;   // texels of the picture
};

Tile tileOf(int level, ivec2 corner, ivec2 canvas) {
    ivec2 size = (canvas + (1 << level >> 1)) >> level;
    // A level of few texels is no more than a tint of the whole picture, and one whose texels are much wider than they
    // should be is not evenly spread.
    bool fits = level <= LEVELS && min(canvas.x, canvas.y) >> level > 8
             && all(lessThanEqual(corner + size + 2 * PAD, canvas));
    return Tile(fits ? level : 0, corner + PAD, size);
}

Tile firstTile(ivec2 canvas) {
    return tileOf(1, ivec2(0), canvas);
}

Tile nextTile(Tile t, ivec2 canvas) {
    bool isWide = canvas.x >= canvas.y;
    ivec2 corner = t.from - PAD, full = t.size + 2 * PAD;
    corner += (t.level == 1) == isWide ? ivec2(full.x, 0) : ivec2(0, full.y);
    return tileOf(t.level + 1, corner, canvas);
}

Tile tileAt(ivec2 p, ivec2 canvas) {
    Tile t = firstTile(canvas);
    while (t.level > 0) {
        ivec2 q = p - t.from + PAD;
        if (all(greaterThanEqual(q, ivec2(0))) && all(lessThan(q, t.size + 2 * PAD))) break;
        t = nextTile(t, canvas);
    }
    return t;
}

// The last level that is made from the picture itself, as a source of the others.
Tile directTile(ivec2 canvas) {
    Tile t = firstTile(canvas);
    for (int k = 1; k < DIRECT; k++) t = nextTile(t, canvas);
    return t;
}

// The texel inside of the picture that a texel beyond its edge mirrors.
ivec2 mirrored(ivec2 p, ivec2 size) {
    p = max(p, -1 - p);
    return clamp(min(p, 2 * size - 1 - p), ivec2(0), size - 1);
}

// The mean of a source around texel i of a coarser grid, by the weights with which the source gives its light to the
// grid. `corner` and `size` say where the source lies in its texture.
vec4 gathered(sampler2D source, ivec2 corner, ivec2 size, ivec2 i, ivec2 coarse, float most) {
    vec2 ratio = vec2(size) / vec2(coarse), centre = (vec2(i) + 0.5) * ratio - 0.5;
    ivec2 low = ivec2(ceil(centre - ratio)), high = ivec2(floor(centre + ratio));
    vec4 sum = vec4(0.0);
    float weights = 0.0;
    for (int y = low.y; y <= high.y; y++) {
        for (int x = low.x; x <= high.x; x++) {
            vec2 near = 1.0 - abs(vec2(x, y) - centre) / ratio;
            vec4 light = texelFetch(source, corner + mirrored(ivec2(x, y), size), 0);
            sum += near.x * near.y * min(light, most);
            weights += near.x * near.y;
        }
    }
    return sum / weights;
}

// The nine weights 1 8 28 56 70 56 28 8 1: a row of Pascal's triangle, the nearest whole numbers have to a Gaussian.
// Their sum is 256, so the division is exact. Sigma is sqrt(2).
const int REACH = 4;
const float WEIGHT[5] = float[5](70.0 / 256.0, 56.0 / 256.0, 28.0 / 256.0, 8.0 / 256.0, 1.0 / 256.0);

// E. Reinhard et al., "Photographic Tone Reproduction for Digital Images", SIGGRAPH 2002, equation 4.
vec3 reinhard(vec3 light) {
    return light * (1.0 + light / (white * white)) / (1.0 + light);
}
