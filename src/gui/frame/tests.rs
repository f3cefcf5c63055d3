//! Frames of the window's contents without a window.

use super::*;
use crate::{
    gpu::testing,
    project::{Input, Media, PassName, Tab},
    session::{CanvasCommand, CaptureCommand, Command, EditCommand, FileCommand, SessionOptions, TransportCommand},
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
    /// Returns `None` after printing the reason if there is no device.
    fn open(files: &[(&str, &str)]) -> Option<Stage> {
        let gpu = testing::gpu()?;
        let folder = tempfile::tempdir().unwrap();
        files.iter().for_each(|(name, text)| std::fs::write(folder.path().join(name), text).unwrap());
        let mut session = Session::with_options(gpu.clone(), Arc::new(|| ()), SessionOptions::default()).unwrap();
        session.apply(FileCommand::Open(folder.path().display().to_string()));
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
        self.frame_of(RawInput { events, ..RawInput::default() })
    }

    /// Drops files on a widget, or outside all widgets.
    fn drop_files(&mut self, names: &[&str], on: Option<&str>) {
        let at = on.map_or(pos2(450.0, 5.0), |widget| self.shell.place(widget).unwrap().center());
        self.frame(vec![Event::PointerMoved(at)]);
        let file = |name: &&str| Arc::new(Dropped(self.folder.path().join(name))) as egui::DroppedFileHandle;
        let dropped_files = names.iter().map(file).collect();
        self.frame_of(RawInput { dropped_files, ..RawInput::default() });
        self.frame(vec![]);
    }

    fn frame_of(&mut self, input: RawInput) -> Frame {
        let screen_rect = Some(Rect::from_min_size(Pos2::ZERO, vec2(900.0, 600.0)));
        let input = RawInput { screen_rect, ..input };
        let Stage { ctx, shell, session, renderer, .. } = self;
        let mut frame = run(ctx, shell, session, renderer, input, Instant::now());
        frame.output.textures_delta.clear();
        self.session.gpu().wait().unwrap();
        frame
    }

    fn until(&mut self, what: &str, is_so: impl Fn(&mut Stage) -> bool) {
        let end = Instant::now() + Duration::from_secs(60);
        while !is_so(self) {
            assert!(Instant::now() < end, "never {what}: {:?}", self.session.diagnostics());
            self.frame(vec![]);
            std::thread::sleep(Duration::from_millis(2));
        }
    }

    /// Returns a point of the picture, given as fractions from its bottom left.
    fn point(&self, u: f32, v: f32) -> Pos2 {
        let p = self.shell.place("viewport").unwrap();
        pos2(p.left() + u * p.width(), p.bottom() - v * p.height())
    }

    /// Returns the colour of the newest picture, whose pixels are all equal.
    fn colour(&mut self) -> [u8; 3] {
        self.session.apply(CaptureCommand::Screenshot);
        let path: PathBuf = self.session.notices().last().unwrap().path.clone().unwrap();
        assert!(path.starts_with(self.folder.path()), "{}", Path::display(&path));
        let picture = image::open(path).unwrap().to_rgb8();
        picture.get_pixel(0, 0).0
    }
}

/// A dropped file from the window system.
#[derive(Debug)]
struct Dropped(PathBuf);

impl egui::DroppedFile for Dropped {
    fn path(&self) -> &Path {
        &self.0
    }

    fn bytes(&self) -> Result<Vec<u8>, String> {
        std::fs::read(&self.0).map_err(|e| e.to_string())
    }
}

fn button(pos: Pos2, pressed: bool) -> Event {
    Event::PointerButton { pos, button: PointerButton::Primary, pressed, modifiers: Modifiers::NONE }
}

/// Red is the mouse position from the left; green: it is down; blue: it went down in this frame.
const MOUSE: &str = "void mainImage(out vec4 o, in vec2 p) {
    o = vec4(iMouse.x / iResolution.x, iMouse.z > 0.0, iMouse.w > 0.0, 1.0);
}";

