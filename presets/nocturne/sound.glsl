// Nothing here remembers anything: a sample is a function of its number. Phases are 32-bit integers that wrap, so a note
// is in tune after three minutes too; a float of seconds would by then know a phase of 440 Hz to a hundredth of a turn.

// The phase of an oscillator, from 0 to 1.
float phaseOf(int samp, float hz) {
    uint step_ = uint(hz * (4294967296.0 / 44100.0) + 0.5);
    return float((uint(samp) * step_) >> 8u) / 16777216.0;
}

// A sawtooth whose harmonic k is r^(k-1) as loud as it would be: sum of r^k sin(k x) / k = atan(r sin x / (1 - r cos x))
// (I. S. Gradshteyn, I. M. Ryzhik, "Table of Integrals, Series, and Products", 1.448). With r^n small where harmonic n
// reaches half the sample rate, nothing aliases.
float softSaw(float phase, float r) {
    float x = 6.2831853 * phase;
    return atan(r * sin(x), 1.0 - r * cos(x)) / max(r, 0.2) * 0.6366;
}

// The largest r whose harmonic at 22,050 Hz is 70 dB down.
float brightest(float hz) {
    return exp2(-11.6 * hz / 22050.0);
}

// A plucked note: bright at first.
float plucked(int samp, float since, int note) {
    if (note == 0 || since < 0.0) return 0.0;
    float hz = hertz(note), r = brightest(hz) * (0.25 + 0.7 * exp(-7.0 * since));
    float attack = min(since * 250.0, 1.0);
    return attack * exp(-3.2 * since) * softSaw(phaseOf(samp, hz), r);
}

// The arpeggio: the last four sixteenths still sound.
float arpeggioAt(int samp, float time) {
    int now = int(floor(time / SIXTEENTH));
    float sum = 0.0;
    for (int i = 0; i < 4; i++) sum += plucked(samp, time - float(now - i) * SIXTEENTH, arpeggio(now - i));
    // The note before these ends here.
    float tail = smoothstep(1.0, 0.0, fract(time / SIXTEENTH));
    return sum + tail * plucked(samp, time - float(now - 4) * SIXTEENTH, arpeggio(now - 4));
}

vec2 pad(int samp, float time) {
    int bar = int(floor(time / BAR));
    vec2 sum = vec2(0.0);
    // Two chords overlap while one becomes the other.
    for (int k = 0; k < 2; k++) {
        int which = bar - k;
        if (which < 0) continue;
        float since = time - float(which) * BAR;
        float level = smoothstep(0.0, 0.9, since) * smoothstep(BAR + 1.2, BAR - 0.2, since);
        if (level <= 0.0) continue;
        for (int i = 0; i < 4; i++) {
            float hz = hertz(rootOf(which) + chordOf(which)[i] + (i == 0 ? 0 : 12));
            float r = 0.35 + 0.2 * sin(0.37 * time + 2.0 * float(i));
            vec2 voices = vec2(softSaw(phaseOf(samp, hz * 1.0021), r), softSaw(phaseOf(samp, hz * 0.9979), r));
            float side = 0.3 * (float(i) - 1.5) / 1.5;
            sum += level * voices * vec2(1.0 - side, 1.0 + side);
        }
    }
    return 0.07 * sum;
}

float bass(int samp, float time) {
    int bar = int(floor(time / BAR));
    if (bar < 2) return 0.0;
    float inBar = time - float(bar) * BAR;
    // On one, and before three.
    float since = inBar < 1.5 * BEAT ? inBar : inBar - 1.5 * BEAT;
    float hz = hertz(rootOf(bar) - 12);
    float level = min(since * 120.0, 1.0) * exp(-1.1 * since) * smoothstep(BAR, BAR - 0.02, inBar)
        * (inBar < 1.5 * BEAT ? smoothstep(1.5 * BEAT, 1.5 * BEAT - 0.02, inBar) : 1.0);
    return 0.3 * level * softSaw(phaseOf(samp, hz), 0.45 * exp(-2.0 * since) + 0.2);
}

float kick(float time) {
    if (time < 8.0 * BAR) return 0.0;
    float since = mod(time, 2.0 * BEAT);
    return 0.38 * sin(6.2831853 * (46.0 * since + 2.2 * (1.0 - exp(-38.0 * since)))) * exp(-9.0 * since)
        * min(since * 500.0, 1.0);
}

// Noise, brighter by the difference of neighbours.
vec2 brush(int samp, float time) {
    if (time < 12.0 * BAR) return vec2(0.0);
    float since = mod(time - BEAT, 2.0 * BEAT);
    vec2 noise = vec2(hash(uint(samp)) >> 16u, hash(uint(samp) + 7u) >> 16u) / 65536.0
        - vec2(hash(uint(samp) - 1u) >> 16u, hash(uint(samp) + 6u) >> 16u) / 65536.0;
    return 0.05 * noise * min(since * 60.0, 1.0) * exp(-16.0 * since);
}

vec2 mainSound(int samp, float time) {
    vec2 sum = pad(samp, time) + bass(samp, time) + kick(time) + brush(samp, time);
    // Echoes on dotted eighths, from one side to the other.
    float gain = 0.16;
    for (int echo = 0; echo < 4; echo++) {
        int late = int(float(echo) * 3.0 * SIXTEENTH * 44100.0 + 0.5);
        float side = echo == 0 ? 0.0 : (echo & 1) == 1 ? 0.7 : -0.7;
        sum += gain * arpeggioAt(samp - late, float(samp - late) / 44100.0) * vec2(1.0 + side, 1.0 - side);
        gain *= 0.42;
    }
    // In at the beginning, out at the end, and never beyond 1.
    sum *= 1.6 * smoothstep(0.0, 2.0, time) * smoothstep(180.0, 172.0, time);
    return sum / (1.0 + abs(sum));
}
