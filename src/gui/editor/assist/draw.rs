//! Code in tooltips, and signs for kinds of names.

use crate::{
    glsl::services::{
        Class, CompletionKind,
        lines::{self, LexState},
    },
    gui::{editor::colors::code_color, theme::Palette},
};
use egui::{
    Color32, FontId,
    text::{LayoutJob, TextFormat},
};
use std::ops::Range;

/// A letter and a colour.
pub(super) fn sign(kind: CompletionKind, palette: &Palette) -> (&'static str, Color32) {
    use CompletionKind as K;
    let (sign, token) = match kind {
        K::Local => ("v", Class::Unknown),
        K::Parameter => ("p", Class::Parameter),
        K::Global => ("g", Class::Global),
        K::Constant => ("c", Class::Number),
        K::Function => ("f", Class::Function),
        K::Builtin => ("f", Class::Builtin),
        K::Struct => ("S", Class::Type),
        K::Type => ("T", Class::Type),
        K::Field => (".", Class::Field),
        K::Macro => ("#", Class::Macro),
        K::Uniform => ("u", Class::Uniform),
        K::Keyword => ("k", Class::Keyword),
    };
    (sign, code_color(token, palette))
}

/// Lays out coloured lines of GLSL; `strong` is emphasised.
pub(super) fn code(palette: &Palette, lines: &[String], font: &FontId, strong: Option<Range<usize>>) -> LayoutJob {
    let mut job = LayoutJob::default();
    for (i, line) in lines.iter().enumerate() {
        if i > 0 {
            job.append("\n", 0.0, TextFormat::simple(font.clone(), palette.text));
        }
        let mut at = 0;
        for token in lines::lex(line, 0..line.len(), LexState::default(), &|_| false) {
            let range = at..at + token.len;
            at = range.end;
            let color = code_color(token.class, palette);
            let format = |is_strong: bool| {
                let mut format = TextFormat::simple(font.clone(), if is_strong { palette.strong } else { color });
                if is_strong {
                    format.background = palette.accent_fill;
                    format.expand_bg = 2.0;
                }
                format
            };
            let Some(strong) = strong.as_ref().filter(|s| s.start < range.end && range.start < s.end) else {
                job.append(&line[range], 0.0, format(false));
                continue;
            };
            let (from, to) = (strong.start.max(range.start), strong.end.min(range.end));
            for (part, is_strong) in [(range.start..from, false), (from..to, true), (to..range.end, false)] {
                if !part.is_empty() {
                    job.append(&line[part], 0.0, format(is_strong));
                }
            }
        }
    }
    job
}
