//! Rules for sources that neither the compiler nor the boundaries of the packages enforce: which code may access
//! files, the environment and the clock, which modules of the root package may name which others, the order of the
//! compiler's stages, and the length of a file.
//!
//! The rules work on tokens, not on lines, so that comments and strings never count and a path that is broken over
//! lines always does. A rule that finds nothing because of a bug is worse than none, so every rule is also tested with
//! a violation.

mod docs;
mod pages;
mod paths;
mod texts;
mod threads;
mod words;

use paths::Named;
use proc_macro2::{Delimiter, Spacing, TokenStream, TokenTree};
use std::{
    collections::BTreeSet,
    fs,
    path::{Path, PathBuf},
};

/// The packages, each in the folder of its name, and the modules of the root package.
const LAYERS: &[&str] = &[
    "signal",
    "audio",
    "texture",
    "diag",
    "project",
    "control",
    "video",
    "media",
    "glsl",
    "graph",
    "gpu",
    "engine",
    "background",
    "playback",
    "film",
    "translate",
    "web",
    "debugger",
    "metrics",
    "tune",
    "session",
    "lab",
    "lsp",
    "cli",
    "gui",
    "main",
];

/// Modules of the root package, and the other modules and packages that each must not name.
const ROOT: &[(&str, &[&str])] = &[
    ("cli", &["gui"]),
    ("gui", &["cli"]),
    (
        "main",
        &[
            "diag",
            "project",
            "media",
            "glsl",
            "graph",
            "gpu",
            "engine",
            "playback",
            "film",
            "debugger",
            "session",
            "lab",
            "translate",
            "web",
            "lsp",
        ],
    ),
];

/// Stages of the compiler, and those that each must not name: a program goes from one stage to the next and never
/// back.
const STAGES: &[(&str, &[&str])] = &[
    ("ir", &["hir", "check", "lower", "opt", "emit", "naga"]),
    ("lower", &["opt", "emit", "naga"]),
    ("opt", &["hir", "check", "lower", "emit", "naga"]),
    ("emit", &["hir", "check", "lower", "opt"]),
];

/// Dependencies of the root package that only some of its modules may name.
const CRATES: &[(&[&str], &[&str])] = &[
    (&["egui", "egui_winit", "egui_wgpu", "egui_plot", "winit", "rfd", "wgpu"], &["gui"]),
    (&["clap"], &["cli"]),
    (&["anyhow"], &["cli", "main"]),
];

/// Names by which code accesses the environment outside, and the layers that must not use them. Durations may be
/// measured (`Instant`) by code that reports them, front ends and the lab; the devices of `audio` are driven by them.
/// The time of day is read in `playback` and `session`. The lab does not read environment variables, because its
/// results must be the same on two machines.
const OUTSIDE: &[(&[&str], &[&str])] = &[
    (
        &["SystemTime", "Zoned"],
        &[
            "signal",
            "audio",
            "control",
            "texture",
            "diag",
            "project",
            "media",
            "glsl",
            "graph",
            "gpu",
            "engine",
            "background",
            "film",
            "translate",
            "web",
            "debugger",
            "lab",
            "lsp",
            "cli",
            "gui",
            "main",
        ],
    ),
    (
        &["Instant"],
        &[
            "signal",
            "texture",
            "diag",
            "project",
            "media",
            "glsl",
            "graph",
            "gpu",
            "engine",
            "film",
            "translate",
            "web",
            "lsp",
        ],
    ),
    (
        &["env"],
        &[
            "signal",
            "audio",
            "control",
            "texture",
            "diag",
            "glsl",
            "graph",
            "gpu",
            "engine",
            "background",
            "film",
            "debugger",
            "lab",
            "lsp",
        ],
    ),
    (
        &["fs", "File", "OpenOptions"],
        &[
            "signal",
            "audio",
            "control",
            "texture",
            "diag",
            "glsl",
            "graph",
            "gpu",
            "engine",
            "background",
            "film",
            "translate",
            "web",
            "debugger",
            "lsp",
        ],
    ),
];

/// The files that may start a render pass without `Gpu::pass`, which works around a driver's bug: that function
/// itself, and the window's one pass, which egui draws.
const RENDER_PASS_FILES: &[&str] = &["gpu/pass.rs", "gui/back_buffer/mod.rs"];

