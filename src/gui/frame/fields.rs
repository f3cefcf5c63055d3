//! A click on a button next to a field leaves the keyboard focus in the field, in every panel that has both.

use super::harness::{CTRL, CTRL_SHIFT, Stage, click, open, press, until};
use crate::{
    gui::panels::Panel,
    playback::comparing::Baseline,
    session::{Status, ToolCommand, ViewCommand, probe::ProbePlace},
};
use egui::{
    Event, Id, Key, LayerId, Modifiers, Pos2, Rect,
    accesskit::{Action, Role},
    pos2,
};
use egui_kittest::kittest::NodeT as _;

const MARK: &str = "§";

/// A widget that takes text or can be clicked: its place, name and id.
struct Widget {
    rect: Rect,
    name: String,
    id: u64,
}

fn widgets(stage: &Stage, roles: &[Role]) -> Vec<Widget> {
    let mut found = Vec::new();
    for node in stage.root().children_recursive() {
        let node = node.accesskit_node();
        let (data, is_of_code) = (node.data(), node.label().is_some_and(|label| label.starts_with("Code of")));
        if data.is_hidden()
            || data.is_disabled()
            || is_of_code
            || !roles.contains(&data.role())
            || !data.supports_action(Action::Focus)
        {
            continue;
        }
        let Some(b) = node.raw_bounds() else { continue };
        let rect = Rect::from_min_max(pos2(b.x0 as f32, b.y0 as f32), pos2(b.x1 as f32, b.y1 as f32));
        let own = [node.label(), node.value(), data.placeholder().map(str::to_owned)];
        let name = own.into_iter().flatten().find(|name| !name.trim().is_empty()).unwrap_or_default();
        let is_within = stage.ctx.content_rect().shrink(2.0).contains_rect(rect);
        let is_seen = is_within && layer_of(stage, node.locate().0.0) == stage.ctx.layer_id_at(rect.center());
        if is_seen && rect.is_positive() {
            found.push(Widget { rect, name, id: node.locate().0.0 });
        }
    }
    found
}

/// Returns the layer that contains a widget. A click on a widget reaches it unless another layer covers it.
fn layer_of(stage: &Stage, id: u64) -> Option<LayerId> {
    stage.ctx.viewport(|viewport| {
        let all = &viewport.prev_pass.widgets;
        all.layer_ids().find(|&layer| all.get_layer(layer).any(|widget| widget.id.value() == id))
    })
}

fn click_at(stage: &mut Stage, at: Pos2) {
    stage.hover_at(at);
    stage.drag_at(at);
    stage.drop_at(at);
    stage.run_steps(4);
}

fn focused(stage: &Stage) -> Option<u64> {
    stage.ctx.memory(|m| m.focused()).map(|id: Id| id.value())
}

/// Buttons that move the keyboard focus to another part of the window. Without a desktop's file dialog the window
/// shows its own, once the desktop has answered.
const LEADING: [&str; 7] =
    ["Edit its text", "Show its picture", "Image:8", "Go", "Start", "Open file…", "Open folder…"];

/// Clicks the buttons next to each field in its panel, and types. Returns the pairs that were tried.
fn try_all(stage: &mut Stage, state: &str, set_up: &dyn Fn(&mut Stage)) -> usize {
    let fields = [Role::TextInput, Role::SpinButton, Role::MultilineTextInput, Role::SearchInput];
    let buttons = [Role::Button, Role::CheckBox, Role::RadioButton, Role::Switch];
    set_up(stage);
    let mut pairs = Vec::new();
    for field in widgets(stage, &fields).into_iter().take(8) {
        let group = |stage: &Stage, at: Pos2| {
            let layer = stage.ctx.layer_id_at(at);
            // Popups over the panels form a group of their own.
            let is_over = layer.is_some_and(|layer| layer.order != egui::Order::Background);
            (layer, stage.state().shell.stop_at(at).filter(|_| !is_over))
        };
        let here = group(stage, field.rect.center());
        let mut beside: Vec<Widget> = widgets(stage, &buttons);
        beside.retain(|b| b.id != field.id && group(stage, b.rect.center()) == here);
        let far = |b: &Widget| b.rect.center().distance(field.rect.center());
        beside.sort_by(|a, b| far(a).total_cmp(&far(b)));
        pairs.extend(beside.into_iter().take(5).map(|b| (field.name.clone(), field.rect, b.name, b.rect)));
    }
    let count = pairs.len();
    for (field_name, field_rect, button_name, button_rect) in pairs {
        press(stage, Modifiers::NONE, Key::Escape);
        set_up(stage);
        let here = |stage: &Stage| {
            let near = |w: &Widget| w.rect.center().distance(field_rect.center()) < 12.0;
            widgets(stage, &fields).into_iter().find(near)
        };
        let Some(field) = here(stage) else { continue };
        click_at(stage, field.rect.center());
        if focused(stage) != Some(field.id) {
            // A number is edited by a click, a field by a press.
            continue;
        }
        let pair = format!("{state}: {field_name:?} beside {button_name:?}");
        let texts = |stage: &Stage| -> Vec<String> {
            let session = &stage.state().session;
            session.tabs().iter().map(|tab| session.text(tab).to_owned()).collect()
        };
        let before = texts(stage);
        click_at(stage, button_rect.center());
        let is_led_away = LEADING.contains(&button_name.as_str());
        if let (Some(_), false) = (here(stage), is_led_away) {
            let popup = egui::Popup::is_any_open(&stage.ctx);
            let has_keys = |w: &Widget| focused(stage) == Some(w.id);
            // A button may remove the field; another one then takes its place.
            let is_gone = !widgets(stage, &fields).iter().any(|w| w.id == field.id);
            let is_kept = widgets(stage, &fields).iter().any(has_keys)
                || is_gone && widgets(stage, &buttons).iter().any(has_keys);
            assert!(popup || is_kept, "{pair}: the keyboard is at {:?}", focused(stage));
            stage.event(Event::Text(MARK.into()));
            stage.run_steps(2);
            assert!(!texts(stage).iter().any(|text| text.contains(MARK)), "{pair}: what is typed goes into the code");
            // Undo removes an added pass.
            let may_take_away = popup || button_name == "Undo";
            assert!(may_take_away || texts(stage).len() >= before.len(), "{pair}: a tab is gone");
        }
    }
    count
}

