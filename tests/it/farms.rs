//! The files of `assets/farm/`, with which schedulers draw a project on many machines, and the progress output that
//! they read. Each file is run as its scheduler would: with its environment variables, or with its placeholders filled
//! in.

use crate::support::program::{Bench, Run, run};
use std::{
    collections::BTreeSet,
    ffi::OsString,
    fs,
    path::{Path, PathBuf},
    process::Command,
};

const PLACE: &str = "fragColor = vec4(fragCoord / iResolution.xy, fract(float(iFrame) * 0.37 + iTime), 1.0);";

fn folder() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("assets/farm")
}

fn text(name: &str) -> String {
    fs::read_to_string(folder().join(name)).unwrap()
}

/// Returns the items of a YAML list that has one item per line.
fn list_after(text: &str, key: &str) -> Vec<String> {
    let items = text.lines().skip_while(|line| line.trim() != key).skip(1).map_while(|line| {
        let item = line.trim().strip_prefix("- ")?;
        Some(item.trim_matches('"').to_owned())
    });
    items.collect()
}

/// Returns the arguments of `eddy` in a file, starting with `render`.
fn arguments(name: &str) -> Vec<String> {
    let text = text(name);
    let words = |text: &str| text.split_whitespace().map(|word| word.replace('"', "")).collect::<Vec<_>>();
    let all = match name {
        "openjd.yaml" => list_after(&text, "args:"),
        "kubernetes.yaml" => list_after(&text, "command:"),
        "opencue.xml" => words(text.split_once("<cmd>").unwrap().1.split_once("</cmd>").unwrap().0),
        "slurm.sh" | "parallel.sh" => {
            let command = text.split_once("\nexec ").unwrap().1.replace("\\\n", " ");
            words(command.split(":::").next().unwrap())
        }
        _ => panic!("{name}: this test needs a rule that extracts its command"),
    };
    let eddy_arguments = all.into_iter().skip_while(|word| word != "render").collect::<Vec<_>>();
    assert!(eddy_arguments.len() > 5, "{name}: {eddy_arguments:?}");
    eddy_arguments
}

#[test]
fn scheduler_files_use_existing_options() {
    let help = Bench::new().line("render --help").expect(0).out;
    let options: BTreeSet<&str> = help.lines().filter_map(|line| line.split_whitespace().next()).collect();
    let mut names = Vec::new();
    for file in fs::read_dir(folder()).unwrap() {
        let name = file.unwrap().file_name().into_string().unwrap();
        let arguments = arguments(&name);
        let used: Vec<&String> = arguments.iter().filter(|word| word.starts_with("--")).collect();
        assert!(used.len() >= 3, "{name}: {arguments:?}");
        for option in used {
            assert!(options.contains(option.as_str()), "{name}: there is no option {option}");
        }
        names.push(name);
    }
    names.sort();
    assert_eq!(names, ["kubernetes.yaml", "opencue.xml", "openjd.yaml", "parallel.sh", "slurm.sh"]);
}

/// Returns the command of a file with its placeholders filled in.
fn filled_command(b: &Bench, name: &str, values: &[(&str, &str)]) -> Command {
    let mut command = b.command();
    let fill = |word: String| values.iter().fold(word, |word, (from, to)| word.replace(from, to));
    let words: Vec<String> = arguments(name).into_iter().map(fill).collect();
    assert!(!words.iter().any(|word| word.contains(['{', '#'])), "{name}: {words:?}");
    command.args(words).arg("--json");
    command
}

/// Returns the command that runs a script with `bash`, with the built program first in the path.
fn script_command(b: &Bench, name: &str, arguments: &str) -> Command {
    let program = Path::new(env!("CARGO_BIN_EXE_eddy"));
    let mut path = OsString::from(program.parent().unwrap());
    path.push(":");
    path.push(std::env::var_os("PATH").unwrap_or_default());
    let mut command = Command::new("bash");
    command.current_dir(b.path(".")).arg(folder().join(name)).args(arguments.split(' ')).env("PATH", path);
    command
}

