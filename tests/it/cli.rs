//! The command line as scripts rely on it, tested with the built program: arguments, exit codes, messages and JSON
//! lines. Tests that need a graphics device are in `cli_render.rs`.

use crate::support::program::{Bench, image, run};
use std::{fs, process::Stdio};

const RED: &str = "fragColor = vec4(1.0, 0.0, 0.0, 1.0);";

#[test]
fn usage_errors_exit_with_2_and_explain_the_syntax() {
    let b = Bench::new();
    b.image("a.glsl", RED);
    for (line, expected) in [
        ("render", "<PROJECT>"),
        ("render a.glsl", "--out"),
        ("render a.glsl --out o --size 0x0", "a size must be at least 1"),
        ("render a.glsl --out o --size 64", "640x360"),
        ("render a.glsl --out o --frames 0", "--frames"),
        ("render a.glsl --out o --frames 3 --at 3", "the last frame is 2"),
        ("render a.glsl --out o.exr --codec h264", "a codec cannot be chosen for exr files"),
        ("render a.glsl --out o.mp4", "--frames 600"),
        ("render a.glsl --out o --frames 5-2", "write 2-5"),
        ("render a.glsl --out o.png --format npy", "do not agree"),
        ("render a.glsl x/a.glsl --out o", "would both be written"),
        ("render a.glsl fluid --out o.png", "give a folder"),
        ("render a.glsl --out o --mouse 0:press", "--mouse"),
        ("render a.glsl --out o --keys 0:down,999", "--keys"),
        ("render a.glsl --out o --date yesterday", "--date"),
        ("render a.glsl --out o --colour red", "--colour"),
        ("fluid more", "more"),
        ("check", "<PROJECT>"),
        ("import a.json", "--out"),
    ] {
        let run = b.line(line).expect(2);
        assert!(run.err.contains(expected), "{line}\n{}", run.err);
        assert!(run.out.is_empty(), "{line}: {}", run.out);
    }
    assert_eq!(b.names("."), ["a.glsl"], "nothing is written before the arguments make sense");
}

#[test]
fn help_and_version_exit_with_0() {
    let b = Bench::new();
    assert!(b.line("--version").expect(0).out.starts_with("eddy "));
    for command in ["", "render", "check", "bench", "list", "import", "export"] {
        assert!(b.line(&format!("{command} --help")).expect(0).out.contains("Usage: eddy"));
    }
}

#[test]
fn list_prints_one_preset_per_line_and_each_is_a_project() {
    let b = Bench::new();
    let list = b.line("list").expect(0).out;
    let names: Vec<&str> = list.lines().collect();
    for preset in ["feedback", "fluid", "brick-breaker"] {
        assert!(names.contains(&preset), "{names:?}");
    }
    let check = b.eddy(["check", "--json"].iter().chain(&names)).expect(0);
    assert_eq!(check.json().len(), names.len());
}

#[test]
fn check_shows_the_place_and_counts_errors() {
    let b = Bench::new();
    b.image("good.glsl", RED);
    b.image("bad.glsl", "    fragColor = vec4(nothing);");
    let run = b.line("check good.glsl bad.glsl").expect(1);
    assert!(run.err.contains("bad.glsl:2:"), "{}", run.err);
    assert!(run.err.contains("^"), "{}", run.err);
    assert!(run.out.contains("good.glsl: ok"), "{}", run.out);
    assert!(run.out.contains("bad.glsl: 1 error"), "{}", run.out);
}

#[test]
fn check_reports_errors_of_unused_passes() {
    let b = Bench::new();
    b.image("p/image.glsl", RED);
    b.image("p/buffer_a.glsl", "fragColor = vec4(one);");
    b.image("p/buffer_b.glsl", "fragColor = vec4(two);");
    let lines = b.line("check --json p").expect(1).json();
    let sources: Vec<_> = lines[0]["diagnostics"].as_array().unwrap().iter().map(|d| d["source"].clone()).collect();
    assert_eq!(sources, ["buffer_a.glsl", "buffer_b.glsl"]);
    assert_eq!(lines[0]["diagnostics"][0]["tab"], "Buffer A");
}

#[test]
fn check_names_pictures_that_cannot_be_read() {
    let b = Bench::new();
    b.image("p/image.glsl", "fragColor = texture(iChannel0, fragCoord) + texture(iChannel1, fragCoord);");
    b.write(
        "p/eddy.toml",
        "eddy = 1\n[passes.image]\nchannels.0 = { file = \"../x.png\" }\nchannels.1 = { file = \"none.png\" }\n",
    );
    let lines = b.line("check --json p").expect(0).json();
    let messages: Vec<_> =
        lines[0]["diagnostics"].as_array().unwrap().iter().map(|d| d["message"].as_str().unwrap()).collect();
    assert_eq!(messages.len(), 2, "{messages:?}");
    assert!(messages[0].starts_with("iChannel0 of Image: ../x.png leads out of the project's folder"), "{messages:?}");
    assert!(messages[1].starts_with("iChannel1 of Image: ") && messages[1].contains("none.png"), "{messages:?}");
}

