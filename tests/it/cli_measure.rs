//! `--probe`, `--assert`, `--replay` and `eddy compare`, tested with the built program.

use crate::support::{git, program::Bench};
use gix_object::Kind;

/// A buffer whose red grows by 1 per frame from frame 3 on, and whose green is NaN from frame 5 on.
const GROWING: &str = "fragColor = vec4(max(iFrame - 2, 0), iFrame > 4 ? sqrt(float(-iFrame)) : 0., 0., 1.);";

fn write_growing_project(b: &Bench) {
    b.image("growing/buffer_a.glsl", GROWING);
    b.image("growing/image.glsl", "fragColor = texelFetch(iChannel0, ivec2(fragCoord), 0) / 16.0;");
}

#[test]
fn probes_are_measured_in_the_given_frames() {
    let Some(b) = Bench::with_gpu() else { return };
    write_growing_project(&b);
    let run = b.line("render growing --size 4x2 --at 1,4,6 --probe sum(buffer_a.x) --probe nonfinite(buffer_a) --json");
    let json = &run.expect(0).json()[0];
    let measured = json["measured"].as_array().unwrap();
    let measurement =
        |i: usize| (measured[i]["quantity"].as_str().unwrap(), &measured[i]["frame"], &measured[i]["value"]);
    assert_eq!(measured.len(), 6, "{json}");
    assert_eq!(measurement(0), ("sum(buffer_a.x)", &1.into(), &0.0.into()));
    assert_eq!(measurement(2), ("sum(buffer_a.x)", &4.into(), &16.0.into()));
    assert_eq!(measurement(4), ("sum(buffer_a.x)", &6.into(), &32.0.into()));
    assert_eq!(measurement(5), ("nonfinite(buffer_a)", &6.into(), &8.0.into()));
    assert_eq!(json["frames"], 7);
    let text = b.line("render growing --size 4x2 --at 4 --probe max(buffer_a.x)").expect(0);
    assert!(text.out.contains("max(buffer_a.x) = 2.0 in frame 4"), "{}", text.out);
}

#[test]
fn a_probe_comment_requests_a_measurement() {
    let Some(b) = Bench::with_gpu() else { return };
    write_growing_project(&b);
    b.image("growing/image.glsl", "//@probe max(buffer_a.x)\nfragColor = vec4(1.); //@probe total(buffer_a)");
    let run = b.line("render growing --size 4x2 --at 4 --json").expect(0);
    let json = &run.json()[0];
    assert_eq!(
        (&json["measured"][0]["quantity"], &json["measured"][0]["value"]),
        (&"max(buffer_a.x)".into(), &2.0.into())
    );
    let diagnostic = &json["diagnostics"][0];
    assert_eq!(
        (&diagnostic["severity"], &diagnostic["line"], &diagnostic["source"]),
        (&"warning".into(), &3.into(), &"image.glsl".into())
    );
    assert!(diagnostic["message"].as_str().unwrap().contains("not `total`"), "{diagnostic}");
}

#[test]
fn a_false_assertion_exits_with_1() {
    let Some(b) = Bench::with_gpu() else { return };
    write_growing_project(&b);
    let render_with = |assertions: &[&str]| {
        let mut arguments = vec!["render", "growing", "--size", "4x2", "--at", "2,4,6", "--json"];
        assertions.iter().for_each(|assertion| arguments.extend(["--assert", assertion]));
        b.eddy(&arguments)
    };
    render_with(&["max(buffer_a.x) <= 4", "min(image) >= 0", "sum(buffer_a.z) within 1e-4 of first"]).expect(1);
    render_with(&["max(buffer_a.x) <= 4", "sum(buffer_a.z) within 1e-4 of first"]).expect(0);
    let run = render_with(&["max(buffer_a.x) <= 1"]).expect(1);
    let diagnostics = &run.json()[0]["diagnostics"];
    let message = |i: usize| diagnostics[i]["message"].as_str().unwrap();
    assert_eq!(diagnostics.as_array().unwrap().len(), 2, "{diagnostics}");
    assert_eq!(message(0), "frame 4: max(buffer_a.x) <= 1 does not hold: it is 2");
    assert_eq!(message(1), "frame 6: max(buffer_a.x) <= 1 does not hold: it is 4");
    let invalid = b.eddy(["render", "growing", "--assert", "sum(buffer_z) < 1"]).expect(2);
    assert!(invalid.err.contains("there is no pass buffer_z"), "{}", invalid.err);
    let invalid = b.eddy(["render", "growing", "--assert", "sum(buffer_a.x) about 1"]).expect(2);
    assert!(invalid.err.contains("within TOLERANCE of VALUE"), "{}", invalid.err);
}

