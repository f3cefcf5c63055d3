//! Reads of textures, and derivatives, by the walker against the device: bit for bit where no texels are mixed, else
//! within what a device may round of the weights.

use crate::support::{
    walked::{all_pixels, is_same, walk},
    *,
};
use eddy::{
    engine::LevelBy,
    gpu::Gpu,
    project::{Filter, PassSize, Project, TexelFormat, Wrap},
};

/// What is read: 8 x 8 texels of whole 64ths, all four components apart.
const TEXELS: &str = "void mainImage(out vec4 o, in vec2 p) {
    uint n = (uint(p.x) + 8u * uint(p.y)) * 2654435761u;
    n ^= n >> 13;
    o = vec4(uvec4(n, n >> 6, n >> 12, n >> 18) & 63u) / 64.0;
}";

/// Texels of these are never mixed, whatever the sampler.
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

/// Reads of a chain of four levels at levels that are given, whole ones and between.
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

/// Levels that follow from derivatives. The lengths are powers of two, so that the level is a whole number but where a
/// bias says otherwise.
const CHOSEN: &[&str] = &[
    "texture(iChannel0, p / 32.0 + 0.0171)",
    "texture(iChannel0, p / 4.0 + 0.0313)",
    "texture(iChannel0, vec2(p.x / 64.0 + 0.0077, p.y / 2.0 + 0.0191))",
    "texture(iChannel0, p / 8.0 + 0.0137, 1.0)",
    "textureGrad(iChannel0, uv, vec2(0.25, 0.0), vec2(0.0, 0.5))",
    "textureGrad(iChannel0, uv, vec2(0.0), vec2(0.0))",
];

/// Levels whose fraction follows from derivatives.
const BETWEEN: &[&str] = &[
    "texture(iChannel0, p / 21.0 + 0.0171)",
    "texture(iChannel0, vec2(p.x / 50.0 + 0.0077, p.y / 5.0 + 0.0191))",
    "texture(iChannel0, p / 13.0 + 0.0137, 0.5)",
    "textureGrad(iChannel0, uv, vec2(0.3, 0.0), vec2(0.0, 0.45))",
];

/// Levels that another pixel of the quad would have otherwise: an edge goes through some quads.
const OF_QUADS: &[&str] = &[
    "texture(iChannel0, fract((p + p.yx * 0.3) / 9.0 + 0.03))",
    "texture(iChannel0, fract((p - p.yx * 0.7) / 17.0 + 0.11), -1.0)",
];

/// Differences of numbers that both have without rounding.
const DERIVATIVES: &[&str] = &[
    "vec4(dFdx(p.x * p.x * p.y), dFdy(p.x * p.x * p.y), fwidth(p.x * p.y), fwidth(p.x))",
    "vec4(dFdx(p * p.yx), dFdy(p * p.yx))",
    "fwidth(vec4(p, p.x * p.x, mod(p.x, 3.0)))",
    "vec4(dFdx(texelFetch(iChannel0, ivec2(p) & 7, 0).xy), dFdy(texelFetch(iChannel0, ivec2(p) & 7, 0).zw))",
    "dFdx(dFdy(vec4(p.x * p.y, p.y * p.y * p.x, p)))",
];

/// A buffer A with the texels, and a buffer B that reads it.
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

/// The largest difference of a component over 16 x 16 pixels, between what is drawn of one project and what is walked
/// of another.
fn apart(gpu: &Gpu, drawn: &Project, walked: &Project) -> f64 {
    apart_by(gpu, drawn, walked, LevelBy::Pixel)
}

/// The same, with levels as some device takes them.
fn apart_by(gpu: &Gpu, drawn: &Project, walked: &Project, level_by: LevelBy) -> f64 {
    let (mut engine, own) = (engine(gpu, drawn, (16, 16)), buffer("B"));
    run(&mut engine, 0, 1);
    let (mut read, texels) = (engine.inspect(&own).unwrap(), engine.read(&own).unwrap());
    read.channels.iter_mut().for_each(|texture| texture.level_by = level_by);
    let pixels = all_pixels(read.size);
    let mut most = 0.0f64;
    for (&(x, y), value) in pixels.iter().zip(walk(walked, &own, &read, &pixels)) {
        for (a, b) in value.expect("nothing is discarded").into_iter().zip(texel(&texels, x, y)) {
            let by = if is_same(a, b) { 0.0 } else { (f64::from(a) - f64::from(b)).abs() };
            most = if by.is_nan() { f64::INFINITY } else { most.max(by) };
        }
    }
    most
}