const MAX_FILE_LINES: usize = 600;

/// The maximum number of lines of tests in the file that they test.
const MAX_INNER_TEST_LINES: usize = 100;

#[derive(Debug, PartialEq, Eq, Clone)]
enum Token {
    Word(String),
    Sign(char),
    /// `::`
    Path,
}

impl Token {
    fn is(&self, word: &str) -> bool {
        matches!(self, Token::Word(w) if w == word)
    }
}

/// Returns words and signs of a Rust text with their lines, without comments, literals and lifetimes.
fn tokens(stream: TokenStream, out: &mut Vec<(Token, usize)>) {
    // A colon or the tick of a lifetime that the next token touches, otherwise a blank.
    let mut last = ' ';
    for tree in stream {
        let line = tree.span().start().line;
        let before = std::mem::replace(&mut last, ' ');
        match tree {
            TokenTree::Ident(_) if before == '\'' => {}
            TokenTree::Ident(word) => out.push((Token::Word(word.to_string()), line)),
            TokenTree::Punct(sign) if sign.as_char() == '\'' => last = '\'',
            TokenTree::Punct(sign) if before == ':' && sign.as_char() == ':' => {
                out.pop();
                out.push((Token::Path, line));
            }
            TokenTree::Punct(sign) => {
                if sign.spacing() == Spacing::Joint {
                    last = sign.as_char();
                }
                out.push((Token::Sign(sign.as_char()), line));
            }
            TokenTree::Group(group) => {
                let (open, close) = match group.delimiter() {
                    Delimiter::Brace => ('{', '}'),
                    Delimiter::Bracket => ('[', ']'),
                    Delimiter::Parenthesis => ('(', ')'),
                    Delimiter::None => (' ', ' '),
                };
                out.push((Token::Sign(open), line));
                tokens(group.stream(), out);
                out.push((Token::Sign(close), group.span_close().start().line));
            }
            TokenTree::Literal(_) => {}
        }
    }
}

/// Returns every top-level module that a text names, with the line: by `crate::x`, `crate::{x, y::z}`, `eddy::x`, or
/// enough `super::`s. `depth` is the number of modules that the file is deep (1 for `src/cli/mod.rs`, 2 for
/// `src/cli/args.rs`).
fn named_modules(named: &[Named], depth: usize) -> Vec<(String, usize)> {
    let top = |named: &Named| {
        let ups = named.segments.iter().take_while(|s| *s == "super").count();
        let is_top = matches!(named.segments[0].as_str(), "crate" | "eddy") || ups >= depth + named.within.len();
        is_top.then(|| named.segments.get(ups.max(1)).map(|name| (name.clone(), named.line))).flatten()
    };
    named.iter().filter_map(top).collect()
}

