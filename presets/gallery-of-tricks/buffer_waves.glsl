// Waves on water: x height, y its change a frame; z is Buffer noise, handed on to Image, whose
// four channels are taken. Left half in hard walls, right half in soft ones. Channel 0 is this buffer
// in the last frame. Leapfrog on the five-point Laplacian, stable while (speed in texels a frame)^2 <= 1/2.

#iUniform float softness = 0.12 in { 0.0, 0.5 } // what the outermost texel takes from a wave in a frame
#iUniform float layer = 18.0 in { 1.0, 40.0 }   // texels that take something

const float SPEED2 = 0.35;

int half_;

vec2 cell(ivec2 p, int side) {
    // the wall mirrors: the cell beyond it is the cell before it
    p.x = clamp(p.x, side * half_, side * half_ + half_ - 1);
    p.y = clamp(p.y, 0, int(iResolution.y) - 1);
    vec4 q = texelFetch(iChannel0, p, 0);
    return isFinite(q) ? q.xy : vec2(0.0);
}

void mainImage(out vec4 water, in vec2 fragCoord) {
    ivec2 p = ivec2(fragCoord);
    half_ = int(iResolution.x) / 2;
    int side = p.x < half_ ? 0 : 1, frame = iFrame % restart;
    vec2 q = cell(p, side);
    float around = cell(p - ivec2(1, 0), side).x + cell(p + ivec2(1, 0), side).x + cell(p - ivec2(0, 1), side).x
        + cell(p + ivec2(0, 1), side).x;
    q.y += SPEED2 * (around - 4.0 * q.x);
    q.x += q.y;

    vec2 local = vec2(p.x - side * half_, p.y) + 0.5, size = vec2(half_, iResolution.y);
    if (frame % 150 == 10) { // a drop, of no net volume
        float k = floor(float(frame) / 150.0);
        vec2 d = (local - size * (0.35 + 0.3 * vec2(hash(vec2(k, 5.0)), hash(vec2(k, 6.0))))) / 4.0;
        q.x += (1.0 - dot(d, d)) * exp(-dot(d, d));
    }
    if (side == 1) {
        float near = 1.0 - min(min(min(local.x, local.y), min(size.x - local.x, size.y - local.y)) / layer, 1.0);
        q *= 1.0 - softness * near * near; // grows slowly: a sudden layer would itself be a wall
    }
    water = vec4(frame == 0 ? vec2(0.0) : q, texelFetch(iChannel1, p, 0).x, 1.0);
}
