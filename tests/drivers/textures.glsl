// Small programs, each file of one after a line `//= NAME`: reads of textures, derivatives, and ray marching. See docs/drivers.md.
// None depends on what the language leaves open, or on the last bits of a float.

//= texel_fetch/buffer_a.glsl
#iChannel0 "self"
void mainImage(out vec4 o, in vec2 p) {
    ivec2 at = ivec2(p), size = textureSize(iChannel0, 0);
    vec4 old = texelFetch(iChannel0, (at + ivec2(3, 1)) % size, 0);
    o = iFrame == 0 ? vec4(p / iResolution.xy, 0.0, 1.0) : vec4(old.yx, old.z + 0.1, 1.0);
}

//= texel_fetch/image.glsl
#iChannel0 "buffer_a"
void mainImage(out vec4 o, in vec2 p) { o = texelFetch(iChannel0, ivec2(p), 0); }

//= feedback_average/buffer_a.glsl
#iChannel0 "self"
#iChannel0::MinFilter "Linear"
#iChannel0::MagFilter "Linear"
#iChannel0::WrapMode "Clamp"
void mainImage(out vec4 o, in vec2 p) {
    vec2 u = p / iResolution.xy, d = 1.0 / iResolution.xy;
    vec4 old = (texture(iChannel0, u + d) + texture(iChannel0, u - d)) * 0.5;
    o = mix(old, vec4(distance(p, vec2(20, 18)) < 8.3 ? 1.0 : 0.0, u.x, 0.3, 1.0), 0.3);
}

//= feedback_average/image.glsl
#iChannel0 "buffer_a"
void mainImage(out vec4 o, in vec2 p) { o = texelFetch(iChannel0, ivec2(p), 0); }

//= texture_bias/buffer_a.glsl
#iChannel0 "self"
#iChannel0::MinFilter "LinearMipMapLinear"
void mainImage(out vec4 o, in vec2 p) {
    if (iFrame % 2 == 0) { o = vec4(mod(floor(p / 4.0), 2.0), p.x / 64.0, 1.0); return; }
    o = textureLod(iChannel0, p / iResolution.xy, 2.0) * 0.5 + 0.5 * textureLod(iChannel0, p / iResolution.xy, 0.0);
}

//= texture_bias/image.glsl
#iChannel0 "buffer_a"
void mainImage(out vec4 o, in vec2 p) { o = texelFetch(iChannel0, ivec2(p), 0); }

//= texture_gradients/buffer_a.glsl
#iChannel0 "self"
#iChannel0::MinFilter "LinearMipMapLinear"
#iChannel0::WrapMode "Repeat"
void mainImage(out vec4 o, in vec2 p) {
    vec2 u = p / iResolution.xy;
    if (iFrame == 0) { o = vec4(0.5 + 0.5 * sin(u * 12.0), u.x, 1.0); return; }
    o = textureGrad(iChannel0, u * 2.0, vec2(4.0 / 64.0, 0), vec2(0, 4.0 / 36.0)) * 0.9 + 0.05;
}

//= texture_gradients/image.glsl
#iChannel0 "buffer_a"
void mainImage(out vec4 o, in vec2 p) { o = texelFetch(iChannel0, ivec2(p), 0); }

//= screen_derivatives.glsl
void mainImage(out vec4 o, in vec2 p) {
    float f = p.x * p.x / 100.0 + p.y;
    o = vec4(dFdx(p.x * 0.5), dFdy(p.y * 0.25), fwidth(p.x + p.y) / 4.0, 1.0);
    o.r += dFdx(float(int(p.x) / 2)) * 0.0 + f * 0.005;
}

//= antialiased_circle.glsl
void mainImage(out vec4 o, in vec2 p) {
    float d = distance(p, iResolution.xy * 0.5) - 11.0, w = fwidth(p.x);
    o = vec4(vec3(1.0 - smoothstep(-w, w, d)), 1.0);
}