/// Checks that the tasks together drew each of ten frames once, and compares the files with those of a single run.
#[track_caller]
fn assert_same_frames_as_one_run(b: &Bench, out: &str, tasks: &[Run]) {
    let lines = tasks.iter().flat_map(Run::json).collect::<Vec<_>>();
    let drawn: Vec<u64> = lines.iter().map(|line| line["frames"].as_u64().unwrap()).collect();
    assert_eq!(drawn.iter().sum::<u64>(), 10, "{out}: {drawn:?}");
    assert!(drawn.len() > 1 && lines.iter().all(|line| line.get("kept").is_none()), "{out}: {lines:?}");
    assert_eq!(b.names(out), b.names("one"));
    for name in b.names("one") {
        assert!(b.bytes(&format!("{out}/{name}")) == b.bytes(&format!("one/{name}")), "{out}/{name} differs");
    }
}

#[cfg(unix)]
#[test]
fn tasks_of_each_scheduler_write_all_frames_once() {
    let Some(b) = Bench::with_gpu() else { return };
    b.image("place/image.glsl", PLACE);
    b.line("render place --size 16x9 --frames 5-14 --out one").expect(0);
    let shared = [("/shared/my-project", "place"), ("1920x1080", "16x9")];

    let pod = |index: u32| {
        let values = [shared[0], shared[1], ("/shared/frames", "kubernetes"), ("0-599", "5-14"), ("auto/8", "auto/3")];
        run(filled_command(&b, "kubernetes.yaml", &values).env("JOB_COMPLETION_INDEX", index.to_string())).expect(0)
    };
    assert_same_frames_as_one_run(&b, "kubernetes", &[0, 1, 2].map(pod));

    let chunk = |frames: &str| {
        let job_parameters = [("Project", "place"), ("Size", "16x9"), ("Format", "png"), ("Out", "openjd")];
        let job_parameters = job_parameters.map(|(name, value)| (format!("{{{{Param.{name}}}}}"), value));
        let task = ("{{Task.Param.Frame}}".to_owned(), frames);
        let values: Vec<(&str, &str)> =
            job_parameters.iter().chain([&task]).map(|(from, to)| (from.as_str(), *to)).collect();
        run(&mut filled_command(&b, "openjd.yaml", &values)).expect(0)
    };
    assert_same_frames_as_one_run(&b, "openjd", &["5-8", "9-13", "14-14"].map(chunk));

    let frame = |(first, last): (&str, &str)| {
        let chunk = [("#FRAME_START#", first), ("#FRAME_END#", last), ("/shared/frames", "opencue")];
        run(&mut filled_command(&b, "opencue.xml", &[&shared[..], &chunk].concat())).expect(0)
    };
    assert_same_frames_as_one_run(&b, "opencue", &[("5", "13"), ("14", "14")].map(frame));

    let task = |id: u32| {
        let mut command = script_command(&b, "slurm.sh", "place 5-14 slurm --size 16x9 --json");
        let ids = [("ID", id.to_string()), ("COUNT", "3".into()), ("MIN", "4".into()), ("STEP", "2".into())];
        run(command.envs(ids.map(|(name, value)| (format!("SLURM_ARRAY_TASK_{name}"), value)))).expect(0)
    };
    assert_same_frames_as_one_run(&b, "slurm", &[4, 6, 8].map(task));

    // This needs GNU parallel itself, which sets PARALLEL_SEQ.
    let version = Command::new("parallel").arg("--version").output();
    if version.is_ok_and(|version| String::from_utf8_lossy(&version.stdout).starts_with("GNU parallel")) {
        let mut all = run(&mut script_command(&b, "parallel.sh", "3 place 5-14 parallel --size 16x9 --json")).expect(0);
        // Lines start with the number of their task.
        all.out = all.out.lines().map(|line| format!("{}\n", line.split_once('\t').unwrap().1)).collect();
        assert_same_frames_as_one_run(&b, "parallel", &[all]);
    }
    for name in ["slurm.sh", "parallel.sh"] {
        assert!(run(&mut script_command(&b, name, "place")).expect(2).err.starts_with("usage: "), "{name}");
    }
    let no_number = run(&mut script_command(&b, "parallel.sh", "many place 5-14 out")).expect(2);
    assert!(no_number.err.starts_with("usage: "), "{}", no_number.err);
}