/// Returns the violations in one file; `path` is relative to `src/`.
fn violations(path: &str, text: &str) -> Vec<String> {
    let stream: TokenStream = text.parse().unwrap_or_else(|error| panic!("src/{path}: {error}"));
    let named = syn::parse_file(text).map_or_else(|_| paths::of_tokens(stream.clone()), |file| paths::of_file(&file));
    let tokens = {
        let mut all = Vec::new();
        tokens(stream, &mut all);
        all
    };
    let parts: Vec<&str> = path.trim_end_matches(".rs").split('/').filter(|p| !matches!(*p, "mod" | "lib")).collect();
    let layer = parts.first().copied().unwrap_or("lib");
    let mut found = Vec::new();
    let mut report = |line: usize, what: String| found.push(format!("src/{path}:{line}: {what}"));

    let lines = text.lines().count();
    if lines > MAX_FILE_LINES {
        report(lines, format!("{lines} lines; split the file: the limit is {MAX_FILE_LINES}"));
    }
    let inner = text.lines().position(|line| line == "mod tests {").map_or(0, |first| lines - first);
    if inner > MAX_INNER_TEST_LINES {
        report(lines - inner + 1, format!("{inner} lines of tests; more than {MAX_INNER_TEST_LINES} go into tests.rs"));
    }
    // Tests may read files.
    let is_test = path.contains("/tests/") || path.ends_with("tests.rs") || path == "gpu/testing.rs";
    // Examples are separate programs.
    if layer == "lib" || parts.get(1) == Some(&"examples") {
        return found;
    }
    if !LAYERS.contains(&layer) {
        report(1, format!("`{layer}` is not a layer: add it to tests/it/layers and to src/lib.rs"));
        return found;
    }
    let root = ROOT.iter().find(|(name, _)| *name == layer);
    if let Some((_, forbidden)) = root {
        for (name, line) in named_modules(&named, parts.len()) {
            if forbidden.contains(&name.as_str()) {
                report(line, format!("`{layer}` may not name `{name}`"));
            }
        }
    }
    let stage = parts.get(1).filter(|_| layer == "glsl" && !is_test);
    if let Some((stage, forbidden)) = stage.and_then(|stage| STAGES.iter().find(|(name, _)| name == stage)) {
        for name in named.iter().filter(|name| name.segments.len() > 1) {
            for word in name.segments.iter().filter(|word| forbidden.contains(&word.as_str())) {
                report(name.line, format!("`glsl/{stage}` may not name `{word}`"));
            }
        }
    }
    for (i, (token, line)) in tokens.iter().enumerate() {
        let Token::Word(word) = token else { continue };
        if let Some((_, may)) = CRATES.iter().find(|(names, _)| names.contains(&word.as_str()))
            && root.is_some()
            && !may.contains(&layer)
        {
            report(*line, format!("only {} may name `{word}`", may.join(", ")));
        }
        // `env!("…")` is evaluated at compile time; a variable or a method may have any name.
        let is_a_path = |n: usize| matches!(tokens.get(n), Some((Token::Path, _)));
        let is_named = is_a_path(i + 1) || (i > 0 && (is_a_path(i - 1) || tokens[i - 1].0.is("use")));
        // Words of the standard library that may also be the name of a module of Eddy.
        let is_of_std = || {
            let statement =
                tokens[..i].iter().rposition(|(t, _)| matches!(t, Token::Sign(';' | '}'))).map_or(0, |n| n + 1);
            let through = i >= 2 && is_a_path(i - 1) && (tokens[i - 2].0.is("std") || tokens[i - 2].0.is("fs"));
            let used = tokens.get(statement).is_some_and(|t| t.0.is("use"))
                && tokens.get(statement + 1).is_some_and(|t| t.0.is("std"));
            through || used
        };
        if let Some((names, never)) = OUTSIDE.iter().find(|(names, _)| names.contains(&word.as_str()))
            && never.contains(&layer)
            && !is_test
            && if names.contains(&"env") || names.contains(&"fs") { is_of_std() } else { is_named }
        {
            report(*line, format!("`{layer}` may not reach outside through `{word}`"));
        }
        if word == "static" {
            let item: Vec<&str> = tokens[i + 1..]
                .iter()
                .take_while(|(t, _)| !matches!(t, Token::Sign('=' | ';' | '{')))
                .filter_map(|(t, _)| if let Token::Word(w) = t { Some(w.as_str()) } else { None })
                .collect();
            let is_state = |w: &&str| {
                ["mut", "Mutex", "RwLock", "OnceLock", "Cell", "RefCell", "OnceCell"].contains(w)
                    || w.starts_with("Atomic")
            };
            if item.iter().any(is_state) {
                report(*line, "process-wide state: pass it as an argument".into());
            }
        }
        if word == "path" && i >= 2 && tokens[i - 1].0 == Token::Sign('[') && tokens[i - 2].0 == Token::Sign('#') {
            report(*line, "the path of a module is that of its name: no `#[path]`".into());
        }
        if word == "begin_render_pass" && !RENDER_PASS_FILES.contains(&path) {
            report(*line, "a pass is encoded with `Gpu::pass`".into());
        }
        // Lowering defines the meaning of the language; adaptations to drivers are rules over the IR.
        if word == "driver" && parts.starts_with(&["glsl", "lower"]) {
            report(*line, "`glsl/lower` may not ask for a driver".into());
        }
        if word == "thread_local" {
            report(*line, "process-wide state: pass it as an argument".into());
        }
        if word == "pub" && tokens.get(i + 1).is_some_and(|(t, _)| t.is("use")) {
            let end = tokens[i..].iter().take_while(|(t, _)| *t != Token::Sign(';'));
            if end.into_iter().any(|(t, _)| *t == Token::Sign('*')) {
                report(*line, "`pub use …::*` hides the names of a module: list them".into());
            }
        }
    }
    found
}

