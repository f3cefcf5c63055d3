// The score: bars of four beats, eight chords that repeat, and an arpeggio of sixteenths that changes with them.

const float TEMPO = 84.0;                 // beats a minute
const float BEAT = 60.0 / TEMPO;          // seconds
const float SIXTEENTH = 0.25 * BEAT;
const float BAR = 4.0 * BEAT;

// The lowest note of a chord, and its intervals in semitones: Am9, Fmaj7, Cmaj7, G6, Dm9, Am7, E7sus4, E7.
int rootOf(int bar) {
    const int roots[8] = int[8](45, 41, 48, 43, 50, 45, 40, 40);
    return roots[bar & 7];
}

ivec4 chordOf(int bar) {
    const ivec4 chords[8] = ivec4[8](ivec4(0, 7, 15, 26), ivec4(0, 7, 16, 23), ivec4(0, 7, 16, 23), ivec4(0, 7, 16, 21),
                                     ivec4(0, 7, 15, 26), ivec4(0, 7, 15, 22), ivec4(0, 7, 17, 22), ivec4(0, 8, 16, 22));
    return chords[bar & 7];
}

// Equal temperament, A above middle C at 440 Hz (ISO 16), MIDI numbers.
float hertz(int note) {
    return 440.0 * exp2(float(note - 69) / 12.0);
}

// Bits that look random, of a number (C. Wellons, "Prospecting for Hash Functions", 2018: lowbias32).
uint hash(uint x) {
    x = (x ^ (x >> 16u)) * 0x7feb352du;
    x = (x ^ (x >> 15u)) * 0x846ca68bu;
    return x ^ (x >> 16u);
}

// The note of the arpeggio at a sixteenth; 0 for a rest.
int arpeggio(int sixteenth) {
    if (sixteenth < 0) return 0;
    int bar = sixteenth / 16, place = sixteenth % 16;
    uint chance = hash(uint(bar % 32) * 16u + uint(place));
    // It begins after a bar, and fills up over the next eight.
    float density = clamp(float(bar + 1) / 9.0, 0.0, 1.0) * (bar % 16 == 15 ? 0.4 : 0.8);
    if (bar == 0 || (float(chance & 255u) / 256.0 >= density && place % 4 != 0)) return 0;
    const int walk[16] = int[16](0, 2, 1, 3, 2, 3, 1, 2, 0, 3, 2, 1, 3, 2, 3, 1);
    int octave = 12 + ((chance >> 9u) % 5u == 0u ? 12 : 0);
    return rootOf(bar) + chordOf(bar)[walk[place]] + octave;
}
