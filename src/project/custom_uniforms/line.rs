//! One `#iUniform` line, in the form the VS Code extension "Shader Toy" made common.
//!
//! ```glsl
//! #iUniform float speed = 1.0 in { 0.0, 5.0 }             // a slider
//! #iUniform float dent = 1.0 in { 0.0, 5.0 } step 0.2     // one that moves by steps
//! #iUniform int rings = 5                                 // a number without limits
//! #iUniform color3 tint = color3(1.0, 0.5, 0.0)           // a colour; a vec3 in GLSL
//! #iUniform vec4 gains = vec4(1.0) in { 0.0, 1.0 }        // four sliders; one number is used for all components
//! #iUniform bool wrapped = true                           // this type the extension does not have
//! ```
//!
//! The comment after a declaration describes it to users. A line `//@group Light` puts the following declarations of
//! the same text into a group of that name, until the next such line; one without a name ends the group.
//!
//! The default is the minimum of the range, or zero without a range.

use super::types::{CustomUniform, CustomUniformRange, CustomUniformType, CustomUniformValue};
use crate::{
    lines::{HashLine, trim_start},
    listed, nearest,
};
use eddy_diag::{Diagnostic, SourceId, Span};
use std::ops::Range;

const FORM: &str = "write #iUniform float speed = 1.0 in { 0.0, 5.0 } step 0.1; default, range and step are optional";

pub(crate) fn is_declaration(line: &HashLine<'_>) -> bool {
    line.body.strip_prefix("iUniform").is_some_and(|rest| !rest.starts_with(|c: char| c.is_alphanumeric() || c == '_'))
}

/// The parts of a line; omitted parts are `None`.
pub(super) struct Declaration {
    pub name: String,
    pub ty: CustomUniformType,
    pub default: Option<[f64; 4]>,
    pub range: Option<CustomUniformRange>,
    pub step: Option<[f64; 4]>,
    /// The comment after it.
    pub about: String,
    /// The group that it is in.
    pub group: String,
    /// The span of the name.
    pub span: Span,
}

/// Returns the name that a line `//@group NAME` gives to the following declarations; empty if it ends a group.
pub(super) fn group(line: &str) -> Option<&str> {
    let rest = line.trim_start().strip_prefix("//")?.trim_start().strip_prefix("@group")?;
    (rest.is_empty() || rest.starts_with(char::is_whitespace)).then(|| rest.trim())
}

/// Returns the text of the comment at the end of a declaration; comments such as `//@print` are not descriptions.
fn about(rest: &str) -> String {
    let comment = rest.split_once("//").map_or("", |(_, comment)| comment.trim_start_matches(['/', '!', '<']).trim());
    if comment.starts_with('@') { String::new() } else { comment.to_owned() }
}

impl Declaration {
    pub(super) fn custom_uniform(&self, source: SourceId) -> CustomUniform {
        CustomUniform {
            name: self.name.clone(),
            ty: self.ty,
            default: CustomUniformValue::new(self.ty, &[0.0; 4]),
            range: None,
            step: None,
            about: String::new(),
            group: self.group.clone(),
            span: self.span,
            declared_in: vec![source],
            is_declared: false,
        }
    }