#[test]
fn check_warns_where_shadertoy_reads_differently() {
    let b = Bench::new();
    b.image("p/buffer_a.glsl", RED);
    b.image("p/image.glsl", "fragColor = texture(iChannel0, fragCoord) + texture(iChannel1, fragCoord);");
    let manifest = |first: &str, second: &str| {
        format!(
            "eddy = 1\n[passes.buffer_a]\n[passes.image]\n\
             channels.0 = {{ buffer = \"A\", {first} }}\nchannels.1 = {{ buffer = \"A\", {second} }}\n"
        )
    };
    for (first, second, expected) in [
        ("filter = \"nearest\"", "filter = \"linear\"", Some("filter")),
        ("wrap = \"repeat\"", "wrap = \"clamp\"", Some("wrap")),
        ("wrap = \"repeat\"", "wrap = \"repeat\"", None),
    ] {
        b.write("p/eddy.toml", manifest(first, second));
        let found = b.line("check --json p").expect(0).json().remove(0)["diagnostics"].clone();
        let found = found.as_array().unwrap();
        match expected {
            None => assert!(found.is_empty(), "{found:?}"),
            Some(word) => {
                assert_eq!(found.len(), 1, "{found:?}");
                assert_eq!(found[0]["severity"], "warning");
                let message = found[0]["message"].as_str().unwrap();
                assert!(message.contains(word) && message.contains("Buffer A"), "{message}");
            }
        }
    }
}

#[test]
fn a_bad_project_is_named_with_its_file_and_does_not_stop_others() {
    let b = Bench::new();
    b.image("good.glsl", RED);
    b.write("broken/eddy.toml", "eddy = 1\nname = \"unclosed\n");
    b.image("broken/image.glsl", RED);
    b.write("empty/readme.txt", "no project");
    b.write("text.txt", "no project");
    b.write("broken.json", "{\"ver\": \"0.1\", ");
    b.write("other.json", "{\"kind\": \"recipe\"}");
    b.write("latin1.glsl", b"// \xe9t\xe9\nvoid mainImage(out vec4 c, in vec2 f) { c = vec4(1.0); }");
    b.write("missing/eddy.toml", "eddy = 1\n[passes.image]\nfile = \"gone.glsl\"\n");
    b.write("include.glsl", format!("#include \"gone.glsl\"\n{}", image(RED)));
    let projects = [
        ("broken", "eddy.toml"),
        ("empty", "image.glsl"),
        ("text.txt", "text.txt"),
        ("broken.json", "broken.json"),
        ("other.json", "other.json"),
        ("latin1.glsl", "latin1.glsl"),
        ("missing", "gone.glsl"),
        ("include.glsl", "gone.glsl"),
        ("fluidd", "fluid"),
        ("no/such/path.glsl", "no/such/path.glsl"),
        ("", "preset"),
        ("good.glsl", ""),
    ];
    let run = b.eddy(["check", "--json"].into_iter().chain(projects.map(|(p, _)| p)));
    assert!(matches!(run.code, Some(1 | 2)), "{run:?}");
    let lines = run.json();
    assert_eq!(lines.len(), projects.len());
    for (line, (project, expected)) in lines.iter().zip(projects) {
        assert_eq!(line["project"], project);
        if expected.is_empty() {
            assert_eq!(line["status"], "ok", "{line}");
            continue;
        }
        assert!(line["status"] == "diagnostics" || line["status"] == "error", "{line}");
        assert!(line["diagnostics"].to_string().contains(expected), "{line}\nshould name {expected}");
    }
}

#[cfg(unix)]
#[test]
fn an_unreadable_file_is_named() {
    use std::os::unix::fs::PermissionsExt;
    let b = Bench::new();
    b.image("p/image.glsl", RED);
    // Root can read every file except a symbolic link to itself.
    if fs::read("/etc/shadow").is_ok() {
        fs::remove_file(b.path("p/image.glsl")).unwrap();
        std::os::unix::fs::symlink("image.glsl", b.path("p/image.glsl")).unwrap();
    } else {
        fs::set_permissions(b.path("p/image.glsl"), fs::Permissions::from_mode(0o0)).unwrap();
    }
    let run = b.line("check p").expect(2);
    assert!(run.err.contains("image.glsl"), "{}", run.err);
}

