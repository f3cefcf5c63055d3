//! A session whose code is looked into: a traced pixel and a probe change nothing of what is simulated.

use crate::support::{self, stage::*};
use eddy::{
    engine::Paint,
    project::{PassName, Tab},
    session::{
        CanvasCommand, CaptureCommand, Command, EditCommand, FileCommand, SessionOptions, ToolCommand,
        TransportCommand, ViewCommand,
        probe::{ProbeLook, ProbePlace},
    },
};
use std::fs;

/// Sums what it saw of time, so that any frame that differs shows.
const HISTORY: &str = "void mainImage(out vec4 o, in vec2 p) {
    vec4 before = texelFetch(iChannel0, ivec2(p), 0);
    o = before * 0.5 + vec4(iTime + float(iFrame), p, 1.0);
}";
const SHOW: &str = "void mainImage(out vec4 o, in vec2 p) {
    vec4 there = texelFetch(iChannel0, ivec2(p), 0);
    float alone = p.x * 2.0;
    o = there + vec4(alone);
}";
const FILES: [(&str, &str); 2] = [("buffer_a.glsl", HISTORY), ("image.glsl", SHOW)];

fn buffer_a() -> PassName {
    PassName::buffer("A")
}

fn step(stage: &mut Stage, count: usize) {
    (0..count).for_each(|_| stage.session.apply(TransportCommand::Step));
    stage.tick();
}

#[test]
fn a_pixel_is_traced_from_what_is_there_and_nothing_is_drawn_for_it() {
    let Some(gpu) = support::gpu() else { return };
    let mut stage = Stage::open(gpu, &FILES);
    step(&mut stage, 5);
    let (frames, frame) = (stage.frames(), stage.session.transport().frame);
    for pass in [PassName::image(), buffer_a()] {
        stage.session.apply(ViewCommand::ShowPass(pass.clone()));
        stage.session.apply(ToolCommand::Trace(Some([0.4, 0.6])));
        stage.until("a trace", |s| s.trace().traced.is_some_and(|traced| traced.pass == pass));
        let traced = stage.session.trace().traced.unwrap().clone();
        assert_eq!((traced.pixel, traced.size, traced.frame), ((3, 2), (8, 4), frame));
        assert_eq!((traced.value, traced.ulps()), (Some(traced.device), Some(vec![0; 4])), "{}", pass.title());
    }
    assert_eq!((stage.frames(), stage.session.transport().frame), (frames, frame));
    // The next frame is walked through by itself.
    step(&mut stage, 1);
    stage.until("the next frame's", |s| s.trace().traced.is_some_and(|traced| traced.frame == frame + 1));
    let traced = stage.session.trace().traced.unwrap();
    assert_eq!(traced.value, Some(traced.device));
    stage.session.apply(ToolCommand::Trace(None));
    assert!(stage.session.trace().traced.is_none());
}

#[test]
fn a_probe_has_the_numbers_and_the_buffers_go_on() {
    let Some(gpu) = support::gpu() else { return };
    let run = |probes: bool| {
        let mut stage = Stage::open(gpu.clone(), &FILES);
        step(&mut stage, 3);
        // Another program draws one frame while paused, whatever it draws.
        let at = SHOW.find("p.x * 2.0").unwrap() + 5;
        let place = ProbePlace { tab: Tab::image(), at, visit: 0 };
        stage.compile(if probes {
            Command::View(ViewCommand::Probe(Some(place)))
        } else {
            Command::Edit(EditCommand::CompileNow)
        });
        step(&mut stage, 4);
        if probes {
            stage.until("numbers", |s| s.probe().is_some_and(|view| view.numbers.is_some()));
            let view = stage.session.probe().unwrap();
            let value = view.value.unwrap().unwrap();
            assert_eq!((value.text.as_str(), value.type_text.as_str(), value.line), ("p.x * 2.0", "float", 3));
            let numbers = view.numbers.unwrap();
            assert_eq!(numbers.pixels.texels[9], [3.0, 3.0, 3.0, 1.0]);
            assert_eq!(numbers.statistics.extremes[0], Some((1.0, 15.0)));
        }
        stage.compile(if probes {
            Command::View(ViewCommand::Probe(None))
        } else {
            Command::Edit(EditCommand::CompileNow)
        });
        step(&mut stage, 2);
        stage.session.apply(ViewCommand::ShowPass(buffer_a()));
        stage.session.apply(CaptureCommand::SaveTexels);
        (stage.session.transport().frame, fs::read(stage.path("project-buffer_a-0001.npy")).unwrap())
    };
    let (with, without) = (run(true), run(false));
    assert_eq!(with.0, without.0, "as many frames");
    assert!(with.1 == without.1, "the value that was probed does not read the buffer, which goes on all the same");
}

