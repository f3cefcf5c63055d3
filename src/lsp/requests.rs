//! The requests about documents, by method.

use super::{
    actions, completion,
    documents::path_of,
    hints, hover,
    messages::{Answer, answer, error, failed},
    navigation,
    positions::{Encoding, Lines},
    program::Program,
    published::Places,
    symbols, tokens,
    workspace::{READ_TIMEOUT, Unavailable, Workspace},
};
use eddy_diag::SourceId;
use gen_lsp_types::{
    self as lsp, CodeActionContext, CodeActionKind, Contents, Hover, Position, PrepareRenamePlaceholder,
    PrepareRenameResult, ReferenceContext, TextDocumentIdentifier, TextDocumentPositionParams,
};
use lsp_server::ErrorCode;
use serde::{Deserialize, de::DeserializeOwned};
use serde_json::Value;

/// The optional abilities of an editor.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct ClientCapabilities {
    /// Parameters of a signature are given as offsets into its label.
    pub label_offsets: bool,
    /// Requests of the server that make the editor refresh colours and hints.
    pub refreshed: [Option<&'static str>; 2],
}

/// Request parameters, limited to the members that Eddy needs: an editor may send others.
#[derive(Deserialize)]
#[serde(rename_all = "camelCase")]
struct DocumentParams {
    text_document: TextDocumentIdentifier,
}

#[derive(Deserialize)]
#[serde(rename_all = "camelCase")]
struct RangeParams {
    text_document: TextDocumentIdentifier,
    range: lsp::Range,
    context: Option<CodeActionContext>,
}

#[derive(Deserialize)]
#[serde(rename_all = "camelCase")]
struct ReferenceParams {
    context: ReferenceContext,
    #[serde(flatten)]
    place: TextDocumentPositionParams,
}

#[derive(Deserialize)]
#[serde(rename_all = "camelCase")]
struct RenameParams {
    new_name: String,
    #[serde(flatten)]
    place: TextDocumentPositionParams,
}

#[derive(Deserialize)]
struct QueryParams {
    query: String,
}

fn read<T: DeserializeOwned>(params: Value) -> Result<T, lsp_server::ResponseError> {
    serde_json::from_value(params).map_err(|why| error(ErrorCode::InvalidParams, why.to_string()))
}

/// A text of a program that is being queried.
struct QueriedText<'a> {
    program: &'a Program,
    places: Places<'a>,
    id: SourceId,
}

impl<'a> QueriedText<'a> {
    fn lines(&mut self) -> Lines<'a> {
        self.places.lines(self.id).clone()
    }

    fn offset(&mut self, position: Position) -> usize {
        let id = self.id;
        self.places.lines(id).offset(position)
    }
}