#[test]
fn claims_may_be_about_texels_and_depend_on_uniforms_and_inputs() {
    let Some(b) = Bench::with_gpu() else { return };
    let code = "#iUniform float level = 0.5 in { 0.0, 9.0 }\nvoid mainImage(out vec4 o, in vec2 p) \
                { o = vec4(p.y > 1. ? level : 7., p.x, 0., 1.); }";
    b.write("p.glsl", code);
    let render = |claim: &str, more: &[&str]| {
        let mut arguments = vec!["render", "p.glsl", "--size", "4x2", "--at", "3", "--json", "--assert", claim];
        arguments.extend(more);
        b.eddy(&arguments)
    };
    for claim in [
        "image.x from row 1 in level..level",
        "image.x at 3,0 == 7",
        "max(length(image.xy)) <= 7 + width",
        "mean(image.x) from row 1 within 1e-6 of first",
        "let top = 8; image.y in 0..top unless dragged because \"no\"",
        "image.z in longest_step..1 unless dragged == 0 because \"nothing moves\"",
        "max(image.x) < longest_step * 60 * 7.01",
    ] {
        render(claim, &[]).expect(0);
    }
    let drag = ["--mouse", "1:down 1,1; 2:up"];
    render("image.z in longest_step..1 unless dragged == 0 because \"nothing moves\"", &drag).expect(1);
    render("image.x from row 1 in 2..2 * level", &["--set", "level=2"]).expect(0);
    let run = render("image.x <= 2 * level because \"a lamp\"", &[]).expect(1);
    let said = run.json()[0]["diagnostics"][0]["message"].as_str().unwrap().to_owned();
    assert_eq!(
        said,
        "frame 3: image.x <= 2 * level does not hold: it is 7 at texel 0,0, the worst of 4 values (a lamp)"
    );
    for (claim, says) in [
        ("image < levl", "no #iUniform line declares `levl`: did you mean level?"),
        ("let level = 1; image < level", "the project has a uniform of this name"),
        ("image < 1; image > 0", "several assertions"),
    ] {
        let wrong = render(claim, &[]).expect(2);
        assert!(format!("{}{}", wrong.err, wrong.out).contains(says), "{claim}: {} {}", wrong.err, wrong.out);
    }
}

