//! The name of the selected pass, how it is drawn and how it is read.

use super::fills::{self, Filling};
use crate::{
    gui::{
        accessible, theme,
        ui_output::{ShellCommand, UiOutput},
    },
    project::{
        Condition, FillKind, Filter, Pass, PassEdit, PassName, PassSize, Project, Region, Tab, TexelFormat, Wrap,
    },
    session::{EditCommand, Session, ViewCommand},
};
use egui::{ComboBox, DragValue, Grid, Key, Response, RichText, Role, TextEdit, Ui};

/// A name that is being typed.
#[derive(Debug, Default)]
pub(super) struct Naming {
    of: Option<Tab>,
    text: String,
}

/// Everything that is being typed.
#[derive(Debug, Default)]
pub(super) struct Typed {
    naming: Naming,
    condition: Naming,
    initial: Filling,
    boundary: Filling,
}

pub(super) fn show(ui: &mut Ui, session: &Session, tab: &Tab, typed: &mut Typed, out: &mut UiOutput) {
    let naming = &mut typed.naming;
    let project = session.project();
    if naming.of.as_ref() != Some(tab) {
        *naming = Naming { of: Some(tab.clone()), text: name_of(tab) };
    }
    let Some(pass) = tab.pass().and_then(|id| project.pass(id)) else {
        ui.heading("Common");
        ui.label("Its code is inserted before the code of every pass.");
        shows(ui, tab, None, out);
        return;
    };
    let is_buffer = pass.id.is_buffer();
    let has = |key: &str| pass.id.row().refusal(key).is_none();
    Grid::new("pass settings").num_columns(2).spacing([14.0, 9.0]).show(ui, |ui| {
        ui.label("Name");
        if is_buffer {
            name(ui, project, &pass.id, naming, out);
        } else {
            ui.label(RichText::new(pass.id.title()).color(theme::of(ui).strong));
        }
        ui.end_row();
        ui.label("File");
        let file = match &pass.source.path {
            Some(_) => pass.source.name.clone(),
            None => "not saved yet".into(),
        };
        ui.add(egui::Label::new(RichText::new(file).color(theme::of(ui).weak)).truncate());
        ui.end_row();
        if has("size") {
            ui.label("Size");
            size(ui, session, pass, out);
            ui.end_row();
            ui.label("Format");
            format(ui, pass, out);
            ui.end_row();
        }
        if has("region") {
            ui.label("Region");
            region(ui, session, pass, out);
            ui.end_row();
        }
        if has("when") {
            ui.label("Drawn when").on_hover_text("A condition on uniforms; leave it empty to draw in every frame");
            condition(ui, pass, &mut typed.condition, out);
            ui.end_row();
        }
        if is_buffer {
            ui.label("Steps");
            steps(ui, project, pass, out);
            ui.end_row();
            ui.label("Sampling");
            samplers(ui, project, &pass.id, out);
            ui.end_row();
        }
        let can_be_filled = !pass.body.is_cleared();
        if has("initial") && can_be_filled {
            ui.label("Initial state");
            fills::show(ui, pass, FillKind::Initial, &mut typed.initial, out);
            ui.end_row();
        }
        if has("boundary") && can_be_filled {
            ui.label("Edges").on_hover_text("Overwrite the outermost texels after each draw");
            fills::show(ui, pass, FillKind::Boundary, &mut typed.boundary, out);
            ui.end_row();
        }
    });
    let note = match pass.body.geometry() {
        Some(_) => "This pass draws meshes. Edit eddy.toml to change the meshes and the camera.",
        None => pass.id.row().note,
    };
    if !note.is_empty() {
        ui.add_space(4.0);
        ui.add(egui::Label::new(RichText::new(note).color(theme::of(ui).weak)).wrap());
    }
    shows(ui, tab, Some(&pass.id), out);
}

/// Shows links to the text and to the picture.
fn shows(ui: &mut Ui, tab: &Tab, pass: Option<&PassName>, out: &mut UiOutput) {
    ui.add_space(8.0);
    ui.horizontal(|ui| {
        out.on_click("passes:text", &ui.button("Edit code"), ShellCommand::GoTo(tab.clone(), None));
        if let Some(pass) = pass.filter(|id| id.is_picture())
            && out.clicked("passes:show", &ui.button("Show this pass"))
        {
            out.ask(ViewCommand::ShowPass(pass.clone()));
        }
    });
}

