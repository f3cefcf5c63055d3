//! `eddy tune` on a small program of two quality constants.

use crate::support::{gpu, program::Bench};
use serde_json::Value;
use std::fs;

/// Far more steps than the picture needs, and four samples of smooth shades. The loop has no early end, so that its
/// time is that of its steps.
const PROGRAM: &str = "#define STEPS 256
#define AA 2
float height(vec2 p) {
    float t = 0.0;
    for (int i = 0; i < STEPS; i++) t += 0.25 * (length(vec3(p, t) - vec3(0, 0, 3)) - 1.5);
    return t;
}
void mainImage(out vec4 color, in vec2 at) {
    vec3 sum = vec3(0);
    for (int y = 0; y < AA; y++)
    for (int x = 0; x < AA; x++) {
        vec2 p = (at + (vec2(x, y) + 0.5) / float(AA) - 0.5) / iResolution.xy - 0.5;
        sum += 0.5 + 0.4 * cos(height(p) + vec3(0, 2, 4) + 0.1 * iTime);
    }
    color = vec4(sum / float(AA * AA), 1.0);
}
";

fn tune(bench: &Bench, more: &[&str]) -> (Option<i32>, Value, String) {
    let common = ["tune", "p", "--json", "--size", "64x36", "--time", "20", "--at", "3,40"];
    let output = bench.command().args(common).args(more).output().unwrap();
    let text = String::from_utf8(output.stdout).unwrap();
    let line = serde_json::from_str(text.lines().next().unwrap_or("null")).unwrap_or(Value::Null);
    (output.status.code(), line, String::from_utf8_lossy(&output.stderr).into_owned())
}

#[test]
fn a_cheaper_setting_within_the_bound_is_found_and_written_only_if_asked() {
    if gpu().is_none() {
        return;
    }
    let bench = Bench::new();
    fs::create_dir_all(bench.path("p")).unwrap();
    let file = bench.path("p/image.glsl");
    fs::write(&file, PROGRAM).unwrap();
    let (code, result, errors) = tune(&bench, &["--csv", "all.csv", "--plot", "plot.svg", "--out", "out"]);
    assert_eq!(code, Some(0), "{result} {errors}");
    let proposal = &result["proposal"];
    assert!(proposal["speed_up"].as_f64().unwrap() > 2.0, "{proposal}");
    assert!(proposal["checked_error"].as_f64().unwrap() <= 0.02, "{proposal}");
    let steps = proposal["values"]["STEPS"].as_f64().unwrap();
    assert!((2.0..=64.0).contains(&steps), "{proposal}");
    assert!(!result["device"].as_str().unwrap().is_empty());
    // By what the pixels execute, the steps are nearly all of the time.
    assert_eq!(result["convergence"][0]["knob"], "STEPS");
    assert!(result["convergence"][0]["share"].as_f64().unwrap() > 0.8, "{}", result["convergence"]);
    assert_eq!(fs::read_to_string(&file).unwrap(), PROGRAM, "nothing is written unasked");
    let tuned = fs::read_to_string(bench.path("out/project/image.glsl")).unwrap();
    assert!(tuned.contains(&format!("#define STEPS {steps}\n")), "{tuned}");
    assert!(bench.path("out/frame_0003.png").exists() && bench.path("out/frame_0040.png").exists());
    assert!(fs::read_to_string(bench.path("all.csv")).unwrap().starts_with("STEPS,AA,ms,error,"));
    assert!(fs::read_to_string(bench.path("plot.svg")).unwrap().contains("proposed"));
    // From the earlier result; the old text is kept.
    fs::write(bench.path("result.json"), result.to_string()).unwrap();
    let (code, applied, errors) = tune(&bench, &["--from", "result.json", "--knob", "STEPS", "--apply"]);
    assert_eq!((code, &applied["applied"]), (Some(0), &Value::Bool(true)), "{applied} {errors}");
    let text = fs::read_to_string(&file).unwrap();
    assert!(text != PROGRAM && text.contains("#define AA 2\n"), "{text}");
    assert_eq!(fs::read_to_string(bench.path("p/before-tune-1/image.glsl")).unwrap(), PROGRAM);
}