fn sources(folder: &Path, into: &mut Vec<PathBuf>) {
    for entry in fs::read_dir(folder).unwrap_or_else(|e| panic!("{}: {e}", folder.display())) {
        let path = entry.unwrap().path();
        if path.is_dir() {
            sources(&path, into);
        } else if path.extension().is_some_and(|e| e == "rs") {
            into.push(path);
        }
    }
}

fn sources_of_eddy() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("src")
}

/// Returns the texts of all source files in a folder, by their relative paths.
fn source_texts(root: &Path) -> Vec<(String, String)> {
    let mut files = Vec::new();
    sources(root, &mut files);
    assert!(files.len() > 20, "only {} files found under {}", files.len(), root.display());
    let path = |file: &PathBuf| file.strip_prefix(root).unwrap().to_string_lossy().replace('\\', "/");
    files.iter().map(|file| (path(file), fs::read_to_string(file).unwrap())).collect()
}

#[test]
fn every_file_follows_the_rules_of_its_layer() {
    let texts = source_texts(&sources_of_eddy());
    let mut layers = BTreeSet::new();
    let mut found = Vec::new();
    for (path, text) in &texts {
        layers.insert(path.split(['/', '.']).next().unwrap().to_owned());
        found.extend(violations(path, text));
    }
    for layer in LAYERS {
        assert!(layers.contains(*layer), "the rules name `{layer}`, which has no file");
    }
    assert!(found.is_empty(), "{} violations:\n{}", found.len(), found.join("\n"));
}

/// Returns the dependencies of a manifest that no source of its package names.
fn unused(manifest: &str, sources: &[String]) -> Vec<String> {
    let manifest: toml::Table = manifest.parse().unwrap();
    let named = |name: &str| {
        let name = name.replace('-', "_");
        let is_named_in =
            |text: &String| text.split(|c: char| c != '_' && !c.is_alphanumeric()).any(|word| word == name);
        sources.iter().any(is_named_in)
    };
    let listed = manifest.get("dependencies").and_then(|listed| listed.as_table());
    listed.into_iter().flatten().map(|(name, _)| name.clone()).filter(|name| !named(name)).collect()
}

/// Cargo rejects circular dependencies of packages, but not unused ones.
#[test]
fn every_dependency_of_a_package_is_used() {
    let root = sources_of_eddy();
    let texts = source_texts(&root);
    let mut packages = 0;
    for layer in LAYERS {
        let Ok(manifest) = fs::read_to_string(root.join(layer).join("Cargo.toml")) else { continue };
        let is_product = |path: &str| !path.contains("tests") && !path.contains("/examples/");
        let own = texts.iter().filter(|(path, _)| path.starts_with(&format!("{layer}/")) && is_product(path));
        let own: Vec<String> = own.map(|(_, text)| text.clone()).collect();
        assert_eq!(unused(&manifest, &own), [""; 0], "{layer}");
        packages += 1;
    }
    assert!(packages > 8, "only {packages} manifests were read");
    let planted = "[dependencies]\neddy-gpu.workspace = true\nlog.workspace = true\n";
    assert_eq!(unused(planted, &["use log::warn; struct my_eddy_gpu;".into()]), ["eddy-gpu"]);
}

/// Returns the files of a folder of tests that its `main.rs` does not declare, so that they are not run.
fn undeclared(main: &str, files: &[String]) -> Vec<String> {
    let is_declared = |name: &str| main.lines().any(|line| line.trim() == format!("mod {name};"));
    let names = files.iter().filter_map(|file| file.strip_suffix(".rs"));
    names.filter(|name| *name != "main" && !is_declared(name)).map(str::to_owned).collect()
}

#[test]
fn every_test_file_is_declared() {
    for folder in ["tests/it", "tests/window"] {
        let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join(folder);
        let names = fs::read_dir(&folder).unwrap().map(|entry| entry.unwrap().file_name().into_string().unwrap());
        let main = fs::read_to_string(folder.join("main.rs")).unwrap();
        let names: Vec<String> = names.collect();
        assert_eq!(undeclared(&main, &names), [""; 0], "{}", folder.display());
        // The check works: a missing declaration is found.
        let removed = names.iter().find_map(|name| name.strip_suffix(".rs").filter(|name| *name != "main")).unwrap();
        assert_eq!(undeclared(&main.replace(&format!("mod {removed};"), ""), &names), [removed]);
    }
}