    /// Adopts the parts that only `other` has. Returns an error that names the part in which they contradict each
    /// other.
    pub(super) fn join(&mut self, other: &Declaration) -> Result<(), &'static str> {
        fn one<T: Copy + PartialEq>(
            mine: &mut Option<T>,
            theirs: Option<T>,
            what: &'static str,
        ) -> Result<(), &'static str> {
            match (*mine, theirs) {
                (Some(a), Some(b)) if a != b => Err(what),
                (None, Some(_)) => {
                    *mine = theirs;
                    Ok(())
                }
                _ => Ok(()),
            }
        }
        if self.about.is_empty() {
            self.about.clone_from(&other.about);
        }
        one(&mut self.default, other.default, "default")?;
        one(&mut self.range, other.range, "range")?;
        one(&mut self.step, other.step, "step")
    }

    /// Completes a custom uniform after all lines are read.
    pub(super) fn complete(&self, custom_uniform: &mut CustomUniform, diagnostics: &mut Vec<Diagnostic>) {
        custom_uniform.step = self.step;
        custom_uniform.about.clone_from(&self.about);
        let unit = CustomUniformRange { min: [0.0; 4], max: [1.0; 4] };
        custom_uniform.range = self.range.or((self.ty == CustomUniformType::Color3).then_some(unit));
        let default = self.default.or(self.range.map(|r| r.min)).unwrap_or_default();
        let wanted = CustomUniformValue::new(self.ty, &default);
        custom_uniform.default = custom_uniform.clamped(&wanted);
        if custom_uniform.default != wanted {
            let shown = custom_uniform.default.glsl(self.ty);
            diagnostics.push(
                Diagnostic::warning(self.span, format!("the default of `{}` is outside its range", self.name))
                    .hint(format!("it starts at {shown}; change the default or the range")),
            );
        }
    }
}

/// Parses a value in the form of user input: `0.3`, `true`, `1,0.5,0`, `vec3(1)` (one number for all components).
pub(crate) fn value(text: &str) -> Option<CustomUniformValue> {
    let text = text.trim();
    match text {
        "true" => return Some(CustomUniformValue::Bool(true)),
        "false" => return Some(CustomUniformValue::Bool(false)),
        _ => {}
    }
    if let Ok(n) = text.parse::<i32>() {
        return Some(CustomUniformValue::Int(n));
    }
    let mut words = WordReader::new(text, 0, SourceId(0));
    let (mut all, size) = match words.peek() {
        Word::Name(name) => {
            let ty = CustomUniformType::ALL.into_iter().find(|t| t.name() == name)?;
            words.next();
            (words.arguments().ok()?, ty.components())
        }
        _ => {
            let mut all = vec![words.number().ok()?];
            while words.peek() == Word::Sign(',') {
                words.next();
                all.push(words.number().ok()?);
            }
            let size = all.len();
            (all, size)
        }
    };
    if words.peek() != Word::End {
        return None;
    }
    if all.len() == 1 {
        all = vec![all[0]; size];
    }
    match (all.len(), size) {
        (1, 1) => Some(CustomUniformValue::Float(all[0])),
        (n, size) if n == size && n <= 4 => Some(CustomUniformValue::Vector(all)),
        _ => None,
    }
}

/// Parses a line for which [`is_declaration`] is true, in a group.
pub(super) fn parse(line: &HashLine<'_>, source: SourceId, group: &str) -> Result<Declaration, Diagnostic> {
    let skipped = "iUniform".len();
    let mut words = WordReader::new(&line.body[skipped..], line.body_at + skipped, source);
    let ty = words.ty()?;
    let (name, span) = words.name()?;
    let (default, range, step, group) = (None, None, None, group.to_owned());
    let mut out = Declaration { name, ty, default, range, step, about: String::new(), group, span };
    if words.peek() == Word::Sign('=') {
        words.next();
        out.default = Some(words.value(ty)?);
    }
    if words.peek() == Word::Name("in") {
        words.next();
        out.range = Some(words.range(ty)?);
    }
    if words.peek() == Word::Name("step") {
        words.next();
        let step = words.value(ty)?;
        if step[..ty.components()].iter().any(|s| *s <= 0.0) {
            return Err(words.error("a step must be above 0"));
        }
        out.step = Some(step);
    }
    out.about = about(&words.text[words.at..]);
    match words.peek() {
        // Some authors end the declaration with a semicolon.
        Word::End | Word::Sign(';') => Ok(out),
        // The extension's tag for its own timeline, in both spellings it accepts.
        Word::Name("sequencer" | "sequncer") => Ok(out),
        _ => {
            words.next();
            Err(words.error(match (out.default, out.range) {
                (None, None) => "expected `=`, `in` or the end of the line",
                (_, None) => "expected `in`, `step` or the end of the line",
                _ => "expected `step` or the end of the line",
            }))
        }
    }
}

