//! What the command line writes for people holds no control characters, whatever the names and texts of a project hold.

use crate::support::program::{Bench, Run, run};
use eddy::cli;
use std::fs;

/// Controls of C0 and C1, an escape sequence that retitles a terminal, marks that turn text round, and a line that a
/// scheduler would obey.
const HOSTILE: &str = "\u{1b}]0;own\u{7}\u{9b}2J\u{7f}\u{202e}\u{2066}\u{200f}\u{2028}";
const FORGED: &str = "x\nopenjd_env: A=1\nerror: forged";

fn is_unsafe(c: char) -> bool {
    c.is_control() && c != '\n' && c != '\t'
        || matches!(c, '\u{61c}' | '\u{200e}' | '\u{200f}' | '\u{2028}'..='\u{202e}' | '\u{2066}'..='\u{2069}')
}

#[track_caller]
fn assert_safe(run: &Run, what: &str) {
    for (stream, text) in [("standard output", &run.out), ("standard error", &run.err)] {
        let found: Vec<char> = text.chars().filter(|c| is_unsafe(*c)).collect();
        assert!(found.is_empty(), "{what}: {stream} has {found:?}:\n{}", text.escape_debug());
        let forged = text.lines().find(|line| line.starts_with("openjd_env") || line.starts_with("error: forged"));
        assert_eq!(forged, None, "{what}: {stream}:\n{text}");
    }
    assert!(!run.err.contains("panicked"), "{what}: {}", run.err);
}

/// Projects with hostile characters in one place each, by what they are. File systems do not allow `/` and NUL alone.
fn projects(b: &Bench) -> Vec<(String, String)> {
    let image = "void mainImage(out vec4 o, in vec2 p) { o = vec4(1.0); }\n";
    let mut found = Vec::new();
    let mut add = |what: &str, folder: &str, files: &[(&str, String)]| {
        for (name, text) in files {
            b.write(&format!("{folder}/{name}"), text);
        }
        found.push((what.to_owned(), folder.to_owned()));
    };
    let toml = |body: &str| format!("eddy = 1\n{body}\n[passes.image]\n");
    // A string of TOML may not hold controls but as escapes.
    let escape = r#"\u001b]0;own\u0007\u009b2J\u007f\u202e\u2066\u2028\nopenjd_env: A=1"#;
    for (what, text) in [
        ("excerpt", format!("{image}// {HOSTILE}\nfloat x = {HOSTILE} ;\n/*{HOSTILE}*/ float y = true;\n")),
        ("#error", format!("#error {HOSTILE} text\n{image}")),
        ("include", format!("#include \"{HOSTILE}.glsl\"\n{image}")),
        ("pragma", format!("#pragma {HOSTILE}\n#extension {HOSTILE} : enable\n#version {HOSTILE}\n{image}")),
        ("channel line", format!("#iChannel0 \"file://{HOSTILE}.png\"\n#iChannel1 \"{HOSTILE}\"\n{image}")),
        ("uniform line", format!("#iUniform float a{HOSTILE} = 1.0\n#iUniform {HOSTILE} b = 2\n{image}")),
        ("probe", format!("//@probe {HOSTILE}\n//@assert max({HOSTILE}) < 1\n{image}")),
        ("macro", format!("#define M(a) a{HOSTILE}\nfloat f() {{ return M(1.0); }}\n{image}")),
    ] {
        add(what, &format!("text-{}", what.replace(' ', "-")), &[("image.glsl", text)]);
    }
    for (what, body) in [
        ("key", format!("\"{escape}\" = 1")),
        ("dialect", format!("dialect = \"{escape}\"")),
        ("name", format!("name = \"{escape}\"\nunknown = 1")),
        ("value", format!("[uniforms]\n\"{escape}\" = \"{escape}\"")),
        ("control", format!("[controls]\n\"{escape}\" = \"{escape}\"")),
        ("group", format!("[groups.\"{escape}\"]\npasses = [\"{escape}\"]")),
        ("pass", format!("[passes.\"{escape}\"]\nfile = \"{escape}\"\nwhen = \"{escape}\"")),
        ("channel", format!("[passes.buffer_a]\nfile = \"image.glsl\"\nchannels.0 = {{ file = \"{escape}.png\" }}")),
        ("input", format!("[passes.buffer_a]\nfile = \"image.glsl\"\nchannels.0 = {{ \"{escape}\" = \"{escape}\" }}")),
        ("raw", format!("# {HOSTILE}\nname = {HOSTILE}")),
    ] {
        add(what, &format!("toml-{what}"), &[("eddy.toml", toml(&body)), ("image.glsl", image.into())]);
    }
    add("folder", &format!("f{HOSTILE}"), &[("image.glsl", format!("{image}bad"))]);
    add("folder of two lines", FORGED, &[("image.glsl", format!("{image}bad"))]);
    add("file", "files", &[("image.glsl", image.into()), (&format!("buffer_{HOSTILE}.glsl"), image.into())]);
    add("file of two lines", "lines", &[("image.glsl", image.into()), (&format!("{FORGED}.glsl"), image.into())]);
    let json = serde_json::json!({ "ver": "0.1", "info": { "id": HOSTILE, "name": FORGED }, "renderpass": [
        { "inputs": [{ "id": HOSTILE, "src": HOSTILE, "ctype": HOSTILE, "channel": 0 }], "outputs": [],
          "code": format!("{HOSTILE} {image}"), "name": HOSTILE, "type": "image" },
        { "inputs": [], "outputs": [], "code": "", "name": FORGED, "type": HOSTILE } ] });
    b.write("shader.json", json.to_string());
    b.write("bad.json", format!("{{\"{HOSTILE}\": {HOSTILE}}}"));
    b.write("isf.fs", format!("/*{{ \"INPUTS\": [{{\"NAME\": \"{escape}\", \"TYPE\": \"{escape}\"}}] }}*/\n{HOSTILE}"));
    let files = ["shader.json", "bad.json", "isf.fs"].map(|name| (name.to_owned(), name.to_owned()));
    found.extend(files);
    found
}

