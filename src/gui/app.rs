//! The event loop: the window system's events in, frames out, and sleep in between.
//!
//! Owns the window, the session and the moment of the next frame. A still window costs nothing: a frame is painted when
//! an event, the session or egui asks for one.

use super::{
    GuiError, Options,
    frame::{self, Frame},
    keys::{HeldKeys, KeyChange},
    report::Report,
    rescue,
    shell::Shell,
    shortcuts,
    surface::{Presented, Surface},
    theme,
};
use crate::{
    gpu::GpuError,
    session::{Command, Request, Session},
};
use serde_json::json;
use std::{
    sync::Arc,
    time::{Duration, Instant},
};
use winit::{
    application::ApplicationHandler,
    dpi::{LogicalSize, PhysicalSize},
    event::{StartCause, WindowEvent},
    event_loop::{ActiveEventLoop, ControlFlow, EventLoop, EventLoopProxy},
    window::{Fullscreen, Window, WindowId},
};

/// Sent to the event loop from other threads.
#[derive(Clone, Copy, Debug)]
pub struct Wake;

/// Opens the window and returns when it is closed.
pub fn run(options: Options) -> Result<(), GuiError> {
    let event_loop = EventLoop::<Wake>::with_user_event().build().map_err(no_display)?;
    let mut app = App { proxy: event_loop.create_proxy(), options, running: None, failed: None };
    event_loop.run_app(&mut app).map_err(no_display)?;
    app.failed.map_or(Ok(()), Err)
}

/// The window system's reason without the place in its own code that it begins with.
fn no_display(error: impl std::fmt::Display) -> GuiError {
    let text = error.to_string();
    let reason = match text.rsplit_once(".rs:") {
        Some((_, rest)) => rest.trim_start_matches(|c: char| c.is_ascii_digit() || c == ':').trim(),
        None => &text,
    };
    GuiError::NoDisplay(reason.trim_end_matches('.').to_owned())
}

struct App {
    proxy: EventLoopProxy<Wake>,
    options: Options,
    running: Option<Running>,
    failed: Option<GuiError>,
}

/// A window that is open.
struct Running {
    window: Arc<Window>,
    ctx: egui::Context,
    input: egui_winit::State,
    surface: Surface,
    session: Session,
    shell: Shell,
    held: HeldKeys,
    report: Report,
    /// When to paint next if nothing happens before.
    paint_at: Option<Instant>,
    painted_at: Instant,
    hidden: bool,
    title: String,
}

impl ApplicationHandler<Wake> for App {
    fn resumed(&mut self, event_loop: &ActiveEventLoop) {
        if self.running.is_some() {
            return;
        }
        match Running::new(event_loop, &self.proxy, &self.options) {
            Ok(running) => self.running = Some(running),
            Err(e) => {
                self.failed = Some(e);
                event_loop.exit();
            }
        }
    }

    fn user_event(&mut self, _: &ActiveEventLoop, _: Wake) {
        if let Some(running) = &mut self.running {
            running.paint_at = Some(Instant::now());
        }
    }

    fn new_events(&mut self, _: &ActiveEventLoop, cause: StartCause) {
        if let (Some(running), StartCause::ResumeTimeReached { .. }) = (&mut self.running, cause) {
            running.paint_at = Some(Instant::now());
        }
    }

    fn window_event(&mut self, event_loop: &ActiveEventLoop, _: WindowId, event: WindowEvent) {
        let Some(running) = &mut self.running else { return };
        match rescue::caught(running, |running| running.on_event(event), |running| &running.session) {
            Ok(Next::Go) => {}
            Ok(Next::Exit) => event_loop.exit(),
            Err(e) => {
                self.failed = Some(e);
                event_loop.exit();
            }
        }
    }

    fn about_to_wait(&mut self, event_loop: &ActiveEventLoop) {
        let Some(running) = &mut self.running else { return };
        let flow = match running.paint_at {
            // Nobody can see it; the window system tells when that changes.
            _ if running.hidden => ControlFlow::Wait,
            None => ControlFlow::Wait,
            Some(at) if at <= Instant::now() => {
                running.paint_at = None;
                running.window.request_redraw();
                ControlFlow::Wait
            }
            Some(at) => ControlFlow::WaitUntil(at),
        };
        event_loop.set_control_flow(flow);
    }
}

