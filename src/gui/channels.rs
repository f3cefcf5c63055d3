//! The strip under the editor: what each channel of the pass in front reads, and how.

use super::{
    outbox::{Outbox, Pick, Wish},
    theme,
    thumbnails::{Subject, Thumbnail, Thumbnails},
};
use crate::{
    media,
    project::{Channel, Filter, Input, Media, Origin, PassId, Sampler, Tab, Wrap},
    session::{Command, Session},
};
use egui::{
    Align2, Color32, ComboBox, FontId, Popup, PopupCloseBehavior, Rect, Response, ScrollArea, Sense, Stroke,
    StrokeKind, Ui, pos2, vec2,
};
use std::path::PathBuf;

/// Height of the strip: roomy, and where the window is low.
pub fn height(window: f32) -> f32 {
    if window > 520.0 { 76.0 } else { 38.0 }
}

pub fn show(ui: &mut Ui, session: &Session, tab: &Tab, thumbnails: &mut Thumbnails, out: &mut Outbox) {
    let rect = ui.available_rect_before_wrap();
    ui.painter().hline(rect.x_range(), rect.top() + 0.5, Stroke::new(1.0, theme::LINE));
    let pass = match tab {
        Tab::Pass(id) | Tab::Stage(id, _) => session.project().pass(id),
        Tab::Common => None,
    };
    let Some(pass) = pass else {
        let text = "Common is put before every pass; channels belong to the passes";
        let painter = ui.painter().with_clip_rect(rect);
        painter.text(rect.center(), Align2::CENTER_CENTER, text, FontId::proportional(12.0), theme::WEAK);
        return;
    };
    let inner = rect.shrink2(vec2(8.0, 6.0));
    let gap = 6.0;
    let width = (inner.width() - 3.0 * gap) / 4.0;
    for (index, channel) in pass.channels.iter().enumerate() {
        let left = inner.left() + index as f32 * (width + gap);
        let card = Rect::from_min_size(pos2(left, inner.top()), vec2(width, inner.height()));
        let response = show_card(ui, session, card, index, channel.as_ref(), thumbnails);
        out.place(format!("channel:{index}"), card);
        Popup::from_toggle_button_response(&response)
            .close_behavior(PopupCloseBehavior::CloseOnClickOutside)
            .width(300.0)
            .show(|ui| choose(ui, session, &pass.id, index, channel.as_ref(), thumbnails, out));
    }
}

fn show_card(
    ui: &Ui,
    session: &Session,
    card: Rect,
    index: usize,
    channel: Option<&Channel>,
    thumbnails: &mut Thumbnails,
) -> Response {
    let response = ui.interact(card, ui.scope_id().with(("channel", index)), Sense::click());
    let painter = ui.painter().with_clip_rect(card);
    painter.rect_filled(card, 5.0, if response.hovered() { theme::BUTTON } else { theme::RAISED });
    let border = if response.hovered() { theme::ACCENT } else { theme::LINE };
    painter.rect_stroke(card, 5.0, Stroke::new(1.0, border), StrokeKind::Inside);
    let roomy = card.height() > 40.0;
    let side = card.height() - 10.0;
    let mut x = card.left() + 8.0;
    if let Some(channel) = channel.filter(|_| card.width() > side + 60.0) {
        let place = Rect::from_min_size(card.min + vec2(5.0, 5.0), vec2(side, side));
        swatch(ui, session, place, &channel.input, thumbnails);
        x = place.right() + 8.0;
    }
    let line = |y: f32, text: String, size: f32, color: Color32| {
        let mut job = egui::text::LayoutJob::simple_singleline(text, FontId::proportional(size), color);
        job.wrap = egui::text::TextWrapping::truncate_at_width((card.right() - x - 4.0).max(8.0));
        let galley = painter.layout_job(job);
        painter.galley(pos2(x, y - galley.size().y / 2.0), galley, color);
    };
    let name = channel.map_or_else(|| "none".to_owned(), |c| input_name(&c.input));
    let tint = if channel.is_some() { theme::TEXT } else { theme::WEAK };
    if roomy {
        line(card.top() + 14.0, format!("iChannel{index}"), 11.0, theme::WEAK);
        line(card.top() + 31.0, name.clone(), 12.5, tint);
        if let Some(channel) = channel {
            line(card.top() + 48.0, sampler_name(channel), 11.0, theme::WEAK);
        }
    } else {
        line(card.center().y, format!("{index}  {name}"), 12.0, tint);
    }
    let tip =
        format!("iChannel{index}: {name}{}", channel.map(|c| format!("\n{}", sampler_name(c))).unwrap_or_default());
    response.on_hover_text(tip).on_hover_cursor(egui::CursorIcon::PointingHand)
}