#[test]
fn the_picture_uses_the_input_of_its_own_frame() {
    let Some(mut stage) = Stage::open(&[("image.glsl", MOUSE)]) else { return };
    assert_eq!(stage.colour(), [0, 0, 0]);
    let near = |a: u8, b: f32| (f32::from(a) - 255.0 * b).abs() < 3.0;
    for playing in [true, false] {
        stage.session.apply(if playing {
            Command::Transport(TransportCommand::Play)
        } else {
            Command::Transport(TransportCommand::Pause)
        });
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
fn a_paused_frame_is_shown_and_then_idles() {
    let Some(mut stage) = Stage::open(&[("image.glsl", MOUSE)]) else { return };
    stage.session.apply(TransportCommand::Pause);
    stage.frame(vec![]);
    let at = stage.point(0.5, 0.5);
    let frame = stage.frame(vec![Event::PointerMoved(at), button(at, true), button(at, false)]);
    assert!(frame.tick.frame_drawn && !frame.wants_next);
    let next = stage.frame(vec![]);
    assert!(!next.tick.frame_drawn && !next.wants_next && next.tick.wake_at.is_none());
}

#[test]
fn a_resize_takes_effect_in_the_same_frame() {
    let Some(mut stage) = Stage::open(&[("image.glsl", MOUSE)]) else { return };
    stage.session.apply(CanvasCommand::SetFixedSize(Some((64, 32))));
    stage.frame(vec![]);
    assert_eq!(stage.session.transport().resolution, (64, 32));
    let place = stage.shell.place("viewport").unwrap();
    assert!((place.width() / place.height() - 2.0).abs() < 0.01, "{place:?}");
}

#[test]
fn problems_and_their_related_places_link_to_tabs() {
    let common = "float one() { return 1.0; }\n\nfloat ring(float r) { return r; }\n";
    let image = "void mainImage(out vec4 o, in vec2 p) {\n    o = vec4(ring(1, 2));\n}\n";
    let Some(mut stage) = Stage::open(&[("common.glsl", common), ("image.glsl", image)]) else { return };
    let problems = stage.session.diagnostics();
    let label = &problems[0].labels[0];
    assert_eq!((problems.len(), problems[0].tab()), (1, Some(&Tab::image())), "{problems:?}");
    assert_eq!((&label.place.tab, label.place.line), (&Some(Tab::Common), 3), "{label:?}");
    stage.frame(vec![]);
    stage.click("problem:0:0");
    assert_eq!(stage.shell.caret(), (Tab::Common, 2));
    stage.click("problem:0");
    assert_eq!(stage.shell.caret(), (Tab::image(), 1));
}

/// Only buffers that a card shows are read back, and an idle window reads nothing.
#[test]
fn channel_previews_show_the_current_buffer() {
    let color = |rgb: &str| format!("void mainImage(out vec4 o, in vec2 p) {{ o = vec4({rgb}, 1.0); }}\n");
    let image = "void mainImage(out vec4 o, in vec2 p) { o = texelFetch(iChannel0, ivec2(p), 0); }\n";
    let manifest = "[passes.buffer_a]\n[passes.image]\nchannels.0 = { buffer = \"A\" }\n";
    let green = color("0.0, 1.0, 0.0");
    let files = [("buffer_a.glsl", green.as_str()), ("image.glsl", image), ("eddy.toml", manifest)];
    let Some(mut stage) = Stage::open(&files) else { return };
    stage.session.apply(TransportCommand::Pause);
    let a = PassName::buffer("A");
    let texel = |stage: &Stage| {
        let (small, _) = stage.session.miniature(&a, 0)?;
        let p = &small.picture;
        Some(p.bytes[4 * (p.width * p.height / 2) as usize..][..3].to_vec())
    };
    for _ in 0..4 {
        stage.frame(vec![]);
    }
    assert_eq!(texel(&stage), Some(vec![0, 255, 0]));
    let rests = stage.frame(vec![]);
    assert!(!rests.wants_next && rests.tick.wake_at.is_none());

    stage.session.apply(EditCommand::EditText { tab: Tab::Pass(a.clone()), text: color("0.0, 0.0, 1.0") });
    stage.session.apply(EditCommand::CompileNow);
    let end = Instant::now() + Duration::from_secs(60);
    while texel(&stage) != Some(vec![0, 0, 255]) {
        stage.frame(vec![]);
        assert!(Instant::now() < end, "{:?}", texel(&stage));
        std::thread::sleep(Duration::from_millis(2));
    }
    // The card is in the panel of the selected pass; the buffer itself reads nothing.
    stage.click("tab:Buffer A");
    stage.frame(vec![]);
    assert_eq!(texel(&stage), None);
}

#[test]
fn the_window_uses_the_theme_of_the_settings() {
    use crate::gui::theme;
    let Some(mut stage) = Stage::open(&[("image.glsl", MOUSE)]) else { return };
    for (preference, is_dark) in [(egui::ThemePreference::Light, false), (egui::ThemePreference::Dark, true)] {
        stage.ctx.set_theme(preference);
        stage.frame(vec![]);
        let visuals = stage.ctx.style_of(stage.ctx.theme()).visuals.clone();
        assert_eq!(theme::of_visuals(&visuals).is_dark, is_dark);
    }
    // The system's preference, or dark if the system has none.
    stage.ctx.set_theme(egui::ThemePreference::System);
    theme::apply(&stage.ctx);
    let ask = |system_theme| {
        let mut output = stage.ctx.run_ui(RawInput { system_theme, ..RawInput::default() }, |_| {});
        output.textures_delta.clear();
        stage.ctx.theme()
    };
    let wanted = [egui::Theme::Light, egui::Theme::Dark, egui::Theme::Dark];
    assert_eq!([ask(Some(egui::Theme::Light)), ask(Some(egui::Theme::Dark)), ask(None)], wanted);
}

#[test]
fn a_pass_can_be_added_with_twenty_tabs() {
    let names: Vec<String> = ('a'..='t').map(|c| format!("buffer_{c}.glsl")).collect();
    let mut files: Vec<(&str, &str)> = names.iter().map(|name| (name.as_str(), MOUSE)).collect();
    files.push(("image.glsl", MOUSE));
    let Some(mut stage) = Stage::open(&files) else { return };
    assert_eq!(stage.session.tabs().len(), 21);
    for tab in ["tab:Buffer A", "tab:Buffer B"] {
        let add = stage.shell.place("button:add-tab").unwrap();
        assert!(add.left() > 450.0 && add.right() <= 900.0, "{add:?}");
        stage.click(tab);
    }
}

/// A picture of one pixel, and a model of one triangle.
fn things(stage: &Stage) {
    image::RgbaImage::from_pixel(1, 1, image::Rgba([255, 0, 0, 255]))
        .save(stage.folder.path().join("red.png"))
        .unwrap();
    let model = "v 0 0 0\nv 20 0 0\nv 0 20 0\nf 1 2 3\n";
    std::fs::write(stage.folder.path().join("triangle.obj"), model).unwrap();
}

fn reads(stage: &Stage, channel: usize) -> Option<Input> {
    let image = stage.session.project().image().unwrap();
    image.bindings.get(channel).map(|channel| channel.input.clone())
}

const READS_SECOND: &str = "void mainImage(out vec4 o, in vec2 p) { o = texture(iChannel2, vec2(0.5)); }";

#[test]
fn a_dropped_picture_goes_to_the_channel_below_it_or_one_in_use() {
    let Some(mut stage) = Stage::open(&[("image.glsl", READS_SECOND)]) else { return };
    things(&stage);
    let picture = || Some(Input::texture(Media::File("red.png".into())));
    stage.drop_files(&["red.png"], None);
    assert_eq!((reads(&stage, 0), reads(&stage, 2)), (None, picture()), "the text reads iChannel2");
    let notice = stage.session.notices().last().unwrap().clone();
    assert_eq!(notice.text, "iChannel2 of Image reads red.png");
    stage.until("the picture", |stage| stage.colour() == [255, 0, 0]);
    // Undo by the notice. Others may appear above it meanwhile.
    for _ in 0..8 {
        std::thread::sleep(std::time::Duration::from_millis(20));
        stage.frame(vec![]);
    }
    stage.click(&format!("toast:{}:undo", notice.id));
    assert_eq!(reads(&stage, 2), None);
    stage.drop_files(&["red.png"], Some("channel:1"));
    assert_eq!((reads(&stage, 1), reads(&stage, 2)), (picture(), None));
}

#[test]
fn a_dropped_model_gets_its_own_pass() {
    let Some(mut stage) = Stage::open(&[("image.glsl", READS_SECOND)]) else { return };
    things(&stage);
    stage.drop_files(&["triangle.obj"], None);
    let model = PassName::buffer("model");
    assert_eq!(reads(&stage, 2), Some(Input::buffer("model")));
    stage.until("a frame of it", |stage| {
        stage.session.compile_state().last.is_some() && !stage.session.compile_state().compiling
    });
    assert!(stage.session.diagnostics().is_empty(), "{:?}", stage.session.diagnostics());
    stage.until("the triangle", |stage| stage.colour() != [0, 0, 0]);
    assert!(stage.session.project().pass(&model).is_some());
}

#[test]
fn unusable_drops_are_reported_and_projects_open() {
    let Some(mut stage) = Stage::open(&[("image.glsl", MOUSE), ("notes.docx", ""), ("lone.glsl", MOUSE)]) else {
        return;
    };
    let before = stage.session.project().clone();
    stage.drop_files(&["notes.docx"], None);
    assert!(stage.session.notices().last().unwrap().text.contains("notes.docx is not a file Eddy can open"));
    assert_eq!(*stage.session.project(), before);
    stage.drop_files(&["lone.glsl"], None);
    assert_eq!(stage.session.project().name, "lone");
}

/// Two passes, one of which reads the other.
const RINGS: &str = r#"{"ver":"0.1","info":{"name":"Rings","description":"","tags":[]},"renderpass":[
{"type":"buffer","name":"Buffer A","inputs":[],"outputs":[{"id":"4dXGR8","channel":0}],"code":"void mainImage(out vec4 o, vec2 p) { o = vec4(0.5); }"},
{"type":"image","name":"Image","outputs":[],"code":"void mainImage(out vec4 o, vec2 p) { o = texelFetch(iChannel2, ivec2(0), 0); }",
"inputs":[{"id":"4dXGR8","channel":2,"type":"buffer","sampler":{"filter":"nearest","wrap":"clamp","vflip":"true"}}]}]}"#;

