//! Files by ffmpeg: the frame of a position is the last one whose time is not later.

use super::*;

/// Returns positions of all kinds in a video of `count` frames at `rate`, with the frame that each shows.
fn positions(count: usize, rate: f64, random: &mut Random) -> Vec<(f64, usize)> {
    let length = count as f64 / rate;
    let of = |n: usize| n as f64 / rate;
    let mut all = Vec::new();
    // On each frame, just before the next, and past the end.
    for n in 0..count + 3 {
        all.push((of(n), n % count));
        all.push((of(n + 1) - 1.5e-3, n % count));
    }
    // Backwards, and in later rounds.
    for n in (0..count).rev().step_by(7) {
        all.push((of(n) + 0.3 / rate, n));
        all.push((2.0 * length + of(n) + 0.3 / rate, n));
    }
    for _ in 0..12 {
        let n = random.below(3 * count as u64) as usize;
        all.push((of(n) + (0.1 + 0.7 * random.unit()) / rate, n % count));
    }
    all
}

#[test]
fn each_position_shows_its_frame_at_every_rate_and_in_every_container() {
    if !has_ffmpeg() {
        return;
    }
    let folder = tempfile::tempdir().unwrap();
    let mut random = Random(1);
    let h264 = ["-c:v", "libx264rgb", "-qp", "0", "-g", "12"];
    let vp9 = ["-c:v", "libvpx-vp9", "-lossless", "1", "-pix_fmt", "gbrp"];
    for (name, rate, args) in [
        ("24.mkv", 24.0, &FFV1[..]),
        ("25.mkv", 25.0, &FFV1),
        ("30.mkv", 30.0, &FFV1),
        ("60.mkv", 60.0, &FFV1),
        ("24.mp4", 24.0, &h264),
        ("30.mp4", 30.0, &h264),
        ("30.avi", 30.0, &FFV1),
        ("24.webm", 24.0, &vp9),
        ("60.webm", 60.0, &vp9),
    ] {
        let path = folder.path().join(name);
        encode(&path, 48, &rate.to_string(), args);
        // Once kept as a whole, once as a window of two frames.
        for (pool, is_kept) in [(Pool::default(), true), (Pool::new(0), false)] {
            let video = open_with(&path, &Tools::default(), &pool).unwrap();
            let VideoInfo { width, height, seconds, .. } = video.info();
            assert_eq!((width, height), SIDE, "{name}");
            assert!((seconds - 48.0 / rate).abs() < 1e-3, "{name}: {seconds}");
            let few = if is_kept { 1 } else { 4 };
            for (at, wanted) in positions(48, rate, &mut random).into_iter().step_by(few) {
                // A container that rounds the length to milliseconds is off by as much in each round.
                let at = at + (at / (48.0 / rate)).floor() * (seconds - 48.0 / rate);
                assert_eq!(shown(&video, at), wanted, "{name} at {at}");
            }
        }
    }
}

#[test]
fn variable_rate_frames_follow_their_times() {
    if !has_ffmpeg() {
        return;
    }
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("variable.mkv");
    // Frame n starts at n^2 / 100 s.
    let times = "settb=1/100,setpts=N*N";
    encode(
        &path,
        12,
        "25",
        &["-vf", times, "-fps_mode", "passthrough", "-enc_time_base", "1/100", "-c:v", "ffv1", "-pix_fmt", "bgra"],
    );
    let video = open(&path).unwrap();
    assert!(video.info().seconds >= 1.21, "{:?}", video.info());
    for n in 0..11_usize {
        let start = (n * n) as f64 / 100.0;
        let end = ((n + 1) * (n + 1)) as f64 / 100.0;
        for at in [start, start + 1e-3, 0.5 * (start + end), end - 1e-3] {
            assert_eq!(shown(&video, at), n, "at {at}");
        }
    }
    assert_eq!(shown(&video, 0.36), 6);
}

#[test]
fn a_jump_shows_the_same_frames_as_playing() {
    if !has_ffmpeg() {
        return;
    }
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("long.mp4");
    // 600 frames with a key frame every 10 s, and references across frames.
    encode(&path, 200, "10", &["-c:v", "libx264", "-crf", "4", "-g", "100", "-bf", "3", "-pix_fmt", "yuv444p"]);
    let played = open_with(&path, &Tools::default(), &Pool::new(0)).unwrap();
    let all: Vec<Frame> = (0..200).map(|n| played.frame_at(n as f64 / 10.0, Pace::Exact).frame.unwrap()).collect();
    let mut random = Random(2);
    for _ in 0..25 {
        let n = random.below(200) as usize;
        let fresh = open_with(&path, &Tools::default(), &Pool::new(0)).unwrap();
        let frame = fresh.frame_at(n as f64 / 10.0 + 0.02, Pace::Exact).frame.unwrap();
        assert!(frame.texels == all[n].texels, "frame {n}");
    }
}

#[test]
fn memory_is_bounded_and_released() {
    if !has_ffmpeg() {
        return;
    }
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("a.mkv");
    encode(&path, 200, "25", &FFV1);
    let bytes = u64::from(SIDE.0 * SIDE.1 * 4);
    let pool = Pool::new(20 * bytes);
    let video = open_with(&path, &Tools::default(), &pool).unwrap();
    for n in 0..250 {
        shown(&video, n as f64 / 25.0);
        assert!(pool.taken() <= 22 * bytes, "{} frames", pool.taken() / bytes);
    }
    drop(video);
    assert_eq!(pool.taken(), 0);
}

