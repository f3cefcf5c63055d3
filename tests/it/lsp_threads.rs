//! `eddy lsp` while it reads: it answers, gives up what is outdated, and says what is wrong of the newest text alone.

use eddy::lsp::Server;
use serde_json::{Value, json};
use std::{thread, time::Duration};

const URI: &str = "file:///nowhere/a.glsl";

struct Editor {
    server: Server,
    /// All that the server has sent.
    sent: Vec<Value>,
}

impl Editor {
    fn new(capabilities: &Value) -> Editor {
        let mut editor = Editor { server: Server::threaded(), sent: Vec::new() };
        editor.send(&json!({"id": 0, "method": "initialize", "params": {"capabilities": capabilities}}));
        editor
    }

    fn send(&mut self, message: &Value) {
        let mut out = Vec::new();
        self.server.handle(serde_json::from_value(message.clone()).unwrap(), &mut out);
        self.sent.extend(out.into_iter().map(|message| serde_json::to_value(message).unwrap()));
    }

    fn open(&mut self, text: &str) {
        let document = json!({"uri": URI, "languageId": "glsl", "version": 0, "text": text});
        self.send(&json!({"method": "textDocument/didOpen", "params": {"textDocument": document}}));
    }

    fn change(&mut self, version: i32, text: &str) {
        self.send(&json!({"method": "textDocument/didChange", "params": {
            "textDocument": {"uri": URI, "version": version}, "contentChanges": [{"text": text}],
        }}));
    }

    /// Does what is to be done until nothing is read any more.
    fn rest(&mut self) {
        loop {
            let mut out = Vec::new();
            let has_more = self.server.idle(&mut out);
            self.sent.extend(out.into_iter().map(|message| serde_json::to_value(message).unwrap()));
            match (has_more, self.server.is_reading()) {
                (true, _) => {}
                (false, true) => thread::sleep(Duration::from_millis(2)),
                (false, false) => return,
            }
        }
    }

    fn hover(&mut self, id: i32, character: u32) -> Value {
        let at = json!({"textDocument": {"uri": URI}, "position": {"line": 0, "character": character}});
        self.send(&json!({"id": id, "method": "textDocument/hover", "params": at}));
        let answer = self.sent.iter().find(|message| message["id"] == id);
        answer.expect("every request is answered at once").clone()
    }

    /// The version and the number of messages of each publication.
    fn published(&self) -> Vec<(i64, usize)> {
        let lists = self.sent.iter().filter(|message| message["method"] == "textDocument/publishDiagnostics");
        lists
            .map(|message| {
                let params = &message["params"];
                (params["version"].as_i64().unwrap_or(-1), params["diagnostics"].as_array().unwrap().len())
            })
            .collect()
    }
}

fn image(body: &str) -> String {
    format!("void mainImage(out vec4 color, in vec2 at) {{ {body} }}")
}

/// A text that is read for longer than a request waits.
fn long() -> String {
    image(&(0..40_000).map(|i| format!("color.x = no_function_{i}(1.0);\n")).collect::<String>())
}

#[test]
fn a_request_is_answered_while_a_text_is_read_and_outdated_texts_are_given_up() {
    let mut editor = Editor::new(&json!({"workspace": {"semanticTokens": {"refreshSupport": true}}}));
    editor.open(&long());
    let refused = editor.hover(1, 6);
    // ContentModified: editors ask again, and show nothing.
    assert_eq!(refused["error"]["code"], -32_801, "{refused}");
    assert!(editor.server.is_reading());
    for version in 1..20 {
        editor.change(version, &format!("{}// {version}", long()));
    }
    editor.change(20, &image("color = vec4(at, sn(1.0), 1.0);"));
    editor.rest();
    // Nothing was said of the texts before.
    assert_eq!(editor.published(), [(20, 1)]);
    let answer = editor.hover(2, 6);
    assert!(answer["result"].to_string().contains("mainImage"), "{answer}");
    // Colours that were refused are asked for again.
    assert!(editor.sent.iter().any(|message| message["method"] == "workspace/semanticTokens/refresh"));
}

#[test]
fn a_text_that_takes_long_is_read_in_the_end() {
    let mut editor = Editor::new(&json!({}));
    editor.open(&long());
    editor.rest();
    assert!(matches!(editor.published()[..], [(0, messages)] if messages > 10), "{:?}", editor.published());
    assert!(!editor.sent.iter().any(|message| message["method"] == "workspace/semanticTokens/refresh"));
    // What is read is known to the next request.
    assert!(editor.hover(1, 6)["result"].to_string().contains("mainImage"));
}

#[test]
fn a_document_that_is_closed_while_it_is_read_has_no_messages() {
    let mut editor = Editor::new(&json!({}));
    editor.open(&long());
    editor.hover(1, 6);
    editor.send(&json!({"method": "textDocument/didClose", "params": {"textDocument": {"uri": URI}}}));
    editor.rest();
    assert!(editor.published().iter().all(|(_, messages)| *messages == 0), "{:?}", editor.published());
}