#[test]
fn two_pictures_are_compared_by_bits_and_by_perception() {
    let Some(b) = Bench::with_gpu() else { return };
    b.image("a.glsl", "fragColor = vec4(fragCoord / iResolution.xy, 0.5, 1.0);");
    b.image("b.glsl", "fragColor = vec4(fragCoord / iResolution.xy, fragCoord.x < 8. ? 0.5 : 0.75, 1.0);");
    let same = b.line("compare a.glsl a.glsl --size 16x16 --repeats 3 --json").expect(0);
    let json = &same.json()[0];
    assert_eq!(
        (&json["texels_apart"], &json["rmse"], &json["psnr"]),
        (&0.into(), &0.0.into(), &"inf".into()),
        "{json}"
    );
    assert_eq!((&json["project"], &json["reference"]), (&"a.glsl".into(), &"a.glsl".into()));
    let time = &json["time"];
    assert!(time["ratio"].as_f64().unwrap() > 0.0 && time["repeats"] == 3, "{time}");

    let different =
        b.line("compare a.glsl b.glsl --size 16x16 --repeats 0 --json --view difference --out d.png").expect(0);
    let json = &different.json()[0];
    assert_eq!((&json["texels_apart"], &json["largest"]), (&128.into(), &0.25.into()), "{json}");
    // A quarter in one of four components of half of the texels.
    assert!((json["rmse"].as_f64().unwrap() - (0.0625f64 / 8.0).sqrt()).abs() < 1e-9, "{json}");
    assert!(json["ssim"].as_f64().unwrap() < 1.0 && json["flip"].as_f64().unwrap() > 0.0 && json["time"].is_null());
    let picture = b.png("d.png");
    assert_eq!((picture.get_pixel(3, 3).0, picture.get_pixel(12, 3).0), ([0, 0, 0, 255], [0, 0, 64, 255]));
    b.line("compare a.glsl b.glsl --size 16x12 --repeats 0 --out s.png").expect(0);
    assert_eq!(b.png("s.png").dimensions(), (32, 12), "the pictures are side by side");
    b.line("compare a.glsl b.glsl --size 16x12 --repeats 0 --view wipe --out w.png").expect(0);
    assert_eq!(b.png("w.png").get_pixel(12, 3).0[2], 191);
    let missing = b.line("compare a.glsl c.glsl --size 16x12").expect(2);
    assert!(missing.err.contains("c.glsl"), "{}", missing.err);
}

/// A picture that does not change is skipped in a frame, which costs nothing; the reported time is that of drawing it.
#[test]
fn unchanged_pictures_are_drawn_when_timed() {
    let Some(b) = Bench::with_gpu() else { return };
    let sines = "float s = 0.0; for (int i = 0; i < 50000; i++) s += sin(fragCoord.x + float(i) * 0.37);";
    b.image("long.glsl", &format!("{sines} fragColor = vec4(s);"));
    b.image("short.glsl", "fragColor = vec4(0.5);");
    let run = b.line("compare long.glsl short.glsl --size 32x32 --repeats 3 --json").expect(0);
    let time = &run.json()[0]["time"];
    // Fifty thousand sines per pixel against one number: a ratio near 1 would mean that neither was drawn in the
    // frames.
    assert!(time["ratio"].as_f64().unwrap() > 3.0, "{time}");
}

#[test]
fn a_project_is_compared_with_its_text_in_a_revision() {
    let Some(b) = Bench::with_gpu() else { return };
    b.image("p/image.glsl", "fragColor = vec4(0.25);");
    b.image("one.glsl", "fragColor = vec4(0.25);");
    git::commit_all(&b.path("."));
    b.image("p/image.glsl", "fragColor = vec4(0.75);");
    b.image("p/new.glsl", "fragColor = vec4(0.75);");
    for (project, largest) in [("p", 0.5), ("one.glsl", 0.0)] {
        let run = b.line(&format!("compare {project} --revision HEAD --size 16x16 --repeats 0 --json")).expect(0);
        assert_eq!(run.json()[0]["largest"], largest, "{project}: {}", run.out);
    }
    let invalid = b.line("compare p --revision v9 --size 16x16").expect(2);
    assert!(invalid.err.contains("no such revision"), "{}", invalid.err);
}

