//! The picture, and the mouse over it.

use super::{
    accessible, cost_map, error_map,
    geometry::{Area, Letterbox, Shape},
    halt, probe, theme,
    ui_output::{ShellCommand, UiOutput},
};
use crate::{
    project::Input,
    session::{CanvasCommand, FallbackPicture, InputCommand, Outcome, Session},
};
use egui::{Align2, Color32, EventFilter, FontId, Id, PointerButton, Pos2, Rect, Sense, TextureId, Ui, pos2, vec2};
use egui_wgpu::Renderer;

/// The margin around the picture, so that the focus frame does not cover it, in physical pixels.
const RIM: f32 = 3.0;

/// The part of the window that the picture fills.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum ViewportMode {
    /// A panel. Another one may have the keyboard focus.
    Panel,
    /// The whole window.
    Window,
}

#[derive(Default)]
pub(super) struct Viewport {
    texture: Option<TextureId>,
    /// The generation of the display in the texture, and whether it is magnified with nearest filtering.
    shows: (u64, bool),
    /// The number of pictures at the last painting.
    painted: u64,
    /// The texture has been created or bound again since.
    is_texture_new: bool,
    letterbox: Option<Letterbox>,
    asked_size: (u32, u32),
    mouse_is_down: bool,
    take_focus: bool,
    shape: Shape,
    /// The next click chooses the pixel to trace.
    picks: bool,
    /// The point of the picture below the mouse, from 0 to 1.
    under: Option<[f32; 2]>,
}

impl Viewport {
    /// The height of the picture's frame in points, with a reserve for coarse pixels.
    pub(super) const RIMS: f32 = 2.0 * RIM + 1.0;

    pub(super) fn new() -> Self {
        Self { shows: (0, true), ..Self::default() }
    }

    pub(super) fn id() -> Id {
        Id::unique("picture")
    }

    pub(super) fn shape(&self) -> Shape {
        self.shape
    }

    pub(super) fn set_shape(&mut self, shape: Shape) {
        self.shape = shape;
    }

    /// Toggles whether the next click chooses the pixel to trace.
    pub(super) fn pick(&mut self) {
        self.picks = !self.picks;
    }

    pub(super) fn stop_picking(&mut self) -> bool {
        std::mem::take(&mut self.picks)
    }

    /// Returns the point of the picture below the mouse, from 0 to 1 across and up.
    pub(super) fn under(&self) -> Option<[f32; 2]> {
        self.under
    }

    pub(super) fn mouse_is_down(&self) -> bool {
        self.mouse_is_down
    }

    /// Gives the picture the keyboard focus in the next frame.
    pub(super) fn focus(&mut self) {
        self.take_focus = true;
    }

    /// Forgets the texture, whose device is lost.
    pub(super) fn forget_texture(&mut self) {
        self.texture = None;
    }

    /// Registers the engine's current picture with egui.
    pub(super) fn prepare(&mut self, session: &Session, renderer: &mut Renderer) {
        let whole = self.letterbox.is_none_or(|l| l.shows_whole_texels());
        let shows = (session.display_generation(), whole);
        if self.texture.is_some() && shows == self.shows {
            return;
        }
        let filter = if whole { wgpu::FilterMode::Nearest } else { wgpu::FilterMode::Linear };
        let device = &session.gpu().device;
        match self.texture {
            None => self.texture = Some(renderer.register_native_texture(device, session.display(), filter)),
            Some(id) => renderer.update_egui_texture_from_wgpu_texture(device, session.display(), filter, id),
        }
        self.shows = shows;
        self.is_texture_new = true;
    }

    /// Returns the picture's texture if its texels have changed since the last painting.
    pub(super) fn take_new_texels(&mut self, session: &Session) -> Option<TextureId> {
        let shown = session.pictures_shown();
        let has_new_texels = std::mem::replace(&mut self.painted, shown) != shown;
        let is_new = std::mem::take(&mut self.is_texture_new) || has_new_texels;
        self.texture.filter(|_| is_new)
    }

