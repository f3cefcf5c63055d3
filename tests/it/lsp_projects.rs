//! The server without a stream: what is answered about projects, single files, plain stages and texts that are not saved.

use eddy::lsp::Server;
use serde_json::{Value, json};
use std::{collections::BTreeMap, fs, path::Path};
use tempfile::TempDir;

/// An editor with a server of its own, and a folder.
struct Editor {
    server: Server,
    folder: TempDir,
    asked: i32,
    /// The newest diagnostics of each document.
    told: BTreeMap<String, Value>,
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
        let mut editor = Self { server: Server::new(), folder, asked: 0, told: BTreeMap::new() };
        editor.ask("initialize", json!({"capabilities": capabilities})).expect("a server that begins");
        editor.tell("initialized", json!({}));
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

    /// Lets the server do what it does while nothing is asked.
    fn settle(&mut self) {
        let mut out = Vec::new();
        while self.server.idle(&mut out) {}
        for message in out.iter().map(|message| serde_json::to_value(message).expect("JSON")) {
            assert_eq!(message["method"], "textDocument/publishDiagnostics");
            let uri = message["params"]["uri"].as_str().expect("a document").to_owned();
            self.told.insert(uri, message["params"]["diagnostics"].clone());
        }
    }

    fn tell(&mut self, method: &str, params: Value) {
        self.send(json!({"method": method, "params": params}));
        self.settle();
    }

    fn ask(&mut self, method: &str, params: Value) -> Result<Value, String> {
        self.asked += 1;
        let answer = self.send(json!({"id": self.asked, "method": method, "params": params})).pop().expect("an answer");
        match answer.get("error") {
            Some(error) => Err(error["message"].as_str().expect("a text").to_owned()),
            None => Ok(answer["result"].clone()),
        }
    }

    fn open(&mut self, name: &str, text: &str) {
        let document = json!({"uri": self.uri(name), "languageId": "glsl", "version": 1, "text": text});
        self.tell("textDocument/didOpen", json!({ "textDocument": document }));
    }

    /// Opens a file as it is on disk.
    fn open_file(&mut self, name: &str) {
        let text = fs::read_to_string(self.folder.path().join(name)).expect("a file");
        self.open(name, &text);
    }

    fn edit(&mut self, name: &str, text: &str) {
        let document = json!({"uri": self.uri(name), "version": 2});
        self.tell("textDocument/didChange", json!({"textDocument": document, "contentChanges": [{"text": text}]}));
    }

    fn place(&self, name: &str, (line, character): (u32, u32)) -> Value {
        json!({"textDocument": {"uri": self.uri(name)}, "position": {"line": line, "character": character}})
    }

    fn ask_at(&mut self, method: &str, name: &str, at: (u32, u32)) -> Value {
        let params = self.place(name, at);
        self.ask(method, params).expect("an answer")
    }

    /// The messages about a document, with their lines.
    fn said(&self, name: &str) -> Vec<String> {
        let list = self.told.get(&self.uri(name)).and_then(Value::as_array).cloned().unwrap_or_default();
        let first = |d: &Value| d["message"].as_str().unwrap_or_default().lines().next().unwrap_or_default().to_owned();
        list.iter().map(|d| format!("{}: {}", d["range"]["start"]["line"], first(d))).collect()
    }
}

/// Names of files and lines of locations.
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
fn a_name_of_common_is_followed_through_all_passes() {
    let mut editor = project();
    editor.open_file("image.glsl");
    assert_eq!(editor.said("image.glsl"), [""; 0]);
    let declared = editor.ask_at("textDocument/definition", "image.glsl", (1, 16));
    assert_eq!(lines(&declared), ["common.glsl:1"]);
    let mut params = editor.place("image.glsl", (1, 16));
    params["context"] = json!({"includeDeclaration": true});
    let used = editor.ask("textDocument/references", params.clone()).unwrap();
    assert_eq!(lines(&used), ["common.glsl:1", "buffer_a.glsl:0", "image.glsl:1"]);
    params["context"] = json!({"includeDeclaration": false});
    assert_eq!(lines(&editor.ask("textDocument/references", params).unwrap()), ["buffer_a.glsl:0", "image.glsl:1"]);
    let shown = editor.ask_at("textDocument/hover", "image.glsl", (1, 16));
    let text = shown["contents"]["value"].as_str().unwrap();
    assert!(text.contains("float twice(float x)") && text.contains("Twice as much."), "{text}");
}

