//! Videos and webcams as textures, with the built program: frames by `iTime`, the same in every run, and errors of
//! those that cannot be played. Files are generated here; tests that need ffmpeg are skipped if it is not installed.

use crate::support::{
    ffmpeg::has_ffmpeg,
    gpu,
    program::{Bench, Npy, run},
};
use image::{
    Delay, Frame, Rgba, RgbaImage,
    codecs::gif::{GifEncoder, Repeat},
};
use std::{
    path::Path,
    process::{Command, Stdio},
    time::{Duration, Instant},
};

/// Returns a colour that encodes a frame's number; the top half has it in blue, too.
fn color(n: u32, is_top: bool) -> Rgba<u8> {
    let value = (n * 8) as u8;
    Rgba([value, 255 - value, if is_top { value } else { 0 }, 255])
}

fn picture(n: u32) -> RgbaImage {
    RgbaImage::from_fn(16, 8, |_, y| color(n, y < 4))
}

/// Returns an animated GIF with these frame durations in milliseconds.
fn gif(delays: &[u32]) -> Vec<u8> {
    let mut bytes = Vec::new();
    let mut encoder = GifEncoder::new(&mut bytes);
    encoder.set_repeat(Repeat::Infinite).unwrap();
    for (n, delay) in delays.iter().enumerate() {
        let delay = Delay::from_numer_denom_ms(*delay, 1);
        encoder.encode_frame(Frame::from_parts(picture(n as u32), 0, 0, delay)).unwrap();
    }
    drop(encoder);
    bytes
}

/// Encodes frames losslessly.
fn encode(path: &Path, frames: u32, rate: u32) {
    use std::io::Write;
    std::fs::create_dir_all(path.parent().unwrap()).unwrap();
    let rate = rate.to_string();
    let mut child = Command::new("ffmpeg")
        .args(["-v", "error", "-y", "-f", "rawvideo", "-pix_fmt", "rgba", "-s", "16x8", "-r", &rate, "-i", "pipe:0"])
        .args(["-c:v", "ffv1", "-pix_fmt", "bgra"])
        .arg(path)
        .stdin(Stdio::piped())
        .spawn()
        .unwrap();
    let mut pipe = child.stdin.take().unwrap();
    (0..frames).for_each(|n| pipe.write_all(&picture(n)).unwrap());
    drop(pipe);
    assert!(child.wait().unwrap().success());
}

/// Writes a project whose Image shows the texture texel by texel, and the uniforms above it.
fn project(b: &Bench, channel: &str) {
    b.write("p/eddy.toml", format!("[passes.image]\nchannels.0 = {channel}\n"));
    b.image(
        "p/image.glsl",
        "fragColor = fragCoord.y < 8. ? texelFetch(iChannel0, ivec2(fragCoord), 0) : \
         vec4(iChannelTime[0], iChannelResolution[0]);",
    );
}

fn texels(b: &Bench, more: &str) -> Npy {
    b.line(&format!("render p --size 16x9 {more} --out p.npy")).expect(0);
    b.npy("p.npy")
}

/// Returns the number of the shown frame, and checks that its top row is at the top.
fn number(shown: &Npy) -> u32 {
    let bytes = |at: [f32; 4]| at.map(|v| (v * 255.0).round() as u8);
    let (bottom, top) = (bytes(shown.at(3, 1)), bytes(shown.at(3, 6)));
    assert_eq!((bottom[2], top[2]), (0, top[0]), "which way up: {bottom:?} {top:?}");
    u32::from(top[0]) / 8
}

#[test]
fn a_video_frame_depends_only_on_time() {
    let Some(_) = gpu() else { return };
    if !has_ffmpeg() {
        return;
    }
    let b = Bench::new();
    encode(&b.path("p/clip.mkv"), 24, 24);
    project(&b, "{ file = \"clip.mkv\", kind = \"video\" }");
    for (fps, frame, wanted) in
        [(24, 0, 0), (24, 7, 7), (24, 23, 23), (24, 24, 0), (24, 55, 7), (60, 20, 8), (60, 19, 7)]
    {
        let shown = texels(&b, &format!("--fps {fps} --at {frame}"));
        assert_eq!(number(&shown), wanted, "frame {frame} at {fps}");
        let [time, resolution @ ..] = shown.at(5, 8);
        assert_eq!(resolution, [16.0, 8.0, 1.0]);
        let position = (f64::from(frame) / f64::from(fps)) % 1.0;
        assert!((f64::from(time) - position).abs() < 1e-5, "frame {frame} at {fps}: {time}");
    }
    // In a run, alone, and without skipping: the same bytes.
    b.line("render p --size 16x9 --fps 30 --frames 50 --at 10,49 --format npy --out run").expect(0);
    b.line("render p --size 16x9 --fps 30 --frames 50 --at 10,49 --no-skip --format npy --out again").expect(0);
    for (name, frame) in [("p_0010.npy", 10), ("p_0049.npy", 49)] {
        b.line(&format!("render p --size 16x9 --fps 30 --at {frame} --out alone.npy")).expect(0);
        assert_eq!(b.bytes(&format!("run/{name}")), b.bytes("alone.npy"), "{name}");
        assert_eq!(b.bytes(&format!("again/{name}")), b.bytes("alone.npy"), "{name}");
    }
}

