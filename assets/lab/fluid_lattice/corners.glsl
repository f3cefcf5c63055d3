// Each population comes from the texel behind it, where it has collided; from a wall, from the one here that went the other way.
void mainImage(out vec4 corners, in vec2 fragCoord) {
    for (int i = 0; i < 4; ++i) {
        ivec2 here = ivec2(fragCoord), from = here - ivec2(CORNERS_X[i], CORNERS_Y[i]);
        bool wall = isWall(from);
        int which = wall ? (i + 2) % 4 : i;
        Cell f = cell(iChannel0, iChannel1, iChannel2, wall ? here : from);
        corners[i] = cornersAfter(f)[which];
        if (wall) corners[i] += dragged(from, 1.0 / 36.0, CORNERS_X[i]);
    }
}
