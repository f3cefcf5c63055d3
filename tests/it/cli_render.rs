//! `eddy render` and `eddy bench`, tested with the built program on whatever device the machine has.

use crate::support::{
    gpu,
    program::{Bench, run},
};

/// The coordinates as red and green, and the frame as blue: every pixel of every frame is different.
const PLACE: &str = "fragColor = vec4(fragCoord / iResolution.xy, float(iFrame) / 16.0, 1.0);";
/// Counts frames in a buffer.
const COUNT: &str = "fragColor = texelFetch(iChannel0, ivec2(fragCoord), 0) + vec4(1.0, 0.5, fragCoord);";

fn write_counting_project(b: &Bench) {
    b.image("count/buffer_a.glsl", COUNT);
    b.image("count/image.glsl", "fragColor = texelFetch(iChannel0, ivec2(fragCoord), 0) / 16.0;");
}

#[test]
fn the_bottom_row_is_row_0_of_npy_and_the_last_of_png() {
    let Some(b) = Bench::with_gpu() else { return };
    b.image("place.glsl", PLACE);
    b.line("render place.glsl --size 8x4 --out place.npy").expect(0);
    let npy = b.npy("place.npy");
    assert_eq!((npy.width, npy.height), (8, 4));
    for (x, y) in [(0, 0), (7, 0), (3, 2), (0, 3)] {
        let expected = [(x as f32 + 0.5) / 8.0, (y as f32 + 0.5) / 4.0, 0.0, 1.0];
        assert!(npy.at(x, y).iter().zip(expected).all(|(a, b)| (a - b).abs() < 1e-6), "{x},{y}: {:?}", npy.at(x, y));
    }
    b.line("render place.glsl --size 8x4 --out place.png").expect(0);
    let png = b.png("place.png");
    assert_eq!(png.dimensions(), (8, 4));
    assert_eq!(png.get_pixel(7, 3).0, [239, 32, 0, 255], "bottom right");
    assert_eq!(png.get_pixel(0, 0).0, [16, 223, 0, 255], "top left");
}

#[test]
fn the_frames_of_at_are_written() {
    let Some(b) = Bench::with_gpu() else { return };
    b.image("place.glsl", PLACE);
    let run = b.line("render place.glsl --size 4x4 --frames 9 --at 8,0,4 --out new/o --json").expect(0);
    assert_eq!(run.json()[0]["frames"], 9);
    assert_eq!(b.names("new/o"), ["place_0000.png", "place_0004.png", "place_0008.png"]);
    for frame in [0u8, 4, 8] {
        let blue = b.png(&format!("new/o/place_{frame:04}.png")).get_pixel(0, 0).0[2];
        assert_eq!(blue, (f32::from(frame) / 16.0 * 255.0 + 0.5) as u8);
    }
    b.line("render place.glsl --size 4x4 --at 4 --out one").expect(0);
    assert_eq!(b.names("one"), ["place.png"]);
    assert_eq!(b.bytes("one/place.png"), b.bytes("new/o/place_0004.png"));
}

#[test]
fn file_names_are_padded_so_that_they_sort_by_frame() {
    let Some(b) = Bench::with_gpu() else { return };
    b.image("place.glsl", PLACE);
    b.line("render place.glsl --size 1x1 --at 9,10001 --out o").expect(0);
    assert_eq!(b.names("o"), ["place_00009.png", "place_10001.png"]);
    b.line("render place.glsl --size 1x1 --at 9,10 --format npy --out few").expect(0);
    assert_eq!(b.names("few"), ["place_0009.npy", "place_0010.npy"]);
}

#[cfg(target_os = "linux")]
#[test]
fn standard_error_has_no_messages_of_libraries() {
    let Some(b) = Bench::with_gpu() else { return };
    b.image("place.glsl", PLACE);
    for runtime in [None, Some(""), Some("relative"), Some("/no/such/folder")] {
        for args in
            ["render place.glsl --size 4x4 --out a.png", "bench place.glsl --size 4x4", "check place.glsl", "list"]
        {
            let mut command = b.command();
            command.args(args.split(' ')).env_remove("WAYLAND_DISPLAY").env_remove("XDG_RUNTIME_DIR");
            command.envs(runtime.map(|r| ("XDG_RUNTIME_DIR", r)));
            let run = run(&mut command).expect(0);
            assert_eq!(run.err, "", "{args} with XDG_RUNTIME_DIR {runtime:?}");
        }
    }
}

