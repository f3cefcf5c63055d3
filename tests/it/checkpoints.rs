//! `eddy render --checkpoint-every` and `--resume`: frames of a project with state are the same when many calls draw
//! them as when one does.

use crate::support::program::Bench;
use std::fs;

/// Sums values of time, mouse, keys, a slider and music; every third frame keeps some of its previous texels.
const HISTORY: &str = "#iUniform float level = 0.5 in { 0.0, 1.0 }
void mainImage(out vec4 o, in vec2 p) {
    vec4 before = texelFetch(iChannel0, ivec2(p), 0);
    if (iFrame % 3 == 1 && p.x > 5.) discard;
    float key = texelFetch(iChannel1, ivec2(32, 0), 0).x, sound = texelFetch(iChannel2, ivec2(p.x * 9.0, 0), 0).x;
    o = fract(before * 1.01 + vec4(iTime * 0.37 + key, sound, level, 0.0) + abs(iMouse) * 0.013 + vec4(0, 0, 0, p.x * 0.01));
}";
const SHOW: &str = "void mainImage(out vec4 o, in vec2 p) { o = texelFetch(iChannel0, ivec2(p), 0) + 0.1 * iTime; }";
const MANIFEST: &str = "eddy = 1\n[passes.buffer_a]\nformat = \"rgba16f\"\nchannels.0 = { buffer = \"A\" }\n\
    channels.1 = { keyboard = true }\nchannels.2 = { file = \"tone.wav\", kind = \"music\" }\n\
    [passes.image]\nchannels.0 = { buffer = \"A\" }\n";
const INPUT: &str = "--size 16x9 --fps 30 --set level=0.25";

/// Creates a folder with the project `p`, which plays a rising tone.
fn project_with_state() -> Option<Bench> {
    let b = Bench::with_gpu()?;
    let sample = |n: u32| (12_000.0 * (f64::from(n) * f64::from(n) * 2e-6).sin()) as i16;
    let frames: Vec<[i16; 2]> = (0..66_150).map(|n| [sample(n); 2]).collect();
    b.write("p/tone.wav", eddy::audio::wav(&frames));
    b.write("p/eddy.toml", MANIFEST);
    b.write("p/buffer_a.glsl", HISTORY);
    b.write("p/image.glsl", SHOW);
    Some(b)
}

fn render<'a>(b: &Bench, more: impl IntoIterator<Item = &'a str>) -> crate::support::program::Run {
    let input = ["--mouse", "3:down 2,2; 20:move 9,4; 33:up", "--keys", "5:down 32; 31:up 32"];
    b.eddy(["render", "p"].into_iter().chain(INPUT.split(' ')).chain(input).chain(more))
}

fn files(b: &Bench, folder: &str) -> Vec<(String, Vec<u8>)> {
    b.names(folder).into_iter().map(|name| (name.clone(), b.bytes(&format!("{folder}/{name}")))).collect()
}

#[test]
fn seven_tasks_from_checkpoints_equal_one_run() {
    let Some(b) = project_with_state() else { return };
    render(&b, ["--frames", "0-41", "--out", "serial"]).expect(0);
    // Image is not drawn for the checkpoints, and nothing else is written.
    let run =
        render(&b, ["--frames", "0-41", "--checkpoint-every", "6", "--checkpoints", "states", "--json"]).expect(0);
    assert_eq!(run.json()[0]["frames"], 42);
    let states = b.names("states");
    assert_eq!(states.len(), 7, "{states:?}");
    assert!(states[0] == "p_000006.eddystate" && states[6] == "p_000042.eddystate");
    for task in 0..7 {
        let shard = format!("{task}/7");
        let run = render(&b, ["--frames", "0-41", "--shard", &shard, "--resume", "states", "--out", "farm", "--json"])
            .expect(0);
        // The frames of a shard are consecutive.
        assert!(run.json()[0]["frames"].as_u64().unwrap() <= 12, "{}", run.out);
    }
    assert!(files(&b, "serial") == files(&b, "farm"));
    // Resume from a named checkpoint, and from a checkpoint of a resumed run.
    render(
        &b,
        ["--frames", "18-23", "--resume", "states/p_000012.eddystate", "--out", "part", "--checkpoint-every", "6"],
    )
    .expect(0);
    assert_eq!(b.bytes("part/p_000018.eddystate"), b.bytes("states/p_000018.eddystate"));
    assert_eq!(b.bytes("part/p_0020.png"), b.bytes("serial/p_0020.png"));
}

