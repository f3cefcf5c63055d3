use super::*;
use crate::cli::{args::Cli, command::Command};
use clap::Parser;

fn targets(line: &str) -> Result<Targets, String> {
    match Cli::parse_from(["eddy", "render"].into_iter().chain(line.split(' '))).command {
        Some(Command::Render(mut args)) => {
            choose_rate(&mut args);
            Targets::of(&args)
        }
        _ => unreachable!(),
    }
}

fn path(line: &str, project: usize, frame: u32) -> String {
    targets(line).unwrap().path(project, &[], frame).unwrap().to_string_lossy().into_owned()
}

#[test]
fn a_single_frame_has_the_stem_and_several_have_numbers() {
    assert_eq!(path("fluid x/a.b.json --out o --frames 9", 0, 8), "o/fluid.png");
    assert_eq!(path("fluid x/a.b.json --out o --frames 9", 1, 8), "o/a.b.png");
    assert_eq!(path("fluid --out o --at 4,9999 --format npy", 0, 4), "o/fluid_0004.npy");
    assert_eq!(path("fluid --out o --at 12345,4 --format npy", 0, 4), "o/fluid_00004.npy");
    assert_eq!(path("fluid --out o --at 4,12345 --format npy", 0, 12345), "o/fluid_12345.npy");
    assert_eq!(path("fluid --out o --at 0,1000000 --frames 12345678", 0, 0), "o/fluid_0000000.png");
    assert_eq!(path("fluid --out o --frames 4-4 --format exr", 0, 4), "o/fluid_0004.exr");
    assert_eq!(path("fluid --out o --frames 0-99999 --shard 0/1000", 0, 4), "o/fluid_00004.png", "as in every shard");
    assert_eq!(path("fluid --out a.v1/x.npy", 0, 0), "a.v1/x.npy");
    assert_eq!(path("fluid --out x.png --format apng --frames 3", 0, 2), "x.png");
    assert_eq!(path("fluid --out o --format mp4 --frames 3", 0, 2), "o/fluid.mp4");
    assert_eq!(path("src/ --out o", 0, 0), "o/src.png");
    assert_ne!(path(". --out o", 0, 0), "o/picture.png", "the folder's name is looked up");
    let swept = targets("fluid --out o --sweep a=0..1:3 --sweep b=1;2 --at 1,2").unwrap();
    let (last, folder) = (swept.sweep.last().unwrap(), Path::new("o"));
    assert_eq!(swept.sweep.len(), 6);
    assert_eq!(swept.path(0, last, 2).unwrap(), folder.join("fluid_a=1_b=2_0002.png"));
}

#[test]
fn a_name_with_an_unsupported_extension_is_not_a_folder() {
    for (name, said) in [
        ("x.jpg", "--out x.jpg: .jpg is not a format that is written; use .png, .exr, "),
        ("o/x.JPEG", "or o/x.JPEG/ for a folder"),
        ("x.webp --format png", ".webp is not"),
        ("x.avi --frames 0-9", ".avi is not"),
        ("x.wav", "--out x.wav is a sound: add --pass sound"),
    ] {
        let why = targets(&format!("fluid --out {name}")).unwrap_err();
        assert!(why.contains(said), "{name}: {why}");
    }
    assert_eq!(path("fluid --out x.jpg/", 0, 0), "x.jpg/fluid.png");
    assert_eq!(path("fluid --out v1.2", 0, 0), "v1.2/fluid.png");
    let dir = tempfile::tempdir().unwrap();
    let there = dir.path().join("there.webp");
    fs::create_dir(&there).unwrap();
    assert_eq!(Path::new(&path(&format!("fluid --out {}", there.display()), 0, 0)), there.join("fluid.png"));
}

#[test]
fn the_output_determines_the_frames() {
    let of = |line| targets(line).map(|t| (t.at, t.drawn, t.keeps));
    assert_eq!(of("a --out o"), Ok((vec![0], Some(1), false)));
    assert_eq!(of("a --out o --frames 9"), Ok((vec![8], Some(9), false)));
    assert_eq!(of("a --out o --at 8,2,2"), Ok((vec![2, 8], Some(9), false)));
    assert_eq!(of("a --out o --at 8 --at 2-3"), Ok((vec![2, 3, 8], None, true)));
    assert_eq!(of("a --out o --at 2 --frames 9"), Ok((vec![2], Some(9), false)));
    assert_eq!(of("a --out o --frames 2-9:3"), Ok((vec![2, 5, 8], None, true)));
    assert_eq!(of("a --out o --frames 2-9:3 --overwrite"), Ok((vec![2, 5, 8], None, false)));
    assert_eq!(of("a --out x.mp4 --frames 3"), Ok((vec![0, 1, 2], Some(3), false)));
    assert_eq!(of("a --out x.mp4 --frames 1-3"), Ok((vec![1, 2, 3], None, false)));
    assert!(of("a --out o --at 9 --frames 9").unwrap_err().contains("the last frame is 8"));
}

