//! Says how deep brackets are nested, told of a stretch of code so that a search can step over it.

/// Holds what a stretch of code does to the depth of one kind of bracket.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(super) struct Depth {
    /// Says how far below its beginning it goes: 0 or less.
    low: i32,
    /// Its end against its beginning.
    net: i32,
}

impl Depth {
    /// Returns what this stretch and the one behind it do together.
    pub(super) fn then(self, next: Depth) -> Depth {
        Depth { low: self.low.min(self.net + next.low), net: self.net + next.net }
    }

    /// Returns how many brackets are opened and not closed again.
    pub(super) fn opened(self) -> i32 {
        self.net - self.low
    }

    /// Returns how many brackets are closed that were not opened.
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

/// Holds what a stretch of code does to the depths of all kinds.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(super) struct Nesting([Depth; 3]);

impl Nesting {
    /// Returns what this stretch and the one behind it do together.
    pub(super) fn then(self, next: Nesting) -> Nesting {
        Nesting(std::array::from_fn(|i| self.0[i].then(next.0[i])))
    }

    pub(super) fn of(self, kind: Bracket) -> Depth {
        self.0[kind as usize]
    }

    /// A byte of code follows.
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
    fn stretches_add_up() {
        for (text, opened, closed) in [("", 0, 0), ("{", 1, 0), ("}{", 1, 1), ("{}(", 0, 0), ("}}{{{", 3, 2)] {
            assert_eq!((curly(text).opened(), curly(text).closed()), (opened, closed), "{text}");
            for at in 0..=text.len() {
                assert_eq!(curly(&text[..at]).then(curly(&text[at..])), curly(text));
            }
        }
    }
}