#[test]
fn import_and_export_overwrite_only_with_force() {
    let b = Bench::new();
    let all = |folder: &str| b.names(folder).iter().map(|n| b.bytes(&format!("{folder}/{n}"))).collect::<Vec<_>>();
    b.line("export fluid --out fluid.json").expect(0);
    let first = b.bytes("fluid.json");
    b.line("export feedback --out fluid.json").expect(2);
    assert_eq!(b.bytes("fluid.json"), first);
    b.line("import fluid.json --out p").expect(0);
    assert!(b.names("p").contains(&"image.glsl".to_owned()), "{:?}", b.names("p"));
    b.line("check p fluid.json").expect(0);
    let before = all("p");
    b.write("p/image.glsl", "mine");
    b.write("p/common.glsl", "mine");
    let rejected = b.line("import fluid.json --out p").expect(2);
    for word in ["--force", "p/image.glsl", "p/common.glsl"] {
        assert!(rejected.err.contains(word), "{word}: {}", rejected.err);
    }
    assert_eq!(b.bytes("p/image.glsl"), b"mine");
    b.line("import fluid.json --out p --force").expect(0);
    assert_eq!(all("p"), before);
    b.line("export p --out fluid.json --force").expect(0);
    assert_eq!(b.bytes("fluid.json"), first, "a round trip loses nothing");
    b.line("import none.json --out q").expect(2);
    b.write("bad.json", "[]");
    b.line("import bad.json --out q").expect(1);
    assert!(b.names("q").is_empty());
}

#[cfg(target_os = "linux")]
#[test]
fn a_window_that_cannot_open_suggests_commands_without_a_window() {
    let b = Bench::new();
    let run =
        run(b.command().arg("fluid").env_remove("DISPLAY").env_remove("WAYLAND_DISPLAY").env_remove("WAYLAND_SOCKET"));
    let run = run.expect(2);
    assert!(run.err.contains("eddy render") || run.err.contains("eddy --help"), "{}", run.err);
}

/// A limit on the size of files simulates a full disk: both fail in the middle of a write.
#[test]
#[cfg(unix)]
fn an_export_that_does_not_fit_reports_one_error_and_leaves_no_file() {
    let b = Bench::new();
    let mut shell = std::process::Command::new("sh");
    shell
        .args(["-c", "trap '' XFSZ; ulimit -f 8; exec \"$@\"", "sh", env!("CARGO_BIN_EXE_eddy")])
        .args(["export", "fluid", "--out", "fluid.json"])
        .current_dir(b.path("."));
    let r = run(&mut shell).expect(2);
    assert_eq!(r.err.matches("cannot write fluid.json: ").count(), 1, "{}", r.err);
    assert!(r.err.matches("os error").count() == 1 && !r.err.contains(".eddy-"), "{}", r.err);
    assert_eq!(b.names("."), [""; 0]);
}

#[test]
fn a_closed_or_full_standard_output_does_not_panic() {
    let b = Bench::new();
    b.image("a.glsl", RED);
    if let Ok(full) = fs::OpenOptions::new().write(true).open("/dev/full") {
        let run = run(b.command().args(["check", "a.glsl", "--json"]).stdout(full)).expect(2);
        assert!(run.err.contains("standard output"), "{}", run.err);
    }
    let mut child = b.command().arg("list").stdout(Stdio::piped()).stderr(Stdio::piped()).spawn().unwrap();
    drop(child.stdout.take());
    let output = child.wait_with_output().unwrap();
    let err = String::from_utf8_lossy(&output.stderr);
    assert!(!err.contains("panicked"), "{err}");
}

#[test]
fn uniforms_are_set_on_the_command_line_and_become_constants_of_an_export() {
    let b = Bench::new();
    let code = "#iUniform float red = 0.2 in { 0.0, 1.0 }\nvoid mainImage(out vec4 o, in vec2 p) { o = vec4(red); }\n";
    b.write("p/image.glsl", code);
    b.write("p/eddy.toml", "eddy = 1\n[uniforms]\nred = 0.4\nreed = 1\n[passes.image]\n");
    let check = b.line("check p").expect(0);
    assert!(check.err.contains("eddy.toml:4:1") && check.err.contains("did you mean red?"), "{}", check.err);
    let exported = b.line("export p --out p.json").expect(0);
    assert!(exported.out.contains("red becomes a constant"), "{}", exported.out);
    assert!(String::from_utf8(b.bytes("p.json")).unwrap().contains("const float red = 0.4;\\n// #iUniform float red"));
    b.line("check p.json").expect(0);
    for (args, expected) in [
        ("rde=1", "did you mean red?"),
        ("red=2", "outside its range, 0.0 to 1.0"),
        ("red=1,2", "is a float and takes a number"),
        ("red", "viscosity=0.3"),
    ] {
        let run = b.line(&format!("render p --size 4x4 --out o.png --set {args}")).expect(2);
        assert!(run.err.contains("--set ") && run.err.contains(expected), "{args}: {}", run.err);
    }
    b.write("p/eddy.toml", "eddy = 1\n[uniforms]\nred = \"x\"\n[passes.image]\n");
    let rejected = b.line("check p").expect(1);
    assert!(
        rejected.err.contains("eddy.toml:3:7") && rejected.err.contains("true, false, a number"),
        "{}",
        rejected.err
    );
}