/// Points of the smallest letters of a buffer's name.
const SMALL: f32 = 9.0;

fn swatch(ui: &Ui, session: &Session, place: Rect, input: &Input, thumbnails: &mut Thumbnails) {
    let painter = ui.painter();
    painter.rect_filled(place, 3.0, theme::SURROUND);
    let letter = match input {
        Input::Texture(media) => match thumbnails.get(Subject::Texture(media.clone(), folder(session))) {
            Thumbnail::Ready(texture) => return egui::Image::new(&texture).corner_radius(3.0).paint_at(ui, place),
            Thumbnail::Waiting => "…",
            Thumbnail::Failed(_) => "!",
        },
        Input::Buffer(name) | Input::Target { buffer: name, .. } => name.as_str(),
        Input::Keyboard => "K",
        Input::CubemapPass | Input::Cubemap(_) => "C",
        Input::Volume(_) => "V",
        Input::Video(_) | Input::Webcam => "film",
        Input::Music(_) | Input::Microphone => "snd",
    };
    // A buffer's name may be long: as large as fits, and what does not fit even small is cut.
    let layout = |size: f32| {
        let mut job =
            egui::text::LayoutJob::simple_singleline(letter.to_owned(), FontId::proportional(size), theme::ACCENT);
        job.wrap =
            egui::text::TextWrapping::truncate_at_width(if size > SMALL { f32::INFINITY } else { place.width() });
        painter.layout_job(job)
    };
    let size = place.height() * 0.45;
    let whole = layout(size);
    let fitting = size * (place.width() - 4.0) / whole.size().x;
    let galley = if fitting < size { layout(fitting.max(SMALL)) } else { whole };
    painter.galley(place.center() - galley.size() / 2.0, galley, theme::ACCENT);
}

/// The project's folder, which pictures' paths are relative to.
fn folder(session: &Session) -> Option<PathBuf> {
    match &session.project().origin {
        Origin::Folder { path, .. } => Some(path.clone()),
        Origin::File(path) | Origin::Json(path) => path.parent().map(PathBuf::from),
        Origin::Unsaved | Origin::Preset(_) => None,
    }
}

fn input_name(input: &Input) -> String {
    match input {
        Input::Buffer(name) => format!("Buffer {name}"),
        Input::Target { buffer, index } => format!("Buffer {buffer}, target {index}"),
        Input::CubemapPass => "Cube A".into(),
        Input::Keyboard => "Keyboard".into(),
        Input::Texture(m) => media_name(m),
        Input::Cubemap(m) => format!("cubemap {}", media_name(m)),
        Input::Volume(m) => format!("volume {}", media_name(m)),
        Input::Video(m) => format!("video {}", media_name(m)),
        Input::Music(m) => format!("music {}", media_name(m)),
        Input::Microphone => "microphone".into(),
        Input::Webcam => "webcam".into(),
    }
}

