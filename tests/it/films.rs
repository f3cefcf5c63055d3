//! Films written by the built program: the frames that ffmpeg decodes from them, their colours, tags, sound and files.
//! Tests that need ffmpeg are skipped where it is not installed.

use crate::support::{
    ffmpeg::{decoded, decoded_by, decoded_sound, has_ffmpeg, probed},
    program::{Bench, run},
};
use eddy::{
    engine::FrameInputs,
    playback::recording::{RecordedFrame, Recording},
    project::CustomUniformValue,
};
use std::fs;

/// Twelve patches of 32x24 pixels, whose colours are spread over the RGB cube.
const CHART: &str = "vec2 cell = floor(fragCoord / vec2(32.0, 24.0)); float n = cell.x + 4.0 * cell.y; vec3 c = n < 8.0 ? \
                    vec3(mod(n, 2.0), mod(floor(n / 2.0), 2.0), floor(n / 4.0)) : n < 9.0 ? vec3(0.5) : n < 10.0 ? vec3(0.9, \
                    0.4, 0.2) : n < 11.0 ? vec3(0.15, 0.35, 0.6) : vec3(0.03, 0.02, 0.05); fragColor = vec4(c, 1.0);";
/// The size of the chart.
const CHART_SIZE: (usize, usize) = (128, 72);
/// The size of the film with flashes.
const SIZE: (usize, usize) = (64, 36);

/// Returns the largest difference of a component of the decoded chart in the middle of a patch, and anywhere.
fn largest_differences(b: &Bench, film: &str, frames: usize) -> (u8, u8) {
    largest_differences_with(b, film, frames, "")
}

fn largest_differences_with(b: &Bench, film: &str, frames: usize, matrix: &str) -> (u8, u8) {
    let reference = b.png("card.png").into_raw();
    let reference: Vec<u8> = reference.chunks_exact(4).flat_map(|p| [p[0], p[1], p[2]]).collect();
    let bytes = decoded_by(&b.path(film), matrix);
    let frame = CHART_SIZE.0 * CHART_SIZE.1 * 3;
    assert_eq!(bytes.len(), frame * frames, "{film}");
    let (mut middle, mut anywhere) = (0, 0);
    for (at, (got, expected)) in bytes.iter().zip(reference.iter().cycle()).enumerate() {
        let (x, y) = (at % frame / 3 % CHART_SIZE.0 % 32, at % frame / 3 / CHART_SIZE.0 % 24);
        let difference = got.abs_diff(*expected);
        anywhere = difference.max(anywhere);
        if (8..24).contains(&x) && (8..16).contains(&y) {
            middle = difference.max(middle);
        }
    }
    (middle, anywhere)
}

fn render_chart(b: &Bench) {
    b.image("card.glsl", CHART);
    b.line("render card.glsl --size 128x72 --no-project --out card.png").expect(0);
}

#[test]
fn every_codec_preserves_the_colours_of_a_chart() {
    let Some(b) = Bench::with_gpu().filter(|_| has_ffmpeg()) else { return };
    render_chart(&b);
    // With 4:4:4 chroma anywhere in the picture; otherwise where a patch is uniform within the codec's filters.
    let films = [
        ("h264.mp4", "", 2, 255),
        ("h264_full.mp4", "--range full", 2, 255),
        ("h264_444.mp4", "--chroma 444", 2, 12),
        ("h264_10.mkv", "--codec h264 --chroma 444 --depth 10", 2, 12),
        ("h265.mp4", "--codec h265", 2, 255),
        ("h265_444.mov", "--codec h265 --chroma 444 --depth 10", 2, 12),
        ("vp9.webm", "", 2, 255),
        ("vp9_444.webm", "--chroma 444 --range full", 2, 2),
        ("av1.webm", "--codec av1", 2, 255),
        ("av1_444.mp4", "--codec av1 --chroma 444", 2, 2),
        ("prores.mov", "", 2, 255),
        ("prores_444.mov", "--chroma 444", 2, 2),
    ];
    for (film, more, middle, anywhere) in films {
        let quality = if more.contains("--quality") { "" } else { "--quality high" };
        b.line(&format!("render card.glsl --size 128x72 --frames 2 --out {film} {more} {quality}")).expect(0);
        let differences = largest_differences(&b, film, 2);
        assert!(differences.0 <= middle && differences.1 <= anywhere, "{film}: {differences:?}");
    }
    for (film, more) in [
        ("lossless.mkv", ""),
        ("lossless.mov", "--codec ffv1"),
        ("lossless_h264.mp4", "--quality lossless"),
        ("lossless_h265.mkv", "--codec h265 --quality lossless"),
        ("lossless_vp9.webm", "--quality lossless"),
        ("lossless_av1.webm", "--codec av1 --quality lossless"),
        ("card.apng", ""),
        // Twelve colours fit into a palette.
        ("card.gif", "--fps 20"),
    ] {
        b.line(&format!("render card.glsl --size 128x72 --frames 2 --out {film} {more}")).expect(0);
        assert_eq!(largest_differences(&b, film, 2), (0, 0), "{film}");
    }
    b.line("render card.glsl --size 128x72 --frames 2 --out deep.mkv --depth 16").expect(0);
    assert_eq!(probed(&b.path("deep.mkv"))["streams"][0]["pix_fmt"], "gbrp16le");
    assert!(largest_differences(&b, "deep.mkv", 2).1 <= 1, "16 bits per component are rounded to 8");
    let names = b.names(".");
    assert!(!names.iter().any(|name| name.starts_with(".eddy")), "temporary files are removed: {names:?}");
}