enum Next {
    Go,
    Exit,
}

impl Running {
    fn new(event_loop: &ActiveEventLoop, proxy: &EventLoopProxy<Wake>, options: &Options) -> Result<Running, GuiError> {
        let mut attributes = Window::default_attributes().with_title("Eddy").with_visible(false);
        attributes = match options.size {
            Some((width, height)) => attributes.with_inner_size(PhysicalSize::new(width, height)),
            None => attributes.with_inner_size(LogicalSize::new(1280.0, 760.0)),
        }
        .with_min_inner_size(LogicalSize::new(360.0, 240.0));
        let window = Arc::new(event_loop.create_window(attributes).map_err(no_display)?);
        let surface = Surface::new(&window, event_loop.owned_display_handle())?;
        let wake = {
            let proxy = proxy.clone();
            // The loop is gone when the window is: nobody is left to wake.
            Arc::new(move || {
                let _ = proxy.send_event(Wake);
            })
        };
        let ctx = egui::Context::default();
        theme::apply(&ctx);
        // Ctrl with plus and minus is the code's size, not the window's.
        ctx.options_mut(|o| o.zoom_with_keyboard = false);
        let input = egui_winit::State::new(
            ctx.clone(),
            egui::ViewportId::ROOT,
            &window,
            Some(window.scale_factor() as f32),
            window.theme(),
            Some(surface.gpu().device.limits().max_texture_dimension_2d as usize),
        );
        let mut session = Session::new(surface.gpu().clone(), wake.clone())?;
        let shell = Shell::new(surface.gpu().clone(), wake, options.project.is_none());
        let report = Report::new(options.json);
        if let Some(project) = &options.project {
            session.apply(Command::Open(project.clone()));
            options.set.iter().for_each(|s| session.apply(Command::AssignKnob(s.clone())));
        } else {
            // The gallery covers the picture.
            session.apply(Command::Pause);
        }
        report.say(json!({ "event": "started", "device": surface.gpu().describe(), "pid": std::process::id() }));
        window.set_visible(true);
        let now = Instant::now();
        Ok(Running {
            window,
            ctx,
            input,
            surface,
            session,
            shell,
            held: HeldKeys::default(),
            report,
            paint_at: Some(now),
            painted_at: now,
            hidden: false,
            title: String::new(),
        })
    }

    fn on_event(&mut self, event: WindowEvent) -> Result<Next, GuiError> {
        if event == WindowEvent::RedrawRequested {
            return self.frame();
        }
        let response = self.input.on_window_event(&self.window, &event);
        match &event {
            WindowEvent::CloseRequested => {
                self.session.apply(Command::Close);
                // A question must be seen to be answered.
                if self.hidden && self.session.question().is_some() {
                    self.window.set_minimized(false);
                    self.hidden = false;
                }
                self.paint_soon();
                return Ok(self.take_requests());
            }
            WindowEvent::Resized(size) => {
                self.surface.resize(size.width, size.height);
                self.hidden = size.width == 0 || size.height == 0;
            }
            WindowEvent::Occluded(hidden) => self.hidden = *hidden,
            WindowEvent::Focused(focused) => {
                if !focused {
                    self.held.clear();
                }
                self.session.apply(Command::Focus(*focused));
            }
            WindowEvent::KeyboardInput { event, is_synthetic, .. } => self.key(event, *is_synthetic),
            WindowEvent::Destroyed => return Ok(Next::Exit),
            _ => {}
        }
        if response.repaint || !matches!(event, WindowEvent::CursorMoved { .. } | WindowEvent::Moved(_)) {
            self.paint_soon();
        }
        Ok(Next::Go)
    }

