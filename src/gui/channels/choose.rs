//! The popup of a channel's card, which chooses its input and sampler.

use super::{
    device_rows,
    names::{filter_name, input_name, wrap_name},
    swatch::{Swatches, folder},
};
use crate::{
    gui::{
        accessible, theme,
        thumbnails::FolderFile,
        ui_output::{Pick, ShellCommand, UiOutput},
    },
    media,
    project::{Channel, FileKind, Filter, Input, InputKind, InputSource, Media, PassName, Wrap},
    session::{Command, EditCommand, FileCommand},
};
use egui::{ComboBox, FontId, Rect, ScrollArea, Sense, Ui, pos2, vec2};
use std::time::Instant;

/// The popup of a card.
pub(super) fn choose(
    ui: &mut Ui,
    pass: &PassName,
    index: usize,
    channel: Option<&Channel>,
    swatches: &mut Swatches<'_>,
    out: &mut UiOutput,
) {
    let session = swatches.session;
    let set = |channel: Option<Channel>| Command::Edit(EditCommand::SetChannel { pass: pass.clone(), index, channel });
    let now = channel.map(|c| &c.input);
    ui.colored_label(theme::of(ui).weak, format!("iChannel{index} of {} reads", pass.title()));
    ui.horizontal_wrapped(|ui| {
        let none = ui.selectable_label(now.is_none(), "none");
        out.on_click("choose:none", &none, set(None));
        for other in &session.project().passes {
            let Some(name) = other.id.buffer_name() else { continue };
            for target in 0..other.formats().len() {
                let input = Input::Pass { id: other.id.clone(), target };
                let place = match target {
                    0 => format!("choose:buffer:{name}"),
                    _ => format!("choose:buffer:{name}:{target}"),
                };
                let item = ui.selectable_label(now == Some(&input), input_name(&input));
                if out.clicked(&place, &item) && now != Some(&input) {
                    out.ask(set(Some(Channel::new(input))));
                }
            }
        }
        let rows = InputKind::all().map(InputKind::row);
        for row in rows.filter(|row| row.source == InputSource::Device) {
            let input = Input::Device(row.kind);
            let item = ui.selectable_label(now == Some(&input), row.title);
            out.on_click(&format!("choose:{}", row.key), &item, set(Some(Channel::new(input))));
        }
        out.on_click(
            "choose:file",
            &ui.button("Image or video file…"),
            ShellCommand::Pick(Pick::Picture { channel: index }),
        );
        out.on_click("choose:sound", &ui.button("Music…"), ShellCommand::Pick(Pick::Sound { channel: index }));
    });
    if let Some(row) = now.and_then(device_rows::of) {
        (row.controls)(ui, session, out);
    }
    if let Some(channel) = channel {
        sampler(ui, channel, out, set);
    }
    ui.separator();
    ScrollArea::vertical().max_height(250.0).auto_shrink([false, true]).show(ui, |ui| {
        ui.spacing_mut().item_spacing = vec2(6.0, 6.0);
        files(ui, pass, index, now, swatches, out);
        for (kind, title) in BUILT_IN {
            ui.colored_label(theme::of(ui).weak, title);
            ui.horizontal_wrapped(|ui| {
                for name in media::builtin::names(kind.row().dimension) {
                    let input = Input::Media { kind, media: Media::Builtin(name.to_owned()) };
                    let (rect, response) = ui.allocate_exact_size(vec2(84.0, 82.0), Sense::click());
                    let chosen = now == Some(&input);
                    accessible::choice(&response, egui::Role::Button, chosen, name);
                    if ui.is_rect_visible(rect) {
                        texture_card(ui, rect, name, &input, chosen || response.hovered(), swatches);
                    }
                    if out.clicked(&format!("choose:{}:{name}", kind.row().key), &response) && !chosen {
                        out.ask(set(Some(Channel::new(input))));
                    }
                    response.on_hover_text(name);
                }
            });
        }
    });
}

