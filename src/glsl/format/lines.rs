//! The lines of a formatted text.

use super::{
    INDENT,
    token::{Kind, Token, would_merge},
};

/// The depth of blocks, brackets, control statements or `#if` lines up to which a text is formatted.
const MAX_DEPTH: usize = 64;

/// The state between two lines.
#[derive(Clone, Debug, Default)]
struct State {
    blocks: Vec<Block>,
    /// The open `(` and `[`; true: the parenthesis of a control statement.
    brackets: Vec<bool>,
    /// The number of `?` without their `:` in each of `brackets`, and outside of them.
    questions: Vec<usize>,
    /// The control statements whose body, without braces, has not ended: `if (…)`, `else`, `do`.
    headers: usize,
    /// Those before the block that was closed last, which an `else` continues.
    closed_headers: usize,
    /// The last word or sign.
    last: Last,
    /// The indentation of the first line of the current statement: as it was written, and as it is now.
    statement: Option<(usize, usize)>,
}

/// An open `{`.
#[derive(Clone, Copy, Debug)]
struct Block {
    indent: usize,
    headers: usize,
    /// A label came before: the statements after it have one more step of indentation.
    has_label: bool,
    /// The brackets that were open before it.
    brackets: usize,
}

/// The last token, on which the blanks before the next one depend.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
struct Last {
    text: String,
    role: Role,
}

#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
enum Role {
    /// Nothing came before in the statement.
    #[default]
    Start,
    Word,
    /// `if`, `for`, `while`, `switch`, `return` and the like, after which there is a blank.
    Keyword,
    /// An operator between two operands.
    Binary,
    /// An operator before its operand.
    Prefix,
    /// `++` or `--` after its operand.
    Postfix,
    Open,
    Close,
    Comma,
    Dot,
    /// `;`, `{`, `}`, or the `:` of a label.
    End,
}

#[derive(Debug, Default)]
pub(super) struct Lines {
    out: String,
    state: State,
    /// The states at the open `#if` lines: each branch continues from there.
    conditions: Vec<State>,
    blank_lines: usize,
}

const KEYWORDS: [&str; 8] = ["if", "for", "while", "switch", "return", "else", "do", "case"];

impl Lines {
    /// Adds a line with its line break.
    pub(super) fn add(&mut self, line: &[Token<'_>]) {
        let (all, line) = (line, line.strip_suffix_break());
        let Some(first) = line.first() else {
            self.blank_lines += 1;
            return;
        };
        if self.blank_lines > 0 && !self.out.is_empty() {
            self.out.push('\n');
        }
        self.blank_lines = 0;
        if let [directive] = line
            && directive.kind == Kind::Directive
        {
            self.condition(directive.text);
            self.out.push_str(without_end(directive.text));
        } else {
            let indent = self.indent(first, line);
            self.out.extend(std::iter::repeat_n(' ', indent));
            self.tokens(line, indent);
        }
        // A `\` at the end of the text has joined it with its last line break.
        if all.len() > line.len() || !self.out.ends_with('\n') {
            self.out.push('\n');
        }
    }

    /// Returns whether the text is nested deeper than any shader: its indentation would be larger than the text.
    pub(super) fn is_too_deep(&self) -> bool {
        let State { blocks, brackets, headers, .. } = &self.state;
        blocks.len().max(brackets.len()).max(*headers).max(self.conditions.len()) > MAX_DEPTH
    }

    pub(super) fn finish(self) -> String {
        self.out
    }

    /// Keeps the state at `#if`, so that braces in each of its branches count once.
    fn condition(&mut self, directive: &str) {
        let word = directive.trim_start_matches('#').trim_start();
        let word = word.split(|c: char| !c.is_ascii_alphanumeric()).next().unwrap_or_default();
        match word {
            "if" | "ifdef" | "ifndef" => self.conditions.push(self.state.clone()),
            "else" | "elif" => {
                if let Some(state) = self.conditions.last() {
                    self.state = state.clone();
                }
            }
            "endif" => drop(self.conditions.pop()),
            _ => {}
        }
    }

    /// Returns the indentation of a line.
    fn indent(&mut self, first: &Token<'_>, line: &[Token<'_>]) -> usize {
        let code = line.iter().find(|token| matches!(token.kind, Kind::Word | Kind::Sign));
        // A macro that is a whole statement, as its author knows.
        let is_aligned = self.state.statement.is_some_and(|(written, _)| first.blanks <= written);
        if is_aligned && first.kind == Kind::Word && self.state.last.role == Role::Close && self.state.is_outside() {
            self.state.statement = None;
        }
        let state = &self.state;
        let block = state.blocks.last();
        let starts = |text: &str| first.text == text;
        if starts("}") {
            return block.map_or(0, |block| block.indent.saturating_sub(INDENT));
        }
        let base = block.map_or(0, |block| block.indent);
        let is_label = matches!(code.map(|token| token.text), Some("case" | "default"));
        let label = if block.is_some_and(|block| block.has_label) && !is_label { INDENT } else { 0 };
        if let Some((written, now)) = state.statement {
            // The brace of a block on a line of its own is below its statement.
            if starts("{") && state.is_outside() {
                return now;
            }
            let least = if matches!(first.text, ")" | "]") { now } else { now + INDENT };
            return (first.blanks + now).saturating_sub(written).max(least);
        }
        let headers = match first.text {
            "else" => state.closed_headers.max(state.headers),
            "{" => state.headers.saturating_sub(1),
            _ => state.headers,
        };
        base + label + headers * INDENT
    }