#[derive(Clone, Copy, Debug, PartialEq)]
enum Word<'a> {
    Name(&'a str),
    Number(f64),
    Sign(char),
    End,
}

/// A reader of a line's tokens.
struct WordReader<'a> {
    text: &'a str,
    /// The offset of the next token, and the range of the previous one.
    at: usize,
    last: Range<usize>,
    /// The offset of `text` in its source.
    base: usize,
    source: SourceId,
}

impl<'a> WordReader<'a> {
    fn new(text: &'a str, base: usize, source: SourceId) -> Self {
        Self { text, at: 0, last: 0..0, base, source }
    }

    fn look(&self) -> (Word<'a>, Range<usize>) {
        let mut at = self.at;
        loop {
            at += self.text[at..].len() - trim_start(&self.text[at..]).len();
            let rest = &self.text[at..];
            if rest.starts_with("//") {
                return (Word::End, at..at);
            }
            match rest.strip_prefix("/*").map(|r| r.find("*/")) {
                Some(Some(end)) => at += end + 4,
                Some(None) => return (Word::End, at..at),
                None => break,
            }
        }
        let rest = &self.text[at..];
        let Some(first) = rest.chars().next() else { return (Word::End, at..at) };
        if first.is_alphabetic() || first == '_' {
            let end = rest.find(|c: char| !c.is_alphanumeric() && c != '_').unwrap_or(rest.len());
            return (Word::Name(&rest[..end]), at..at + end);
        }
        let end = number_end(rest);
        match rest[..end].parse() {
            Ok(number) if end > 0 => (Word::Number(number), at..at + end),
            _ => (Word::Sign(first), at..at + first.len_utf8()),
        }
    }

