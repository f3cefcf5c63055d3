//! The list of all uses of a name, below the code.

use super::{
    accessible,
    icons::{self, Icon},
    theme,
    ui_output::UiOutput,
};
use crate::{project::Tab, session::Session};
use egui::{Align2, FontId, ScrollArea, Sense, Stroke, Ui, pos2, vec2};
use std::ops::Range;

const ROW: f32 = 21.0;

pub(super) struct Uses {
    name: String,
    /// The noun for the places: "reference" or "match".
    of: &'static str,
    places: Vec<Use>,
    selected: Option<usize>,
}

struct Use {
    tab: Tab,
    range: Range<usize>,
    /// Counted from 1.
    line: usize,
    /// The line without its indent, and the range of the name in it.
    text: String,
    name: Range<usize>,
}

/// The results of a frame of the list.
#[derive(Default)]
pub(super) struct UsesResponse {
    pub go_to: Option<(Tab, Range<usize>)>,
    pub closed: bool,
}

impl Uses {
    /// Returns `None` if there is nothing to list.
    pub(super) fn new<'t>(text: impl Fn(&Tab) -> Option<&'t str>, places: Vec<(Tab, Range<usize>)>) -> Option<Self> {
        let mut list: Vec<Use> = Vec::new();
        for (tab, range) in places {
            // Lines are counted from the previous place: counting from the top each time takes minutes for many uses
            // in a long text.
            let before = list.last().filter(|p| p.tab == tab && p.range.start <= range.start);
            let known = before.map_or((0, 1), |p| (p.range.start, p.line));
            list.extend(text(&tab).and_then(|text| place(text, tab.clone(), range, known)));
        }
        let places = list;
        let first = places.first()?;
        let name = first.text[first.name.clone()].to_owned();
        Some(Self { name, of: "reference", places, selected: None })
    }

    /// Returns the list of search results; `None` if nothing was found.
    pub(super) fn found<'t>(
        text: impl Fn(&Tab) -> Option<&'t str>,
        query: &str,
        places: Vec<(Tab, Range<usize>)>,
    ) -> Option<Self> {
        Some(Self { name: query.to_owned(), of: "match", ..Self::new(text, places)? })
    }

    /// `limit`: the maximum height of the list.
    pub(super) fn show(&mut self, ui: &mut Ui, session: &Session, limit: f32, out: &mut UiOutput) -> UsesResponse {
        out.stop("uses", ui);
        let mut shown = UsesResponse::default();
        let top = ui.max_rect().top() + 0.5;
        ui.painter().hline(ui.max_rect().x_range(), top, Stroke::new(1.0, theme::of(ui).line));
        ui.add_space(3.0);
        ui.horizontal(|ui| {
            ui.add_space(12.0);
            ui.monospace(&self.name);
            ui.colored_label(theme::of(ui).weak, self.count());
            ui.with_layout(egui::Layout::right_to_left(egui::Align::Center), |ui| {
                let close = icons::button(ui, Icon::Close, "Close the list").on_hover_text("Close (Esc)");
                shown.closed = out.clicked("button:close-uses", &close);
            });
        });
        shown.closed |= ui.input(|i| i.key_pressed(egui::Key::Escape));
        let several = session.tabs().len() > 1;
        ScrollArea::vertical().id_salt("use list").max_height(limit).auto_shrink([false, true]).show_rows(
            ui,
            ROW,
            self.places.len(),
            |ui, rows| {
                ui.spacing_mut().item_spacing.y = 0.0;
                for i in rows {
                    if self.row(ui, i, several, out) {
                        self.selected = Some(i);
                        shown.go_to = Some((self.places[i].tab.clone(), self.places[i].range.clone()));
                    }
                }
            },
        );
        ui.add_space(4.0);
        shown
    }

    /// Returns the number of places in words: "5 matches in 2 tabs".
    fn count(&self) -> String {
        let plural = |n: usize, noun: &str| match (n, noun) {
            (1, _) => format!("1 {noun}"),
            (_, "match") => format!("{n} matches"),
            _ => format!("{n} {noun}s"),
        };
        let mut tabs: Vec<&Tab> = self.places.iter().map(|place| &place.tab).collect();
        tabs.dedup();
        format!("{} in {}", plural(self.places.len(), self.of), plural(tabs.len(), "tab"))
    }

    fn row(&self, ui: &mut Ui, index: usize, several: bool, out: &mut UiOutput) -> bool {
        let place = &self.places[index];
        let (rect, response) = ui.allocate_exact_size(vec2(ui.available_width(), ROW), Sense::click());
        let name = format!("{} line {}: {}", place.tab.title(), place.line, place.text);
        accessible::name(&response, egui::Role::Button, name);
        if self.selected == Some(index) || response.hovered() {
            let fill =
                if response.hovered() { theme::of(ui).raised } else { theme::of(ui).accent_fill.gamma_multiply(0.5) };
            ui.painter().rect_filled(rect, 0.0, fill);
        }
        let painter = ui.painter().with_clip_rect(rect.intersect(ui.clip_rect()));
        let at = if several { format!("{} {}", place.tab.title(), place.line) } else { format!("line {}", place.line) };
        let font = FontId::proportional(12.0);
        let end =
            painter.text(pos2(rect.left() + 14.0, rect.center().y), Align2::LEFT_CENTER, at, font, theme::of(ui).weak);
        let mut job = egui::text::LayoutJob::default();
        let format = |color| egui::TextFormat::simple(FontId::monospace(12.0), color);
        job.append(&place.text[..place.name.start], 0.0, format(theme::of(ui).text));
        job.append(&place.text[place.name.clone()], 0.0, format(theme::of(ui).accent));
        job.append(&place.text[place.name.end..], 0.0, format(theme::of(ui).text));
        job.break_on_newline = false;
        let galley = painter.layout_job(job);
        let x = end.right().max(rect.left() + 90.0) + 12.0;
        painter.galley(pos2(x, rect.center().y - galley.size().y / 2.0), galley, theme::of(ui).text);
        let clicked = out.clicked(&format!("use:{index}"), &response);
        response.on_hover_cursor(egui::CursorIcon::PointingHand);
        clicked
    }
}