#[test]
fn a_json_line_has_the_documented_members() {
    let Some(b) = Bench::with_gpu() else { return };
    b.image("place.glsl", PLACE);
    let line = b.line("render ./place.glsl --size 16x16 --frames 3 --json").expect(0).json().remove(0);
    let mut names: Vec<_> = line.as_object().unwrap().keys().cloned().collect();
    names.sort();
    assert_eq!(names, ["compile_ms", "diagnostics", "frame_ms", "frames", "project", "status"]);
    assert_eq!((&line["project"], &line["status"]), (&"./place.glsl".into(), &"ok".into()));
    assert!(line["compile_ms"].as_f64().unwrap() > 0.0 && line["frame_ms"].as_f64().unwrap() > 0.0, "{line}");
    assert_eq!(b.names("."), ["place.glsl"], "without --out nothing is written");
}

#[test]
fn a_bad_project_does_not_stop_the_others_of_a_call() {
    let Some(b) = Bench::with_gpu() else { return };
    b.image("one.glsl", PLACE);
    b.image("bad.glsl", "fragColor = nothing;");
    b.image("two.glsl", PLACE);
    write_counting_project(&b);
    let run = b.line("render one.glsl bad.glsl gone.glsl two.glsl count --size 4x4 --out o --json").expect(2);
    let status: Vec<_> = run.json().iter().map(|l| l["status"].as_str().unwrap().to_owned()).collect();
    assert_eq!(status, ["ok", "diagnostics", "error", "ok", "ok"]);
    assert_eq!(b.names("o"), ["count.png", "one.png", "two.png"]);
    let bad = &run.json()[1]["diagnostics"][0];
    assert_eq!((&bad["source"], &bad["line"]), (&"bad.glsl".into(), &2.into()));
    b.line("render one.glsl bad.glsl --size 4x4 --out o").expect(1);
}

#[test]
fn a_size_beyond_the_device_is_an_error_with_the_limit() {
    let Some(b) = Bench::with_gpu() else { return };
    b.image("a.glsl", PLACE);
    let run = b.line("render a.glsl --size 1000000x8 --out o").expect(2);
    assert!(run.err.contains("1000000x8") && run.err.contains("at most"), "{}", run.err);
    assert!(b.names("o").is_empty());
}

#[test]
fn a_pass_is_written_by_name_and_an_unknown_name_is_an_error() {
    let Some(b) = Bench::with_gpu() else { return };
    write_counting_project(&b);
    b.line("render count --pass buffer_a --frames 5 --size 4x4 --out a.npy").expect(0);
    assert_eq!(b.npy("a.npy").at(2, 1), [5.0, 2.5, 12.5, 7.5]);
    let run = b.line("render count --pass buffer_c --size 4x4 --out c.png").expect(2);
    assert!(run.err.contains("buffer_c") && run.err.contains("buffer_a"), "{}", run.err);
    assert_eq!(b.names("."), ["a.npy", "count"]);
}

#[test]
fn two_runs_and_a_run_without_skipping_write_the_same_bytes() {
    let Some(b) = Bench::with_gpu() else { return };
    write_counting_project(&b);
    b.image("place.glsl", PLACE);
    for (out, more) in [("a", ""), ("b", ""), ("c", "--no-skip")] {
        b.line(&format!("render count place.glsl fluid --size 64x36 --at 0,3,7 --out {out} {more}")).expect(0);
    }
    let names = b.names("a");
    assert_eq!(names.len(), 9);
    for other in ["b", "c"] {
        assert_eq!(b.names(other), names);
        for name in &names {
            assert!(b.bytes(&format!("a/{name}")) == b.bytes(&format!("{other}/{name}")), "{other}/{name} differs");
        }
    }
}

