//! The resolution of the picture: the sizes to choose from, and a field for any other.

use super::{
    accessible,
    actions::{Action, PictureAction, SCALES, SIZES},
    geometry::Shape,
    theme,
    ui_output::UiOutput,
};
use crate::session::{CanvasCommand, Session};
use egui::{
    Align2, Button, ComboBox, Id, Key, Margin, Popup, PopupCloseBehavior, Response, RichText, Role, ScrollArea,
    TextEdit, Ui, vec2,
};

/// The height of the list, which scrolls.
const HEIGHT: f32 = 360.0;
const WIDTH: f32 = 216.0;

fn popup() -> Id {
    Id::unique("menu of the resolution")
}

fn typed() -> Id {
    Id::unique("resolution that is typed")
}

fn field() -> Id {
    Id::unique("resolution field")
}

fn is_asked() -> Id {
    Id::unique("the keyboard goes to the resolution")
}

/// The text of the field.
#[derive(Clone, Default)]
struct Typed {
    text: String,
    /// Enter was pressed, and the text is not a valid size.
    is_refused: bool,
    /// The egui pass in which it was last shown.
    shown: u64,
}

/// Opens the menu with the keyboard focus in its field.
pub(super) fn open(ctx: &egui::Context) {
    Popup::open_id(ctx, popup());
    ctx.data_mut(|data| data.insert_temp(typed(), Typed::default()));
    // The field does not exist yet.
    ctx.data_mut(|data| data.insert_temp(is_asked(), true));
}

/// Shows the menu that [`open`] opens, at a widget. Called in each frame, whichever widget it is.
pub(super) fn opened(anchor: &Response, session: &Session, shape: Shape, out: &mut UiOutput) {
    let menu = Popup::from_response(anchor).id(popup()).open_memory(None).style(egui::containers::menu::menu_style);
    menu.close_behavior(PopupCloseBehavior::CloseOnClickOutside).show(|ui| {
        ScrollArea::vertical().max_height(HEIGHT).show(ui, |ui| list(ui, session, shape, out));
    });
}

/// Shows the resolution on a button that opens the list.
pub(super) fn button(ui: &mut Ui, session: &Session, shape: Shape, out: &mut UiOutput) {
    let (width, height) = session.transport().resolution;
    let response = ComboBox::from_id_salt("size")
        .width(96.0)
        .height(HEIGHT)
        .close_behavior(PopupCloseBehavior::CloseOnClickOutside)
        .selected_text(RichText::new(format!("{width}×{height}")).monospace().size(12.0))
        .show_ui(ui, |ui| list(ui, session, shape, out))
        .response
        .on_hover_text("Resolution of the picture in pixels (iResolution)");
    accessible::name(&response, Role::ComboBox, "Resolution");
    out.place("combo:size", response.rect);
    opened(&response, session, shape, out);
}

/// Shows a menu entry that opens the list next to it.
pub(super) fn entry(ui: &mut Ui, session: &Session, shape: Shape, out: &mut UiOutput) {
    let (width, height) = session.transport().resolution;
    let config = egui::containers::menu::MenuConfig::new().close_behavior(PopupCloseBehavior::CloseOnClickOutside);
    let title = format!("Resolution: {width}×{height}");
    let (response, _) = egui::containers::menu::SubMenuButton::new(title).config(config).ui(ui, |ui| {
        ScrollArea::vertical().max_height(HEIGHT).show(ui, |ui| list(ui, session, shape, out));
    });
    out.place("options:resolution", response.rect);
}

/// Shows the resolutions to choose from.
fn list(ui: &mut Ui, session: &Session, shape: Shape, out: &mut UiOutput) {
    ui.set_min_width(WIDTH);
    let transport = session.transport();
    let mut chosen = None;
    size_field(ui, session, out);
    ui.separator();
    for (choice, name) in [(Shape::Site, "16:9, as on Shadertoy"), (Shape::Fill, "Fill the panel")] {
        let on = transport.fixed_size.is_none() && shape == choice;
        if ui.selectable_label(on, name).clicked() {
            chosen = Some(PictureAction::Shape(choice));
        }
    }
    ui.separator();
    // Two dense blocks, so that all of it is in sight in a window of 800x500.
    ui.colored_label(theme::of(ui).weak, "Scale");
    ui.horizontal(|ui| {
        ui.spacing_mut().item_spacing.x = 2.0;
        for scale in SCALES {
            let on = transport.fixed_size.is_none() && (transport.scale - scale.factor()).abs() < 1e-3;
            if out.clicked(&format!("scale:{}", scale.name()), &ui.selectable_label(on, scale.name())) {
                chosen = Some(PictureAction::Scale(scale));
            }
        }
    });
    ui.separator();
    ui.colored_label(theme::of(ui).weak, "Fixed size");
    let own = transport.fixed_size.filter(|size| !SIZES.contains(size));
    egui::Grid::new("fixed sizes").num_columns(2).spacing([2.0, 2.0]).show(ui, |ui| {
        for (n, size) in SIZES.into_iter().chain(own).enumerate() {
            let name = format!("{} × {}", size.0, size.1);
            let on = transport.fixed_size == Some(size);
            if out.clicked(&format!("size:{}x{}", size.0, size.1), &ui.selectable_label(on, name)) {
                chosen = Some(PictureAction::Size(size));
            }
            if n % 2 == 1 {
                ui.end_row();
            }
        }
    });
    if let Some(action) = chosen {
        out.act(Action::Picture(action));
        Popup::close_all(ui.ctx());
    }
}