#[test]
fn clicking_a_button_keeps_the_focus_in_its_field() {
    let Some(mut stage) = open(false) else { return };
    let open_panel = |panel: Panel| {
        move |stage: &mut Stage| {
            for other in Panel::all() {
                stage
                    .state_mut()
                    .shell
                    .set_open(other, matches!(other, Panel::Code | Panel::Picture) || other == panel);
            }
            stage.run_steps(4);
        }
    };
    let by_keys = |modifiers: Modifiers, key: Key, field: &'static str| {
        move |stage: &mut Stage| {
            if stage.state().shell.place(field).is_none() {
                press(stage, modifiers, key);
            }
        }
    };
    stage.state_mut().session.apply(ToolCommand::Trace(Some([0.5, 0.5])));
    stage.state_mut().shell.set_open(Panel::Trace, true);
    until(&mut stage, "a traced pixel", |stage| stage.state().session.trace().traced.is_some());
    stage.state_mut().session.apply(ToolCommand::Compare(Some(Baseline::LastSave)));
    until(&mut stage, "a comparison", |stage| matches!(stage.state().session.comparison(), Some(Status::Ended(Ok(_)))));
    let mut tried = Vec::new();
    let mut all = |stage: &mut Stage, state: &str, set_up: &dyn Fn(&mut Stage)| {
        let count = try_all(stage, state, set_up);
        eprintln!("{state}: {count} pairs");
        tried.push((state.to_owned(), count));
        press(stage, Modifiers::NONE, Key::Escape);
        press(stage, Modifiers::NONE, Key::Escape);
    };
    all(&mut stage, "trace", &|stage| {
        if stage.state().session.trace().traced.is_none() {
            stage.state_mut().session.apply(ToolCommand::Trace(Some([0.5, 0.5])));
            until(stage, "a traced pixel", |stage| stage.state().session.trace().traced.is_some());
        }
        open_panel(Panel::Trace)(stage);
    });
    for panel in [Panel::Compare, Panel::Buffers, Panel::Uniforms, Panel::Measurements, Panel::Costs, Panel::Lab] {
        all(&mut stage, panel.title(), &open_panel(panel));
    }
    all(&mut stage, "find and replace", &by_keys(CTRL, Key::H, "field:replace"));
    all(&mut stage, "a line", &by_keys(CTRL, Key::G, "field:line"));
    all(&mut stage, "palette", &by_keys(CTRL_SHIFT, Key::P, "palette"));
    all(&mut stage, "passes", &|stage| {
        by_keys(CTRL_SHIFT, Key::B, "passes:row:Buffer A")(stage);
        click(stage, "passes:row:Buffer A");
    });
    press(&mut stage, CTRL_SHIFT, Key::B);
    all(&mut stage, "help", &by_keys(Modifiers::NONE, Key::F1, "field:help"));
    all(&mut stage, "time", &|stage| {
        if !egui::Popup::is_any_open(&stage.ctx) {
            click(stage, "button:time");
        }
    });
    all(&mut stage, "a colour", &|stage| {
        open_panel(Panel::Uniforms)(stage);
        if !egui::Popup::is_any_open(&stage.ctx) {
            click(stage, "uniform:tint");
        }
    });
    all(&mut stage, "probe", &|stage| {
        if stage.state().session.probe().is_none() {
            let tab = stage.state().session.tabs().into_iter().find(|tab| tab.title() == "Image").unwrap();
            let at = stage.state().session.text(&tab).find("red * at").unwrap();
            stage.state_mut().session.apply(ViewCommand::Probe(Some(ProbePlace { tab, at, visit: 0 })));
        }
        until(stage, "a probe", |stage| stage.state().shell.place("probe:close").is_some());
    });
    all(&mut stage, "gallery", &|stage| {
        if stage.state().shell.place("gallery:search").is_none() {
            press(stage, CTRL_SHIFT, Key::G);
        }
    });
    let pairs: usize = tried.iter().map(|(_, count)| count).sum();
    assert!(pairs > 40, "{tried:?}");
    for state in ["find and replace", "trace", "passes", "probe"] {
        assert!(tried.iter().any(|(name, count)| name == state && *count > 0), "{state}: {tried:?}");
    }
}

#[test]
fn removing_a_field_keeps_the_focus_in_its_panel() {
    let Some(mut stage) = open(false) else { return };
    press(&mut stage, CTRL_SHIFT, Key::B);
    click(&mut stage, "passes:row:Buffer A");
    click(&mut stage, "passes:region");
    let number = stage.state().shell.place("passes:region:x").unwrap().center();
    click_at(&mut stage, number);
    click(&mut stage, "passes:region");
    stage.run_steps(4);
    assert!(stage.state().shell.place("passes:region:x").is_none());
    assert!(!stage.state().shell.has_keys(&stage.ctx), "the code has the keyboard");
    let session = &stage.state().session;
    let before: Vec<String> = session.tabs().iter().map(|tab| session.text(tab).to_owned()).collect();
    stage.event(Event::Text(MARK.into()));
    stage.run_steps(2);
    let session = &stage.state().session;
    assert!(session.tabs().iter().map(|tab| session.text(tab)).eq(before.iter().map(String::as_str)));
}
