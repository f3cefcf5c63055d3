//! The list of quick fixes at the caret.

use crate::{
    gui::{accessible, inline_code::Inline, theme, ui_output::UiOutput},
    project::Tab,
    session::{Session, TabFix},
};
use egui::{Align2, Area, Frame, Id, Key, Margin, Modifiers, Order, Rect, Sense, Ui, vec2};

const ROW: f32 = 24.0;

/// The available fixes. The list does not take the keyboard focus, so that typing continues in the code.
pub(super) struct Fixes {
    list: Vec<TabFix>,
    selected: usize,
    /// The caret for which they were requested: moving it closes the list.
    at: (Tab, usize, u64),
}

/// The results of a frame of the list.
pub(super) enum FixesAction {
    Nothing,
    Closed,
    Fix(TabFix),
}

impl Fixes {
    /// Returns the fixes for the line of a caret; those for the caret itself come first. `at`: its tab, byte and the
    /// revision of the text. `line`: counted from 0.
    pub(super) fn new(session: &Session, at: (Tab, usize, u64), line: usize) -> Self {
        let places = session.diagnostics().iter().filter_map(|d| Some((d, d.place.as_ref()?)));
        let mut here: Vec<_> = places.filter(|(_, p)| p.tab.as_ref() == Some(&at.0) && p.line == line + 1).collect();
        here.sort_by_key(|(d, place)| {
            (!(place.range.start..=place.range.end).contains(&at.1), std::cmp::Reverse(d.severity))
        });
        let mut list: Vec<TabFix> = Vec::new();
        for fix in here.iter().flat_map(|(d, _)| &d.fixes) {
            if !list.contains(fix) {
                list.push(fix.clone());
            }
        }
        Self { list, selected: 0, at }
    }

    /// Takes the list's keys before the code sees them.
    pub(super) fn take_keys(&mut self, ui: &Ui) -> FixesAction {
        let count = |key| ui.input_mut(|i| i.count_and_consume_key(Modifiers::NONE, key));
        let (down, up) = (count(Key::ArrowDown), count(Key::ArrowUp));
        if !self.list.is_empty() {
            let by = down as isize - up as isize;
            self.selected = (self.selected as isize + by).rem_euclid(self.list.len() as isize) as usize;
        }
        let (enter, escape) = (count(Key::Enter) > 0, count(Key::Escape) > 0);
        match self.list.get(self.selected) {
            Some(fix) if enter => FixesAction::Fix(fix.clone()),
            _ if enter || escape => FixesAction::Closed,
            _ => FixesAction::Nothing,
        }
    }

    /// Shows the list below the caret. `now`: the current caret, as [`Fixes::new`] takes it.
    pub(super) fn show(&self, ui: &Ui, caret: Rect, now: &(Tab, usize, u64), out: &mut UiOutput) -> FixesAction {
        if *now != self.at {
            return FixesAction::Closed;
        }
        let mut chosen = FixesAction::Nothing;
        let area = Area::new(Id::unique("quick fixes"))
            .order(Order::Foreground)
            .fixed_pos(caret.left_bottom() + vec2(0.0, 2.0))
            .pivot(Align2::LEFT_TOP)
            .constrain_to(ui.ctx().content_rect());
        out.show_area("fixes", area, ui, |ui, out| {
            Frame::popup(ui.style()).inner_margin(Margin::same(4)).show(ui, |ui| {
                ui.spacing_mut().item_spacing.y = 0.0;
                if self.list.is_empty() {
                    ui.colored_label(theme::of(ui).weak, "No quick fix for this line");
                }
                let palette = theme::of(ui);
                let inline = Inline { size: 13.0, color: palette.text, palette };
                let titles: Vec<_> =
                    self.list.iter().map(|fix| ui.painter().layout_job(inline.job(&fix.title))).collect();
                let width = titles.iter().map(|t| t.size().x).fold(160.0, f32::max) + 16.0;
                for (i, (fix, title)) in self.list.iter().zip(titles).enumerate() {
                    let (rect, response) = ui.allocate_exact_size(vec2(width, ROW), Sense::click());
                    let is_selected = i == self.selected;
                    accessible::choice(&response, egui::Role::ListBoxOption, is_selected, &fix.title);
                    if is_selected {
                        ui.painter().rect_filled(rect, 4.0, theme::of(ui).accent_fill);
                    } else if response.hovered() {
                        ui.painter().rect_filled(rect, 4.0, theme::of(ui).button);
                    }
                    let at = egui::pos2(rect.left() + 8.0, rect.center().y - title.size().y / 2.0);
                    ui.painter().galley(at, title, theme::of(ui).text);
                    if out.clicked(&format!("fix:{i}"), &response) {
                        chosen = FixesAction::Fix(fix.clone());
                    }
                }
            });
        });
        chosen
    }
}
