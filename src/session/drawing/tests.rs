//! Tests of a device that draws and paints, as a GPU is.

use crate::{
    CanvasCommand, EditCommand, FileCommand, Session, SessionOptions, TransportCommand,
    view::{Level, Outcome},
};
use eddy_gpu::{Gpu, GpuOptions, testing};
use eddy_project::Tab;
use std::{
    sync::Arc,
    time::{Duration, Instant},
};

/// Returns a device that is treated as a GPU.
fn gpu() -> Option<Gpu> {
    testing::gpu_with(&GpuOptions { treat_as_gpu: true, ..GpuOptions::default() })
}

fn tick_until(session: &mut Session, what: &str, is_so: impl Fn(&Session) -> bool) {
    let end = Instant::now() + Duration::from_secs(120);
    while !is_so(session) {
        assert!(Instant::now() < end, "no {what}: {:?}", session.notices());
        session.tick(Instant::now());
        std::thread::sleep(Duration::from_millis(2));
    }
}

/// Opens a session whose frames are drawn on a thread, and waits for some.
fn open(gpu: Gpu) -> Session {
    let options = SessionOptions {
        edit_debounce: Duration::ZERO,
        draws_on_thread: true,
        frame_limit: Duration::from_secs(60),
        ..SessionOptions::default()
    };
    let mut session = Session::with_options(gpu, Arc::new(|| ()), options).unwrap();
    session.apply(CanvasCommand::SetFixedSize(Some((64, 36))));
    tick_until(&mut session, "frames", |s| s.transport().frame > 2);
    session
}

/// Returns the size and the first pixel of the picture that the window shows.
fn shown(session: &Session) -> ((u32, u32), [u8; 4]) {
    let (texture, gpu) = (session.display().texture(), session.gpu());
    let buffer = gpu.device.create_buffer(&wgpu::BufferDescriptor {
        label: None,
        size: 256,
        usage: wgpu::BufferUsages::COPY_DST | wgpu::BufferUsages::MAP_READ,
        mapped_at_creation: false,
    });
    let mut encoder = gpu.device.create_command_encoder(&wgpu::CommandEncoderDescriptor::default());
    let layout = wgpu::TexelCopyBufferLayout { offset: 0, bytes_per_row: None, rows_per_image: None };
    let pixel = wgpu::Extent3d { width: 1, height: 1, depth_or_array_layers: 1 };
    encoder.copy_texture_to_buffer(
        texture.as_image_copy(),
        wgpu::TexelCopyBufferInfo { buffer: &buffer, layout },
        pixel,
    );
    gpu.queue.submit([encoder.finish()]);
    buffer.slice(..).map_async(wgpu::MapMode::Read, |mapped| mapped.unwrap());
    gpu.wait().unwrap();
    let bytes = buffer.slice(..4).get_mapped_range().unwrap();
    ((texture.width(), texture.height()), bytes[..4].try_into().unwrap())
}

fn write(session: &mut Session, code: &str) {
    let text = format!("void mainImage(out vec4 o, in vec2 p) {{ {code} }}");
    let before = session.programs_drawn();
    session.apply(EditCommand::EditText { tab: Tab::image(), text });
    tick_until(session, "first frame of the program", |s| s.programs_drawn() > before);
}

#[test]
fn the_window_shows_the_engines_texture_and_the_processor_copies_nothing() {
    let Some(gpu) = gpu() else { return };
    let mut session = open(gpu.clone());
    assert!(session.services.drawing.device().wait().unwrap().is_same_device(&gpu));
    write(&mut session, "o = vec4(1.0, 0.0, 0.2, 1.0);");
    assert_eq!(shown(&session), ((64, 36), [255, 0, 51, 255]));
    let generation = session.display_generation();
    write(&mut session, "o = vec4(0.0, 1.0, 0.2, 1.0);");
    assert_eq!(shown(&session), ((64, 36), [0, 255, 51, 255]));
    assert_eq!(session.display_generation(), generation, "the texture stays");
    session.apply(CanvasCommand::SetFixedSize(Some((80, 20))));
    tick_until(&mut session, "picture of the new size", |s| s.display().texture().width() == 80);
    assert!(session.display_generation() > generation);
    assert_eq!(shown(&session), ((80, 20), [0, 255, 51, 255]));
    assert_eq!(session.copied_picture_bytes(), 0);
}

#[test]
fn on_the_processor_each_picture_is_copied_both_ways() {
    let Some(gpu) = testing::gpu() else { return };
    if !gpu.rasteriser().shares_processor() {
        return;
    }
    let session = open(gpu.clone());
    assert!(!session.services.drawing.device().wait().unwrap().is_same_device(&gpu));
    let bytes = session.copied_picture_bytes();
    assert!(bytes > 0 && bytes.is_multiple_of(2 * 4), "{bytes}");
}

