//! `eddy lsp` and `eddy check` detect the same kind of shader in a file, and report the same diagnostics.

use crate::support::program::Bench;
use eddy::lsp::Server;
use serde_json::{Value, json};
use std::collections::{BTreeMap, BTreeSet};

/// An editor with one file open.
struct Editor {
    server: Server,
    uri: String,
    /// The diagnostics of each file.
    published: BTreeMap<String, Value>,
    last_id: i32,
}

impl Editor {
    fn open(b: &Bench, name: &str) -> Editor {
        let uri = format!("file://{}", b.path(name).display());
        let mut editor = Editor { server: Server::new(), uri, published: BTreeMap::new(), last_id: 0 };
        editor.request("initialize", json!({"capabilities": {"general": {"positionEncodings": ["utf-8"]}}}));
        let text = String::from_utf8(b.bytes(name)).unwrap();
        let document = json!({"uri": editor.uri, "languageId": "glsl", "version": 0, "text": text});
        editor.send(json!({"method": "textDocument/didOpen", "params": {"textDocument": document}}));
        editor
    }

    /// Sends a message, and returns the last result.
    fn send(&mut self, message: Value) -> Value {
        let mut out = Vec::new();
        self.server.handle(serde_json::from_value(message).unwrap(), &mut out);
        while self.server.idle(&mut out) {}
        let mut answer = Value::Null;
        for message in out.into_iter().map(|message| serde_json::to_value(message).unwrap()) {
            if let Some(uri) = message.pointer("/params/uri").and_then(Value::as_str) {
                self.published.insert(uri.to_owned(), message["params"]["diagnostics"].clone());
            } else if !message["result"].is_null() {
                answer = message["result"].clone();
            }
        }
        answer
    }

    fn request(&mut self, method: &str, mut params: Value) -> Value {
        self.last_id += 1;
        if let (Some(params), false) = (params.as_object_mut(), self.uri.is_empty() || method == "initialize") {
            params.insert("textDocument".into(), json!({"uri": self.uri}));
        }
        self.send(json!({"id": self.last_id, "method": method, "params": params}))
    }

    /// Returns severity, line and first line of each message.
    fn diagnostics(&self) -> BTreeSet<(String, u64, String)> {
        let all = self.published.values().flat_map(|list| list.as_array().unwrap());
        all.map(|d| {
            let severity = ["", "error", "warning", "note"][d["severity"].as_u64().unwrap() as usize];
            let message = d["message"].as_str().unwrap().split("\nhelp: ").next().unwrap();
            (severity.to_owned(), d["range"]["start"]["line"].as_u64().unwrap() + 1, message.to_owned())
        })
        .collect()
    }
}

fn check_diagnostics(b: &Bench, name: &str) -> BTreeSet<(String, u64, String)> {
    let report = &b.eddy(["check", "--json", name]).json()[0];
    let text = |d: &Value, key: &str| d[key].as_str().unwrap().to_owned();
    let list = report["diagnostics"].as_array().unwrap();
    list.iter().map(|d| (text(d, "severity"), d["line"].as_u64().unwrap_or(1), text(d, "message"))).collect()
}

const HEADER: &str =
    r#"/*{"INPUTS": [{"NAME": "level", "TYPE": "float", "MAX": 1.0}, {"NAME": "picture", "TYPE": "image"}]}*/"#;

