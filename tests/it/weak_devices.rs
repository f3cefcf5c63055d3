//! Devices with the least limits: presets draw there what they draw elsewhere, and what exceeds a limit is an error that
//! names it, or an unloaded channel.

use crate::support::*;
use eddy::{
    engine::{BuildOptions, Program},
    gpu::testing::weak_gpu,
    media,
    project::{Input, Media, presets},
};

/// Presets with several targets, meshes, cubemaps, mip levels of 32-bit floats and filtered ones.
const PRESETS: [&str; 5] = ["ssao", "gbuffer-edges", "sky-spheres", "mip-fluid", "particles"];

#[test]
fn presets_draw_the_same_on_a_weak_device() {
    let (Some(weak), Some(gpu)) = (weak_gpu(), gpu()) else { return };
    for name in PRESETS {
        let project = presets::load(name).unwrap().project;
        let picture = |gpu| ran(gpu, &project, (64, 36), 2).read_image().unwrap();
        let (usual, on_weak) = (picture(&gpu), picture(&weak));
        let both = usual.texels.iter().flatten().zip(on_weak.texels.iter().flatten());
        let differences: Vec<f32> = both.map(|(a, b)| (a.clamp(0.0, 1.0) - b.clamp(0.0, 1.0)).abs()).collect();
        let mean = differences.iter().sum::<f32>() / differences.len() as f32;
        assert!(mean < 1e-4, "{name} differs by {mean} in the mean");
    }
}

#[test]
fn pictures_larger_than_the_textures_of_the_device_read_as_black() {
    let Some(weak) = weak_gpu() else { return };
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("wide.png");
    image::RgbImage::from_pixel(5_000, 2, image::Rgb([255; 3])).save(&path).unwrap();
    let text = "void mainImage(out vec4 o, in vec2 p) {
        o = texture(iChannel0, p) + vec4(iChannelResolution[0].xy, 0.0, 0.0);
    }";
    let wide = eddy::project::Channel::new(Input::texture(Media::Picked(path)));
    let project = project(vec![image(text, [Some(wide), None, None, None])]);
    let built = Program::build(&weak, &project, &media::gather(&project, None).0, &BuildOptions::default()).unwrap();
    let warning = &built.diagnostics[0].message;
    assert!(warning.starts_with("channel 0 of Image is black:") && warning.contains("5000x2"), "{warning}");
    let mut engine = eddy::engine::Engine::new(weak, 2, 2).unwrap();
    engine.set_program(built.program).unwrap();
    run(&mut engine, 0, 1);
    assert_eq!(texel(&engine.read_image().unwrap(), 0, 0), [0.0, 0.0, 0.0, 1.0]);
}

#[test]
fn targets_that_the_device_lacks_are_named() {
    let Some(weak) = weak_gpu() else { return };
    let mut ssao = presets::load("ssao").unwrap().project;
    let geometry = ssao.pass_mut(&buffer("geometry")).unwrap();
    geometry.settings.format = eddy::texture::TexelFormat::Rgba32f;
    let (set, _) = media::gather(&ssao, None);
    let error = Program::build(&weak, &ssao, &set, &BuildOptions::default()).err().unwrap().to_string();
    assert!(error.contains("Buffer geometry") && error.contains("40 bytes"), "{error}");
}