/// Returns the messages for Open Job Description in a text, and checks their form: the action filter of
/// `openjd-sessions` accepts lines of this form, and a percentage from 0 to 100.
#[track_caller]
fn messages(text: &str) -> (Vec<f64>, Vec<String>) {
    let (mut percents, mut others) = (Vec::new(), Vec::new());
    for line in text.lines().filter(|line| line.contains("openjd")) {
        let (kind, message) = line.strip_prefix("openjd_").unwrap().split_once(": ").unwrap();
        match kind {
            "progress" => percents.push(message.parse().unwrap()),
            "status" | "fail" => others.push(format!("{kind}: {message}")),
            _ => panic!("{line}"),
        }
    }
    assert!(percents.is_sorted() && percents.iter().all(|percent| (0.0..=100.0).contains(percent)), "{percents:?}");
    (percents, others)
}

#[test]
fn open_job_description_progress_has_the_documented_form() {
    let Some(b) = Bench::with_gpu() else { return };
    b.image("place.glsl", PLACE);
    b.image("wrong.glsl", "fragColor = vec4(lenght(fragCoord)); fragColor = vec4(ohno);");
    let run = b.line("render place.glsl --size 4x4 --frames 0-4 --out o --progress openjd").expect(0);
    assert!(run.out.starts_with("place.glsl: 5 frames") && !run.out.contains("openjd"), "{}", run.out);
    let (percents, others) = messages(&run.err);
    assert_eq!((percents.first(), percents.last()), (Some(&0.0), Some(&100.0)));
    assert_eq!(others[0], "status: place.glsl: compiling");
    assert_eq!(others[1], "status: place.glsl: 0 of 5 frames");
    assert_eq!(others.last().unwrap(), "status: place.glsl: done");
    // Existing files count as done.
    let (percents, _) = messages(&b.line("render place.glsl --size 4x4 --frames 0-4 --out o --progress openjd").err);
    assert_eq!(percents, [100.0]);
    // A failing project reports the reason in one line, and the call is not complete. Percentages are those of the
    // call.
    let run = b.line("render place.glsl wrong.glsl --size 4x4 --out p --json --progress openjd").expect(1);
    assert_eq!(run.json().len(), 2);
    let (percents, others) = messages(&run.err);
    assert_eq!((percents.first(), percents.last()), (Some(&0.0), Some(&50.0)));
    let failures: Vec<&String> = others.iter().filter(|message| message.starts_with("fail")).collect();
    assert!(failures.len() == 1 && failures[0].starts_with("fail: wrong.glsl: wrong.glsl:2:18: "), "{failures:?}");
    assert!(failures[0].contains("`lenght`") && failures[0].ends_with("(and 1 more error)"), "{failures:?}");
    let run = b.line("render place.glsl --frames 0-4 --out one.png --progress openjd").expect(2);
    assert!(messages(&run.err).1[0].starts_with("fail: --out one.png is one file"), "{}", run.err);
    // Pictures and sounds on standard output are not changed by progress output.
    let line = "render place.glsl --size 4x4 --out - --format png --progress openjd";
    let piped = b.command().args(line.split(' ')).output().unwrap();
    image::load_from_memory(&piped.stdout).unwrap();
    assert_eq!(messages(&String::from_utf8(piped.stderr).unwrap()).0.last(), Some(&100.0));
}

#[test]
fn progress_is_shown_only_where_requested() {
    let Some(b) = Bench::with_gpu() else { return };
    b.image("place.glsl", PLACE);
    let error =
        |style: &str| b.line(&format!("render place.glsl --size 4x4 --frames 0-4 --json {style}")).expect(0).err;
    // Standard error is not a terminal here.
    assert_eq!([error(""), error("--progress auto"), error("--progress none")], ["", "", ""]);
    // These frames are drawn before the first progress line is due.
    assert_eq!(error("--progress plain"), "");
    let bar = error("--progress bar");
    assert!(bar.contains("place.glsl") && bar.contains("/5 frames") && bar.contains("\x1b[2K"), "{bar:?}");
    b.write("tone/image.glsl", crate::support::program::image(PLACE));
    b.write("tone/sound.glsl", "vec2 mainSound(int n, float t) { return vec2(sin(t * 2764.6)); }\n");
    let sound = b.line("render tone --pass sound --secs 7 --out tone.wav --progress openjd").expect(0);
    assert!(messages(&sound.err).1.contains(&"status: tone: 0 of 2 blocks".to_owned()), "{}", sound.err);
}