#[test]
fn a_film_is_tagged_with_its_colours_and_its_frame_rate() {
    let Some(b) = Bench::with_gpu().filter(|_| has_ffmpeg()) else { return };
    b.image("card.glsl", CHART);
    b.line("render card.glsl --size 64x36 --frames 2 --out small.mp4 --codec av1").expect(0);
    for (film, more, codec, pixels, range, rate) in [
        ("a.mp4", "", "h264", "yuv420p", "tv", "60/1"),
        ("b.mp4", "--codec h265 --depth 10 --fps 29.97", "hevc", "yuv420p10le", "tv", "30000/1001"),
        ("c.webm", "--range full --fps 25", "vp9", "yuv420p", "pc", "25/1"),
        ("d.mp4", "--codec av1", "av1", "yuv420p", "tv", "60/1"),
        ("e.mov", "--fps 24", "prores", "yuv422p10le", "tv", "24/1"),
        ("f.mp4", "--range full", "h264", "yuvj420p", "pc", "60/1"),
    ] {
        b.line(&format!("render card.glsl --size 128x72 --frames 4 --out {film} {more}")).expect(0);
        let stream = &probed(&b.path(film))["streams"][0];
        assert_eq!((&stream["codec_name"], &stream["pix_fmt"]), (&codec.into(), &pixels.into()), "{film}");
        for tag in ["color_space", "color_transfer", "color_primaries"] {
            assert_eq!(stream[tag], "bt709", "{film}: {tag}");
        }
        assert_eq!((&stream["color_range"], &stream["avg_frame_rate"]), (&range.into(), &rate.into()), "{film}");
    }
    // Every third frame, at a third of the rate.
    b.line("render card.glsl --size 128x72 --frames 0-29:3 --out g.mp4").expect(0);
    let stream = &probed(&b.path("g.mp4"))["streams"][0];
    assert_eq!((&stream["avg_frame_rate"], &stream["nb_frames"]), (&"20/1".into(), &"10".into()));
}

/// A white picture, and a click of 1 ms, in the first tenth and at the start of each second.
fn write_flashing_project(b: &Bench) {
    b.image("flash/image.glsl", "fragColor = vec4(vec3(fract(iTime + 0.001) < 0.1 ? 1.0 : 0.0), 1.0);");
    b.write("flash/sound.glsl", "vec2 mainSound(int samp, float time) { return vec2(samp % 44100 < 44 ? 0.9 : 0.0); }");
}

/// Returns the frames of a film of 64x36 pixels at which the brightness rises.
fn flashes(film: &[u8]) -> Vec<usize> {
    let levels: Vec<u8> = film.chunks_exact(SIZE.0 * SIZE.1 * 3).map(|frame| frame[frame.len() / 2]).collect();
    (0..levels.len()).filter(|&n| levels[n] > 128 && (n == 0 || levels[n - 1] <= 128)).collect()
}

