//! Reads of channels without an input, or whose media are missing: one opaque black texel, as in WebGL, while a buffer
//! without a pass is a texture of zeros. Drawn by the device, and walked.

use crate::support::{gpu, meshes, program::Bench, walked::assert_walked, *};
use eddy::project::{Channel, Input, InputKind, Media, PassName, Project, Sampler};

const OPAQUE: [f32; 4] = [0.0, 0.0, 0.0, 1.0];
const ZERO: [f32; 4] = [0.0; 4];

/// Reads of a two-dimensional texture.
const READS: &[(&str, [f32; 4])] = &[
    ("texture(iChannel0, vec2(0.3, 0.7))", OPAQUE),
    ("texture(iChannel0, p * 40.0, 2.0)", OPAQUE),
    ("textureLod(iChannel0, vec2(-3.0, 9.0), 4.0)", OPAQUE),
    ("textureGrad(iChannel0, p, vec2(1.0), vec2(0.5))", OPAQUE),
    ("textureProj(iChannel0, vec3(p, 2.0))", OPAQUE),
    ("textureOffset(iChannel0, p, ivec2(1, -1))", OPAQUE),
    ("texelFetch(iChannel0, ivec2(0), 0)", OPAQUE),
    ("texelFetch(iChannel0, ivec2(1, 0), 0)", ZERO),
    ("texelFetch(iChannel0, ivec2(0, -1), 0)", ZERO),
    ("texelFetchOffset(iChannel0, ivec2(0), 0, ivec2(3, 0))", ZERO),
    ("vec4(textureSize(iChannel0, 0), iChannelResolution[0].xy)", [1.0, 1.0, 0.0, 0.0]),
    ("vec4(textureSize(iChannel0, 1), textureSize(iChannel0, 40 + int(p.x)))", [1.0; 4]),
];

/// Reads of a volume, and of a cubemap.
const DEEP_READS: &[&str] = &[
    "texture(iChannel0, vec3(0.3, 0.7, -2.0))",
    "textureLod(iChannel0, vec3(p, 1.0), 2.0)",
    "textureGrad(iChannel0, vec3(p, 1.0), vec3(1.0), vec3(0.5))",
];

/// Returns inputs without a texture. The engine gets no media here, so files are missing too; without a file music
/// still has a spectrum, and a webcam without a camera has the same size as on Shadertoy.
fn planes() -> Vec<Option<Input>> {
    let file = || Media::File("nowhere".into());
    let inputs = [Input::Media { kind: InputKind::Video, media: file() }, Input::texture(file())];
    [None].into_iter().chain(inputs.map(Some)).collect()
}

/// Returns a project whose buffer B is a single expression that reads channel 0.
fn reading(input: Option<Input>, expression: &str) -> Project {
    let code = format!("void mainImage(out vec4 o, in vec2 p) {{ o = {expression}; }}");
    let channel = input.map(|input| Channel { input, sampler: Sampler::TEXTURE });
    let show = "void mainImage(out vec4 o, in vec2 p) { o = texelFetch(iChannel0, ivec2(p), 0); }";
    project(vec![pass(buffer("B"), &code, [channel, None, None, None]), image(show, [nearest("B"), None, None, None])])
}

/// Draws and walks the expression, and checks both results.
#[track_caller]
fn check(input: Option<Input>, expression: &str, expected: [f32; 4]) {
    let Some(gpu) = gpu() else { return };
    let project = reading(input.clone(), expression);
    let mut engine = ran(&gpu, &project, (4, 4), 1);
    assert_eq!(texel(&engine.read(&buffer("B")).unwrap(), 2, 1), expected, "{expression} of {input:?}");
    assert_walked(&mut engine, &project, &buffer("B"));
}

#[test]
fn a_channel_without_a_texture_reads_as_one_opaque_black_texel() {
    for input in planes() {
        READS.iter().for_each(|(expression, expected)| check(input.clone(), expression, *expected));
    }
    let file = || Media::File("nowhere".into());
    for input in [
        Input::Media { kind: InputKind::Volume, media: file() },
        Input::Media { kind: InputKind::Cubemap, media: file() },
        Input::pass(PassName::cube()),
    ] {
        for read in DEEP_READS {
            // llvmpipe's weights of eight equal texels add up to slightly less than 1.
            check(Some(input.clone()), &format!("floor({read} * 4.0 + 0.5) / 4.0"), OPAQUE);
        }
    }
}

#[test]
fn a_missing_buffer_and_the_frame_before_the_first_are_zeros() {
    for (expression, expected) in [
        ("texture(iChannel0, vec2(0.3, 0.7))", ZERO),
        ("textureLod(iChannel0, vec2(0.3, 0.7), 0.0)", ZERO),
        ("texelFetch(iChannel0, ivec2(1), 0)", ZERO),
        ("texelFetch(iChannel0, ivec2(-1), 0)", ZERO),
        ("vec4(textureSize(iChannel0, 0), iChannelResolution[0].xy)", [4.0; 4]),
    ] {
        for name in ["C", "B"] {
            check(Some(Input::buffer(name)), expression, expected);
        }
    }
}

#[test]
fn vertex_stages_read_a_channel_without_a_texture_alike() {
    let Some(gpu) = gpu() else { return };
    let vertex = "in vec3 aPosition; out vec4 read; void main() { read = textureLod(iChannel0, aPosition.xy, 0.0) * \
                  vec4(1.0, 1.0, 1.0, 0.5) + texelFetch(iChannel1, ivec2(0), 0) * vec4(1.0, 1.0, 1.0, 0.25); \
                  gl_Position = vec4(aPosition.xy * 9.0, 0.0, 1.0); }";
    let fragment = "in vec4 read; layout(location = 0) out vec4 o; void main() { o = read; }";
    let mut draw = meshes::draw("builtin:cube");
    draw.cull = eddy::project::Cull::None;
    let project = meshes::whole(meshes::scene(fragment, &[vertex], 1, meshes::straight(), vec![draw]));
    let mut engine = ran(&gpu, &project, (4, 4), 1);
    assert_eq!(texel(&engine.read(&buffer("scene")).unwrap(), 2, 2), [0.0, 0.0, 0.0, 0.75]);
    assert_walked(&mut engine, &project, &buffer("scene"));
}

#[test]
fn trace_and_render_agree_about_a_missing_image_file() {
    let Some(b) = Bench::with_gpu() else { return };
    b.write("w/eddy.toml", "[passes.image]\nchannels.0 = { file = \"gone.png\" }\nchannels.1 = { webcam = true }\n");
    b.image(
        "w/image.glsl",
        "fragColor = vec4(texture(iChannel0, fragCoord).a, texture(iChannel1, fragCoord).a, \
         texelFetch(iChannel2, ivec2(0), 0).a, 1.0);",
    );
    let line = b.line("trace w --pixel 1,1 --size 4x4 --json").expect(0).json().remove(0);
    assert_eq!(line["value"], serde_json::json!([1.0, 1.0, 1.0, 1.0]), "{line}");
    assert_eq!(line["device"], line["value"], "{line}");
    b.line("render w --size 4x4 --out w.png").expect(0);
    assert_eq!(b.png("w.png").get_pixel(0, 0).0, [255; 4]);
}
