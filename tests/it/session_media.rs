//! Image files and models of an open project: loading them does not block the window.

use crate::support::{self, stage::Stage};
use eddy::session::{Command, FallbackPicture, FileCommand, Outcome, TransportCommand};
use image::{ImageBuffer, Rgba};
use std::time::{Duration, Instant};

const TOML: &str = "eddy = 1\n\n[passes.image]\nchannels.0 = { file = \"pic.png\" }\n";
const SHOW: &str = "void mainImage(out vec4 o, in vec2 p) { o = texelFetch(iChannel0, ivec2(0), 0); }\n";
const MODEL: &str = "eddy = 1\n\n[passes.buffer_a]\ndraw = [{ mesh = \"m.gltf\", vertex = \"a.vert.glsl\" \
                     }]\n\n[passes.image]\nchannels.0 = { buffer = \"A\" }\n";
const VERTEX: &str = "in vec3 aPosition;\nvoid main() { gl_Position = vec4(aPosition, 1.0); }\n";
const FRAGMENT: &str = "layout(location = 0) out vec4 color;\nvoid main() { color = vec4(1.0); }\n";

/// Opens the project and returns the time that the calls took.
fn open(stage: &mut Stage) -> Duration {
    let start = Instant::now();
    stage.session.apply(FileCommand::Open(stage.folder().to_str().unwrap().into()));
    stage.act(Command::Transport(TransportCommand::Pause));
    start.elapsed()
}

fn messages(stage: &Stage) -> Vec<&str> {
    stage.session.diagnostics().iter().map(|d| d.message.as_str()).collect()
}

#[cfg(unix)]
fn pipe(stage: &Stage, name: &str) {
    let made = std::process::Command::new("mkfifo").arg(stage.path(name)).status().unwrap();
    assert!(made.success());
}

#[cfg(unix)]
#[test]
fn an_image_file_that_is_a_pipe_opens_at_once_with_a_warning() {
    let Some(gpu) = support::gpu() else { return };
    let mut stage = Stage::bare(gpu);
    stage.write("eddy.toml", TOML);
    stage.write("image.glsl", SHOW);
    pipe(&stage, "pic.png");
    let took = open(&mut stage);
    assert!(took < Duration::from_secs(1), "{took:?}");
    stage.until_compiled();
    let warnings = messages(&stage);
    assert!(warnings.len() == 1 && warnings[0].contains("pic.png: it is a pipe, not a regular file"), "{warnings:?}");
    assert_eq!(stage.red(), 0);
}

#[cfg(unix)]
#[test]
fn a_model_that_is_or_names_a_pipe_opens_at_once_with_an_error() {
    let Some(gpu) = support::gpu() else { return };
    let mut stage = Stage::bare(gpu);
    for (name, text) in
        [("eddy.toml", MODEL), ("a.vert.glsl", VERTEX), ("buffer_a.glsl", FRAGMENT), ("image.glsl", SHOW)]
    {
        stage.write(name, text);
    }
    pipe(&stage, "m.gltf");
    let took = open(&mut stage);
    assert!(took < Duration::from_secs(1), "{took:?}");
    stage.until_compiled();
    let errors = messages(&stage);
    assert!(errors.len() == 1 && errors[0].contains("m.gltf: it is a pipe"), "{errors:?}");

    std::fs::rename(stage.path("m.gltf"), stage.path("m.bin")).unwrap();
    stage.write("m.gltf", r#"{"asset":{"version":"2.0"},"buffers":[{"byteLength":4,"uri":"m.bin"}]}"#);
    let took = open(&mut stage);
    assert!(took < Duration::from_secs(1), "{took:?}");
    stage.until("the error about the model's pipe", |s| {
        s.diagnostics()
            .iter()
            .any(|d| d.message.contains("m.gltf refers to a file: ") && d.message.contains("is a pipe"))
    });
}

#[test]
fn only_a_changed_image_file_is_reloaded() {
    let Some(gpu) = support::gpu() else { return };
    let mut stage = Stage::bare(gpu);
    stage.write("eddy.toml", TOML);
    stage.write("image.glsl", SHOW);
    let paint = |stage: &Stage, red: u8| {
        ImageBuffer::<Rgba<u8>, _>::from_pixel(2, 2, Rgba([red, 0, 0, 255])).save(stage.path("pic.png")).unwrap();
    };
    paint(&stage, 51);
    open(&mut stage);
    stage.until_compiled();
    assert_eq!(stage.red(), 51, "{:?}", messages(&stage));
    stage.settle();
    paint(&stage, 102);
    stage.until_red(102);
    // A file outside the project causes no compile and no frame.
    stage.settle();
    let frames = stage.frames();
    stage.write("notes.txt", "nothing");
    stage.for_a_while();
    assert_eq!(stage.frames(), frames);
}

#[test]
fn errors_without_a_line_are_in_the_error_count() {
    let Some(gpu) = eddy::gpu::testing::weak_gpu() else { return };
    let mut stage = Stage::bare(gpu);
    for (name, text) in
        [("eddy.toml", MODEL), ("a.vert.glsl", VERTEX), ("buffer_a.glsl", FRAGMENT), ("image.glsl", SHOW)]
    {
        stage.write(name, text);
    }
    stage.write("m.gltf", r#"{"asset":{"version":"2.0"},"meshes":[{"primitives":[{"attributes":{"POSITION":77}}]}]}"#);
    open(&mut stage);
    stage.until_compiled();
    let one = Some(Outcome::Failed { errors: 1, meanwhile: FallbackPicture::Nothing });
    assert_eq!(stage.session.compile_state().last, one, "{:?}", messages(&stage));
    assert!(messages(&stage)[0].contains("accessor 77, but there are 0"), "{:?}", messages(&stage));

    // An error of the device is counted too.
    let mesh = MODEL.replace("m.gltf", "builtin:cube");
    let wide =
        mesh.replace("[passes.buffer_a]", "[passes.buffer_a]\ntargets = [\"rgba32f\", \"rgba32f\", \"rgba32f\"]");
    assert_ne!(mesh, wide);
    stage.write("eddy.toml", &wide);
    open(&mut stage);
    stage.until_compiled();
    assert_eq!(stage.session.compile_state().last, one, "{:?}", messages(&stage));
    assert!(messages(&stage)[0].contains("48 bytes per texel"), "{:?}", messages(&stage));
}