    /// Fills the available space.
    pub(super) fn show(&mut self, ui: &mut Ui, session: &Session, mode: ViewportMode, out: &mut UiOutput) {
        let alone = mode == ViewportMode::Window;
        let rect = ui.available_rect_before_wrap();
        let scale = ui.pixels_per_point();
        let rim = if alone { 0.0 } else { RIM };
        ui.painter().rect_filled(rect, 0.0, theme::of(ui).surround);
        let min = (rect.min.to_vec2() * scale).round() + vec2(rim, rim);
        let max = (rect.max.to_vec2() * scale).round() - vec2(rim, rim);
        let area = Area { x: min.x, y: min.y, width: (max.x - min.x).max(0.0), height: (max.y - min.y).max(0.0) };
        // As on Shadertoy, where full screen fills the whole screen.
        let shape = if alone { Shape::Fill } else { self.shape };
        let size = shape.within(area.width as u32, area.height as u32);
        if size != self.asked_size && size.0 > 0 && size.1 > 0 {
            self.asked_size = size;
            out.ask(CanvasCommand::SetViewport { width: size.0, height: size.1 });
        }
        let letterbox = Letterbox::new(area, session.transport().resolution);
        let p = letterbox.picture;
        let picture = Rect::from_min_size(pos2(p.x, p.y) / scale, vec2(p.width, p.height) / scale);
        if let Some(texture) = self.texture {
            ui.painter().image(texture, picture, Rect::from_min_max(Pos2::ZERO, pos2(1.0, 1.0)), Color32::WHITE);
        }
        if self.letterbox.is_none_or(|l| l.shows_whole_texels() != letterbox.shows_whole_texels()) {
            ui.ctx().request_repaint();
        }
        self.letterbox = Some(letterbox);
        out.place("viewport", picture);

        let response = ui.interact(rect, Self::id(), Sense::click_and_drag());
        accessible::name(&response, egui::Role::Canvas, format!("Picture of {}", session.shown_pass().title()));
        out.home("picture", ui, Self::id());
        out.place("picture", rect);
        let reads_pointer = session.project().dialect.row().reads_pointer();
        self.mouse(ui, &response, (&letterbox, reads_pointer), out);
        cost_map::paint(ui, session, picture);
        error_map::paint(ui, session, picture);
        traced(ui, session, picture);
        let scale = ui.pixels_per_point();
        let pointer = ui.input(|i| i.pointer.latest_pos()).filter(|at| picture.contains(*at));
        self.under = pointer.map(|at| fraction(&letterbox, at * scale));
        if self.picks {
            if pointer.is_some() {
                ui.ctx().set_cursor_icon(egui::CursorIcon::Crosshair);
            }
            pill(ui, rect, Align2::LEFT_BOTTOM, "Click a pixel to trace it", theme::DARK.accent);
        }
        if std::mem::take(&mut self.take_focus) {
            response.request_focus();
        }
        if response.has_focus() {
            let all = EventFilter { tab: true, horizontal_arrows: true, vertical_arrows: true, escape: true };
            ui.memory_mut(|m| m.set_focus_lock_filter(Self::id(), all));
            if !alone {
                ui.painter().rect_stroke(rect, 0.0, theme::of(ui).focus(), egui::StrokeKind::Inside);
            }
        } else if reads_keyboard(session) {
            pill(ui, rect, Align2::RIGHT_TOP, "Click the picture to give it keyboard focus", theme::DARK.weak);
        }
        if let Some(Outcome::Failed { errors, meanwhile }) = session.compile_state().last {
            pill(ui, rect, Align2::LEFT_TOP, &trouble(errors, meanwhile), theme::DARK.error);
        }
        probe::show(ui, session, rect, self.under, out);
        error_map::show(ui, session, rect, out);
        cost_map::show(ui, session, rect, self.under, out);
        halt::show(ui, session, rect, out);
    }