/// Commands in the configuration of an untrusted repository are not run, and its trees are not written outside the
/// folder.
#[test]
fn an_untrusted_repository_runs_nothing_and_writes_nothing_outside() {
    let Some(b) = Bench::with_gpu() else { return };
    b.image("p/image.glsl", "fragColor = vec4(0.25);");
    let root = b.path("p");
    git::commit_all(&root);
    let (marker, outside) = (b.path("ran"), b.path("evil.glsl"));
    let run = format!("touch {}", marker.display());
    let config = format!(
        "[core]\n\trepositoryformatversion = 1\n\tsshCommand = {run} #\n\tfsmonitor = {run} #\n[extensions]\n\t\
         partialClone = origin\n[remote \"origin\"]\n\turl = ssh://nowhere.invalid/x\n\tpromisor = true\n\t\
         uploadpack = {run} #\n"
    );
    b.write("p/.git/config", &config);
    let compare = "compare p --revision HEAD --size 16x16 --repeats 0";
    b.line(compare).expect(0);
    let blob = git::object(&root, Kind::Blob, b"payload");
    let missing_object = "0123456789012345678901234567890123456789".parse().unwrap();
    for (name, id, expected) in [
        (outside.to_str().unwrap(), blob, "which is not a valid file name for a project"),
        ("../../evil.glsl", blob, "which is not a valid file name for a project"),
        ("gone.glsl", missing_object, "the clone is partial, and Eddy does not fetch"),
    ] {
        let tree = git::object(&root, Kind::Tree, &git::entry("100644", name, id));
        git::commit(&root, tree);
        let rejected = b.line(compare).expect(2);
        assert!(rejected.err.contains(expected), "{name}: {}", rejected.err);
    }
    assert!(!marker.exists() && !outside.exists());
}

#[test]
fn a_replay_gives_every_frame_its_recorded_inputs() {
    let Some(b) = Bench::with_gpu() else { return };
    let code = "#iUniform float level = 0.5 in { 0.0, 1.0 }\nvoid mainImage(out vec4 o, in vec2 p) \
                { o = vec4(iTime, iMouse.x, texelFetch(iChannel0, ivec2(32, 0), 0).x + 2. * level, 1.); }";
    b.write("p/image.glsl", code);
    b.write("p/eddy.toml", "eddy = 1\n[passes.image]\nchannels.0 = { keyboard = true }\n");
    let lines = [
        r#"{"eddy_recording":1,"project":"p"}"#,
        r#"{"time":0.25,"size":[4,2],"held":[32]}"#,
        r#"{"time":1.5,"mouse":[7,1,7,1],"held":[],"set":{"level":0.75}}"#,
        r#"{"time":2.0,"size":[6,2]}"#,
    ];
    b.write("run.replay", lines.join("\n"));
    let run = b.line("render p --replay run.replay --at 0,1,2 --format npy --out o --json").expect(0);
    assert_eq!(run.json()[0]["frames"], 3);
    let frame = |n: u32| b.npy(&format!("o/p_{n:04}.npy"));
    assert_eq!((frame(0).width, frame(0).at(0, 0)), (4, [0.25, 0.0, 2.0, 1.0]));
    assert_eq!((frame(1).width, frame(1).at(0, 0)), (4, [1.5, 7.0, 1.5, 1.0]));
    assert_eq!((frame(2).width, frame(2).at(5, 1)), (6, [2.0, 7.0, 1.5, 1.0]));
    let all = b.line("render p --replay run.replay --json").expect(0);
    assert_eq!(all.json()[0]["frames"], 3, "all recorded frames");
    for (line, expected) in [
        ("render p --replay run.replay --frames 4 --json", "3 were recorded"),
        ("render p --replay run.replay --size 8x8 --json", "cannot be used with"),
        ("render p --replay p/image.glsl --json", "not an Eddy recording"),
        ("render p --replay none.replay --json", "cannot read none.replay"),
    ] {
        let run = b.line(line).expect(2);
        assert!(run.err.contains(expected), "{line}: {}", run.err);
    }
}