#[test]
fn a_frame_beyond_its_timeout_is_an_error_and_the_next_project_is_drawn() {
    let Some(b) = Bench::with_gpu() else { return };
    let slow_loop =
        "float a = fragCoord.x; for (int i = 0; i < 10000000; i++) a = fract(sin(a) * 43758.5 + float(i & 1));";
    b.image("slow.glsl", &format!("{slow_loop} fragColor = vec4(a);"));
    b.image("fast.glsl", "fragColor = vec4(1.0);");
    let run =
        b.line("render slow.glsl fast.glsl --size 320x180 --frames 2 --frame-timeout 0.5 --json --out o").expect(2);
    let [slow, fast] = &run.json()[..] else { panic!("{}", run.out) };
    assert_eq!((&slow["status"], &fast["status"]), (&"error".into(), &"ok".into()), "{}", run.out);
    assert!(run.out.contains("after 0.5 s") && run.out.contains("--frame-timeout"), "{}", run.out);
    assert_eq!(b.names("o"), ["fast.png"]);
    let run = b.line("bench slow.glsl --size 320x180 --frames 1 --frame-timeout 0.5").expect(2);
    assert!(run.err.contains("frame 0 was stopped after 0.5 s"), "{}", run.err);
}

#[test]
fn the_mouse_script_reaches_imouse() {
    let Some(b) = Bench::with_gpu() else { return };
    b.image("m.glsl", "fragColor = iMouse;");
    b.image("p/buffer_a.glsl", "fragColor = iMouse;");
    b.image("p/image.glsl", "fragColor = texelFetch(iChannel0, ivec2(0), 0);");
    let script = "1:down 40.7,20; 3:move 50,10; 4:up; 5:move 1,1";
    let args = "render p --pass buffer_a --size 64x36 --at 0,1,2,3,4,5 --format npy --out o --mouse";
    b.eddy(args.split(' ').chain([script])).expect(0);
    let expected = [
        [0.0, 0.0, -0.0, -0.0],
        [40.0, 20.0, 40.0, 20.0],
        [40.0, 20.0, 40.0, -20.0],
        [50.0, 10.0, 40.0, -20.0],
        [50.0, 10.0, -40.0, -20.0],
        [50.0, 10.0, -40.0, -20.0],
    ];
    for (frame, expected) in expected.into_iter().enumerate() {
        assert_eq!(b.npy(&format!("o/p_{frame:04}.npy")).at(0, 0), expected, "frame {frame}");
    }
}

#[test]
fn the_key_script_reaches_the_keyboard_texture() {
    let Some(b) = Bench::with_gpu() else { return };
    b.write("k/eddy.toml", "eddy = 1\n[passes.image]\nchannels.0 = { keyboard = true }\n");
    b.image(
        "k/image.glsl",
        "fragColor = vec4(texelFetch(iChannel0, ivec2(32, 0), 0).x, texelFetch(iChannel0, ivec2(32, 1), 0).x, \
         texelFetch(iChannel0, ivec2(32, 2), 0).x, 1.0);",
    );
    let args = "render k --size 4x4 --at 0,1,2,3,4 --format npy --out o --keys";
    b.eddy(args.split(' ').chain(["1:down 32; 3:up 32"])).expect(0);
    let held_pressed_toggled = [[0.0, 0.0, 0.0], [1.0, 1.0, 1.0], [1.0, 0.0, 1.0], [0.0, 0.0, 1.0], [0.0, 0.0, 1.0]];
    for (frame, expected) in held_pressed_toggled.into_iter().enumerate() {
        assert_eq!(b.npy(&format!("o/k_{frame:04}.npy")).at(1, 1)[..3], expected, "frame {frame}");
    }
}

#[test]
fn time_and_date_follow_fps() {
    let Some(b) = Bench::with_gpu() else { return };
    b.image("p/buffer_a.glsl", "fragColor = vec4(iTime, iTimeDelta, iFrameRate, iDate.w);");
    b.image("p/buffer_b.glsl", "fragColor = iDate;");
    b.image("p/image.glsl", "fragColor = texelFetch(iChannel0, ivec2(0), 0) + texelFetch(iChannel1, ivec2(0), 0);");
    b.line("render p --pass buffer_a --size 4x4 --frames 4 --fps 8 --out a.npy").expect(0);
    assert_eq!(b.npy("a.npy").at(0, 0), [0.375, 0.125, 8.0, 0.375], "without --date iDate.w is iTime");
    b.line("render p --pass buffer_b --size 4x4 --frames 9 --fps 4 --date 2024-12-31T23:59:59 --out d.npy").expect(0);
    assert_eq!(b.npy("d.npy").at(0, 0), [2025.0, 0.0, 1.0, 1.0], "after midnight; months count from 0");
}