//= sphere_march.glsl
void mainImage(out vec4 o, in vec2 p) {
    vec3 at = vec3(0, 0, -3), ray = normalize(vec3((p - 0.5 * iResolution.xy) / iResolution.y, 1.0));
    float t = 0.0;
    for (int i = 0; i < 60; i++) {
        float d = min(length(at + ray * t) - 1.0, at.y + ray.y * t + 1.0);
        t += d;
        if (d < 1e-3 || t > 20.0) break;
    }
    o = vec4(vec3(exp(-0.2 * t)), 1.0);
}

//= mandelbrot.glsl
void mainImage(out vec4 o, in vec2 p) {
    // Few rounds: more of them would show the last bits.
    vec2 c = (p - vec2(42, 18)) / 16.0, z = vec2(0);
    int n = 0;
    for (; n < 6; n++) {
        z = vec2(z.x * z.x - z.y * z.y, 2.0 * z.x * z.y) + c;
        if (dot(z, z) > 16.0) break;
    }
    o = vec4(vec3(float(n) / 6.0), 1.0);
}

//= value_noise.glsl
float at(ivec2 i) { uint h = uint(i.x) * 374761393u + uint(i.y) * 668265263u; h = (h ^ (h >> 13)) * 1274126177u; return float(h >> 8) / 16777216.0; }
float noise(vec2 p) {
    ivec2 i = ivec2(floor(p));
    vec2 f = fract(p);
    f = f * f * (3.0 - 2.0 * f);
    return mix(mix(at(i), at(i + ivec2(1, 0)), f.x), mix(at(i + ivec2(0, 1)), at(i + 1), f.x), f.y);
}
void mainImage(out vec4 o, in vec2 p) {
    float sum = 0.0, weight = 0.5;
    mat2 turn = mat2(0.8, 0.6, -0.6, 0.8);
    vec2 q = p / 9.0 + 0.01;
    for (int i = 0; i < 4; i++) { sum += weight * noise(q); q = turn * q * 2.0; weight *= 0.5; }
    o = vec4(sum, sum * sum, sqrt(sum), 1.0);
}

//= voronoi.glsl
void mainImage(out vec4 o, in vec2 p) {
    vec2 q = p / 9.0;
    float near = 9.0;
    for (int y = -1; y <= 1; y++)
        for (int x = -1; x <= 1; x++) {
            ivec2 cell = ivec2(floor(q)) + ivec2(x, y);
            vec2 at = vec2(cell) + vec2((cell * ivec2(7, 13) + cell.yx * ivec2(5, 3)) & 15) / 16.0;
            near = min(near, distance(q, at));
        }
    o = vec4(vec3(near), 1.0);
}

//= game_of_life/buffer_a.glsl
#iChannel0 "self"
void mainImage(out vec4 o, in vec2 p) {
    ivec2 at = ivec2(p), size = ivec2(iResolution.xy);
    if (iFrame == 0) { o = vec4(vec3((at.x * 7 + at.y * 11 + at.x * at.y) % 5 < 2 ? 1.0 : 0.0), 1.0); return; }
    int n = 0;
    for (int y = -1; y <= 1; y++)
        for (int x = -1; x <= 1; x++) n += int(texelFetch(iChannel0, (at + ivec2(x, y) + size) % size, 0).r > 0.5);
    bool alive = texelFetch(iChannel0, at, 0).r > 0.5;
    o = vec4(vec3(n == 3 || alive && n == 4 ? 1.0 : 0.0), 1.0);
}

//= game_of_life/image.glsl
#iChannel0 "buffer_a"
void mainImage(out vec4 o, in vec2 p) { o = texelFetch(iChannel0, ivec2(p), 0); }

//= time_palette.glsl
void mainImage(out vec4 o, in vec2 p) {
    vec3 c = 0.5 + 0.5 * cos(iTime * 30.0 + (p / iResolution.xy).xyx * 3.0 + vec3(0, 2, 4));
    o = vec4(pow(c, vec3(1.0 / 2.2)), 1.0);
}
