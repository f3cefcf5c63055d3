//! Reads of textures, and derivatives, walker compared with device: bit for bit without filtering, otherwise within the
//! rounding of a device's weights.

use crate::support::{
    walked::{all_pixels, is_same, walk},
    *,
};
use eddy::{
    engine::LevelBy,
    gpu::Gpu,
    project::{Filter, PassSize, Project, TexelFormat, Wrap},
};

/// The texture: 8 x 8 texels of multiples of 1/64, with four different components.
const TEXELS: &str = "void mainImage(out vec4 o, in vec2 p) {
    uint n = (uint(p.x) + 8u * uint(p.y)) * 2654435761u;
    n ^= n >> 13;
    o = vec4(uvec4(n, n >> 6, n >> 12, n >> 18) & 63u) / 64.0;
}";

/// Reads that never filter, whatever the sampler.
const FETCHED: &[&str] = &[
    "texelFetch(iChannel0, ivec2(p) & 7, 0)",
    "texelFetch(iChannel0, ivec2(p) - 4, 0)",
    "texelFetchOffset(iChannel0, ivec2(p) / 3, 0, ivec2(1, 2))",
    "vec4(textureSize(iChannel0, 0), iChannelResolution[0].xy)",
];

/// Filtered reads of the finest level, from -1 to 2 across the texture.
const SAMPLED: &[&str] = &[
    "texture(iChannel0, uv)",
    "texture(iChannel0, vec2(uv.y, -uv.x))",
    "textureLod(iChannel0, uv, 0.0)",
    "textureGrad(iChannel0, uv, vec2(0.01, 0.0), vec2(0.02))",
    "textureProj(iChannel0, vec3(uv * 2.0, 2.0))",
    "textureProj(iChannel0, vec4(uv * -4.0, 3.0, -4.0))",
    "textureProjLod(iChannel0, vec3(uv * 0.5, 0.5), 0.0)",
    "textureOffset(iChannel0, uv, ivec2(1, -2))",
    "textureLodOffset(iChannel0, uv, 0.0, ivec2(-8, 7))",
    "textureGradOffset(iChannel0, uv, vec2(0.01), vec2(0.0), ivec2(3, 3))",
    "textureProjOffset(iChannel0, vec3(uv * 2.0, 2.0), ivec2(-1, 5))",
];

/// Reads of a chain of four levels at explicit levels, whole ones and fractions.
const LEVELS: &[&str] = &[
    "textureLod(iChannel0, uv, 1.0)",
    "textureLod(iChannel0, uv, 1.5)",
    "textureLod(iChannel0, uv, 0.25)",
    "textureLod(iChannel0, uv, 9.0)",
    "textureLod(iChannel0, uv, -3.0)",
    "textureLodOffset(iChannel0, uv, 2.0, ivec2(1, 0))",
    "texelFetch(iChannel0, ivec2(p) & 3, 1)",
    "texelFetch(iChannel0, ivec2(p), 3)",
    "vec4(textureSize(iChannel0, 1), textureSize(iChannel0, 3))",
    "vec4(textureSize(iChannel0, int(uv.x * 9.0)), textureSize(iChannel0, 5 + int(p.x) % 40))",
];

/// Levels computed from derivatives. The lengths are powers of two, so that the level is a whole number, except with a
/// bias.
const CHOSEN: &[&str] = &[
    "texture(iChannel0, p / 32.0 + 0.0171)",
    "texture(iChannel0, p / 4.0 + 0.0313)",
    "texture(iChannel0, vec2(p.x / 64.0 + 0.0077, p.y / 2.0 + 0.0191))",
    "texture(iChannel0, p / 8.0 + 0.0137, 1.0)",
    "textureGrad(iChannel0, uv, vec2(0.25, 0.0), vec2(0.0, 0.5))",
    "textureGrad(iChannel0, uv, vec2(0.0), vec2(0.0))",
];

/// Fractional levels computed from derivatives.
const BETWEEN: &[&str] = &[
    "texture(iChannel0, p / 21.0 + 0.0171)",
    "texture(iChannel0, vec2(p.x / 50.0 + 0.0077, p.y / 5.0 + 0.0191))",
    "texture(iChannel0, p / 13.0 + 0.0137, 0.5)",
    "textureGrad(iChannel0, uv, vec2(0.3, 0.0), vec2(0.0, 0.45))",
];

