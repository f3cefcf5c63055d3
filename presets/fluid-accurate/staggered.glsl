// Reading the staggered velocity, and paths through it. Positions are in cells of the grid: cell (i, j) is the square from (i, j)
// to (i + 1, j + 1). The text that includes this names the texture: VELOCITY.

ivec2 grid() {
    return textureSize(VELOCITY, 0);
}

// Faces by their index; those of the walls, and all beyond, let nothing through. Along a wall the fluid slips.
float across(ivec2 face) {
    ivec2 size = grid();
    if (face.x <= 0 || face.x >= size.x) return 0.0;
    return texelFetch(VELOCITY, ivec2(face.x, clamp(face.y, 0, size.y - 1)), 0).x;
}

float upwards(ivec2 face) {
    ivec2 size = grid();
    if (face.y <= 0 || face.y >= size.y) return 0.0;
    return texelFetch(VELOCITY, ivec2(clamp(face.x, 0, size.x - 1), face.y), 0).y;
}

vec2 inside(vec2 at) {
    return clamp(at, vec2(0.0), vec2(grid()));
}

float acrossAt(vec2 at) {
    vec2 g = inside(at) - vec2(0.0, 0.5);
    ivec2 i = ivec2(floor(g));
    vec2 f = g - vec2(i);
    return mix(mix(across(i), across(i + ivec2(1, 0)), f.x), mix(across(i + ivec2(0, 1)), across(i + 1), f.x), f.y);
}

float upwardsAt(vec2 at) {
    vec2 g = inside(at) - vec2(0.5, 0.0);
    ivec2 i = ivec2(floor(g));
    vec2 f = g - vec2(i);
    return mix(mix(upwards(i), upwards(i + ivec2(1, 0)), f.x), mix(upwards(i + ivec2(0, 1)), upwards(i + 1), f.x), f.y);
}

vec2 velocityAt(vec2 at) {
    return vec2(acrossAt(at), upwardsAt(at));
}

// Where what is at `at` was `cells` (a time, in cells per height of velocity) ago; negative: where it will be.
vec2 path(vec2 at, float cells) {
    vec2 middle = inside(at - 0.5 * cells * velocityAt(at));
    return inside(at - cells * velocityAt(middle));
}