fn name_of(tab: &Tab) -> String {
    tab.pass().filter(|_| tab.is_buffer()).and_then(PassName::buffer_name).map_or_else(|| tab.title(), str::to_owned)
}

fn name(ui: &mut Ui, project: &Project, id: &PassName, naming: &mut Naming, out: &mut UiOutput) {
    let is_wrong = checked(project, id, &naming.text).1.is_some();
    let field = TextEdit::singleline(&mut naming.text).desired_width(150.0);
    let field = field.text_color_opt(is_wrong.then_some(theme::of(ui).error));
    let response = ui.add(field);
    // Typed and entered in one frame, if frames are slow.
    let (wanted, why) = checked(project, id, &naming.text);
    accessible::name(&response, Role::TextInput, "Name");
    out.place("passes:name", response.rect);
    let is_cancelled = ui.input(|i| i.key_pressed(Key::Escape));
    if response.lost_focus() {
        match wanted.filter(|_| why.is_none() && !is_cancelled) {
            Some(other) if other != *id => {
                out.ask(EditCommand::EditPasses(PassEdit::Rename { pass: id.clone(), name: naming.text.clone() }));
                naming.of = None;
            }
            _ => naming.text = name_of(&Tab::Pass(id.clone())),
        }
    }
    if let Some(why) = why {
        response.on_hover_text(why);
    }
}

/// Shows the condition by which a pass is drawn.
fn condition(ui: &mut Ui, pass: &Pass, typed: &mut Naming, out: &mut UiOutput) {
    let now = pass.settings.when.as_ref().map_or("", Condition::text);
    let tab = Tab::Pass(pass.id.clone());
    if typed.of.as_ref() != Some(&tab) {
        *typed = Naming { of: Some(tab), text: now.to_owned() };
    }
    let wrong = |text: &str| Some(text).filter(|text| !text.trim().is_empty()).and_then(|t| Condition::parse(t).err());
    let is_wrong = wrong(&typed.text).is_some();
    let hint = RichText::new("always; or quality > 1").color(theme::of(ui).weak);
    let field = TextEdit::singleline(&mut typed.text).hint_text(hint).font(egui::TextStyle::Monospace);
    let field = field.desired_width(200.0).text_color_opt(is_wrong.then_some(theme::of(ui).error));
    let response = ui.add(field);
    accessible::name(&response, Role::TextInput, "Drawn when");
    out.place("passes:when", response.rect);
    let why = wrong(&typed.text);
    let is_cancelled = ui.input(|i| i.key_pressed(Key::Escape));
    if response.lost_focus() {
        let text = typed.text.trim();
        if !is_cancelled && why.is_none() && text != now {
            edit(out, PassEdit::When(pass.id.clone(), (!text.is_empty()).then(|| text.to_owned())));
        }
    }
    if !response.has_focus() {
        // Shows the current condition, whatever changed it.
        typed.of = None;
    }
    response.on_hover_text(why.map_or_else(
        || "While it is false, the pass is not drawn and holds what it holds before frame 0".to_owned(),
        |why| why.to_string(),
    ));
}

/// Returns the pass that a name denotes, and why this one cannot have it.
fn checked(project: &Project, id: &PassName, name: &str) -> (Option<PassName>, Option<String>) {
    let wanted = PassName::buffer_named(name);
    let why = match &wanted {
        None => Some(PassName::NAMES.to_owned()),
        Some(other) if other != id && project.pass(other).is_some() => {
            Some(format!("{} already exists", other.title()))
        }
        Some(_) => None,
    };
    (wanted, why)
}

fn edit(out: &mut UiOutput, edit: PassEdit) {
    out.ask(EditCommand::EditPasses(edit));
}

/// Records the place of a number, and sets its accessible name.
fn number(response: &Response, name: &str, out: &mut UiOutput) {
    accessible::name(response, Role::SpinButton, name.replace(':', " "));
    out.place(format!("passes:{name}"), response.rect);
}

fn combo_box(response: &Response, name: &str, out: &mut UiOutput) {
    accessible::name(response, Role::ComboBox, name);
    out.place(format!("passes:{name}"), response.rect);
}