#[test]
fn the_language_server_and_check_agree_on_every_kind_of_file() {
    let b = Bench::new();
    let isf = |text: &str| format!("{HEADER}\n{text}");
    let plain = |text: &str| format!("#version 300 es\nprecision highp float;\n{text}");
    for (name, text, errors) in [
        ("a.glsl", "void mainImage(out vec4 c, in vec2 p) { c = vec4(sn(p.x)); }".to_owned(), 1),
        ("b.glsl", "void mainImage(out vec4 c, in vec2 p) { c = vec4(p, 0.0, 1.0); }".to_owned(), 0),
        ("c.fs", isf("void main() { gl_FragColor = level * IMG_THIS_PIXEL(picture) + TIME; }"), 0),
        ("d.fs", isf("void main() { gl_FragColor = vec4(levels); }"), 1),
        ("e.frag", isf("#version 120\n#extension GL_ARB_x : enable\nvoid main() { gl_FragColor = vec4(1.0); }"), 0),
        ("f.fs", "/*{\"INPUTS\": [{\"NAME\": \"a\" }*/\nvoid main() { gl_FragColor = vec4(a); }".to_owned(), 1),
        ("g.fs", "/*{}*/ void main() { gl_FragColor = vec4(1.0); }".to_owned(), 0),
        ("h.frag", plain("out vec4 c;\nuniform vec3 tint;\nvoid main() { c = vec4(tint, 1.0); }"), 0),
        ("i.frag", plain("out vec4 c;\nvoid main() { c = tint; }"), 1),
        ("j.vert", plain("in vec3 p;\nvoid main() { gl_Position = vec4(p, 1.0); }"), 0),
        ("k.glsl", plain("in vec3 p;\nvoid main() { gl_Position = vec4(p, 1); }"), 0),
        ("l.frag", "#version 410 core\nout vec4 c;\nvoid main() { c = vec4(1.0); }".to_owned(), 0),
        (
            "m.frag",
            "uniform vec2 u_resolution;\nvoid main() { gl_FragColor = vec4(u_resolution, 0, 1); }".to_owned(),
            0,
        ),
        ("n.glsl", "//!HOOK MAIN\n//!BIND MAIN\nvec4 hook() { return MAIN_texOff(vec2(0.0)); }".to_owned(), 1),
        ("o.glsl", "void main() { gl_FragColor = vec4(1.0); }".to_owned(), 0),
        ("p.frag", "varying vec2 v_texcoord;\nvoid main() { gl_FragColor = vec4(v_texcoords, 0, 1); }".to_owned(), 1),
        ("q.glsl", "o = vec4(FC.xy / r, fract(t), 1);".to_owned(), 0),
    ] {
        b.write(name, &text);
        let (checked, diagnostics) = (check_diagnostics(&b, name), Editor::open(&b, name).diagnostics());
        assert_eq!(diagnostics, checked, "{name}");
        assert_eq!(
            diagnostics.iter().filter(|diagnostic| diagnostic.0 == "error").count(),
            errors,
            "{name}: {diagnostics:?}"
        );
    }
}

#[test]
fn the_vertex_shader_of_an_isf_file_is_compiled_with_it() {
    let b = Bench::new();
    b.write(
        "a.fs",
        format!("{HEADER}\nvarying vec2 right;\nvoid main() {{ gl_FragColor = vec4(right, level, 1.0); }}"),
    );
    let vertex = "varying vec2 right;\nvoid main() { isf_vertShaderInit(); right = isf_FragNormCoord + level; }\n";
    b.write("a.vs", vertex);
    let editor = Editor::open(&b, "a.vs");
    assert_eq!(editor.diagnostics(), BTreeSet::new());
    assert_eq!(check_diagnostics(&b, "a.vs"), BTreeSet::new());
    b.write("a.vs", vertex.replace("level", "levle"));
    let diagnostics = Editor::open(&b, "a.vs").diagnostics();
    assert_eq!(diagnostics, check_diagnostics(&b, "a.vs"));
    assert!(diagnostics.iter().any(|(_, line, message)| *line == 2 && message.contains("`levle`")), "{diagnostics:?}");
    // Without an ISF file it is an ordinary vertex shader.
    b.write("alone/b.vs", "#version 300 es\nin vec3 p;\nvoid main() { gl_Position = vec4(p, 1.0); }");
    assert_eq!(Editor::open(&b, "alone/b.vs").diagnostics(), BTreeSet::new());
}

#[test]
fn inputs_and_names_of_isf_are_completed_and_explained() {
    let b = Bench::new();
    b.write(
        "a.fs",
        format!("{HEADER}\nvoid main() {{ gl_FragColor = vec4(level + TIME) + IMG_THIS_PIXEL(picture); }}"),
    );
    let mut editor = Editor::open(&b, "a.fs");
    let at = |character: u64| json!({"position": {"line": 1, "character": character}});
    let column = "void main() { gl_FragColor = vec4(".len() as u64;
    let items = editor.request("textDocument/completion", at(column));
    let labels: BTreeSet<&str> =
        items["items"].as_array().unwrap().iter().map(|item| item["label"].as_str().unwrap()).collect();
    for name in ["level", "picture", "TIME", "RENDERSIZE", "isf_FragNormCoord", "IMG_NORM_PIXEL", "PASSINDEX", "DATE"] {
        assert!(labels.contains(name), "{name}");
    }
    let hover = |editor: &mut Editor, at: Value| editor.request("textDocument/hover", at).to_string();
    assert!(hover(&mut editor, at(column + 1)).contains("float level"));
    assert!(hover(&mut editor, at(column + 9)).contains("float TIME"));
}
