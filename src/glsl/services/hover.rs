//! Hover: a name's declaration, its documentation, and where it is declared.

use super::{
    analysis::Analysis,
    docs,
    infer::Infer,
    symbols::Target,
    text::{Directive, Source},
};
use crate::{
    ast::BasicType,
    hir::{DeclRef, ExprId, ExprKind, LocalKind, Type},
    lex::Kind as Token,
    near,
};
use eddy_diag::{SourceId, Span};

/// The limit of names that a misspelled one is compared with: more take too long for a tooltip.
const MAX_CANDIDATES: usize = 20_000;

/// The hover text of a name. Plain text, no markup.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Hover {
    /// The name that it describes.
    pub span: Span,
    /// The kind of the name: `local variable`, `built-in function`.
    pub kind: &'static str,
    /// Its declaration as GLSL: one line for each overload, or a struct's lines. Empty for keywords.
    pub signature: Vec<String>,
    /// Eddy's documentation of a predefined name, otherwise the author's comment above the declaration; may be empty.
    pub doc: String,
    /// Its name in the declaration; `None` for predefined names.
    pub declared: Option<Span>,
}

impl Analysis {
    /// Returns the hover at `offset`; `None` for tokens that need no explanation.
    pub fn hover(&self, source: SourceId, offset: usize) -> Option<Hover> {
        let (source, token) = self.word_at(source, offset)?;
        let text = &self.sources[source];
        let span = text.span_of(token);
        if text.tokens[token].is_inactive {
            return None;
        }
        let plain = |kind, signature, doc: &str| Hover { span, kind, signature, doc: doc.to_owned(), declared: None };
        if text.tokens[token].directive == Directive::Head {
            return docs::directive(text.text_of(token)).map(|doc| plain("directive", Vec::new(), doc));
        }
        if let Some(target) = self.target_of(source, token) {
            return Some(self.hover_of(target, span));
        }
        let word = text.text_of(token);
        match text.kind(token) {
            Token::Ident if token > 0 && text.kind(token - 1) == Token::Dot => {
                let infer = Infer::new(self, source, (source, span.start));
                let base = infer.before(token - 1)?;
                let ty = infer.before(token + 1)?;
                let signature = vec![format!("{} .{word}", self.type_name(ty))];
                let doc = format!("Components of a `{}`.", self.type_name(base));
                matches!(self.module.types.get(base), Type::Vector { .. }).then(|| plain("components", signature, &doc))
            }
            Token::Ident => {
                let near = self.nearest(source, token)?;
                Some(plain("unknown name", Vec::new(), &format!("Not declared here. Did you mean `{near}`?")))
            }
            Token::Type => None,
            _ => docs::keyword(word).map(|doc| plain("keyword", Vec::new(), doc)),
        }
    }

    /// Returns the name that an unknown one at `offset` was probably meant to be.
    pub fn near(&self, source: SourceId, offset: usize) -> Option<String> {
        let (source, token) = self.word_at(source, offset)?;
        let is_unknown = self.sources[source].kind(token) == Token::Ident && self.target_of(source, token).is_none();
        is_unknown.then(|| self.nearest(source, token)).flatten()
    }

    fn nearest(&self, source: usize, token: usize) -> Option<String> {
        let text = &self.sources[source];
        let at = (source, text.tokens[token].start);
        let items = self.everything_at(at);
        let types = BasicType::ALL.iter().map(|ty| ty.name());
        let all = items.iter().map(|item| item.label.as_str()).chain(types).take(MAX_CANDIDATES);
        near::nearest_identifier(text.text_of(token), all).map(str::to_owned)
    }

    fn hover_of(&self, target: Target, span: Span) -> Hover {
        let name = self.text_of(span);
        let declared = self.declaration(target);
        let doc = match target {
            Target::Decl(DeclRef::Builtin(builtin)) => builtin.text.to_owned(),
            _ => {
                let own = declared.map(|at| self.comment_above(at)).unwrap_or_default();
                if own.is_empty() { docs::variable(name).unwrap_or_default().to_owned() } else { own }
            }
        };
        let mut signature = self.declared_as(target);
        if let Some(exact) = self.exact_builtin(target, span) {
            let more = signature.len() - 1;
            signature = vec![exact];
            if more > 0 {
                signature.push(format!("// and {more} more overload{}", if more == 1 { "" } else { "s" }));
            }
        }
        Hover { span, kind: self.kind_name(target), signature, doc, declared }
    }

