//! The server without a stream: answers about projects, single files, plain stages and unsaved texts.

use eddy::lsp::Server;
use serde_json::{Value, json};
use std::{collections::BTreeMap, fs, path::Path};
use tempfile::TempDir;

/// An editor with its own server and a folder.
struct Editor {
    server: Server,
    folder: TempDir,
    last_id: i32,
    /// The newest diagnostics of each document.
    published: BTreeMap<String, Value>,
}

impl Editor {
    fn new(files: &[(&str, &str)]) -> Self {
        Self::with(files, json!({"general": {"positionEncodings": ["utf-8", "utf-16"]}}))
    }

    fn with(files: &[(&str, &str)], capabilities: Value) -> Self {
        let folder = tempfile::tempdir().expect("a folder");
        for (name, text) in files {
            fs::write(folder.path().join(name), text).expect("a file");
        }
        let mut editor = Self { server: Server::new(), folder, last_id: 0, published: BTreeMap::new() };
        editor.request("initialize", json!({"capabilities": capabilities})).expect("an initialised server");
        editor.notify("initialized", json!({}));
        editor
    }

    fn uri(&self, name: &str) -> String {
        format!("file://{}", self.folder.path().join(name).display())
    }

    fn send(&mut self, message: Value) -> Vec<Value> {
        let mut out = Vec::new();
        assert_eq!(self.server.handle(serde_json::from_value(message).expect("a message"), &mut out), None);
        out.iter().map(|message| serde_json::to_value(message).expect("JSON")).collect()
    }

    /// Lets the server do its idle work, and stores the diagnostics that it publishes.
    fn settle(&mut self) {
        let mut out = Vec::new();
        while self.server.idle(&mut out) {}
        for message in out.iter().map(|message| serde_json::to_value(message).expect("JSON")) {
            assert_eq!(message["method"], "textDocument/publishDiagnostics");
            let uri = message["params"]["uri"].as_str().expect("a document").to_owned();
            self.published.insert(uri, message["params"]["diagnostics"].clone());
        }
    }

    fn notify(&mut self, method: &str, params: Value) {
        self.send(json!({"method": method, "params": params}));
        self.settle();
    }

    fn request(&mut self, method: &str, params: Value) -> Result<Value, String> {
        self.last_id += 1;
        let answer =
            self.send(json!({"id": self.last_id, "method": method, "params": params})).pop().expect("an answer");
        match answer.get("error") {
            Some(error) => Err(error["message"].as_str().expect("a text").to_owned()),
            None => Ok(answer["result"].clone()),
        }
    }

    fn open(&mut self, name: &str, text: &str) {
        let document = json!({"uri": self.uri(name), "languageId": "glsl", "version": 1, "text": text});
        self.notify("textDocument/didOpen", json!({ "textDocument": document }));
    }

    /// Opens a file with its text on disk.
    fn open_file(&mut self, name: &str) {
        let text = fs::read_to_string(self.folder.path().join(name)).expect("a file");
        self.open(name, &text);
    }

    fn edit(&mut self, name: &str, text: &str) {
        let document = json!({"uri": self.uri(name), "version": 2});
        self.notify("textDocument/didChange", json!({"textDocument": document, "contentChanges": [{"text": text}]}));
    }

    fn place(&self, name: &str, (line, character): (u32, u32)) -> Value {
        json!({"textDocument": {"uri": self.uri(name)}, "position": {"line": line, "character": character}})
    }

    fn request_at(&mut self, method: &str, name: &str, at: (u32, u32)) -> Value {
        let params = self.place(name, at);
        self.request(method, params).expect("an answer")
    }

    /// Returns the messages about a document, with their lines.
    fn messages(&self, name: &str) -> Vec<String> {
        let list = self.published.get(&self.uri(name)).and_then(Value::as_array).cloned().unwrap_or_default();
        let first = |d: &Value| d["message"].as_str().unwrap_or_default().lines().next().unwrap_or_default().to_owned();
        list.iter().map(|d| format!("{}: {}", d["range"]["start"]["line"], first(d))).collect()
    }
}

/// Returns the file names and lines of locations.
fn lines(locations: &Value) -> Vec<String> {
    let one = |location: &Value| {
        let uri = location["uri"].as_str().unwrap_or_default();
        let name = Path::new(uri).file_name().unwrap_or_default().to_string_lossy().into_owned();
        format!("{name}:{}", location["range"]["start"]["line"])
    };
    locations.as_array().map(|all| all.iter().map(one).collect()).unwrap_or_default()
}

const COMMON: &str = "// Twice as much.\nfloat twice(float x) { return 2.0 * x; }\n";
const BUFFER: &str = "void mainImage(out vec4 c, in vec2 p) { c = vec4(twice(p.x)); }\n";
const IMAGE: &str = "void mainImage(out vec4 c, in vec2 p) {\n    float y = twice(p.y);\n    c = vec4(y);\n}\n";

