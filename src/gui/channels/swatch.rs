//! The thumbnail of an input.

use super::{
    Live,
    device_rows::{self, DeviceThumbnail},
    sound,
};
use crate::{
    gui::{
        theme,
        thumbnails::{Thumbnail, ThumbnailSource, Thumbnails},
    },
    media::MediaKey,
    project::{Input, InputKind, Media, Origin},
    session::Session,
    texture::Dimension,
};
use egui::{FontId, Rect, Ui, vec2};
use std::path::PathBuf;

/// The minimum font size of a buffer's name, in points.
const SMALL: f32 = 9.0;

/// The sources of thumbnails.
pub(super) struct Swatches<'a> {
    pub session: &'a Session,
    pub thumbnails: &'a mut Thumbnails,
    pub live: &'a mut Live,
}

impl Swatches<'_> {
    /// Shows an input in a place: a texture as it is, a pass by its live thumbnail.
    pub(super) fn show(&mut self, ui: &Ui, place: Rect, input: &Input) {
        let device = device_rows::of(input).map_or(&DeviceThumbnail::None, |row| &row.thumbnail);
        let texture = match (input.target(), device) {
            (Some((pass, index)), _) => self.live.get(ui, self.session, pass, index),
            (None, DeviceThumbnail::Texture(texture)) => texture(self.live, ui, self.session),
            (None, _) => None,
        };
        if let Some((texture, aspect)) = texture {
            let shown = fitting(place, aspect);
            ui.painter().rect_filled(place, 3.0, theme::of(ui).surround);
            return egui::Image::new((texture.id(), shown.size())).corner_radius(3.0).paint_at(ui, shown);
        }
        let is_painted = match device {
            DeviceThumbnail::Painted(paint) => paint(ui, self.session, place),
            _ => sound::show(ui, self.session, place, input),
        };
        if !is_painted {
            swatch(ui, self.session, place, input, self.thumbnails);
        }
    }
}

/// Returns the largest rectangle of an aspect ratio in the middle of another.
fn fitting(place: Rect, aspect: f32) -> Rect {
    let width = place.width().min(place.height() * aspect);
    Rect::from_center_size(place.center(), vec2(width, width / aspect.max(0.01)))
}

fn swatch(ui: &Ui, session: &Session, place: Rect, input: &Input, thumbnails: &mut Thumbnails) {
    let painter = ui.painter();
    painter.rect_filled(place, 3.0, theme::of(ui).surround);
    let subject = subject(session, input);
    let letter = match (&subject, input) {
        (Some(subject), _) => match thumbnails.get(subject.clone()) {
            Thumbnail::Ready(texture) => {
                let size = texture.size_vec2();
                let shown = fitting(place, size.x / size.y.max(1.0));
                let is_wave = matches!(subject, ThumbnailSource::Sound(..));
                let tint = if is_wave { theme::of(ui).accent } else { egui::Color32::WHITE };
                return egui::Image::new(&texture).corner_radius(3.0).tint(tint).paint_at(ui, shown);
            }
            Thumbnail::Waiting => "…",
            Thumbnail::Failed(_) if matches!(input.media(), Some(Media::Site { .. })) => input.row().glyph,
            Thumbnail::Failed(_) => "!",
        },
        (None, input) => input.buffer_name().unwrap_or(input.row().glyph),
    };
    // A buffer's name may be long: the font is as large as fits, and at the minimum size the name is truncated.
    let layout = |size: f32| {
        let mut job = egui::text::LayoutJob::simple_singleline(
            letter.to_owned(),
            FontId::proportional(size),
            theme::of(ui).accent,
        );
        job.wrap =
            egui::text::TextWrapping::truncate_at_width(if size > SMALL { f32::INFINITY } else { place.width() });
        painter.layout_job(job)
    };
    let size = place.height() * 0.45;
    let whole = layout(size);
    let fitting = size * (place.width() - 4.0) / whole.size().x;
    let galley = if fitting < size { layout(fitting.max(SMALL)) } else { whole };
    painter.galley(place.center() - galley.size() / 2.0, galley, theme::of(ui).accent);
}

/// Returns the thumbnail's source for media; `None` for a file of Shadertoy without a substitute in Eddy.
fn subject(session: &Session, input: &Input) -> Option<ThumbnailSource> {
    let Input::Media { kind, media } = input else { return None };
    match kind {
        InputKind::Texture | InputKind::Cubemap | InputKind::Volume => {
            let dimension = input.row().dimension;
            let key = MediaKey { media: media.clone(), dimension, vflip: dimension == Dimension::D2 };
            Some(ThumbnailSource::Texture(key, folder(session)))
        }
        InputKind::Video => Some(ThumbnailSource::Video(media.clone(), folder(session))),
        InputKind::Music => Some(ThumbnailSource::Sound(media.clone(), folder(session))),
        _ => None,
    }
}

/// Returns the project's folder, to which paths of pictures are relative.
pub(super) fn folder(session: &Session) -> Option<PathBuf> {
    match &session.project().origin {
        Origin::Folder { path, .. } => Some(path.clone()),
        Origin::File(path) | Origin::Json(path) => path.parent().map(PathBuf::from),
        Origin::Unsaved | Origin::Preset(_) => None,
    }
}
