//! Frames by ranges and shards with the built program: names, frames that are kept, an array of tasks compared with one
//! run byte by byte, and killed tasks.

use crate::support::program::{Bench, run};
use std::{
    process::Stdio,
    time::{Duration, Instant},
};

const PLACE: &str = "fragColor = vec4(fragCoord / iResolution.xy, fract(float(iFrame) * 0.37 + iTime), 1.0);";

/// Writes a project that counts frames in a buffer.
fn counting(b: &Bench) {
    b.image(
        "count/buffer_a.glsl",
        "fragColor = texelFetch(iChannel0, ivec2(fragCoord), 0) + vec4(1.0, 0.5, fragCoord);",
    );
    b.image("count/image.glsl", "fragColor = fract(texelFetch(iChannel0, ivec2(fragCoord), 0) / 16.0);");
}

/// Compares two folders byte for byte.
#[track_caller]
fn assert_same(b: &Bench, one: &str, other: &str, count: usize) {
    let names = b.names(one);
    assert_eq!((names.len(), &b.names(other)), (count, &names));
    for name in names {
        assert!(b.bytes(&format!("{one}/{name}")) == b.bytes(&format!("{other}/{name}")), "{other}/{name} differs");
    }
}

#[test]
fn frames_of_a_range_are_numbered_and_existing_files_are_kept() {
    let Some(b) = Bench::with_gpu() else { return };
    b.image("place.glsl", PLACE);
    let line = "render place.glsl --size 4x4 --out o --frames 3-9:3,12";
    let run = b.line(&format!("{line} --json")).expect(0);
    assert_eq!(b.names("o"), ["place_0003.png", "place_0006.png", "place_0009.png", "place_0012.png"]);
    assert_eq!((&run.json()[0]["frames"], &run.json()[0]["kept"]), (&4.into(), &serde_json::Value::Null));
    std::fs::remove_file(b.path("o/place_0006.png")).unwrap();
    b.write("o/place_0009.png", "mine");
    let run = b.line(line).expect(0);
    assert!(run.out.contains("1 frame,") && run.out.contains("3 pictures were there already"), "{}", run.out);
    assert_eq!(b.bytes("o/place_0009.png"), b"mine");
    let run = b.line(&format!("{line} --json")).expect(0);
    assert_eq!((&run.json()[0]["frames"], &run.json()[0]["kept"]), (&0.into(), &4.into()));
    b.line(&format!("{line} --overwrite")).expect(0);
    assert_ne!(b.bytes("o/place_0009.png"), b"mine");
    // A single frame has a name without a number and is always written.
    b.line("render place.glsl --size 4x4 --at 9 --out p").expect(0);
    assert_eq!(b.bytes("p/place.png"), b.bytes("o/place_0009.png"));
    b.write("p/place.png", "old");
    b.line("render place.glsl --size 4x4 --at 9 --out p").expect(0);
    assert_eq!(b.bytes("p/place.png"), b.bytes("o/place_0009.png"));
}

#[test]
fn skipped_frames_do_not_change_the_others() {
    let Some(b) = Bench::with_gpu() else { return };
    b.image("place.glsl", PLACE);
    counting(&b);
    b.image(
        "keeps/buffer_a.glsl",
        "if (int(fragCoord.x) != iFrame % 8) discard; fragColor = vec4(float(iFrame) / 32.0);",
    );
    b.image("keeps/image.glsl", "fragColor = texelFetch(iChannel0, ivec2(fragCoord), 0);");
    b.write("key/eddy.toml", "[passes.image]\nchannels.0 = { keyboard = true }\n");
    b.image("key/image.glsl", "fragColor = texelFetch(iChannel0, ivec2(32, 2), 0) + iMouse / 64.0;");
    let input = ["--mouse", "1:down 4,4; 5:move 9,2; 9:up", "--keys", "2:down 32; 3:up 32"];
    for (project, is_drawn) in [("place.glsl", 3), ("key", 3), ("count", 18), ("keeps", 18)] {
        let stem = project.trim_end_matches(".glsl");
        let args = |frames: &str, out: &str| {
            let line = format!("render {project} --size 16x9 --json --format npy --out {out} {frames}");
            b.eddy(line.split(' ').map(str::to_owned).chain(input.map(str::to_owned))).expect(0).json().remove(0)
        };
        assert_eq!(args("--frames 4,11,17", "jumped")["frames"], is_drawn, "{project}");
        assert_eq!(args("--frames 18 --at 4,11,17", "drawn")["frames"], 18, "{project}");
        for frame in [4, 11, 17] {
            let name = format!("{stem}_{frame:04}.npy");
            assert_eq!(b.bytes(&format!("jumped/{name}")), b.bytes(&format!("drawn/{name}")), "{project} {frame}");
        }
    }
}