    /// Sends mouse events in order: both a press and a release between two frames are sent.
    fn mouse(
        &mut self,
        ui: &Ui,
        response: &egui::Response,
        (letterbox, reads_pointer): (&Letterbox, bool),
        out: &mut UiOutput,
    ) {
        let scale = ui.pixels_per_point();
        // Points are pixels divided by the scale; rounding on the way back must not move to the neighbouring pixel.
        let pixels = |p: Pos2| ((p.x * scale * 256.0).round() / 256.0, (p.y * scale * 256.0).round() / 256.0);
        let on_top = |p: Pos2| ui.ctx().layer_id_at(p) == Some(response.layer_id);
        let events = ui.input(|i| i.events.clone());
        for event in events {
            match event {
                egui::Event::PointerButton { pos, button: PointerButton::Primary, pressed: true, modifiers } => {
                    let (x, y) = pixels(pos);
                    let is_pick = self.picks || (modifiers.command && modifiers.shift);
                    if is_pick && response.rect.contains(pos) && on_top(pos) {
                        if letterbox.contains(x, y) {
                            self.picks = false;
                            out.shell_commands.push(ShellCommand::Trace(fraction(letterbox, pos2(x, y))));
                        }
                        continue;
                    }
                    if response.rect.contains(pos) && on_top(pos) {
                        response.request_focus();
                        if letterbox.contains(x, y) {
                            self.mouse_is_down = true;
                            let (x, y) = letterbox.canvas_from_window(x, y);
                            out.ask(InputCommand::MouseDown { x, y });
                        }
                    }
                }
                egui::Event::PointerMoved(pos)
                    if self.mouse_is_down || reads_pointer && response.rect.contains(pos) && on_top(pos) =>
                {
                    let (x, y) = pixels(pos);
                    let (x, y) = letterbox.canvas_from_window(x, y);
                    out.ask(InputCommand::MouseMove { x, y });
                }
                egui::Event::PointerButton { button: PointerButton::Primary, pressed: false, .. }
                | egui::Event::WindowFocused(false)
                    if self.mouse_is_down =>
                {
                    self.mouse_is_down = false;
                    out.ask(InputCommand::MouseUp);
                }
                _ => {}
            }
        }
    }
}

/// Returns the point of the picture that a pixel of the window shows, from 0 to 1 across and up.
fn fraction(letterbox: &Letterbox, at: Pos2) -> [f32; 2] {
    let (x, y) = letterbox.canvas_from_window(at.x, at.y);
    [x / letterbox.canvas.0.max(1) as f32, y / letterbox.canvas.1.max(1) as f32]
}

/// Paints a ring around the pixel that is traced.
fn traced(ui: &Ui, session: &Session, picture: Rect) {
    let Some(traced) = session.trace().traced.filter(|traced| traced.pass == *session.shown_pass()) else { return };
    let part = |at: u32, of: u32| (at as f32 + 0.5) / of.max(1) as f32;
    let (x, y) = (part(traced.pixel.0, traced.size.0), part(traced.pixel.1, traced.size.1));
    let at = picture.left_bottom() + vec2(x * picture.width(), -y * picture.height());
    for (radius, color) in [(6.0, Color32::BLACK), (5.0, Color32::WHITE)] {
        ui.painter().with_clip_rect(picture).circle_stroke(at, radius, egui::Stroke::new(1.0, color));
    }
}

fn reads_keyboard(session: &Session) -> bool {
    session.project().passes.iter().flat_map(|p| p.bindings.channels()).any(|c| c.input == Input::KEYBOARD)
}

/// Shows a line of text over a corner of the picture, on black in either theme.
fn pill(ui: &Ui, rect: Rect, corner: Align2, text: &str, color: Color32) {
    let room = (rect.width() / 2.0 - 24.0).max(60.0);
    let mut job = egui::text::LayoutJob::simple_singleline(text.to_owned(), FontId::proportional(12.0), color);
    job.wrap = egui::text::TextWrapping::truncate_at_width(room);
    let galley = ui.painter().layout_job(job);
    let place = corner.align_size_within_rect(galley.size() + vec2(16.0, 8.0), rect.shrink(8.0));
    ui.painter().rect_filled(place, 5.0, Color32::from_black_alpha(190));
    ui.painter().galley(place.min + vec2(8.0, 4.0), galley, color);
}

/// Returns what is shown instead of the newest text's picture, and why.
fn trouble(errors: usize, meanwhile: FallbackPicture) -> String {
    let why = match errors {
        // The compiler or the device gave up, which a notice reports.
        0 => "Not compiled".to_owned(),
        1 => "1 error".to_owned(),
        n => format!("{n} errors"),
    };
    let what = match meanwhile {
        FallbackPicture::Nothing => "nothing to draw yet",
        FallbackPicture::LastGood => "showing the last working version",
        FallbackPicture::Newest => "drawn anyway",
    };
    format!("{why} – {what}")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn fallback_text_depends_on_the_picture_shown() {
        assert_eq!(trouble(5, FallbackPicture::Nothing), "5 errors – nothing to draw yet");
        assert_eq!(trouble(1, FallbackPicture::LastGood), "1 error – showing the last working version");
        assert_eq!(trouble(2, FallbackPicture::Newest), "2 errors – drawn anyway");
        assert_eq!(trouble(0, FallbackPicture::Nothing), "Not compiled – nothing to draw yet");
    }
}
