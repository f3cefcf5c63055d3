// Rows of Buffer A: one spectrum each, the newest at the bottom.
const int ROWS = 64;
// Rows a second. It does not depend on the frame rate.
const float RATE = 32.0;

// The ends of the scale, in hertz. A bin of the analyser is 44100 / 2048 = 21.5 Hz wide.
const float LOWEST = 60.0, HIGHEST = 9000.0, BIN = 44100.0 / 2048.0;

// The frequency at a place from 0 to 1 of the scale, on which an octave has the same width everywhere.
float frequency(float at) {
    return LOWEST * pow(HIGHEST / LOWEST, at);
}
