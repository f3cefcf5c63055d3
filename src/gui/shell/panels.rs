//! Lays out the panels and shows their contents.

use super::{Shell, of_project::OfProject};
use crate::{
    gui::{
        actions::Action,
        buffers,
        channels::{self, Live},
        code::CodePanel,
        compare, costs, custom_uniforms,
        dock::{Contents, Heights, Panel},
        lab::Lab,
        measures,
        recorder::{self, Recorder},
        sound, theme,
        thumbnails::Thumbnails,
        toasts, top_bar, trace, transport,
        ui_output::{ShellCommand, UiOutput},
        viewport::{Viewport, ViewportMode},
    },
    project::Origin,
    session::{FilmForm, Session, ToolCommand, ViewCommand},
};
use egui::{CentralPanel, Frame, Id, Margin, Order, Rect, Ui, vec2};

impl Shell {
    pub(super) fn panels(&mut self, ui: &mut Ui, session: &Session, out: &mut UiOutput) {
        let p = theme::of(ui);
        let state = top_bar::State {
            is_gallery: self.gallery,
            has_lab_results: self.lab.has_results(),
            open: self.dock.open_panels(),
            settings: self.settings.settings(),
        };
        egui::Panel::top("top")
            .exact_size(38.0)
            .frame(Frame::NONE.fill(p.panel).inner_margin(Margin::symmetric(8, 0)))
            .show(ui, |ui| top_bar::show(ui, session, &state, out));
        if self.gallery {
            self.watch_costs(false, out);
            let can_close = session.project().origin != Origin::Unsaved || session.is_dirty();
            toasts::panel(ui, session, out);
            let frame = Frame::NONE.fill(p.background);
            CentralPanel::default().frame(frame).show(ui, |ui| {
                self.page.show(ui, session, &mut self.thumbnails, can_close, out);
            });
            return;
        }
        if let Some(tab) = self.lab.take_tab(session) {
            out.shell_commands.push(ShellCommand::GoTo(tab, Some((0, 0))));
        }
        if !self.dock.is_seen(Panel::Code) {
            toasts::panel(ui, session, out);
        }
        let under_picture = if self.dock.is_seen(Panel::Picture) { self.viewport.under() } else { None };
        let Self { viewport, code, lab, kept, recorder, settings, thumbnails, live, dock, .. } = self;
        let choices = &settings.settings().recorder;
        CentralPanel::default().frame(Frame::NONE.fill(p.panel)).show(ui, |ui| {
            dock.show(
                ui,
                &mut PanelContents {
                    viewport,
                    code,
                    lab,
                    kept,
                    recorder,
                    choices,
                    thumbnails,
                    live,
                    under_picture,
                    session,
                    out,
                },
            );
        });
        // Closing the panel ends the trace of the pixel.
        if session.trace().traced.is_some() && !self.dock.is_open(Panel::Trace) {
            out.ask(ToolCommand::Trace(None));
        }
        let sees_costs = self.dock.is_seen(Panel::Costs)
            | self.kept.buffers.wants_costs()
            | self.kept.measurements.take_costs_wish();
        self.watch_costs(sees_costs, out);
    }

    /// Gathers costs only while they are visible.
    fn watch_costs(&mut self, is_seen: bool, out: &mut UiOutput) {
        if std::mem::replace(&mut self.sees_costs, is_seen) != is_seen {
            out.ask(ViewCommand::WatchCosts(is_seen));
        }
    }

    /// Shows the code over a picture that fills the window.
    pub(super) fn present(&mut self, ui: &mut Ui, session: &Session, out: &mut UiOutput) {
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
                if out.clicked("button:leave-present", &button.on_hover_text(tip)) {
                    out.act(Action::Present);
                }
            });
        });
}

