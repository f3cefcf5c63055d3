//! `eddy lsp`: sessions of the protocol compared with stored answers, the built program over its streams, and randomly
//! edited texts compared with `eddy check`.

use crate::support::program::Bench;
use eddy::{lsp::Server, project::limits};
use serde_json::{Value, json};
use std::{
    collections::BTreeSet,
    fmt::Write as _,
    io::{BufRead, BufReader, Read, Write},
    path::Path,
    process::Stdio,
};

/// A session that records what the editor sends and what the server answers.
struct Session {
    server: Server,
    bench: Bench,
    last_id: i32,
    log: String,
}

impl Session {
    fn new(files: &[(&str, &str)]) -> Self {
        let bench = Bench::new();
        files.iter().for_each(|(name, text)| bench.write(name, text));
        let mut session = Self { server: Server::new(), bench, last_id: 0, log: String::new() };
        session.request("initialize", json!({"capabilities": {"general": {"positionEncodings": ["utf-8"]}}}));
        session.notify("initialized", json!({}));
        session
    }

    fn uri(&self, name: &str) -> String {
        format!("file://{}", self.bench.path(name).display())
    }

    fn send(&mut self, message: Value) {
        let mut out = Vec::new();
        self.server.handle(serde_json::from_value(message).unwrap(), &mut out);
        while self.server.idle(&mut out) {}
        let folder = self.uri("");
        for message in out {
            let mut message = serde_json::to_value(message).unwrap();
            if let Some(version) = message.pointer_mut("/result/serverInfo/version") {
                *version = "VERSION".into();
            }
            let text = message.to_string().replace(&folder, "file:///DIR/");
            writeln!(self.log, "<-- {text}").unwrap();
        }
    }

    fn notify(&mut self, method: &str, params: Value) {
        writeln!(self.log, "--> {method}").unwrap();
        self.send(json!({"method": method, "params": params}));
    }

    fn request(&mut self, method: &str, params: Value) {
        self.last_id += 1;
        writeln!(self.log, "--> {} {method}", self.last_id).unwrap();
        self.send(json!({"id": self.last_id, "method": method, "params": params}));
    }

    fn open(&mut self, name: &str, text: &str) {
        let document = json!({"uri": self.uri(name), "languageId": "glsl", "version": 1, "text": text});
        self.notify("textDocument/didOpen", json!({ "textDocument": document }));
    }

    fn request_at(&mut self, method: &str, name: &str, (line, character): (u32, u32), more: Value) {
        let mut params = json!({
            "textDocument": {"uri": self.uri(name)},
            "position": {"line": line, "character": character},
        });
        if let (Some(params), Some(more)) = (params.as_object_mut(), more.as_object()) {
            params.extend(more.clone());
        }
        self.request(method, params);
    }

    fn request_for_document(&mut self, method: &str, name: &str) {
        let range = json!({"start": {"line": 0, "character": 0}, "end": {"line": 999, "character": 0}});
        let params = json!({
            "textDocument": {"uri": self.uri(name)}, "range": range, "context": {"diagnostics": []},
        });
        self.request(method, params);
    }
}

const COMMON: &str = "\
#define TAU (2.0 * 3.14159265)

// A ray that is walked along.
struct Ray {
    vec3 from;
    vec3 to;
};

/* How bright a point is,
   from 0 to 1. */
float brightness(vec2 at, float gain) {
    return gain * length(at) / TAU;
}
";

const IMAGE: &str = "\
#iUniform float speed = 1.0 in { 0.0, 4.0 }
const float LIMIT = 2.0 * TAU;

#ifdef NEVER
float left_out;
#endif

void mainImage(out vec4 fragColor, in vec2 fragCoord) {
    vec2 at = fragCoord / iResolution.xy;
    Ray ray = Ray(vec3(at, 0), vec3(0));
    float b = brightness(at * speed, 0.5);
    fragColor = vec4(ray.from * b, textur2D(iChannel0, at).x);
}
";

