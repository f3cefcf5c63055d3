//! `eddy lsp` while it reads a text: it answers requests, cancels outdated work, and publishes diagnostics of the
//! newest text only.

use eddy::lsp::Server;
use serde_json::{Value, json};
use std::{thread, time::Duration};

const URI: &str = "file:///nowhere/a.glsl";

struct Editor {
    server: Server,
    /// All messages that the server has sent.
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

    /// Lets the server work until it has read everything.
    fn finish(&mut self) {
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

    /// Returns the version and the number of messages of each publication.
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

/// Returns a text whose reading takes longer than a request waits.
fn slow_text() -> String {
    image(&(0..40_000).map(|i| format!("color.x = no_function_{i}(1.0);\n")).collect::<String>())
}

#[test]
fn requests_are_answered_during_reading_and_outdated_texts_are_cancelled() {
    let mut editor = Editor::new(&json!({"workspace": {"semanticTokens": {"refreshSupport": true}}}));
    editor.open(&slow_text());
    let error_answer = editor.hover(1, 6);
    // ContentModified: editors repeat the request, and show no error.
    assert_eq!(error_answer["error"]["code"], -32_801, "{error_answer}");
    assert!(editor.server.is_reading());
    for version in 1..20 {
        editor.change(version, &format!("{}// {version}", slow_text()));
    }
    editor.change(20, &image("color = vec4(at, sn(1.0), 1.0);"));
    editor.finish();
    // Nothing was published for the previous texts.
    assert_eq!(editor.published(), [(20, 1)]);
    let answer = editor.hover(2, 6);
    assert!(answer["result"].to_string().contains("mainImage"), "{answer}");
    // The client is asked to request rejected semantic tokens again.
    assert!(editor.sent.iter().any(|message| message["method"] == "workspace/semanticTokens/refresh"));
}

#[test]
fn a_slow_text_is_read_eventually() {
    let mut editor = Editor::new(&json!({}));
    editor.open(&slow_text());
    editor.finish();
    assert!(matches!(editor.published()[..], [(0, messages)] if messages > 10), "{:?}", editor.published());
    assert!(!editor.sent.iter().any(|message| message["method"] == "workspace/semanticTokens/refresh"));
    // A text that has been read is available to the next request.
    assert!(editor.hover(1, 6)["result"].to_string().contains("mainImage"));
}

#[test]
fn a_document_that_is_closed_during_reading_gets_no_messages() {
    let mut editor = Editor::new(&json!({}));
    editor.open(&slow_text());
    editor.hover(1, 6);
    editor.send(&json!({"method": "textDocument/didClose", "params": {"textDocument": {"uri": URI}}}));
    editor.finish();
    assert!(editor.published().iter().all(|(_, messages)| *messages == 0), "{:?}", editor.published());
}
