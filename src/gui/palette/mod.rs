//! The command palette: every action by a few letters of its name.

mod fuzzy;

use super::{
    accessible,
    actions::{ACTIONS, Action},
    theme,
    ui_output::{Request, UiOutput},
};
use egui::{
    Align2, Area, FontId, Frame, Id, Key, Margin, Modifiers, Order, Rect, Sense, TextEdit, Ui, pos2, text::LayoutJob,
    vec2,
};

const WIDTH: f32 = 520.0;
const ROW: f32 = 26.0;
/// The maximum number of visible rows.
const ROWS: usize = 12;

#[derive(Default)]
pub(super) struct Palette {
    open: Option<Open>,
    /// The widget that had the keyboard focus before, and gets it back.
    before: Option<Id>,
    /// Newest first: they lead the list before anything is typed.
    recent: Vec<Action>,
}

#[derive(Default)]
struct Open {
    typed: String,
    /// The entries that are listed instead of the actions.
    only: Option<Vec<Offer>>,
    selected: usize,
    /// The first visible row.
    top: usize,
    takes_focus: bool,
    keys: Keys,
}

/// The keys of a frame that are for the list.
#[derive(Default)]
struct Keys {
    rows: isize,
    pages: isize,
    enter: bool,
    escape: bool,
}

/// An entry that depends on the open project or on this machine.
#[derive(Clone)]
pub(super) struct Offer {
    /// The name for scripts that click on it.
    pub name: String,
    pub title: String,
    pub request: Request,
}

#[derive(Clone, Copy)]
enum Choice<'a> {
    Action(Action),
    Offer(&'a Offer),
}

/// A match, and the matched letters of its title.
struct Fit<'a> {
    name: &'a str,
    title: &'a str,
    choice: Choice<'a>,
    letters: Vec<usize>,
    /// The synonym by which it was found, if its title alone does not match.
    synonym: Option<&'a str>,
}

impl Palette {
    pub(super) fn open(&mut self, ui: &Ui) {
        self.before = ui.memory(|m| m.focused());
        self.open = Some(Open { takes_focus: true, ..Open::default() });
    }

    /// Opens the palette with these entries in place of the actions.
    pub(super) fn open_with(&mut self, ui: &Ui, offers: Vec<Offer>) {
        self.open(ui);
        if let Some(open) = &mut self.open {
            open.only = Some(offers);
        }
    }

    pub(super) fn is_open(&self) -> bool {
        self.open.is_some()
    }

    pub(super) fn close(&mut self, ui: &Ui) {
        self.open = None;
        if let Some(id) = self.before.take() {
            ui.memory_mut(|m| m.request_focus(id));
        }
    }

    /// Takes the list's keys before any panel sees them.
    pub(super) fn take_keys(&mut self, ui: &Ui) {
        let Some(open) = &mut self.open else { return };
        let count = |key| ui.input_mut(|i| i.count_and_consume_key(Modifiers::NONE, key)) as isize;
        open.keys = Keys {
            rows: count(Key::ArrowDown) - count(Key::ArrowUp),
            pages: count(Key::PageDown) - count(Key::PageUp),
            enter: count(Key::Enter) > 0,
            escape: count(Key::Escape) > 0,
        };
    }