fn demo() -> Session {
    let mut session = Session::new(&[("common.glsl", COMMON), ("image.glsl", IMAGE)]);
    session.open("image.glsl", IMAGE);
    session
}

#[test]
fn a_session_of_questions() {
    let mut session = demo();
    for at in [(10, 17), (8, 26), (10, 30), (0, 17)] {
        session.request_at("textDocument/hover", "image.glsl", at, json!({}));
        session.request_at("textDocument/definition", "image.glsl", at, json!({}));
    }
    let all = json!({"context": {"includeDeclaration": true}});
    session.request_at("textDocument/references", "image.glsl", (10, 17), all);
    session.request_at("textDocument/documentHighlight", "image.glsl", (8, 10), json!({}));
    session.request_at("textDocument/signatureHelp", "image.glsl", (10, 35), json!({}));
    session.request_at("textDocument/completion", "image.glsl", (11, 25), json!({}));
    session.request_at("textDocument/prepareRename", "image.glsl", (10, 17), json!({}));
    session.request_at("textDocument/rename", "image.glsl", (10, 17), json!({"newName": "glow"}));
    session.request_at("textDocument/rename", "image.glsl", (10, 30), json!({"newName": "pace"}));
    session.request_at("textDocument/rename", "image.glsl", (10, 30), json!({"newName": "at"}));
    insta::assert_snapshot!(session.log);
}

#[test]
fn a_session_about_whole_texts() {
    let mut session = demo();
    for name in ["image.glsl", "common.glsl"] {
        if name == "common.glsl" {
            session.open(name, COMMON);
        }
        for method in ["documentSymbol", "foldingRange", "semanticTokens/full", "inlayHint", "codeAction", "formatting"]
        {
            session.request_for_document(&format!("textDocument/{method}"), name);
        }
    }
    session.request("workspace/symbol", json!({"query": "bri"}));
    insta::assert_snapshot!(session.log);
}

#[test]
fn a_session_of_edits() {
    let mut session = demo();
    let document = json!({"uri": session.uri("image.glsl"), "version": 2});
    let change = json!({
        "range": {"start": {"line": 11, "character": 35}, "end": {"line": 11, "character": 44}},
        "text": "texture",
    });
    session.notify("textDocument/didChange", json!({"textDocument": document, "contentChanges": [change]}));
    session.open("common.glsl", &COMMON.replace("struct Ray", "struct Line"));
    let document = json!({"uri": session.uri("common.glsl")});
    session.notify("textDocument/didClose", json!({ "textDocument": document }));
    session.request("textDocument/formatting", json!({}));
    session.request("textDocument/unheardOf", json!({}));
    session.request("shutdown", Value::Null);
    insta::assert_snapshot!(session.log);
}

/// A text of megabytes must not produce an answer of gigabytes.
#[test]
fn lists_of_a_document_have_a_limit() {
    let text = "float a;\n".repeat(limits::LSP_ITEMS + 100);
    let mut session = Session::new(&[("many.glsl", &text)]);
    session.open("many.glsl", &text);
    session.log.clear();
    session.request_for_document("textDocument/documentSymbol", "many.glsl");
    assert_eq!(session.log.matches("\"selectionRange\"").count(), limits::LSP_ITEMS);
    session.log.clear();
    session.request_at(
        "textDocument/references",
        "many.glsl",
        (0, 6),
        json!({"context": {"includeDeclaration": true}}),
    );
    assert!(session.log.matches("\"range\"").count() <= limits::LSP_ITEMS);
}

fn framed(message: &Value) -> Vec<u8> {
    let text = message.to_string();
    format!("Content-Length: {}\r\n\r\n{text}", text.len()).into_bytes()
}