#[test]
fn an_array_of_tasks_writes_the_same_files_as_one_run() {
    let Some(b) = Bench::with_gpu() else { return };
    b.image("place.glsl", PLACE);
    counting(&b);
    for (project, shards) in [("place.glsl", 7), ("count", 3)] {
        let line = format!("render {project} --size 16x9 --frames 0-25");
        b.line(&format!("{line} --out {project}.one")).expect(0);
        for shard in 0..shards {
            let run = b.line(&format!("{line} --out {project}.array --shard {shard}/{shards}")).expect(0);
            let is_noted = run.err.contains("the project has a state");
            assert_eq!(is_noted, project == "count" && shard > 0, "{project} {shard}: {}", run.err);
        }
        assert_same(&b, &format!("{project}.one"), &format!("{project}.array"), 26);
    }
    // A scheduler sets the shard by environment variables.
    for task in 0..4u32 {
        let slurm = [
            ("SLURM_ARRAY_TASK_ID", (task * 5 + 10).to_string()),
            ("SLURM_ARRAY_TASK_COUNT", "4".into()),
            ("SLURM_ARRAY_TASK_MIN", "10".into()),
            ("SLURM_ARRAY_TASK_STEP", "5".into()),
        ];
        let mut command = b.command();
        command.args("render place.glsl --size 16x9 --frames 0-25 --out slurm --shard auto".split(' ')).envs(slurm);
        run(&mut command).expect(0);
        let mut command = b.command();
        let seq = (task + 1).to_string();
        command.args("render place.glsl --size 16x9 --frames 0-25 --out seq --shard auto/4".split(' '));
        run(command.env("PARALLEL_SEQ", seq)).expect(0);
    }
    assert_same(&b, "place.glsl.one", "slurm", 26);
    assert_same(&b, "place.glsl.one", "seq", 26);
    let none = b.line("render place.glsl --frames 0-25 --out none --shard auto").expect(2);
    assert!(none.err.contains("SLURM_ARRAY_TASK_ID") && none.err.contains("i/n"), "{}", none.err);
    // With more tasks than frames, some tasks have nothing to do, which is not an error.
    assert_eq!(
        b.line("render place.glsl --size 4x4 --frames 0-1 --out few --shard 1/3").expect(0).out.lines().count(),
        1
    );
    assert_eq!(b.line("render place.glsl --size 4x4 --frames 0-1 --out few --shard 0/3").expect(0).out, "");
}

/// `EDDY_KILLS` is the number of killed tasks.
#[test]
fn a_killed_and_restarted_task_writes_the_same_bytes() {
    let Some(b) = Bench::with_gpu() else { return };
    b.image("place.glsl", PLACE);
    let line = "render place.glsl --size 96x54 --frames 0-29";
    let start = Instant::now();
    b.line(&format!("{line} --out one")).expect(0);
    let whole = start.elapsed();
    let kills = std::env::var("EDDY_KILLS").ok().and_then(|kills| kills.parse().ok()).unwrap_or(5u32);
    let mut killed_while_writing = 0;
    for kill in 0..kills {
        let out = format!("killed{kill}");
        let mut command = b.command();
        command.args(format!("{line} --out {out}").split(' ')).stdout(Stdio::null()).stderr(Stdio::null());
        let mut child = command.spawn().unwrap();
        // A moment while pictures are written: by the golden ratio, which spreads any number of them.
        let part = (f64::from(kill) * 0.618_033_988_75 + 0.5).fract();
        let first = b.path(format!("{out}/place_0000.png"));
        let give_up = Instant::now() + Duration::from_secs(60);
        while !first.exists() && Instant::now() < give_up {
            std::thread::sleep(Duration::from_millis(1));
        }
        std::thread::sleep(whole.mul_f64(0.3 * part));
        child.kill().unwrap();
        child.wait().unwrap();
        let names = b.names(&out);
        let pictures = || names.iter().filter(|name| name.ends_with(".png"));
        killed_while_writing += u32::from(pictures().count() < 30);
        for name in pictures() {
            assert!(b.bytes(&format!("{out}/{name}")) == b.bytes(&format!("one/{name}")), "{name} is incomplete");
        }
        b.line(&format!("{line} --out {out}")).expect(0);
        assert_same(&b, "one", &out, 30);
    }
    assert!(killed_while_writing > 0, "no task was killed in time");
}