fn size(ui: &mut Ui, session: &Session, pass: &Pass, out: &mut UiOutput) {
    let canvas = session.transport().resolution;
    let now = pass.settings.size;
    ui.horizontal(|ui| {
        let label = match now {
            PassSize::Canvas => "picture size",
            PassSize::Scale(_) => "scaled",
            PassSize::Fixed(..) => "fixed",
            PassSize::Sides(..) => "by side",
        };
        let combo = ComboBox::from_id_salt("size").width(104.0).selected_text(label).show_ui(ui, |ui| {
            let (width, height) = now.of(canvas);
            let factor = match now {
                PassSize::Scale(by) => by,
                _ => 0.5,
            };
            for (name, label, size) in [
                ("canvas", "picture size", PassSize::Canvas),
                ("scale", "scaled", PassSize::Scale(factor)),
                ("fixed", "fixed", PassSize::Fixed(width, height)),
            ] {
                let is_now = std::mem::discriminant(&size) == std::mem::discriminant(&now);
                if out.clicked(&format!("passes:size:{name}"), &ui.selectable_label(is_now, label)) && !is_now {
                    edit(out, PassEdit::Size(pass.id.clone(), size));
                }
            }
        });
        combo_box(&combo.response, "size", out);
        match now {
            PassSize::Canvas | PassSize::Sides(..) => {}
            PassSize::Scale(by) => {
                let mut value = by;
                let drag = DragValue::new(&mut value).speed(0.005).range(0.001..=64.0).max_decimals(4);
                number(&ui.add(drag), "scale", out);
                if value != by {
                    edit(out, PassEdit::Size(pass.id.clone(), PassSize::Scale(value)));
                }
            }
            PassSize::Fixed(width, height) => {
                let (mut w, mut h) = (width, height);
                number(&ui.add(DragValue::new(&mut w).range(1..=32_768).speed(1.0)), "width", out);
                ui.label("×");
                number(&ui.add(DragValue::new(&mut h).range(1..=32_768).speed(1.0)), "height", out);
                if (w, h) != (width, height) {
                    edit(out, PassEdit::Size(pass.id.clone(), PassSize::Fixed(w, h)));
                }
            }
        }
        if !matches!(now, PassSize::Fixed(..)) {
            let (width, height) = now.of(canvas);
            ui.colored_label(theme::of(ui).weak, format!("currently {width}×{height}"));
        }
    });
}

fn format(ui: &mut Ui, pass: &Pass, out: &mut UiOutput) {
    let now = pass.settings.format;
    ui.horizontal(|ui| {
        let combo = ComboBox::from_id_salt("format").width(104.0).selected_text(now.name()).show_ui(ui, |ui| {
            for format in TexelFormat::ALL {
                let label = format!("{}   {}", format.name(), meaning(format));
                let item = ui.selectable_label(format == now, label);
                if out.clicked(&format!("passes:format:{}", format.name()), &item) && format != now {
                    edit(out, PassEdit::Format(pass.id.clone(), format));
                }
            }
        });
        combo_box(&combo.response, "format", out);
        let bytes = now.bytes();
        let unit = if bytes == 1 { "byte" } else { "bytes" };
        ui.colored_label(theme::of(ui).weak, format!("{bytes} {unit} per texel"));
    });
    let more = pass.body.more_targets();
    if !more.is_empty() {
        ui.end_row();
        ui.label("");
        let names: Vec<&str> = more.iter().map(|f| f.name()).collect();
        ui.colored_label(theme::of(ui).weak, format!("more targets: {}", names.join(", ")));
    }
}

fn meaning(format: TexelFormat) -> &'static str {
    match format {
        TexelFormat::Rgba32f => "four floats, as on Shadertoy",
        TexelFormat::Rgba16f => "four half floats",
        TexelFormat::Rgba8 => "four from 0 to 1, 256 values",
        TexelFormat::Rg32f => "two floats",
        TexelFormat::Rg16f => "two half floats",
        TexelFormat::Rg8 => "two from 0 to 1, 256 values",
        TexelFormat::R32f => "one float",
        TexelFormat::R16f => "one half float",
        TexelFormat::R8 => "one from 0 to 1, 256 values",
    }
}

