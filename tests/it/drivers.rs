//! Other drivers than the machine's own: OpenGL, and SwiftShader where Chromium has brought it. `scripts/drivers` draws
//! all presets and many programs on them; these are the ones that such drivers once drew wrongly.

use crate::support::{display::Display, gpu, program::*, skipped};
use eddy::{
    gpu::{FloatConverter, Gpu, MipMaker, Readback, Texture, TextureDescriptor, TextureShape, testing},
    texture::TexelFormat,
};
use std::path::{Path, PathBuf};

/// Projects with cubemaps and their mips, a pass that draws a cubemap, a volume, targets of 32-bit floats, and meshes.
const PROJECTS: [&str; 5] =
    ["toml-builtin-textures", "toml-cubemap-file", "toml-cube", "toml-format-rgba32f", "mesh-state"];
/// The mean difference of a colour in steps of 1/255, and the share of pixels that differ by more than 8 steps: as in
/// `scripts/drivers`.
const MEAN: f64 = 0.5;
const SHARE: f64 = 0.005;

/// The programs of `scripts/drivers` compile, and are as many as it promises together with the saved projects.
#[test]
fn programs_of_the_matrix_compile() {
    let b = Bench::new();
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests");
    for file in std::fs::read_dir(root.join("drivers")).unwrap() {
        let text = std::fs::read_to_string(file.unwrap().path()).unwrap();
        for part in text.split("\n//= ").skip(1) {
            let (name, text) = part.split_once('\n').unwrap();
            b.write(&format!("programs/{name}"), text);
        }
    }
    let names = b.names("programs");
    assert!(names.len() + std::fs::read_dir(root.join("saved/projects")).unwrap().count() > 100, "{names:?}");
    b.eddy(["check".into()].into_iter().chain(names.iter().map(|name| format!("programs/{name}")))).expect(0);
}

/// Draws the projects with an environment.
fn draw(bench: &Bench, out: &str, environment: &[(&str, &Path)]) -> Vec<image::RgbaImage> {
    let saved = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/saved/projects");
    let mut command = bench.command();
    command.arg("render").args(PROJECTS.map(|name| saved.join(name)));
    // An odd size: no pixel's centre is on the edge between two texels of a picture.
    command.args(["--size", "61x37", "--frames", "3", "--out", out]).envs(environment.iter().copied());
    run(&mut command).expect(0);
    PROJECTS.iter().map(|name| bench.png(&format!("{out}/{name}.png"))).collect()
}

#[track_caller]
fn assert_same(pictures: &[image::RgbaImage], reference: &[image::RgbaImage]) {
    for ((name, one), two) in PROJECTS.iter().zip(pictures).zip(reference) {
        let differences: Vec<u8> = one.as_raw().iter().zip(two.as_raw()).map(|(a, b)| a.abs_diff(*b)).collect();
        let mean = differences.iter().map(|d| f64::from(*d)).sum::<f64>() / differences.len() as f64;
        let far = differences.chunks_exact(4).filter(|pixel| pixel.iter().any(|d| *d > 8)).count();
        let share = far as f64 * 4.0 / differences.len() as f64;
        assert!(mean <= MEAN && share <= SHARE, "{name}: mean {mean}, {share} of the pixels");
    }
}

/// Returns the manifest of SwiftShader, or counts a skipped test.
fn swiftshader(bench: &Bench) -> Option<PathBuf> {
    let library = "/usr/lib/chromium/libvk_swiftshader.so";
    if !Path::new(library).exists() {
        skipped("Chromium's SwiftShader is not installed");
        return None;
    }
    let driver = serde_json::json!({ "library_path": library, "api_version": "1.3.0" });
    bench.write("swiftshader.json", serde_json::json!({ "file_format_version": "1.0.0", "ICD": driver }).to_string());
    Some(bench.path("swiftshader.json"))
}

#[test]
fn opengl_draws_cubemaps_and_float_targets_as_the_other_drivers() {
    let (Some(_), Some(_)) = (gpu(), testing::opengl()) else { return };
    let b = Bench::new();
    let reference = draw(&b, "usual", &[]);
    assert_same(&draw(&b, "opengl", &[("WGPU_BACKEND", Path::new("gl"))]), &reference);
}

