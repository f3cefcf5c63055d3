//! A lexer that reads a text word by word.

use eddy_project::{Expression, Syntax, limits};

/// Words of the grammar, which are not the names of values.
const KEYWORDS: [&str; 9] = ["within", "of", "in", "from", "except", "at", "unless", "because", "nan"];

/// Fails for a text that is longer than the limit of an assertion.
pub(super) fn check_length(text: &str) -> Result<(), String> {
    let (most, own) = (limits::ASSERTION, text.len());
    if own <= most {
        Ok(())
    } else {
        Err(format!("an assertion has at most {most} letters, and this has {own}: shorten it"))
    }
}

fn is_letter(c: char) -> bool {
    c.is_ascii_alphabetic() || c == '_'
}

/// A text, read from its start. Blanks before and after every part are skipped.
pub struct Reader<'t> {
    text: &'t str,
    at: usize,
}

impl<'t> Reader<'t> {
    pub fn new(text: &'t str) -> Self {
        let text = text.trim_end();
        Self { text, at: text.len() - text.trim_start().len() }
    }

    fn rest(&self) -> &'t str {
        &self.text[self.at..]
    }

    fn skip(&mut self, bytes: usize) {
        self.at = self.text.len() - self.rest()[bytes..].trim_start().len();
    }

    /// Returns the position of the next part, in bytes.
    pub(super) fn at(&self) -> usize {
        self.at
    }

    /// Returns the text from a position to the end of the last part that was read.
    pub(super) fn since(&self, start: usize) -> &'t str {
        self.text[start..self.at].trim_end()
    }

    /// Takes characters while they match.
    pub(super) fn take(&mut self, fits: impl Fn(char) -> bool) -> &'t str {
        let rest = self.rest();
        let end = rest.find(|c| !fits(c)).unwrap_or(rest.len());
        self.skip(end);
        &rest[..end]
    }

    /// Takes a sign or a word if it comes next, or several with blanks between them. A word ends before a letter.
    pub fn has(&mut self, mark: &str) -> bool {
        let mut rest = self.rest();
        for part in mark.split(' ') {
            match rest.strip_prefix(part) {
                Some(after) if !(part.ends_with(is_letter) && after.starts_with(is_letter)) => {
                    rest = after.trim_start()
                }
                _ => return false,
            }
        }
        self.at = self.text.len() - rest.len();
        true
    }

    /// Fails if a mark does not come next, as [`Reader::has`] reads it.
    pub fn want(&mut self, mark: &str, within: &str) -> Result<(), String> {
        if self.has(mark) { Ok(()) } else { Err(self.expected(&format!("`{mark}` {within}"))) }
    }

    /// Returns the word or number that comes next, which is empty before a sign.
    fn word(&self) -> &'t str {
        let rest = self.rest();
        &rest[..rest.find(|c: char| !(is_letter(c) || c.is_ascii_digit())).unwrap_or(rest.len())]
    }

    /// Takes a name. `what` is the thing that it names: "a uniform".
    pub fn name(&mut self, what: &str) -> Result<&'t str, String> {
        let word = self.word();
        if !word.starts_with(is_letter) || KEYWORDS.contains(&word) {
            return Err(self.expected(what));
        }
        self.skip(word.len());
        Ok(word)
    }

    /// Takes a whole number from 0 on.
    pub(super) fn whole(&mut self, what: &str) -> Result<u32, String> {
        let end = self.rest().find(|c: char| !c.is_ascii_digit()).unwrap_or(self.rest().len());
        let number = self.rest()[..end].parse().map_err(|_| self.expected(what))?;
        self.skip(end);
        Ok(number)
    }

    /// Takes an expression.
    pub fn expression(&mut self, what: &str) -> Result<Expression, String> {
        let word = self.word();
        let can_start = !word.is_empty() || self.rest().starts_with(['.', '+', '-', '!', '(']);
        if !can_start || KEYWORDS.iter().any(|keyword| keyword.eq_ignore_ascii_case(word)) {
            return Err(self.expected(what));
        }
        let (expression, length) = Expression::parse_start(self.rest(), Syntax::Assertion).map_err(|error| {
            self.skip(error.range.start);
            error.to_string()
        })?;
        self.skip(length);
        Ok(expression)
    }

    /// Takes a text in quotes if one comes next. Each line break with the blanks around it becomes one blank.
    pub(super) fn string(&mut self) -> Result<Option<String>, String> {
        let Some(inner) = self.rest().strip_prefix('"') else { return Ok(None) };
        let end = inner.find('"').ok_or("this text in quotes has no end: add a \"")?;
        self.skip(end + 2);
        Ok(Some(inner[..end].lines().map(str::trim).collect::<Vec<_>>().join(" ")))
    }

    /// Returns the next letters, for messages.
    fn next(&self) -> String {
        self.rest().chars().take(20).collect()
    }

    /// Returns a message that something else was expected here.
    pub(super) fn expected(&self, what: &str) -> String {
        let found = if self.is_at_end() { "but the text ends".to_owned() } else { format!("found `{}`", self.next()) };
        format!("expected {what}, {found}")
    }

    pub(super) fn is_at_end(&self) -> bool {
        self.rest().is_empty()
    }

    /// Fails if the text goes on.
    pub(super) fn end(&self) -> Result<(), String> {
        if self.is_at_end() { Ok(()) } else { Err(format!("unexpected `{}` after the end", self.next())) }
    }
}
