//! Directives in texts are applied, or every command rejects them at their line with the same message.

use crate::support::program::Bench;

const GREEN: &str = "void mainImage(out vec4 o, in vec2 p) { o = vec4(0.0, 1.0, 0.0, 1.0); }\n";
const SHOW: &str = "void mainImage(out vec4 o, in vec2 p) { o = texelFetch(iChannel0, ivec2(p), 0); }\n";

/// Runs each command that reads texts on a project; each must reject it with one error that contains all `parts`.
fn assert_every_command_rejects(b: &Bench, project: &str, parts: &[&str]) {
    for command in ["check", "render --size 2x2 --frames 1 --out o.png", "bench --frames 1", "export --out o.json"] {
        let (name, options) = command.split_once(' ').unwrap_or((command, ""));
        let run = b.line(&format!("{name} {project} {options}"));
        assert_ne!(run.code, Some(0), "{command}: {run:?}");
        let output = format!("{}{}", run.out, run.err);
        for part in parts {
            assert!(output.contains(part), "{command} does not print {part:?} but\n{output}");
        }
        assert_eq!(output.matches("error: ").count(), 1, "{command}: {output}");
        assert!(b.names(".").iter().all(|n| !n.starts_with("o.")), "{command} wrote {:?}", b.names("."));
    }
}

#[test]
fn a_broken_directive_is_one_error_at_its_line_in_every_command() {
    for (line, parts) in [
        ("#include <tone.glsl>", &["angle brackets", "write #include \"tone.glsl\""][..]),
        ("#include <nothere.glsl> // note", &["angle brackets"]),
        ("#include", &["has no file name"]),
        ("  #  include \"\"\r", &["has no file name"]),
        ("#include 'tone.glsl'", &["single quotes", "write #include \"tone.glsl\""]),
        ("#include tone.glsl", &["double quotes", "write #include \"tone.glsl\""]),
        ("#include \"tone.glsl", &["closing quote"]),
        ("#include \"tone.glsl\" int x;", &["unexpected `int x;`"]),
        ("#include \"nothere.glsl\"", &["there is no file nothere.glsl"]),
        ("#include <common>", &["chunk of three.js"]),
        ("#Include \"tone.glsl\"", &["upper and lower case differ", "write #include \"tone.glsl\""]),
        ("#import \"tone.glsl\"", &["no directive `#import`", "write #include \"tone.glsl\""]),
        ("#include_next \"tone.glsl\"", &["no directive `#include_next`"]),
        ("#pragma include \"tone.glsl\"", &["`#pragma include`", "write #include \"tone.glsl\""]),
        ("#iKeyboard", &["`#iKeyboard`", "#iChannel0 \"keyboard\""]),
        ("#iVertex \"a.glsl\"", &["`#iVertex`"]),
        ("#iChannel0 self", &["double quotes"]),
        ("#iChannel0 'self'", &["double quotes"]),
        ("#iChannel4 \"self\"", &["there is no iChannel4"]),
        ("#iChannel \"self\"", &["no directive `#iChannel`", "write #iChannel0"]),
        ("#ichannel0 \"self\"", &["no directive `#ichannel0`", "write #iChannel0"]),
        ("#iChannel0 \"\"", &["not an input that a channel can read"]),
        ("#iChannel0 \"file://self\"", &["Image cannot read itself"]),
        ("#iChannel0 \"./image.glsl\"", &["Image cannot read itself"]),
        ("#iChannel0 \"file://blur.glsl\"", &["there is no file blur.glsl"]),
        ("#iChannel0 \"buffer_c.glsl\"", &["there is no file buffer_c.glsl", "did you mean \"buffer_b.glsl\"?"]),
        ("#iChannel0 \"buffer_b\"\n#iChannel0::WrapMode \"Wrap\"", &["unknown wrap mode", ":3:1"]),
        ("#iUniform flaot x = 1.0", &["unknown slider type flaot"]),
        ("#iuniform float x = 1.0", &["no directive `#iuniform`", "did you mean `#iUniform`?"]),
    ] {
        let b = Bench::new();
        b.write("image.glsl", format!("// first\n{line}\n{GREEN}"));
        b.write("buffer_b.glsl", GREEN);
        b.write("tone.glsl", "float tone() { return 1.0; }\n");
        let place: &[&str] = if parts.contains(&":3:1") { &[] } else { &["image.glsl:2:"] };
        let all: Vec<&str> = parts.iter().chain(place).copied().collect();
        assert_every_command_rejects(&b, ".", &all);
    }
}