#[test]
fn knobs_are_listed_and_mistakes_say_how_to_fix_them() {
    let bench = Bench::new();
    fs::create_dir_all(bench.path("p")).unwrap();
    fs::write(bench.path("p/image.glsl"), PROGRAM).unwrap();
    let output = bench.command().args(["tune", "p", "--list"]).output().unwrap();
    let text = String::from_utf8(output.stdout).unwrap();
    assert!(text.contains("STEPS = 256") && text.contains("it bounds the loop at image.glsl:5"), "{text}");
    for (arguments, says) in [
        (["--knob", "NOTHING"], "the knobs are"),
        (["--error", "flop < 1"], "an error is flip, ssim, psnr"),
        (["--range", "STEPS=9..2"], "above the high end"),
        (["--fix", "STEPS"], "NAME=VALUE"),
        (["--budget", "0ms"], "milliseconds"),
        (["--from", "none.json"], "none.json"),
    ] {
        if arguments[0] == "--from" && gpu().is_none() {
            continue;
        }
        let output = bench.command().args(["tune", "p"]).args(arguments).output().unwrap();
        let text = String::from_utf8_lossy(&output.stderr).into_owned();
        assert!(output.status.code() == Some(2) && text.contains(says), "{arguments:?}: {text}");
    }
}

/// Returns a text with other values of its knobs.
fn with_values(text: &str, knobs: &Value, values: &Value) -> String {
    let mut lines: Vec<String> = text.lines().map(str::to_owned).collect();
    for knob in knobs.as_array().unwrap() {
        let value = values[knob["name"].as_str().unwrap()].as_f64().unwrap();
        let number = knob["place"].as_str().unwrap().rsplit(':').next().unwrap();
        let line = &mut lines[number.parse::<usize>().unwrap() - 1];
        let start = knob["column"].as_u64().unwrap() as usize - 1;
        let length = line[start..].find(|c: char| !c.is_ascii_digit() && c != '.').unwrap_or(line.len() - start);
        let is_float = line[start..start + length].contains('.');
        line.replace_range(start..start + length, &if is_float { format!("{value:?}") } else { format!("{value}") });
    }
    lines.join("\n")
}

/// Programs that the search was not made with (tests/tune): the proposal keeps the bound in frames that no search draws.
#[test]
fn proposals_keep_the_bound_in_other_frames() {
    if gpu().is_none() {
        return;
    }
    let bench = Bench::new();
    for (name, least) in [("soft_shadow", 1.5), ("radial_blur", 1.2), ("voronoi", 1.5)] {
        let source = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join(format!("tests/tune/{name}.glsl"));
        let text = fs::read_to_string(source).unwrap();
        fs::write(bench.path("p.glsl"), &text).unwrap();
        let args = ["tune", "p.glsl", "--json", "--size", "48x27", "--time", "20", "--at", "20,430"];
        let output = bench.command().args(args).output().unwrap();
        let result: Value = serde_json::from_slice(&output.stdout).unwrap_or_else(|why| panic!("{name}: {why}"));
        let proposal = &result["proposal"];
        assert!(proposal["speed_up"].as_f64().unwrap() > least, "{name}: {proposal}");
        for (file, values) in [("tuned.glsl", &proposal["values"]), ("exact.glsl", &result["reference"])] {
            fs::write(bench.path(file), with_values(&text, &result["knobs"], values)).unwrap();
        }
        // At 4 s and 16.7 s, without the frames before.
        for rate in ["0.25", "0.06"] {
            let args = ["compare", "tuned.glsl", "exact.glsl", "--json", "--size", "48x27", "--repeats", "0"];
            let output = bench.command().args(args).args(["--frame", "1", "--fps", rate]).output().unwrap();
            let compared: Value = serde_json::from_slice(&output.stdout).unwrap();
            assert!(compared["flip"].as_f64().unwrap() <= 0.02, "{name}, {rate} frames per second: {compared}");
        }
    }
}

#[test]
fn a_search_ends_in_its_time_and_proposes_nothing_that_it_did_not_check() {
    if gpu().is_none() {
        return;
    }
    let bench = Bench::new();
    fs::write(bench.path("p.glsl"), PROGRAM.replace("256", "20000")).unwrap();
    let began = std::time::Instant::now();
    let output =
        bench.command().args(["tune", "p.glsl", "--json", "--size", "320x180", "--time", "0.5"]).output().unwrap();
    let line: Value = serde_json::from_slice(&output.stdout).unwrap();
    assert!(line["proposal"].is_null(), "{line}");
    // A frame that is drawn already is completed.
    assert!(began.elapsed().as_secs_f64() < 20.0, "{:?}", began.elapsed());
}