/// Lists the files of the project's folder that a channel can read.
fn files(
    ui: &mut Ui,
    pass: &PassName,
    index: usize,
    now: Option<&Input>,
    swatches: &mut Swatches<'_>,
    out: &mut UiOutput,
) {
    let Some(folder) = folder(swatches.session) else { return };
    let files = swatches.thumbnails.files(&folder, Instant::now());
    if files.is_empty() {
        return;
    }
    ui.colored_label(theme::of(ui).weak, "Files of the project");
    ui.horizontal_wrapped(|ui| {
        for FolderFile { path, kind } in files.iter() {
            let kind = match kind {
                FileKind::Video => InputKind::Video,
                FileKind::Sound => InputKind::Music,
                _ => InputKind::Texture,
            };
            let media = Media::File(path.clone());
            // A file may be read as another kind than its extension suggests: an animated image is a video.
            let chosen = now.and_then(Input::media) == Some(&media);
            let input = match now {
                Some(now) if chosen => now.clone(),
                _ => Input::Media { kind, media },
            };
            let (name, shown) = (path.file_name().unwrap_or_default().to_string_lossy(), path.display().to_string());
            let (rect, response) = ui.allocate_exact_size(vec2(84.0, 82.0), Sense::click());
            accessible::choice(&response, egui::Role::Button, chosen, &shown);
            if ui.is_rect_visible(rect) {
                texture_card(ui, rect, &name, &input, chosen || response.hovered(), swatches);
            }
            if out.clicked(&format!("choose:file:{shown}"), &response) && !chosen {
                out.ask(FileCommand::Bring { paths: vec![folder.join(path)], to: Some((pass.clone(), Some(index))) });
            }
            response.on_hover_text(shown);
        }
    });
}

/// The kinds of input that have built-in files.
const BUILT_IN: [(InputKind, &str); 3] = [
    (InputKind::Texture, "Textures that come with Eddy"),
    (InputKind::Cubemap, "Cubemaps"),
    (InputKind::Volume, "Volumes"),
];

fn texture_card(ui: &Ui, rect: Rect, name: &str, input: &Input, hot: bool, swatches: &mut Swatches<'_>) {
    ui.painter().rect_filled(rect, 4.0, if hot { theme::of(ui).chosen } else { theme::of(ui).background });
    let place = Rect::from_center_size(pos2(rect.center().x, rect.top() + 34.0), vec2(60.0, 60.0));
    swatches.show(ui, place, input);
    let mut job =
        egui::text::LayoutJob::simple_singleline(name.to_owned(), FontId::proportional(10.5), theme::of(ui).text);
    job.wrap = egui::text::TextWrapping::truncate_at_width(rect.width() - 6.0);
    let galley = ui.painter().layout_job(job);
    let at = pos2(rect.center().x - galley.size().x / 2.0, rect.bottom() - 16.0);
    ui.painter().galley(at, galley, theme::of(ui).text);
}

/// Shows filter, wrap and flip, as far as the input has them.
fn sampler(ui: &mut Ui, channel: &Channel, out: &mut UiOutput, set: impl Fn(Option<Channel>) -> Command) {
    if channel.input.row().has_fixed_sampler {
        return;
    }
    let mut sampler = channel.sampler;
    ui.separator();
    ui.horizontal_wrapped(|ui| {
        let filter = ComboBox::from_id_salt("filter").width(78.0).selected_text(filter_name(sampler.filter));
        let filter = filter.show_ui(ui, |ui| {
            for filter in [Filter::Nearest, Filter::Linear, Filter::Mipmap] {
                ui.selectable_value(&mut sampler.filter, filter, filter_name(filter));
            }
        });
        accessible::name(&filter.response, egui::Role::ComboBox, "Filter");
        let wrap = ComboBox::from_id_salt("wrap").width(72.0).selected_text(wrap_name(sampler.wrap));
        let wrap = wrap.show_ui(ui, |ui| {
            for wrap in [Wrap::Clamp, Wrap::Repeat] {
                ui.selectable_value(&mut sampler.wrap, wrap, wrap_name(wrap));
            }
        });
        accessible::name(&wrap.response, egui::Role::ComboBox, "Wrap");
        if channel.input.row().has_vflip {
            ui.checkbox(&mut sampler.vflip, "flip").on_hover_text("Put the top row of the image at v = 1");
        }
    });
    if sampler != channel.sampler {
        out.ask(set(Some(Channel { sampler, ..channel.clone() })));
    }
}