    fn tokens(&mut self, line: &[Token<'_>], indent: usize) {
        let written = line.first().map_or(0, |token| token.blanks);
        let mut before: Option<&Token<'_>> = None;
        for token in line {
            let (role, has_blank) = self.role(token);
            if let Some(before) = before {
                let blanks = match token.kind {
                    // Aligned with those of other lines.
                    Kind::Comment if token.text.starts_with("//") => token.blanks.max(1),
                    _ if before.kind == Kind::Comment => usize::from(!matches!(role, Role::Close | Role::Comma)),
                    _ => usize::from(has_blank || would_merge(before.text, token.text)),
                };
                self.out.extend(std::iter::repeat_n(' ', blanks));
            }
            self.out.push_str(without_end(token.text));
            if matches!(token.kind, Kind::Word | Kind::Sign) {
                self.state.follow(token, role, (written, indent));
            } else if token.kind == Kind::Joined {
                self.state.last = Last { text: String::new(), role: Role::Word };
                self.state.statement.get_or_insert((written, indent));
            }
            before = Some(token);
        }
    }

    /// Returns what a token is, and whether there is a blank before it.
    fn role(&self, token: &Token<'_>) -> (Role, bool) {
        let state = &self.state;
        let last = state.last.role;
        if token.kind != Kind::Sign {
            let role = match token.kind {
                Kind::Word if KEYWORDS.contains(&token.text) => Role::Keyword,
                _ => Role::Word,
            };
            return (role, !matches!(last, Role::Prefix | Role::Open | Role::Dot));
        }
        let is_after_operand = matches!(last, Role::Word | Role::Close | Role::Postfix);
        let is_open = matches!(last, Role::Open | Role::Prefix);
        match token.text {
            "(" => (Role::Open, !matches!(last, Role::Word | Role::Close | Role::Prefix | Role::Open | Role::Dot)),
            "[" => (Role::Open, false),
            ")" | "]" => (Role::Close, false),
            "," => (Role::Comma, false),
            ";" => (Role::End, false),
            "." => (Role::Dot, false),
            "{" => (Role::End, last != Role::Open),
            "}" => (Role::End, state.last.text != "{"),
            "++" | "--" if is_after_operand => (Role::Postfix, false),
            "!" | "~" | "++" | "--" => (Role::Prefix, !is_open),
            "+" | "-" if !is_after_operand => (Role::Prefix, !is_open),
            ":" if state.questions.last().is_none_or(|open| *open == 0) => (Role::End, false),
            _ => (Role::Binary, true),
        }
    }
}

impl State {
    /// Returns whether no bracket has been opened in the current block.
    fn is_outside(&self) -> bool {
        self.brackets.len() == self.blocks.last().map_or(0, |block| block.brackets)
    }

    /// Takes a word or a sign. `indent`: the indentation of its line, as written and now.
    fn follow(&mut self, token: &Token<'_>, role: Role, indent: (usize, usize)) {
        let is_outside = self.is_outside();
        let is_control = matches!(self.last.text.as_str(), "if" | "for" | "while" | "switch");
        let mut ends = false;
        if self.questions.is_empty() {
            self.questions.push(0);
        }
        match token.text {
            "(" | "[" => {
                self.brackets.push(is_control && token.text == "(");
                self.questions.push(0);
            }
            // One without its partner is left alone.
            ")" | "]" if is_outside => {}
            ")" | "]" => {
                let is_header = self.brackets.pop() == Some(true);
                self.questions.pop();
                // `while (…);` after `do` is no header, but its `;` ends the statement anyway.
                if is_header {
                    self.headers += 1;
                    ends = true;
                }
            }
            "?" => *self.questions.last_mut().expect("one is always open") += 1,
            ":" => match self.questions.last_mut() {
                Some(open) if *open > 0 => *open -= 1,
                _ => {
                    ends = true;
                    if let Some(block) = self.blocks.last_mut() {
                        block.has_label = true;
                    }
                }
            },
            "{" => {
                let statement = self.statement.map_or(indent.1, |(_, now)| now);
                let headers = self.headers.saturating_sub(1);
                self.blocks.push(Block {
                    indent: statement + INDENT,
                    headers,
                    has_label: false,
                    brackets: self.brackets.len(),
                });
                self.questions.push(0);
                self.headers = 0;
                ends = true;
            }
            "}" => {
                if let Some(block) = self.blocks.pop() {
                    self.brackets.truncate(block.brackets);
                    self.closed_headers = block.headers;
                }
                self.questions.truncate(1 + self.brackets.len() + self.blocks.len());
                self.headers = 0;
                ends = true;
            }
            ";" if is_outside => {
                self.closed_headers = self.headers.saturating_sub(1);
                self.headers = 0;
                *self.questions.last_mut().expect("one is always open") = 0;
                ends = true;
            }
            "else" => {
                self.headers = self.closed_headers + 1;
                ends = true;
            }
            // `else if` is one header.
            "if" if self.last.text == "else" => {
                self.headers = self.headers.saturating_sub(1);
                ends = true;
            }
            "do" if is_outside => {
                self.headers += 1;
                ends = true;
            }
            _ => {}
        }
        match ends {
            true => self.statement = None,
            false => drop(self.statement.get_or_insert(indent)),
        }
        self.last = Last { text: token.text.to_owned(), role };
    }
}

/// Returns a token without the blanks at its end. Those after a `\` decide whether it joins its line with the next.
fn without_end(text: &str) -> &str {
    let trimmed = text.trim_end();
    if trimmed.ends_with('\\') { text } else { trimmed }
}

/// Returns a line without its line break.
trait StripBreak {
    fn strip_suffix_break(&self) -> &Self;
}

impl StripBreak for [Token<'_>] {
    fn strip_suffix_break(&self) -> &Self {
        match self {
            [line @ .., last] if last.kind == Kind::Break => line,
            line => line,
        }
    }
}