#[cfg(unix)]
#[test]
fn a_write_error_names_the_file_and_leaves_no_partial_file() {
    let Some(b) = Bench::with_gpu() else { return };
    b.image("a.glsl", PLACE);
    b.write("file", "mine");
    let r = b.line("render a.glsl --size 4x4 --out file").expect(2);
    assert!(r.err.contains("file"), "{}", r.err);
    assert_eq!(b.bytes("file"), b"mine");
    let r = b.line("render a.glsl --size 4x4 --out no/such/a.png").expect(2);
    assert!(r.err.contains("no/such/a.png"), "{}", r.err);

    // A limit on the size of files simulates a full disk: both fail in the middle of a write.
    b.write("o/a.npy", "the picture of yesterday");
    let mut shell = std::process::Command::new("sh");
    shell
        .args(["-c", "trap '' XFSZ; ulimit -f 16; exec \"$@\"", "sh", env!("CARGO_BIN_EXE_eddy")])
        .args("render a.glsl --size 64x36 --format npy --out o".split(' '))
        .current_dir(b.path("."))
        .env("MESA_SHADER_CACHE_DISABLE", "true");
    let r = run(&mut shell).expect(2);
    assert!(r.err.contains("o/a.npy"), "{}", r.err);
    assert_eq!(b.names("o"), ["a.npy"], "no partial file is left");
    assert_eq!(b.bytes("o/a.npy"), b"the picture of yesterday");
}

#[test]
fn a_missing_input_is_black_with_a_warning() {
    let Some(b) = Bench::with_gpu() else { return };
    b.write(
        "w/eddy.toml",
        "eddy = 1\n[passes.image]\nchannels.0 = { webcam = true }\nchannels.1 = { file = \"gone.png\" }\n",
    );
    b.image(
        "w/image.glsl",
        "fragColor = vec4(0.25) + texture(iChannel0, fragCoord) + texture(iChannel1, fragCoord); fragColor.b = \
         iChannelResolution[1].x; fragColor.r = iChannelResolution[0].x;",
    );
    let line = b.line("render w --size 4x4 --out w.npy --json").expect(0).json().remove(0);
    assert_eq!(line["status"], "ok", "{line}");
    let found = line["diagnostics"].as_array().unwrap();
    assert!(found.iter().all(|d| d["severity"] == "warning"), "{line}");
    assert!(found.iter().any(|d| d["message"].as_str().unwrap().contains("gone.png")), "{line}");
    let [camera, _, picture, _] = b.npy("w.npy").at(0, 0);
    assert_eq!((camera, picture), (320.0, 0.0), "an unloaded channel has size 0, a camera that is off Shadertoy's");
}

#[test]
fn bench_reports_the_cost_of_a_frame() {
    let Some(b) = Bench::with_gpu() else { return };
    write_counting_project(&b);
    let line = b.line("bench count --size 16x16 --frames 5 --json").expect(0).json().remove(0);
    assert_eq!((&line["project"], &line["status"], &line["frames"]), (&"count".into(), &"ok".into(), &5.into()));
    assert!(line["frame_ms"].as_f64().unwrap() > 0.0 && line["cpu_us_per_pass"].as_f64().unwrap() > 0.0, "{line}");
    let names: Vec<_> = line["passes"].as_array().unwrap().iter().map(|p| p["pass"].clone()).collect();
    assert_eq!(names, ["buffer_a", "image"]);
    let text = b.line("bench count --size 16x16 --frames 5").expect(0).out;
    assert!(text.contains("Buffer A") && text.contains("ms"), "{text}");
}