/// The script lists them, because it runs the tests of the window in parallel with the others.
#[test]
fn every_test_binary_is_run_by_the_script() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let script = fs::read_to_string(root.join("scripts/test")).unwrap();
    let entries = fs::read_dir(root.join("tests")).unwrap().map(|entry| entry.unwrap().path());
    let binaries = entries.filter(|path| path.extension().is_some_and(|e| e == "rs") || path.join("main.rs").exists());
    let names: Vec<String> = binaries.map(|path| path.file_stem().unwrap().to_str().unwrap().to_owned()).collect();
    assert!(names.len() >= 6, "{names:?}");
    let named: Vec<&str> = script.split_whitespace().collect();
    let is_run = |name: &&String| named.windows(2).any(|pair| pair == ["--test", name.as_str()]);
    assert_eq!(names.iter().find(|name| !is_run(name)), None);
}

/// Returns the violations in the paths of modules; `paths` are relative to `src/`.
fn misplaced(paths: &[&str]) -> Vec<String> {
    let has_files =
        |folder: &str| paths.iter().any(|p| p.strip_prefix(folder).is_some_and(|rest| rest.starts_with('/')));
    let next_to_folder = paths.iter().filter(|p| has_files(p.trim_end_matches(".rs")));
    let next_to_folder =
        next_to_folder.map(|p| format!("src/{p} is next to its folder: make it {}/mod.rs", p.trim_end_matches(".rs")));
    let is_named = |p: &&&str| p.ends_with("_tests.rs");
    let named = paths.iter().filter(is_named).map(|p| format!("src/{p}: tests of a module are tests.rs in its folder"));
    next_to_folder.chain(named).collect()
}

#[test]
fn modules_have_the_expected_paths() {
    let texts = source_texts(&sources_of_eddy());
    let paths: Vec<&str> = texts.iter().map(|(path, _)| path.as_str()).collect();
    let found = misplaced(&paths);
    assert!(found.is_empty(), "{}", found.join("\n"));
    let planted = ["glsl/parse.rs", "glsl/parse/expr.rs", "glsl/parser.rs", "gpu/pass_tests.rs", "gpu/pass.rs"];
    assert_eq!(misplaced(&planted).len(), 2, "{:?}", misplaced(&planted));
}