#[test]
fn a_rename_changes_all_files_or_none() {
    let mut editor = project();
    editor.open_file("image.glsl");
    let mut params = editor.place("image.glsl", (1, 16));
    let named = editor.ask("textDocument/prepareRename", params.clone()).unwrap();
    assert_eq!(named["placeholder"], "twice");
    params["newName"] = "doubled".into();
    let edit = editor.ask("textDocument/rename", params.clone()).unwrap();
    let files = edit["changes"].as_object().unwrap();
    assert_eq!(files.len(), 3);
    assert!(files.values().all(|edits| edits[0]["newText"] == "doubled"), "{edit}");
    for (name, why) in [("c", "already has a meaning"), ("mix", "cannot be declared"), ("2x", "is not a name")] {
        params["newName"] = name.into();
        let refused = editor.ask("textDocument/rename", params.clone()).unwrap_err();
        assert!(refused.contains(why), "{name}: {refused}");
    }
    let mut params = editor.place("image.glsl", (2, 8));
    params["newName"] = "x".into();
    assert!(editor.ask("textDocument/rename", params).unwrap_err().contains("defined by GLSL"));
}

#[test]
fn texts_that_are_not_saved_count_for_every_pass() {
    let mut editor = project();
    editor.open_file("common.glsl");
    editor.open_file("image.glsl");
    editor.edit("common.glsl", "float thrice(float x) { return 3.0 * x; }\n");
    assert_eq!(editor.said("image.glsl"), ["1: there is no function `twice`"]);
    // A file that is not open has its mistakes too.
    assert_eq!(editor.said("buffer_a.glsl"), ["0: there is no function `twice`"]);
    editor.edit("common.glsl", COMMON);
    assert_eq!(editor.said("image.glsl"), [""; 0]);
    assert_eq!(editor.said("buffer_a.glsl"), [""; 0]);
    // What is closed unsaved counts no longer.
    editor.edit("common.glsl", "");
    let document = json!({"textDocument": {"uri": editor.uri("common.glsl")}});
    editor.tell("textDocument/didClose", document);
    assert_eq!(editor.said("image.glsl"), [""; 0]);
}

#[test]
fn a_mistake_in_common_has_its_place_and_its_other_places() {
    let mut editor = project();
    editor.open_file("image.glsl");
    editor.open("common.glsl", "float twice(float x) { return 2.0 * x; }\nfloat twice(float x) { return x; }\n");
    let told = &editor.told[&editor.uri("common.glsl")][0];
    assert_eq!(told["range"]["start"]["line"], 1, "{told}");
    assert_eq!(told["relatedInformation"][0]["location"]["range"]["start"]["line"], 0, "{told}");
    assert_eq!(told["source"], "eddy");
}

#[test]
fn a_mend_of_a_message_is_a_code_action() {
    let mut editor = Editor::new(&[]);
    editor.open("a.glsl", "void mainImage(out vec4 c, in vec2 p) {\n    c = vec4(lerp(0.0, 1.0, p.x));\n}\n");
    let range = json!({"start": {"line": 1, "character": 14}, "end": {"line": 1, "character": 14}});
    let mut params =
        json!({"textDocument": {"uri": editor.uri("a.glsl")}, "range": range, "context": {"diagnostics": []}});
    let actions = editor.ask("textDocument/codeAction", params.clone()).unwrap();
    assert_eq!(actions[0]["title"], "Replace with `mix`");
    assert_eq!(actions[0]["edit"]["changes"][editor.uri("a.glsl")][0]["newText"], "mix");
    params["range"] = json!({"start": {"line": 0, "character": 0}, "end": {"line": 0, "character": 1}});
    assert_eq!(editor.ask("textDocument/codeAction", params.clone()).unwrap(), json!([]));
    params["context"] = json!({"diagnostics": [], "only": ["refactor"]});
    assert_eq!(editor.ask("textDocument/codeAction", params).unwrap(), json!([]));
}

