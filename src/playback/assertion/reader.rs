//! A lexer that reads a text word by word.

pub(super) struct Reader<'t> {
    rest: &'t str,
}

impl<'t> Reader<'t> {
    pub(super) fn new(text: &'t str) -> Self {
        Self { rest: text.trim() }
    }

    /// Takes characters while they match, and the blanks after them.
    pub(super) fn take(&mut self, fits: impl Fn(char) -> bool) -> &'t str {
        let end = self.rest.find(|c| !fits(c)).unwrap_or(self.rest.len());
        let (taken, rest) = self.rest.split_at(end);
        self.rest = rest.trim_start();
        taken
    }

    pub(super) fn has(&mut self, mark: &str) -> bool {
        match self.rest.strip_prefix(mark) {
            Some(rest) => {
                self.rest = rest.trim_start();
                true
            }
            None => false,
        }
    }

    pub(super) fn want(&mut self, mark: &str, within: &str) -> Result<(), String> {
        if self.has(mark) { Ok(()) } else { Err(format!("expected `{mark}` {within}, {}", self.found())) }
    }

    pub(super) fn found(&self) -> String {
        match self.rest.is_empty() {
            true => "but the text ends".into(),
            false => format!("found `{}`", self.rest.chars().take(20).collect::<String>()),
        }
    }

    pub(super) fn end(&self) -> Result<(), String> {
        if self.rest.is_empty() { Ok(()) } else { Err(format!("unexpected `{}` after the end", self.rest)) }
    }

    pub(super) fn number(&mut self, what: &str) -> Result<f64, String> {
        let found = self.found();
        let word = self.take(|c| c.is_ascii_alphanumeric() || matches!(c, '.' | '+' | '-'));
        word.parse().ok().filter(|x: &f64| !x.is_nan()).ok_or_else(|| format!("expected {what}, {found}"))
    }
}