/// A recording has no inputs after its last frame.
#[test]
fn no_command_draws_more_frames_than_were_recorded() {
    let Some(b) = Bench::with_gpu() else { return };
    b.image("p/buffer_a.glsl", "fragColor = texelFetch(iChannel0, ivec2(fragCoord), 0) + iTime;");
    b.image("p/image.glsl", "fragColor = texelFetch(iChannel0, ivec2(fragCoord), 0) / 3.;");
    b.write("p/eddy.toml", "eddy = 1\n[passes.buffer_a]\nchannels.0 = { buffer = \"A\" }\n[passes.image]\nchannels.0 = { buffer = \"A\" }\n");
    let lines = [
        r#"{"eddy_recording":1,"project":"p"}"#,
        r#"{"time":0.25,"size":[4,2]}"#,
        r#"{"time":1.5}"#,
        r#"{"time":2.0,"size":[6,2]}"#,
    ];
    b.write("run.replay", lines.join("\n"));
    let json = |line: &str| b.line(&format!("{line} --replay run.replay --json")).expect(0).json()[0].clone();
    let last = json("trace p --pass buffer_a --pixel 0,0 --frame 2");
    assert_eq!((&last["value"][0], &last["frames"]), (&3.75.into(), &3.into()), "{last}");
    let probed = json("probe p buffer_a:2:1 --frame 2");
    assert_eq!((&probed["width"], &probed["max"][0]), (&6.into(), &3.75.into()), "{probed}");
    let precise = json("lab precision p --pixels 2x1");
    assert_eq!((&precise["frames"], &precise["width"], &precise["double"]["frame"]), (&3.into(), &4.into(), &2.into()));
    assert_eq!(precise["rows"].as_array().unwrap().iter().filter(|row| row["frame"] == 2).count(), 2, "{precise}");
    let bench = json("bench p");
    assert_eq!((&bench["frames"], &bench["width"]), (&3.into(), &6.into()), "{bench}");
    assert_eq!(json("compare p p --frame 2 --repeats 3")["time"]["repeats"], 3);
    for line in [
        "trace p --pixel 0,0 --frame 3",
        "trace p --nonfinite --frame 9",
        "probe p image:2:13 --frame 3",
        "compare p p --frame 3",
        "bench p --frames 4",
        "lab precision p --frames 4",
    ] {
        let run = b.line(&format!("{line} --replay run.replay")).expect(2);
        assert!(run.err.contains("frames were requested, but only 3 were recorded"), "{line}: {}", run.err);
    }
}

/// Buffer B takes the square root of a number that falls below 0 in frame 40 at texel (3, 2); Buffer C passes it on a
/// frame later, and Image shows it from frame 43 on.
#[test]
fn the_first_nan_is_named_by_pass_frame_texel_and_line() {
    let Some(b) = Bench::with_gpu() else { return };
    b.write(
        "p/eddy.toml",
        "eddy = 1\n[passes.buffer_b]\n[passes.buffer_a]\nchannels.0 = { buffer = \"B\" }\n[passes.buffer_c]\n\
         channels.0 = { buffer = \"A\" }\nchannels.1 = { buffer = \"C\" }\n\
         [passes.image]\nchannels.0 = { buffer = \"C\" }\n",
    );
    b.image("p/buffer_a.glsl", "fragColor = texelFetch(iChannel0, ivec2(fragCoord), 0);");
    b.image(
        "p/buffer_b.glsl",
        "float rest = ivec2(fragCoord) == ivec2(3, 2) ? 39.5 - float(iFrame) : 1.;\nfloat root = sqrt(rest);\n\
         fragColor = vec4(root, 0., 0., 1.);",
    );
    b.image(
        "p/buffer_c.glsl",
        "fragColor = texelFetch(iChannel0, ivec2(fragCoord), 0) + 0. * texelFetch(iChannel1, ivec2(fragCoord), 0);",
    );
    b.image("p/image.glsl", "fragColor = iFrame < 43 ? vec4(0.) : texelFetch(iChannel0, ivec2(fragCoord), 0);");
    b.line("render p --size 8x6 --at 42,43 --format npy --out seen").expect(0);
    let is_seen = |frame: u32| b.npy(&format!("seen/p_{frame:04}.npy")).at(3, 2)[0].is_nan();
    assert_eq!([42, 43].map(is_seen), [false, true]);
    let run = b.line("trace p --nonfinite --frame 60 --size 8x6 --json").expect(0);
    let found = &run.json()[0]["nonfinite"];
    assert_eq!(
        (&found["pass"], &found["frame"], &found["texels"]),
        (&"buffer_b".into(), &40.into(), &1.into()),
        "{found}"
    );
    assert_eq!(found["texel"], serde_json::json!([3, 2]));
    let born = &found["born"];
    assert_eq!(
        (&born["source"], &born["line"], &born["text"]),
        (&"buffer_b.glsl".into(), &3.into(), &"sqrt(rest)".into())
    );
    assert_eq!(born["numbers"], "-0.5");
    let text = b.line("trace p --nonfinite --frame 60 --size 8x6").expect(0).out;
    assert!(
        text.contains("buffer_b, frame 40, texel 3,2") && text.contains("buffer_b.glsl:3:14: first NaN here"),
        "{text}"
    );
    let none = b.line("trace p --nonfinite --frame 39 --size 8x6 --json").expect(0);
    assert!(none.json()[0]["nonfinite"].is_null());
    b.line("trace p --size 8x6").expect(2);
}

