//! Hostile files and names, and an ffmpeg that is missing or hangs.

use super::*;
use std::time::Instant;

#[test]
fn special_file_names_are_not_interpreted_by_ffmpeg() {
    if !has_ffmpeg() {
        return;
    }
    let folder = tempfile::tempdir().unwrap();
    let whole = folder.path().join("whole.mkv");
    encode(&whole, 10, "25", &FFV1);
    for name in [
        "-i",
        "-",
        "a%03d.mkv",
        "concat:a|b",
        "file:x",
        "http:x.mp4",
        "lavfi",
        "pipe:0",
        "x.m3u8",
        "a\nb",
        "*.mkv",
        "subfile,,start,0,end,9,,:a",
    ] {
        let path = folder.path().join(name);
        fs::copy(&whole, &path).unwrap();
        let video = open(&path).unwrap_or_else(|e| panic!("{name}: {e}"));
        assert_eq!(shown(&video, 0.21), 5, "{name}");
    }
}

#[test]
fn playlists_and_scripts_are_rejected() {
    if !has_ffmpeg() {
        return;
    }
    let folder = tempfile::tempdir().unwrap();
    let secret = folder.path().join("secret.mkv");
    encode(&secret, 10, "25", &FFV1);
    let (secret, ts) = (secret.display().to_string(), folder.path().join("secret.ts"));
    encode(&ts, 10, "25", &["-c:v", "mpeg2video"]);
    let ts = ts.display();
    for (name, text) in [
        ("concat.mp4", format!("ffconcat version 1.0\nfile '{secret}'\n")),
        ("list.mp4", format!("#EXTM3U\n#EXT-X-TARGETDURATION:1\n#EXTINF:1,\nfile://{ts}\n#EXT-X-ENDLIST\n")),
        (
            "dash.mp4",
            format!(
                "<?xml version=\"1.0\"?><MPD><Period><AdaptationSet><BaseURL>file://{secret}</BaseURL></AdaptationSet></Period></MPD>"
            ),
        ),
        ("refs.mov", format!("RTSPtextRTSP://{secret}")),
        ("sdp.mp4", "v=0\no=- 0 0 IN IP4 127.0.0.1\nc=IN IP4 127.0.0.1\nm=video 5004 RTP/AVP 96\n".into()),
        ("lavfi.mp4", "testsrc".into()),
        ("vob.mp4", format!("[Script Info]\n[playlist]\nFile1={secret}\n")),
        ("meta.mp4", ";FFMETADATA1\ntitle=x\n".into()),
    ] {
        let path = folder.path().join(name);
        fs::write(&path, text).unwrap();
        let error = open(&path).expect_err(name);
        assert!(matches!(error, VideoError::Damaged(_) | VideoError::NoPicture), "{name}: {error:?}");
    }
}

#[test]
fn without_ffmpeg_the_error_says_what_to_install() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("a.mp4");
    fs::write(&path, "anything").unwrap();
    let tools =
        Tools { ffprobe: folder.path().join("ffprobe"), ffmpeg: folder.path().join("ffmpeg"), ..Tools::default() };
    let error = open_with(&path, &tools, &Pool::default()).unwrap_err();
    assert!(matches!(error, VideoError::NoProgram { .. }), "{error:?}");
    assert!(error.hint().contains("install ffmpeg"), "{}", error.hint());
}

/// Makes a program from a shell script.
#[cfg(unix)]
fn script(path: &Path, text: &str) {
    use std::os::unix::fs::PermissionsExt;
    fs::write(path, format!("#!/bin/sh\n{text}\n")).unwrap();
    fs::set_permissions(path, fs::Permissions::from_mode(0o755)).unwrap();
}

#[cfg(unix)]
#[test]
fn a_decoder_that_hangs_is_stopped_and_abandoned() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("a.mp4");
    fs::write(&path, "anything").unwrap();
    let (ffmpeg, ffprobe) = (folder.path().join("ffmpeg"), folder.path().join("ffprobe"));
    let pids = folder.path().join("pids");
    let sleeps = format!("echo $$ >> '{}'; exec sleep 600", pids.display());
    script(&ffmpeg, &sleeps);
    script(&ffprobe, &sleeps);
    let patience = Duration::from_millis(400);
    let tools = Tools { ffmpeg: ffmpeg.clone(), ffprobe: ffprobe.clone(), patience };
    let began = Instant::now();
    assert!(matches!(open_with(&path, &tools, &Pool::default()).unwrap_err(), VideoError::Hangs { .. }));
    let answer = r#"{"streams":[{"width":4,"height":4,"time_base":"1/25","avg_frame_rate":"25/1"}],"format":{"duration":"1.0"}}"#;
    script(&ffprobe, &format!("echo '{answer}'"));
    assert!(matches!(open_with(&path, &tools, &Pool::default()).unwrap_err(), VideoError::Hangs { .. }));
    // A decoder that outputs some frames and then hangs: the decoded ones stay.
    let frames = "head -c 128 /dev/zero; echo '[Parsed_showinfo_0 @ 0x0] n: 0 pts: 0 s:4x4' >&2; \
                  echo '[Parsed_showinfo_0 @ 0x0] n: 1 pts: 1 s:4x4' >&2";
    script(&ffmpeg, &format!("{frames}; {sleeps}"));
    let video = open_with(&path, &tools, &Pool::default()).unwrap();
    let shown = video.frame_at(0.5, Pace::Exact);
    assert!(shown.frame.is_some() && !shown.is_late, "{shown:?}");
    // Later lookups do not wait again.
    let again = Instant::now();
    video.frame_at(0.6, Pace::Exact);
    assert!(again.elapsed() < patience);
    assert!(began.elapsed() < Duration::from_secs(20), "{:?}", began.elapsed());
    drop(video);
    for pid in fs::read_to_string(&pids).unwrap().split_whitespace() {
        let status = fs::read_to_string(format!("/proc/{pid}/stat")).unwrap_or_default();
        assert!(status.is_empty() || status.contains(") Z"), "{pid} still runs: {status}");
    }
}

#[cfg(unix)]
#[test]
fn endless_messages_use_bounded_memory_and_do_not_block() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("a.mp4");
    fs::write(&path, "anything").unwrap();
    let (ffmpeg, ffprobe) = (folder.path().join("ffmpeg"), folder.path().join("ffprobe"));
    script(&ffprobe, "head -c 20000000 /dev/zero; head -c 3000000 /dev/zero >&2");
    script(&ffmpeg, "exit 1");
    let tools = Tools { ffmpeg, ffprobe, patience: Duration::from_secs(10) };
    assert!(matches!(open_with(&path, &tools, &Pool::default()).unwrap_err(), VideoError::Damaged(_)));
}
