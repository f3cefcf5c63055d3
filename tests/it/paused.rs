//! A paused picture is unchanged: edits of its code and changes of its window redraw the same frame from the same
//! state, and leave no trace in the following frames.

use crate::support::{self, stage::*};
use eddy::{
    project::{Channel, Input, PassEdit, PassName, Tab},
    session::{
        CanvasCommand, CaptureCommand, Command, EditCommand, InputCommand, Level, ToolCommand, TransportCommand,
        ViewCommand, probe::ProbePlace,
    },
};
use std::{fs, time::Duration};

/// Accumulates time, input and a slider, twice per frame; some texels keep their value from two draws before.
const SUM: &str = "#iUniform float gain = 0.25 in { 0.0, 1.0 }
void mainImage(out vec4 o, in vec2 p) {
    vec4 old = texelFetch(iChannel0, ivec2(p), 0);
    if (iFrame % 4 == 2 && p.y > 2.) discard;
    o = fract(old * 1.25 + vec4(iTime * 0.31 + gain, float(iFrame) * 0.07, iMouse.x * 0.01, p.x * 0.03));
}";
const SHOW: &str = "void mainImage(out vec4 o, in vec2 p) { o = texelFetch(iChannel0, ivec2(p), 0); }";
const MANIFEST: &str = "eddy = 1
[passes.buffer_a]
channels.0 = { buffer = \"A\" }
[passes.image]
channels.0 = { buffer = \"A\" }
[groups.twice]
passes = [\"buffer_a\"]
steps = 2
";

fn buffer_a() -> Tab {
    Tab::Pass(PassName::buffer("A"))
}

/// Returns a stage paused at frame 101, after a drag of the mouse.
fn stage(gpu: eddy::gpu::Gpu) -> Stage {
    let mut stage = Stage::open(gpu, &[("eddy.toml", MANIFEST), ("buffer_a.glsl", SUM), ("image.glsl", SHOW)]);
    assert!(stage.is_ok(), "{:?}", stage.session.notices());
    stage.session.apply(ViewCommand::ShowPass(PassName::buffer("A")));
    for frame in 1..=100 {
        if frame == 40 {
            stage.session.apply(InputCommand::MouseDown { x: 3.5, y: 1.5 });
        }
        stage.act(Command::Transport(TransportCommand::Step));
    }
    stage.act(Command::Input(InputCommand::MouseUp));
    assert_eq!(place(&stage).1, 101, "input draws a frame, as on Shadertoy");
    stage
}

fn place(stage: &Stage) -> (f64, i32) {
    let transport = stage.session.transport();
    (transport.time_secs, transport.frame)
}

fn texels(stage: &mut Stage) -> Vec<u8> {
    stage.act(Command::Capture(CaptureCommand::SaveTexels));
    fs::read(stage.session.notices().iter().rev().find_map(|n| n.path.clone()).unwrap()).unwrap()
}

fn edit(stage: &mut Stage, tab: Tab, text: &str) {
    stage.session.apply(EditCommand::EditText { tab, text: text.into() });
    stage.compile(Command::Edit(EditCommand::CompileNow));
    stage.tick();
}

/// Steps, and returns the texels of the next frame.
fn next(stage: &mut Stage) -> Vec<u8> {
    stage.act(Command::Transport(TransportCommand::Step));
    texels(stage)
}

#[test]
fn an_edit_while_paused_draws_the_same_frame_from_the_same_state() {
    let Some(gpu) = support::gpu() else { return };
    let other = SUM.replace("1.25", "1.5");
    let (mut edited, mut control) = (stage(gpu.clone()), stage(gpu));
    let (shown, before) = (place(&edited), texels(&mut edited));
    let mut others = Vec::new();
    for _ in 0..4 {
        edit(&mut edited, buffer_a(), &other);
        assert_eq!(place(&edited), shown);
        others.push(texels(&mut edited));
        edit(&mut edited, buffer_a(), SUM);
        assert_eq!(place(&edited), shown);
        assert!(texels(&mut edited) == before, "the original code draws the original frame");
    }
    others.dedup();
    assert!(others.len() == 1 && others[0] != before, "the other code draws the same, different frame each time");
    // Edits of Image alone: a change and an error; then a channel, and a pass that is added and removed.
    edit(&mut edited, image_tab(), &SHOW.replace("0);", "0).yxzw;"));
    edit(&mut edited, image_tab(), "void mainImage(");
    edit(&mut edited, image_tab(), SHOW);
    let channel = Some(Channel::new(Input::KEYBOARD));
    for channel in [channel, None] {
        edited.compile(Command::Edit(EditCommand::SetChannel { pass: PassName::image(), index: 2, channel }));
    }
    edited.compile(Command::Edit(EditCommand::AddTab(Tab::Pass(PassName::buffer("B")))));
    edited.compile(Command::Edit(EditCommand::EditPasses(PassEdit::Remove(Tab::Pass(PassName::buffer("B"))))));
    // Changes on disk.
    edited.write("buffer_a.glsl", &other);
    edited.session.apply(InputCommand::Focus(true));
    edited.until("the text of the disk", |s| s.text(&buffer_a()).contains("1.5"));
    edited.until_compiled();
    assert!(texels(&mut edited) == others[0]);
    edit(&mut edited, buffer_a(), SUM);
    assert_eq!(place(&edited), shown);
    assert!(texels(&mut edited) == before);
    for _ in 0..5 {
        assert!(next(&mut edited) == next(&mut control), "the following frames are unaffected");
    }
    assert_eq!(place(&edited), place(&control));
    assert!(edited.notices(Level::Warning).is_empty(), "{:?}", edited.notices(Level::Warning));
}

#[test]
fn inspecting_a_paused_picture_does_not_advance_it() {
    let Some(gpu) = support::gpu() else { return };
    let (mut inspected, mut control) = (stage(gpu.clone()), stage(gpu));
    let (shown, before) = (place(&inspected), texels(&mut inspected));
    let at = SUM.find("old * 1.25").unwrap();
    let probe = |at: usize| Command::View(ViewCommand::Probe(Some(ProbePlace { tab: buffer_a(), at, visit: 0 })));
    let inspections: Vec<Vec<Command>> = vec![
        vec![probe(at)],
        vec![probe(at + 6)],
        vec![Command::View(ViewCommand::Probe(None))],
        vec![Command::Tool(ToolCommand::Trace(Some([0.4, 0.6])))],
        vec![Command::Tool(ToolCommand::FindDivergence)],
        vec![Command::Tool(ToolCommand::Trace(None))],
        vec![Command::Tool(ToolCommand::Audit)],
        vec![Command::Tool(ToolCommand::HideAudit)],
        vec![Command::Capture(CaptureCommand::Screenshot)],
        vec![Command::View(ViewCommand::ShowPass(PassName::image()))],
        vec![Command::View(ViewCommand::ShowPass(PassName::buffer("A")))],
        vec![Command::Tool(ToolCommand::FindNonfinite(true))],
        vec![Command::Tool(ToolCommand::FindNonfinite(false))],
        vec![Command::View(ViewCommand::WatchCosts(true))],
        vec![Command::Canvas(CanvasCommand::Cover(true))],
        vec![Command::Canvas(CanvasCommand::Cover(false))],
        vec![Command::Input(InputCommand::Focus(false)), Command::Input(InputCommand::Focus(true))],
        vec![Command::Canvas(CanvasCommand::SetFixedSize(Some((6, 3))))],
        vec![Command::Canvas(CanvasCommand::SetFixedSize(Some((24, 12))))],
        vec![Command::Canvas(CanvasCommand::SetFixedSize(Some((3, 30))))],
        vec![Command::Canvas(CanvasCommand::SetFixedSize(Some((8, 4))))],
        vec![
            Command::Canvas(CanvasCommand::SetFixedSize(None)),
            Command::Canvas(CanvasCommand::SetViewport { width: 16, height: 8 }),
            Command::Canvas(CanvasCommand::SetScale(0.25)),
        ],
        vec![Command::Canvas(CanvasCommand::SetViewport { width: 20, height: 20 })],
        vec![Command::Canvas(CanvasCommand::SetFixedSize(Some((8, 4))))],
    ];
    for commands in inspections {
        let what = format!("{commands:?}");
        commands.into_iter().for_each(|command| inspected.session.apply(command));
        inspected.until_compiled();
        for _ in 0..20 {
            inspected.tick();
            std::thread::sleep(Duration::from_millis(1));
        }
        assert_eq!(place(&inspected), shown, "{what}");
        assert!(!inspected.session.transport().playing, "{what}");
    }
    assert!(texels(&mut inspected) == before, "the texels outside a smaller picture are restored");
    assert!(next(&mut inspected) == next(&mut control));
}

#[test]
fn moving_a_slider_while_paused_redraws_the_same_frame() {
    let Some(gpu) = support::gpu() else { return };
    let (mut moved, mut control) = (stage(gpu.clone()), stage(gpu));
    let (shown, before) = (place(&moved), texels(&mut moved));
    for value in ["gain=0.5", "gain=0.75", "gain=0.25"] {
        moved.act(Command::Edit(EditCommand::AssignCustomUniform(value.into())));
        assert_eq!(place(&moved), shown);
        assert_eq!(texels(&mut moved) == before, value == "gain=0.25", "{value}");
    }
    // Also at a smaller size, from the texels of the large picture.
    moved.act(Command::Canvas(CanvasCommand::SetFixedSize(Some((5, 3)))));
    moved.act(Command::Edit(EditCommand::AssignCustomUniform("gain=0.125".into())));
    assert_eq!(moved.session.transport().resolution, (5, 3));
    moved.session.apply(CanvasCommand::SetFixedSize(Some((8, 4))));
    moved.act(Command::Edit(EditCommand::AssignCustomUniform("gain=0.25".into())));
    assert!(texels(&mut moved) == before);
    assert!(next(&mut moved) == next(&mut control));
    // Changing it before a frame is the same as drawing that frame with the new value.
    control.session.apply(EditCommand::AssignCustomUniform("gain=1.0".into()));
    moved.act(Command::Edit(EditCommand::AssignCustomUniform("gain=1.0".into())));
    assert!(next(&mut moved) == next(&mut control));
}

#[test]
fn playing_before_the_redraw_skips_no_step() {
    let Some(gpu) = support::gpu() else { return };
    let (mut edited, mut control) = (stage(gpu.clone()), stage(gpu));
    for stage in [&mut edited, &mut control] {
        stage.session.apply(TransportCommand::SetFixedRate(Some(60.0)));
    }
    let play_to_110 = |stage: &mut Stage| {
        stage.session.apply(TransportCommand::Play);
        while place(stage).1 < 110 {
            stage.tick();
        }
        stage.session.apply(TransportCommand::Pause);
    };
    edited.session.apply(EditCommand::EditText { tab: buffer_a(), text: format!("{SUM}\n// the same") });
    edited.session.apply(CanvasCommand::SetFixedSize(Some((4, 2))));
    edited.session.apply(CanvasCommand::SetFixedSize(Some((8, 4))));
    edited.session.apply(EditCommand::CompileNow);
    play_to_110(&mut edited);
    edited.until_compiled();
    play_to_110(&mut control);
    assert_eq!(place(&edited), place(&control));
    assert!(texels(&mut edited) == texels(&mut control));
}

#[test]
fn frame_0_is_redrawn_from_the_initial_state_of_new_code() {
    let Some(gpu) = support::gpu() else { return };
    let seeded = |red: &str| {
        format!(
            "void mainImage(out vec4 o, in vec2 p) {{
    o = texelFetch(iChannel0, ivec2(p), 0);
    if (iFrame == 0) o = o * 0.5 + vec4({red}, 0.0, 0.0, 1.0);
}}"
        )
    };
    let mut stage =
        Stage::open(gpu, &[("eddy.toml", MANIFEST), ("buffer_a.glsl", &seeded("0.4")), ("image.glsl", SHOW)]);
    assert_eq!((stage.red(), place(&stage).1), (153, 0), "0.4 · 0.5 + 0.4");
    edit(&mut stage, buffer_a(), &seeded("0.56"));
    assert_eq!((stage.red(), place(&stage).1), (214, 0), "0.56 · 0.5 + 0.56");
    stage.act(Command::Transport(TransportCommand::Step));
    edit(&mut stage, buffer_a(), &seeded("0.2"));
    assert_eq!((stage.red(), place(&stage).1), (214, 1), "the seed is kept after frame 0");
}
