// By what the step that the sliders ask for is multiplied: 1, or less where the flow would deform by more than
// MOST_DEFORMATION in it. Channel 0 is how steep the velocity of the last frame is, in 8 x 8 parts, channel 1 any texture
// of its grid.

void mainImage(out vec4 pace, in vec2 fragCoord) {
    float slope = 0.0;
    for (int i = 0; i < 64; i++) slope = max(slope, texelFetch(iChannel0, ivec2(i % 8, i / 8), 0).x);
    float deformation = slope * speed * iTimeDelta * iChannelResolution[1].y;
    pace = vec4(isFinite(vec4(deformation)) ? min(1.0, MOST_DEFORMATION / max(deformation, 1e-6)) : 1.0, 0.0, 0.0, 0.0);
}