#[test]
fn directives_in_comments_and_inactive_groups_are_ignored() {
    let b = Bench::new();
    let lines = "#include <stdio.h>\n#iKeyboard\n#import \"x\"\n#pragma include \"x\"\n";
    let text = format!(
        "/*\n{lines}#iChannel7 self\n*/\n// note \\\n#iChannel7 self\n#ifdef C\n{lines}#endif\n#StrictCompatibility\n{GREEN}"
    );
    b.write("image.glsl", text);
    let run = b.line("check image.glsl").expect(0);
    assert!(run.out.contains("image.glsl: ok\n"), "{run:?}");
}

#[test]
fn channel_lines_outside_passes_are_reported() {
    let b = Bench::new();
    b.write("p/image.glsl", format!("#include \"tone.glsl\"\n{GREEN}"));
    b.write("p/tone.glsl", "\n#iChannel0 \"keyboard\"\n");
    assert_every_command_rejects(
        &b,
        "p",
        &["p/tone.glsl:2:1".strip_prefix("p/").unwrap(), "a channel belongs to a pass"],
    );
    b.write("q/common.glsl", "#iChannel0 \"keyboard\"\n");
    b.write("q/image.glsl", GREEN);
    assert_every_command_rejects(&b, "q", &["common.glsl:1:1", "a channel belongs to a pass"]);
    // A project with eddy.toml ignores such lines, so it still opens.
    b.write("r/eddy.toml", "[passes.image]\nchannels.0 = { keyboard = true }\n");
    b.write("r/image.glsl", format!("#iChannel0 \"keyboard\"\n#iChannel1 \"file://a.png\"\n{GREEN}"));
    let run = b.line("check r").expect(0);
    assert_eq!(run.err.matches("warning: ").count(), 1, "{run:?}");
    assert!(run.err.contains("image.glsl:2:1") && run.err.contains("eddy.toml sets the input of iChannel1"), "{run:?}");
}

#[test]
fn a_channel_that_reads_a_missing_pass_is_a_warning_at_its_line() {
    let b = Bench::new();
    b.write("lone.glsl", format!("\n#iChannel0 \"buffer_a\"\n{SHOW}"));
    let run = b.line("check lone.glsl").expect(0);
    assert_eq!(run.err.matches("warning: ").count(), 1, "{run:?}");
    assert!(
        run.err.contains("lone.glsl:2:1") && run.err.contains("reads Buffer A, but the project has no such pass"),
        "{run:?}"
    );
}

#[test]
fn a_single_file_reads_the_files_that_its_channels_name() {
    let Some(b) = Bench::with_gpu() else { return };
    let half = "void mainImage(out vec4 o, in vec2 p) { o = 0.5 * texelFetch(iChannel1, ivec2(p), 0); }\n";
    b.write("show.glsl", format!("#iChannel0 \"file://parts/half.glsl\"\n{SHOW}"));
    b.write("parts/half.glsl", format!("#iChannel1 \"./ones.glsl\"\n{half}"));
    b.write("parts/ones.glsl", "void mainImage(out vec4 o, in vec2 p) { o = vec4(1.0); }\n");
    b.line("render show.glsl --size 2x2 --frames 1 --out o.npy").expect(0);
    assert_eq!(b.npy("o.npy").at(1, 1), [0.5, 0.5, 0.5, 1.0], "the files of channels are drawn first");
    b.line("export show.glsl --out o.json").expect(0);
    b.line("render o.json --size 2x2 --frames 1 --out p.npy").expect(0);
    assert_eq!(b.npy("p.npy").texels, b.npy("o.npy").texels);
    b.write("buffer_a.glsl", "void mainImage(out vec4 o, in vec2 p) { o = vec4(0.25); }\n");
    for name in ["buffer_a.glsl", "file://buffer_a.glsl", "file://./buffer_a.glsl"] {
        b.write("show.glsl", format!("#iChannel0 \"{name}\"\n{SHOW}"));
        b.line("render show.glsl --size 2x2 --frames 1 --out o.npy").expect(0);
        assert_eq!(b.npy("o.npy").at(0, 1)[..3], [0.25; 3], "{name}");
    }
}