#[test]
fn plain_stages_are_read_as_such() {
    let mut editor = Editor::new(&[]);
    let fragment = "#version 300 es\nprecision highp float;\nuniform vec3 tint;\nin vec2 uv;\nout vec4 color;\n\
                    void main() { color = vec4(tint, uv.x); }\n";
    editor.open("a.frag", fragment);
    assert_eq!(editor.said("a.frag"), [""; 0]);
    let shown = editor.ask_at("textDocument/hover", "a.frag", (5, 29));
    assert!(shown["contents"]["value"].as_str().unwrap().contains("uniform vec3 tint"), "{shown}");
    let mut params = editor.place("a.frag", (5, 29));
    params["newName"] = "hue".into();
    let edit = editor.ask("textDocument/rename", params).unwrap();
    assert_eq!(edit["changes"][editor.uri("a.frag")].as_array().unwrap().len(), 2);
    editor.open("a.vert", "#version 300 es\nin vec3 position;\nvoid main() { gl_Position = vec4(position, 1); x; }\n");
    assert_eq!(editor.said("a.vert").len(), 1, "{:?}", editor.said("a.vert"));
}

#[test]
fn an_included_file_belongs_to_who_includes_it() {
    let mut editor = Editor::new(&[("noise.glsl", "float noise(float x) { return fract(x); }\n")]);
    editor.open_file("noise.glsl");
    assert_eq!(editor.said("noise.glsl").len(), 1, "alone it has no mainImage");
    let image = "#include \"noise.glsl\"\nvoid mainImage(out vec4 c, in vec2 p) { c = vec4(noise(p.x)); }\n";
    editor.open("a.glsl", image);
    assert_eq!(editor.said("noise.glsl"), [""; 0]);
    assert_eq!(lines(&editor.ask_at("textDocument/definition", "a.glsl", (1, 51))), ["noise.glsl:0"]);
    assert_eq!(lines(&editor.ask_at("textDocument/definition", "a.glsl", (0, 12))), ["noise.glsl:0"]);
    editor.edit("noise.glsl", "float noise(float x) { return fract(y); }\n");
    assert_eq!(editor.said("noise.glsl").len(), 1);
    editor.edit("a.glsl", "void mainImage(out vec4 c, in vec2 p) { c = vec4(1); }\n");
    assert!(editor.said("noise.glsl").len() > 1, "{:?}", editor.said("noise.glsl"));
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
    assert_eq!(editor.said("buffer_blur.glsl").len(), 1);
    let shown = editor.ask_at("textDocument/hover", "image.glsl", (1, 46));
    assert!(shown["contents"]["value"].as_str().unwrap().contains("= `2.0`, set in eddy.toml"), "{shown}");
    assert_eq!(lines(&editor.ask_at("textDocument/definition", "image.glsl", (1, 46))), ["image.glsl:0"]);
    let range = json!({"start": {"line": 0, "character": 0}, "end": {"line": 9, "character": 0}});
    let params = json!({"textDocument": {"uri": editor.uri("image.glsl")}, "range": range});
    let hints = editor.ask("textDocument/inlayHint", params).unwrap();
    assert_eq!(hints[0]["label"], "now 2.0 (eddy.toml)", "{hints}");
    editor.open("eddy.toml", "[passes.image]\nchannels.0 = { buffer = 7 }\n");
    assert_eq!(editor.said("eddy.toml").len(), 1, "{:?}", editor.told);
    assert_ne!(editor.ask_at("textDocument/hover", "image.glsl", (1, 8)), Value::Null, "services go on");
    editor.edit("eddy.toml", manifest);
    assert_eq!(editor.said("eddy.toml"), [""; 0]);
}