fn project() -> Editor {
    Editor::new(&[("common.glsl", COMMON), ("buffer_a.glsl", BUFFER), ("image.glsl", IMAGE)])
}

#[test]
fn a_name_in_common_is_found_in_all_passes() {
    let mut editor = project();
    editor.open_file("image.glsl");
    assert_eq!(editor.messages("image.glsl"), [""; 0]);
    let declared = editor.request_at("textDocument/definition", "image.glsl", (1, 16));
    assert_eq!(lines(&declared), ["common.glsl:1"]);
    let mut params = editor.place("image.glsl", (1, 16));
    params["context"] = json!({"includeDeclaration": true});
    let used = editor.request("textDocument/references", params.clone()).unwrap();
    assert_eq!(lines(&used), ["common.glsl:1", "buffer_a.glsl:0", "image.glsl:1"]);
    params["context"] = json!({"includeDeclaration": false});
    assert_eq!(lines(&editor.request("textDocument/references", params).unwrap()), ["buffer_a.glsl:0", "image.glsl:1"]);
    let shown = editor.request_at("textDocument/hover", "image.glsl", (1, 16));
    let text = shown["contents"]["value"].as_str().unwrap();
    assert!(text.contains("float twice(float x)") && text.contains("Twice as much."), "{text}");
}

#[test]
fn a_rename_changes_all_files_or_none() {
    let mut editor = project();
    editor.open_file("image.glsl");
    let mut params = editor.place("image.glsl", (1, 16));
    let named = editor.request("textDocument/prepareRename", params.clone()).unwrap();
    assert_eq!(named["placeholder"], "twice");
    params["newName"] = "doubled".into();
    let edit = editor.request("textDocument/rename", params.clone()).unwrap();
    let files = edit["changes"].as_object().unwrap();
    assert_eq!(files.len(), 3);
    assert!(files.values().all(|edits| edits[0]["newText"] == "doubled"), "{edit}");
    for (name, why) in [("c", "already has a meaning"), ("mix", "cannot be declared"), ("2x", "is not a name")] {
        params["newName"] = name.into();
        let error = editor.request("textDocument/rename", params.clone()).unwrap_err();
        assert!(error.contains(why), "{name}: {error}");
    }
    let mut params = editor.place("image.glsl", (2, 8));
    params["newName"] = "x".into();
    assert!(editor.request("textDocument/rename", params).unwrap_err().contains("defined by GLSL"));
}

#[test]
fn unsaved_texts_are_used_for_every_pass() {
    let mut editor = project();
    editor.open_file("common.glsl");
    editor.open_file("image.glsl");
    editor.edit("common.glsl", "float thrice(float x) { return 3.0 * x; }\n");
    assert_eq!(editor.messages("image.glsl"), ["1: there is no function `twice`"]);
    // Errors in a file that is not open are published, too.
    assert_eq!(editor.messages("buffer_a.glsl"), ["0: there is no function `twice`"]);
    editor.edit("common.glsl", COMMON);
    assert_eq!(editor.messages("image.glsl"), [""; 0]);
    assert_eq!(editor.messages("buffer_a.glsl"), [""; 0]);
    // An unsaved text is dropped when it is closed.
    editor.edit("common.glsl", "");
    let document = json!({"textDocument": {"uri": editor.uri("common.glsl")}});
    editor.notify("textDocument/didClose", document);
    assert_eq!(editor.messages("image.glsl"), [""; 0]);
}

#[test]
fn an_error_in_common_has_its_place_and_related_places() {
    let mut editor = project();
    editor.open_file("image.glsl");
    editor.open("common.glsl", "float twice(float x) { return 2.0 * x; }\nfloat twice(float x) { return x; }\n");
    let diagnostic = &editor.published[&editor.uri("common.glsl")][0];
    assert_eq!(diagnostic["range"]["start"]["line"], 1, "{diagnostic}");
    assert_eq!(diagnostic["relatedInformation"][0]["location"]["range"]["start"]["line"], 0, "{diagnostic}");
    assert_eq!(diagnostic["source"], "eddy");
}

#[test]
fn a_fix_of_a_diagnostic_is_a_code_action() {
    let mut editor = Editor::new(&[]);
    editor.open("a.glsl", "void mainImage(out vec4 c, in vec2 p) {\n    c = vec4(lerp(0.0, 1.0, p.x));\n}\n");
    let range = json!({"start": {"line": 1, "character": 14}, "end": {"line": 1, "character": 14}});
    let mut params =
        json!({"textDocument": {"uri": editor.uri("a.glsl")}, "range": range, "context": {"diagnostics": []}});
    let actions = editor.request("textDocument/codeAction", params.clone()).unwrap();
    assert_eq!(actions[0]["title"], "Replace with `mix`");
    assert_eq!(actions[0]["edit"]["changes"][editor.uri("a.glsl")][0]["newText"], "mix");
    params["range"] = json!({"start": {"line": 0, "character": 0}, "end": {"line": 0, "character": 1}});
    assert_eq!(editor.request("textDocument/codeAction", params.clone()).unwrap(), json!([]));
    params["context"] = json!({"diagnostics": [], "only": ["refactor"]});
    assert_eq!(editor.request("textDocument/codeAction", params).unwrap(), json!([]));
}

