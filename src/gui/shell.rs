//! The window's contents: which panels there are, where, and what becomes of what they want.

use super::{
    channels,
    code::CodePanel,
    costs,
    files::{Files, Picked},
    gallery, help, knobs,
    lab::Lab,
    outbox::{Outbox, Pick, Wish},
    problems, questions,
    report::Report,
    shortcuts::{self, Action},
    theme,
    thumbnails::Thumbnails,
    toasts, top_bar, transport,
    viewport::Viewport,
};
use crate::{
    gpu::Gpu,
    project::{Channel, Input, Media, Origin, Sampler, Tab},
    session::{Command, Session},
};
use egui::{CentralPanel, Frame, Margin, Panel, Ui};
use egui_wgpu::Renderer;
use serde_json::{Value, json};
use std::{
    path::{Path, PathBuf},
    sync::Arc,
    time::Instant,
};

pub struct Shell {
    viewport: Viewport,
    code: CodePanel,
    files: Files,
    lab: Lab,
    /// The lab's panel is open; a run goes on without it.
    lab_open: bool,
    costs_open: bool,
    thumbnails: Thumbnails,
    gallery: bool,
    /// The picture ran when the gallery covered it, and goes on when it is uncovered.
    runs_behind_gallery: bool,
    help: bool,
    fullscreen: bool,
    /// Wanted by the frame before: done when the session has done what went with it.
    wishes: Vec<Wish>,
    places: Outbox,
    /// Notices and texts told of in the report.
    reported_notice: Option<u64>,
    reported_generation: Option<u64>,
}

impl Shell {
    /// `gallery`: begin on the page of presets.
    pub fn new(gpu: Gpu, wake: Arc<dyn Fn() + Send + Sync>, gallery: bool) -> Self {
        let mut viewport = Viewport::new();
        viewport.focus();
        Self {
            viewport,
            code: CodePanel::new(),
            files: Files::new(wake.clone()),
            lab: Lab::new(&gpu, wake.clone()),
            lab_open: false,
            costs_open: false,
            thumbnails: Thumbnails::new(gpu, wake),
            gallery,
            runs_behind_gallery: gallery,
            help: false,
            fullscreen: false,
            wishes: Vec::new(),
            places: Outbox::default(),
            reported_notice: None,
            reported_generation: None,
        }
    }

    pub fn is_fullscreen(&self) -> bool {
        self.fullscreen
    }

    /// The picture has the keyboard: keys are the shader's.
    pub fn picture_has_keys(&self, ctx: &egui::Context) -> bool {
        !self.gallery && ctx.memory(|m| m.has_focus(Viewport::id()))
    }

    pub fn ask_save_as(&mut self, name: &str) {
        self.files.ask(Pick::SaveAs(name.to_owned()), None);
    }

    /// Takes over what the session has new, before it is shown or painted.
    pub fn prepare(&mut self, session: &Session, renderer: &mut Renderer) {
        self.code.prepare(session);
        self.viewport.prepare(session, renderer);
    }

    /// Shows everything once. What the session is to do comes back.
    pub fn show(&mut self, ui: &mut Ui, session: &Session) -> Vec<Command> {
        self.thumbnails.update(ui.ctx());
        self.lab.update();
        let mut out = Outbox::default();
        out.wishes.append(&mut self.wishes);
        let asking = session.question().is_some();
        if !asking {
            self.keys(ui, &mut out);
            Files::dropped(ui, |at| self.channel_at(at), &mut out);
        }
        if self.fullscreen && !self.gallery {
            CentralPanel::default().frame(Frame::NONE).show(ui, |ui| self.viewport.show(ui, session, true, &mut out));
        } else {
            self.panels(ui, session, &mut out);
        }
        toasts::show(ui, session, Instant::now(), &mut out);
        questions::show(ui, session, &mut out);
        if self.help {
            self.help = help::show(ui, &mut out);
        }
        match self.files.show(ui, &mut out) {
            Some(Picked::Path(pick, path)) => out.wishes.push(Wish::Picked(pick, path)),
            Some(Picked::Cancelled(Pick::SaveAs(_))) => out.ask(Command::SaveAsCancelled),
            Some(Picked::Cancelled(_)) | None => {}
        }
        for wish in std::mem::take(&mut out.wishes) {
            self.grant(ui, session, wish, &mut out);
        }
        let commands = std::mem::take(&mut out.commands);
        self.places = out;
        commands
    }

