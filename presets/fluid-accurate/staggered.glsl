// Reading a staggered field, and paths through the velocity. Places are in cells of the grid: cell (i, j) is the square
// from (i, j) to (i + 1, j + 1). Axis 0 is x and the left faces, axis 1 is y and the bottom faces.
//
// The walls are in the reading: beyond one lies the mirror image of what lies inside, so that a stencil has no case of
// its own there. Through a wall nothing flows (odd image). Along it the fluid slips (even image) or sticks (odd image,
// about the wall's own speed).

// What stands for an index that may lie beyond the walls: a texel, by its index, times `sign`, plus `lid`.
struct Image {
    int at;
    float sign;
    float lid;
};

// In the direction of the axis: faces 0 to n, of which 0 and n are the walls. Face n has no texel. Images repeat after
// two boxes.
Image alongAxis(int i, int n) {
    if (walls == PERIODIC) return Image(i - n * int(floor(float(i) / float(n))), 1.0, 0.0);
    i -= 2 * n * int(floor(float(i) / float(2 * n)));
    float sign = i == n ? 0.0 : i > n ? -1.0 : 1.0;
    return Image(min(min(i, 2 * n - i), n - 1), sign, 0.0);
}

// In the other direction: rows 0 to n - 1, half a cell from the walls. `lid` is the speed of the upper one.
Image acrossAxis(int i, int n, float lid) {
    if (walls == PERIODIC) return Image(i - n * int(floor(float(i) / float(n))), 1.0, 0.0);
    bool beyond = i >= n && i < 2 * n;
    i -= 2 * n * int(floor(float(i) / float(2 * n)));
    bool odd = i >= n && walls == NO_SLIP;
    return Image(min(i, 2 * n - 1 - i), odd ? -1.0 : 1.0, odd && beyond ? 2.0 * lid : 0.0);
}

Image imageX(int i, int n, int axis) {
    if (axis == 0) return alongAxis(i, n);
    return acrossAxis(i, n, 0.0);
}

Image imageY(int i, int n, int axis) {
    if (axis == 1) return alongAxis(i, n);
    return acrossAxis(i, n, lid_speed);
}

// One face by its index.
float faceOf(sampler2D field, ivec2 i, int axis) {
    ivec2 size = textureSize(field, 0);
    Image x = imageX(i.x, size.x, axis), y = imageY(i.y, size.y, axis);
    return x.sign * (y.lid + y.sign * texelFetch(field, ivec2(x.at, y.at), 0)[axis]);
}

// The middle of a face.
vec2 faceAt(ivec2 p, int axis) {
    return vec2(p) + (axis == 0 ? vec2(0.0, 0.5) : vec2(0.5, 0.0));
}

// A place in terms of the faces, held inside the walls.
vec2 fromFaces(vec2 at, vec2 size, int axis) {
    return (walls == PERIODIC ? at : clamp(at, vec2(0.0), size)) - faceAt(ivec2(0), axis);
}

// Between four values, lower left, lower right, upper left and upper right, by lines. By differences, so that where all
// are the same the result is, too, to the last bit: what weights that make 1 up to rounding lose, they lose each frame.
float between(vec4 corners, vec2 f) {
    float lower = corners.x + f.x * (corners.y - corners.x), upper = corners.z + f.x * (corners.w - corners.z);
    return lower + f.y * (upper - lower);
}

// One component in between its faces, by lines.
float linearAt(sampler2D field, vec2 at, int axis) {
    ivec2 size = textureSize(field, 0);
    vec2 g = fromFaces(at, vec2(size), axis);
    ivec2 i = ivec2(floor(g));
    vec2 f = g - vec2(i);
    Image l = imageX(i.x, size.x, axis), r = imageX(i.x + 1, size.x, axis);
    Image d = imageY(i.y, size.y, axis), u = imageY(i.y + 1, size.y, axis);
    return between(vec4(l.sign * (d.lid + d.sign * texelFetch(field, ivec2(l.at, d.at), 0)[axis]),
                        r.sign * (d.lid + d.sign * texelFetch(field, ivec2(r.at, d.at), 0)[axis]),
                        l.sign * (u.lid + u.sign * texelFetch(field, ivec2(l.at, u.at), 0)[axis]),
                        r.sign * (u.lid + u.sign * texelFetch(field, ivec2(r.at, u.at), 0)[axis])), f);
}

// By cubics: J. D. Everett's form of Lagrange's interpolation through four points needs only the two in the middle
// where their second differences are known, so that sixteen fetches are four. A texel of `curves` (curves.glsl) is one
// component, its second differences along x and along y, and that along y of that along x.
float cubicAt(sampler2D curves, vec2 at, int axis) {
    ivec2 size = textureSize(curves, 0);
    vec2 g = fromFaces(at, vec2(size), axis);
    ivec2 i = ivec2(floor(g));
    vec2 f = g - vec2(i), c = 1.0 - f;
    vec2 near = f * c * (1.0 + c) / -6.0, far = f * c * (1.0 + f) / -6.0;
    Image l = imageX(i.x, size.x, axis), r = imageX(i.x + 1, size.x, axis);
    Image d = imageY(i.y, size.y, axis), u = imageY(i.y + 1, size.y, axis);
    vec2 left = l.sign * vec2(c.x, near.x), right = r.sign * vec2(f.x, far.x);
    vec2 down = d.sign * vec2(c.y, near.y), up = u.sign * vec2(f.y, far.y);
    vec4 ld = texelFetch(curves, ivec2(l.at, d.at), 0), rd = texelFetch(curves, ivec2(r.at, d.at), 0);
    vec4 lu = texelFetch(curves, ivec2(l.at, u.at), 0), ru = texelFetch(curves, ivec2(r.at, u.at), 0);
    vec4 corners = vec4(l.sign * (d.lid + d.sign * ld.x), r.sign * (d.lid + d.sign * rd.x),
                        l.sign * (u.lid + u.sign * lu.x), r.sign * (u.lid + u.sign * ru.x));
    float bent = dot(ld.yzw, vec3(left.y * down.x, left * down.y)) + dot(rd.yzw, vec3(right.y * down.x, right * down.y))
               + dot(lu.yzw, vec3(left.y * up.x, left * up.y)) + dot(ru.yzw, vec3(right.y * up.x, right * up.y));
    return between(corners, f) + bent;
}

// Where what is at `at` was `cells` (a time, in cells per height of velocity) ago; negative: where it will be. By the
// midpoint rule: `here` is the velocity at `at`. `across` and `upwards` are the curves of the velocity's two
// components.
vec2 path(sampler2D across, sampler2D upwards, vec2 at, vec2 here, float cells) {
    vec2 middle = at - 0.5 * cells * here;
    return at - cells * vec2(cubicAt(across, middle, 0), cubicAt(upwards, middle, 1));
}

// The same by lines, from a velocity as it is.
vec2 quickPath(sampler2D velocity, vec2 at, float cells) {
    vec2 middle = at - 0.5 * cells * vec2(linearAt(velocity, at, 0), linearAt(velocity, at, 1));
    return at - cells * vec2(linearAt(velocity, middle, 0), linearAt(velocity, middle, 1));
}