/// Returns the samples at which the sound gets loud after a tenth of a second of silence.
fn clicks(sound: &[i16]) -> Vec<usize> {
    let mut last: Option<usize> = None;
    let mut found = Vec::new();
    for (n, sample) in sound.iter().enumerate() {
        if sample.unsigned_abs() > 6_000 {
            if last.is_none_or(|last| n - last > 4_410) {
                found.push(n);
            }
            last = Some(n);
        }
    }
    found
}

#[test]
fn picture_and_sound_stay_in_sync_to_the_end() {
    let Some(b) = Bench::with_gpu().filter(|_| has_ffmpeg()) else { return };
    write_flashing_project(&b);
    for film in ["a.mp4", "a.webm", "a.mov"] {
        b.line(&format!("render flash --size 64x36 --frames 600 --out {film}")).expect(0);
        let info = probed(&b.path(film));
        let streams = info["streams"].as_array().unwrap();
        let stream_of = |kind: &str| streams.iter().find(|s| s["codec_type"] == kind).unwrap();
        let (video, audio) = (stream_of("video"), stream_of("audio"));
        let number = |value: &serde_json::Value| value.as_str().and_then(|text| text.parse::<f64>().ok());
        for stream in [video, audio] {
            let start = number(&stream["start_time"]).unwrap();
            assert!(start.abs() < 1.0 / 60.0, "{film}: {start}");
        }
        let seconds = number(&info["format"]["duration"]).unwrap();
        assert!((seconds - 10.0).abs() < 1.0 / 60.0 + 0.01, "{film}: {seconds} s");
        let bytes = decoded(&b.path(film));
        assert_eq!(bytes.len(), SIZE.0 * SIZE.1 * 3 * 600, "{film}");
        let flashes = flashes(&bytes);
        assert_eq!(flashes, (0..10).map(|second| second * 60).collect::<Vec<_>>(), "{film}");
        let sound = decoded_sound(&b.path(film));
        let missing = sound.len().abs_diff(441_000);
        assert!(missing <= 44_100 / 60, "{film}: {} samples", sound.len());
        let clicks = clicks(&sound);
        assert_eq!(clicks.len(), 10, "{film}: {clicks:?}");
        for (second, click) in clicks.iter().enumerate() {
            let offset = (*click as f64 / 44_100.0 - second as f64).abs();
            assert!(offset < 1.0 / 60.0, "{film}: click {second} is {offset} s from its flash");
        }
    }
}

#[test]
fn a_range_has_the_sound_of_its_time_and_sound_can_be_disabled() {
    let Some(b) = Bench::with_gpu().filter(|_| has_ffmpeg()) else { return };
    write_flashing_project(&b);
    b.line("render flash --size 64x36 --frames 90-149 --out a.mov").expect(0);
    let sound = decoded_sound(&b.path("a.mov"));
    assert_eq!(sound.len(), 44_100);
    assert_eq!(clicks(&sound), [22_050], "second 2 is half a second after frame 90");
    assert_eq!(flashes(&decoded(&b.path("a.mov"))), [30]);
    b.line("render flash --size 64x36 --frames 60 --out b.mov --no-audio").expect(0);
    assert_eq!(probed(&b.path("b.mov"))["streams"].as_array().unwrap().len(), 1);
    // Music of a channel is part of the sound, too.
    b.write("music/eddy.toml", "[passes.image]\nchannels.0 = { file = \"a.wav\", kind = \"music\" }\n");
    b.image("music/image.glsl", "fragColor = texture(iChannel0, vec2(0.1, 0.2));");
    b.line("render flash --pass sound --secs 1.5 --out music/a.wav").expect(0);
    b.line("render music --size 64x36 --frames 180 --out c.mov").expect(0);
    assert_eq!(clicks(&decoded_sound(&b.path("c.mov"))), [0, 44_100, 66_150, 110_250], "the music loops every 1.5 s");
}

/// Writes a recording of frames at these times, in which a slider moves before frame 100.
fn record(b: &Bench, name: &str, times: impl IntoIterator<Item = f64>) {
    let frame = |(n, time_secs): (usize, f64)| {
        let inputs = FrameInputs { time_secs, ..FrameInputs::at_fixed_step(n as i32, 60.0) };
        let level = (n >= 100).then(|| ("level".to_owned(), CustomUniformValue::Float(0.4)));
        RecordedFrame { inputs, size: (64, 36), values: level.into_iter().collect(), reset: false }
    };
    let recording = Recording { project: "flash".into(), frames: times.into_iter().enumerate().map(frame).collect() };
    let mut bytes = Vec::new();
    recording.write(&mut bytes).unwrap();
    b.write(name, bytes);
}

