//! Control characters of untrusted text never reach the terminal, in any command and from any source: names of folders
//! and files, keys, values, code and messages. JSON stays valid JSON.

use crate::support::{gpu, program::Bench};
use eddy::diag::is_terminal_control;
use std::{fs, process::Stdio};

/// Sequences that a terminal or a line reader interprets.
const CONTROLS: [(&str, &str); 22] = [
    ("erase", "\u{1b}[2J"),
    ("title", "\u{1b}]0;OWNED\u{7}"),
    ("reset", "\u{1b}c"),
    ("bell", "\u{7}"),
    ("backspace", "\u{8}"),
    ("carriage return", "\rFORGED"),
    ("line break", "\nFORGED: A=1\n"),
    ("vertical tab", "\u{b}"),
    ("form feed", "\u{c}"),
    ("shift out", "\u{e}"),
    ("delete", "\u{7f}"),
    ("next line", "\u{85}FORGED"),
    ("device control string", "\u{90}q"),
    ("control sequence of 8 bits", "\u{9b}31m"),
    ("operating system command of 8 bits", "\u{9d}0;OWNED\u{9c}"),
    ("line separator", "\u{2028}FORGED"),
    ("paragraph separator", "\u{2029}FORGED"),
    ("override", "\u{202e}"),
    ("isolate", "\u{2066}\u{2069}"),
    ("left-to-right mark", "\u{200e}"),
    ("right-to-left mark", "\u{200f}"),
    ("Arabic letter mark", "\u{61c}"),
];

const IMAGE: &str = "void mainImage(out vec4 o, in vec2 p) { o = vec4(1); }\n";

/// Returns the files of a project with the text in one place, and the name of its folder.
type Place = fn(&str) -> (String, Vec<(String, String)>);

fn code(text: String) -> (String, Vec<(String, String)>) {
    ("p".into(), vec![("image.glsl".into(), text)])
}

/// Returns a project with this `eddy.toml`.
fn manifest(text: String) -> (String, Vec<(String, String)>) {
    ("p".into(), vec![("eddy.toml".into(), text), ("image.glsl".into(), IMAGE.into())])
}

/// Returns a TOML string.
fn quoted(text: &str) -> String {
    format!("\"{}\"", text.chars().map(|c| format!("\\U{:08x}", u32::from(c))).collect::<String>())
}

const PLACES: [(&str, Place); 24] = [
    ("folder", |c| (format!("p{c}q"), vec![("image.glsl".into(), IMAGE.into())])),
    ("folder with an error", |c| (format!("p{c}q"), vec![("image.glsl".into(), "void mainImage() { o = ; }".into())])),
    ("empty folder", |c| (format!("p{c}q"), Vec::new())),
    ("unused file", |c| {
        ("p".into(), vec![("image.glsl".into(), IMAGE.into()), (format!("buffer_{c}.glsl"), "x".into())])
    }),
    ("only file", |c| ("p".into(), vec![(format!("im{c}age.glsl"), "int x = nope;".into())])),
    ("code", |c| code(format!("void mainImage(out vec4 o, in vec2 p) {{ /* {c} */ o = nope; }}"))),
    ("code before a mistake", |c| code(format!("{c} void mainImage(out vec4 o, in vec2 p) {{ o = nope; }}"))),
    ("#error", |c| code(format!("#error a{c}b\n{IMAGE}"))),
    ("#include", |c| code(format!("#include \"a{c}b.glsl\"\n{IMAGE}"))),
    ("#extension", |c| code(format!("#extension a{c}b : require\n{IMAGE}"))),
    ("#iUniform", |c| code(format!("#iUniform float a{c}b = 1.0 in {{ 0.0, 1.0 }}\n{IMAGE}"))),
    ("#iChannel", |c| code(format!("#iChannel0 \"file://a{c}b.png\"\n{IMAGE}"))),
    ("#pragma and directive", |c| code(format!("#pragma a{c}b\n#bad{c}\n{IMAGE}"))),
    ("//@ comment", |c| code(format!("//@probe {c}\n//@assert a{c}\n{IMAGE}"))),
    ("dialect", |c| manifest(format!("dialect = {}\n[passes.image]\n", quoted(c)))),
    ("key", |c| manifest(format!("{} = 1\n[passes.image]\n", quoted(c)))),
    ("pass", |c| manifest(format!("[passes.image]\n[passes.{}]\n", quoted(c)))),
    ("key of a pass", |c| manifest(format!("[passes.image]\n{} = 1\n", quoted(c)))),
    ("file of a pass", |c| manifest(format!("[passes.image]\nfile = {}\n", quoted(&format!("a{c}.glsl"))))),
    ("format", |c| manifest(format!("[passes.image]\nformat = {}\n", quoted(c)))),
    ("input", |c| manifest(format!("[passes.image]\nchannel0 = {{ kind = {} }}\n", quoted(c)))),
    ("file of an input", |c| {
        manifest(format!("[passes.image]\nchannel0 = {{ kind = \"texture\", file = {} }}\n", quoted(c)))
    }),
    ("uniform", |c| manifest(format!("[passes.image]\n[uniforms]\n{} = {}\n", quoted(c), quoted(c)))),
    ("damaged manifest", |c| manifest(format!("[passes.image]\nx = {c}\n"))),
];

