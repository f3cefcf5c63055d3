// Bloom over buffers of their own size: each half as large as the one before, down and up again.
//
// Method: J. Jimenez, "Next Generation Post Processing in Call of Duty: Advanced Warfare", SIGGRAPH 2014 courses. Down by 13
// bilinear fetches, which are five overlapping 4 x 4 boxes: a 2 x 2 mean alone shimmers when a small light moves. Up by a
// 3 x 3 tent: what a bilinear sampler alone leaves of the coarse grid is gone. A third of the memory of the packed pyramid,
// and every level is blurred by all the wider ones.
//
// All weights of a filter sum to one, and every step is a mean of two pictures: a wall of one colour stays that colour.
//
// Thirteen fetches are five whole boxes only where a texel stands over the corner that four texels of the source share. So
// texel i of a level is always over texels 2 i and 2 i + 1 of the one before, counted from the bottom left, whether or not the
// picture is so many texels wide. What lies beyond its edge is its mirror image: light that a filter sends over it comes back.
//
// Measured (tests/preset_filters.rs), strength 1, over the phases, at 640 x 360, 641 x 359, 333 x 187 and 187 x 333:
// a spot's total is 0.994 to 0.999 of its light (16 bits leave out the faintest) and its centroid moves by 0.05 pixels at most.
// At the upper and right edges of sizes that 32 does not divide the total is up to 9 % off: the coarse texels end elsewhere.

#iUniform float strength = 0.35 in { 0.0, 1.0 } // the part of the light that is spread
#iUniform float spread = 0.62 in { 0.0, 1.0 }   // of that, the part each level hands on to the next wider one
#iUniform float exposure = 0.0 in { -4.0, 4.0 } // in stops
#iUniform float white = 6.0 in { 1.0, 40.0 }    // the light that becomes paper white

// Against single hot pixels that blink. The first leaves out what a component has above it, and keeps all light below it. The
// second weighs bright pixels down among darker ones (see `box`); it keeps no total: of one texel of 1 on black 57 % is left.
#iUniform float brightest = 64.0 in { 1.0, 10000.0 }
#iUniform bool calm = false

// E. Reinhard et al., "Photographic Tone Reproduction for Digital Images", SIGGRAPH 2002, equation 4.
vec3 reinhard(vec3 light) {
    return light * (1.0 + light / (white * white)) / (1.0 + light);
}

vec4 box(vec4 a, vec4 b, vec4 c, vec4 d, bool weigh) {
    if (!weigh) return 0.25 * (a + b + c + d);
    // B. Karis, "Tone Mapping", 2013: a mean weighted by 1 / (1 + luminance) does not blink with one hot texel.
    const vec4 LUMA = vec4(0.2126, 0.7152, 0.0722, 0.0);
    vec4 w = 1.0 / (1.0 + vec4(dot(a, LUMA), dot(b, LUMA), dot(c, LUMA), dot(d, LUMA)));
    return (a * w.x + b * w.y + c * w.z + d * w.w) / (w.x + w.y + w.z + w.w);
}

// A place in a picture, in texels, where the picture is so many texels wide and high and mirrored beyond its edges.
vec2 folded(vec2 at, vec2 extent) {
    return extent - abs(extent - abs(at));
}

// The source around `at`. `at` and `extent`, the size of the picture there, are in its texels; extent need not be whole.
vec4 fetched(sampler2D source, vec2 at, vec2 extent) {
    return min(textureLod(source, folded(at, extent) / vec2(textureSize(source, 0)), 0.0), brightest);
}

vec4 down13(sampler2D source, vec2 at, vec2 extent, bool weigh) {
    vec4 inner[4], outer[9];
    for (int i = 0; i < 4; i++) inner[i] = fetched(source, at + vec2(2 * (i % 2) - 1, 2 * (i / 2) - 1), extent);
    for (int i = 0; i < 9; i++) outer[i] = fetched(source, at + 2.0 * vec2(i % 3 - 1, i / 3 - 1), extent);
    return 0.5 * box(inner[0], inner[1], inner[2], inner[3], weigh)
         + 0.125 * (box(outer[0], outer[1], outer[3], outer[4], weigh) + box(outer[1], outer[2], outer[4], outer[5], weigh)
                  + box(outer[3], outer[4], outer[6], outer[7], weigh) + box(outer[4], outer[5], outer[7], outer[8], weigh));
}

// Rows 1 2 1, columns 1 2 1, over 16: sigma is 0.71 texels of the source.
vec4 tent(sampler2D source, vec2 at, vec2 extent) {
    vec4 sum = vec4(0.0);
    for (int y = -1; y <= 1; y++) {
        for (int x = -1; x <= 1; x++) {
            vec2 q = folded(at + vec2(x, y), extent) / vec2(textureSize(source, 0));
            sum += float((2 - abs(x)) * (2 - abs(y))) * textureLod(source, q, 0.0);
        }
    }
    return sum / 16.0;
}