#[test]
fn a_film_of_a_recording_has_the_sound_of_its_times() {
    let Some(b) = Bench::with_gpu().filter(|_| has_ffmpeg()) else { return };
    write_flashing_project(&b);
    let level = "#iUniform float level = 0.9 in { 0.0, 1.0 }\n";
    let click = "vec2 mainSound(int samp, float time) { return vec2(samp % 44100 < 44 ? level : 0.0); }";
    b.write("flash/sound.glsl", format!("{level}{click}"));
    // A second from 0.5 s on, half a second in which time is paused, and a second from 2.75 s on.
    let step = |n: i32| f64::from(n) / 60.0;
    let first = (0..60).map(|n| 0.5 + step(n)).chain([0.5 + step(59); 30]);
    record(&b, "jumps.replay", first.chain((0..60).map(|n| 2.75 + step(n))));
    b.line("render flash --replay jumps.replay --out a.mov").expect(0);
    let sound = decoded_sound(&b.path("a.mov"));
    assert_eq!(sound.len(), 110_250);
    assert_eq!(clicks(&sound), [22_050, 77_175], "seconds 1 and 3");
    assert_eq!(flashes(&decoded(&b.path("a.mov"))), [30, 105]);
    let levels = [22_060, 77_185].map(|n| f64::from(sound[n]) / 32_768.0);
    assert!((levels[0] - 0.9).abs() < 1e-3 && (levels[1] - 0.4).abs() < 1e-3, "{levels:?}");
    assert!(sound[45_000..66_000].iter().all(|sample| *sample == 0), "time is paused");
    // A range of the recording, with a step.
    b.line("render flash --replay jumps.replay --frames 96-148:2 --out b.mov").expect(0);
    assert_eq!(clicks(&decoded_sound(&b.path("b.mov"))), [(105 - 96) * 735]);
    // A recording at 120 frames per second is played slower at the default rate, and at its own speed with
    // `--fps 120`.
    record(&b, "fast.replay", (0..90).map(|n| 0.5 + f64::from(n) / 120.0));
    let slow = b.line("render flash --replay fast.replay --out c.mov").expect(0);
    assert!((slow.out + &slow.err).contains("0.50 times the recorded speed; --fps 120 plays"));
    let [click] = clicks(&decoded_sound(&b.path("c.mov")))[..] else { panic!("one click") };
    assert!(click.abs_diff(44_100) < 735, "{click}: half a second of the recording plays for one second");
    let same_rate = b.line("render flash --replay fast.replay --fps 120 --out d.mov").expect(0);
    assert!(!(same_rate.out + &same_rate.err).contains("recorded speed"));
    assert_eq!(clicks(&decoded_sound(&b.path("d.mov"))), [22_050]);
    b.line("render flash --replay fast.replay --no-audio --out e.mov").expect(0);
    assert_eq!(probed(&b.path("e.mov"))["streams"].as_array().unwrap().len(), 1);
}

#[test]
fn frames_can_be_piped() {
    let Some(b) = Bench::with_gpu() else { return };
    render_chart(&b);
    let piped = |args: &str| {
        let output = b.command().args(args.split(' ')).output().unwrap();
        assert_eq!(output.status.code(), Some(0), "{args}: {}", String::from_utf8_lossy(&output.stderr));
        (output.stdout, String::from_utf8(output.stderr).unwrap())
    };
    let (bytes, messages) = piped("render card.glsl --size 128x72 --frames 3 --out - --format raw");
    assert_eq!(bytes, b.png("card.png").into_raw().repeat(3));
    assert!(messages.contains("3 frames"), "{messages}");
    let (bytes, _) = piped("render card.glsl --size 128x72 --frames 3 --out - --chroma 444");
    assert!(bytes.starts_with(b"YUV4MPEG2 W128 H72 F60:1 Ip A1:1 C444 "));
    b.write("a.y4m", &bytes);
    let (bytes, _) = piped("render card.glsl --size 128x72 --at 0-1 --out - --format png");
    assert_eq!(bytes, b.bytes("card.png").repeat(2));
    if has_ffmpeg() {
        // The format does not store the matrix, so it is set here.
        assert!(largest_differences_with(&b, "a.y4m", 3, "in_color_matrix=bt709:").1 <= 2);
    }
    // A reader that closes the pipe early is not an error.
    #[cfg(target_os = "linux")]
    {
        let eddy = env!("CARGO_BIN_EXE_eddy");
        let line = format!("{eddy} render card.glsl --size 640x360 --frames 200 --out - --format raw | head -c 100");
        let script = format!("{{ {line}; }} >short; echo ${{PIPESTATUS[0]}}");
        let mut command = std::process::Command::new("bash");
        let run = run(command.args(["-c", &script]).current_dir(b.path(".")));
        assert_eq!((run.out.trim(), run.err.as_str()), ("0", ""));
        assert_eq!(b.bytes("short").len(), 100);
    }
}