#[test]
fn planted_violations_are_caught() {
    let planted = [
        ("cli/args.rs", "use crate::gui;", "`cli` may not name `gui`"),
        ("cli/args.rs", "use crate::{diag, gui::run};", "`cli` may not name `gui`"),
        (
            "cli/args.rs",
            "use crate::{\n    diag::{a, b},\n    gui::run,\n};",
            "src/cli/args.rs:3: `cli` may not name `gui`",
        ),
        ("gui/mod.rs", "fn f() { crate::cli::main() }", "`gui` may not name `cli`"),
        ("gui/a/b.rs", "use super::super::super::cli::x;", "`gui` may not name `cli`"),
        ("gui/a.rs", "mod tests { use super::super::super::cli; }", "`gui` may not name `cli`"),
        ("main.rs", "fn main() { eddy::engine::run() }", "`main` may not name `engine`"),
        ("lobby/mod.rs", "", "`lobby` is not a layer"),
        ("cli/mod.rs", "fn f(w: winit::window::Window) {}", "only gui may name `winit`"),
        ("gui/mod.rs", "fn f() -> anyhow::Result<()> { Ok(()) }", "only cli, main may name `anyhow`"),
        ("glsl/lower/expr.rs", "use naga::Expression;", "`glsl/lower` may not name `naga`"),
        ("glsl/lower/expr.rs", "use crate::{hir, opt::PASSES};", "`glsl/lower` may not name `opt`"),
        (
            "glsl/lower/expr.rs",
            "fn f(s: Source) -> bool { s.driver.nan_angle }",
            "`glsl/lower` may not ask for a driver",
        ),
        ("glsl/opt/cse.rs", "fn f(id: crate::hir::ExprId) {}", "`glsl/opt` may not name `hir`"),
        ("glsl/emit/mod.rs", "use super::hir::Module;", "`glsl/emit` may not name `hir`"),
        ("glsl/ir/mod.rs", "use super::emit;", "`glsl/ir` may not name `emit`"),
        ("cli/bench.rs", "use {std::io, wgpu};", "only gui may name `wgpu`"),
        ("engine/run.rs", "let s = std::fs::read(p);", "may not reach outside through `fs`"),
        ("engine/run.rs", "use std::{env, fs};\nlet x = env::var(\"A\");", "may not reach outside through `env`"),
        ("glsl/lib.rs", "use std::fs;", "may not reach outside through `fs`"),
        ("engine/run.rs", "let now = std::time::SystemTime::now();", "may not reach outside through `SystemTime`"),
        ("cli/bench.rs", "let now = jiff::Zoned::now();", "may not reach outside through `Zoned`"),
        ("engine/run.rs", "let began = std::time::Instant::now();", "may not reach outside through `Instant`"),
        ("lab/run.rs", "let now = SystemTime::now();", "may not reach outside through `SystemTime`"),
        ("lab/shard.rs", "let x = std::env::var(name);", "may not reach outside through `env`"),
        ("graph/mod.rs", "let now = Instant::now();", "may not reach outside through `Instant`"),
        ("media/mod.rs", "static CACHE: Mutex<u8> = Mutex::new(0);", "process-wide state"),
        ("media/mod.rs", "pub(crate) static mut COUNT: u8 = 0;", "process-wide state"),
        ("media/mod.rs", "thread_local! { static X: u8 = 0; }", "process-wide state"),
        ("media/mod.rs", "pub use keyboard::*;", "hides the names of a module"),
        ("engine/run.rs", "let pass = encoder.begin_render_pass(&descriptor);", "encoded with `Gpu::pass`"),
        (
            "engine/run.rs",
            "#[cfg(test)]\n#[path = \"run_tests.rs\"]\nmod tests;",
            "src/engine/run.rs:2: the path of a module",
        ),
    ];
    for (path, text, message) in planted {
        let found = violations(path, text);
        assert!(found.iter().any(|v| v.contains(message)), "{path}: {text}\nshould say: {message}\nsaid: {found:?}");
    }
    let long = "\n".repeat(MAX_FILE_LINES + 1);
    assert!(violations("cli/mod.rs", &long).iter().any(|v| v.contains("split the file")));
    let tests = format!("mod tests {{{}}}", "\n".repeat(MAX_INNER_TEST_LINES + 1));
    assert!(violations("cli/mod.rs", &tests).iter().any(|v| v.contains("lines of tests")));
}

#[test]
fn code_that_only_resembles_a_violation_is_accepted() {
    let accepted = [
        ("graph/mod.rs", "// use crate::gpu;\n/* crate::gpu /* nested */ crate::gpu */ fn f() {}"),
        ("graph/mod.rs", "const A: &str = \"crate::gpu \\\" wgpu::Device\";"),
        ("graph/mod.rs", "const A: &str = r#\"crate::gpu \" egui\"#; const B: char = '\"'; const C: char = '\\'';"),
        ("graph/mod.rs", "fn f<'a>(x: &'a str) -> &'static str { x }"),
        ("gui/panels/mod.rs", "use super::cli_text;"),
        ("gui/panels/mod.rs", "mod cli; use super::super::engine; use crate::session;"),
        ("gui/mod.rs", "mod tests { use super::cli; }"),
        ("engine/run.rs", "let version = env!(\"CARGO_PKG_VERSION\");"),
        ("engine/run.rs", "fn f(env: u8) -> u8 { self.fs + env }"),
        ("lab/cost.rs", "use std::{fs, time::Instant}; use crate::{engine, gpu};"),
        ("cli/args.rs", "use jiff::civil::DateTime; use std::{fs, time::Instant};"),
        ("project/presets.rs", "static NAMES: LazyLock<Vec<&'static str>> = LazyLock::new(read);"),
        ("project/presets.rs", "static PRESETS: Dir<'_> = include_dir!(\"presets\");"),
        ("lib.rs", "pub mod gui;"),
    ];
    for (path, text) in accepted {
        assert_eq!(violations(path, text), Vec::<String>::new(), "{path}: {text}");
    }
}
