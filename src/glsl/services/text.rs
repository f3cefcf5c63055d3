//! A text as written: every token before macro expansion, comments, directives, brackets.
//!
//! The parser's stream only contains what is compiled, and nothing of a statement that it could not parse. Queries
//! about incomplete lines are answered from here.

use crate::{
    Text,
    ast::{Interner, Origins, Symbol},
    lex::{Kind, LINE_START, Lexer, words},
    parse::brackets,
    preprocess::Tok,
};
use eddy_diag::{SourceId, Span};
use std::{ops::Range, sync::Arc};

/// One token of the text.
#[derive(Clone, Copy, Debug)]
pub(super) struct Lexeme {
    /// Keywords are distinguished from names.
    pub kind: Kind,
    /// For names: the symbol.
    pub value: u32,
    pub start: u32,
    pub end: u32,
    /// Index of the matching bracket; [`brackets::ALONE`] for other tokens and for unmatched brackets.
    pub partner: u32,
    /// Index of the innermost bracket around it that is matched or is an open brace; `ALONE` outside of all.
    pub around: u32,
    /// Its part of a directive: `#` and the word after it, or the rest of the line.
    pub directive: Directive,
    /// An `#if` leaves it out.
    pub is_inactive: bool,
    pub starts_line: bool,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Directive {
    No,
    /// `#` or its word.
    Head,
    /// The rest of the line.
    Body,
}

impl Lexeme {
    /// Returns whether it is a name, keyword or type.
    pub(super) fn is_word(&self) -> bool {
        self.kind == Kind::Ident || self.kind == Kind::BadName || self.kind.is_keyword()
    }

    pub(super) fn symbol(&self) -> Symbol {
        Symbol(self.value)
    }

    pub(super) fn range(&self) -> Range<usize> {
        self.start as usize..self.end as usize
    }
}

#[derive(Clone, Debug)]
pub(super) struct Source {
    pub id: SourceId,
    pub text: Arc<str>,
    pub tokens: Vec<Lexeme>,
    pub comments: Vec<Range<u32>>,
    pub inactive: Vec<Range<u32>>,
}

impl Source {
    pub(super) fn new(text: Text<'_>, origins: &Origins, names: &mut Interner) -> Self {
        let inactive: Vec<Range<u32>> =
            origins.inactive.iter().filter(|s| s.source == text.id).map(|s| s.start..s.end).collect();
        let mut source = Self {
            id: text.id,
            text: text.text.into(),
            tokens: Vec::with_capacity(text.text.len() / 4 + 8),
            comments: Vec::new(),
            inactive,
        };
        source.read(names);
        source.pair();
        source
    }

    /// Returns the index of the first token that starts at or after `offset`.
    pub(super) fn first_from(&self, offset: usize) -> usize {
        self.tokens.partition_point(|t| (t.start as usize) < offset)
    }

    /// Returns the word that contains `offset` or has it at either end.
    pub(super) fn word_at(&self, offset: usize) -> Option<usize> {
        let next = self.first_from(offset + 1);
        let holds = |i: usize| self.tokens.get(i).is_some_and(|t| t.is_word() && t.end as usize >= offset);
        let last = next.checked_sub(1)?;
        if holds(last) {
            return Some(last);
        }
        // After `foo` in `foo(`, where the bracket starts.
        last.checked_sub(1).filter(|&i| holds(i))
    }

    /// Returns the name that a span covers exactly.
    pub(super) fn token_of(&self, span: Span) -> Option<usize> {
        let i = self.first_from(span.start as usize);
        self.tokens.get(i).filter(|t| t.start == span.start)?;
        Some(i)
    }

    pub(super) fn text_of(&self, token: usize) -> &str {
        self.text.get(self.tokens[token].range()).unwrap_or("")
    }

    pub(super) fn span_of(&self, token: usize) -> Span {
        Span::new(self.id, self.tokens[token].range())
    }

    pub(super) fn kind(&self, token: usize) -> Kind {
        self.tokens.get(token).map_or(Kind::Eof, |t| t.kind)
    }

    pub(super) fn partner(&self, token: usize) -> Option<usize> {
        let partner = self.tokens.get(token)?.partner;
        (partner != brackets::ALONE).then_some(partner as usize)
    }

    pub(super) fn around(&self, token: usize) -> Option<usize> {
        let around = self.tokens.get(token)?.around;
        (around != brackets::ALONE).then_some(around as usize)
    }

    /// Returns whether it is inside a comment, or at the end of one that extends to the end of its line.
    pub(super) fn is_comment(&self, offset: usize) -> bool {
        let at = self.comments.partition_point(|c| (c.start as usize) < offset);
        let Some(comment) = at.checked_sub(1).map(|i| &self.comments[i]) else { return false };
        let text = self.text.get(comment.start as usize..comment.end as usize).unwrap_or("");
        let reaches_on = text.starts_with("//") || !(text.len() > 3 && text.ends_with("*/"));
        offset < comment.end as usize || (reaches_on && offset == comment.end as usize)
    }

