//! Messages in, messages out: the lifecycle of a server, notifications about documents, and its idle work.

use super::{
    messages::error,
    positions::Encoding,
    program::Root,
    published::publish,
    requests::{self, ClientCapabilities},
    tokens, uris,
    workspace::Workspace,
};
use eddy_project as project;
use gen_lsp_types::{
    CodeActionKind, CodeActionOptions, CodeActionProvider, CompletionOptions, DeclarationProvider, DefinitionProvider,
    DidChangeTextDocumentParams, DidCloseTextDocumentParams, DidOpenTextDocumentParams, DocumentFormattingProvider,
    DocumentHighlightProvider, DocumentSymbolProvider, FoldingRangeProvider, Full, HoverProvider, InlayHintProvider,
    ReferencesProvider, RenameOptions, RenameProvider, Save, SemanticTokensOptions, SemanticTokensOptionsRange,
    SemanticTokensProvider, ServerCapabilities, SignatureHelpOptions, TextDocumentSync, TextDocumentSyncKind,
    TextDocumentSyncOptions, WorkspaceSymbolProvider,
};
use lsp_server::{ErrorCode, Message, Notification, Request, RequestId, Response};
use serde::de::DeserializeOwned;
use serde_json::{Value, json};
use std::{
    panic::{AssertUnwindSafe, catch_unwind},
    path::PathBuf,
    time::Duration,
};

/// The state of a server.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
enum ServerState {
    #[default]
    Uninitialised,
    Running,
    /// `shutdown` was requested.
    ShuttingDown,
}

/// A language server without a stream.
#[derive(Default)]
pub struct Server {
    state: ServerState,
    encoding: Encoding,
    client: ClientCapabilities,
    /// The editor reports files that change on disk, if requested.
    watches_files: bool,
    workspace: Workspace,
    /// Projects of folders that the editor has open: they are read even while none of their files is open.
    folders: Vec<PathBuf>,
}

impl Server {
    pub fn new() -> Self {
        Self::default()
    }

    /// Returns a server that reads programs on a separate thread. A request about one that is being read is refused
    /// after 50 ms, and a change cancels the reading. [`Server::idle`] must be called repeatedly while
    /// [`Server::is_reading`].
    pub fn threaded() -> Self {
        let mut server = Self::new();
        server.workspace.is_threaded = true;
        server
    }

    /// Returns whether a program is being read on the other thread.
    pub fn is_reading(&self) -> bool {
        self.workspace.is_reading()
    }

    /// Handles a message; messages to send are added to `out`. Returns the exit code when the editor ends the server:
    /// 0, or 1 if it did not request a shutdown first.
    pub fn handle(&mut self, message: Message, out: &mut Vec<Message>) -> Option<u8> {
        match message {
            Message::Request(request) => self.request(request, out),
            Message::Notification(Notification { method, .. }) if method == "exit" => {
                return Some(u8::from(self.state != ServerState::ShuttingDown));
            }
            Message::Notification(notification) => {
                self.catch_panic(|server| server.notified(notification, out));
            }
            // The server's own requests need no response.
            Message::Response(_) => {}
        }
        None
    }

    /// Does the next piece of idle work: reads changed programs, publishes diagnostics, checks pictures. Returns false
    /// if there is none.
    pub fn idle(&mut self, out: &mut Vec<Message>) -> bool {
        if self.state != ServerState::Running {
            return false;
        }
        let mut did = false;
        self.catch_panic(|server| did = server.idle_work(out));
        did
    }

    fn idle_work(&mut self, out: &mut Vec<Message>) -> bool {
        let is_stale = self.workspace.programs.iter().any(|program| program.is_stale) || self.workspace.is_reading();
        if is_stale && !self.workspace.settle_within(Duration::ZERO) {
            return false;
        }
        if std::mem::take(&mut self.workspace.has_refused) {
            let refresh = |method: &str| {
                let id = RequestId::from(format!("eddy-{method}"));
                Message::Request(Request { id, method: method.into(), params: Value::Null })
            };
            out.extend(self.client.refreshed.iter().flatten().map(|method| refresh(method)));
        }
        let folders = &self.folders;
        let left =
            self.workspace.take_closed_programs(|root| matches!(root, Root::Folder(path) if folders.contains(path)));
        for program in left {
            // The program that has these documents now publishes their diagnostics.
            for uri in program.published {
                if self.owner_of(&uri).is_none() {
                    out.push(publish_diagnostics(&json!({"uri": uri, "diagnostics": []})));
                }
            }
        }
        if let Some(index) = self.workspace.programs.iter().position(|program| program.is_unpublished) {
            self.publish(index, out);
            return true;
        }
        let unseen = self.workspace.programs.iter_mut().find(|program| program.has_unseen_media());
        let Some(program) = unseen else { return is_stale };
        program.look_at_media();
        true
    }

    fn owner_of(&self, uri: &str) -> Option<usize> {
        let path = super::documents::path_of(uri);
        self.workspace.documents.get(&path)?;
        self.workspace.owner(&path)
    }