/// The number of bytes of a line that are shown before a name, and after it.
const BEFORE: usize = 120;
const MAX_AFTER: usize = 240;

/// `known`: a place at or before this one, and its line.
fn place(text: &str, tab: Tab, range: Range<usize>, known: (usize, usize)) -> Option<Use> {
    text.get(range.clone())?;
    let head = &text[text.ceil_char_boundary(range.start.saturating_sub(BEFORE))..range.start];
    let start = range.start - head.len() + head.rfind('\n').map_or(0, |i| i + 1);
    let tail = &text[range.end..text.floor_char_boundary(range.end + MAX_AFTER)];
    let end = range.end + tail.find(['\n', '\r']).unwrap_or(tail.len());
    let line = &text[start..end];
    let indent = line.len() - line.trim_start().len();
    let name = range.start.checked_sub(start + indent)?..range.end.checked_sub(start + indent)?;
    let passed = text.as_bytes().get(known.0..range.start)?;
    let number = known.1 + passed.iter().filter(|b| **b == b'\n').count();
    Some(Use { tab, line: number, text: line[indent..].to_owned(), name, range })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn places_have_their_line() {
        let text = "float a;\r\n    b = a * a; // x\r\n";
        let at = text.rfind("a;").unwrap();
        let found = place(text, Tab::image(), at..at + 1, (0, 1)).unwrap();
        assert_eq!((found.line, found.text.as_str(), &found.text[found.name]), (2, "b = a * a; // x", "a"));
        let first = place(text, Tab::image(), 6..7, (0, 1)).unwrap();
        assert_eq!((first.line, first.text.as_str()), (1, "float a;"));
        assert_eq!(place(text, Tab::image(), at..at + 1, (6, 1)).unwrap().line, 2);
        assert!(place(text, Tab::Common, 90..91, (0, 1)).is_none(), "the text has changed meanwhile");
        let long = format!("{}a{}", "ä b ".repeat(3_000), " ö + ".repeat(3_000));
        let at = long.find('a').unwrap();
        let found = place(&long, Tab::Common, at..at + 1, (0, 1)).unwrap();
        assert_eq!(&found.text[found.name], "a");
        assert!(found.text.len() < 400, "a line of {} bytes is shown in part", long.len());
    }
}
