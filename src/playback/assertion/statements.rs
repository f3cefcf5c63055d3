//! A text with several assertions, and the names that they share.

use super::{assertions::Assertion, conditions::constant, reader::Reader};
use eddy_project::{Expression, PassName};
use std::{collections::BTreeMap, sync::Arc};

/// The numbers that `let` statements define, each with the expressions before it.
pub(super) type Numbers = Vec<(String, Expression)>;

/// An error in a statement.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("line {line}: {message}")]
pub struct StatementError {
    pub line: usize,
    pub message: String,
}

/// The assertions of a text, with what its `let` statements define.
#[derive(Default)]
pub struct Statements {
    numbers: Numbers,
    texts: BTreeMap<String, Arc<str>>,
    /// Names of passes in this text.
    passes: BTreeMap<String, PassName>,
    assertions: Vec<Assertion>,
}

/// Reads a statement of a kind of its own; returns false without reading if the next one is of another kind.
type ReadOther<'f> = &'f mut dyn FnMut(&mut Reader<'_>, &mut Statements) -> Result<bool, String>;

impl Statements {
    /// Reads the statements of a text. `other` may read some of them.
    pub fn read(&mut self, text: &str, other: ReadOther<'_>) -> Result<(), StatementError> {
        let text = without_comments(text);
        let mut reader = Reader::new(&text);
        self.read_all(&mut reader, other).map_err(|message| {
            let before = text.get(..reader.at()).unwrap_or_default();
            StatementError { line: 1 + before.matches('\n').count(), message }
        })
    }

    fn read_all(&mut self, reader: &mut Reader<'_>, other: ReadOther<'_>) -> Result<(), String> {
        while !reader.is_at_end() {
            let is_read = other(reader, self)?;
            if !is_read && reader.has("let") {
                self.define(reader)?;
            } else if !is_read {
                let assertion = Assertion::read(reader, self)?;
                self.assertions.push(assertion);
            }
            if !reader.has(";") {
                return reader.end();
            }
        }
        Ok(())
    }

    fn define(&mut self, reader: &mut Reader<'_>) -> Result<(), String> {
        let name = reader.name("the name of a number or a text")?;
        if name == "first" || constant(name).is_some() {
            return Err(format!("`{name}` has a meaning of its own: choose another name"));
        }
        if self.texts.contains_key(name) || self.numbers.iter().any(|(own, _)| own == name) {
            return Err(format!("`{name}` is already defined: choose another name"));
        }
        reader.want("=", "after the name")?;
        if let Some(text) = reader.string()? {
            self.texts.insert(name.to_owned(), text.into());
            return Ok(());
        }
        let number = reader.expression("a number or a text in quotes")?;
        if number.has_name("first") {
            return Err("`first` is the value of a quantity: write it in a claim".to_owned());
        }
        self.numbers.push((name.to_owned(), number));
        Ok(())
    }

    /// Gives a pass a name of its own in the statements that follow.
    pub fn name_pass(&mut self, name: &str, pass: PassName) {
        self.passes.insert(name.to_owned(), pass);
    }

    pub(super) fn pass(&self, name: &str) -> Option<PassName> {
        self.passes.get(name).cloned().or_else(|| PassName::parse(name))
    }

    /// Reads a text in quotes, or the name of one.
    pub fn text(&self, reader: &mut Reader<'_>) -> Result<Arc<str>, String> {
        if let Some(text) = reader.string()? {
            return Ok(text.into());
        }
        let name = reader.name("a reason in quotes")?;
        self.texts.get(name).cloned().ok_or_else(|| format!("no `let` before it defines the text `{name}`"))
    }

    /// Returns the assertions in the order of the text.
    pub fn into_assertions(self) -> Vec<Assertion> {
        let numbers = Arc::new(self.numbers);
        self.assertions.into_iter().map(|assertion| assertion.with(&numbers)).collect()
    }
}

/// Replaces comments by nothing, from `//` to the end of the line, unless they are in quotes.
fn without_comments(text: &str) -> String {
    let mut is_quoted = false;
    let mut is_comment = false;
    let mut last = ' ';
    let mut plain = String::new();
    for c in text.chars() {
        is_comment &= c != '\n';
        is_quoted ^= c == '"' && !is_comment;
        if c == '/' && last == '/' && !is_quoted && !is_comment {
            plain.pop();
            is_comment = true;
        }
        if !is_comment {
            plain.push(c);
        }
        last = c;
    }
    plain
}