    /// Shows the palette while it is open, with `offers` after the actions. Returns the chosen action, or requests the
    /// chosen offer, and closes.
    pub(super) fn show(&mut self, ui: &Ui, offers: &[Offer], out: &mut UiOutput) -> Option<Action> {
        let open = self.open.as_mut()?;
        let only = open.only.clone();
        let list = |typed: &str| match &only {
            Some(only) => fits_of(typed, only),
            None => fits(typed, &self.recent, offers),
        };
        let fits = list(&open.typed);
        let window = ui.ctx().content_rect();
        let width = WIDTH.min(window.width() - 24.0);
        let rows = (((window.height() - 110.0) / ROW) as usize).clamp(1, ROWS);
        open.step(ui, fits.len(), rows);
        let mut chosen = open.keys.enter.then_some(open.selected);
        let mut closes = open.keys.escape;
        let mut is_retyped = false;
        let area = Area::new(Id::unique("palette"))
            .order(Order::Foreground)
            .fixed_pos(pos2(window.center().x, window.top() + 44.0))
            .pivot(Align2::CENTER_TOP)
            .constrain_to(window);
        out.show_area("palette", area, ui, |ui, out| {
            Frame::popup(ui.style()).inner_margin(Margin::same(6)).show(ui, |ui| {
                ui.set_width(width);
                let field = TextEdit::singleline(&mut open.typed).id(Id::unique("palette field"));
                let hint = if only.is_some() { "Type a name" } else { "Type a command" };
                let field = field.hint_text(hint).desired_width(f32::INFINITY);
                let field = ui.add(field.margin(Margin::symmetric(8, 6)));
                out.place("field:palette", field.rect);
                if std::mem::take(&mut open.takes_focus) {
                    field.request_focus();
                }
                if field.changed() {
                    (open.selected, open.top) = (0, 0);
                    is_retyped = true;
                }
                closes |= field.lost_focus() && chosen.is_none();
                ui.add_space(4.0);
                ui.spacing_mut().item_spacing.y = 0.0;
                if fits.is_empty() {
                    let what = if only.is_some() { "name" } else { "command" };
                    ui.colored_label(theme::of(ui).weak, format!("No matching {what}"));
                }
                for (i, fit) in fits.iter().enumerate().skip(open.top).take(rows) {
                    let (rect, response) = ui.allocate_exact_size(vec2(width, ROW), Sense::click());
                    let is_selected = i == open.selected;
                    accessible::choice(&response, egui::Role::ListBoxOption, is_selected, fit.title);
                    if i == open.selected {
                        ui.painter().rect_filled(rect, 4.0, theme::of(ui).chosen);
                    } else if response.hovered() {
                        ui.painter().rect_filled(rect, 4.0, theme::of(ui).button);
                    }
                    let key = match fit.choice {
                        Choice::Action(action) => out.keys.hint(action),
                        Choice::Offer(_) => String::new(),
                    };
                    row(ui, rect, fit, &key, is_selected);
                    out.place(format!("palette:{}", fit.name), rect);
                    // A press takes the keyboard focus from the field, which must not close the palette before the row
                    // is clicked.
                    if response.is_pointer_button_down_on() || response.clicked() {
                        closes = false;
                        field.request_focus();
                    }
                    if response.clicked() {
                        chosen = Some(i);
                    }
                }
            });
        });
        // Letters and Enter in one frame: choose among the rows that match the letters.
        let (fits, chosen) = match is_retyped && open.keys.enter {
            true => (list(&open.typed), Some(0)),
            false => (fits, chosen),
        };
        let choice = chosen.and_then(|i| fits.get(i)).map(|fit| fit.choice);
        match choice {
            Some(Choice::Action(action)) => {
                self.recent.retain(|a| *a != action);
                self.recent.insert(0, action);
            }
            Some(Choice::Offer(offer)) => out.request(offer.request.clone()),
            None => {}
        }
        if closes || choice.is_some() {
            self.close(ui);
        }
        match choice {
            Some(Choice::Action(action)) => Some(action),
            _ => None,
        }
    }
}

impl Open {
    /// Moves the selection, and keeps it visible.
    fn step(&mut self, ui: &Ui, count: usize, rows: usize) {
        let last = count.saturating_sub(1);
        let Keys { rows: by, pages, .. } = self.keys;
        // A single step wraps round at the ends, a page stops there.
        if by != 0 && count > 0 {
            self.selected = (self.selected as isize + by).rem_euclid(count as isize) as usize;
        }
        self.selected = self.selected.saturating_add_signed(pages * rows as isize);
        self.selected = self.selected.min(last);
        self.top = self.top.clamp(self.selected.saturating_sub(rows - 1), self.selected);
        let scrolled = ui.input(|i| i.smooth_scroll_delta().y);
        if scrolled != 0.0 {
            self.top = self.top.saturating_add_signed(if scrolled < 0.0 { 1 } else { -1 });
            self.top = self.top.min(count.saturating_sub(rows));
            self.selected = self.selected.clamp(self.top, (self.top + rows - 1).min(last));
        }
    }
}

