//! A card: its picture, its name and its text. A preset's card has its whole description.

use crate::{
    gui::{
        accessible, theme,
        thumbnails::{Thumbnail, ThumbnailSource, Thumbnails},
        ui_output::UiOutput,
    },
    project::presets,
    session::FileCommand,
};
use egui::{Align2, Color32, FontId, Galley, Rect, Sense, Stroke, StrokeKind, Ui, pos2, text::LayoutJob, vec2};
use std::sync::{Arc, LazyLock};

/// The margin around the words.
const MARGIN: f32 = 12.0;
const TITLE: f32 = 22.0;

/// The contents of a preset's card.
#[derive(Debug)]
pub(super) struct Card {
    /// The preset's name.
    pub name: &'static str,
    title: String,
    about: String,
    /// The text that a search looks at, in lower case.
    words: String,
}

/// Reading them all takes milliseconds, too long for every frame.
static CARDS: LazyLock<Vec<Card>> = LazyLock::new(|| presets::names().iter().map(|name| Card::new(name)).collect());

pub(super) fn of(name: &str) -> Option<&'static Card> {
    CARDS.iter().find(|card| card.name == name)
}

/// Returns the height of a card with a text of this height.
pub(super) fn height(width: f32, text: f32) -> f32 {
    picture(width).y + 9.0 + TITLE + text + MARGIN
}

/// Returns the size of a card's picture, which is 16:9.
fn picture(width: f32) -> egui::Vec2 {
    vec2(width, (width * 9.0 / 16.0).round())
}

impl Card {
    fn new(name: &'static str) -> Card {
        let (title, info) = match presets::load(name) {
            Ok(loaded) => (loaded.project.name, loaded.project.info),
            Err(_) => (name.to_owned(), Default::default()),
        };
        let words = format!("{name} {title} {} {}", info.description, info.tags.join(" ")).to_lowercase();
        Card { name, title, about: info.description, words }
    }

    /// Returns whether the card contains all the words, given in lower case.
    pub(super) fn fits(&self, words: &[String]) -> bool {
        words.iter().all(|word| self.words.contains(word.as_str()))
    }

    /// Lays out the description for a card of this width.
    pub(super) fn text(&self, ui: &Ui, width: f32) -> Arc<Galley> {
        words(ui, &self.about, width)
    }

    /// Returns true while the pointer is on it.
    pub(super) fn show(
        &self,
        ui: &Ui,
        rect: Rect,
        text: Arc<Galley>,
        thumbnails: &mut Thumbnails,
        out: &mut UiOutput,
    ) -> bool {
        let response = ui.interact(rect, egui::Id::unique(("preset", self.name)), Sense::click());
        accessible::name(&response, egui::Role::Button, format!("{}: {}", self.title, self.about));
        if response.gained_focus() {
            response.scroll_to_me(None);
        }
        if ui.is_rect_visible(rect) {
            out.place(format!("preset:{}", self.name), rect.intersect(ui.clip_rect()));
        }
        if response.clicked() {
            out.ask(FileCommand::Open(self.name.to_owned()));
        }
        if !ui.is_rect_visible(rect) {
            return false;
        }
        let picture = match thumbnails.live(self.name) {
            Some(texture) => Thumbnail::Ready(texture),
            None => thumbnails.get(ThumbnailSource::Preset(self.name.to_owned())),
        };
        let place = paint(ui, rect, response.hovered() || response.has_focus(), &picture, &self.title, text);
        let trouble = match picture {
            Thumbnail::Ready(_) => {
                let state = if thumbnails.live(self.name).is_some() { "live" } else { "picture" };
                out.place(format!("{state}:{}", self.name), place);
                None
            }
            Thumbnail::Waiting => None,
            Thumbnail::Failed(why) => {
                let p = theme::of(ui);
                let font = FontId::proportional(12.0);
                ui.painter().text(place.center(), Align2::CENTER_CENTER, "No thumbnail", font, p.weak);
                Some(why)
            }
        };
        let response = response.on_hover_cursor(egui::CursorIcon::PointingHand);
        match trouble {
            Some(why) => response.on_hover_text(why).hovered(),
            None => response.hovered(),
        }
    }
}

/// Lays the words of a card out below its title.
pub(super) fn words(ui: &Ui, text: &str, width: f32) -> Arc<Galley> {
    let job = LayoutJob::simple(text.to_owned(), FontId::proportional(12.0), theme::of(ui).weak, width - 2.0 * MARGIN);
    ui.painter().layout_job(job)
}

/// Paints a card: its uncropped picture, its title and its text. Returns the place of the picture.
pub(super) fn paint(ui: &Ui, rect: Rect, is_hot: bool, picture: &Thumbnail, title: &str, text: Arc<Galley>) -> Rect {
    let p = theme::of(ui);
    let painter = ui.painter();
    painter.rect_filled(rect, 8.0, if is_hot { p.button } else { p.panel });
    let place = Rect::from_min_size(rect.min, self::picture(rect.width()));
    let top = egui::CornerRadius { nw: 8, ne: 8, sw: 0, se: 0 };
    painter.rect_filled(place, top, p.surround);
    if let Thumbnail::Ready(texture) = picture {
        let size = texture.size_vec2();
        let scale = (place.width() / size.x).min(place.height() / size.y);
        let within = Rect::from_center_size(place.center(), size * scale);
        let fills = within.width() > place.width() - 2.0;
        let image = egui::Image::new(texture).corner_radius(if fills { top } else { egui::CornerRadius::ZERO });
        image.paint_at(ui, if fills { place } else { within });
    }
    let border = if is_hot { Stroke::new(1.5, p.accent) } else { Stroke::new(1.0, p.line) };
    painter.rect_stroke(rect, 8.0, border, StrokeKind::Inside);
    let at = pos2(rect.left() + MARGIN, place.bottom() + 9.0);
    let mut job = LayoutJob::simple_singleline(title.to_owned(), FontId::proportional(14.5), p.strong);
    job.wrap = egui::text::TextWrapping::truncate_at_width(rect.width() - 2.0 * MARGIN);
    painter.galley(at, painter.layout_job(job), p.strong);
    painter.galley(at + vec2(0.0, TITLE), text, Color32::PLACEHOLDER);
    place
}
