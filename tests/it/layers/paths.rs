//! The paths that a Rust text names, each with its module and line.

use proc_macro2::{TokenStream, TokenTree};
use syn::{
    File, ItemMod, ItemUse, Macro, UseTree, Visibility,
    spanned::Spanned,
    visit::{self, Visit},
};

/// A path as it is written.
#[derive(Debug, PartialEq, Eq)]
pub(super) struct Named {
    /// The modules of the same file that contain it, from the outside in.
    pub within: Vec<String>,
    pub segments: Vec<String>,
    pub line: usize,
}

/// Returns every path, including single names. Comments and strings are ignored; arguments of macros count.
pub(super) fn of_file(file: &File) -> Vec<Named> {
    let mut reader = Reader::default();
    reader.visit_file(file);
    reader.found
}

/// Works like [`of_file`], but on a text that need not be a whole file: single statements, for example.
pub(super) fn of_tokens(tokens: TokenStream) -> Vec<Named> {
    let mut reader = Reader::default();
    reader.scan(tokens);
    reader.found
}

#[derive(Default)]
struct Reader {
    within: Vec<String>,
    found: Vec<Named>,
}

impl Reader {
    fn add(&mut self, segments: Vec<String>, line: usize) {
        if !segments.is_empty() {
            self.found.push(Named { within: self.within.clone(), segments, line });
        }
    }

    fn tree(&mut self, tree: &UseTree, before: &[String]) {
        let with = |name: String| before.iter().cloned().chain([name]).collect::<Vec<_>>();
        let line = tree.span().start().line;
        match tree {
            UseTree::Path(path) => self.tree(&path.tree, &with(path.ident.to_string())),
            UseTree::Name(name) if name.ident == "self" => self.add(before.to_vec(), line),
            UseTree::Name(name) => self.add(with(name.ident.to_string()), line),
            UseTree::Rename(name) => self.add(with(name.ident.to_string()), line),
            UseTree::Glob(_) => self.add(with("*".into()), line),
            UseTree::Group(group) => group.items.iter().for_each(|tree| self.tree(tree, before)),
        }
    }

    fn scan(&mut self, tokens: TokenStream) {
        let (mut segments, mut line, mut colons) = (Vec::new(), 0, 0);
        for token in tokens {
            match token {
                TokenTree::Ident(name) if segments.is_empty() || colons == 2 => {
                    if segments.is_empty() {
                        line = name.span().start().line;
                    }
                    segments.push(name.to_string());
                    colons = 0;
                    continue;
                }
                TokenTree::Punct(sign) if sign.as_char() == ':' && !segments.is_empty() && colons < 2 => {
                    colons += 1;
                    continue;
                }
                TokenTree::Ident(name) => {
                    self.add(std::mem::take(&mut segments), line);
                    (segments, line, colons) = (vec![name.to_string()], name.span().start().line, 0);
                    continue;
                }
                TokenTree::Group(group) => self.scan(group.stream()),
                TokenTree::Punct(_) | TokenTree::Literal(_) => {}
            }
            self.add(std::mem::take(&mut segments), line);
            colons = 0;
        }
        self.add(segments, line);
    }
}

impl<'ast> Visit<'ast> for Reader {
    fn visit_item_mod(&mut self, module: &'ast ItemMod) {
        if module.content.is_none() {
            return;
        }
        self.within.push(module.ident.to_string());
        visit::visit_item_mod(self, module);
        self.within.pop();
    }

    fn visit_item_use(&mut self, item: &'ast ItemUse) {
        self.tree(&item.tree, &[]);
    }

    fn visit_path(&mut self, path: &'ast syn::Path) {
        let segments = path.segments.iter().map(|s| s.ident.to_string()).collect();
        self.add(segments, path.span().start().line);
        visit::visit_path(self, path);
    }

    fn visit_macro(&mut self, found: &'ast Macro) {
        visit::visit_macro(self, found);
        self.scan(found.tokens.clone());
    }

    /// The visibility of an item is not a use of the path.
    fn visit_visibility(&mut self, _: &'ast Visibility) {}
}
