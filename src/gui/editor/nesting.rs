//! The bracket nesting of a stretch of code, summarised so that a search can skip it.

/// The effect of a stretch of code on the depth of one kind of bracket.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(super) struct Depth {
    /// The lowest depth relative to its start: 0 or less.
    low: i32,
    /// The depth at its end relative to its start.
    net: i32,
}

impl Depth {
    /// Returns the combined effect of this stretch and the next one.
    pub(super) fn then(self, next: Depth) -> Depth {
        Depth { low: self.low.min(self.net + next.low), net: self.net + next.net }
    }

    /// Returns the number of brackets that are opened and not closed.
    pub(super) fn opened(self) -> i32 {
        self.net - self.low
    }

    /// Returns the number of brackets that are closed but not opened.
    pub(super) fn closed(self) -> i32 {
        -self.low
    }

    pub(super) fn net(self) -> i32 {
        self.net
    }
}

/// A kind of bracket.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Bracket {
    Round,
    Square,
    Curly,
}

impl Bracket {
    /// Returns the kind of a bracket, and 1 for an opening and -1 for a closing one.
    pub(super) fn of(byte: u8) -> Option<(Bracket, i32)> {
        Some(match byte {
            b'(' => (Bracket::Round, 1),
            b')' => (Bracket::Round, -1),
            b'[' => (Bracket::Square, 1),
            b']' => (Bracket::Square, -1),
            b'{' => (Bracket::Curly, 1),
            b'}' => (Bracket::Curly, -1),
            _ => return None,
        })
    }
}

/// The effect of a stretch of code on the depths of all kinds.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(super) struct Nesting([Depth; 3]);

impl Nesting {
    /// Returns the combined effect of this stretch and the next one.
    pub(super) fn then(self, next: Nesting) -> Nesting {
        Nesting(std::array::from_fn(|i| self.0[i].then(next.0[i])))
    }

    pub(super) fn of(self, kind: Bracket) -> Depth {
        self.0[kind as usize]
    }

    /// Appends a byte of code.
    #[inline]
    pub(super) fn push(&mut self, byte: u8) {
        if let Some((kind, by)) = Bracket::of(byte) {
            let depth = &mut self.0[kind as usize];
            *depth = depth.then(Depth { low: by.min(0), net: by });
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn curly(text: &str) -> Depth {
        let mut nesting = Nesting::default();
        text.bytes().for_each(|b| nesting.push(b));
        nesting.of(Bracket::Curly)
    }

    #[test]
    fn nesting_of_stretches_is_additive() {
        for (text, opened, closed) in [("", 0, 0), ("{", 1, 0), ("}{", 1, 1), ("{}(", 0, 0), ("}}{{{", 3, 2)] {
            assert_eq!((curly(text).opened(), curly(text).closed()), (opened, closed), "{text}");
            for at in 0..=text.len() {
                assert_eq!(curly(&text[..at]).then(curly(&text[at..])), curly(text));
            }
        }
    }
}
