//! Music as a texture: the analyser's rows, which do not depend on the frames drawn before, and the fallback for a
//! missing file.

use crate::support::{ffmpeg::has_ffmpeg, program::Bench};
use std::f64::consts::TAU;

/// Returns a WAV file of a sine: 16 bits, stereo, 44.1 kHz.
fn wav(hertz: f64, seconds: f64) -> Vec<u8> {
    let count = (seconds * 44_100.0) as u32;
    let mut file = b"RIFF".to_vec();
    file.extend((36 + 4 * count).to_le_bytes());
    file.extend(b"WAVEfmt \x10\0\0\0\x01\0\x02\0");
    file.extend(44_100u32.to_le_bytes());
    file.extend(176_400u32.to_le_bytes());
    file.extend(b"\x04\0\x10\0data");
    file.extend((4 * count).to_le_bytes());
    for n in 0..count {
        let value = (600.0 * (TAU * hertz * f64::from(n) / 44_100.0).sin()) as i16;
        file.extend(value.to_le_bytes().repeat(2));
    }
    file
}

/// Writes a project whose Image shows the texture texel by texel, and the uniforms in its third row.
fn project(b: &Bench, channel: &str) {
    b.write("p/eddy.toml", format!("[passes.image]\nchannels.0 = {channel}\n"));
    b.image(
        "p/image.glsl",
        "fragColor = fragCoord.y < 2. ? texelFetch(iChannel0, ivec2(fragCoord), 0) : \
         vec4(iChannelTime[0], iChannelResolution[0]);",
    );
}

fn texels(b: &Bench, at: &str) -> crate::support::program::Npy {
    b.line(&format!("render p --size 512x3 --fps 60 --at {at} --out p.npy")).expect(0);
    b.npy("p.npy")
}

#[test]
fn a_sine_peaks_at_its_bin_and_frames_do_not_depend_on_earlier_ones() {
    let Some(b) = Bench::with_gpu() else { return };
    b.write("p/tone.wav", wav(440.0, 1.0));
    project(&b, "{ file = \"tone.wav\", kind = \"music\" }");
    let alone = texels(&b, "50");
    let peak = (0..512).max_by(|x, y| alone.at(*x, 0)[0].total_cmp(&alone.at(*y, 0)[0])).unwrap();
    assert!((20..=21).contains(&peak), "440 Hz is in bin 20.4, not {peak}");
    // The wave swings by 600 of 32,768 around 128 of 255.
    let wave: Vec<f32> = (0..512).map(|x| alone.at(x, 1)[0] * 255.0).collect();
    let (low, high) = wave.iter().fold((255f32, 0f32), |(low, high), v| (low.min(*v), high.max(*v)));
    assert!((125.0..=126.5).contains(&low) && (129.5..=131.0).contains(&high), "{low} to {high}");
    assert_eq!(alone.at(9, 2)[1..], [512.0, 2.0, 1.0]);
    assert!((alone.at(9, 2)[0] - 50.0 / 60.0).abs() < 1e-6);
    // It loops: a second and a half in, the position is half a second.
    assert!((texels(&b, "90").at(9, 2)[0] - 0.5).abs() < 1e-6);
    b.line("render p --size 512x3 --fps 60 --at 10,50 --format npy --out both").expect(0);
    let names = b.names("both");
    let run = b.npy(&format!("both/{}", names.iter().find(|n| n.contains("50")).unwrap()));
    assert_eq!(run.texels, alone.texels);
}

#[test]
fn unreadable_music_is_silent_and_missing_shadertoy_music_is_synthetic() {
    let Some(b) = Bench::with_gpu() else { return };
    b.write("p/bad.mp3", [7; 4000]);
    for name in ["gone.mp3", "bad.mp3"] {
        project(&b, &format!("{{ file = \"{name}\", kind = \"music\" }}"));
        let run = b.line("render p --size 512x3 --at 30 --out p.npy --overwrite").expect(0);
        assert!(run.err.contains(name) && run.err.contains("the channel is silent"), "{}", run.err);
        let shown = b.npy("p.npy");
        for x in [0, 3, 100, 511] {
            assert_eq!(shown.at(x, 0)[0], 0.0, "{name}: no level");
            assert!((shown.at(x, 1)[0] - 128.0 / 255.0).abs() < 1e-6, "{name}: the wave is flat");
        }
        // The time, and the size of the texture.
        assert_eq!(shown.at(0, 2), [0.0, 512.0, 2.0, 1.0], "{name}");
    }
    let pass = r#"{"inputs": [{"id": 1, "src": "/media/a/gone.mp3", "ctype": "music", "channel": 0,
        "sampler": {"filter": "linear", "wrap": "clamp", "vflip": "true", "srgb": "false", "internal": "byte"}}],
        "outputs": [{"id": 37, "channel": 0}], "code": CODE, "name": "", "description": "", "type": "image"}"#;
    let code = serde_json::to_string(&String::from_utf8(b.bytes("p/image.glsl")).unwrap()).unwrap();
    b.write(
        "site.json",
        format!(r#"{{"ver": "0.1", "info": {{"id": "x"}}, "renderpass": [{}]}}"#, pass.replace("CODE", &code)),
    );
    let run = b.line("render site.json --size 512x3 --at 30 --out p.npy --overwrite").expect(0);
    assert!(run.err.contains("gone.mp3") && run.err.contains("synthetic spectrum"), "{}", run.err);
    let shown = b.npy("p.npy");
    let t: f64 = 30.0 / 60.0;
    for j in [3usize, 100, 400] {
        let x = j as f64 / 512.0;
        let level = (0.75 + 0.25 * (10.0 * j as f64 + 13.0 * t).sin()) * (-3.0 * x).exp();
        assert!((f64::from(shown.at(j, 0)[0]) - level).abs() < 1.0 / 255.0, "{j}");
    }
    assert_eq!(shown.at(0, 2)[0], 10.5);
}