/// The state that the panels need while they are shown.
struct PanelContents<'a> {
    viewport: &'a mut Viewport,
    code: &'a mut CodePanel,
    lab: &'a mut Lab,
    kept: &'a mut OfProject,
    recorder: &'a mut Recorder,
    /// The recorder's last choices.
    choices: &'a FilmForm,
    /// The point of the picture under the pointer, in the newest frame.
    under_picture: Option<[f32; 2]>,
    thumbnails: &'a mut Thumbnails,
    live: &'a mut Live,
    session: &'a Session,
    out: &'a mut UiOutput,
}

impl Contents for PanelContents<'_> {
    fn show(&mut self, ui: &mut Ui, panel: Panel) -> bool {
        let Self { code, lab, kept, recorder, choices, thumbnails, live, under_picture, session, out, .. } = self;
        let margin = Margin { left: 8, right: 6, top: 2, bottom: 4 };
        match panel {
            Panel::Picture => return self.picture(ui),
            Panel::Code => return code.show(ui, session, out),
            Panel::Uniforms => within(ui, Margin::symmetric(10, 0), |ui| custom_uniforms::show(ui, session, out)),
            Panel::Channels => channels::show(ui, session, code.current(), thumbnails, live, out),
            Panel::Costs => within(ui, Margin { top: 0, ..margin }, |ui| costs::show(ui, session, out)),
            Panel::Trace => within(ui, margin, |ui| trace::show(&mut kept.debugger, ui, session, out)),
            Panel::Buffers => within(ui, margin, |ui| {
                let context = buffers::Context { live, under_picture: *under_picture };
                buffers::show(&mut kept.buffers, ui, session, context, out);
            }),
            Panel::Compare => within(ui, margin, |ui| compare::show(&mut kept.compare, ui, session, out)),
            Panel::Measurements => within(ui, margin, |ui| measures::show(&mut kept.measurements, ui, session, out)),
            Panel::Sound => within(ui, margin, |ui| sound::show(&mut kept.sound, ui, session, out)),
            Panel::Recorder => within(ui, margin, |ui| recorder::show(recorder, ui, choices, session, out)),
            Panel::Lab => within(ui, Margin { left: 10, right: 8, top: 2, bottom: 6 }, |ui| lab.show(ui, out)),
        }
        false
    }

    fn tools(&mut self, ui: &mut Ui, panel: Panel) {
        match panel {
            Panel::Uniforms => custom_uniforms::tools(ui, self.session, self.out),
            Panel::Costs => costs::tools(ui, self.session, self.out),
            _ => {}
        }
    }

    fn title(&self, panel: Panel) -> String {
        match panel {
            Panel::Uniforms => match self.session.custom_uniforms().len() {
                0 => panel.title().to_owned(),
                n => format!("{} ({n})", panel.title()),
            },
            Panel::Channels => channels::title(self.session, self.code.current()),
            Panel::Costs => "Costs of a frame".to_owned(),
            _ => panel.title().to_owned(),
        }
    }

    fn heights(&self) -> Heights {
        Heights {
            transport: transport::HEIGHT + Viewport::RIMS,
            uniforms: custom_uniforms::height(self.session),
            channels: channels::HEIGHT,
        }
    }

    fn place(&mut self, name: String, rect: Rect) {
        self.out.place(name, rect);
    }
}

impl PanelContents<'_> {
    /// Shows the picture with its bar below it. Returns true if a drag of them starts.
    fn picture(&mut self, ui: &mut Ui) -> bool {
        let p = theme::of(ui);
        let bar = egui::Panel::bottom("transport")
            .exact_size(transport::HEIGHT)
            .frame(Frame::NONE.fill(p.panel).inner_margin(Margin::symmetric(8, 0)))
            .show_separator_line(false)
            .show(ui, |ui| transport::show(ui, self.session, self.viewport.shape(), self.out));
        CentralPanel::default()
            .frame(Frame::NONE)
            .show(ui, |ui| self.viewport.show(ui, self.session, ViewportMode::Panel, self.out));
        bar.inner
    }
}

fn within(ui: &mut Ui, margin: Margin, show: impl FnOnce(&mut Ui)) {
    Frame::NONE.inner_margin(margin).show(ui, |ui| {
        ui.set_min_size(ui.available_size());
        show(ui);
    });
}