#[test]
fn a_probe_that_is_shown_otherwise_is_painted_though_nothing_is_drawn() {
    let Some(gpu) = support::gpu() else { return };
    let mut stage = Stage::with_options(gpu, |_| SessionOptions { draws_on_thread: true, ..SessionOptions::default() });
    FILES.iter().for_each(|(name, text)| stage.write(name, text));
    let folder = stage.folder();
    stage.session.apply(FileCommand::Open(folder.to_str().unwrap().into()));
    stage.session.apply(TransportCommand::Pause);
    // A picture that is drawn within a few milliseconds is waited for in the tick that asks for it.
    stage.compile(Command::Canvas(CanvasCommand::SetFixedSize(Some((2048, 1024)))));
    let at = SHOW.find("p.x * 2.0").unwrap() + 5;
    let place = ProbePlace { tab: Tab::image(), at, visit: 0 };
    stage.session.apply(ViewCommand::Probe(Some(place)));
    stage.until("numbers", |s| s.probe().is_some_and(|view| view.numbers.is_some()));
    stage.for_a_while();
    let frames = stage.frames();
    stage.session.apply(ViewCommand::LookAtProbe(ProbeLook { paint: Paint::FalseColour, ..ProbeLook::default() }));
    // The tick that hears of the wish, then one that has the picture.
    assert!(stage.tick().changed);
    let end = std::time::Instant::now() + std::time::Duration::from_secs(30);
    while !stage.tick().changed {
        assert!(std::time::Instant::now() < end, "never painted");
        std::thread::sleep(std::time::Duration::from_millis(2));
    }
    assert_eq!(stage.frames(), frames);
}

#[test]
fn a_breakpoint_stands_where_a_statement_does() {
    let Some(gpu) = support::gpu() else { return };
    let image = "// A comment.\n\
        float twice(float x) {\n\
        \x20   // Within.\n\
        \x20   return 2.0 * x;\n\
        }\n\
        \n\
        void mainImage(out vec4 o, in vec2 p) {\n\
        \x20   vec3 a = vec3(\n\
        \x20       0.5);\n\
        #if 0\n\
        \x20   a.x = 1.0;\n\
        #endif\n\
        \x20   for (int i = 0; i < 3; i++) {\n\
        \x20       a.y += 0.1;\n\
        \x20   }\n\
        \x20   o = vec4(a, twice(shade()));\n\
        }\n\
        // The end.\n";
    let mut stage = Stage::bare(gpu);
    stage.write("image.glsl", format!("#include \"shade.glsl\"\n{image}"));
    stage.write("shade.glsl", "// Light.\nfloat shade() {\n    return 0.5;\n}\n");
    stage.write("common.glsl", "const float HALF = 0.5;\nfloat half_of(float x) {\n    return HALF * x;\n}\n");
    let folder = stage.folder();
    stage.session.apply(FileCommand::Open(folder.to_str().unwrap().into()));
    stage.compile(Command::Transport(TransportCommand::Pause));
    let at = |tab: &Tab, line: usize| stage.session.stop_line(tab, line);
    let found: Vec<Option<usize>> = (0..=18).map(|line| at(&image_tab(), line)).collect();
    let wanted = [4, 4, 4, 4, 4, 8, 8, 8, 8, 8, 13, 13, 13, 13, 14, 16, 16].map(Some);
    assert_eq!(found[..17], wanted);
    assert_eq!(found[17..], [None, None], "none is below");
    let shade = Tab::Included("shade.glsl".into());
    assert_eq!([0, 2, 3].map(|line| at(&shade, line)), [Some(2), Some(2), None]);
    assert_eq!([0, 2, 3].map(|line| at(&Tab::Common, line)), [Some(2), Some(2), None]);
    // What the compiler does not understand is no reason to fall over.
    for text in ["", "{", "void mainImage(", "void mainImage(out vec4 o, in vec2 p) { o = ; for (;; }", "float f() {"] {
        stage.edit(text);
        for line in 0..3 {
            assert!(stage.session.stop_line(&image_tab(), line).is_none_or(|line| line < 3));
        }
    }
}
