//! Divides a text into tokens, comments, directives and line breaks, whatever its errors.

/// The kind of a piece of a text.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Kind {
    /// A name, a keyword or a number.
    Word,
    /// An operator or a bracket.
    Sign,
    /// A comment without the line break after it. It may contain line breaks.
    Comment,
    /// A line of the preprocessor, with its continuation lines, without the line break after it.
    Directive,
    Break,
    /// Two or more lines of code of which a `\` joins each with the next: a token may be in both.
    Joined,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Token<'t> {
    pub kind: Kind,
    pub text: &'t str,
    /// The number of columns of blanks before it.
    pub blanks: usize,
}

/// The operators of more than one character, the longest first.
const SIGNS: [&str; 21] = [
    "<<=", ">>=", "++", "--", "<<", ">>", "<=", ">=", "==", "!=", "&&", "||", "^^", "+=", "-=", "*=", "/=", "%=", "&=",
    "^=", "|=",
];
/// The number of columns of a tab.
const TAB: usize = 4;

/// Returns the tokens of a text in which every line ends in `\n`.
pub(super) fn tokens(text: &str) -> Vec<Token<'_>> {
    let mut found = Vec::new();
    let (mut at, mut starts_line) = (0, true);
    while at < text.len() {
        let rest = &text[at..];
        let code = rest.trim_start_matches(|c: char| c != '\n' && c.is_ascii_whitespace());
        let blanks = width(&rest[..rest.len() - code.len()]);
        at = text.len() - code.len();
        if code.is_empty() {
            break;
        }
        let (kind, length) = match () {
            () if code.starts_with('\n') => (Kind::Break, 1),
            () if starts_line && code.starts_with('#') => (Kind::Directive, directive(code)),
            () if starts_line && is_joined(code) => (Kind::Joined, joined(code)),
            () => one(code),
        };
        // A comment before a directive leaves it one.
        starts_line = match kind {
            Kind::Break => true,
            Kind::Comment => starts_line,
            _ => false,
        };
        found.push(Token { kind, text: &code[..length], blanks });
        at += length;
    }
    found
}

fn width(blanks: &str) -> usize {
    blanks.chars().fold(0, |column, c| if c == '\t' { (column / TAB + 1) * TAB } else { column + 1 })
}

/// Returns the kind and the length of the comment, word or sign at the start of a text.
fn one(code: &str) -> (Kind, usize) {
    if code.starts_with("//") {
        return (Kind::Comment, logical_line(code));
    }
    if let Some(inside) = code.strip_prefix("/*") {
        return (Kind::Comment, inside.find("*/").map_or(code.len(), |end| end + 4));
    }
    let bytes = code.as_bytes();
    let is_number = bytes[0].is_ascii_digit() || bytes[0] == b'.' && bytes.get(1).is_some_and(u8::is_ascii_digit);
    if is_number || is_name(bytes[0]) {
        let mut end = 1;
        while end < bytes.len() {
            let is_exponent = is_number && matches!(bytes[end - 1], b'e' | b'E') && !code.starts_with("0x");
            let goes_on = is_name(bytes[end])
                || is_number && bytes[end] == b'.'
                || is_exponent && matches!(bytes[end], b'+' | b'-');
            if !goes_on {
                break;
            }
            end += 1;
        }
        return (Kind::Word, end);
    }
    let long = SIGNS.iter().find(|sign| code.starts_with(**sign));
    (Kind::Sign, long.map_or_else(|| code.chars().next().map_or(1, char::len_utf8), |sign| sign.len()))
}

/// Letters of other scripts are no names in GLSL; they are kept together.
fn is_name(byte: u8) -> bool {
    byte.is_ascii_alphanumeric() || byte == b'_' || !byte.is_ascii()
}

/// Returns the length of a line with those that a `\` joins to it.
fn logical_line(code: &str) -> usize {
    let mut end = 0;
    for line in code.split_inclusive('\n') {
        end += line.len();
        if !line.trim_end_matches('\n').ends_with('\\') {
            return end - usize::from(line.ends_with('\n'));
        }
    }
    end
}

/// Returns the length of a directive: its logical line, and what its comments contain.
fn directive(code: &str) -> usize {
    let (mut end, mut at) = (logical_line(code), 0);
    loop {
        let line = &code[..end];
        let open = loop {
            let Some(start) = line[at..].find("/*").map(|start| at + start) else { return end };
            if line[at..start].contains("//") {
                return end;
            }
            match line[start + 2..].find("*/") {
                Some(close) => at = start + close + 4,
                None => break start,
            }
        };
        let Some(close) = code[open + 2..].find("*/").map(|close| open + close + 4) else { return code.len() };
        at = close;
        end = close + logical_line(&code[close..]);
    }
}

/// Returns whether a `\` joins this line of code with the next, outside of comments.
fn is_joined(code: &str) -> bool {
    let line = code.split('\n').next().unwrap_or_default();
    line.ends_with('\\') && !line.contains("//") && !line.contains("/*")
}

fn joined(code: &str) -> usize {
    logical_line(code)
}

/// Returns whether two tokens without a blank between them would be read as something else.
pub(super) fn would_merge(before: &str, after: &str) -> bool {
    let both = [before, after].concat();
    one(&both) != (one(before).0, before.len())
}