fn region(ui: &mut Ui, session: &Session, pass: &Pass, out: &mut UiOutput) {
    let now = pass.settings.region;
    ui.vertical(|ui| {
        let mut is_part = now.is_some();
        let check = ui.checkbox(&mut is_part, "draw only a region");
        if out.clicked("passes:region", &check) {
            let (width, height) = pass.settings.size.of(session.transport().resolution);
            edit(out, PassEdit::Region(pass.id.clone(), is_part.then_some(Region { x: 0, y: 0, width, height })));
        }
        check.on_hover_text("Texels outside the region keep their values");
        let Some(now) = now else { return };
        let mut next = now;
        ui.horizontal(|ui| {
            for (name, value, least) in [("x", &mut next.x, 0), ("y", &mut next.y, 0)]
                .into_iter()
                .chain([("width", &mut next.width, 1), ("height", &mut next.height, 1)])
            {
                let drag = DragValue::new(value).range(least..=u32::MAX).speed(1.0).prefix(format!("{} ", &name[..1]));
                let response = ui.add(drag);
                number(&response, &format!("region:{name}"), out);
                response.on_hover_text(format!("{name} in texels, from the bottom left"));
            }
        });
        if next != now {
            edit(out, PassEdit::Region(pass.id.clone(), Some(next)));
        }
    });
}

fn steps(ui: &mut Ui, project: &Project, pass: &Pass, out: &mut UiOutput) {
    let group = project.groups.iter().find(|g| g.passes.contains(&pass.id));
    let now = group.map_or(1, |g| g.steps);
    let buffers: Vec<&PassName> = project.passes.iter().map(|p| &p.id).take_while(|id| **id != pass.id).collect();
    ui.vertical(|ui| {
        ui.horizontal(|ui| {
            let mut value = now;
            number(&ui.add(DragValue::new(&mut value).range(1..=10_000).speed(0.1)), "steps", out);
            if value != now {
                edit(out, PassEdit::Steps(pass.id.clone(), value));
            }
            ui.label(if now == 1 { "time per frame" } else { "times per frame" });
        });
        if let Some(before) = buffers.last() {
            let is_joined = group.is_some_and(|g| g.passes.contains(before));
            let mut joined = is_joined;
            let check = ui.checkbox(&mut joined, format!("alternating with {}", before.title()));
            if out.clicked("passes:joined", &check) && joined != is_joined {
                edit(out, PassEdit::WithPrevious(pass.id.clone(), joined));
            }
            check.on_hover_text("Draw both once, in order, then repeat");
        }
    });
}

/// Shows the filter and the wrap of all channels that read a buffer.
fn samplers(ui: &mut Ui, project: &Project, id: &PassName, out: &mut UiOutput) {
    let channels = project.passes.iter().flat_map(|p| p.bindings.channels());
    let readers: Vec<_> = channels.filter(|c| c.input.target().is_some_and(|(of, _)| of == id)).collect();
    if readers.is_empty() {
        ui.colored_label(theme::of(ui).weak, "no channel reads it");
        return;
    }
    let filter = same(readers.iter().map(|c| c.sampler.filter));
    let wrap = same(readers.iter().map(|c| c.sampler.wrap));
    ui.horizontal(|ui| {
        let label = filter.map_or("mixed filters", filter_name);
        let combo = ComboBox::from_id_salt("filter").width(84.0).selected_text(label).show_ui(ui, |ui| {
            for one in [Filter::Nearest, Filter::Linear, Filter::Mipmap] {
                let item = ui.selectable_label(filter == Some(one), filter_name(one));
                if out.clicked(&format!("passes:filter:{}", filter_name(one)), &item) && filter != Some(one) {
                    edit(out, PassEdit::Filter(id.clone(), one));
                }
            }
        });
        combo_box(&combo.response, "filter", out);
        let label = wrap.map_or("mixed wraps", wrap_name);
        let combo = ComboBox::from_id_salt("wrap").width(84.0).selected_text(label).show_ui(ui, |ui| {
            for one in [Wrap::Clamp, Wrap::Repeat] {
                let item = ui.selectable_label(wrap == Some(one), wrap_name(one));
                if out.clicked(&format!("passes:wrap:{}", wrap_name(one)), &item) && wrap != Some(one) {
                    edit(out, PassEdit::Wrap(id.clone(), one));
                }
            }
        });
        combo_box(&combo.response, "wrap", out);
    });
}

/// Returns the common value of all.
fn same<T: PartialEq>(mut all: impl Iterator<Item = T>) -> Option<T> {
    let first = all.next()?;
    all.all(|one| one == first).then_some(first)
}

fn filter_name(filter: Filter) -> &'static str {
    match filter {
        Filter::Nearest => "nearest",
        Filter::Linear => "linear",
        Filter::Mipmap => "mipmap",
    }
}

fn wrap_name(wrap: Wrap) -> &'static str {
    match wrap {
        Wrap::Clamp => "clamp",
        Wrap::Repeat => "repeat",
    }
}