    pub(super) fn is_inactive(&self, offset: usize) -> bool {
        let at = self.inactive.partition_point(|r| (r.start as usize) <= offset);
        at > 0 && offset < self.inactive[at - 1].end as usize
    }

    fn read(&mut self, names: &mut Interner) {
        let text = self.text.clone();
        let mut lexer = Lexer::new(self.id, &text);
        let (mut before, mut directive, mut inactive) = (0usize, Directive::No, 0usize);
        loop {
            let token = lexer.next(names);
            let (start, end) = (token.span.start, token.span.end);
            let gap_end = if token.kind == Kind::Eof { text.len() } else { start as usize };
            self.take_comments(before..gap_end.max(before));
            before = end as usize;
            match token.kind {
                Kind::Eof => break,
                Kind::Newline => {
                    directive = Directive::No;
                    before = start as usize;
                    continue;
                }
                Kind::OpenComment => {
                    self.comments.push(start..text.len() as u32);
                    break;
                }
                _ => {}
            }
            if token.kind == Kind::Hash && token.has(LINE_START) {
                lexer.start_directive();
                directive = Directive::Head;
            }
            while self.inactive.get(inactive).is_some_and(|r| r.end <= start) {
                inactive += 1;
            }
            let kind = if token.kind == Kind::Ident { words::kind(token.value) } else { token.kind };
            self.tokens.push(Lexeme {
                kind,
                value: token.value,
                start,
                end,
                partner: brackets::ALONE,
                around: brackets::ALONE,
                directive,
                is_inactive: self.inactive.get(inactive).is_some_and(|r| r.start <= start),
                starts_line: token.has(LINE_START),
            });
            if directive == Directive::Head && token.kind != Kind::Hash {
                directive = Directive::Body;
                if text.get(start as usize..end as usize) == Some("error") {
                    let (_, rest) = lexer.rest_of_line();
                    before = rest.end as usize;
                }
            }
        }
    }

    /// Adds the comments between two tokens, where there is nothing else but white space.
    fn take_comments(&mut self, gap: Range<usize>) {
        let bytes = self.text.as_bytes();
        let mut at = gap.start;
        while at + 1 < gap.end {
            let end = match (bytes[at], bytes[at + 1]) {
                (b'/', b'/') => {
                    let ends = |i: usize| bytes[i] == b'\n' && !is_continued(&bytes[..i]);
                    (at..gap.end).find(|&i| ends(i)).unwrap_or(gap.end)
                }
                (b'/', b'*') => {
                    let close = bytes[at + 2..gap.end].windows(2).position(|w| w == b"*/");
                    close.map_or(gap.end, |i| at + i + 4)
                }
                _ => {
                    at += 1;
                    continue;
                }
            };
            self.comments.push(at as u32..end as u32);
            at = end;
        }
    }

    /// Finds partners and enclosing brackets: in code, and separately in each directive.
    fn pair(&mut self) {
        let is_code = |t: &Lexeme| t.directive == Directive::No && !t.is_inactive;
        let code: Vec<u32> = (0..self.tokens.len() as u32).filter(|&i| is_code(&self.tokens[i as usize])).collect();
        self.pair_part(&code);
        let mut line = Vec::new();
        for i in 0..=self.tokens.len() {
            let token = self.tokens.get(i);
            if token.is_none_or(|t| t.directive != Directive::Body) {
                self.pair_part(&line);
                line.clear();
            } else {
                line.push(i as u32);
            }
        }
    }

    fn pair_part(&mut self, part: &[u32]) {
        if part.is_empty() {
            return;
        }
        let mut tokens: Vec<Tok> =
            part.iter().map(|&i| Tok { kind: self.tokens[i as usize].kind, value: brackets::ALONE }).collect();
        brackets::pair(&mut tokens, 0);
        let mut open: Vec<u32> = Vec::new();
        for (at, &i) in part.iter().enumerate() {
            let Tok { kind, value } = tokens[at];
            let token = &mut self.tokens[i as usize];
            let is_bracket = matches!(
                kind,
                Kind::LParen | Kind::RParen | Kind::LBracket | Kind::RBracket | Kind::LBrace | Kind::RBrace
            );
            if is_bracket && value != brackets::ALONE {
                token.partner = part[value as usize];
            }
            if matches!(kind, Kind::RParen | Kind::RBracket | Kind::RBrace) && value != brackets::ALONE {
                while let Some(top) = open.pop() {
                    if top == part[value as usize] {
                        break;
                    }
                }
            }
            token.around = open.last().copied().unwrap_or(brackets::ALONE);
            let opens = matches!(kind, Kind::LParen | Kind::LBracket) && value != brackets::ALONE;
            if opens || kind == Kind::LBrace {
                open.push(i);
            }
        }
    }
}

/// Returns whether a line, without its end, continues on the next.
fn is_continued(line: &[u8]) -> bool {
    line.strip_suffix(b"\r").unwrap_or(line).ends_with(b"\\")
}