#[test]
fn a_project_is_compared_with_double_precision() {
    let Some(b) = Bench::with_gpu() else { return };
    b.image(
        "p.glsl",
        "float a = 1000. + fragCoord.x * 1e-3;\nfloat b = a * a - 1e6;\nfloat c;\nif (fragCoord.x > 1e9) c = 1.;\n\
         fragColor = vec4(b * 0.5, c + 0.25, 0., 1.);",
    );
    let line = "lab precision p.glsl --frames 1 --size 16x9 --pixels 8x3 --json --map map.npy";
    let run = b.line(line).expect(0);
    let double = &run.json()[0]["double"];
    assert_eq!((&double["pixels"], &double["pass"]), (&24.into(), &"image".into()), "{}", run.out);
    let finding = |kind: &str| {
        let all = double["findings"].as_array().unwrap();
        all.iter().find(|f| f["kind"] == kind).unwrap_or_else(|| panic!("{kind}: {double}")).clone()
    };
    let (rounding, undefined) = (finding("rounding"), finding("undefined"));
    assert_eq!((&rounding["line"], &rounding["text"]), (&3.into(), &"a * a - 1e6".into()));
    assert!(rounding["error_left"].as_f64() < rounding["error"].as_f64());
    assert_eq!((&undefined["line"], &undefined["text"], &undefined["pixels"]), (&4.into(), &"c".into(), &24.into()));
    let map = b.npy("map.npy");
    assert_eq!((map.width, map.height), (8, 3));
    let largest = map.texels.iter().map(|t| t[0]).fold(0.0, f32::max);
    assert!((f64::from(largest) / double["largest"].as_f64().unwrap() - 1.0).abs() < 1e-5);
    assert!(map.texels.iter().all(|t| t[1] == 0.0 && t[3] == 0.0));
    let text = b.line("lab precision p.glsl --frames 1 --size 16x9 --pixels 8x3").expect(0).out;
    assert!(text.contains("p.glsl:3:11: cancellation"), "{text}");

    // Every device must round these as IEEE 754 does.
    b.image("exact.glsl", "fragColor = vec4(fragCoord * 0.5, 0.25, iFrame);");
    let run = b.line("lab precision exact.glsl --frames 1 --size 16x9 --pixels 8x3 --json").expect(0);
    let walker = serde_json::json!({ "same": 24, "median_ulps": 0, "largest_ulps": 0, "visible": 0, "furthest": null });
    assert_eq!(run.json()[0]["double"]["walker"], walker);
}

#[test]
fn a_comment_prints_the_values_of_a_traced_pixel() {
    let Some(b) = Bench::with_gpu() else { return };
    b.image(
        "p.glsl",
        "float sum = 0.;\nfor (int i = 0; i < 3; i++) {\n    sum += fragCoord.x; //@print vec2(sum, i)\n}\n\
         //@print nothing + 1.\nfragColor = vec4(sum);",
    );
    let run = b.line("trace p.glsl --pixel 2,1 --size 8x6 --json").expect(0);
    let printed = &run.json()[0]["printed"];
    assert_eq!((&printed[0]["line"], &printed[0]["expression"]), (&4.into(), &"vec2(sum, i)".into()), "{printed}");
    assert_eq!(printed[0]["values"], serde_json::json!([[2.5, 0.0], [5.0, 1.0], [7.5, 2.0]]));
    assert!(printed[1]["error"].as_str().unwrap().contains("nothing"), "{printed}");
    let text = b.line("trace p.glsl --pixel 2,1 --size 8x6").expect(0).out;
    assert!(text.contains("Image:4: vec2(sum, i)\n        1  (2.5, 0.0)"), "{text}");
}

