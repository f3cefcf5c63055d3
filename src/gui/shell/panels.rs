//! Lays out the panels and shows their contents.

use super::Shell;
use crate::{
    gui::{
        actions::Action,
        panels::{Panel, PanelContext},
        problems, theme, toasts, top_bar,
        ui_output::{ShellCommand, UiOutput},
        viewport::ViewportMode,
    },
    project::Origin,
    session::{Session, ToolCommand, ViewCommand},
};
use egui::{CentralPanel, Frame, Id, Margin, Order, Rect, Ui, vec2};

impl Shell {
    pub(super) fn panels(&mut self, ui: &mut Ui, session: &Session, out: &mut UiOutput) {
        let p = theme::of(ui);
        let state = top_bar::State {
            is_gallery: self.modes.gallery,
            has_lab_results: self.lab.has_results(),
            open: self.dock.open_panels(),
            settings: self.config.settings(),
        };
        egui::Panel::top("top")
            .exact_size(38.0)
            .frame(Frame::NONE.fill(p.panel).inner_margin(Margin::symmetric(8, 0)))
            .show(ui, |ui| top_bar::show(ui, session, &state, out));
        if self.modes.gallery {
            self.watch_costs(false, out);
            let can_close = session.project().origin != Origin::Unsaved || session.is_dirty();
            toasts::panel(ui, session, ui.available_height() * 0.4, out);
            let frame = Frame::NONE.fill(p.background);
            CentralPanel::default().frame(frame).show(ui, |ui| {
                self.gallery.show(ui, session, &mut self.thumbnails, can_close, out);
            });
            return;
        }
        if let Some(tab) = self.lab.take_tab(session) {
            out.shell_commands.push(ShellCommand::GoTo(tab, Some((0, 0))));
        }
        if !self.dock.is_seen(Panel::Code) {
            let limit = ui.available_height() * 0.4;
            // The text is written in another editor: its errors are listed here.
            let problems = if problems::has_errors(session) {
                let room = limit - problems::STATE - toasts::ROW;
                problems::panel(ui, session, None, room, out)
            } else {
                0.0
            };
            toasts::panel(ui, session, limit - problems, out);
        }
        let under_picture = if self.dock.is_seen(Panel::Picture) { self.viewport.under() } else { None };
        let Self { viewport, code, lab, project_ui, recorder, config, thumbnails, live, wake, dock, .. } = self;
        let settings = config.settings();
        CentralPanel::default().frame(Frame::NONE.fill(p.panel)).show(ui, |ui| {
            let mut context = PanelContext {
                viewport,
                code,
                lab,
                recorder,
                project_ui,
                settings,
                under_picture,
                thumbnails,
                live,
                wake,
                session,
                out,
            };
            dock.show(ui, &mut context);
        });
        // Closing the panel ends the trace of the pixel.
        if session.trace().traced.is_some() && !self.dock.is_open(Panel::Trace) {
            out.ask(ToolCommand::Trace(None));
        }
        let sees_costs = self.dock.is_seen(Panel::Costs)
            | self.project_ui.buffers.wants_costs()
            | self.project_ui.measurements.take_costs_request();
        self.watch_costs(sees_costs, out);
    }

    /// Gathers costs only while they are visible.
    fn watch_costs(&mut self, is_seen: bool, out: &mut UiOutput) {
        if std::mem::replace(&mut self.sees_costs, is_seen) != is_seen {
            out.ask(ViewCommand::WatchCosts(is_seen));
        }
    }

    /// Shows the code over a picture that fills the window.
    pub(super) fn show_code_over_picture(&mut self, ui: &mut Ui, session: &Session, out: &mut UiOutput) {
        CentralPanel::default().frame(Frame::NONE).show(ui, |ui| {
            let whole = ui.max_rect();
            self.viewport.show(ui, session, ViewportMode::Window, out);
            // The rest belongs to the picture, with the mouse.
            let size = vec2((whole.width() * 0.56).clamp(320.0_f32.min(whole.width()), 1000.0), whole.height());
            let place = Rect::from_min_size(whole.min, size);
            egui::Area::new(Id::unique("code over picture"))
                .order(Order::Middle)
                .fixed_pos(place.min)
                .constrain(false)
                .show(ui.ctx(), |ui| {
                    theme::put_over_picture(ui);
                    ui.set_min_size(place.size());
                    ui.set_max_size(place.size());
                    ui.set_clip_rect(place);
                    self.code.show(ui, session, out);
                });
            leave_button(ui, whole, out);
        });
    }
}

/// Shows a button at the picture's corner that leaves code over picture; visible while the pointer moves there.
fn leave_button(ui: &Ui, whole: Rect, out: &mut UiOutput) {
    let corner = Rect::from_min_max(whole.right_top() + vec2(-260.0, 0.0), whole.right_top() + vec2(0.0, 120.0));
    if !ui.ctx().pointer_latest_pos().is_some_and(|at| corner.contains(at)) {
        return;
    }
    egui::Area::new(Id::unique("leave code over picture"))
        .order(Order::Foreground)
        .fixed_pos(whole.right_top() + vec2(-10.0, 10.0))
        .pivot(egui::Align2::RIGHT_TOP)
        .show(ui.ctx(), |ui| {
            theme::put_over_picture(ui);
            Frame::NONE.fill(theme::of(ui).panel).corner_radius(6).inner_margin(Margin::same(4)).show(ui, |ui| {
                let button = ui.button("Leave code over picture");
                let tip = out.keys.tip("Show all panels again", Action::Present);
                out.on_click("button:leave-present", &button.on_hover_text(tip), Action::Present);
            });
        });
}