#[test]
fn vp9_and_av1_films_can_have_odd_sizes() {
    let Some(b) = Bench::with_gpu().filter(|_| has_ffmpeg()) else { return };
    b.image("plain.glsl", "fragColor = vec4(0.25, 0.5, 0.75, 1.0);");
    for (name, more, [width, height]) in [
        ("a.webm", "", [161, 91]),
        ("b.webm", "--codec av1", [161, 91]),
        ("c.mp4", "--codec av1 --depth 10", [67, 128]),
        ("d.webm", "--chroma 444", [63, 35]),
        ("e.webm", "", [1, 1]),
    ] {
        b.line(&format!("render plain.glsl --size {width}x{height} --frames 2 --out {name} {more}")).expect(0);
        let stream = &probed(&b.path(name))["streams"][0];
        assert_eq!((&stream["width"], &stream["height"]), (&width.into(), &height.into()), "{name}");
        let bytes = decoded_by(&b.path(name), "");
        assert_eq!(bytes.len(), 2 * 3 * width * height, "{name}");
        // The last column and row have their own chroma sample.
        let difference =
            bytes.chunks_exact(3).map(|p| p[0].abs_diff(64).max(p[1].abs_diff(128)).max(p[2].abs_diff(191))).max();
        assert!(difference <= Some(3), "{name}: {difference:?}");
    }
    b.line("render plain.glsl --size 161x91 --frames 3 --out a.gif").expect(0);
    let stream = &probed(&b.path("a.gif"))["streams"][0];
    assert_eq!((&stream["avg_frame_rate"], &stream["width"]), (&"50/1".into(), &161.into()));
    let line = "render plain.glsl --frames 3 --out a.gif --json";
    assert!(b.line(line).expect(0).out.contains("a GIF has at most 50 frames per second"));
    // The size is rejected before the project is read.
    let odd_size = b.line("render nothing-here.glsl --size 161x91 --frames 3 --out a.mp4").expect(2);
    assert!(odd_size.err.contains("even width and height, not 161x91"), "{}", odd_size.err);
    let small = b.line("render nothing-here.glsl --size 128x2 --frames 3 --out a.mkv --codec h265").expect(2);
    assert!(small.err.contains("at least 16 pixels each way, not 128x2"), "{}", small.err);
}

#[test]
fn ffmpeg_errors_are_reported_before_drawing_and_leave_no_files() {
    let Some(b) = Bench::with_gpu() else { return };
    render_chart(&b);
    let mut command = b.command();
    command.args("render card.glsl --size 128x72 --frames 3 --out a.mp4".split(' ')).env("PATH", b.path("nothing"));
    let missing = run(&mut command).expect(2);
    assert!(missing.err.contains("install") && missing.err.contains("ffmpeg"), "{}", missing.err);
    b.line("render card.glsl --size 128x72 --frames 3 --out a.apng").expect(0);
    if !has_ffmpeg() {
        return;
    }
    let odd_size = b.line("render card.glsl --size 63x36 --frames 3 --out a.mp4").expect(2);
    assert!(odd_size.err.contains("even width") && odd_size.err.contains("63x36"), "{}", odd_size.err);
    b.line("render card.glsl --size 63x35 --frames 3 --out odd.mp4 --chroma 444").expect(0);
    // A compile error leaves the existing film unchanged.
    b.write("a.mp4", "mine");
    b.image("bad.glsl", "fragColor = nothing;");
    b.line("render bad.glsl --size 64x36 --frames 3 --out a.mp4").expect(1);
    assert_eq!(b.bytes("a.mp4"), b"mine");
    let names = b.names(".");
    assert!(!names.iter().any(|name| name.starts_with(".eddy")), "{names:?}");
    // Names that look like options or addresses are file names.
    for name in ["-i.mp4", "http:..x.mp4", "a%d.mp4", "it's & a b.mp4"] {
        let out = format!("--out={name}");
        b.eddy("render card.glsl --size 128x72 --frames 2".split(' ').chain([out.as_str()])).expect(0);
        assert!(fs::metadata(b.path(name)).unwrap().len() > 100, "{name}");
    }
    // Repeating a call writes the same bytes.
    for film in ["x.mp4", "x.webm", "x.mkv"] {
        b.line(&format!("render card.glsl --size 64x36 --frames 3 --out {film}")).expect(0);
        let first = b.bytes(film);
        b.line(&format!("render card.glsl --size 64x36 --frames 3 --out {film}")).expect(0);
        assert!(b.bytes(film) == first, "{film} differs");
    }
}

