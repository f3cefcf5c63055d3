//! Frames of the window's contents without a window.

use super::*;
use crate::{
    project::{PassId, Tab},
    session::{Command, SessionOptions, testing},
};
use egui::{Event, Modifiers, PointerButton, Pos2, Rect, pos2, vec2};
use std::{
    path::{Path, PathBuf},
    sync::Arc,
    time::Duration,
};

/// The window's contents without a window, painted on nothing.
struct Stage {
    ctx: egui::Context,
    shell: Shell,
    session: Session,
    renderer: Renderer,
    folder: tempfile::TempDir,
}

impl Stage {
    /// `None` where there is no device, after saying so.
    fn open(files: &[(&str, &str)]) -> Option<Stage> {
        let gpu = testing::gpu()?;
        let folder = tempfile::tempdir().unwrap();
        files.iter().for_each(|(name, text)| std::fs::write(folder.path().join(name), text).unwrap());
        let mut session = Session::with_options(gpu.clone(), Arc::new(|| ()), SessionOptions::default()).unwrap();
        session.apply(Command::Open(folder.path().display().to_string()));
        let renderer = Renderer::new(&gpu.device, wgpu::TextureFormat::Rgba8Unorm, Default::default());
        let shell = Shell::new(gpu, Arc::new(|| ()), false);
        let mut stage = Stage { ctx: egui::Context::default(), shell, session, renderer, folder };
        let end = Instant::now() + Duration::from_secs(60);
        let is_done = |s: &Session| s.compile_state().last.is_some() && !s.compile_state().compiling;
        while !is_done(&stage.session) {
            stage.frame(vec![]);
            assert!(Instant::now() < end, "never compiled: {:?}", stage.session.diagnostics());
            std::thread::sleep(Duration::from_millis(2));
        }
        stage.frame(vec![]);
        Some(stage)
    }

    fn click(&mut self, widget: &str) {
        let at = self.shell.place(widget).unwrap_or_else(|| panic!("no {widget}")).center();
        self.frame(vec![Event::PointerMoved(at), button(at, true), button(at, false)]);
        self.frame(vec![]);
    }

    fn frame(&mut self, events: Vec<Event>) -> Frame {
        let screen_rect = Some(Rect::from_min_size(Pos2::ZERO, vec2(900.0, 600.0)));
        let input = RawInput { screen_rect, events, ..RawInput::default() };
        let Stage { ctx, shell, session, renderer, .. } = self;
        let mut frame = run(ctx, shell, session, renderer, input, Instant::now());
        frame.output.textures_delta.clear();
        self.session.gpu().wait().unwrap();
        frame
    }

    /// A point of the picture as fractions from its bottom left.
    fn point(&self, u: f32, v: f32) -> Pos2 {
        let p = self.shell.place("viewport").unwrap();
        pos2(p.left() + u * p.width(), p.bottom() - v * p.height())
    }

    /// The colour of the newest picture, all of whose pixels are one.
    fn colour(&mut self) -> [u8; 3] {
        self.session.apply(Command::Screenshot);
        let path: PathBuf = self.session.notices().last().unwrap().path.clone().unwrap();
        assert!(path.starts_with(self.folder.path()), "{}", Path::display(&path));
        let picture = image::open(path).unwrap().to_rgb8();
        picture.get_pixel(0, 0).0
    }
}

fn button(pos: Pos2, pressed: bool) -> Event {
    Event::PointerButton { pos, button: PointerButton::Primary, pressed, modifiers: Modifiers::NONE }
}

/// Red is where the mouse is, from the left; green: it is down; blue: it went down in this frame.
const MOUSE: &str = "void mainImage(out vec4 o, in vec2 p) {
    o = vec4(iMouse.x / iResolution.x, iMouse.z > 0.0, iMouse.w > 0.0, 1.0);
}";

#[test]
fn the_picture_of_a_frame_sees_the_input_of_that_frame() {
    let Some(mut stage) = Stage::open(&[("image.glsl", MOUSE)]) else { return };
    assert_eq!(stage.colour(), [0, 0, 0]);
    let near = |a: u8, b: f32| (f32::from(a) - 255.0 * b).abs() < 3.0;
    for playing in [true, false] {
        stage.session.apply(if playing { Command::Play } else { Command::Pause });
        let (left, right) = (stage.point(0.25, 0.5), stage.point(0.75, 0.5));
        let frame = stage.frame(vec![Event::PointerMoved(left), button(left, true)]);
        let [red, green, blue] = stage.colour();
        assert!(frame.tick.frame_drawn && near(red, 0.25), "pressed, playing {playing}: {red}");
        assert_eq!((green, blue), (255, 255), "pressed, playing {playing}");
        stage.frame(vec![Event::PointerMoved(right)]);
        let [red, green, blue] = stage.colour();
        assert!(near(red, 0.75), "moved, playing {playing}: {red}");
        assert_eq!((green, blue), (255, 0), "moved, playing {playing}");
        stage.frame(vec![button(right, false)]);
        assert_eq!(stage.colour()[1], 0, "released, playing {playing}");
    }
}

#[test]
fn a_paused_frame_shows_what_was_drawn_in_it_and_then_rests() {
    let Some(mut stage) = Stage::open(&[("image.glsl", MOUSE)]) else { return };
    stage.session.apply(Command::Pause);
    stage.frame(vec![]);
    let at = stage.point(0.5, 0.5);
    let frame = stage.frame(vec![Event::PointerMoved(at), button(at, true), button(at, false)]);
    assert!(frame.tick.frame_drawn && !frame.wants_next);
    let next = stage.frame(vec![]);
    assert!(!next.tick.frame_drawn && !next.wants_next && next.tick.wake_at.is_none());
}

#[test]
fn a_new_size_is_drawn_and_placed_in_the_frame_that_asks_for_it() {
    let Some(mut stage) = Stage::open(&[("image.glsl", MOUSE)]) else { return };
    stage.session.apply(Command::SetFixedSize(Some((64, 32))));
    stage.frame(vec![]);
    assert_eq!(stage.session.transport().resolution, (64, 32));
    let place = stage.shell.place("viewport").unwrap();
    assert!((place.width() / place.height() - 2.0).abs() < 0.01, "{place:?}");
}

#[test]
fn a_problem_and_the_further_places_it_speaks_of_lead_to_their_tabs() {
    let common = "float one() { return 1.0; }\n\nfloat ring(float r) { return r; }\n";
    let image = "void mainImage(out vec4 o, in vec2 p) {\n    o = vec4(ring(1, 2));\n}\n";
    let Some(mut stage) = Stage::open(&[("common.glsl", common), ("image.glsl", image)]) else { return };
    let problems = stage.session.diagnostics();
    let label = &problems[0].labels[0];
    assert_eq!((problems.len(), problems[0].tab()), (1, Some(&Tab::Pass(PassId::Image))), "{problems:?}");
    assert_eq!((&label.place.tab, label.place.line), (&Some(Tab::Common), 3), "{label:?}");
    stage.frame(vec![]);
    stage.click("problem:0:0");
    assert_eq!(stage.shell.caret(), (Tab::Common, 2));
    stage.click("problem:0");
    assert_eq!(stage.shell.caret(), (Tab::Pass(PassId::Image), 1));
}