    fn kind_name(&self, target: Target) -> &'static str {
        let Target::Decl(decl) = target else {
            return if target == Target::DeprecatedTime { "uniform" } else { "macro" };
        };
        match decl {
            DeclRef::Local(id) => match self.module[id].kind {
                LocalKind::Const => "local constant",
                LocalKind::Var => "local variable",
                _ => "parameter",
            },
            DeclRef::Global(_) => "global",
            DeclRef::Func(_) => "function",
            DeclRef::Struct(_) => "struct",
            DeclRef::Member(..) => "field",
            DeclRef::Builtin(_) => "built-in function",
            DeclRef::BuiltinVar(_) => "built-in variable",
            DeclRef::BuiltinConst(_) => "built-in constant",
            DeclRef::Uniform(_) | DeclRef::CustomUniform(_) | DeclRef::ChannelStruct(_) => "uniform",
            DeclRef::Channel(_) => "channel",
        }
    }

    /// Returns the overload that a call of a built-in resolves to, with its types.
    fn exact_builtin(&self, target: Target, span: Span) -> Option<String> {
        let Target::Decl(DeclRef::Builtin(builtin)) = target else { return None };
        let call = self.module.exprs.iter().find_map(|expr| match expr.kind {
            ExprKind::Builtin { builtin: called, args }
                if called == builtin && self.spelled(expr.loc.first) == span =>
            {
                Some((expr.ty, args))
            }
            _ => None,
        })?;
        let args = &self.module[call.1];
        let param = |(i, &arg): (usize, &ExprId)| {
            let ty = self.type_name(self.module[arg].ty);
            format!("{ty} {}", builtin.param(i, args.len()))
        };
        let params: Vec<String> = args.iter().enumerate().map(param).collect();
        Some(super::show::call_text(&format!("{} {}", self.type_name(call.0), builtin.name), &params).0)
    }

    /// Returns the author's comment that ends in the line above a declaration, or follows it on its line.
    pub(super) fn comment_above(&self, name: Span) -> String {
        let Some(source) = self.source_index(name.source) else { return String::new() };
        let source = &self.sources[source];
        let text = &source.text;
        let line_start = text[..name.start as usize].rfind('\n').map_or(0, |i| i + 1);
        let above = comments_before(source, line_start);
        if !above.is_empty() {
            return above;
        }
        let line_end = text[name.end as usize..].find('\n').map_or(text.len(), |i| name.end as usize + i);
        let after = source.comments.partition_point(|c| c.start < name.end);
        match source.comments.get(after) {
            Some(c) if (c.start as usize) < line_end => unwrap(&text[c.start as usize..c.end as usize]),
            _ => String::new(),
        }
    }
}

/// Returns the comments that end in the line before `line_start`, and those that directly precede them.
fn comments_before(source: &Source, line_start: usize) -> String {
    let text = &source.text;
    let mut lines = Vec::new();
    let mut below = line_start;
    let mut next = source.comments.partition_point(|c| (c.end as usize) <= line_start);
    while let Some(comment) = next.checked_sub(1).map(|i| &source.comments[i]) {
        let (start, end) = (comment.start as usize, comment.end as usize);
        let begins_line = text[..start].rsplit('\n').next().is_some_and(|before| before.trim().is_empty());
        let gap = text.get(end..below).unwrap_or("x");
        if !begins_line || !gap.trim().is_empty() || gap.matches('\n').count() > 1 {
            break;
        }
        lines.push(unwrap(&text[start..end]));
        below = text[..start].rfind('\n').map_or(0, |i| i + 1);
        next -= 1;
    }
    lines.reverse();
    lines.retain(|line| !line.is_empty());
    lines.join("\n")
}

/// Returns a comment without its delimiters; lines of dashes and the like are left out.
fn unwrap(comment: &str) -> String {
    let inner = comment.strip_prefix("/*").map(|c| c.strip_suffix("*/").unwrap_or(c)).unwrap_or(comment);
    let strip = |line: &str| {
        let line = line.trim().trim_start_matches(['/', '*', '!']).trim_end_matches(['*', '/']);
        let line = line.trim_matches(|c: char| c.is_whitespace() || matches!(c, '-' | '=' | '#' | '~' | '_'));
        line.to_owned()
    };
    let lines: Vec<String> = inner.lines().map(strip).filter(|line| !line.is_empty()).collect();
    lines.join("\n")
}