#[test]
fn set_uniforms_affect_render_and_bench() {
    let Some(b) = Bench::with_gpu() else { return };
    b.write(
        "a.glsl",
        "#iUniform vec2 both = vec2(0.25, 0.5)\nvoid mainImage(out vec4 o, in vec2 p) { o = vec4(both, 0.0, 1.0); }\n",
    );
    b.line("render a.glsl --size 1x1 --out a.npy").expect(0);
    assert_eq!(b.npy("a.npy").at(0, 0), [0.25, 0.5, 0.0, 1.0]);
    b.line("render a.glsl --size 1x1 --out b.npy --set both=-1,7").expect(0);
    assert_eq!(b.npy("b.npy").at(0, 0), [-1.0, 7.0, 0.0, 1.0]);
    b.line("bench a.glsl --size 1x1 --frames 1 --set both=1,2").expect(0);
    assert!(b.line("bench a.glsl --size 1x1 --frames 1 --set bott=1,2").expect(2).err.contains("did you mean both?"));
}

#[test]
fn bench_reports_unchanged_passes_and_no_skip_draws_them() {
    let Some(b) = Bench::with_gpu() else { return };
    b.image("p/buffer_a.glsl", "fragColor = vec4(fragCoord, iResolution.xy);");
    b.image("p/buffer_b.glsl", "fragColor = texelFetch(iChannel0, ivec2(fragCoord), 0) + iTime;");
    b.image("p/image.glsl", "fragColor = texelFetch(iChannel1, ivec2(fragCoord), 0);");
    b.write(
        "p/eddy.toml",
        "[passes.buffer_a]\nsize = [4, 2]\nformat = \"rg16f\"\n[passes.buffer_b]\nchannels.0 = { buffer = \"A\" }\n\
         [passes.image]\nchannels.1 = { buffer = \"B\" }\n",
    );
    let bench = |args: &str| b.line(&format!("bench p --size 8x4 --frames 5 {args}")).expect(0);
    assert!(bench("").out.contains("unchanged"));
    let json = &bench("--json").json()[0];
    assert_eq!((json["passes_rested"].as_f64(), json["bytes_rested"].as_f64()), (Some(1.0), Some(4.0 * 2.0 * 4.0)));
    let full = &bench("--json --no-skip").json()[0];
    assert_eq!(full["passes_rested"].as_f64(), Some(0.0));
    assert!(!bench("--no-skip").out.contains("unchanged"));
    b.line("render p --size 8x4 --frames 4 --out a.npy").expect(0);
    b.line("render p --size 8x4 --frames 4 --out b.npy --no-skip").expect(0);
    assert_eq!(b.bytes("a.npy"), b.bytes("b.npy"));
    b.line("render p --size 8x4 --pass buffer_a --out c.npy").expect(0);
    assert_eq!((b.npy("c.npy").width, b.npy("c.npy").at(3, 1)), (4, [3.5, 1.5, 0.0, 1.0]));
    let exported = b.line("export p --out p.json").expect(0);
    assert!(exported.out.contains("The size and format of Buffer A are left out."), "{}", exported.out);
}

#[test]
fn a_sweep_draws_once_per_value() {
    let Some(b) = Bench::with_gpu() else { return };
    b.write(
        "p/image.glsl",
        "#iUniform float gain = 0.1 in { 0.0, 1.0 }\n#iUniform color3 tint = color3(1.0, 1.0, 1.0)\n\
         void mainImage(out vec4 o, in vec2 p) { o = vec4(gain * tint, 1); }\n",
    );
    let run = b
        .eddy([
            "render",
            "p",
            "--size",
            "2x2",
            "--out",
            "o",
            "--sweep",
            "gain=0..1:3",
            "--sweep",
            "tint=1,0,0;0,1,0",
            "--json",
        ])
        .expect(0);
    let lines = run.json();
    assert_eq!(lines.len(), 6);
    assert_eq!(lines[5]["sweep"], serde_json::json!(["gain=1", "tint=0,1,0"]));
    let texel = |name: &str| image::open(b.path(name)).unwrap().to_rgb8().get_pixel(0, 0).0;
    assert_eq!(texel("o/p_gain=0.5_tint=1,0,0.png"), [128, 0, 0]);
    assert_eq!(texel("o/p_gain=1_tint=0,1,0.png"), [0, 255, 0]);
    let run = b.line("bench p --size 2x2 --frames 2 --sweep gain=0;1 --json").expect(0).json();
    assert_eq!(run.iter().map(|l| l["sweep"][0].as_str().unwrap()).collect::<Vec<_>>(), ["gain=0", "gain=1"]);
    let run = b.line("render p --size 2x2 --out o --sweep gian=0;1").expect(2);
    assert!(run.err.contains("--sweep") && run.err.contains("gain"), "{}", run.err);
    let run = b.line("render p --size 2x2 --out o/x.png --sweep gain=0;1").expect(2);
    assert!(run.err.contains("2 pictures"), "{}", run.err);
}