/// All expressions by these samplers: those that are further apart than `bound`, and what is furthest.
fn check(gpu: &Gpu, filters: &[Filter], expressions: &[&str], bound: f64) {
    let (mut wrong, mut most) = (Vec::new(), 0.0f64);
    for &filter in filters {
        for wrap in [Wrap::Clamp, Wrap::Repeat] {
            for expression in expressions {
                let project = reading((filter, wrap), expression);
                let by = apart(gpu, &project, &project);
                most = most.max(by);
                if by > bound {
                    wrong.push(format!("{by} with {filter:?}, {wrap:?}: {expression}"));
                }
            }
        }
    }
    println!("at most {most}, that is {} of 1/256, of {filters:?}", most * 256.0);
    assert!(wrong.is_empty(), "more than {bound}:\n{}", wrong.join("\n"));
}

/// What mixed texels of less than 1 may be off by. Vulkan has devices say how many bits their weights have
/// (`subTexelPrecisionBits` and `mipmapPrecisionBits`, 4 at least; GPUs say 8), of each of two axes and of levels.
/// lavapipe says 8 too, but filters textures of floats by floats: what is left is the rounding of coordinates.
fn bound(gpu: &Gpu, weights: f64) -> f64 {
    if gpu.info.device_type == wgpu::DeviceType::Cpu { 4e-6 } else { weights / 256.0 }
}

const ALL: [Filter; 3] = [Filter::Nearest, Filter::Linear, Filter::Mipmap];

#[test]
fn texels_and_derivatives_are_the_same_bits() {
    let Some(gpu) = gpu() else { return };
    check(&gpu, &ALL, FETCHED, 0.0);
    check(&gpu, &ALL[..1], SAMPLED, 0.0);
    check(&gpu, &ALL[..1], DERIVATIVES, 0.0);
}

#[test]
fn mixed_texels_are_within_the_precision_of_weights() {
    let Some(gpu) = gpu() else { return };
    check(&gpu, &ALL[1..2], SAMPLED, bound(&gpu, 2.0));
}

#[test]
fn levels_are_within_the_precision_of_weights() {
    let Some(gpu) = gpu() else { return };
    check(&gpu, &ALL[2..], LEVELS, bound(&gpu, 3.0));
    check(&gpu, &ALL[2..], CHOSEN, bound(&gpu, 3.0));
}

/// llvmpipe's levels are those of whole quads, and its logarithm is made of lines.
#[test]
fn levels_between_two_are_as_the_device_takes_them() {
    let Some(gpu) = gpu() else { return };
    let is_cpu = gpu.info.device_type == wgpu::DeviceType::Cpu;
    let mut apart_otherwise = 0.0f64;
    for expression in BETWEEN.iter().chain(OF_QUADS.iter().filter(|_| is_cpu)) {
        let project = reading((Filter::Mipmap, Wrap::Repeat), expression);
        let [pixel, quad] = [LevelBy::Pixel, LevelBy::Quad].map(|by| apart_by(&gpu, &project, &project, by));
        let (own, most) = if is_cpu { (quad, 4e-6) } else { (pixel, 3.0 / 256.0) };
        assert!(own <= most, "{own}: {expression}");
        apart_otherwise = apart_otherwise.max(pixel);
    }
    assert!(!is_cpu || apart_otherwise > 1e-3, "{apart_otherwise}: the two are not told apart");
}

/// Of textures of 8 bits llvmpipe, which lavapipe draws by, gives filtered values of 8 bits: weights and the results of
/// each of three steps are cut to them.
#[test]
fn texels_of_8_bits_are_mixed_in_8_bits() {
    let Some(gpu) = gpu() else { return };
    let mut most = 0.0f64;
    for expression in SAMPLED {
        let mut project = reading((Filter::Linear, Wrap::Repeat), expression);
        project.passes[0].settings.format = TexelFormat::Rgba8;
        most = most.max(apart(&gpu, &project, &project));
    }
    println!("at most {} of 1/255", most * 255.0);
    assert!(most <= 3.0 / 255.0, "{most}");
}

/// The control: a texel beside the right one, and a weight that is off by more than a device may be, are seen.
#[test]
fn a_wrong_texel_and_a_wrong_weight_are_seen() {
    let Some(gpu) = gpu() else { return };
    let seen = |filter, drawn: &str, walked: &str| {
        let [drawn, walked] = [drawn, walked].map(|expression| reading((filter, Wrap::Repeat), expression));
        apart(&gpu, &drawn, &walked)
    };
    assert!(seen(Filter::Nearest, "texture(iChannel0, uv)", "textureOffset(iChannel0, uv, ivec2(1, 0))") > 0.5);
    // A twentieth of a texel.
    assert!(
        seen(Filter::Linear, "texture(iChannel0, uv)", "texture(iChannel0, uv + vec2(0.05 / 8.0, 0.0))") > 2.0 / 256.0
    );
}