    fn publish(&mut self, index: usize, out: &mut Vec<Message>) {
        let owners: Vec<(PathBuf, Option<usize>)> = (self.workspace.documents.iter())
            .map(|document| (document.path.clone(), self.workspace.owner(&document.path)))
            .collect();
        let is_others = |path: &std::path::Path| {
            owners.iter().any(|(other, owner)| other == path && owner.is_some_and(|owner| owner != index))
        };
        let Workspace { documents, programs, .. } = &mut self.workspace;
        for params in publish(&mut programs[index], documents, self.encoding, is_others) {
            out.push(publish_diagnostics(&params));
        }
    }

    /// Runs work that must not end the server, even by a panic.
    fn catch_panic(&mut self, work: impl FnOnce(&mut Self)) -> bool {
        let done = catch_unwind(AssertUnwindSafe(|| work(self)));
        if done.is_err() {
            log::error!("a message could not be handled; the documents are read again");
            // Unfinished work is done again from the start.
            self.workspace.drop_reading();
            self.workspace.programs.clear();
            let paths: Vec<PathBuf> = self.workspace.documents.iter().map(|d| d.path.clone()).collect();
            for path in paths {
                self.workspace.start_reading(Root::File(path));
            }
        }
        done.is_ok()
    }

    fn request(&mut self, Request { id, method, params }: Request, out: &mut Vec<Message>) {
        let answer = match (self.state, method.as_str()) {
            (ServerState::Uninitialised, "initialize") => {
                self.state = ServerState::Running;
                Ok(self.initialize(&params))
            }
            (ServerState::Uninitialised, _) => {
                Err(error(ErrorCode::ServerNotInitialized, "\"initialize\" comes first"))
            }
            (_, "initialize") => Err(error(ErrorCode::InvalidRequest, "\"initialize\" was sent before")),
            (ServerState::ShuttingDown, _) => Err(error(ErrorCode::InvalidRequest, "the server was shut down")),
            (ServerState::Running, "shutdown") => {
                self.state = ServerState::ShuttingDown;
                Ok(Value::Null)
            }
            (ServerState::Running, _) => {
                let setting = (self.encoding, self.client);
                let mut answer = None;
                let is_done = self.catch_panic(|server| {
                    answer = requests::request(&mut server.workspace, setting, &method, params);
                });
                match answer {
                    Some(answer) => answer,
                    None if is_done => {
                        Err(error(ErrorCode::MethodNotFound, format!("Eddy does not know the method {method}")))
                    }
                    None => Err(error(ErrorCode::InternalError, "this is a bug in Eddy: please report it")),
                }
            }
        };
        out.push(Message::Response(Response { id, response_result: answer }));
    }

    /// Reads the editor's capabilities member by member: an editor may send more than any version of the protocol
    /// defines.
    fn initialize(&mut self, params: &Value) -> Value {
        let at = |path: &str| params.pointer(path);
        let encodings = at("/capabilities/general/positionEncodings");
        let encodings: Vec<String> =
            encodings.and_then(|list| serde_json::from_value(list.clone()).ok()).unwrap_or_default();
        self.encoding = Encoding::choose(&encodings);
        let signature = "/capabilities/textDocument/signatureHelp/signatureInformation/parameterInformation";
        let is_on = |path: &str| at(path).and_then(Value::as_bool).unwrap_or_default();
        self.client.label_offsets = is_on(&format!("{signature}/labelOffsetSupport"));
        let refreshes = |what: &'static str, method: &'static str| {
            is_on(&format!("/capabilities/workspace/{what}/refreshSupport")).then_some(method)
        };
        self.client.refreshed = [
            refreshes("semanticTokens", "workspace/semanticTokens/refresh"),
            refreshes("inlayHint", "workspace/inlayHint/refresh"),
        ];
        self.watches_files = is_on("/capabilities/workspace/didChangeWatchedFiles/dynamicRegistration");
        let folders = at("/workspaceFolders").and_then(Value::as_array).into_iter().flatten();
        let folders = folders.filter_map(|folder| folder.get("uri")?.as_str());
        let root = at("/rootUri").and_then(Value::as_str);
        let is_project = |path: &PathBuf| project::folder_around(&path.join("image.glsl")).as_ref() == Some(path);
        for path in folders.chain(root).filter_map(uris::path).filter(is_project) {
            if !self.folders.contains(&path) {
                self.workspace.start_reading(Root::Folder(path.clone()));
                self.folders.push(path);
            }
        }
        json!({
            "capabilities": capabilities(self.encoding),
            "serverInfo": { "name": "eddy", "version": env!("CARGO_PKG_VERSION") },
        })
    }