#[test]
fn shards_share_the_frames_of_all_projects() {
    let line = "a b --out o --frames 0-4 --sweep x=1;2 --shard";
    let mut all = Vec::new();
    for shard in 0..7 {
        let targets = targets(&format!("{line} {shard}/7")).unwrap();
        for (project, swept) in [(0, 0), (0, 1), (1, 0), (1, 1)] {
            all.extend(targets.part(project, swept).iter().map(|frame| (project, swept, *frame)));
        }
    }
    let wanted = [(0, 0), (0, 1), (1, 0), (1, 1)].into_iter().flat_map(|(p, s)| (0..5).map(move |f| (p, s, f)));
    assert_eq!(all, wanted.collect::<Vec<_>>());
}

#[test]
fn a_film_of_steps_has_its_own_rate() {
    let rate = |line| targets(line).unwrap().rate.per_second();
    assert_eq!(rate("a --out x.mp4 --frames 9"), 60.0);
    assert_eq!(rate("a --out x.mp4 --frames 0-9:2 --fps 25"), 12.5);
    assert_eq!(rate("a --out x.mp4 --frames 9 --fps 24000/1001"), 24_000.0 / 1001.0);
    // A GIF cannot have 60 frames per second: it gets the maximum, unless a rate is requested.
    assert_eq!(rate("a --out x.gif --frames 9"), 50.0);
    assert_eq!(rate("a --out o --format gif --frames 9"), 50.0);
    assert_eq!(rate("a --out x.gif --frames 0-9:2"), 30.0);
    assert_eq!(rate("a --out x.gif --frames 9 --fps 24"), 24.0);
    assert_eq!(rate("a --out x.gif --frames 0-9:3"), 20.0);
}

#[test]
fn colliding_files_and_invalid_options_are_rejected() {
    for (line, says) in [
        ("a b --out x.png", "2 pictures"),
        ("a --out x.png --at 1,2", "2 pictures"),
        ("a --out x.png --sweep b=1;2", "2 pictures"),
        ("a --out o --sweep b=1;2 --sweep b=3;4", "listed twice"),
        ("x/a.json y/a.json --out o", "x/a.json and y/a.json"),
        ("fluid fluid --out o", "would both be written"),
        ("a --out x.png --format npy", "do not agree"),
        ("a b --out x.mp4 --frames 2", "2 films"),
        ("a --out x.mp4", "--frames 600"),
        ("a --out x.mp4 --frames 1,2,4", "as one range"),
        ("a --out x.mp4 --frames 0-9 --shard 0/2", "as a whole"),
        ("a --out o --frames 9 --shard 0/2", "--frames 0-599"),
        ("a --out o --frames 0-9 --at 2", "leave one of them out"),
        ("a --out x.gif --frames 9 --fps 60", "50, 33.3, 25 or 20"),
        ("a --out x.webm --frames 9 --codec prores", "use vp9 or av1"),
        ("a --out x.png --depth 10", "8 or 16"),
        ("a --out o --frames 0-9 --loop 1", "--loop is for films"),
        ("a --out - --frames 9 --format mp4", "needs a file"),
        ("a --out - --frames 9 --json", "leave one of them out"),
        ("a b --out - --frames 9", "one project alone"),
        ("a --out x.mp4 --frames 9 --fps 1e9", "frames per second"),
    ] {
        let message = targets(line).expect_err(line);
        assert!(message.contains(says), "{line}: {message}");
    }
    assert_eq!(targets("fluid fluid --json").unwrap().path(0, &[], 0), None);
}

#[test]
fn case_sensitive_file_systems_distinguish_names_by_case() {
    let list = |names: &[&str]| -> Vec<String> { names.iter().map(|n| (*n).to_owned()).collect() };
    let pair = list(&["x/a.json", "x/A.json"]);
    assert_eq!(stems(&pair, || true), Ok(list(&["a", "A"])));
    assert!(stems(&pair, || false).unwrap_err().contains("would both be written as A"));
    let three = list(&["x/a.json", "x/A.json", "y/a.json"]);
    assert!(stems(&three, || true).unwrap_err().contains("x/a.json and y/a.json"));
    assert!(stems(&list(&["a", "b"]), || panic!("nothing to ask")).is_ok());

    let folder = tempfile::tempdir().unwrap();
    fs::write(folder.path().join("a"), "1").unwrap();
    fs::write(folder.path().join("A"), "2").unwrap();
    let are_two = fs::read_to_string(folder.path().join("a")).unwrap() == "1";
    assert_eq!(tells_case_apart(&folder.path().join("not/there/yet")), are_two);
    assert_eq!(fs::read_dir(folder.path()).unwrap().count(), 1 + usize::from(are_two), "nothing is left behind");
}