#[test]
fn channel_lines_open_videos_by_extension_or_type_and_can_flip_them() {
    let Some(_) = gpu() else { return };
    if !has_ffmpeg() {
        return;
    }
    let b = Bench::new();
    encode(&b.path("p/clip.mkv"), 4, 4);
    std::fs::rename(b.path("p/clip.mkv"), b.path("p/clip.mov")).unwrap();
    b.write("p/still.gif", gif(&[500, 500]));
    b.write(
        "p/image.glsl",
        "#iChannel0 \"clip.mov\"\n#iChannel0::VFlip \"false\"\n#iChannel1 \"still.gif\"\n#iChannel2 \"still.gif\"\n\
         #iChannel2::Type \"Video\"\nvoid mainImage(out vec4 o, vec2 p) { o = p.x < 1. ? texelFetch(iChannel0, ivec2(0, 7), 0) : \
         p.x < 2. ? texelFetch(iChannel1, ivec2(0), 0) : texelFetch(iChannel2, ivec2(0), 0); }",
    );
    b.line("render p --size 3x1 --fps 4 --at 2 --out p.png").expect(0);
    let png = b.png("p.png");
    assert_eq!(png.get_pixel(0, 0), &color(2, false), "without a flip, row 7 is the bottom row");
    assert_eq!(png.get_pixel(1, 0), &color(0, false), "a GIF without a type is an image");
    assert_eq!(png.get_pixel(2, 0), &color(1, false), "with the type Video it plays");
}

#[test]
fn animated_images_and_sequences_play_without_ffmpeg() {
    let Some(_) = gpu() else { return };
    let b = Bench::new();
    b.write("p/a.gif", gif(&[100, 300, 50, 50]));
    for n in 0..5 {
        let mut png = std::io::Cursor::new(Vec::new());
        picture(n).write_to(&mut png, image::ImageFormat::Png).unwrap();
        b.write(&format!("p/walk-5fps/{n:02}.png"), png.into_inner());
    }
    let shown = |channel: &str, frame: u32| {
        project(&b, channel);
        let mut command = b.command();
        let args = format!("render p --size 16x9 --fps 100 --at {frame} --out p.npy");
        let ran = run(command.args(args.split(' ')).env("PATH", "")).expect(0);
        assert_eq!(ran.err, "", "{channel}");
        number(&b.npy("p.npy"))
    };
    for (frame, wanted) in [(0, 0), (9, 0), (10, 1), (39, 1), (40, 2), (45, 3), (49, 3), (50, 0), (60, 1)] {
        assert_eq!(shown("{ file = \"a.gif\", kind = \"video\" }", frame), wanted, "frame {frame}");
    }
    for (frame, wanted) in [(0, 0), (19, 0), (20, 1), (99, 4), (100, 0)] {
        assert_eq!(shown("{ file = \"walk-5fps/00.png\", kind = \"video\" }", frame), wanted, "frame {frame}");
    }
}