/// SwiftShader compiles in this process: a pass that takes it too long is rejected.
#[test]
fn swiftshader_draws_the_same_and_its_compiler_has_a_time_limit() {
    let b = Bench::new();
    let (Some(_), Some(manifest)) = (gpu(), swiftshader(&b)) else { return };
    let environment: [(&str, &Path); 1] = [("VK_ICD_FILENAMES", &manifest)];
    assert_same(&draw(&b, "swiftshader", &environment), &draw(&b, "usual", &[]));
    let lines: String = (0..2_000).map(|i| format!("a = a * 1.{} + sin(a);\n", i % 7 + 1)).collect();
    b.image("long.glsl", &format!("float a = fragCoord.x;\n{lines}fragColor = vec4(a);"));
    let args = "render long.glsl --size 8x8 --compile-timeout 0.1 --out long.png --json";
    let run = run(b.command().envs(environment).args(args.split(' '))).expect(1);
    let message = run.json()[0]["diagnostics"][0]["message"].to_string();
    assert!(message.contains("more than 0.1 s of CPU time"), "{message}");
}

/// A window for which neither Vulkan nor OpenGL has a device: the error names both, and what can be done.
#[test]
fn a_window_without_a_device_says_why_each_was_not_taken() {
    let b = Bench::new();
    let Some(manifest) = swiftshader(&b) else { return };
    let Some(display) = Display::open() else { return };
    let mut command = b.command();
    command.env("DISPLAY", display.name()).env_remove("WAYLAND_DISPLAY").env("VK_ICD_FILENAMES", &manifest);
    // EGL without a vendor has no OpenGL.
    command.env("__EGL_VENDOR_LIBRARY_FILENAMES", b.path("none.json")).arg("feedback");
    let error = run(&mut command).expect(2).err;
    assert!(error.contains("SwiftShader") && error.contains("(vulkan) cannot draw on this window"), "{error}");
    assert!(error.contains("no device for OpenGL"), "{error}");
    assert!(error.contains("eddy render") && error.contains("mesa-vulkan-drivers"), "{error}");
}

fn cube(gpu: &Gpu, shape: TextureShape) -> Texture {
    Texture::new(gpu, &TextureDescriptor { label: "cube", shape, is_target: true }).unwrap()
}

/// Returns all that is read of faces: the bytes of a cube, those of a larger and a smaller one that it was copied
/// into, and the floats of each level of each face.
fn read(gpu: &Gpu) -> (Vec<Vec<u8>>, Vec<Vec<[f32; 4]>>) {
    let shape = TextureShape::cube(8, TexelFormat::Rgba8).with_mips();
    let whole = cube(gpu, shape);
    let texels = 6 * 8 * 8 * 4;
    whole.write(gpu, &(0..texels).map(|i: u32| (i.wrapping_mul(2_654_435_761) >> 24) as u8).collect::<Vec<_>>());
    let mut mips = MipMaker::new(gpu);
    let chain = mips.chain(gpu, &whole).unwrap();
    let copies = [12, 5].map(|side| cube(gpu, TextureShape::cube(side, TexelFormat::Rgba8)));
    let mut encoder = gpu.device.create_command_encoder(&Default::default());
    mips.build(gpu, &mut encoder, &chain);
    for copy in &copies {
        copy.clear(gpu, &mut encoder, wgpu::Color::WHITE);
        whole.copy_overlap(gpu, &mut encoder, copy);
    }
    gpu.queue.submit([encoder.finish()]);
    let mut readback = Readback::default();
    let bytes = [&whole, &copies[0], &copies[1]].map(|cube| readback.bytes(gpu, cube).unwrap());
    let converter = FloatConverter::new(gpu);
    let places = (0..6).flat_map(|layer| (0..shape.levels).map(move |level| (layer, level)));
    let floats = places.map(|place| converter.convert_level(gpu, &whole, place).unwrap());
    let floats = floats.map(|floats| readback.rgba32float(gpu, &floats).unwrap()).collect();
    (bytes.into(), floats)
}

#[test]
fn faces_and_their_mips_are_the_same_on_opengl() {
    let (Some(other), Some(gl)) = (testing::gpu(), testing::opengl()) else { return };
    assert_eq!(gl.info.backend, wgpu::Backend::Gl);
    let ((bytes, floats), (gl_bytes, gl_floats)) = (read(&other), read(&gl));
    assert!(bytes[1].ends_with(&[255; 4]) && bytes[1] != gl_bytes[2]);
    assert_eq!(bytes, gl_bytes);
    for (level, (one, two)) in floats.iter().zip(&gl_floats).enumerate() {
        let worst = one.as_flattened().iter().zip(two.as_flattened()).map(|(a, b)| (a - b).abs()).fold(0.0, f32::max);
        // Each level is rounded to 8 bits.
        assert!(worst <= (level % 4) as f32 * 1.01 / 255.0, "face {}, level {}: {worst}", level / 4, level % 4);
    }
}