    fn peek(&self) -> Word<'a> {
        self.look().0
    }

    fn next(&mut self) -> Word<'a> {
        let (word, place) = self.look();
        self.at = place.end;
        self.last = place;
        word
    }

    /// Returns an error at the previous token.
    fn error(&self, message: impl Into<String>) -> Diagnostic {
        // At the end of the line, mark the last token instead.
        let place = if self.last.is_empty() {
            let before = self.text[..self.last.start].trim_end().len();
            before.saturating_sub(1)..before
        } else {
            self.last.clone()
        };
        let start = (0..=place.start).rev().find(|i| self.text.is_char_boundary(*i)).unwrap_or(0);
        Diagnostic::error(Span::new(self.source, self.base + start..self.base + place.end), message).hint(FORM)
    }

    fn expect(&mut self, sign: char, what: &str) -> Result<(), Diagnostic> {
        if self.next() == Word::Sign(sign) { Ok(()) } else { Err(self.error(format!("expected `{sign}` {what}"))) }
    }

    fn ty(&mut self) -> Result<CustomUniformType, Diagnostic> {
        let names = CustomUniformType::ALL.map(CustomUniformType::name);
        let Word::Name(word) = self.next() else {
            return Err(self.error(format!("expected a type: {}", listed(&names))));
        };
        CustomUniformType::ALL.into_iter().find(|t| t.name() == word).ok_or_else(|| {
            let known = match nearest(word, names) {
                Some(near) => format!("did you mean {near}?"),
                None => format!("the types are {}", listed(&names)),
            };
            self.error(format!("unknown slider type {word}")).hint(known)
        })
    }

    fn name(&mut self) -> Result<(String, Span), Diagnostic> {
        match self.next() {
            Word::Name(name) if name.is_ascii() => {
                let place = self.base + self.last.start..self.base + self.last.end;
                Ok((name.to_owned(), Span::new(self.source, place)))
            }
            _ => Err(self.error("expected the uniform's name, in letters of GLSL: a to z, digits and _")),
        }
    }

    fn number(&mut self) -> Result<f64, Diagnostic> {
        match self.next() {
            Word::Number(x) if (x as f32).is_finite() => Ok(x),
            Word::Number(_) => Err(self.error("this number is too large for a float")),
            Word::Name("true") => Ok(1.0),
            Word::Name("false") => Ok(0.0),
            _ => Err(self.error("expected a number")),
        }
    }

    /// Parses numbers in parentheses; constructors among them count as their components.
    fn arguments(&mut self) -> Result<Vec<f64>, Diagnostic> {
        self.expect('(', "after the type")?;
        let mut depth = 1;
        let mut all = Vec::new();
        loop {
            match self.peek() {
                Word::Name(name) if CustomUniformType::ALL.iter().any(|t| t.name() == name) => {
                    self.next();
                    self.expect('(', "after the type")?;
                    depth += 1;
                    continue;
                }
                _ => all.push(self.number()?),
            }
            while self.peek() == Word::Sign(')') {
                self.next();
                depth -= 1;
                if depth == 0 {
                    return Ok(all);
                }
            }
            self.expect(',', "or `)`")?;
        }
    }

    /// Parses a value of a type; one number sets all components.
    fn value(&mut self, ty: CustomUniformType) -> Result<[f64; 4], Diagnostic> {
        let first = self.look().1.start;
        let mut all = match self.peek() {
            Word::Name(name) if name != "true" && name != "false" => {
                self.next();
                if !CustomUniformType::ALL.iter().any(|t| t.name() == name) {
                    return Err(self.error("expected a number, or a constructor of numbers"));
                }
                self.arguments()?
            }
            _ => vec![self.number()?],
        };
        let n = ty.components();
        let end = self.last.end;
        self.last = first..end;
        if all.len() == 1 {
            all = vec![all[0]; n];
        }
        if all.len() != n {
            let wants = if n == 1 { "one number".into() } else { format!("{n} numbers, or one for all") };
            return Err(self.error(format!("a {} takes {wants}, not {}", ty.name(), all.len())));
        }
        if ty == CustomUniformType::Int && all[0].fract() != 0.0 {
            return Err(self.error("an int takes whole numbers"));
        }
        if ty == CustomUniformType::Bool && all[0] != 0.0 && all[0] != 1.0 {
            return Err(self.error("a bool is true or false"));
        }
        let mut out = [0.0; 4];
        out[..n].copy_from_slice(&all);
        Ok(out)
    }

    fn range(&mut self, ty: CustomUniformType) -> Result<CustomUniformRange, Diagnostic> {
        if ty == CustomUniformType::Bool {
            return Err(self.error("a bool has no range"));
        }
        self.expect('{', "before the smallest value")?;
        let first = self.last.start;
        let min = self.value(ty)?;
        self.expect(',', "between the smallest and the largest value")?;
        let max = self.value(ty)?;
        self.expect('}', "after the largest value")?;
        if min.iter().zip(max).any(|(a, b)| *a > b) {
            self.last.start = first;
            return Err(self.error("the range ends below its start"));
        }
        Ok(CustomUniformRange { min, max })
    }
}

/// Returns the length of the GLSL number that starts a text, including its sign.
fn number_end(text: &str) -> usize {
    let bytes = text.as_bytes();
    let digits = |mut i: usize| {
        while bytes.get(i).is_some_and(u8::is_ascii_digit) {
            i += 1;
        }
        i
    };
    let start = usize::from(matches!(bytes.first(), Some(b'-' | b'+')));
    let mut end = digits(start);
    let mut any = end > start;
    if bytes.get(end) == Some(&b'.') {
        let after = digits(end + 1);
        any |= after > end + 1;
        end = after;
    }
    if !any {
        return 0;
    }
    if matches!(bytes.get(end), Some(b'e' | b'E')) {
        let sign = usize::from(matches!(bytes.get(end + 1), Some(b'-' | b'+')));
        let after = digits(end + 1 + sign);
        if after > end + 1 + sign {
            end = after;
        }
    }
    end
}