#[test]
fn a_checkpoint_of_another_run_is_rejected_with_the_reason() {
    let Some(b) = project_with_state() else { return };
    render(&b, ["--frames", "0-9", "--checkpoint-every", "5", "--checkpoints", "s"]).expect(0);
    let resumed =
        |more: &[&str]| render(&b, ["--at", "7", "--json", "--resume", "s"].into_iter().chain(more.iter().copied()));
    resumed(&[]).expect(0);
    for (more, expected) in [
        (&["--set", "level=0.75"][..], "have changed since"),
        (&["--date", "2026-01-01"], "have changed since"),
        (&["--resume", "s/p_000010.eddystate"], "cannot be used multiple times"),
    ] {
        let run = resumed(more);
        assert!(
            run.code != Some(0) && (run.out.clone() + &run.err).contains(expected),
            "{expected}: {} {}",
            run.out,
            run.err
        );
    }
    let late = render(&b, ["--at", "7", "--json", "--resume", "s/p_000010.eddystate"]);
    assert!(late.code == Some(2) || late.code == Some(1), "{late:?}");
    assert!((late.out + &late.err).contains("it is before frame 10, and frame 7 is to be written"));
    // The project has changed. A folder without a checkpoint draws from frame 0 and reports it.
    b.write("p/image.glsl", SHOW.replace("0.1", "0.2"));
    let run = resumed(&[]);
    assert!(run.code != Some(0) && (run.out + &run.err).contains("have changed since"));
    fs::create_dir(b.path("empty")).unwrap();
    let run = render(&b, ["--at", "7", "--json", "--resume", "empty"]).expect(0);
    assert_eq!(run.json()[0]["frames"], 8);
    assert!(run.out.contains("no checkpoint of p is at or before frame 7"), "{}", run.out);
    // A truncated checkpoint.
    let whole = b.bytes("s/p_000005.eddystate");
    b.write("s/p_000005.eddystate", &whole[..whole.len() / 2]);
    let run = render(&b, ["--at", "7", "--json", "--resume", "s/p_000005.eddystate"]);
    assert!(run.code != Some(0) && (run.out + &run.err).contains("p_000005.eddystate"));
}

#[test]
fn a_stateless_project_writes_no_checkpoints() {
    let Some(b) = Bench::with_gpu() else { return };
    b.image("plain.glsl", "fragColor = vec4(iTime);");
    let run = b.line("render plain.glsl --size 8x4 --frames 0-9 --checkpoint-every 5 --checkpoints s --json").expect(0);
    assert!(run.out.contains("has no state"), "{}", run.out);
    assert!(b.names("s").is_empty());
}