/// ffmpeg decodes Opus, AC-3 and the sound of videos.
#[test]
fn ffmpeg_decodes_other_formats_and_the_sound_of_videos() {
    let Some(b) = Bench::with_gpu().filter(|_| has_ffmpeg()) else { return };
    b.write("p/tone.wav", wav(440.0, 1.0));
    let convert = |options: &[&str], name: &str| {
        let mut command = std::process::Command::new("ffmpeg");
        command.args(["-v", "error", "-y"]).args(options).arg(name).current_dir(b.path("p"));
        assert!(command.status().unwrap().success(), "{name}");
    };
    let picture = ["-i", "tone.wav", "-f", "lavfi", "-i", "color=red:size=64x64:rate=25:duration=1", "-shortest"];
    convert(&["-i", "tone.wav", "-c:a", "libopus", "-b:a", "128k"], "a.opus");
    convert(&["-i", "tone.wav"], "a.aiff");
    convert(&["-i", "tone.wav", "-c:a", "ac3"], "a.ac3");
    convert(&[&picture[..], &["-c:v", "libvpx-vp9", "-c:a", "libopus"]].concat(), "a.webm");
    convert(&[&picture[..], &["-c:v", "mpeg4", "-c:a", "ac3"]].concat(), "a.mkv");
    convert(&["-f", "lavfi", "-i", "color=red:size=64x64:rate=25:duration=1", "-c:v", "mpeg4"], "mute.mkv");
    for name in ["a.opus", "a.aiff", "a.ac3", "a.webm", "a.mkv"] {
        project(&b, &format!("{{ file = \"{name}\", kind = \"music\" }}"));
        let texels = texels(&b, "50");
        let peak = (0..512).max_by(|x, y| texels.at(*x, 0)[0].total_cmp(&texels.at(*y, 0)[0])).unwrap();
        assert!((20..=21).contains(&peak), "{name}: 440 Hz is in bin 20.4, not {peak}");
    }
    // A playlist that points ffmpeg to another file is refused, whatever its extension.
    b.write("p/list.aac", "ffconcat version 1.0\nfile tone.wav\n");
    b.write("p/list.mp3", "#EXTM3U\n#EXT-X-TARGETDURATION:1\n#EXTINF:1,\ntone.wav\n#EXT-X-ENDLIST\n");
    for name in ["list.aac", "list.mp3"] {
        project(&b, &format!("{{ file = \"{name}\", kind = \"music\" }}"));
        let warnings = b.line("check p").expect(0).err;
        assert!(warnings.contains("the channel is silent"), "{name}: {warnings}");
    }
    project(&b, "{ file = \"mute.mkv\", kind = \"music\" }");
    assert!(b.line("check p").expect(0).err.contains("the channel is silent"));
}

#[test]
fn an_unrecorded_microphone_gets_the_synthetic_spectrum() {
    let Some(b) = Bench::with_gpu() else { return };
    project(&b, "{ microphone = true }");
    let run = b.line("render p --size 512x3 --at 30 --out p.npy").expect(0);
    assert!(run.err.contains("iChannel0 of Image: the microphone is not recorded"), "{}", run.err);
    let shown = b.npy("p.npy");
    let level = (0.75 + 0.25 * (1000.0 + 13.0 * 0.5_f64).sin()) * (-3.0 * 100.0 / 512.0_f64).exp();
    assert!((f64::from(shown.at(100, 0)[0]) - level).abs() < 1.0 / 255.0);
    assert_eq!(shown.at(9, 2), [10.5, 512.0, 2.0, 1.0]);
}

#[test]
fn a_damaged_file_is_reported_with_a_fix() {
    let Some(b) = Bench::with_gpu() else { return };
    b.write("p/bad.mp3", [7; 4000]);
    project(&b, "{ file = \"bad.mp3\", kind = \"music\" }");
    let run = b.line("check p").expect(0);
    assert!(run.err.contains("bad.mp3") && run.err.contains("ffmpeg"), "{} {}", run.out, run.err);
}