#[test]
fn a_lost_device_is_replaced_with_the_windows() {
    let Some(first) = gpu() else { return };
    let mut session = open(first.clone());
    write(&mut session, "o = vec4(1.0, 0.0, 0.2, 1.0);");
    testing::lose(&first);
    let end = Instant::now() + Duration::from_millis(300);
    while Instant::now() < end {
        session.tick(Instant::now());
    }
    let errors = |session: &Session| session.notices().iter().filter(|n| n.level == Level::Error).count();
    assert_eq!(errors(&session), 0, "the window tells of it: {:?}", session.notices());
    let other = gpu().unwrap();
    session.show_on(other.clone()).unwrap();
    tick_until(&mut session, "frames of the new device", |s| s.transport().frame > 2 && s.transport().playing);
    tick_until(&mut session, "the same picture", |s| shown(s).1 == [255, 0, 51, 255]);
    assert!(session.services.drawing.device().wait().unwrap().is_same_device(&other));
    assert!(matches!(session.compile_state().last, Some(Outcome::Ok { .. })));
    assert_eq!(session.copied_picture_bytes(), 0);
}

/// A project that counts its frames in red.
const COUNTS: [(&str, &str); 2] = [
    (
        "buffer_a.glsl",
        "#iChannel0 \"self\"\nvoid mainImage(out vec4 o, in vec2 p) { \
         o = texelFetch(iChannel0, ivec2(p), 0) + vec4(1.0 / 255.0, 0.0, 0.0, 1.0); }",
    ),
    (
        "image.glsl",
        "#iChannel0 \"buffer_a\"\nvoid mainImage(out vec4 o, in vec2 p) { o = texelFetch(iChannel0, ivec2(p), 0); }",
    ),
];

#[test]
fn buffers_are_restored_after_a_loss_by_drawing_the_frames_again() {
    let folder = tempfile::tempdir().unwrap();
    for (name, text) in COUNTS {
        std::fs::write(folder.path().join(name), text).unwrap();
    }
    for first in [testing::gpu(), gpu()] {
        let Some(first) = first else { return };
        let is_shared = !first.rasteriser().shares_processor();
        let mut session = open(first.clone());
        let before = session.programs_drawn();
        session.apply(FileCommand::Open(folder.path().display().to_string()));
        session.apply(CanvasCommand::SetFixedSize(Some((64, 36))));
        tick_until(&mut session, "first frame", |s| s.programs_drawn() > before);
        session.apply(TransportCommand::Reset);
        tick_until(&mut session, "frames", |s| (10..200).contains(&s.transport().frame));
        session.apply(TransportCommand::Pause);
        tick_until(&mut session, "idle engine", |s| !s.services.drawing.is_busy());
        session.tick(Instant::now());
        let (frame, picture) = (session.transport().frame, shown(&session));
        assert_eq!(i32::from(picture.1[0]), frame + 1, "a frame more each time");
        testing::lose(&session.services.drawing.device().wait().unwrap());
        if is_shared {
            session.show_on(gpu().unwrap()).unwrap();
        } else {
            // The next request to the device notices it.
            session.apply(CanvasCommand::SetFixedSize(Some((64, 37))));
            session.apply(CanvasCommand::SetFixedSize(Some((64, 36))));
            session.apply(TransportCommand::Step);
        }
        tick_until(&mut session, "the frame of before", |s| {
            s.transport().frame >= frame && shown(s).1 != [0, 0, 0, 255]
        });
        let (again, steps) = (session.transport().frame, i32::from(!is_shared));
        assert!((frame..=frame + steps).contains(&again), "{frame} and then {again}");
        tick_until(&mut session, "the count of before", |s| i32::from(shown(s).1[0]) == s.transport().frame + 1);
        assert!(!session.transport().playing);
    }
}

#[test]
fn an_abandoned_frame_frees_the_device_between_two_slices() {
    let Some(gpu) = gpu() else { return };
    let mut session = open(gpu);
    session.apply(CanvasCommand::SetFixedSize(Some((1280, 720))));
    // The frame takes many seconds on the processor, a slice of it a fraction of one.
    let text = "void mainImage(out vec4 o, in vec2 p) { float x = p.x; for (int i = 0; i < 20000; i++) x = sin(x + p.y); \
                o = vec4(x); }";
    session.apply(EditCommand::EditText { tab: Tab::image(), text: text.into() });
    let since = |s: &Session| s.services.drawing.draws_since();
    tick_until(&mut session, "slow frame", |s| since(s).is_some_and(|at| at.elapsed() > Duration::from_millis(500)));
    session.services.drawing.restart_thread(Instant::now(), (64, 36)).unwrap();
    let end = Instant::now() + Duration::from_secs(6);
    while session.services.drawing.lost_threads() > 0 {
        assert!(Instant::now() < end, "the thread goes on");
        std::thread::sleep(Duration::from_millis(2));
    }
}
