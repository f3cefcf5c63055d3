//! Tests moving the focus through two panels of buttons and a text that takes every key.

use super::*;
use egui::{EventFilter, Modal, Panel as Side, RawInput, Sense, pos2, vec2};

#[derive(Default)]
struct Stage {
    ctx: Context,
    focus: Focus,
    /// A dialog with two buttons is open.
    asks: bool,
    /// A second text exists, after everything else.
    has_second: bool,
}

/// An action of a frame besides showing the widgets.
#[derive(Clone, Copy, PartialEq)]
enum Step {
    None,
    Panel { forward: bool },
}

impl Stage {
    fn text() -> Id {
        Id::unique("text")
    }

    fn second() -> Id {
        Id::unique("second text")
    }

    /// Shows a frame; returns the label of the widget that has the focus afterwards.
    fn frame(&mut self, events: Vec<Event>, step: Step) -> String {
        let screen_rect = Some(Rect::from_min_size(pos2(0.0, 0.0), vec2(400.0, 300.0)));
        let input = RawInput { screen_rect, events, focused: true, ..RawInput::default() };
        let mut names: Vec<(Id, String)> = vec![(Self::text(), "text".into()), (Self::second(), "second".into())];
        let Stage { ctx, focus, asks, has_second } = self;
        let mut output = ctx.run_ui(input, |ui| {
            let mut out = UiOutput::default();
            focus.take_keys(ui);
            let mut button = |ui: &mut Ui, name: &str| names.push((ui.button(name).id, name.to_owned()));
            Side::top("top").show(ui, |ui| {
                out.stop("top", ui);
                ui.horizontal(|ui| ["a", "b", "c"].into_iter().for_each(|name| button(ui, name)));
            });
            Side::left("left").show(ui, |ui| {
                out.stop("left", ui);
                ["d", "e"].into_iter().for_each(|name| button(ui, name));
            });
            let mut home = |ui: &mut Ui, name: &'static str, id: Id| {
                out.home(name, ui, id);
                let response = ui.interact(ui.max_rect(), id, Sense::click_and_drag());
                if response.has_focus() {
                    let all = EventFilter { tab: true, horizontal_arrows: true, vertical_arrows: true, escape: true };
                    ui.memory_mut(|m| m.set_focus_lock_filter(id, all));
                }
            };
            if *has_second {
                Side::bottom("second").exact_size(40.0).show(ui, |ui| home(ui, "second", Self::second()));
            }
            egui::CentralPanel::default().show(ui, |ui| home(ui, "text", Self::text()));
            if *asks {
                let list = ["yes", "no"].into_iter();
                Modal::new(Id::unique("ask")).show(ui.ctx(), |ui| list.for_each(|name| button(ui, name)));
            }
            if let Step::Panel { forward } = step {
                focus.step(ui, &out, forward);
            }
            focus.settle(ui, &out, *asks);
        });
        output.textures_delta.clear();
        let focused = self.ctx.memory(|m| m.focused());
        let name = names.iter().find(|(id, _)| Some(*id) == focused).map(|(_, name)| name.clone());
        name.unwrap_or_else(|| format!("{focused:?}"))
    }

    fn press(&mut self, key: Key, modifiers: Modifiers) -> String {
        let event = Event::Key { key, physical_key: None, pressed: true, repeat: false, modifiers };
        self.frame(vec![event], Step::None);
        self.frame(vec![], Step::None)
    }

    fn tab(&mut self) -> String {
        self.press(Key::Tab, Modifiers::NONE)
    }

    fn step(&mut self, forward: bool) -> String {
        self.frame(vec![], Step::Panel { forward });
        self.frame(vec![], Step::None)
    }
}

#[test]
fn f6_cycles_panels_and_tab_stays_within_one() {
    let mut stage = Stage::default();
    stage.frame(vec![], Step::None);
    assert_eq!(stage.frame(vec![], Step::None), "text", "what is home has the keyboard where nobody else has");
    assert_eq!(stage.tab(), "text", "Tab is typed there");
    assert_eq!(stage.step(true), "a");
    assert_eq!([stage.tab(), stage.tab(), stage.tab()], ["b", "c", "a"]);
    assert_eq!(stage.press(Key::Tab, Modifiers::SHIFT), "c");
    assert_eq!([stage.step(true), stage.tab()], ["d", "e"]);
    assert_eq!([stage.step(false), stage.step(true), stage.step(true)], ["c", "e", "text"], "where one was before");
    assert_eq!(stage.step(false), "e");
    assert_eq!(stage.press(Key::Escape, Modifiers::NONE), "text");
}

#[test]
fn a_dialog_traps_and_restores_the_focus() {
    let mut stage = Stage::default();
    stage.frame(vec![], Step::None);
    assert_eq!(stage.frame(vec![], Step::None), "text");
    stage.asks = true;
    stage.frame(vec![], Step::None);
    assert_eq!(stage.frame(vec![], Step::None), "None", "what lies below has lost it");
    assert_eq!([stage.tab(), stage.tab(), stage.tab()], ["yes", "no", "yes"]);
    stage.asks = false;
    stage.frame(vec![], Step::None);
    stage.frame(vec![], Step::None);
    assert_eq!(stage.frame(vec![], Step::None), "text");
}

#[test]
fn escape_returns_to_the_last_used_home() {
    let mut stage = Stage { has_second: true, ..Stage::default() };
    stage.frame(vec![], Step::None);
    assert_eq!(stage.frame(vec![], Step::None), "text");
    assert_eq!([stage.step(true), stage.step(true)], ["second", "a"]);
    assert_eq!(stage.press(Key::Escape, Modifiers::NONE), "text");
    assert_eq!(stage.step(true), "second");
    assert_eq!(stage.press(Key::X, Modifiers::NONE), "second", "something is done there");
    assert_eq!(stage.step(true), "a");
    assert_eq!(stage.press(Key::Escape, Modifiers::NONE), "second");
}

#[test]
fn pressing_shift_alone_does_not_count_as_use() {
    let mut stage = Stage { has_second: true, ..Stage::default() };
    stage.frame(vec![], Step::None);
    assert_eq!(stage.frame(vec![], Step::None), "text");
    for _ in 0..2 {
        stage.press(Key::ShiftLeft, Modifiers::SHIFT);
        stage.step(true);
    }
    assert_eq!(stage.press(Key::Escape, Modifiers::NONE), "text");
}