    fn notified(&mut self, Notification { method, params }: Notification, out: &mut Vec<Message>) {
        if self.state != ServerState::Running {
            return;
        }
        match method.as_str() {
            "initialized" if self.watches_files => out.push(watch()),
            "textDocument/didOpen" => {
                if let Some(DidOpenTextDocumentParams { text_document }) = read(&method, params) {
                    let path = self.workspace.documents.open(text_document);
                    self.workspace.opened(&path);
                }
            }
            "textDocument/didChange" => {
                if let Some(DidChangeTextDocumentParams { text_document, content_changes }) = read(&method, params) {
                    let changed = self.workspace.documents.change(&text_document, content_changes, self.encoding);
                    if let Some(path) = changed {
                        self.workspace.changed(&path);
                    }
                }
            }
            "textDocument/didClose" => {
                if let Some(DidCloseTextDocumentParams { text_document }) = read(&method, params)
                    && let Some(path) = self.workspace.documents.close(&text_document.uri.0)
                {
                    // The file on disk is used again.
                    self.workspace.changed(&path);
                }
            }
            "workspace/didChangeWatchedFiles" => self.workspace.changed_on_disk(),
            // An editor that watches files has reported this one already.
            "textDocument/didSave" if !self.watches_files => self.workspace.changed_on_disk(),
            // `$/cancelRequest` is handled where messages are queued; all others are ignored.
            _ => {}
        }
    }

    /// Returns the answer to a request that the editor cancelled before it was handled.
    pub fn cancelled(id: RequestId) -> Message {
        Message::Response(Response { id, response_result: Err(error(ErrorCode::RequestCanceled, "cancelled")) })
    }
}

/// Reads the parameters of a notification; malformed ones cannot be reported to the editor.
fn read<T: DeserializeOwned>(method: &str, params: Value) -> Option<T> {
    serde_json::from_value(params).inspect_err(|why| log::warn!("{method}: {why}")).ok()
}

fn publish_diagnostics(params: &impl serde::Serialize) -> Message {
    Message::Notification(Notification::new("textDocument/publishDiagnostics".into(), params))
}

/// Returns the request to the editor to watch files on disk.
fn watch() -> Message {
    let pattern = "**/*.{glsl,frag,vert,fs,vs,toml,png,jpg,jpeg,webp,hdr,exr,npy,glb,gltf,obj,mp3,ogg,wav,mp4,webm}";
    let params = json!({ "registrations": [{
        "id": "eddy-files",
        "method": "workspace/didChangeWatchedFiles",
        "registerOptions": { "watchers": [{ "globPattern": pattern }] },
    }] });
    Message::Request(Request {
        id: RequestId::from("eddy-files".to_owned()),
        method: "client/registerCapability".into(),
        params,
    })
}

/// Returns the capabilities of this server.
fn capabilities(encoding: Encoding) -> ServerCapabilities {
    let letters = |all: &[&str]| Some(all.iter().map(|letter| (*letter).to_owned()).collect());
    ServerCapabilities {
        position_encoding: Some(encoding.kind()),
        text_document_sync: Some(TextDocumentSync::Options(TextDocumentSyncOptions {
            open_close: Some(true),
            change: Some(TextDocumentSyncKind::Incremental),
            save: Some(Save::Bool(true)),
            ..TextDocumentSyncOptions::default()
        })),
        completion_provider: Some(CompletionOptions {
            trigger_characters: letters(&[".", "#"]),
            ..CompletionOptions::default()
        }),
        hover_provider: Some(HoverProvider::Bool(true)),
        signature_help_provider: Some(SignatureHelpOptions {
            trigger_characters: letters(&["(", ","]),
            ..SignatureHelpOptions::default()
        }),
        declaration_provider: Some(DeclarationProvider::Bool(true)),
        definition_provider: Some(DefinitionProvider::Bool(true)),
        references_provider: Some(ReferencesProvider::Bool(true)),
        document_highlight_provider: Some(DocumentHighlightProvider::Bool(true)),
        document_symbol_provider: Some(DocumentSymbolProvider::Bool(true)),
        workspace_symbol_provider: Some(WorkspaceSymbolProvider::Bool(true)),
        code_action_provider: Some(CodeActionProvider::CodeActionOptions(CodeActionOptions {
            code_action_kinds: Some(vec![CodeActionKind::QuickFix]),
            ..CodeActionOptions::default()
        })),
        rename_provider: Some(RenameProvider::RenameOptions(RenameOptions {
            prepare_provider: Some(true),
            ..RenameOptions::default()
        })),
        document_formatting_provider: Some(DocumentFormattingProvider::Bool(true)),
        folding_range_provider: Some(FoldingRangeProvider::Bool(true)),
        semantic_tokens_provider: Some(SemanticTokensProvider::SemanticTokensOptions(SemanticTokensOptions {
            legend: tokens::legend(),
            range: Some(SemanticTokensOptionsRange::Bool(true)),
            full: Some(Full::Bool(true)),
            ..SemanticTokensOptions::default()
        })),
        inlay_hint_provider: Some(InlayHintProvider::Bool(true)),
        ..ServerCapabilities::default()
    }
}