#[test]
fn the_program_serves_an_editor_over_its_streams() {
    let b = Bench::new();
    let mut server = b.command().arg("lsp").stdin(Stdio::piped()).stdout(Stdio::piped()).spawn().unwrap();
    let mut input = server.stdin.take().unwrap();
    let mut output = BufReader::new(server.stdout.take().unwrap());
    let mut next = || {
        let mut length = 0;
        loop {
            let mut line = String::new();
            assert_ne!(output.read_line(&mut line).unwrap(), 0, "the server ended");
            match line.trim().strip_prefix("Content-Length: ") {
                Some(number) => length = number.parse().unwrap(),
                None if line.trim().is_empty() => break,
                None => {}
            }
        }
        let mut text = vec![0; length];
        output.read_exact(&mut text).unwrap();
        serde_json::from_slice::<Value>(&text).unwrap()
    };
    input.write_all(b"Content-Length: 5\r\n\r\n{\"a\":").unwrap();
    let parse_error = next();
    assert_eq!((&parse_error["id"], &parse_error["error"]["code"]), (&Value::Null, &json!(-32700)), "{parse_error}");
    // One write, so that the second message is already waiting.
    let mut all = framed(&json!({"jsonrpc": "2.0", "id": 1, "method": "initialize", "params": {"capabilities": {}}}));
    all.extend(framed(&json!({"jsonrpc": "2.0", "method": "initialized", "params": {}})));
    input.write_all(&all).unwrap();
    let initialized = next();
    assert_eq!(initialized["result"]["capabilities"]["positionEncoding"], "utf-16", "{initialized}");
    assert_eq!(initialized["jsonrpc"], "2.0");
    let text = "void mainImage(out vec4 c, in vec2 p) { c = x; }";
    let document = json!({"uri": "file:///nowhere/a.glsl", "languageId": "glsl", "version": 1, "text": text});
    let open = json!({"jsonrpc": "2.0", "method": "textDocument/didOpen", "params": {"textDocument": document}});
    input.write_all(&framed(&open)).unwrap();
    let published = next();
    assert_eq!(
        published["params"]["diagnostics"][0]["message"].as_str().unwrap().lines().next(),
        Some("`x` is not declared")
    );
    let last_messages =
        [json!({"jsonrpc": "2.0", "id": "end", "method": "shutdown"}), json!({"jsonrpc": "2.0", "method": "exit"})];
    input.write_all(&last_messages.iter().flat_map(framed).collect::<Vec<u8>>()).unwrap();
    assert_eq!(next(), json!({"jsonrpc": "2.0", "id": "end", "result": null}));
    assert_eq!(server.wait().unwrap().code(), Some(0));
}

#[test]
fn the_server_exits_with_1_when_its_input_ends() {
    let run = Bench::new().line("lsp");
    assert_eq!((run.code, run.out.as_str()), (Some(1), ""), "{}", run.err);
}

/// A generator of random numbers with a seed, so that a failure can be reproduced.
struct Random(u64);

impl Random {
    fn below(&mut self, end: usize) -> usize {
        self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (self.0 >> 33) as usize % end.max(1)
    }
}

const PIECES: &[&str] =
    &["", "}", "{", "(", ";", "vec3 q = ", "#if 1\n", "/*", "float x", "é", ".", "1.0", "\n", "#define a b\n", "iTime"];

/// A diagnostic: severity, file, line, column, and first line of the message.
type Diagnostics = BTreeSet<(String, String, u64, u64, String)>;

fn check_diagnostics(b: &Bench, spec: &str) -> Diagnostics {
    let run = b.eddy(["check", "--json", spec]);
    let report = &run.json()[0];
    let list = report["diagnostics"].as_array().unwrap();
    let number = |d: &Value, key: &str| d[key].as_u64().unwrap_or(1);
    list.iter()
        .map(|d| {
            let text = |key: &str| d[key].as_str().unwrap_or("").to_owned();
            (text("severity"), text("source"), number(d, "line"), number(d, "column"), text("message"))
        })
        .collect()
}