fn media_name(media: &Media) -> String {
    let last = |path: &str| path.rsplit('/').next().unwrap_or(path).to_owned();
    match media {
        Media::Builtin(name) => name.clone(),
        Media::File(path) | Media::Picked(path) => {
            path.file_name().map_or_else(|| path.display().to_string(), |n| n.to_string_lossy().into())
        }
        Media::Site { path, .. } => last(path),
    }
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

fn sampler_name(channel: &Channel) -> String {
    if channel.input == Input::Keyboard {
        return "nearest, clamp".into();
    }
    let s = channel.sampler;
    format!("{}, {}", filter_name(s.filter), wrap_name(s.wrap))
}

/// The popup of a card.
fn choose(
    ui: &mut Ui,
    session: &Session,
    pass: &PassId,
    index: usize,
    channel: Option<&Channel>,
    thumbnails: &mut Thumbnails,
    out: &mut Outbox,
) {
    let set = |out: &mut Outbox, channel: Option<Channel>| {
        out.ask(Command::SetChannel { pass: pass.clone(), index, channel });
    };
    let now = channel.map(|c| &c.input);
    ui.colored_label(theme::WEAK, format!("iChannel{index} of {} reads", pass.title()));
    ui.horizontal_wrapped(|ui| {
        let none = ui.selectable_label(now.is_none(), "none");
        if out.clicked("choose:none", &none) {
            set(out, None);
        }
        for other in &session.project().passes {
            let PassId::Buffer(name) = &other.id else { continue };
            for index in 0..other.settings.formats().len() {
                let (input, place) = match index {
                    0 => (Input::Buffer(name.clone()), format!("choose:buffer:{name}")),
                    _ => (Input::Target { buffer: name.clone(), index }, format!("choose:buffer:{name}:{index}")),
                };
                let item = ui.selectable_label(now == Some(&input), input_name(&input));
                if out.clicked(&place, &item) && now != Some(&input) {
                    set(out, Some(Channel { input, sampler: Sampler::BUFFER }));
                }
            }
        }
        let item = ui.selectable_label(now == Some(&Input::Keyboard), "Keyboard");
        if out.clicked("choose:keyboard", &item) {
            let sampler = Sampler { filter: Filter::Nearest, wrap: Wrap::Clamp, vflip: false };
            set(out, Some(Channel { input: Input::Keyboard, sampler }));
        }
        if out.clicked("choose:file", &ui.button("Picture…")) {
            out.wishes.push(Wish::Pick(Pick::Picture { channel: index }));
        }
    });
    if let Some(channel) = channel {
        sampler(ui, channel, out, set);
    }
    ui.separator();
    ui.colored_label(theme::WEAK, "Textures that come with Eddy");
    ScrollArea::vertical().max_height(210.0).auto_shrink([false, true]).show(ui, |ui| {
        ui.spacing_mut().item_spacing = vec2(6.0, 6.0);
        ui.horizontal_wrapped(|ui| {
            for name in media::builtin::names() {
                let input = Input::Texture(Media::Builtin(name.to_owned()));
                let (rect, response) = ui.allocate_exact_size(vec2(84.0, 82.0), Sense::click());
                let chosen = now == Some(&input);
                if ui.is_rect_visible(rect) {
                    texture_card(ui, session, rect, name, &input, chosen || response.hovered(), thumbnails);
                }
                if out.clicked(&format!("choose:texture:{name}"), &response) && !chosen {
                    set(out, Some(Channel { input, sampler: Sampler::TEXTURE }));
                }
                response.on_hover_text(name);
            }
        });
    });
}

fn texture_card(
    ui: &Ui,
    session: &Session,
    rect: Rect,
    name: &str,
    input: &Input,
    hot: bool,
    thumbnails: &mut Thumbnails,
) {
    ui.painter().rect_filled(rect, 4.0, if hot { theme::ACCENT_FILL } else { theme::BACKGROUND });
    let place = Rect::from_center_size(pos2(rect.center().x, rect.top() + 34.0), vec2(60.0, 60.0));
    swatch(ui, session, place, input, thumbnails);
    let mut job = egui::text::LayoutJob::simple_singleline(name.to_owned(), FontId::proportional(10.5), theme::TEXT);
    job.wrap = egui::text::TextWrapping::truncate_at_width(rect.width() - 6.0);
    let galley = ui.painter().layout_job(job);
    let at = pos2(rect.center().x - galley.size().x / 2.0, rect.bottom() - 16.0);
    ui.painter().galley(at, galley, theme::TEXT);
}

/// Filter, wrap and flip, as far as the input has them.
fn sampler(ui: &mut Ui, channel: &Channel, out: &mut Outbox, set: impl Fn(&mut Outbox, Option<Channel>)) {
    if matches!(channel.input, Input::Keyboard | Input::Music(_) | Input::Microphone) {
        return;
    }
    let mut sampler = channel.sampler;
    ui.separator();
    ui.horizontal_wrapped(|ui| {
        let filter = ComboBox::from_id_salt("filter").width(78.0).selected_text(filter_name(sampler.filter));
        filter.show_ui(ui, |ui| {
            for filter in [Filter::Nearest, Filter::Linear, Filter::Mipmap] {
                ui.selectable_value(&mut sampler.filter, filter, filter_name(filter));
            }
        });
        let wrap = ComboBox::from_id_salt("wrap").width(72.0).selected_text(wrap_name(sampler.wrap));
        wrap.show_ui(ui, |ui| {
            for wrap in [Wrap::Clamp, Wrap::Repeat] {
                ui.selectable_value(&mut sampler.wrap, wrap, wrap_name(wrap));
            }
        });
        if matches!(channel.input, Input::Texture(_) | Input::Cubemap(_) | Input::Video(_) | Input::Webcam) {
            ui.checkbox(&mut sampler.vflip, "flip").on_hover_text("The picture's top row lies at v = 1");
        }
    });
    if sampler != channel.sampler {
        set(out, Some(Channel { sampler, ..channel.clone() }));
    }
}
