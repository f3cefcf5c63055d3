//! The initial contents of a pass, and its border.

use crate::{
    gui::{accessible, theme, ui_output::UiOutput},
    project::{FillKind, FillValue, Pass, PassEdit, PassName},
    session::EditCommand,
};
use egui::{ComboBox, DragValue, Key, RichText, Role, TextEdit, Ui, vec2};
use std::{path::Path, sync::Arc};

/// The initial text of a new expression.
const FIRST: &str = "vec4(0.0)";

/// A value that is being typed.
#[derive(Debug, Default)]
pub(super) struct Filling {
    /// The pass, and the value that it had when the text was taken from it.
    of: Option<(PassName, Option<FillValue>)>,
    text: String,
    /// A file is requested that has no name yet.
    wants_file: bool,
}

/// The kinds of values to choose from.
#[derive(Clone, Copy, PartialEq)]
enum Form {
    Nothing,
    Expression,
    File,
}

impl Form {
    fn of(value: Option<&FillValue>) -> Form {
        match value {
            None => Form::Nothing,
            Some(FillValue::Expression(_)) => Form::Expression,
            Some(FillValue::File(_) | FillValue::InMemory { .. }) => Form::File,
        }
    }
}

/// Shows one of the two in a cell of the grid.
pub(super) fn show(ui: &mut Ui, pass: &Pass, kind: FillKind, filling: &mut Filling, out: &mut UiOutput) {
    let now = pass.fill(kind).map(|fill| fill.value.clone());
    let width = pass.settings.boundary.as_ref().map_or(1, |boundary| boundary.width);
    let of = Some((pass.id.clone(), now.clone()));
    if filling.of != of {
        *filling = Filling { of, text: now.as_ref().map(text).unwrap_or_default(), wants_file: false };
    }
    let edit = |out: &mut UiOutput, value: Option<FillValue>, width: u32| {
        let pass = pass.id.clone();
        out.ask(EditCommand::EditPasses(match kind {
            FillKind::Initial => PassEdit::Initial(pass, value),
            FillKind::Boundary => PassEdit::Boundary(pass, value.map(|value| (width, value))),
        }));
    };
    let form = if filling.wants_file { Form::File } else { Form::of(now.as_ref()) };
    let key = kind.key();
    let nothing = match kind {
        FillKind::Initial => "zeros",
        FillKind::Boundary => "as drawn",
    };
    let name_of = |form: Form| match form {
        Form::Nothing => nothing,
        Form::Expression => "an expression",
        Form::File => "a file",
    };
    ui.vertical(|ui| {
        ui.horizontal(|ui| {
            let mut chosen = form;
            let combo = ComboBox::from_id_salt(key).width(104.0).selected_text(name_of(form)).show_ui(ui, |ui| {
                for one in [Form::Nothing, Form::Expression, Form::File] {
                    let item = ui.selectable_label(one == form, name_of(one));
                    if out.clicked(&format!("passes:{key}:{}", name_of(one)), &item) {
                        chosen = one;
                    }
                }
            });
            let what = match kind {
                FillKind::Initial => "Initial state",
                FillKind::Boundary => "Edges",
            };
            accessible::name(&combo.response, Role::ComboBox, what);
            out.place(format!("passes:{key}"), combo.response.rect);
            if chosen != form {
                filling.wants_file = chosen == Form::File;
                match chosen {
                    Form::Nothing => edit(out, None, width),
                    Form::Expression => edit(out, Some(FillValue::Expression(FIRST.into())), width),
                    Form::File => filling.text.clear(),
                }
            }
            if kind == FillKind::Boundary && now.is_some() {
                let mut next = width;
                let drag = ui.add(DragValue::new(&mut next).range(1..=32_768).speed(0.1));
                accessible::name(&drag, Role::SpinButton, "Edge width in texels");
                out.place("passes:boundary:width", drag.rect);
                ui.label(if width == 1 { "texel wide" } else { "texels wide" });
                if next != width {
                    edit(out, now.clone(), next);
                }
            }
        });
        if form != Form::Nothing
            && let Some(value) = field(ui, key, form, filling, out)
            && now.as_ref() != Some(&value)
        {
            edit(out, Some(value), width);
        }
    });
}

/// Shows the text of a value. Returns the new value when it has been typed.
fn field(ui: &mut Ui, key: &str, form: Form, filling: &mut Filling, out: &mut UiOutput) -> Option<FillValue> {
    let hint = if form == Form::File { "state.npy or an image file" } else { FIRST };
    let hint = RichText::new(hint).color(theme::of(ui).weak);
    let field = TextEdit::singleline(&mut filling.text).hint_text(hint).font(egui::TextStyle::Monospace);
    let width = ui.available_width().clamp(140.0, 420.0);
    let response = ui.add_sized(vec2(width, 24.0), field);
    let (name, tip) = match form {
        Form::File => ("File", "An image or .npy file in the project's folder; row 0 of an array is the bottom"),
        _ => ("Expression", "A vec4 expression in GLSL; may use Common, fragCoord and Shadertoy's uniforms"),
    };
    accessible::name(&response, Role::TextInput, format!("{name}, {key}"));
    out.place(format!("passes:{key}:text"), response.rect);
    let is_cancelled = ui.input(|i| i.key_pressed(Key::Escape));
    let is_done = response.lost_focus();
    response.on_hover_text(tip);
    if !is_done {
        return None;
    }
    let typed = filling.text.trim();
    if is_cancelled || typed.is_empty() {
        // Show the current value again.
        filling.of = None;
        return None;
    }
    Some(match form {
        Form::File => FillValue::File(Path::new(typed).to_owned()),
        _ => FillValue::Expression(Arc::from(typed)),
    })
}

fn text(value: &FillValue) -> String {
    match value {
        FillValue::Expression(text) => text.to_string(),
        FillValue::File(path) | FillValue::InMemory { name: path, .. } => path.display().to_string(),
    }
}