    fn panels(&mut self, ui: &mut Ui, session: &Session, out: &mut Outbox) {
        let window = ui.max_rect();
        Panel::top("top")
            .exact_size(38.0)
            .frame(Frame::NONE.fill(theme::PANEL).inner_margin(Margin::symmetric(8, 0)))
            .show(ui, |ui| top_bar::show(ui, session, self.gallery, self.lab_open, out));
        if self.gallery {
            let can_close = session.project().origin != Origin::Unsaved || session.is_dirty();
            let frame = Frame::NONE.fill(theme::BACKGROUND);
            CentralPanel::default()
                .frame(frame)
                .show(ui, |ui| gallery::show(ui, session, &mut self.thumbnails, can_close, out));
            return;
        }
        Panel::bottom("transport")
            .exact_size(36.0)
            .frame(Frame::NONE.fill(theme::PANEL).inner_margin(Margin::symmetric(8, 0)))
            .show(ui, |ui| transport::show(ui, session, self.viewport.shape(), out));
        if let Some(tab) = self.lab.take_tab(session) {
            out.wishes.push(Wish::GoTo(tab, Some((0, 0))));
        }
        if self.lab_open {
            Panel::bottom("lab")
                .default_size(window.height() * 0.48)
                .size_range(150.0..=(window.height() - 180.0).max(150.0))
                .resizable(true)
                .frame(Frame::NONE.fill(theme::PANEL).inner_margin(Margin { left: 10, right: 8, top: 5, bottom: 6 }))
                .show(ui, |ui| self.lab.show(ui, out));
        }
        // A tall window has the code below the picture, where lines are long enough to read.
        let tall = window.height() > window.width() * 1.1;
        let side = if tall {
            Panel::bottom("code")
                .default_size(window.height() * 0.5)
                .size_range(160.0..=(window.height() - 180.0).max(160.0))
        } else {
            Panel::right("code")
                .default_size(window.width() * 0.5)
                .size_range(220.0..=(window.width() - 160.0).max(220.0))
        };
        side.resizable(true).frame(Frame::NONE.fill(theme::PANEL)).show(ui, |ui| {
            ui.spacing_mut().item_spacing.y = 0.0;
            // The lab takes its height from the code, and sliders and channels leave their share of it.
            let height = if self.lab_open { ui.available_height() } else { window.height() };
            Panel::bottom("channels")
                .exact_size(channels::height(height))
                .frame(Frame::NONE.fill(theme::PANEL))
                .show_separator_line(false)
                .show(ui, |ui| channels::show(ui, session, self.code.current(), &mut self.thumbnails, out));
            if let Some(height) = knobs::height(ui, session, height) {
                Panel::bottom("knobs")
                    .exact_size(height)
                    .frame(Frame::NONE.fill(theme::PANEL).inner_margin(Margin::symmetric(8, 0)))
                    .show_separator_line(false)
                    .show(ui, |ui| knobs::show(ui, session, out));
            }
            CentralPanel::default().frame(Frame::NONE).show(ui, |ui| self.code.show(ui, session, out));
        });
        CentralPanel::default().frame(Frame::NONE).show(ui, |ui| {
            if self.costs_open {
                let height = ui.available_height();
                Panel::bottom("costs")
                    .default_size((height * 0.42).min(260.0))
                    .size_range(84.0..=(height - 60.0).max(84.0))
                    .resizable(true)
                    .frame(Frame::NONE.fill(theme::PANEL).inner_margin(Margin { left: 8, right: 6, top: 2, bottom: 4 }))
                    .show(ui, |ui| costs::show(ui, session, out));
            }
            CentralPanel::default().frame(Frame::NONE).show(ui, |ui| self.viewport.show(ui, session, false, out));
        });
    }

    /// The window's own keys, taken before any widget sees them.
    fn keys(&self, ui: &Ui, out: &mut Outbox) {
        let code_has_keys = self.code.has_keys(ui.ctx());
        ui.input_mut(|i| {
            i.events.retain(|event| {
                let egui::Event::Key { key, modifiers, pressed: true, repeat, .. } = event else { return true };
                let Some(action) = shortcuts::action(*key, *modifiers) else { return true };
                // The code's own meaning of a key comes first while one types.
                if code_has_keys && shortcuts::is_of_editor(*key, *modifiers) {
                    return true;
                }
                let repeats = matches!(action, Action::Step | Action::FontLarger | Action::FontSmaller);
                if !repeat || repeats {
                    out.wishes.push(Wish::Act(action));
                }
                false
            });
        });
        if self.fullscreen && ui.input(|i| i.key_pressed(egui::Key::Escape)) {
            out.act(Action::Fullscreen);
        }
    }

