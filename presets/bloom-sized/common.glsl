// Bloom over buffers of their own size: each half as large as the one before, down and up again.
//
// Method: J. Jimenez, "Next Generation Post Processing in Call of Duty: Advanced Warfare", SIGGRAPH 2014 courses: down
// by a wide filter, for a 2 x 2 mean alone shimmers when a small light moves; up by a 3 x 3 tent, which leaves nothing
// of the coarse grid to be seen; every level is blurred by all the wider ones. The filter down is here the transpose of
// the tent and not his thirteen fetches: a texel gets its light from the finer ones by the weights with which it gives
// it back. A third of the memory of the packed pyramid.
//
// All weights of a filter sum to one, and every step is a mean of two pictures: a wall of one colour stays that colour.
//
// Texel i of a level is always over texels 2 i and 2 i + 1 of the one before, counted from the bottom left, so a level
// has ceil(W / 2^k) of them. Where the one before has an odd number, the last texel is over one of them and over
// nothing. How much of the picture it stands for is kept in alpha, 1 for a whole texel, and light is kept times alpha.
// Since the filters are transposes of each other, both agree about every texel's share, and light is neither made nor
// lost at such an edge. What lies beyond the last texel is the mirror image: light that a filter sends over the edge
// comes back.
//
// Measured (tests/it/preset_bloom.rs, `eddy lab bloom`), strength 1, over the phases, at 640 x 360, 641 x 359, 333 x
// 187, 187 x 333: a spot's total is 0.998 to 0.999 of its light, also at the edges (0.996 to 0.998 at a spread of 1,
// where stores of 16 bits are cut off and not rounded, as by Mesa's software driver), and its centroid moves by 0.2
// pixels at most.

#iUniform float strength = 0.35 in { 0.0, 1.0 } // the part of the light that is spread
#iUniform float spread = 0.62 in { 0.0, 1.0 }   // of that, the part each level hands on to the next wider one
#iUniform float exposure = 0.0 in { -4.0, 4.0 } // in stops
#iUniform float white = 6.0 in { 1.0, 40.0 }    // the light that becomes paper white

// Against single hot pixels that blink. The first leaves out what a component has above it, and keeps all light below
// it. The second weighs bright pixels down among darker ones (see `down`); it keeps no total: of one texel of 1 on
// black 57 % is left.
#iUniform float brightest = 64.0 in { 1.0, 10000.0 }
#iUniform bool calm = false

// What the levels are stored times: as much as 16 bits have room for. They end at 6e-8, which a spot of 1 is soon below
// where it is spread far: unscaled, 1.3 % of it is lost at a spread of 1.
float scale() {
    return exp2(floor(log2(32768.0 / brightest)));
}

// E. Reinhard et al., "Photographic Tone Reproduction for Digital Images", SIGGRAPH 2002, equation 4.
vec3 reinhard(vec3 light) {
    return light * (1.0 + light / (white * white)) / (1.0 + light);
}

// Texels of level k that the picture covers. The buffers are a little larger, as a part of the canvas is rounded; on a
// canvas below 25 pixels they may be smaller.
ivec2 levelSize(int k, vec2 canvas, vec2 buffer_) {
    return min((ivec2(canvas) + (1 << k) - 1) >> k, ivec2(buffer_));
}

// A place in a picture, in texels, mirrored beyond its edges.
vec2 folded(vec2 at, vec2 extent) {
    return extent - abs(extent - abs(at));
}

// What is at a place of a level (or of the picture), between texels, times how much there is of it. `size` is how many
// texels there are, `extent` where the mirror is: as far, or a texel farther, with nothing in it.
vec4 fetched(sampler2D source, vec2 at, vec2 size, vec2 extent, bool isPicture) {
    at = folded(at, extent);
    vec2 part = 1.0 - clamp(extent - size, 0.0, 1.0) * clamp(at - size + 0.5, 0.0, 1.0);
    vec4 light = textureLod(source, min(at, size - 0.5) / vec2(textureSize(source, 0)), 0.0);
    if (isPicture) light = vec4(min(light.rgb, brightest), 1.0);
    return part.x * part.y * light;
}

// A texel of level k out of the level before, which is the picture for k = 1: light times alpha and scale(), and alpha.
// Rows and columns are 1 3 5 7 7 5 3 1, over 32, two weights a fetch. Sigma is 1.66 texels of the source.
vec4 down(sampler2D source, vec2 fragCoord, int k, vec2 canvas, vec2 resolution) {
    const float PLACE[4] = float[4](-2.75, -11.0 / 12.0, 11.0 / 12.0, 2.75),
        WEIGHT[4] = float[4](0.125, 0.375, 0.375, 0.125);
    vec2 own = vec2(levelSize(k, canvas, resolution));
    if (any(greaterThan(fragCoord, own))) return vec4(0.0);
    vec2 size = vec2(levelSize(k - 1, canvas, vec2(textureSize(source, 0))));
    vec4 sum = vec4(0.0);
    float weights = 0.0;
    for (int i = 0; i < 16; i++) {
        vec2 at = 2.0 * fragCoord + vec2(PLACE[i % 4], PLACE[i / 4]);
        vec4 light = fetched(source, at, size, 2.0 * own, k == 1);
        float weight = WEIGHT[i % 4] * WEIGHT[i / 4];
        // B. Karis, "Tone Mapping", 2013: a mean weighted by 1 / (1 + luminance) does not blink with one hot texel.
        if (calm && k == 1) weight /= 1.0 + dot(light, vec4(0.2126, 0.7152, 0.0722, 0.0));
        sum += weight * light;
        weights += weight;
    }
    sum /= weights;
    return k == 1 ? vec4(scale() * sum.rgb, sum.a) : sum;
}

// A texel of level k - 1 out of level k, whose light is no longer times alpha. Rows and columns are 1 2 1.
vec4 tent(sampler2D source, vec2 fragCoord, int k, vec2 canvas) {
    vec2 texels = vec2(textureSize(source, 0)), extent = vec2(levelSize(k, canvas, texels));
    vec4 sum = vec4(0.0);
    for (int y = -1; y <= 1; y++) {
        for (int x = -1; x <= 1; x++) {
            vec2 at = min(folded(0.5 * fragCoord + vec2(x, y), extent), extent - 0.5);
            sum += float((2 - abs(x)) * (2 - abs(y))) * textureLod(source, at / texels, 0.0);
        }
    }
    return sum / 16.0;
}

// Light without its alpha.
vec4 plain(vec4 light) {
    return vec4(light.rgb / max(light.a, 1e-4), 1.0);
}