/// Buffer A has a state in four of its texels, of which one component is read; Buffer B repeats its texels, as the driver
/// cannot know that it does; Buffer C is not read; Image asks only the size of D.
#[test]
fn unused_work_is_listed_with_what_it_costs_and_whether_it_is_left_out() {
    let Some(b) = Bench::with_gpu() else { return };
    b.image("p/buffer_a.glsl", "fragColor = vec4(iTime);");
    b.image("p/buffer_b.glsl", "fragColor = vec4(min(iTime, 0.0) + fragCoord, 0.5, 1.0 / 3.0);");
    b.image("p/buffer_c.glsl", "fragColor = vec4(1.0);");
    b.image("p/buffer_d.glsl", "fragColor = vec4(iTime);");
    b.image(
        "p/image.glsl",
        "vec4 sum = vec4(0.0); for (int i = 0; i < 4; i++) sum.x += texelFetch(iChannel0, ivec2(clamp(i, 0, 3), 0), 0).x; \
         fragColor = sum + texelFetch(iChannel1, ivec2(fragCoord), 0) / 8.0 + float(textureSize(iChannel2, 0).x) / 64.0;",
    );
    b.write(
        "p/eddy.toml",
        "[passes.buffer_a]\n[passes.buffer_b]\n[passes.buffer_c]\n[passes.buffer_d]\n[passes.image]\n\
         channels.0 = { buffer = \"A\" }\nchannels.1 = { buffer = \"B\" }\nchannels.2 = { buffer = \"D\" }\n\
         channels.3 = { buffer = \"C\" }\n",
    );
    let line = b.line("unused p --size 16x8 --frames 6 --json").expect(0).json().remove(0);
    let findings = line["findings"].as_array().unwrap();
    let find = |kind: &str, pass: &str| {
        let found = findings.iter().find(|f| f["kind"] == kind && f["pass"] == pass);
        found.unwrap_or_else(|| panic!("{kind} of {pass}: {line:#}"))
    };
    let all = 16 * 8 * 16;
    let (texels, components) = (find("texels", "buffer_a"), find("components", "buffer_a"));
    assert_eq!((&texels["bytes"], &texels["skipped"]), (&(all - 4 * 16).into(), &false.into()), "{texels}");
    assert!(texels["message"].as_str().unwrap().contains("the first 4x1"), "{texels}");
    assert_eq!(components["bytes"], all * 3 / 4, "{components}");
    assert!(components["message"].as_str().unwrap().contains("green, blue, alpha are read by no pass"), "{components}");
    let frames = find("frames", "buffer_b");
    assert!(frames["message"].as_str().unwrap().contains("in 5 of 6 frames") && frames["skipped"] == false, "{frames}");
    // Thirds have other bits in 16, which 8 bits of the picture do not show.
    assert_eq!(find("precision", "buffer_b")["bytes"], all / 2);
    for (kind, pass) in [("pass", "buffer_c"), ("pass", "buffer_d"), ("channel", "image")] {
        assert_eq!(find(kind, pass)["skipped"], true);
    }
    assert!(!findings.iter().any(|f| f["kind"] == "texels" && f["pass"] == "buffer_b"), "{line:#}");
    let text = b.line("unused p --size 16x8 --frames 2 --no-precision").expect(0).out;
    assert!(text.contains("left out by Eddy:") && text.contains("Buffer A"), "{text}");
    assert!(!text.contains("format = \"rgba16f\""), "{text}");
}