#[test]
fn a_dropped_json_and_a_dropped_folder_are_opened_with_their_channels() {
    let Some(mut stage) = Stage::open(&[("image.glsl", MOUSE), ("rings.json", RINGS)]) else { return };
    stage.drop_files(&["rings.json"], None);
    assert_eq!(stage.session.project().name, "Rings");
    assert_eq!(reads(&stage, 2), Some(Input::buffer("A")));
    stage.until("its picture", |stage| {
        let state = stage.session.compile_state();
        state.last.is_some() && !state.compiling && stage.session.diagnostics().is_empty()
    });

    let waves = stage.folder.path().join("waves");
    std::fs::create_dir(&waves).unwrap();
    let manifest = "name = \"Waves\"\n[passes.buffer_a]\n[passes.image]\nchannels.1 = { buffer = \"A\" }\n";
    for (name, text) in [("eddy.toml", manifest), ("image.glsl", MOUSE), ("buffer_a.glsl", MOUSE)] {
        std::fs::write(waves.join(name), text).unwrap();
    }
    stage.drop_files(&["waves"], None);
    assert_eq!(stage.session.project().name, "Waves");
    assert_eq!(reads(&stage, 1), Some(Input::buffer("A")));
}

#[test]
fn text_pasted_outside_the_code_is_opened() {
    let Some(mut stage) = Stage::open(&[("image.glsl", MOUSE)]) else { return };
    stage.click("viewport");
    let text = "#iChannel3 \"keyboard\"\nvoid mainImage(out vec4 o, in vec2 p) { o = vec4(0.5); }";
    stage.frame(vec![Event::Paste(text.into())]);
    assert_eq!(stage.session.project().name, "Pasted shader");
    assert_eq!(reads(&stage, 3), Some(Input::KEYBOARD));
    assert!(stage.session.is_dirty(), "it lies nowhere else");
    stage.frame(vec![Event::Paste("https://www.shadertoy.com/view/abc".into())]);
    assert!(stage.session.notices().last().unwrap().text.contains("bookmarklet"));
}

