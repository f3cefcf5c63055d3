// Reading a staggered field, and paths through the velocity. Places are in cells of the grid: cell (i, j) is the square from
// (i, j) to (i + 1, j + 1). Axis 0 is x and the left faces, axis 1 is y and the bottom faces.
//
// The walls are in the reading: what lies beyond one is the mirror image of what lies inside, so that a stencil needs no case of
// its own there. Through a wall nothing flows (odd image). Along it the fluid slips (even image) or sticks (odd image, about the
// wall's own speed).

const int NO_SLIP = 1, PERIODIC = 2; // values of the slider `walls`; 0 is free slip

// Texels and weights of a stencil of 4 x 4 faces. `lid` is what the moving wall adds.
struct Stencil {
    ivec4 x, y;
    vec4 wx, wy;
    float lid;
};

// Weights of the four points around a place at fraction f between the middle two.
vec4 linear(float f) {
    return vec4(0.0, 1.0 - f, f, 0.0);
}

// Lagrange's cubic through four points: exact for polynomials of degree three.
vec4 cubic(float f) {
    float a = 1.0 + f, b = 1.0 - f, c = 2.0 - f;
    return vec4(-f * b * c / 6.0, a * b * c / 2.0, a * f * c / 2.0, -a * f * b / 6.0);
}

ivec4 wrapped(ivec4 at, int n) {
    return at - n * ivec4(floor(vec4(at) / float(n)));
}

// The direction the axis points in: faces 0 to n, of which 0 and n are walls and n has no texel.
void alongAxis(int from, int n, inout vec4 w, out ivec4 at) {
    at = from + ivec4(-1, 0, 1, 2);
    if (walls == PERIODIC) {
        at = wrapped(at, n);
        return;
    }
    w *= 1.0 - 2.0 * vec4(lessThan(at, ivec4(0))) - 2.0 * vec4(greaterThan(at, ivec4(n)));
    at = n - abs(n - abs(at));
    w *= vec4(notEqual(at, ivec4(n)));
    at = clamp(at, ivec4(0), ivec4(n - 1));
}

// The other direction: rows 0 to n - 1, half a cell from the walls. Gives the weight of what lies beyond the upper wall.
float acrossAxis(int from, int n, inout vec4 w, out ivec4 at) {
    at = from + ivec4(-1, 0, 1, 2);
    if (walls == PERIODIC) {
        at = wrapped(at, n);
        return 0.0;
    }
    vec4 low = vec4(lessThan(at, ivec4(0))), high = vec4(greaterThanEqual(at, ivec4(n)));
    float beyond = dot(w, high);
    if (walls == NO_SLIP) w *= 1.0 - 2.0 * (low + high);
    at = min(max(at, -1 - at), 2 * n - 1 - at);
    at = clamp(at, ivec4(0), ivec4(n - 1));
    return beyond;
}

vec2 inside(vec2 at, ivec2 size) {
    return walls == PERIODIC ? at : clamp(at, vec2(0.0), vec2(size));
}

// The stencil for one component at a place, by lines (order 1) or cubics (order 3).
Stencil stencilAt(vec2 at, ivec2 size, int axis, int order) {
    vec2 g = inside(at, size) - (axis == 0 ? vec2(0.0, 0.5) : vec2(0.5, 0.0));
    vec2 whole = floor(g), f = g - whole;
    ivec2 i = ivec2(whole);
    Stencil s;
    s.wx = order == 1 ? linear(f.x) : cubic(f.x);
    s.wy = order == 1 ? linear(f.y) : cubic(f.y);
    s.lid = 0.0;
    if (axis == 0) {
        alongAxis(i.x, size.x, s.wx, s.x);
        float beyond = acrossAxis(i.y, size.y, s.wy, s.y);
        if (walls == NO_SLIP) s.lid = 2.0 * lid_speed * beyond * dot(s.wx, vec4(1.0));
    } else {
        acrossAxis(i.x, size.x, s.wx, s.x);
        alongAxis(i.y, size.y, s.wy, s.y);
    }
    return s;
}