#[test]
fn pictures_contain_their_project_unless_disabled() {
    use eddy::playback::scene::{Scene, SceneInputs};
    let Some(b) = project_with_state() else { return };
    render(&b, ["--at", "12", "--out", "a.png"]).expect(0);
    let scene = Scene::read(&b.path("a.png")).unwrap();
    assert_eq!((scene.frame, scene.size), (12, (16, 9)));
    let SceneInputs::Script(script) = &scene.inputs else { panic!("{:?}", scene.inputs) };
    assert_eq!((script.fps, script.keys.as_str()), (30.0, "5:down 32; 31:up 32"));
    assert_eq!(scene.frames(true).unwrap().len(), 13);
    assert!(scene.project.custom_uniform_values.contains_key("level"));
    render(&b, ["--at", "12", "--out", "b.png", "--no-project"]).expect(0);
    assert!(!Scene::is_in(&b.bytes("b.png")) && b.png("a.png") == b.png("b.png"));
    render(&b, ["--at", "12", "--out", "a.exr"]).expect(0);
    let of_floats = Scene::read(&b.path("a.exr")).unwrap();
    assert_eq!((of_floats.frame, of_floats.inputs), (scene.frame, scene.inputs.clone()));
    render(&b, ["--at", "12", "--out", "b.exr", "--no-project"]).expect(0);
    assert!(!Scene::is_in(&b.bytes("b.exr")));
    let floats = |name: &str| image::load_from_memory(&b.bytes(name)).unwrap().into_rgba32f();
    assert_eq!(floats("a.exr"), floats("b.exr"));
    // A picture that is not a single frame of the project does not contain it.
    render(&b, ["--at", "12", "--out", "c.png", "--supersample", "2"]).expect(0);
    assert!(!Scene::is_in(&b.bytes("c.png")));
}

#[test]
fn a_plan_counts_the_frames_of_each_task_and_writes_nothing() {
    let Some(b) = project_with_state() else { return };
    let plan = |more: &[&str]| {
        let run = render(&b, ["--plan", "--json"].into_iter().chain(more.iter().copied())).expect(0);
        run.json().remove(0)["plan"].clone()
    };
    let found = plan(&["--frames", "0-41", "--shard", "0/7"]);
    let resumed = &found["resumed"];
    assert_eq!((&found["writes"], &found["tasks"], &found["most_frames"]), (&42.into(), &7.into(), &42.into()));
    assert_eq!(found["state"], serde_json::json!(["Buffer A"]));
    assert_eq!(
        (&resumed["checkpoint_every"], &resumed["most_frames"], &resumed["serial_frames"]),
        (&6.into(), &6.into(), &36.into())
    );
    assert!(found["state_ms"].as_f64().is_some_and(|millis| millis > 0.0));
    // Blocks of 5 and 6 frames: some start between two checkpoints.
    let found = plan(&["--frames", "0-36", "--shard", "0/7"]);
    assert!(found["resumed"]["most_frames"].as_u64().is_some_and(|max| (6..12).contains(&max)), "{found}");
    assert!(plan(&["--frames", "0-41"])["resumed"].is_null());
    b.image("plain.glsl", "fragColor = vec4(iTime);");
    let run = b.line("render plain.glsl --size 8x4 --frames 0-41 --shard 0/4 --out o --plan").expect(0);
    assert!(
        run.out.contains("each can be drawn by itself") && run.out.contains("at most 11 frames each"),
        "{}",
        run.out
    );
    assert!(b.names("o").is_empty());
}

#[cfg(unix)]
#[test]
fn symbolic_links_in_the_output_folder_are_not_followed() {
    let Some(b) = project_with_state() else { return };
    let state = "--frames 4 --checkpoint-every 2 --checkpoints to --out o.png";
    let calls = [
        (state, "p_000002.eddystate"),
        ("--out to/", "p.png"),
        ("--frames 0-3 --overwrite --out to/", "p_0002.png"),
        ("--frames 0-3 --format apng --out to/", "p.apng"),
        ("--format exr --out to/", "p.exr"),
    ];
    for (arguments, name) in calls {
        for target in ["../victim", "../gone"] {
            b.write("victim", "precious");
            fs::create_dir(b.path("to")).unwrap();
            std::os::unix::fs::symlink(target, b.path("to").join(name)).unwrap();
            let run = render(&b, arguments.split(' '));
            assert_eq!(fs::read_to_string(b.path("victim")).unwrap(), "precious", "{arguments}");
            assert!(!b.path("gone").exists(), "{arguments}");
            assert!(run.code != Some(0) && run.err.contains("link"), "{arguments}: {run:?}");
            fs::remove_dir_all(b.path("to")).unwrap();
        }
    }
}
