//! A paused picture stands still: whatever is done to its code or its window shows the same frame, drawn from the same
//! state, and nothing of it is in the frames that follow.

use crate::support::{self, stage::*};
use eddy::{
    project::{Channel, Input, PassEdit, PassName, Tab},
    session::{
        CanvasCommand, CaptureCommand, Command, EditCommand, InputCommand, Level, ToolCommand, TransportCommand,
        ViewCommand, probe::ProbePlace,
    },
};
use std::{fs, time::Duration};

/// Adds up what it sees of time, input and a slider, twice a frame; some texels keep what they had two draws before.
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

/// Paused at frame 100, with a hand that has been on it.
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
    assert_eq!(place(&stage).1, 101, "input draws a frame, as on the site");
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

/// The texels of the frame after the one that is shown.
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
        assert!(texels(&mut edited) == before, "as if there had been no edit");
    }
    others.dedup();
    assert!(others.len() == 1 && others[0] != before, "the other code draws one and the same frame each time");
    // Image alone; a mistake; a channel; another pass, and none.
    edit(&mut edited, image_tab(), &SHOW.replace("0);", "0).yxzw;"));
    edit(&mut edited, image_tab(), "void mainImage(");
    edit(&mut edited, image_tab(), SHOW);
    let channel = Some(Channel::new(Input::KEYBOARD));
    for channel in [channel, None] {
        edited.compile(Command::Edit(EditCommand::SetChannel { pass: PassName::image(), index: 2, channel }));
    }
    edited.compile(Command::Edit(EditCommand::AddTab(Tab::Pass(PassName::buffer("B")))));
    edited.compile(Command::Edit(EditCommand::EditPasses(PassEdit::Remove(Tab::Pass(PassName::buffer("B"))))));
    // From disk as well.
    edited.write("buffer_a.glsl", &other);
    edited.session.apply(InputCommand::Focus(true));
    edited.until("the text of the disk", |s| s.text(&buffer_a()).contains("1.5"));
    edited.until_compiled();
    assert!(texels(&mut edited) == others[0]);
    edit(&mut edited, buffer_a(), SUM);
    assert_eq!(place(&edited), shown);
    assert!(texels(&mut edited) == before);
    for _ in 0..5 {
        assert!(next(&mut edited) == next(&mut control), "what follows is what would have followed");
    }
    assert_eq!(place(&edited), place(&control));
    assert!(edited.notices(Level::Warning).is_empty(), "{:?}", edited.notices(Level::Warning));
}

#[test]
fn looking_at_a_paused_picture_steps_nothing() {
    let Some(gpu) = support::gpu() else { return };
    let (mut looked, mut control) = (stage(gpu.clone()), stage(gpu));
    let (shown, before) = (place(&looked), texels(&mut looked));
    let at = SUM.find("old * 1.25").unwrap();
    let probe = |at: usize| Command::View(ViewCommand::Probe(Some(ProbePlace { tab: buffer_a(), at, visit: 0 })));
    let looks: Vec<Vec<Command>> = vec![
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
    for commands in looks {
        let what = format!("{commands:?}");
        commands.into_iter().for_each(|command| looked.session.apply(command));
        looked.until_compiled();
        for _ in 0..20 {
            looked.tick();
            std::thread::sleep(Duration::from_millis(1));
        }
        assert_eq!(place(&looked), shown, "{what}");
        assert!(!looked.session.transport().playing, "{what}");
    }
    assert!(texels(&mut looked) == before, "the texels that a smaller canvas has no room for are back");
    assert!(next(&mut looked) == next(&mut control));
}

#[test]
fn a_slider_that_is_turned_while_paused_draws_the_same_frame() {
    let Some(gpu) = support::gpu() else { return };
    let (mut turned, mut control) = (stage(gpu.clone()), stage(gpu));
    let (shown, before) = (place(&turned), texels(&mut turned));
    for value in ["gain=0.5", "gain=0.75", "gain=0.25"] {
        turned.act(Command::Edit(EditCommand::AssignCustomUniform(value.into())));
        assert_eq!(place(&turned), shown);
        assert_eq!(texels(&mut turned) == before, value == "gain=0.25", "{value}");
    }
    // On a smaller canvas too, from the texels of the large one.
    turned.act(Command::Canvas(CanvasCommand::SetFixedSize(Some((5, 3)))));
    turned.act(Command::Edit(EditCommand::AssignCustomUniform("gain=0.125".into())));
    assert_eq!(turned.session.transport().resolution, (5, 3));
    turned.session.apply(CanvasCommand::SetFixedSize(Some((8, 4))));
    turned.act(Command::Edit(EditCommand::AssignCustomUniform("gain=0.25".into())));
    assert!(texels(&mut turned) == before);
    assert!(next(&mut turned) == next(&mut control));
    // To have changed it before a frame is to have drawn that frame with it.
    control.session.apply(EditCommand::AssignCustomUniform("gain=1.0".into()));
    turned.act(Command::Edit(EditCommand::AssignCustomUniform("gain=1.0".into())));
    assert!(next(&mut turned) == next(&mut control));
}

#[test]
fn what_begins_to_run_before_the_frame_is_drawn_again_misses_no_step() {
    let Some(gpu) = support::gpu() else { return };
    let (mut edited, mut control) = (stage(gpu.clone()), stage(gpu));
    for stage in [&mut edited, &mut control] {
        stage.session.apply(TransportCommand::SetFixedRate(Some(60.0)));
    }
    let begin = |stage: &mut Stage| {
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
    begin(&mut edited);
    edited.until_compiled();
    begin(&mut control);
    assert_eq!(place(&edited), place(&control));
    assert!(texels(&mut edited) == texels(&mut control));
}

#[test]
fn frame_0_of_new_code_begins_as_that_code_begins() {
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
    assert_eq!((stage.red(), place(&stage).1), (214, 1), "what was seeded stays");
}
