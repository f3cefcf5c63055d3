//! The texts that the editor has open.

use super::{
    positions::{Encoding, Lines},
    uris,
};
use eddy_project::EditedTexts;
use gen_lsp_types::{TextDocumentContentChangeEvent, TextDocumentItem, VersionedTextDocumentIdentifier};
use std::{collections::BTreeMap, path::PathBuf, sync::Arc};

#[derive(Clone, Debug)]
pub(crate) struct Document {
    pub uri: String,
    /// The file's path, or a unique one for a document that is not saved yet.
    pub path: PathBuf,
    pub version: i32,
    pub text: Arc<str>,
}

/// Documents by their paths.
#[derive(Clone, Debug, Default)]
pub(crate) struct Documents {
    open: BTreeMap<PathBuf, Document>,
    /// The same texts, as projects read them.
    texts: EditedTexts,
}

/// A folder that no file system has: the parent of documents without a file.
const UNSAVED: &str = "/\u{0}unsaved";

/// Returns the path that identifies a document.
pub(crate) fn path_of(uri: &str) -> PathBuf {
    uris::path(uri).unwrap_or_else(|| {
        let name = uri.rsplit(['/', ':']).next().unwrap_or_default();
        let folder: String = uri.chars().map(|c| if c.is_alphanumeric() { c } else { '_' }).collect();
        PathBuf::from(UNSAVED).join(folder).join(name)
    })
}

impl Documents {
    pub(crate) fn open(&mut self, item: TextDocumentItem) -> PathBuf {
        let path = path_of(&item.uri.0);
        let text: Arc<str> = item.text.into();
        self.texts.insert(path.clone(), text.clone());
        let document = Document { uri: item.uri.0, path: path.clone(), version: item.version, text };
        self.open.insert(path.clone(), document);
        path
    }

    /// Applies changes in order. Those of a document that is not open are dropped.
    pub(crate) fn change(
        &mut self,
        of: &VersionedTextDocumentIdentifier,
        changes: Vec<TextDocumentContentChangeEvent>,
        encoding: Encoding,
    ) -> Option<PathBuf> {
        let path = path_of(&of.text_document_identifier.uri.0);
        let document = self.open.get_mut(&path)?;
        let mut text = document.text.to_string();
        for change in changes {
            match change {
                TextDocumentContentChangeEvent::TextDocumentContentChangePartial(part) => {
                    let range = Lines::new(&text, encoding).bytes(part.range);
                    text.replace_range(range, &part.text);
                }
                TextDocumentContentChangeEvent::TextDocumentContentChangeWholeDocument(whole) => text = whole.text,
            }
        }
        document.version = of.version;
        document.text = text.into();
        self.texts.insert(path.clone(), document.text.clone());
        Some(path)
    }

    pub(crate) fn close(&mut self, uri: &str) -> Option<PathBuf> {
        let path = path_of(uri);
        self.texts.remove(&path);
        self.open.remove(&path).map(|_| path)
    }

    pub(crate) fn get(&self, path: &std::path::Path) -> Option<&Document> {
        self.open.get(path)
    }

    pub(crate) fn iter(&self) -> impl Iterator<Item = &Document> {
        self.open.values()
    }

    pub(crate) fn texts(&self) -> &EditedTexts {
        &self.texts
    }

    /// Returns the URI of a file, in the editor's spelling if it has it open.
    pub(crate) fn uri(&self, path: &std::path::Path) -> String {
        self.open.get(path).map_or_else(|| uris::uri(path), |document| document.uri.clone())
    }
}