/// How each command is called on a project; `None` for one that reads no project. A new command is added here.
fn call(command: &str, project: &str, b: &Bench) -> Option<Vec<String>> {
    let words = |text: &str| text.split_whitespace().map(str::to_owned).collect::<Vec<_>>();
    let with = |before: &str, after: &str| Some([words(before), vec![project.to_owned()], words(after)].concat());
    match command {
        "render" => with("render", "--size 8x8 --out o --overwrite --progress openjd"),
        "check" => with("check", ""),
        "bench" => with("bench", "--size 8x8 --frames 2"),
        "probe" => with("probe", "o --size 8x8"),
        "trace" => with("trace", "--size 8x8 --pixel 1,1"),
        "compare" => with("compare", "--with files --size 8x8"),
        "lab" => Some(vec!["lab".into(), "precision".into(), project.into(), "--size".into(), "8x8".into()]),
        "import" => with("import", "--out imported --force"),
        "export" => with("export", "--out out.json --force"),
        "translate" => with("translate", "--to wgsl --out translated --force"),
        "list" | "doctor" | "completions" | "man" | "lsp" | "help" | "try-compile" => {
            let _ = b;
            None
        }
        other => panic!("`eddy {other}` is not called by this test: add how it is called on a project"),
    }
}

#[test]
fn no_command_writes_control_characters_of_a_project() {
    let Some(b) = Bench::with_gpu() else { return };
    let projects = projects(&b);
    let commands: Vec<String> =
        cli::definition().get_subcommands().map(|command| command.get_name().to_owned()).collect();
    assert!(commands.len() > 10, "{commands:?}");
    let mut count = 0;
    for command in &commands {
        for (what, project) in &projects {
            let Some(arguments) = call(command, project, &b) else { continue };
            for json in [false, true] {
                let takes_json =
                    cli::definition().find_subcommand(command).unwrap().get_arguments().any(|a| a.get_id() == "json");
                if json && !takes_json {
                    continue;
                }
                let more = json.then(|| "--json".to_owned());
                let run = run(b.command().args(arguments.iter().chain(&more)));
                assert_safe(&run, &format!("{command}, {what}, json: {json}"));
                count += 1;
            }
        }
    }
    assert!(count > 200, "{count} runs");
}

#[test]
fn arguments_and_missing_files_are_escaped() {
    let b = Bench::new();
    for arguments in [
        vec!["check".to_owned(), format!("--{HOSTILE}")],
        vec![format!("{HOSTILE}.png")],
        vec!["render".into(), "--size".into(), HOSTILE.into(), "x".into()],
        vec!["check".into(), format!("{HOSTILE}/missing.glsl"), FORGED.into()],
        vec!["render".into(), "x".into(), "--mouse".into(), HOSTILE.into(), "--out".into(), "a.png".into()],
        vec!["import".into(), FORGED.into(), "--out".into(), HOSTILE.into()],
    ] {
        let run = run(b.command().args(&arguments).env("DISPLAY", "").env_remove("WAYLAND_DISPLAY"));
        assert_safe(&run, &format!("{arguments:?}"));
    }
}

#[test]
#[cfg(unix)]
fn a_checkpoint_is_not_written_through_a_link_out_of_its_folder() {
    let Some(b) = Bench::with_gpu() else { return };
    b.write("p/buffer_a.glsl", "#iChannel0 \"self\"\nvoid mainImage(out vec4 o, in vec2 p) { o = texelFetch(iChannel0, ivec2(p), 0) + 0.1; }\n");
    b.write(
        "p/image.glsl",
        "#iChannel0 \"buffer_a\"\nvoid mainImage(out vec4 o, in vec2 p) { o = texelFetch(iChannel0, ivec2(p), 0); }\n",
    );
    b.write("victim", "precious");
    fs::create_dir(b.path("states")).unwrap();
    std::os::unix::fs::symlink("../victim", b.path("states/p_000002.eddystate")).unwrap();
    let run = b.line("render p --size 8x8 --frames 4 --checkpoint-every 2 --checkpoints states --out o.png").expect(2);
    assert!(run.err.contains("p_000002.eddystate") && run.err.contains("a link leads out of"), "{}", run.err);
    assert_eq!(b.bytes("victim"), b"precious");
}