/// Levels that would differ for another pixel of the quad: an edge crosses some quads.
const OF_QUADS: &[&str] = &[
    "texture(iChannel0, fract((p + p.yx * 0.3) / 9.0 + 0.03))",
    "texture(iChannel0, fract((p - p.yx * 0.7) / 17.0 + 0.11), -1.0)",
];

/// Differences of numbers that both compute without rounding.
const DERIVATIVES: &[&str] = &[
    "vec4(dFdx(p.x * p.x * p.y), dFdy(p.x * p.x * p.y), fwidth(p.x * p.y), fwidth(p.x))",
    "vec4(dFdx(p * p.yx), dFdy(p * p.yx))",
    "fwidth(vec4(p, p.x * p.x, mod(p.x, 3.0)))",
    "vec4(dFdx(texelFetch(iChannel0, ivec2(p) & 7, 0).xy), dFdy(texelFetch(iChannel0, ivec2(p) & 7, 0).zw))",
    "dFdx(dFdy(vec4(p.x * p.y, p.y * p.y * p.x, p)))",
];

/// Returns a project with the texels in buffer A, which buffer B reads.
fn reading((filter, wrap): (Filter, Wrap), expression: &str) -> Project {
    let code = format!("void mainImage(out vec4 o, in vec2 p) {{ vec2 uv = p * 0.1871 - 1.0317; o = {expression}; }}");
    let mut texels = pass(buffer("A"), TEXELS, Default::default());
    texels.settings.size = PassSize::Fixed(8, 8);
    let show = "void mainImage(out vec4 o, in vec2 p) { o = texelFetch(iChannel0, ivec2(p), 0); }";
    project(vec![
        texels,
        pass(buffer("B"), &code, [reads("A", filter, wrap), None, None, None]),
        image(show, [nearest("B"), None, None, None]),
    ])
}

/// Returns the largest difference of a component over 16 x 16 pixels, between one project as drawn and another as
/// walked.
fn largest_difference(gpu: &Gpu, drawn: &Project, walked: &Project) -> f64 {
    difference_by(gpu, drawn, walked, LevelBy::Pixel)
}

/// The same, with levels chosen as on some devices.
fn difference_by(gpu: &Gpu, drawn: &Project, walked: &Project, level_by: LevelBy) -> f64 {
    let (mut engine, own) = (engine(gpu, drawn, (16, 16)), buffer("B"));
    run(&mut engine, 0, 1);
    let (mut read, texels) = (engine.inspect(&own).unwrap(), engine.read(&own).unwrap());
    read.channels.iter_mut().for_each(|texture| texture.level_by = level_by);
    let pixels = all_pixels(read.size);
    let mut largest = 0.0f64;
    for (&(x, y), value) in pixels.iter().zip(walk(walked, &own, &read, &pixels)) {
        for (a, b) in value.expect("no pixel is discarded").into_iter().zip(texel(&texels, x, y)) {
            let difference = if is_same(a, b) { 0.0 } else { (f64::from(a) - f64::from(b)).abs() };
            largest = if difference.is_nan() { f64::INFINITY } else { largest.max(difference) };
        }
    }
    largest
}

/// Checks all expressions with these samplers: reports those that differ by more than `bound`, and the largest
/// difference.
fn check(gpu: &Gpu, filters: &[Filter], expressions: &[&str], bound: f64) {
    let (mut wrong, mut largest) = (Vec::new(), 0.0f64);
    for &filter in filters {
        for wrap in [Wrap::Clamp, Wrap::Repeat] {
            for expression in expressions {
                let project = reading((filter, wrap), expression);
                let difference = largest_difference(gpu, &project, &project);
                largest = largest.max(difference);
                if difference > bound {
                    wrong.push(format!("{difference} with {filter:?}, {wrap:?}: {expression}"));
                }
            }
        }
    }
    println!("at most {largest}, that is {} of 1/256, of {filters:?}", largest * 256.0);
    assert!(wrong.is_empty(), "more than {bound}:\n{}", wrong.join("\n"));
}