#[test]
fn unplayable_videos_are_black_and_reported() {
    let Some(_) = gpu() else { return };
    let b = Bench::new();
    b.write("p/clip.mp4", "not a video at all");
    std::fs::write(b.path("outside.mp4"), "x").unwrap();
    #[cfg(unix)]
    std::os::unix::fs::symlink(b.path("outside.mp4"), b.path("p/link.mp4")).unwrap();
    let errors_of = |name: &str, path: Option<&str>| {
        project(&b, &format!("{{ file = '{name}', kind = \"video\" }}"));
        let mut command = b.command();
        command.args("render p --size 16x9 --out p.npy".split(' '));
        path.map(|path| command.env("PATH", path));
        let ran = run(&mut command).expect(0);
        let shown = b.npy("p.npy");
        assert_eq!([shown.at(0, 0), shown.at(0, 8)], [[0.0, 0.0, 0.0, 1.0]; 2], "{name}");
        ran.err
    };
    let missing = errors_of("clip.mp4", Some(""));
    assert!(missing.contains("ffprobe is not installed") && missing.contains("install ffmpeg"), "{missing}");
    for (name, words) in [
        ("-i", "there is no such file"),
        ("-", "there is no such file"),
        ("http://x/y.mp4", "there is no such file"),
        ("concat:a|b", "there is no such file"),
        ("a%03d.png", "there is no such file"),
        ("file:/etc/passwd", "there is no such file"),
        ("/etc/passwd", "leads out of the project's folder"),
        ("../outside.mp4", "leads out of the project's folder"),
        ("gone.mp4", "there is no such file"),
    ] {
        let errors = errors_of(name, None);
        assert!(errors.contains(words), "{name}: {errors}");
    }
    #[cfg(unix)]
    assert!(errors_of("link.mp4", None).contains("is a link that leads out"), "a link");
    if has_ffmpeg() {
        let damaged = errors_of("clip.mp4", None);
        assert!(damaged.contains("the video is damaged") && damaged.contains("ffmpeg -i FILE"), "{damaged}");
    }
}

#[cfg(unix)]
#[test]
fn a_hanging_ffmpeg_is_killed_after_a_timeout() {
    use std::os::unix::fs::PermissionsExt;
    let Some(_) = gpu() else { return };
    let b = Bench::new();
    b.write("p/clip.mp4", "anything");
    for name in ["ffmpeg", "ffprobe"] {
        b.write(&format!("bin/{name}"), "#!/bin/sh\nexec /bin/sleep 600\n");
        std::fs::set_permissions(b.path(format!("bin/{name}")), std::fs::Permissions::from_mode(0o755)).unwrap();
    }
    project(&b, "{ file = \"clip.mp4\", kind = \"video\" }");
    let start = Instant::now();
    let mut command = b.command();
    command.args("render p --size 16x9 --out p.npy".split(' ')).env("PATH", b.path("bin"));
    let ran = run(&mut command).expect(0);
    assert!(ran.err.contains("ffprobe gave no answer for 10 s"), "{}", ran.err);
    assert!(start.elapsed() < Duration::from_secs(60), "{:?}", start.elapsed());
}

#[test]
fn a_webcam_is_black_without_the_webcam_option() {
    let Some(_) = gpu() else { return };
    let b = Bench::new();
    project(&b, "{ webcam = true }");
    let run = b.line("render p --size 16x9 --fps 10 --at 5 --out p.npy").expect(0);
    assert!(run.err.contains("no camera is on") && run.err.contains("--webcam"), "{}", run.err);
    let shown = b.npy("p.npy");
    assert_eq!((shown.at(2, 2), shown.at(2, 8)), ([0.0, 0.0, 0.0, 1.0], [0.0, 320.0, 240.0, 1.0]));
    if !has_ffmpeg() {
        return;
    }
    let shown = texels(&b, "--fps 10 --at 5 --webcam lavfi:color=red:s=24x10:r=30");
    assert_eq!(shown.at(2, 8), [0.0, 24.0, 10.0, 1.0]);
    let red = shown.at(2, 2);
    assert!(red[0] > 0.9 && red[1] < 0.1, "{red:?}");
    let run = b.line("render p --size 16x9 --webcam /dev/video-of-nobody --out p.npy").expect(0);
    assert!(run.err.contains("--webcam /dev/video-of-nobody: the camera gives no pictures"), "{}", run.err);
}

#[test]
fn mip_levels_of_a_video_follow_its_frames() {
    let Some(_) = gpu() else { return };
    let b = Bench::new();
    b.write("p/a.gif", gif(&[100, 100, 100]));
    b.write(
        "p/eddy.toml",
        "[passes.image]\nchannels.0 = { file = \"a.gif\", kind = \"video\", filter = \"mipmap\" }\n",
    );
    b.image("p/image.glsl", "fragColor = textureLod(iChannel0, vec2(0.5), 4.0);");
    for frame in 0..3_u32 {
        b.line(&format!("render p --size 1x1 --fps 10 --at {frame} --out p.npy")).expect(0);
        let [red, green, blue, _] = b.npy("p.npy").at(0, 0).map(|v| v * 255.0);
        let value = (frame * 8) as f32;
        assert!((red - value).abs() < 1.5 && (green - (255.0 - value)).abs() < 1.5, "{frame}: {red} {green}");
        assert!((blue - value / 2.0).abs() < 1.5, "{frame}: {blue}");
    }
}
