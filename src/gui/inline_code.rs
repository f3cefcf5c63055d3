//! Messages with code in them: what is between backticks is set in the font of code, on a tinted ground.

use super::theme::{self, Palette};
use egui::{
    Color32, FontId, Label, Response, TextFormat, Ui, WidgetText,
    text::{LayoutJob, TextWrapping},
};

/// The size and the colour of a message.
#[derive(Clone)]
pub(super) struct Inline<'a> {
    pub size: f32,
    pub color: Color32,
    pub palette: &'a Palette,
}

impl Inline<'_> {
    /// Lays out a message. A backtick without its partner is shown as it is.
    pub(super) fn job(&self, text: &str) -> LayoutJob {
        let mut job = LayoutJob::default();
        self.append(&mut job, text);
        job
    }

    /// The same in one line of at most this width, which ends in an ellipsis if it is cut.
    pub(super) fn line(&self, text: &str, width: f32) -> LayoutJob {
        let mut job = self.job(&text.replace('\n', " "));
        job.break_on_newline = false;
        job.wrap = TextWrapping::truncate_at_width(width);
        job
    }

    pub(super) fn append(&self, job: &mut LayoutJob, text: &str) {
        let plain = TextFormat::simple(FontId::proportional(self.size), self.color);
        let code = TextFormat {
            font_id: FontId::monospace(self.size - 0.5),
            color: self.color,
            background: self.palette.line.gamma_multiply(0.7),
            expand_bg: 1.5,
            ..TextFormat::default()
        };
        for (is_code, part) in parts(text) {
            // Between code and the text beside it, for the ground.
            let margin = if job.is_empty() { 0.0 } else { 2.5 };
            job.append(part, margin, if is_code { code.clone() } else { plain.clone() });
        }
    }
}

/// Returns the parts of a message, and whether each is code.
fn parts(text: &str) -> Vec<(bool, &str)> {
    let mut found = Vec::new();
    let mut rest = text;
    while let Some((before, after)) = rest.split_once('`') {
        let Some((code, after)) = after.split_once('`') else { break };
        // A message about the backtick itself.
        if code.is_empty() {
            break;
        }
        found.push((false, before));
        found.push((true, code));
        rest = after;
    }
    found.push((false, rest));
    found.retain(|(_, part)| !part.is_empty());
    found
}

/// Shows a wrapped message in a colour.
pub(super) fn label(ui: &mut Ui, color: Color32, text: &str) -> Response {
    let size = egui::TextStyle::Body.resolve(ui.style()).size;
    let job = Inline { size, color, palette: theme::of(ui) }.job(text);
    ui.add(Label::new(WidgetText::from(job)).wrap())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn code_is_between_two_backticks() {
        for (text, wanted) in [
            ("missing `;` after `)`", vec![(false, "missing "), (true, ";"), (false, " after "), (true, ")")]),
            ("`pq` is not declared", vec![(true, "pq"), (false, " is not declared")]),
            ("a ` alone", vec![(false, "a ` alone")]),
            ("`a` and ` alone", vec![(true, "a"), (false, " and ` alone")]),
            ("unexpected ``", vec![(false, "unexpected ``")]),
            ("plain", vec![(false, "plain")]),
            ("", vec![]),
        ] {
            assert_eq!(parts(text), wanted, "{text}");
        }
    }
}
