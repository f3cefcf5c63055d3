//! The author's own uniforms: sliders, numbers, colours, switches.

use super::{
    dock::COLLAPSED,
    panels::{Content, DefaultPlace, PanelRow},
    theme,
    ui_output::UiOutput,
    uniform_row,
};
use crate::{
    project::{CustomUniform, Dialect},
    session::{Command, EditCommand, Session},
};
use egui::{Align, Button, Layout, Margin, RichText, ScrollArea, Ui, Vec2};

pub(super) const PANEL: PanelRow = PanelRow::new(
    "uniforms",
    "Uniforms",
    DefaultPlace::BelowPicture,
    Content::Within(Margin::symmetric(10, 0), |ui, context| show(ui, context.session, context.out)),
)
.open_by_default()
.tools(|ui, context| tools(ui, context.session, context.out))
.heading(|context| match context.session.custom_uniforms().len() {
    0 => "Uniforms".to_owned(),
    n => format!("Uniforms ({n})"),
})
.action("Panel: Uniforms", &[], "sliders parameters tweak");

const ROW: f32 = uniform_row::HEIGHT;
/// The height of two lines of text.
const EMPTY: f32 = COLLAPSED;
/// The height of a group's name.
const GROUP: f32 = 24.0;

/// Returns the height of all rows.
pub(super) fn height(session: &Session) -> f32 {
    let groups = groups(session.custom_uniforms());
    let names = groups.iter().filter(|(name, _)| !name.is_empty()).count();
    match session.custom_uniforms().len() {
        0 => EMPTY,
        n => ROW * n as f32 + GROUP * names as f32 + 8.0,
    }
}

/// Returns the uniforms by group, groups and uniforms in the order of the code; those without a group come first.
fn groups(custom_uniforms: &[CustomUniform]) -> Vec<(&str, Vec<&CustomUniform>)> {
    let mut groups: Vec<(&str, Vec<&CustomUniform>)> = vec![("", Vec::new())];
    for custom_uniform in custom_uniforms {
        match groups.iter_mut().find(|(name, _)| *name == custom_uniform.group) {
            Some((_, members)) => members.push(custom_uniform),
            None => groups.push((&custom_uniform.group, vec![custom_uniform])),
        }
    }
    groups
}

/// Shows the controls for all uniforms at the right end of the panel's row.
fn tools(ui: &mut Ui, session: &Session, out: &mut UiOutput) {
    let custom_uniforms = session.custom_uniforms();
    if custom_uniforms.iter().any(|k| session.custom_uniform_value(k) != k.default) {
        let reset = ui.add(Button::new("Reset all").small()).on_hover_text("Reset all uniforms to their defaults");
        out.on_click("uniforms:reset", &reset, Command::Edit(EditCommand::ResetCustomUniforms));
    }
}

/// Returns how to declare a slider in a project without any: a sentence, and a line of code if one can be written.
fn how_to_declare(dialect: Dialect) -> (&'static str, &'static str) {
    match dialect {
        Dialect::Shadertoy => ("Add a line like this to get a slider:", "#iUniform float speed = 1.0 in { 0.0, 4.0 }"),
        Dialect::Ghostty => ("Ghostty gives a shader its own uniforms and no others.", ""),
        Dialect::Isf => (
            "Add a line like this to INPUTS, and save, to get a slider:",
            r#"{ "NAME": "speed", "TYPE": "float", "DEFAULT": 1.0, "MIN": 0.0, "MAX": 4.0 }"#,
        ),
        _ => ("Add a line like this to get a slider:", "uniform float speed;"),
    }
}

fn show(ui: &mut Ui, session: &Session, out: &mut UiOutput) {
    out.stop("uniforms", ui);
    let custom_uniforms = session.custom_uniforms();
    ui.spacing_mut().item_spacing.y = 3.0;
    ScrollArea::vertical().auto_shrink([false, false]).show(ui, |ui| {
        if custom_uniforms.is_empty() {
            let (text, line) = how_to_declare(session.project().dialect);
            ui.colored_label(theme::of(ui).weak, text);
            ui.add(egui::Label::new(RichText::new(line).monospace()).selectable(true));
        }
        for (name, members) in groups(custom_uniforms) {
            if !name.is_empty() {
                let title = RichText::new(name).size(12.5).color(theme::of(ui).strong);
                let place = Vec2::new(ui.available_width(), GROUP - 3.0);
                let layout = Layout::left_to_right(Align::Max);
                let shown = ui.allocate_ui_with_layout(place, layout, |ui| {
                    ui.set_min_size(place);
                    ui.add(egui::Label::new(title).truncate());
                });
                out.place(format!("uniforms:group:{name}"), shown.response.rect);
            }
            for custom_uniform in members {
                ui.push_id(&custom_uniform.name, |ui| uniform_row::show(ui, session, custom_uniform, out));
            }
        }
    });
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::project::{Origin, Pass, PassName, Project, Source};

    #[test]
    fn groups_keep_the_order_of_the_code_after_ungrouped_uniforms() {
        let text = "//@group Light\n#iUniform float a\n//@group\n#iUniform float b\n//@group Fog\n#iUniform float c\n\
                    //@group Light\n#iUniform float d\n";
        let source = Source { name: "image.glsl".into(), path: None, text: text.into() };
        let project = Project::new("p", vec![Pass::new(PassName::image(), source)], Origin::Unsaved);
        let list = project.custom_uniforms().list;
        let shown: Vec<(&str, Vec<&str>)> = groups(&list)
            .into_iter()
            .map(|(name, members)| (name, members.iter().map(|one| one.name.as_str()).collect()))
            .collect();
        assert_eq!(shown, [("", vec!["b"]), ("Light", vec!["a", "d"]), ("Fog", vec!["c"])]);
    }
}