#[test]
fn sizes_and_colours_match_browsers() {
    if !has_ffmpeg() {
        return;
    }
    let folder = tempfile::tempdir().unwrap();
    let file = |name: &str| folder.path().join(name);
    let red = ["-vf", "geq=r=255:g=0:b=0,scale=out_color_matrix=bt709,format=yuv420p", "-c:v", "libx264", "-qp", "0"];
    let tagged = [&red[..], &["-colorspace", "bt709", "-color_primaries", "bt709", "-color_trc", "bt709"]].concat();
    encode(&file("709.mp4"), 5, "25", &tagged);
    let video = open(&file("709.mp4")).unwrap();
    let texel = video.frame_at(0.0, Pace::Exact).frame.unwrap().texels[..4].to_vec();
    assert!(texel[0] >= 253 && texel[1] <= 2 && texel[2] <= 2, "{texel:?}");
    // Without a tag this one is treated as BT.601, as in Chromium, and so is not pure red.
    encode(&file("untagged.mp4"), 5, "25", &red);
    let video = open(&file("untagged.mp4")).unwrap();
    let texel = video.frame_at(0.0, Pace::Exact).frame.unwrap().texels[..4].to_vec();
    assert!((225..=240).contains(&texel[0]), "{texel:?}");
    // Wide pixels, and a picture that is rotated to its side.
    for (name, args, size) in [
        ("wide.mp4", &["-c", "copy", "-aspect", "8:3"][..], (32, 12)),
        ("turned.mp4", &["-c", "copy", "-metadata:s:v:0", "rotate=90"], (12, 16)),
    ] {
        let made =
            Command::new("ffmpeg").args(["-v", "error", "-i"]).arg(file("709.mp4")).args(args).arg(file(name)).status();
        assert!(made.unwrap().success());
        let video = open(&file(name)).unwrap();
        let is_turned = size == (12, 16) && (video.info().width, video.info().height) == SIDE;
        // Newer versions of ffmpeg do not write the rotation this way.
        assert!((video.info().width, video.info().height) == size || is_turned, "{name}: {:?}", video.info());
        assert_eq!(video.frame_at(0.0, Pace::Exact).frame.unwrap().texels.len(), video.info().frame_bytes());
    }
    // An alpha channel, and an odd size.
    encode(
        &file("alpha.webm"),
        5,
        "25",
        &["-vf", "geq=r=255:g=0:b=0:a=128,crop=15:11,format=yuva420p", "-c:v", "libvpx-vp9"],
    );
    let video = open(&file("alpha.webm")).unwrap();
    assert_eq!((video.info().width, video.info().height), (15, 11));
    let texel = video.frame_at(0.0, Pace::Exact).frame.unwrap().texels[..4].to_vec();
    assert!((126..=129).contains(&texel[3]), "{texel:?}");
}

#[test]
fn other_files_are_errors_and_truncated_videos_play_to_their_end() {
    if !has_ffmpeg() {
        return;
    }
    let folder = tempfile::tempdir().unwrap();
    let file = |name: &str| folder.path().join(name);
    let sound = ["-v", "error", "-f", "lavfi", "-i", "sine=d=1", "-c:a", "libvorbis"];
    assert!(Command::new("ffmpeg").args(sound).arg(file("sound.webm")).status().unwrap().success());
    assert_eq!(open(&file("sound.webm")).unwrap_err(), VideoError::NoPicture);
    fs::write(file("text.mp4"), "no video\n".repeat(100)).unwrap();
    assert!(matches!(open(&file("text.mp4")).unwrap_err(), VideoError::Damaged(_)));
    fs::write(file("empty.mp4"), "").unwrap();
    assert!(matches!(open(&file("empty.mp4")).unwrap_err(), VideoError::Damaged(_)));
    encode(&file("whole.mkv"), 48, "24", &FFV1);
    let bytes = fs::read(file("whole.mkv")).unwrap();
    fs::write(file("cut.mkv"), &bytes[..bytes.len() / 2]).unwrap();
    let video = open(&file("cut.mkv")).unwrap();
    assert_eq!(shown(&video, 3.2 / 24.0), 3);
    let last = shown(&video, 47.5 / 24.0);
    assert!((4..47).contains(&last), "the last whole frame stays: {last}");
}

#[test]
fn a_file_without_a_length_ends_with_its_last_frame() {
    if !has_ffmpeg() {
        return;
    }
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("live.webm");
    encode(&path, 25, "25", &["-c:v", "libvpx-vp9", "-lossless", "1", "-pix_fmt", "gbrp", "-live", "1", "-f", "webm"]);
    let video = open(&path).unwrap();
    assert!((video.info().seconds - 1.0).abs() < 0.05, "{:?}", video.info());
    assert_eq!(shown(&video, 0.5), 12);
}

#[test]
fn a_live_picture_does_not_wait_for_long() {
    if !has_ffmpeg() {
        return;
    }
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("a.mkv");
    encode(&path, 200, "25", &FFV1);
    let video = open_with(&path, &Tools::default(), &Pool::new(0)).unwrap();
    // Jumps until a frame is late: then an available frame is shown, and later the right one.
    let mut was_late = 0;
    for n in 0..40 {
        let at = (n * 61 % 200) as f64 / 25.0;
        let began = std::time::Instant::now();
        let shown = video.frame_at(at, Pace::Live);
        // 150 ms, plus the delays of a busy machine.
        assert!(began.elapsed() < Duration::from_millis(1500), "{:?}", began.elapsed());
        assert!(shown.frame.is_some());
        was_late += usize::from(shown.is_late);
        let settled = video.frame_at(at, Pace::Exact);
        assert_eq!(number(&settled.frame.unwrap()), n * 61 % 200);
    }
    assert!(was_late < 40);
}