/// A panel that is closed or hidden by another tab measures nothing; an open one measures only what is visible.
#[test]
fn only_visible_measurements_run() {
    let text = format!("{}{MOUSE}", "//@probe max(image.x)\n".repeat(40));
    let Some(mut stage) = Stage::open(&[("image.glsl", &text)]) else { return };
    let count = |stage: &Stage| stage.session.measured_frames();
    // Slow read-backs are repeated less often.
    stage.session.apply(CanvasCommand::SetFixedSize(Some((16, 9))));
    stage.session.apply(TransportCommand::Play);
    (0..5).for_each(|_| drop(stage.frame(vec![])));
    assert_eq!((stage.session.measures().len(), count(&stage)), (40, 0));

    let press = |stage: &mut Stage, key: egui::Key| {
        let modifiers = Modifiers { ctrl: true, command: true, shift: true, ..Modifiers::NONE };
        // A key that is never released counts as pressed once.
        let change = |pressed| Event::Key { key, physical_key: None, pressed, repeat: false, modifiers };
        stage.frame(vec![change(true), change(false)]);
    };
    press(&mut stage, egui::Key::J);
    stage.until("a measured frame", |stage| count(stage) > 2);
    assert!(stage.shell.place("panel:measurements").is_some());
    let measured = |stage: &Stage| stage.session.measures().iter().filter(|m| m.record.newest().is_some()).count();
    assert!((1..20).contains(&measured(&stage)), "those in sight: {}", measured(&stage));

    stage.click("measures:go:1");
    assert_eq!(stage.shell.caret(), (Tab::image(), 1));

    // Hidden by another tab of its place.
    press(&mut stage, egui::Key::T);
    stage.until("the buffers in front", |stage| stage.shell.place("measures:card:0").is_none());
    stage.frame(vec![]);
    let covered = count(&stage);
    (0..20).for_each(|_| drop(stage.frame(vec![])));
    assert_eq!(count(&stage), covered);
    press(&mut stage, egui::Key::T);
    stage.until("it is in front again", |stage| count(stage) > covered);

    press(&mut stage, egui::Key::J);
    stage.until("the panel is closed", |stage| stage.shell.place("panel:measurements").is_none());
    stage.frame(vec![]);
    let closed = count(&stage);
    let frame = stage.session.transport().frame;
    (0..20).for_each(|_| drop(stage.frame(vec![])));
    assert!(stage.session.transport().frame > frame && stage.shell.place("measures:card:0").is_none());
    assert_eq!(count(&stage), closed);
}
