//! Measures the time that `eddy lsp` needs for a keystroke in a shader of 2,000 lines: `cargo bench --bench lsp`.
//!
//! A keystroke is a change of one character, the resulting diagnostics, and the immediate requests of editors: a
//! completion, the colours and the hints of the whole text. Each is timed from the message to the answer, including
//! JSON, without a stream.

use eddy::lsp::Server;
use serde_json::{Value, json};
use std::time::{Duration, Instant};

const KEYS: usize = 60;

fn main() {
    let text = long();
    let lines = text.lines().count();
    for (title, common) in [("one file", 0), ("Common of 1,000 lines before it", 1000)] {
        measure(title, lines, &text, common);
    }
    while_reading();
}

/// Measures the time to any answer while a text of 4 MB is read, which takes seconds: either the result, or the answer
/// that reading is in progress.
fn while_reading() {
    let body: String = (0..100_000).map(|i| format!("color.x = nam_of_functio_{i}x(1.0);\n")).collect();
    let text = format!("void mainImage(out vec4 color, in vec2 at) {{\n{body}}}\n");
    let uri = "file:///nowhere/a.glsl";
    let mut server = Server::threaded();
    let mut out = Vec::new();
    let mut times = Vec::new();
    let mut send = |message: Value| {
        let began = Instant::now();
        server.handle(serde_json::from_value(message).expect("a message"), &mut out);
        server.idle(&mut out);
        out.clear();
        times.push(began.elapsed());
    };
    send(json!({"id": 0, "method": "initialize", "params": {"capabilities": {}}}));
    let document = json!({"uri": uri, "languageId": "glsl", "version": 0, "text": text});
    send(json!({"method": "textDocument/didOpen", "params": {"textDocument": document}}));
    for version in 1..40 {
        let range = json!({"start": {"line": 0, "character": 0}, "end": {"line": 0, "character": 0}});
        send(json!({"method": "textDocument/didChange", "params": {
            "textDocument": {"uri": uri, "version": version}, "contentChanges": [{"range": range, "text": " "}],
        }}));
        let at = json!({"textDocument": {"uri": uri}, "position": {"line": 0, "character": 6}});
        send(json!({"id": version, "method": "textDocument/hover", "params": at}));
    }
    times.sort();
    let millis = |time: Duration| time.as_secs_f64() * 1e3;
    let (median, worst) = (times[times.len() / 2], times[times.len() - 1]);
    println!(
        "{:.1} MB that are read meanwhile: median {:.2} ms, worst {:.2} ms of {}",
        text.len() as f64 / 1e6,
        millis(median),
        millis(worst),
        times.len()
    );
}

/// A shader of two thousand lines: functions that call each other.
fn long() -> String {
    let mut text = String::new();
    for i in 0..280 {
        let before = if i == 0 { "p.x".to_owned() } else { format!("f{}(p * 0.5, k)", i - 1) };
        text.push_str(&format!(
            "// What {i} does.\nfloat f{i}(vec2 p, float k) {{\n    float a = sin(p.x * {i}.0 + iTime) * k;\n    vec3 b = \
             vec3(a, p) + vec3(0.5);\n    for (int i = 0; i < 4; i++) b += b.zxy * 0.1;\n    return dot(b, \
             vec3(1.0)) + {before};\n}}\n"
        ));
    }
    text.push_str(
        "void mainImage(out vec4 color, in vec2 at) {\n    float x = f9(at, 1.0);\n    color = vec4(x);\n}\n",
    );
    text
}

fn common(lines: usize) -> String {
    (0..lines / 4).map(|i| format!("// {i}\nfloat c{i}(float x) {{\n    return x + {i}.0;\n}}\n")).collect()
}

struct Times {
    name: &'static str,
    all: Vec<Duration>,
}

fn measure(title: &str, lines: usize, text: &str, common_lines: usize) {
    let folder = tempfile::tempdir().expect("a folder");
    let write = |name: &str, text: &str| std::fs::write(folder.path().join(name), text).expect("a file");
    write("image.glsl", text);
    if common_lines > 0 {
        write("common.glsl", &common(common_lines));
    }
    let uri = format!("file://{}", folder.path().join("image.glsl").display());
    let mut server = Server::new();
    let mut send = |message: Value, until_idle: bool| {
        let mut out = Vec::new();
        server.handle(serde_json::from_value(message).expect("a message"), &mut out);
        while until_idle && server.idle(&mut out) {}
        serde_json::to_vec(&out).expect("JSON").len()
    };
    send(json!({"id": 0, "method": "initialize", "params": {"capabilities": {}}}), true);
    let document = json!({"uri": uri, "languageId": "glsl", "version": 0, "text": text});
    send(json!({"method": "textDocument/didOpen", "params": {"textDocument": document}}), true);
    let line = lines - 2;
    let mut times: Vec<Times> = ["key and diagnostics", "key and completion", "colours", "hints"]
        .map(|name| Times { name, all: vec![] })
        .into();
    for key in 0..KEYS {
        let mut timed = |which: usize, messages: &[Value], until_idle: bool| {
            let began = Instant::now();
            for message in messages {
                send(message.clone(), until_idle);
            }
            times[which].all.push(began.elapsed());
        };
        let change = |text: &str, to: usize| {
            let range = json!({"start": {"line": line, "character": 4}, "end": {"line": line, "character": to}});
            json!({"method": "textDocument/didChange", "params": {
                "textDocument": {"uri": uri, "version": key + 1}, "contentChanges": [{"range": range, "text": text}],
            }})
        };
        let at = json!({"textDocument": {"uri": uri}, "position": {"line": line, "character": 5}});
        let range = json!({"start": {"line": 0, "character": 0}, "end": {"line": lines, "character": 0}});
        let whole = json!({"textDocument": {"uri": uri}, "range": range});
        // A letter is typed, a completion is requested before diagnostics are published, and the letter is deleted.
        timed(0, &[change("x", 4)], true);
        timed(0, &[change("", 5)], true);
        let completion = json!({"id": 1, "method": "textDocument/completion", "params": at});
        timed(1, &[change("s", 4), completion], false);
        timed(2, &[json!({"id": 2, "method": "textDocument/semanticTokens/full", "params": whole})], false);
        timed(3, &[json!({"id": 3, "method": "textDocument/inlayHint", "params": whole})], false);
        timed(0, &[change("", 5)], true);
    }
    println!("{title}, {lines} lines:");
    for Times { name, mut all } in times {
        all.sort();
        let millis = |time: Duration| time.as_secs_f64() * 1e3;
        let worst = all.last().copied().unwrap_or_default();
        println!(
            "  {name}: median {:.2} ms, worst {:.2} ms of {}",
            millis(all[all.len() / 2]),
            millis(worst),
            all.len()
        );
    }
}