#[test]
fn an_exr_has_the_floats_of_the_pass() {
    let Some(b) = Bench::with_gpu() else { return };
    b.write(
        "p/eddy.toml",
        "[passes.buffer_a]\nformat = \"rgba16f\"\n[passes.image]\nchannels.0 = { buffer = \"A\" }\n",
    );
    b.image("p/buffer_a.glsl", "fragColor = vec4(fragCoord.x / 3.0, -fragCoord.y, 1e-7, 60000.0);");
    b.image("p/image.glsl", "fragColor = texelFetch(iChannel0, ivec2(fragCoord), 0) * vec4(1.0 / 3.0, 7.0, 1.0, 1e6);");
    for pass in ["image", "buffer_a"] {
        b.line(&format!("render p --size 8x4 --pass {pass} --out a.exr")).expect(0);
        b.line(&format!("render p --size 8x4 --pass {pass} --out a.npy")).expect(0);
        let (exr, npy) = (image::open(b.path("a.exr")).unwrap().into_rgba32f(), b.npy("a.npy"));
        for (x, y, pixel) in exr.enumerate_pixels() {
            assert_eq!(pixel.0, npy.at(x as usize, 3 - y as usize), "{pass} {x},{y}");
        }
    }
    b.line("render p --size 8x4 --out a.png --depth 16").expect(0);
    assert_eq!(image::open(b.path("a.png")).unwrap().color(), image::ColorType::Rgba16);
}

/// The OpenEXR tools read the files that Eddy writes.
#[test]
#[ignore = "needs exrheader and exrmaketiled of the package openexr"]
fn openexr_tools_read_an_exr() {
    let Some(b) = Bench::with_gpu() else { return };
    render_chart(&b);
    b.line("render card.glsl --size 128x72 --out a.exr").expect(0);
    let header = run(std::process::Command::new("exrheader").arg(b.path("a.exr"))).expect(0).out;
    for expected in ["R, 32-bit floating-point", "A, 32-bit floating-point", "zip, multi-scanline", "(127 71)"] {
        assert!(header.contains(expected), "{expected} in {header}");
    }
    // Read and rewritten in tiles by the library itself.
    let mut tiled = std::process::Command::new("exrmaketiled");
    run(tiled.args([b.path("a.exr"), b.path("tiled.exr")])).expect(0);
    let floats = |name: &str| image::open(b.path(name)).unwrap().into_rgba32f();
    assert_eq!(floats("tiled.exr"), floats("a.exr"));
}