#[test]
fn plain_shader_stages_are_recognised() {
    let mut editor = Editor::new(&[]);
    let fragment = "#version 300 es\nprecision highp float;\nuniform vec3 tint;\nin vec2 uv;\nout vec4 color;\n\
                    void main() { color = vec4(tint, uv.x); }\n";
    editor.open("a.frag", fragment);
    assert_eq!(editor.messages("a.frag"), [""; 0]);
    let shown = editor.request_at("textDocument/hover", "a.frag", (5, 29));
    assert!(shown["contents"]["value"].as_str().unwrap().contains("uniform vec3 tint"), "{shown}");
    let mut params = editor.place("a.frag", (5, 29));
    params["newName"] = "hue".into();
    let edit = editor.request("textDocument/rename", params).unwrap();
    assert_eq!(edit["changes"][editor.uri("a.frag")].as_array().unwrap().len(), 2);
    editor.open("a.vert", "#version 300 es\nin vec3 position;\nvoid main() { gl_Position = vec4(position, 1); x; }\n");
    assert_eq!(editor.messages("a.vert").len(), 1, "{:?}", editor.messages("a.vert"));
}

#[test]
fn an_included_file_belongs_to_the_file_that_includes_it() {
    let mut editor = Editor::new(&[("noise.glsl", "float noise(float x) { return fract(x); }\n")]);
    editor.open_file("noise.glsl");
    assert_eq!(editor.messages("noise.glsl").len(), 1, "on its own it has no mainImage");
    let image = "#include \"noise.glsl\"\nvoid mainImage(out vec4 c, in vec2 p) { c = vec4(noise(p.x)); }\n";
    editor.open("a.glsl", image);
    assert_eq!(editor.messages("noise.glsl"), [""; 0]);
    assert_eq!(lines(&editor.request_at("textDocument/definition", "a.glsl", (1, 51))), ["noise.glsl:0"]);
    assert_eq!(lines(&editor.request_at("textDocument/definition", "a.glsl", (0, 12))), ["noise.glsl:0"]);
    editor.edit("noise.glsl", "float noise(float x) { return fract(y); }\n");
    assert_eq!(editor.messages("noise.glsl").len(), 1);
    editor.edit("a.glsl", "void mainImage(out vec4 c, in vec2 p) { c = vec4(1); }\n");
    assert!(editor.messages("noise.glsl").len() > 1, "{:?}", editor.messages("noise.glsl"));
}

#[test]
fn a_project_with_a_manifest_is_found_from_any_of_its_files() {
    let manifest =
        "[passes.image]\nchannels.0 = { buffer = \"blur\" }\n[passes.buffer_blur]\n[uniforms]\nspeed = 2.0\n";
    let image = "#iUniform float speed = 1.0 in { 0.0, 4.0 }\n\
                 void mainImage(out vec4 c, in vec2 p) { c = speed * texelFetch(iChannel0, ivec2(p), 0); }\n";
    let mut editor = Editor::new(&[
        ("eddy.toml", manifest),
        ("image.glsl", image),
        ("buffer_blur.glsl", "void mainImage(out vec4 c, in vec2 p) { c = vec4(y); }\n"),
    ]);
    editor.open_file("image.glsl");
    assert_eq!(editor.messages("buffer_blur.glsl").len(), 1);
    let shown = editor.request_at("textDocument/hover", "image.glsl", (1, 46));
    assert!(shown["contents"]["value"].as_str().unwrap().contains("= `2.0`, set in eddy.toml"), "{shown}");
    assert_eq!(lines(&editor.request_at("textDocument/definition", "image.glsl", (1, 46))), ["image.glsl:0"]);
    let range = json!({"start": {"line": 0, "character": 0}, "end": {"line": 9, "character": 0}});
    let params = json!({"textDocument": {"uri": editor.uri("image.glsl")}, "range": range});
    let hints = editor.request("textDocument/inlayHint", params).unwrap();
    assert_eq!(hints[0]["label"], "now 2.0 (eddy.toml)", "{hints}");
    editor.open("eddy.toml", "[passes.image]\nchannels.0 = { buffer = 7 }\n");
    assert_eq!(editor.messages("eddy.toml").len(), 1, "{:?}", editor.published);
    assert_ne!(editor.request_at("textDocument/hover", "image.glsl", (1, 8)), Value::Null, "services continue");
    editor.edit("eddy.toml", manifest);
    assert_eq!(editor.messages("eddy.toml"), [""; 0]);
}