    /// Passes a key on to the shader if the picture has the keyboard and the window has no use for it.
    fn key(&mut self, event: &winit::event::KeyEvent, is_synthetic: bool) {
        let ours = self.input.egui_input().events.iter().rev().find_map(|e| match e {
            egui::Event::Key { key, modifiers, pressed: true, .. } => {
                Some(shortcuts::action(*key, *modifiers).is_some())
            }
            _ => None,
        });
        let to_shader = self.shell.picture_has_keys(&self.ctx) && !is_synthetic && ours != Some(true);
        match self.held.change(event, to_shader) {
            Some(KeyChange::Down(code)) => self.session.apply(Command::KeyDown(code)),
            Some(KeyChange::Up(code)) => self.session.apply(Command::KeyUp(code)),
            None => {}
        }
    }

    fn paint_soon(&mut self) {
        let now = Instant::now();
        self.paint_at = Some(self.paint_at.map_or(now, |at| at.min(now)));
    }

    fn frame(&mut self) -> Result<Next, GuiError> {
        if self.hidden {
            return Ok(Next::Go);
        }
        let began = Instant::now();
        let raw = self.input.take_egui_input(&self.window);
        let renderer = self.surface.renderer();
        let Frame { output, tick, wants_next } =
            frame::run(&self.ctx, &mut self.shell, &mut self.session, renderer, raw, began);
        self.input.handle_platform_output(&self.window, output.platform_output.clone());
        let delay = output.viewport_output.values().map(|v| v.repaint_delay).min().unwrap_or(Duration::MAX);
        let presented = self.surface.paint(&self.window, output, &self.ctx);
        self.shell.report(
            &self.session,
            &mut self.report,
            self.surface.size(),
            self.window.scale_factor() as f32,
            began,
        );
        match self.surface.gpu().take_trouble("the window") {
            Ok(()) => {}
            Err(reason @ GpuError::Lost(_)) => {
                return Err(GuiError::Lost { reason, rescue: rescue::save_unsaved(&self.session) });
            }
            Err(refused) => self.session.tell_of(&refused),
        }
        self.follow_shell();
        if let Next::Exit = self.take_requests() {
            return Ok(Next::Exit);
        }
        let mut next = began.checked_add(delay);
        if wants_next || presented == Presented::Again {
            next = Some(began);
        }
        if let Some(at) = tick.wake_at {
            // The screen's own rhythm holds the loop back; where it does not (software drivers), this does.
            let interval = self.screen_interval();
            let early = self.painted_at + interval.mul_f64(0.75) > began;
            let at = if early { at.max(self.painted_at + interval) } else { at };
            next = Some(next.map_or(at, |n| n.min(at)));
        }
        self.paint_at = match (self.paint_at, next) {
            (Some(a), Some(b)) => Some(a.min(b)),
            (a, b) => a.or(b),
        };
        self.painted_at = began;
        Ok(Next::Go)
    }

    fn take_requests(&mut self) -> Next {
        while let Some(request) = self.session.take_request() {
            match request {
                Request::Exit => return Next::Exit,
                Request::SaveAs { suggested_name } => {
                    self.shell.ask_save_as(&suggested_name);
                    self.paint_soon();
                }
            }
        }
        Next::Go
    }

    fn screen_interval(&self) -> Duration {
        let millihertz = self.window.current_monitor().and_then(|m| m.refresh_rate_millihertz()).unwrap_or(60_000);
        Duration::from_secs_f64(1000.0 / f64::from(millihertz.clamp(24_000, 1_000_000)))
    }

    /// The window's own properties, as the shell and the session want them.
    fn follow_shell(&mut self) {
        let project = self.session.project();
        let title = format!("{}{} – Eddy", if self.session.is_dirty() { "● " } else { "" }, project.name);
        if title != self.title {
            self.window.set_title(&title);
            self.title = title;
        }
        let is_full = self.window.fullscreen().is_some();
        if is_full != self.shell.is_fullscreen() {
            self.window.set_fullscreen(self.shell.is_fullscreen().then_some(Fullscreen::Borderless(None)));
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_missing_display_is_told_in_plain_words() {
        let error = no_display("os error at /somewhere/linux/mod.rs:788: Failed to open connection to X server.");
        let text = error.to_string();
        assert!(text.starts_with("no display was found: Failed to open connection to X server. "), "{text}");
        assert!(text.contains("eddy render"));
    }
}