#[test]
fn supersampling_and_shutter_average_samples_of_pixels_and_time() {
    let Some(b) = Bench::with_gpu() else { return };
    b.image("a.glsl", "fragColor = vec4(floor(fragCoord), iResolution.x + iMouse.x, 1.0);");
    let line = "render a.glsl --size 4x2 --out a.npy --mouse";
    b.eddy(line.split(' ').chain(["0:down 3,1", "--supersample", "3"])).expect(0);
    let npy = b.npy("a.npy");
    assert_eq!((npy.width, npy.height), (4, 2));
    // Columns 6, 7 and 8, and rows 3, 4 and 5, of a picture of 12x6.
    assert_eq!(npy.at(2, 1), [7.0, 4.0, 12.0 + 9.0, 1.0]);
    b.image("t.glsl", "fragColor = vec4(iTime, float(iFrame), fract(iTime * 60.0 + 0.001) < 0.2 ? 1.0 : 0.0, 1.0);");
    b.line("render t.glsl --size 2x2 --frames 30-30 --shutter 0.5 --samples 4 --format npy --out t").expect(0);
    let [time, frame, lit, _] = b.npy("t/t_0030.npy").at(0, 0);
    // Times 1/16, 3/16, 5/16 and 7/16 of a frame after 0.5 s.
    assert!((time - (0.5 + 0.25 / 60.0)).abs() < 1e-6, "{time}");
    assert_eq!((frame, lit), (30.0, 0.5));
    b.image("s/buffer_a.glsl", "fragColor = texelFetch(iChannel0, ivec2(fragCoord), 0) + 1.0;");
    b.image("s/image.glsl", "fragColor = texelFetch(iChannel0, ivec2(fragCoord), 0);");
    let rejected = b.line("render s --size 2x2 --frames 2 --shutter 0.5 --out s.png").expect(2);
    assert!(rejected.err.contains("Buffer A") && rejected.err.contains("state"), "{}", rejected.err);
}

#[test]
fn a_loop_blends_its_start_with_the_frames_after_its_end() {
    let Some(b) = Bench::with_gpu() else { return };
    // Without state, and with state.
    b.image("t.glsl", "fragColor = vec4(float(iFrame) / 100.0, 0.2, 0.3, 1.0);");
    b.image("s/buffer_a.glsl", "fragColor = texelFetch(iChannel0, ivec2(fragCoord), 0) + 0.01;");
    b.image("s/image.glsl", "fragColor = vec4(texelFetch(iChannel0, ivec2(fragCoord), 0).x - 0.01, 0.2, 0.3, 1.0);");
    for project in ["t.glsl", "s"] {
        for (frames, numbers) in [("12", (0..12).collect::<Vec<i32>>()), ("10-33:2", (10..34).step_by(2).collect())] {
            let rate = if frames == "12" { 4.0 } else { 8.0 };
            let args = format!(
                "render {project} --size 4x2 --fps {rate} --frames {frames} --loop 1 --format raw --depth 16 --out x.raw"
            );
            let run = b.line(&args).expect(0);
            assert!(run.err.contains("no visible seam"), "{}", run.err);
            let bytes = b.bytes("x.raw");
            let reds: Vec<f64> = bytes
                .chunks_exact(4 * 2 * 8)
                .map(|frame| f64::from(u16::from_le_bytes([frame[0], frame[1]])) / 65_535.0)
                .collect();
            assert_eq!(reds.len(), 12);
            let length = numbers[11] - numbers[0] + numbers[1] - numbers[0];
            for (n, (red, number)) in reds.iter().zip(&numbers).enumerate() {
                let blend = (n as f64 / 4.0).min(1.0);
                let expected = (f64::from(number + length) * (1.0 - blend) + f64::from(*number) * blend) / 100.0;
                assert!((red - expected).abs() < 2e-5, "{project} {frames} {n}: {red}, not {expected}");
            }
        }
    }
    let jump = b.line("render t.glsl --size 4x2 --frames 60 --loop 0 --out x.apng").expect(0);
    assert!(jump.err.contains("jumps where it begins again"), "{}", jump.err);
    // A film of whole periods is not changed.
    b.write("s/eddy.toml", "period = 3\n[passes.buffer_a]\nchannels.0 = { buffer = \"A\" }\n[passes.image]\nchannels.0 = { buffer = \"A\" }\n");
    let film = |b: &Bench, more: &str| {
        let line = b.line(&format!("render s --size 4x2 --fps 4 {more} --format raw --out x.raw")).expect(0);
        (b.bytes("x.raw"), line.err)
    };
    for frames in [12, 24] {
        let (faded, messages) = film(&b, &format!("--frames {frames} --loop 1"));
        assert!(
            faded == film(&b, &format!("--frames {frames}")).0 && messages.contains("nothing is faded"),
            "{messages}"
        );
    }
    let (faded, messages) = film(&b, "--frames 13 --loop 1");
    assert!(faded != film(&b, "--frames 13").0 && messages.contains("a film of 12 frames"), "{messages}");
    let long = b.line("render t.glsl --size 4x2 --frames 60 --loop 2 --out x.apng").expect(2);
    assert!(long.err.contains("1.00 s long"), "{}", long.err);
}