/// Shows a field for any size, and below it a hint or why the size cannot be drawn.
fn size_field(ui: &mut Ui, session: &Session, out: &mut UiOutput) {
    let limit = session.gpu().device.limits().max_texture_dimension_2d;
    let pass = ui.ctx().cumulative_pass_nr();
    let kept: Option<Typed> = ui.data(|data| data.get_temp(typed()));
    // A reopened menu starts with an empty field.
    let mut typed_now = kept.filter(|typed| pass.saturating_sub(typed.shown) <= 4).unwrap_or_default();
    typed_now.shown = pass;
    let p = theme::of(ui);
    let mut is_entered = false;
    ui.horizontal(|ui| {
        ui.label("Size");
        let (width, height) = session.transport().resolution;
        let ink = if typed_now.is_refused { p.error } else { p.text };
        let edit = TextEdit::singleline(&mut typed_now.text).id(field()).hint_text(format!("{width}x{height}"));
        let edit = edit.text_color(ink).desired_width(104.0).margin(Margin::symmetric(6, 3));
        let response = ui.add(edit.align(Align2::LEFT_CENTER));
        accessible::name(&response, Role::TextInput, "Width and height in pixels");
        out.place("size:field", response.rect);
        if ui.data_mut(|data| data.remove_temp::<bool>(is_asked())).is_some() {
            response.request_focus();
        }
        typed_now.is_refused &= !response.changed();
        if response.lost_focus() && ui.input(|input| input.key_pressed(Key::Enter)) {
            is_entered = true;
            response.request_focus();
        }
        let is_empty = typed_now.text.trim().is_empty();
        let set = ui.add_enabled(!is_empty, Button::new("Set").min_size(vec2(36.0, 24.0)));
        accessible::name(&set, Role::Button, "Set resolution");
        is_entered |= out.clicked("size:set", &set);
    });
    // Typed and entered in one frame, if frames are slow.
    let size = read(&typed_now.text, limit);
    let is_empty = typed_now.text.trim().is_empty();
    let mut note = format!("Width x height, up to {limit} x {limit}");
    match size {
        _ if is_empty => {}
        Ok(size) if is_entered => {
            out.ask(CanvasCommand::SetFixedSize(Some(size)));
            typed_now = Typed { shown: pass, ..Typed::default() };
            Popup::close_all(ui.ctx());
        }
        Ok(_) => {}
        Err(why) => {
            typed_now.is_refused |= is_entered;
            note = why;
        }
    }
    let ink = if typed_now.is_refused { p.error } else { p.weak };
    let note = ui.label(RichText::new(note).size(11.5).color(ink));
    if typed_now.is_refused {
        out.place("size:error", note.rect);
    }
    ui.data_mut(|data| data.insert_temp(typed(), typed_now));
}

/// Parses a width and a height as people write them: `1080x1920`, `1080 × 1920`, `1080, 1920`. Returns a hint if it is
/// invalid.
fn read(text: &str, limit: u32) -> Result<(u32, u32), String> {
    let between = |c: char| c.is_whitespace() || matches!(c, 'x' | 'X' | '×' | '*' | ',' | ':');
    let text = text.trim().trim_end_matches("px");
    let numbers: Vec<&str> = text.split(between).filter(|part| !part.is_empty()).collect();
    let is_whole = |part: &&str| part.bytes().all(|c| c.is_ascii_digit());
    let (&[width, height], true) = (numbers.as_slice(), numbers.iter().all(is_whole)) else {
        return Err("Enter width and height, like 1080x1920".into());
    };
    // A number that overflows exceeds any limit.
    let side = |part: &str| part.parse().unwrap_or(u32::MAX);
    match (side(width), side(height)) {
        (0, _) | (_, 0) => Err("Width and height must be at least 1".into()),
        (w, h) if w > limit || h > limit => Err(format!("This GPU draws at most {limit} x {limit}")),
        size => Ok(size),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn sizes_are_parsed_in_common_notations() {
        for text in ["1080x1920", " 1080 x 1920 ", "1080X1920", "1080×1920", "1080 1920", "1080, 1920", "1080*1920px"]
        {
            assert_eq!(read(text, 8192), Ok((1080, 1920)), "{text}");
        }
        assert_eq!(read("1x1", 8192), Ok((1, 1)));
        assert_eq!(read("8192x8192", 8192), Ok((8192, 8192)));
        for bad in ["", "x", "1080", "1080x", "axb", "-4x4", "1.5x3", "1x2x3", "1080p", "１x１"] {
            assert!(read(bad, 8192).unwrap_err().contains("like 1080x1920"), "{bad}");
        }
        for none in ["0x4", "4x0", "0 0"] {
            assert!(read(none, 8192).unwrap_err().contains("at least 1"), "{none}");
        }
        for large in ["8193x4", "4x8193", "99999999999999999999x4"] {
            assert_eq!(read(large, 8192).unwrap_err(), "This GPU draws at most 8192 x 8192", "{large}");
        }
    }
}