/// Returns the allowed difference of filtered texels below 1. Vulkan devices report the number of bits of their weights
/// (`subTexelPrecisionBits` and `mipmapPrecisionBits`, at least 4; GPUs report 8), for each of two axes and for levels.
/// lavapipe reports 8 too, but filters float textures in floats: only the rounding of coordinates remains.
fn bound(gpu: &Gpu, weights: f64) -> f64 {
    if gpu.info.device_type == wgpu::DeviceType::Cpu { 4e-6 } else { weights / 256.0 }
}

const ALL: [Filter; 3] = [Filter::Nearest, Filter::Linear, Filter::Mipmap];

#[test]
fn texels_and_derivatives_match_bit_for_bit() {
    let Some(gpu) = gpu() else { return };
    check(&gpu, &ALL, FETCHED, 0.0);
    check(&gpu, &ALL[..1], SAMPLED, 0.0);
    check(&gpu, &ALL[..1], DERIVATIVES, 0.0);
}

#[test]
fn filtered_texels_are_within_the_precision_of_weights() {
    let Some(gpu) = gpu() else { return };
    check(&gpu, &ALL[1..2], SAMPLED, bound(&gpu, 2.0));
}

#[test]
fn levels_are_within_the_precision_of_weights() {
    let Some(gpu) = gpu() else { return };
    check(&gpu, &ALL[2..], LEVELS, bound(&gpu, 3.0));
    check(&gpu, &ALL[2..], CHOSEN, bound(&gpu, 3.0));
}

/// llvmpipe computes levels per quad, with a piecewise linear logarithm.
#[test]
fn fractional_levels_match_the_device() {
    let Some(gpu) = gpu() else { return };
    let is_cpu = gpu.info.device_type == wgpu::DeviceType::Cpu;
    let mut largest_by_pixel = 0.0f64;
    for expression in BETWEEN.iter().chain(OF_QUADS.iter().filter(|_| is_cpu)) {
        let project = reading((Filter::Mipmap, Wrap::Repeat), expression);
        let [pixel, quad] = [LevelBy::Pixel, LevelBy::Quad].map(|by| difference_by(&gpu, &project, &project, by));
        let (difference, limit) = if is_cpu { (quad, 4e-6) } else { (pixel, 3.0 / 256.0) };
        assert!(difference <= limit, "{difference}: {expression}");
        largest_by_pixel = largest_by_pixel.max(pixel);
    }
    assert!(!is_cpu || largest_by_pixel > 1e-3, "{largest_by_pixel}: the test does not distinguish the two");
}

/// For 8-bit textures llvmpipe, on which lavapipe is based, filters in 8 bits: weights and the results of each of three
/// steps are truncated to 8 bits.
#[test]
fn texels_of_8_bits_are_mixed_in_8_bits() {
    let Some(gpu) = gpu() else { return };
    let mut largest = 0.0f64;
    for expression in SAMPLED {
        let mut project = reading((Filter::Linear, Wrap::Repeat), expression);
        project.passes[0].settings.format = TexelFormat::Rgba8;
        largest = largest.max(largest_difference(&gpu, &project, &project));
    }
    println!("at most {} of 1/255", largest * 255.0);
    assert!(largest <= 3.0 / 255.0, "{largest}");
}

/// The control: a neighbouring texel, and a weight with a larger error than a device may have, are detected.
#[test]
fn a_wrong_texel_and_a_wrong_weight_are_detected() {
    let Some(gpu) = gpu() else { return };
    let difference = |filter, drawn: &str, walked: &str| {
        let [drawn, walked] = [drawn, walked].map(|expression| reading((filter, Wrap::Repeat), expression));
        largest_difference(&gpu, &drawn, &walked)
    };
    assert!(difference(Filter::Nearest, "texture(iChannel0, uv)", "textureOffset(iChannel0, uv, ivec2(1, 0))") > 0.5);
    // A twentieth of a texel.
    assert!(
        difference(Filter::Linear, "texture(iChannel0, uv)", "texture(iChannel0, uv + vec2(0.05 / 8.0, 0.0))")
            > 2.0 / 256.0
    );
}
