//! Tests of valid, damaged, mismatched and oversized checkpoints.

use super::*;

fn moment() -> Moment {
    Moment {
        eddy: "1.2.3".into(),
        project: "waves".into(),
        fingerprint: "0123".into(),
        frame: 40,
        size: (8, 4),
        device: "a device".into(),
    }
}

fn state() -> State {
    let texels = |count: u64, from: u64| (0..count).map(|n| (n * 7 + from) as u8).collect::<Vec<u8>>();
    let flat = TextureShape::flat(8, 4, TexelFormat::Rgba32f);
    let cube = TextureShape::cube(2, TexelFormat::Rgba16f);
    let target = |pass, index, shape: TextureShape, count: u64| TargetState {
        pass,
        index,
        shape,
        textures: (0..count).map(|n| texels(shape.bytes(), n)).collect(),
    };
    State { targets: vec![target(PassName::buffer("A"), 1, flat, 2), target(PassName::cube(), 0, cube, 1)] }
}

fn forms() -> Vec<TargetForm> {
    let form = |target: TargetState| TargetForm {
        textures: target.textures.len(),
        pass: target.pass,
        index: target.index,
        shape: target.shape,
        is_read: true,
    };
    state().targets.into_iter().map(form).collect()
}

/// Five gigabytes of zeros take five megabytes of a file: the list of targets is compared before they are decompressed.
#[test]
fn only_targets_that_the_program_has_are_kept() {
    let dir = tempfile::tempdir().unwrap();
    let file = dir.path().join("a.eddystate");
    write(dir.path(), "a.eddystate", &moment(), &state()).unwrap();
    // Targets that are not read, or that another selection of passes has, are skipped.
    let mut less = forms();
    less[0].is_read = false;
    let kept = |forms: &[TargetForm]| read(&file, &moment(), forms).unwrap().state.targets;
    assert_eq!(kept(&less), state().targets[1..]);
    assert_eq!(kept(&forms()[..1]), state().targets[..1]);
    let mut other = forms();
    other[0].shape = TextureShape::flat(8, 8, TexelFormat::Rgba32f);
    let error = read(&file, &moment(), &other).unwrap_err().to_string();
    assert!(error.contains("Buffer A was 8x4") && error.contains("and is 8x8"), "{error}");
    // The texels of these are missing: the list alone decides.
    let whole = std::fs::read(&file).unwrap();
    let line = whole.iter().position(|b| *b == b'\n').unwrap();
    let text = String::from_utf8(whole[..line].to_vec()).unwrap();
    let entry = |n: usize| {
        format!(
            ",{{\"pass\":\"b{n}\",\"target\":0,\"format\":\"rgba32f\",\"width\":8192,\"height\":8192,\"faces\":1,\"textures\":1}}]}}"
        )
    };
    let with = |text: &str, entry: &str| format!("{}{entry}\n", text.strip_suffix("]}").unwrap());
    std::fs::write(&file, with(with(&text, &entry(1)).trim_end(), &entry(2))).unwrap();
    let error = read(&file, &moment(), &forms()).unwrap_err().to_string();
    assert!(error.contains("targets that this run does not have"), "{error}");
    let twice = text.replace("\"cube_a\"", "\"buffer_a\"");
    std::fs::write(&file, format!("{twice}\n")).unwrap();
    assert!(read(&file, &moment(), &forms()).is_err());
}

#[test]
fn state_round_trips_bit_for_bit() {
    let dir = tempfile::tempdir().unwrap();
    let file = dir.path().join(file_name("waves", 40));
    write(dir.path(), &file_name("waves", 40), &moment(), &state()).unwrap();
    assert_eq!(read(&file, &moment(), &forms()).unwrap(), Checkpoint { moment: moment(), state: state() });
    assert_eq!(super::moment(&file).unwrap(), moment());
}

#[test]
fn mismatched_run_is_rejected_with_the_reason() {
    let dir = tempfile::tempdir().unwrap();
    let file = dir.path().join("a.eddystate");
    write(dir.path(), "a.eddystate", &moment(), &state()).unwrap();
    for (run, said) in [
        (Moment { eddy: "1.2.4".into(), ..moment() }, "written by Eddy 1.2.3, and this is 1.2.4"),
        (Moment { size: (8, 5), ..moment() }, "of 8x4 pixels, and this one of 8x5"),
        (Moment { fingerprint: "0124".into(), ..moment() }, "have changed since"),
    ] {
        let error = read(&file, &run, &forms()).unwrap_err().to_string();
        assert!(error.contains("a.eddystate does not fit") && error.contains(said), "{error}");
    }
    // The device and the project's name do not matter.
    let elsewhere = Moment { device: "another".into(), project: "b".into(), frame: 0, ..moment() };
    assert!(read(&file, &elsewhere, &forms()).is_ok());
}

#[test]
fn damaged_files_are_rejected() {
    let dir = tempfile::tempdir().unwrap();
    let file = dir.path().join("a.eddystate");
    write(dir.path(), "a.eddystate", &moment(), &state()).unwrap();
    let whole = std::fs::read(&file).unwrap();
    let line = whole.iter().position(|b| *b == b'\n').unwrap();
    let mut accepted = 0;
    for at in 0..whole.len() {
        for damage in [0x01, 0x80] {
            let mut bytes = whole.clone();
            bytes[at] ^= damage;
            std::fs::write(&file, &bytes).unwrap();
            let read = read(&file, &moment(), &forms());
            // Descriptive text, and fields of the gzip header (time, system), may differ.
            let is_free = at < line || (line + 1..line + 11).contains(&at);
            assert!(is_free || read.is_err(), "byte {at} of {}", whole.len());
            accepted += usize::from(read.is_ok_and(|read| read.state != state()));
        }
        std::fs::write(&file, &whole[..at]).unwrap();
        assert!(read(&file, &moment(), &forms()).is_err(), "cut at {at}");
    }
    // A valid but different name of a pass or a format is reported by the engine.
    assert!(accepted < 20, "{accepted}");
    let large =
        String::from_utf8_lossy(&whole[..line]).replace("\"width\":8,\"height\":4", "\"width\":32768,\"height\":32768");
    std::fs::write(&file, [large.as_bytes(), &whole[line..]].concat()).unwrap();
    let error = read(&file, &moment(), &forms()).unwrap_err().to_string();
    assert!(error.contains("it says that it holds") && error.contains("bytes"), "{error}");
    std::fs::write(&file, b"{\"eddy_checkpoint\":2}\n").unwrap();
    assert!(read(&file, &moment(), &forms()).unwrap_err().to_string().contains("a newer Eddy wrote"));
}

#[test]
fn the_latest_checkpoint_before_a_frame_is_found() {
    let dir = tempfile::tempdir().unwrap();
    for frame in [0, 100, 200, 1_000_000] {
        std::fs::write(dir.path().join(file_name("a", frame)), "").unwrap();
    }
    std::fs::write(dir.path().join(file_name("a_b", 150)), "").unwrap();
    std::fs::write(dir.path().join("a_x.eddystate"), "").unwrap();
    let found = |frame| latest(dir.path(), "a", frame).unwrap().map(|(frame, _)| frame);
    assert_eq!([0, 99, 100, 199, 5_000_000].map(found), [0, 0, 100, 100, 1_000_000].map(Some));
    assert_eq!(latest(dir.path(), "c", 9).unwrap(), None);
}