/// Returns the matching entries, best first.
fn fits_of<'a>(typed: &str, offers: &'a [Offer]) -> Vec<Fit<'a>> {
    let fit = |offer: &'a Offer| {
        let (cost, letters) = fuzzy::fit(typed, &offer.title)?;
        Some((
            cost,
            Fit { name: &offer.name, title: &offer.title, choice: Choice::Offer(offer), letters, synonym: None },
        ))
    };
    let mut found: Vec<_> = offers.iter().filter_map(fit).collect();
    found.sort_by_key(|(cost, _)| *cost);
    found.into_iter().map(|(_, fit)| fit).collect()
}

/// Returns the matches, best first; everything before anything is typed, the actions first.
fn fits<'a>(typed: &str, recent: &[Action], offers: &'a [Offer]) -> Vec<Fit<'a>> {
    let age = |choice: Choice<'_>| match choice {
        Choice::Action(action) => recent.iter().position(|a| *a == action).unwrap_or(usize::MAX),
        Choice::Offer(_) => usize::MAX,
    };
    let actions = ACTIONS.iter().filter(|entry| entry.action != Action::Palette);
    let actions = actions.map(|entry| (entry.name, entry.title, entry.synonyms, Choice::Action(entry.action)));
    let offers = offers.iter().map(|offer| (offer.name.as_str(), offer.title.as_str(), "", Choice::Offer(offer)));
    let mut found: Vec<_> = actions
        .chain(offers)
        .filter_map(|(name, title, synonyms, choice)| {
            let own = fuzzy::fit(typed, title).map(|(cost, letters)| (cost, letters, None));
            let other =
                fuzzy::fit_with(typed, title, synonyms).map(|(cost, letters, word)| (cost, letters, Some(word)));
            let (cost, letters, synonym) = own.into_iter().chain(other).min_by_key(|(cost, ..)| *cost)?;
            Some((cost, age(choice), Fit { name, title, choice, letters, synonym }))
        })
        .collect();
    // Equal ones stay in the table's order.
    found.sort_by_key(|(cost, age, _)| (*cost, *age));
    found.into_iter().map(|(_, _, fit)| fit).collect()
}

/// Shows a title with the matched letters emphasised, and the key.
fn row(ui: &Ui, rect: Rect, fit: &Fit<'_>, key: &str, is_selected: bool) {
    let painter = ui.painter().with_clip_rect(rect);
    let weak = if is_selected { theme::of(ui).text } else { theme::of(ui).weak };
    let key = painter.layout_no_wrap(key.to_owned(), FontId::proportional(12.0), weak);
    let mut job = LayoutJob::default();
    for (i, letter) in fit.title.char_indices() {
        let color = match (fit.letters.contains(&i), is_selected) {
            (true, true) => theme::of(ui).strong,
            (true, false) => theme::of(ui).accent,
            (false, _) => theme::of(ui).text,
        };
        job.append(letter.encode_utf8(&mut [0; 4]), 0.0, egui::TextFormat::simple(FontId::proportional(13.5), color));
    }
    if let Some(word) = fit.synonym {
        job.append(word, 8.0, egui::TextFormat::simple(FontId::proportional(12.0), weak));
    }
    let room = rect.width() - key.size().x - 36.0;
    job.wrap = egui::text::TextWrapping::truncate_at_width(room.max(40.0));
    let title = painter.layout_job(job);
    painter.galley(pos2(rect.left() + 10.0, rect.center().y - title.size().y / 2.0), title, theme::of(ui).text);
    let at = pos2(rect.right() - 10.0 - key.size().x, rect.center().y - key.size().y / 2.0);
    painter.galley(at, key, weak);
}

#[cfg(test)]
mod tests;