    /// Returns where a named widget was shown last, in points.
    #[cfg(test)]
    pub fn place(&self, name: &str) -> Option<egui::Rect> {
        self.places.places.get(name).copied()
    }

    /// The tab in front, and the line of its caret from 0.
    #[cfg(test)]
    pub fn caret(&self) -> (Tab, usize) {
        self.code.caret()
    }

    /// Which channel's card a point is on.
    fn channel_at(&self, at: egui::Pos2) -> Option<usize> {
        (0..4).find(|i| self.places.places.get(&format!("channel:{i}")).is_some_and(|r| r.contains(at)))
    }

    fn grant(&mut self, ui: &Ui, session: &Session, wish: Wish, out: &mut Outbox) {
        match wish {
            Wish::Act(action) => self.act(ui, session, action, out),
            Wish::Shape(shape) => self.viewport.set_shape(shape),
            Wish::Pick(pick) => self.files.ask(pick, start_folder(session)),
            Wish::Picked(pick, path) => self.picked(pick, path, out),
            Wish::CloseGallery => self.close_gallery(out),
            Wish::GoTo(tab, place) => {
                if session.tabs().contains(&tab) {
                    let clicked = place.is_none();
                    self.code.go_to(tab, place);
                    if clicked {
                        self.code.focus();
                    }
                } else if !self.wishes.contains(&Wish::GoTo(tab.clone(), place))
                    && out.commands.contains(&Command::AddTab(tab.clone()))
                {
                    // The tab is being made; it is there in the next frame.
                    self.wishes.push(Wish::GoTo(tab, place));
                }
                ui.ctx().request_repaint();
            }
        }
    }

    fn close_gallery(&mut self, out: &mut Outbox) {
        if std::mem::take(&mut self.gallery) && std::mem::take(&mut self.runs_behind_gallery) {
            out.ask(Command::Play);
        }
        self.viewport.focus();
    }

    fn picked(&mut self, pick: Pick, path: PathBuf, out: &mut Outbox) {
        match pick {
            Pick::OpenFolder | Pick::OpenFile => {
                out.ask(Command::Open(path.display().to_string()));
                self.close_gallery(out);
            }
            Pick::SaveAs(_) => out.ask(Command::SaveAs(path)),
            Pick::LabFolder => self.lab.keep_in(path),
            Pick::LabReport => self.lab.save_report(path),
            Pick::Picture { channel } => {
                if let Tab::Pass(pass) = self.code.current() {
                    let media = Media::Picked(path);
                    let channel_ = Channel { input: Input::Texture(media), sampler: Sampler::TEXTURE };
                    out.ask(Command::SetChannel { pass: pass.clone(), index: channel, channel: Some(channel_) });
                }
            }
        }
    }

    fn act(&mut self, ui: &Ui, session: &Session, action: Action, out: &mut Outbox) {
        match action {
            Action::Compile => out.ask(Command::CompileNow),
            Action::Save => out.ask(Command::Save),
            Action::SaveAs => self.ask_save_as(&session.project().name),
            Action::Open => self.files.ask(Pick::OpenFile, start_folder(session)),
            Action::New => {
                out.ask(Command::New);
                self.close_gallery(out);
                self.code.focus();
            }
            Action::Gallery if self.gallery => self.close_gallery(out),
            Action::Gallery => {
                self.gallery = true;
                self.runs_behind_gallery = session.transport().playing;
                out.ask(Command::Pause);
            }
            Action::TogglePlay => out.ask(Command::TogglePlay),
            Action::Reset => out.ask(Command::Reset),
            Action::Step => out.ask(Command::Step),
            Action::TabLeft => self.code.go_aside(session, -1),
            Action::TabRight => self.code.go_aside(session, 1),
            Action::Screenshot => out.ask(Command::Screenshot),
            Action::SaveTexels => out.ask(Command::SaveTexels),
            Action::Fullscreen => {
                self.fullscreen = !self.fullscreen;
                self.viewport.focus();
            }
            Action::Lab => {
                self.lab_open = self.gallery || !self.lab_open;
                if self.gallery {
                    self.close_gallery(out);
                }
            }
            Action::Costs => {
                self.costs_open = !self.costs_open;
                out.ask(Command::WatchCosts(self.costs_open));
            }
            Action::Help => self.help = !self.help,
            Action::Find => self.code.open_find(),
            Action::GoToLine => self.code.open_go_to_line(),
            Action::NextProblem => self.code.go_to_next_problem(session),
            Action::FontLarger => self.code.scale_font(Some(1.0)),
            Action::FontSmaller => self.code.scale_font(Some(-1.0)),
            Action::FontReset => self.code.scale_font(None),
            Action::Quit => out.ask(Command::Close),
        }
        ui.ctx().request_repaint();
    }