/// Queries a document. One that is not open, or whose program is unknown, gets the empty answer.
fn query_document(
    workspace: &mut Workspace,
    encoding: Encoding,
    document: &TextDocumentIdentifier,
    work: impl FnOnce(QueriedText<'_>) -> Answer,
) -> Answer {
    let path = path_of(&document.uri.0);
    match workspace.find(&path) {
        Ok(_) => {}
        Err(Unavailable::Unknown) => return Ok(Value::Null),
        Err(Unavailable::Reading) => return Err(reading_error()),
    }
    // Looked up again, because the result borrows the documents too.
    let owner = workspace.owner(&path).map(|index| &workspace.programs[index]);
    let Some((program, id)) = owner.and_then(|program| Some((program, program.id_of(&path)?))) else {
        return Ok(Value::Null);
    };
    work(QueriedText { program, places: Places::new(program, &workspace.documents, encoding), id })
}

/// Formats a document. The text is enough: it need not be analysed.
fn format(workspace: &Workspace, encoding: Encoding, params: Value) -> Answer {
    let DocumentParams { text_document } = read(params)?;
    let Some(document) = workspace.documents.get(&path_of(&text_document.uri.0)) else { return Ok(Value::Null) };
    let lines = Lines::new(&document.text, encoding);
    let edits = eddy_glsl::format_edits(&document.text).into_iter();
    let edit = |(range, new_text)| lsp::TextEdit { range: lines.range(range), new_text };
    answer(edits.map(edit).collect::<Vec<_>>())
}

/// The answer to a request about a program that is being read: editors repeat it, or ask again after the next change.
fn reading_error() -> lsp_server::ResponseError {
    error(ErrorCode::ContentModified, "the text is still being analysed: ask again")
}

/// Answers a request; `None` for a method that Eddy does not know.
pub(crate) fn request(
    workspace: &mut Workspace,
    (encoding, abilities): (Encoding, ClientCapabilities),
    method: &str,
    params: Value,
) -> Option<Answer> {
    let about_place =
        |params: Value, workspace: &mut Workspace, work: &dyn Fn(QueriedText<'_>, usize) -> Answer| -> Answer {
            let TextDocumentPositionParams { text_document, position } = read(params)?;
            query_document(workspace, encoding, &text_document, |mut asked| {
                let at = asked.offset(position);
                work(asked, at)
            })
        };
    let about_document =
        |params: Value, workspace: &mut Workspace, work: &dyn Fn(QueriedText<'_>) -> Answer| -> Answer {
            let DocumentParams { text_document } = read(params)?;
            query_document(workspace, encoding, &text_document, work)
        };
    Some(match method {
        "textDocument/hover" => about_place(params, workspace, &|mut asked, at| {
            let found = hover::hover(asked.program, asked.id, at);
            answer(found.map(|(text, span)| Hover {
                contents: Contents::MarkupContent(text),
                range: Some(asked.places.range(span)),
            }))
        }),
        "textDocument/completion" => about_place(params, workspace, &|mut asked, at| {
            let lines = asked.lines();
            answer(completion::completions(asked.program, asked.id, at, &lines))
        }),
        "textDocument/signatureHelp" => about_place(params, workspace, &|asked, at| {
            answer(hover::signature(asked.program, asked.id, at, encoding, abilities.label_offsets))
        }),
        "textDocument/definition" | "textDocument/declaration" => about_place(params, workspace, &|mut asked, at| {
            answer(navigation::definition(asked.program, &mut asked.places, asked.id, at))
        }),
        "textDocument/documentHighlight" => about_place(params, workspace, &|mut asked, at| {
            answer(navigation::highlights(asked.program, &mut asked.places, asked.id, at))
        }),
        "textDocument/references" => references(workspace, encoding, params),
        "textDocument/prepareRename" => about_place(params, workspace, &|mut asked, at| {
            let found = asked.program.programs(|programs| programs.renamable(asked.id, at));
            let (placeholder, span) = found.map_err(failed)?;
            let range = asked.places.range(span);
            answer(PrepareRenameResult::PrepareRenamePlaceholder(PrepareRenamePlaceholder { range, placeholder }))
        }),
        "textDocument/rename" => rename(workspace, encoding, params),
        "textDocument/documentSymbol" => about_document(params, workspace, &|mut asked| {
            let lines = asked.lines();
            answer(symbols::of_document(asked.program, asked.id, &lines))
        }),
        "textDocument/foldingRange" => about_document(params, workspace, &|mut asked| {
            let lines = asked.lines();
            answer(tokens::folds(asked.program, asked.id, &lines))
        }),
        "textDocument/formatting" => format(workspace, encoding, params),
        "textDocument/semanticTokens/full" => about_document(params, workspace, &|mut asked| {
            let lines = asked.lines();
            answer(tokens::tokens(asked.program, asked.id, &lines, 0..u32::MAX))
        }),
        "textDocument/semanticTokens/range" => query_range(workspace, encoding, params, |mut asked, range, _| {
            let lines = asked.lines();
            let rows = range.start.line..range.end.line.saturating_add(1);
            answer(tokens::tokens(asked.program, asked.id, &lines, rows))
        }),
        "textDocument/inlayHint" => query_range(workspace, encoding, params, |mut asked, range, _| {
            let lines = asked.lines();
            answer(hints::hints(asked.program, asked.id, &lines, lines.bytes(range)))
        }),
        "textDocument/codeAction" => query_range(workspace, encoding, params, |mut asked, range, context| {
            // An editor that requests only refactorings gets no fixes.
            let only = context.and_then(|context| context.only);
            let is_wanted = |kind: &CodeActionKind| matches!(kind, CodeActionKind::QuickFix | CodeActionKind::Empty);
            if only.is_some_and(|only| !only.iter().any(is_wanted)) {
                return answer(Vec::<lsp::CodeAction>::new());
            }
            let bytes = asked.lines().bytes(range);
            answer(actions::actions(asked.program, &mut asked.places, asked.id, bytes))
        }),
        "workspace/symbol" => read(params).and_then(|QueryParams { query }| {
            if !workspace.settle_within(READ_TIMEOUT) {
                return Err(reading_error());
            }
            let mut found = Vec::new();
            for program in &workspace.programs {
                symbols::of_program(program, &workspace.documents, encoding, &query, &mut found);
            }
            answer(found)
        }),
        "textDocument/rangeFormatting" | "textDocument/onTypeFormatting" => {
            Err(failed("Eddy formats whole documents only"))
        }
        _ => return None,
    })
}

fn query_range(
    workspace: &mut Workspace,
    encoding: Encoding,
    params: Value,
    work: impl FnOnce(QueriedText<'_>, lsp::Range, Option<CodeActionContext>) -> Answer,
) -> Answer {
    let RangeParams { text_document, range, context } = read(params)?;
    query_document(workspace, encoding, &text_document, |asked| work(asked, range, context))
}

fn references(workspace: &mut Workspace, encoding: Encoding, params: Value) -> Answer {
    let ReferenceParams { context, place } = read(params)?;
    query_document(workspace, encoding, &place.text_document, |mut asked| {
        let at = asked.offset(place.position);
        let all = context.include_declaration;
        answer(navigation::references(asked.program, &mut asked.places, asked.id, at, all))
    })
}

fn rename(workspace: &mut Workspace, encoding: Encoding, params: Value) -> Answer {
    let RenameParams { new_name, place } = read(params)?;
    query_document(workspace, encoding, &place.text_document, |mut asked| {
        let at = asked.offset(place.position);
        let fix = asked.program.rename((asked.id, at), &new_name).map_err(failed)?;
        answer(actions::edit(asked.program, &mut asked.places, &fix))
    })
}
