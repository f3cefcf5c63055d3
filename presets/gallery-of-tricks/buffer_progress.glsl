// Clouds of eight octaves of noise: x their height so far, w how many octaves are in it. Left all at once in frame 0,
// right one more each frame until all are there. A square that wanders about erases what it meets, as a resize does.
// Channel 0 is this buffer in the last frame.

const int OCTAVES = 8;

float octave(int i, vec2 uv) {
    return pow(0.5, float(i + 1)) * noise(uv * 3.0 * pow(2.0, float(i)) + 17.0 * float(i));
}

void mainImage(out vec4 clouds, in vec2 fragCoord) {
    int frame = iFrame % restart;
    bool left = 2.0 * fragCoord.x < iResolution.x;
    vec2 uv = fract(fragCoord / iResolution.xy * vec2(2.0, 1.0));
    clouds = texelFetch(iChannel0, ivec2(fragCoord), 0);
    if (!isFinite(clouds) || frame == 0) clouds = vec4(0.0);
    if (left) {
        if (frame == 0) {
            for (int i = 0; i < OCTAVES; i++) clouds.x += octave(i, uv);
            clouds.w = float(OCTAVES);
        }
    } else if (clouds.w < float(OCTAVES)) {
        clouds.x += octave(int(clouds.w), uv);
        clouds.w += 1.0;
    }
    vec2 eraser = 0.5 + 0.36 * vec2(sin(0.031 * float(frame)), cos(0.023 * float(frame)));
    if (frame > 90 && max(abs(uv.x - eraser.x), abs(uv.y - eraser.y)) < 0.07) clouds = vec4(0.0);
}
