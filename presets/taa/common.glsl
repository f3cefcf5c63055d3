// Temporal anti-aliasing: one sample a pixel a frame, each frame at another place within the pixel, and a running mean
// over the frames, carried along with what moves.
//
//   jitter     16 points of the Halton sequence in bases 2 and 3
//   reproject  the history is looked up where this piece of the picture was a frame ago, by a Catmull-Rom filter: a
//   linear
//              one would blur a little more every frame, up to a sigma of 1.5 pixels
//   uncover    where most of the 3 x 3 texels of the history were of something that moves otherwise, there is no
//   history clamp      what cannot be there any more is known by its colour: the history is held within mean +- gamma *
//   sigma of
//              the 3 x 3 samples of this frame, in YCoCg, where the box around them is tight
//   trust      a narrow box kills ghosts and costs detail: hairlines are thinner than what 9 samples see. So it is
//   narrow
//              only where things that move differently meet, and for 24 frames after, and wide where the history is
//              older
//   blend      the plain mean while the history is young; then a tenth of the new, nine tenths of the old (the weight
//   of some
//              19 samples); at rest and trusted a twenty-fifth (49 samples, three rounds of the jitter)
//
// B. Karis, "High-Quality Temporal Supersampling", SIGGRAPH 2014 courses; M. Salvi, "An Excursion in Temporal
// Supersampling", GDC 2016 (the clamp by variance); J. Jimenez, "Filmic SMAA", SIGGRAPH 2016 courses (the filter).
//
// Against 64 samples a pixel, PSNR of the colours as the screen shows them, 320 x 180 (tests/it/preset_filters.rs):
// at rest 31.9 dB, 19.5 with one sample; gamma = relaxed = 0.75, the narrow box everywhere, has 28.4. In motion 23.0
// dB, 15.6 with one sample. Where an object was six frames ago the picture is 0.032 off in the mean. Behind a disc that crosses a star less than 1 % of its colour is left after a frame, at every gamma
// (`eddy lab taa`); by the clamp alone that took 21 pixels at gamma = 0.75, and more than 71 from 1 on.

#iUniform float speed = 1.0 in { 0.0, 4.0 }   // 0: everything stands still
#iUniform bool jittered = true

const int PHASES = 16;

float radicalInverse(int i, int base) {
    float result = 0.0, digit = 1.0 / float(base);
    for (; i > 0; i /= base) {
        result += float(i % base) * digit;
        digit /= float(base);
    }
    return result;
}

// Where within the pixel frame `i` looks, from -0.5 to 0.5. The mean over PHASES frames is near zero.
vec2 jitter(int i) {
    int phase = i % PHASES + 1; // the sequence begins at 1: number 0 is the pixel's corner
    return jittered ? vec2(radicalInverse(phase, 2), radicalInverse(phase, 3)) - 0.5 : vec2(0.0);
}

// ---------------------------------------------------------------------------------------------- what moves, and how

// Pixels in a unit: the height, or less on a narrow canvas.
float unit(vec2 resolution) {
    return min(resolution.y, 0.7 * resolution.x);
}

const int WALL = 0, WHEEL = 1, COG = 2, OBJECTS = 3;

mat2 turned(float angle) {
    return mat2(cos(angle), -sin(angle), sin(angle), cos(angle));
}

vec2 wheelAt(float t) { return vec2(0.34 * sin(0.43 * t) + 0.12, 0.10 * sin(0.9 * t) + 0.08); }
vec2 cogAt(float t) { return vec2(-0.48 + 0.10 * sin(0.7 * t), -0.12); }

// From the picture (height 1, the middle is 0) to the object's own coordinates at time t, and back.
vec2 toObject(int id, vec2 p, float t) {
    if (id == WHEEL) return turned(0.25 * t) * (p - wheelAt(t));
    if (id == COG) return turned(-0.6 * t) * (p - cogAt(t));
    return p + vec2(0.06 * t, 0.0);
}

vec2 fromObject(int id, vec2 q, float t) {
    if (id == WHEEL) return turned(-0.25 * t) * q + wheelAt(t);
    if (id == COG) return turned(0.6 * t) * q + cogAt(t);
    return q - vec2(0.06 * t, 0.0);
}