/// Returns the error in an output, if any.
fn leak(bytes: &[u8]) -> Option<String> {
    let Ok(text) = std::str::from_utf8(bytes) else { return Some("it is not UTF-8".into()) };
    let is_leak = |c: &char| !matches!(c, '\n' | '\t') && is_terminal_control(*c);
    if let Some(c) = text.chars().find(is_leak) {
        return Some(format!("it has {}", c.escape_unicode()));
    }
    text.lines().any(|line| line.starts_with("FORGED")).then(|| "a line is forged".into())
}

/// Runs Eddy, and returns the error in its output, if any.
fn leak_of(bench: &Bench, arguments: &[&str]) -> Option<String> {
    let mut command = bench.command();
    command.args(arguments).stdin(Stdio::null()).env("XDG_CONFIG_HOME", bench.path("config"));
    let output = command.env_remove("DISPLAY").env_remove("WAYLAND_DISPLAY").output().unwrap();
    let json = arguments.contains(&"--json").then(|| String::from_utf8_lossy(&output.stdout).into_owned());
    let is_json = |line: &str| serde_json::from_str::<serde_json::Value>(line).is_ok();
    let broken = json.filter(|json| !json.lines().all(is_json)).map(|_| "a line is not JSON".into());
    let found = leak(&output.stdout).or_else(|| leak(&output.stderr)).or(broken)?;
    Some(format!("{arguments:?}: {found}\n{:?}", String::from_utf8_lossy(&[output.stdout, output.stderr].concat())))
}

/// Writes a project below a folder. Returns its path.
fn write(bench: &Bench, below: &str, (folder, files): (String, Vec<(String, String)>)) -> String {
    let path = format!("{below}/{folder}");
    fs::create_dir_all(bench.path(&path)).unwrap();
    files.iter().for_each(|(name, text)| fs::write(bench.path(&path).join(name), text).unwrap());
    path
}

#[test]
fn no_control_character_of_a_project_reaches_the_terminal() {
    let bench = Bench::new();
    let mut projects = Vec::new();
    for (n, (_, control)) in CONTROLS.iter().enumerate() {
        for (m, (_, place)) in PLACES.iter().enumerate() {
            projects.push(write(&bench, &format!("{n}-{m}"), place(control)));
        }
    }
    let mut leaks = Vec::new();
    for option in [None, Some("--json")] {
        for part in projects.chunks(PLACES.len()) {
            let part = part.iter().map(String::as_str);
            let arguments: Vec<&str> = ["check"].into_iter().chain(option).chain(part).collect();
            leaks.extend(leak_of(&bench, &arguments));
        }
    }
    assert!(leaks.is_empty(), "{} calls leak:\n{}", leaks.len(), leaks.join("\n"));
}

