//! Pictures and models of an open project: read beside the window, and never in its way.

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

/// Opens the project, with the time that takes the caller.
fn open(stage: &mut Stage) -> Duration {
    let began = Instant::now();
    stage.session.apply(FileCommand::Open(stage.folder().to_str().unwrap().into()));
    stage.act(Command::Transport(TransportCommand::Pause));
    began.elapsed()
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
fn a_picture_that_is_a_pipe_opens_at_once_with_a_word_about_it() {
    let Some(gpu) = support::gpu() else { return };
    let mut stage = Stage::bare(gpu);
    stage.write("eddy.toml", TOML);
    stage.write("image.glsl", SHOW);
    pipe(&stage, "pic.png");
    let took = open(&mut stage);
    assert!(took < Duration::from_secs(1), "{took:?}");
    stage.until_compiled();
    let said = messages(&stage);
    assert!(said.len() == 1 && said[0].contains("pic.png: it is a pipe, not a regular file"), "{said:?}");
    assert_eq!(stage.red(), 0);
}

#[cfg(unix)]
#[test]
fn a_model_that_is_a_pipe_or_names_one_opens_at_once_with_an_error() {
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
    let said = messages(&stage);
    assert!(said.len() == 1 && said[0].contains("m.gltf: it is a pipe"), "{said:?}");

    std::fs::rename(stage.path("m.gltf"), stage.path("m.bin")).unwrap();
    stage.write("m.gltf", r#"{"asset":{"version":"2.0"},"buffers":[{"byteLength":4,"uri":"m.bin"}]}"#);
    let took = open(&mut stage);
    assert!(took < Duration::from_secs(1), "{took:?}");
    stage.until("the pipe behind the model", |s| {
        s.diagnostics()
            .iter()
            .any(|d| d.message.contains("m.gltf refers to a file: ") && d.message.contains("is a pipe"))
    });
}

#[test]
fn a_picture_that_changes_on_disk_is_read_again_and_one_that_does_not_is_not() {
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
    // A file that is none of the project's is no reason to compile: the picture stands.
    stage.settle();
    let frames = stage.frames();
    stage.write("notes.txt", "nothing");
    stage.for_a_while();
    assert_eq!(stage.frames(), frames);
}

#[test]
fn errors_without_a_line_are_counted() {
    let Some(gpu) = support::gpu() else { return };
    let side = gpu.device.limits().max_texture_dimension_2d + 1;
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

    // What the device refuses is an error of the list too.
    stage.write("eddy.toml", TOML);
    ImageBuffer::<Rgba<u8>, _>::from_pixel(side, 1, Rgba([9, 0, 0, 255])).save(stage.path("pic.png")).unwrap();
    open(&mut stage);
    stage.until_compiled();
    assert_eq!(stage.session.compile_state().last, one, "{:?}", messages(&stage));
    assert!(messages(&stage)[0].contains(&side.to_string()), "{:?}", messages(&stage));
}