    /// Tells scripts what is new.
    pub fn report(&mut self, session: &Session, report: &mut Report, window: (u32, u32), scale: f32, now: Instant) {
        if !report.is_enabled() {
            return;
        }
        let transport = session.transport();
        let generation = session.text_generation();
        let project = session.project();
        let opened = report.say_if_new("opened", json!({ "name": project.name, "origin": origin(&project.origin) }));
        if self.reported_generation.replace(generation).is_some_and(|g| g != generation) && !opened {
            report.say(json!({ "event": "reloaded", "name": project.name }));
        }
        report.say_if_new("compiled", compiled(session));
        let values: serde_json::Map<String, Value> =
            session.knobs().iter().map(|k| (k.name.clone(), json!(session.knob_value(k).components()))).collect();
        report.say_if_new("uniforms", json!({ "values": values }));
        report.say_if_new("shown", json!({ "pass": session.shown_pass().title() }));
        for notice in session.notices() {
            if self.reported_notice.is_none_or(|id| notice.id > id) {
                self.reported_notice = Some(notice.id);
                let level = format!("{:?}", notice.level).to_lowercase();
                report.say(json!({ "event": "notice", "level": level, "text": notice.text, "path": notice.path }));
            }
        }
        let question =
            session.question().map(|q| format!("{q:?}").split([' ', '(']).next().unwrap_or_default().to_lowercase());
        report.say_if_new("question", json!({ "kind": question }));
        let dirty: Vec<String> = session.tabs().iter().filter(|t| session.is_tab_dirty(t)).map(Tab::title).collect();
        report.say_if_new("dirty", json!({ "dirty": session.is_dirty(), "tabs": dirty }));
        if self.lab_open {
            report.say_if_new("lab", self.lab.report());
        }
        if self.costs_open {
            report.say_if_new("costs", costs::report(session));
        }
        report.layout(window, transport.resolution, scale, &self.places.areas(scale));
        let frame = json!({
            "frame": transport.frame,
            "time": transport.time_secs,
            "playing": transport.playing,
            "fps": transport.fps,
            "mouse_has_picture": self.viewport.mouse_is_down(),
        });
        report.frame(now, transport.playing, frame);
    }
}

/// How the newest finished compile ended, with every diagnostic.
fn compiled(session: &Session) -> Value {
    let state = session.compile_state();
    let diagnostics: Vec<Value> = session
        .diagnostics()
        .iter()
        .map(|d| {
            let place = d.place.as_ref();
            json!({
                "severity": d.severity.name(),
                "tab": d.tab().map(Tab::title),
                "file": place.filter(|place| place.tab.is_none()).map(|place| &place.text),
                "line": place.map_or(0, |place| place.line),
                "column": place.map_or(0, |place| place.column),
                "message": d.message,
            })
        })
        .collect();
    let ok = state.last.as_ref().map(|l| matches!(l, crate::session::Outcome::Ok { .. }));
    json!({ "ok": ok, "compiling": state.compiling, "state": problems::state(session).0, "diagnostics": diagnostics })
}

fn origin(origin: &Origin) -> Value {
    match origin {
        Origin::Unsaved => json!(null),
        Origin::Preset(name) => json!({ "preset": name }),
        Origin::Folder { path, .. } => json!({ "folder": path }),
        Origin::File(path) => json!({ "file": path }),
        Origin::Json(path) => json!({ "json": path }),
    }
}

/// Returns where a file dialog begins: beside the project.
fn start_folder(session: &Session) -> Option<PathBuf> {
    match &session.project().origin {
        Origin::Folder { path, .. } | Origin::File(path) | Origin::Json(path) => path.parent().map(Path::to_owned),
        Origin::Unsaved | Origin::Preset(_) => None,
    }
}