/// Returns the commands in a help text, which clap generates from the definitions.
fn commands(bench: &Bench, of: &[&str]) -> Vec<String> {
    let output = bench.command().args(of).arg("--help").output().unwrap();
    let help = String::from_utf8(output.stdout).unwrap();
    let rows = help.lines().skip_while(|line| *line != "Commands:").skip(1).take_while(|line| line.starts_with("  "));
    let names = rows.filter(|line| !line.starts_with("   ")).filter_map(|line| line.split_whitespace().next());
    names.map(str::to_owned).collect()
}

/// Returns the calls of a command with a project that can be drawn and one that cannot.
fn calls<'a>(command: &str, good: &'a str, bad: &'a str, out: &'a str) -> Vec<Vec<&'a str>> {
    let small = ["--size", "8x8"];
    let with = |words: &[&'a str]| words.iter().chain(&small).copied().collect::<Vec<_>>();
    match command {
        "render" => {
            // A progress bar prints its own control codes.
            let call = |style| with(&["render", good, bad, "--out", out, "--progress", style]);
            let mut all: Vec<_> = ["none", "plain", "openjd"].map(call).into();
            all.push(with(&["render", good, bad, "--json"]));
            all.push(with(&["render", good, "--plan"]));
            all.push(with(&["render", good, "--out", "none/x.png"]));
            all.push(with(&["render", good, good, "--out", out]));
            all
        }
        "tune" => {
            vec![vec!["tune", good, "--list"], vec!["tune", bad, "--list"], with(&["tune", good]), with(&["tune", bad])]
        }
        "probe" => [good, bad].map(|p| with(&["probe", p, "--at", "image:2:7"])).into(),
        "trace" => [good, bad].map(|p| with(&["trace", p, "--pixel", "1,1"])).into(),
        "compare" => vec![with(&["compare", good, good]), with(&["compare", good, bad])],
        "check" => vec![vec!["check", good, bad], vec!["check", good, "--dump-ir"], vec!["check", "--json", good, bad]],
        "bench" => vec![with(&["bench", good, bad, "--frames", "1"])],
        "unused" => vec![with(&["unused", good, bad, "--frames", "1"])],
        "lab" => vec![vec!["lab", "--list"], vec!["lab", good, "--out", out]],
        "lab merge" => vec![vec!["lab", "merge", good, "--out", out]],
        "lab precision" => vec![with(&["lab", "precision", good, bad, "--frames", "1"])],
        "lab stability" => vec![vec!["lab", "stability", bad]],
        "list" => vec![vec!["list"]],
        "import" => vec![vec!["import", good, "--out", out], vec!["import", bad, "--out", good]],
        "export" => [good, bad].map(|p| vec!["export", p, "--out", "x.html", "--force"]).into(),
        "convert" => [good, bad].map(|p| vec!["convert", p, "--out", out]).into(),
        "translate" => [good, bad].map(|p| vec!["translate", p, "--to", "wgsl", "--force"]).into(),
        "lsp" => vec![vec!["lsp"]],
        "doctor" => vec![vec!["doctor"], vec!["doctor", "--json"]],
        "completions" => vec![vec!["completions", "bash"], vec!["completions", bad]],
        "man" => vec![vec!["man", "--out", out], vec!["man", "--out", "file\u{1b}[2J/x"]],
        "help" => vec![vec!["help", bad]],
        other => panic!("eddy {other} is new: call it here with a hostile project"),
    }
}