#[test]
fn presets_edited_at_random_have_the_diagnostics_of_check() {
    let (mut random, mut broken) = (Random(31), 0);
    for preset in ["fluid", "sky-spheres", "bloom", "spectrum", "scene-bloom-taa"] {
        let b = Bench::new();
        let from = Path::new(env!("CARGO_MANIFEST_DIR")).join("presets").join(preset);
        let mut texts = Vec::new();
        for entry in std::fs::read_dir(&from).unwrap() {
            let path = entry.unwrap().path();
            let name = path.file_name().unwrap().to_string_lossy().into_owned();
            if path.is_file() {
                b.write(&format!("p/{name}"), std::fs::read(&path).unwrap());
                texts.extend(name.ends_with(".glsl").then_some(name));
            }
        }
        texts.sort();
        let mut server = Server::new();
        let mut published: std::collections::BTreeMap<String, Value> = Default::default();
        let mut send = |message: Value| {
            let mut out = Vec::new();
            server.handle(serde_json::from_value(message).unwrap(), &mut out);
            while server.idle(&mut out) {}
            for message in out.into_iter().map(|message| serde_json::to_value(message).unwrap()) {
                if let Some(uri) = message.pointer("/params/uri").and_then(Value::as_str) {
                    published.insert(uri.to_owned(), message["params"]["diagnostics"].clone());
                }
            }
            published.clone()
        };
        send(json!({"id": 0, "method": "initialize",
            "params": {"capabilities": {"general": {"positionEncodings": ["utf-32"]}}}}));
        let uri = |name: &str| format!("file://{}", b.path(format!("p/{name}")).display());
        for name in &texts {
            let text = String::from_utf8(b.bytes(&format!("p/{name}"))).unwrap();
            let document = json!({"uri": uri(name), "languageId": "glsl", "version": 0, "text": text});
            send(json!({"method": "textDocument/didOpen", "params": {"textDocument": document}}));
        }
        for version in 1..6 {
            let name = &texts[random.below(texts.len())];
            let mut text = String::from_utf8(b.bytes(&format!("p/{name}"))).unwrap();
            let mut at = random.below(text.len());
            while !text.is_char_boundary(at) {
                at -= 1;
            }
            let mut end = (at + random.below(8)).min(text.len());
            while !text.is_char_boundary(end) {
                end -= 1;
            }
            text.replace_range(at..end.max(at), PIECES[random.below(PIECES.len())]);
            b.write(&format!("p/{name}"), &text);
            let document = json!({"uri": uri(name), "version": version});
            let published = send(json!({"method": "textDocument/didChange",
                "params": {"textDocument": document, "contentChanges": [{"text": text}]}}));
            let checked = check_diagnostics(&b, "p");
            let placed: Diagnostics = checked.iter().filter(|diagnostic| !diagnostic.1.is_empty()).cloned().collect();
            let mut found = Diagnostics::new();
            for (uri, list) in &published {
                let file = uri.rsplit('/').next().unwrap().to_owned();
                for d in list.as_array().unwrap() {
                    let severity = ["", "error", "warning", "note"][d["severity"].as_u64().unwrap() as usize];
                    let start = &d["range"]["start"];
                    let place = |key: &str| start[key].as_u64().unwrap() + 1;
                    let message = d["message"].as_str().unwrap().split("\nhelp: ").next().unwrap().to_owned();
                    found.insert((severity.into(), file.clone(), place("line"), place("character"), message));
                }
            }
            let nowhere: BTreeSet<&String> =
                checked.iter().filter(|diagnostic| diagnostic.1.is_empty()).map(|diagnostic| &diagnostic.4).collect();
            found.retain(|diagnostic| placed.contains(diagnostic) || !nowhere.contains(&diagnostic.4));
            assert_eq!(found, placed, "{preset}/{name}, edit {version}");
            broken += usize::from(!placed.is_empty());
        }
    }
    assert!(broken > 10, "{broken} of 25 edits cause errors");
}