#[test]
fn columns_are_those_that_the_editor_counts() {
    let text = "void mainImage(out vec4 c, in vec2 p) {\n    /* \u{1f300}é */ c = nothing;\n}\n";
    for (encodings, column) in [(json!(["utf-8"]), 21), (json!(["utf-16"]), 18), (json!(["utf-32"]), 17)] {
        let mut editor = Editor::with(&[], json!({"general": {"positionEncodings": encodings}}));
        editor.open("a.glsl", text);
        let told = &editor.told[&editor.uri("a.glsl")][0];
        assert_eq!(told["range"]["start"], json!({"line": 1, "character": column}), "{told}");
        let change = json!({
            "range": {"start": {"line": 1, "character": column}, "end": {"line": 1, "character": column + 7}},
            "text": "p.xyxy",
        });
        let document = json!({"uri": editor.uri("a.glsl"), "version": 2});
        editor.tell("textDocument/didChange", json!({"textDocument": document, "contentChanges": [change]}));
        assert_eq!(editor.said("a.glsl"), [""; 0]);
    }
}

#[test]
fn what_makes_no_sense_is_refused_and_the_server_goes_on() {
    let mut editor = Editor::new(&[]);
    editor.open("a.glsl", IMAGE);
    for (method, params, why) in [
        ("textDocument/unheardOf", json!({}), "does not know"),
        ("textDocument/hover", json!({}), "missing field"),
        ("textDocument/hover", json!([1, 2]), "invalid"),
        ("textDocument/rename", json!(null), "invalid"),
        ("initialize", json!({}), "before"),
        ("textDocument/formatting", json!({}), "does not format"),
    ] {
        let refused = editor.ask(method, params).unwrap_err();
        assert!(refused.contains(why), "{method}: {refused}");
    }
    for params in [json!(null), json!({"textDocument": 3}), json!({"textDocument": {"uri": "file:///nowhere.glsl"}})] {
        editor.tell("textDocument/didOpen", params.clone());
        editor.tell("textDocument/didChange", params.clone());
        editor.tell("textDocument/didClose", params);
    }
    let elsewhere = json!({"textDocument": {"uri": "untitled:x"}, "position": {"line": 0, "character": 0}});
    assert_eq!(editor.ask("textDocument/hover", elsewhere).unwrap(), Value::Null, "it is not open");
    let far = editor.ask_at("textDocument/completion", "a.glsl", (4_000_000_000, 4_000_000_000));
    assert!(far["items"].as_array().is_some());
    let backwards = json!({
        "range": {"start": {"line": 3, "character": 9}, "end": {"line": 0, "character": 0}}, "text": "\n"
    });
    let document = json!({"uri": editor.uri("a.glsl"), "version": 2});
    editor.tell("textDocument/didChange", json!({"textDocument": document, "contentChanges": [backwards]}));
    assert_ne!(editor.ask_at("textDocument/hover", "a.glsl", (1, 5)), json!(1));
}

#[test]
fn a_document_without_a_file_and_a_file_that_goes_are_served() {
    let mut editor = project();
    let document = json!({"uri": "untitled:Untitled-1", "languageId": "glsl", "version": 1, "text": "float x = y;"});
    editor.tell("textDocument/didOpen", json!({ "textDocument": document }));
    assert!(!editor.told["untitled:Untitled-1"].as_array().unwrap().is_empty());
    editor.open_file("image.glsl");
    fs::remove_file(editor.folder.path().join("common.glsl")).unwrap();
    editor.tell("workspace/didChangeWatchedFiles", json!({"changes": []}));
    assert_eq!(editor.said("image.glsl"), ["1: there is no function `twice`"]);
    fs::remove_file(editor.folder.path().join("image.glsl")).unwrap();
    editor.tell("workspace/didChangeWatchedFiles", json!({"changes": []}));
    assert_ne!(editor.ask_at("textDocument/hover", "image.glsl", (0, 8)), Value::Null, "its text is the editor's");
}

#[test]
fn a_server_ends_as_the_protocol_has_it() {
    let exit = |server: &mut Server| {
        let message = serde_json::from_value(json!({"method": "exit"})).expect("a message");
        server.handle(message, &mut Vec::new())
    };
    let mut editor = Editor::new(&[]);
    assert_eq!(editor.ask("shutdown", Value::Null), Ok(Value::Null));
    assert!(editor.ask("textDocument/hover", json!({})).unwrap_err().contains("shut down"));
    assert_eq!(exit(&mut editor.server), Some(0));
    assert_eq!(exit(&mut Server::new()), Some(1));
}