float row(sampler2D field, Stencil s, int y, int axis) {
    return dot(s.wx, vec4(texelFetch(field, ivec2(s.x.x, y), 0)[axis], texelFetch(field, ivec2(s.x.y, y), 0)[axis],
                          texelFetch(field, ivec2(s.x.z, y), 0)[axis], texelFetch(field, ivec2(s.x.w, y), 0)[axis]));
}

float cubicAt(sampler2D field, vec2 at, int axis) {
    Stencil s = stencilAt(at, textureSize(field, 0), axis, 3);
    return s.lid + s.wy.x * row(field, s, s.y.x, axis) + s.wy.y * row(field, s, s.y.y, axis)
                 + s.wy.z * row(field, s, s.y.z, axis) + s.wy.w * row(field, s, s.y.w, axis);
}

float linearAt(sampler2D field, vec2 at, int axis) {
    Stencil s = stencilAt(at, textureSize(field, 0), axis, 1);
    return s.lid + s.wy.y * (s.wx.y * texelFetch(field, ivec2(s.x.y, s.y.y), 0)[axis] + s.wx.z * texelFetch(field, ivec2(s.x.z, s.y.y), 0)[axis])
                 + s.wy.z * (s.wx.y * texelFetch(field, ivec2(s.x.y, s.y.z), 0)[axis] + s.wx.z * texelFetch(field, ivec2(s.x.z, s.y.z), 0)[axis]);
}

// One face by its index, which may lie beyond the walls.
float faceOf(sampler2D field, ivec2 i, int axis) {
    ivec2 size = textureSize(field, 0);
    int n = axis == 0 ? size.x : size.y, m = axis == 0 ? size.y : size.x;
    int along = axis == 0 ? i.x : i.y, other = axis == 0 ? i.y : i.x;
    float sign = 1.0, lid = 0.0;
    if (walls == PERIODIC) {
        along -= n * int(floor(float(along) / float(n)));
        other -= m * int(floor(float(other) / float(m)));
    } else {
        // A reach of more than one box is reflected from wall to wall: the images repeat after two boxes.
        bool beyond = other >= m && other < 2 * m;
        along -= 2 * n * int(floor(float(along) / float(2 * n)));
        other -= 2 * m * int(floor(float(other) / float(2 * m)));
        if (along == n) sign = 0.0;
        if (along > n) {
            along = 2 * n - along;
            sign = -1.0;
        }
        if (other >= m) {
            other = 2 * m - 1 - other;
            if (walls == NO_SLIP) {
                sign = -sign;
                if (axis == 0 && beyond && sign != 0.0) lid = 2.0 * lid_speed;
            }
        }
        along = min(along, n - 1);
    }
    return lid + sign * texelFetch(field, axis == 0 ? ivec2(along, other) : ivec2(other, along), 0)[axis];
}

// The middle of a face.
vec2 faceAt(ivec2 p, int axis) {
    return vec2(p) + (axis == 0 ? vec2(0.0, 0.5) : vec2(0.5, 0.0));
}

// Where what is at `at` was `cells` (a time, in cells per height of velocity) ago; negative: where it will be. By the midpoint
// rule: `here` is the velocity at `at`.
vec2 path(sampler2D velocity, vec2 at, vec2 here, float cells) {
    vec2 middle = at - 0.5 * cells * here;
    return at - cells * vec2(cubicAt(velocity, middle, 0), cubicAt(velocity, middle, 1));
}

// The same with less care.
vec2 quickPath(sampler2D velocity, vec2 at, float cells) {
    vec2 middle = at - 0.5 * cells * vec2(linearAt(velocity, at, 0), linearAt(velocity, at, 1));
    return at - cells * vec2(linearAt(velocity, middle, 0), linearAt(velocity, middle, 1));
}
