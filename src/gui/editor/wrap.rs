//! Wraps a long piece of a line into rows.

use super::pieces;

/// The rows of a piece: the bytes at which they start, the first at 0, and the indent of all rows after the first, in
/// digit widths.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct Breaks {
    pub starts: Vec<usize>,
    pub indent: f32,
}

/// Cuts a piece into rows no wider than `limit`, in digit widths: after a blank or a sign if possible, and with the
/// indent of the piece.
pub(super) fn breaks(text: &str, limit: f32, width: &mut dyn FnMut(char) -> f32) -> Breaks {
    let blanks = &text[..text.len() - text.trim_start().len()];
    // At least half of the width is left for text.
    let indent = Some(pieces::columns(blanks, width)).filter(|i| *i <= limit / 2.0).unwrap_or(0.0);
    let mut starts = vec![0];
    let (mut start, mut at, mut x) = (0, 0, 0.0);
    // The last place at which this row may end.
    let mut place = None;
    while let Some(c) = text[at..].chars().next() {
        let wide = pieces::columns(c.encode_utf8(&mut [0; 4]), width);
        // A blank at the end of a row may overhang.
        if x + wide > limit && at > start && !c.is_whitespace() {
            // The text after the place is measured again because the next row is indented.
            (start, x) = (place.take().unwrap_or(at), indent);
            starts.push(start);
            at = start;
            continue;
        }
        x += wide;
        at += c.len_utf8();
        if (c.is_whitespace() || ",;({[+-*/=&|?:".contains(c)) && at > blanks.len() {
            place = Some(at);
        }
    }
    Breaks { starts, indent }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn rows(text: &str, limit: f32) -> Vec<&str> {
        let starts = breaks(text, limit, &mut |_| 2.0).starts;
        let ends = starts[1..].iter().copied().chain([text.len()]);
        starts.iter().zip(ends).map(|(a, b)| &text[*a..b]).collect()
    }

    #[test]
    fn rows_break_between_words_and_fill_the_width() {
        assert_eq!(rows("short", 10.0), ["short"]);
        assert_eq!(rows("", 10.0), [""]);
        assert_eq!(rows("one two three", 8.0), ["one two ", "three"]);
        assert_eq!(rows("f(aaaa, bbbb)", 8.0), ["f(aaaa, ", "bbbb)"]);
        assert_eq!(rows("xxxxxxxxxx", 4.0), ["xxxx", "xxxx", "xx"]);
        assert_eq!(rows("  ab cd ef", 6.0), ["  ab ", "cd ", "ef"], "two are for the indent");
        assert_eq!(rows("ééé", 4.0), ["éé", "é"]);
        assert_eq!(rows("a          b", 4.0), ["a          ", "b"]);
        assert_eq!(rows("abc", 0.5), ["a", "b", "c"]);
    }

    #[test]
    fn no_row_is_wider_than_the_limit() {
        let text = "    vec3 colour = mix(first(uv), second(uv * 2.0), smoothstep(0.0, 1.0, length(uv))); ".repeat(20);
        for limit in 5..120 {
            let found = breaks(&text, limit as f32, &mut |_| 1.0);
            let ends = found.starts[1..].iter().copied().chain([text.len()]);
            for (i, (from, to)) in found.starts.iter().zip(ends).enumerate() {
                let indent = if i == 0 { 0.0 } else { found.indent };
                let wide = text[*from..to].trim_end().len() as f32 + indent;
                assert!(wide <= limit as f32 && to > *from, "{wide} in {limit}");
            }
        }
    }
}