#[test]
fn columns_use_the_encoding_of_the_editor() {
    let text = "void mainImage(out vec4 c, in vec2 p) {\n    /* \u{1f300}é */ c = nothing;\n}\n";
    for (encodings, column) in [(json!(["utf-8"]), 21), (json!(["utf-16"]), 18), (json!(["utf-32"]), 17)] {
        let mut editor = Editor::with(&[], json!({"general": {"positionEncodings": encodings}}));
        editor.open("a.glsl", text);
        let diagnostic = &editor.published[&editor.uri("a.glsl")][0];
        assert_eq!(diagnostic["range"]["start"], json!({"line": 1, "character": column}), "{diagnostic}");
        let change = json!({
            "range": {"start": {"line": 1, "character": column}, "end": {"line": 1, "character": column + 7}},
            "text": "p.xyxy",
        });
        let document = json!({"uri": editor.uri("a.glsl"), "version": 2});
        editor.notify("textDocument/didChange", json!({"textDocument": document, "contentChanges": [change]}));
        assert_eq!(editor.messages("a.glsl"), [""; 0]);
    }
}

#[test]
fn invalid_messages_are_rejected_and_the_server_continues() {
    let mut editor = Editor::new(&[]);
    editor.open("a.glsl", IMAGE);
    for (method, params, why) in [
        ("textDocument/unheardOf", json!({}), "does not know"),
        ("textDocument/hover", json!({}), "missing field"),
        ("textDocument/hover", json!([1, 2]), "invalid"),
        ("textDocument/rename", json!(null), "invalid"),
        ("initialize", json!({}), "before"),
        ("textDocument/rangeFormatting", json!({}), "whole documents"),
    ] {
        let error = editor.request(method, params).unwrap_err();
        assert!(error.contains(why), "{method}: {error}");
    }
    for params in [json!(null), json!({"textDocument": 3}), json!({"textDocument": {"uri": "file:///nowhere.glsl"}})] {
        editor.notify("textDocument/didOpen", params.clone());
        editor.notify("textDocument/didChange", params.clone());
        editor.notify("textDocument/didClose", params);
    }
    let elsewhere = json!({"textDocument": {"uri": "untitled:x"}, "position": {"line": 0, "character": 0}});
    assert_eq!(editor.request("textDocument/hover", elsewhere).unwrap(), Value::Null, "it is not open");
    let far = editor.request_at("textDocument/completion", "a.glsl", (4_000_000_000, 4_000_000_000));
    assert!(far["items"].as_array().is_some());
    let backwards = json!({
        "range": {"start": {"line": 3, "character": 9}, "end": {"line": 0, "character": 0}}, "text": "\n"
    });
    let document = json!({"uri": editor.uri("a.glsl"), "version": 2});
    editor.notify("textDocument/didChange", json!({"textDocument": document, "contentChanges": [backwards]}));
    assert_ne!(editor.request_at("textDocument/hover", "a.glsl", (1, 5)), json!(1));
}

#[test]
fn documents_without_a_file_and_deleted_files_are_served() {
    let mut editor = project();
    let document = json!({"uri": "untitled:Untitled-1", "languageId": "glsl", "version": 1, "text": "float x = y;"});
    editor.notify("textDocument/didOpen", json!({ "textDocument": document }));
    assert!(!editor.published["untitled:Untitled-1"].as_array().unwrap().is_empty());
    editor.open_file("image.glsl");
    fs::remove_file(editor.folder.path().join("common.glsl")).unwrap();
    editor.notify("workspace/didChangeWatchedFiles", json!({"changes": []}));
    assert_eq!(editor.messages("image.glsl"), ["1: there is no function `twice`"]);
    fs::remove_file(editor.folder.path().join("image.glsl")).unwrap();
    editor.notify("workspace/didChangeWatchedFiles", json!({"changes": []}));
    assert_ne!(
        editor.request_at("textDocument/hover", "image.glsl", (0, 8)),
        Value::Null,
        "the editor still has its text"
    );
}

#[test]
fn a_server_exits_as_the_protocol_defines() {
    let exit = |server: &mut Server| {
        let message = serde_json::from_value(json!({"method": "exit"})).expect("a message");
        server.handle(message, &mut Vec::new())
    };
    let mut editor = Editor::new(&[]);
    assert_eq!(editor.request("shutdown", Value::Null), Ok(Value::Null));
    assert!(editor.request("textDocument/hover", json!({})).unwrap_err().contains("shut down"));
    assert_eq!(exit(&mut editor.server), Some(0));
    assert_eq!(exit(&mut Server::new()), Some(1));
}