/// A pass whose compilation takes a software driver too long is rejected at its largest function, and a pass that
/// compiles in time is drawn.
#[test]
fn a_pass_beyond_the_compile_timeout_is_rejected() {
    let Some(gpu) = gpu() else { return };
    if !gpu.compiles_here {
        return;
    }
    let b = Bench::new();
    let sines = |count: usize| {
        let lines: String = (0..count).map(|i| format!("a = a * 1.{} + sin(a);\n", i % 7 + 1)).collect();
        let main = "void mainImage(out vec4 c, vec2 p) { c = vec4(much(p.x)); }";
        format!("float little(float a) {{ return a; }}\nfloat much(float a) {{\n{lines}return little(a); }}\n{main}\n")
    };
    b.write("long.glsl", sines(2_000));
    let args = "render long.glsl --size 8x8 --compile-timeout 0.2 --out long.png --json";
    // A driver that compiled the text in an earlier run has it in its cache.
    let run = run(b.command().env("MESA_SHADER_CACHE_DISABLE", "true").args(args.split(' '))).expect(1);
    let line = &run.json()[0];
    assert_eq!(line["status"], "diagnostics");
    let error = &line["diagnostics"][0];
    let message = error["message"].as_str().expect("a message");
    assert!(message.contains("Image") && message.contains("more than 0.2 s of CPU time"), "{message}");
    assert_eq!(error["line"], 2, "{error}");
    assert!(b.names(".").iter().all(|name| name != "long.png"));
    b.write("short.glsl", sines(600));
    b.line("render short.glsl --size 8x8 --compile-timeout 100 --out short.png").expect(0);
}

/// A driver that hangs is reported, and the process still ends: its exit handlers must not wait for the hung thread.
#[test]
#[ignore = "takes two minutes"]
#[cfg(target_os = "linux")]
fn a_hanging_driver_ends_the_command() {
    let b = Bench::new();
    b.write(
        "driver.c",
        "#include <unistd.h>\nint vk_icdNegotiateLoaderICDInterfaceVersion(void *v) { for (;;) sleep(9); }",
    );
    let library = b.path("driver.so");
    let cc = std::process::Command::new("cc")
        .args(["-shared", "-fPIC", "-o"])
        .arg(&library)
        .arg(b.path("driver.c"))
        .status();
    assert!(cc.unwrap().success());
    let driver = serde_json::json!({
        "file_format_version": "1.0.0",
        "ICD": { "library_path": library, "api_version": "1.1.0" },
    });
    b.write("driver.json", driver.to_string());
    b.image("a.glsl", PLACE);
    b.image("b.glsl", PLACE);
    for (args, code) in [("render a.glsl b.glsl --frames 1 --size 8x8 --out out", 2), ("doctor", 2)] {
        let mut command = b.command();
        command.env("VK_DRIVER_FILES", b.path("driver.json")).env("WGPU_BACKEND", "vulkan");
        let start = std::time::Instant::now();
        let run = run(command.args(args.split(' '))).expect(code);
        // The timeout passes once for both files.
        let seconds = start.elapsed().as_secs();
        assert!((60..75).contains(&seconds), "{seconds} s");
        let output = format!("{}{}", run.out, run.err);
        let count = output.matches("the graphics driver has not answered for 60 s").count();
        assert_eq!(count, if args == "doctor" { 1 } else { 2 }, "{output}");
    }
}