#[test]
fn no_command_prints_control_characters_of_a_hostile_project() {
    let bench = Bench::new();
    let all: String = CONTROLS.iter().map(|(_, control)| *control).collect();
    let drawable = "void mainImage(out vec4 o, in vec2 p) {\n  o = vec4(p, 0, 1);\n}\n".to_owned();
    let good = (format!("good{all}"), vec![("image.glsl".into(), drawable)]);
    let good = write(&bench, "1", good);
    let bad = vec![
        ("image.glsl".into(), format!("#error {all}\n{IMAGE}")),
        ("eddy.toml".into(), format!("{} = 1", quoted(&all))),
    ];
    let bad = write(&bench, "2", (format!("bad{all}"), bad));
    let out = format!("out{all}");
    let mut names = commands(&bench, &[]);
    assert!(names.iter().any(|name| name == "render"), "{names:?}");
    let of_lab = commands(&bench, &["lab"]).into_iter().filter(|name| name != "help");
    names.extend(of_lab.map(|name| format!("lab {name}")));
    let draws = ["render", "probe", "trace", "compare", "bench", "unused", "lab", "doctor"];
    let has_gpu = gpu().is_some();
    let mut leaks = Vec::new();
    for name in names {
        if !has_gpu && draws.iter().any(|command| name.starts_with(command)) {
            continue;
        }
        for call in calls(&name, &good, &bad, &out) {
            leaks.extend(leak_of(&bench, &call));
        }
    }
    let drawn = fs::read_dir(bench.path(&out)).is_ok_and(|files| files.count() > 0);
    assert!(drawn || !has_gpu, "the drawable project was not drawn");
    // Usage errors repeat the arguments, which may come from a shell's expansion.
    for call in [vec!["check", "--no\u{1b}[2J"], vec!["\u{9b}31m", "--x"], vec!["render", &good, "--size", &all]] {
        leaks.extend(leak_of(&bench, &call));
    }
    assert!(leaks.is_empty(), "{} calls leak:\n{}", leaks.len(), leaks.join("\n"));
}

/// Files that write to the standard streams directly, and what they write.
const WRITERS: [(&str, &str); 7] = [
    ("cli/terminal.rs", "the writer that escapes"),
    ("cli/leave.rs", "flushes"),
    ("cli/command.rs", "the language server's protocol"),
    ("gui/report.rs", "escaped JSON"),
    ("playback/trial.rs", "a fixed word"),
    ("gpu/testing.rs", "tests"),
    ("glsl/lib.rs", "an example in its docs"),
];

#[test]
fn only_the_escaping_writer_writes_to_the_terminal() {
    let mut todo = vec![std::path::PathBuf::from(concat!(env!("CARGO_MANIFEST_DIR"), "/src"))];
    let (mut found, mut seen) = (Vec::new(), 0);
    while let Some(folder) = todo.pop() {
        for path in fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path()) {
            let name = path.to_string_lossy().rsplit_once("/src/").unwrap().1.to_owned();
            if path.is_dir() {
                todo.extend((!name.ends_with("/examples")).then_some(path));
                continue;
            }
            if !name.ends_with(".rs") || WRITERS.iter().any(|(writer, _)| *writer == name) {
                continue;
            }
            seen += 1;
            let text = fs::read_to_string(&path).unwrap();
            let code = text.split("#[cfg(test)]").next().unwrap();
            // Queries write nothing.
            let code = code.replace("io::stderr().is_terminal()", "").replace("io::stderr().as_raw_handle()", "");
            let words = ["io::stdout()", "io::stderr()", "println!(", "eprint!(", " print!("];
            let is_of_tests = name.ends_with("/tests.rs")
                || name.contains("/tests/")
                || ["gui/editor/cost.rs", "gui/frame/fields.rs"].contains(&&*name);
            if !is_of_tests && words.iter().any(|word| code.contains(word)) {
                found.push(name);
            }
        }
    }
    assert!(seen > 500, "{seen} files");
    assert!(found.is_empty(), "use cli/terminal.rs, which escapes control characters, in {found:?}");
}
