//! The event loop: takes the window system's events, paints frames, and sleeps in between.
//!
//! Owns the window, the session and the time of the next frame. An idle window costs nothing: a frame is painted only
//! when an event, the session or egui requests one.

use super::{
    GuiError, Opened, Options,
    app_event::AppEvent,
    clipboard,
    device_recovery::{self, DeviceLosses},
    fonts,
    frame::{self, Frame},
    hosts,
    keys::{HeldKeys, KeyChange},
    mapped::MapCheck,
    report::Report,
    settings::{Overrides, RestoredSizes, SettingsFile, WindowFile, WindowPlace, WindowState},
    shell::Shell,
    surface::{Presented, Surface},
    system_theme, termination, theme, window_opening,
};
use crate::{
    gpu::{ADAPTER_VARIABLE, AdapterChoice, Gpu, GpuError, HlslCompiler},
    playback::trial::TrialSettings,
    session::{
        self, CanvasCommand, EditCommand, FileCommand, HaltCommand, InputCommand, Level, NoticeCommand, Request,
        Session, SessionOptions,
    },
};
use egui_winit::accesskit_winit;
use serde_json::json;
use std::{
    sync::{Arc, mpsc::Receiver},
    time::{Duration, Instant},
};
use winit::{
    application::ApplicationHandler,
    event::{ElementState, StartCause, WindowEvent},
    event_loop::{ActiveEventLoop, ControlFlow, EventLoop, EventLoopProxy},
    keyboard::ModifiersState,
    window::{Fullscreen, Window, WindowId},
};

/// Opens the window, and returns when it is closed.
pub fn run(options: Options) -> Result<(), GuiError> {
    run_with(options, |_| ())
}

/// The same as [`run`]. Once the window is open, calls `opened` with its first graphics device.
pub fn run_with(options: Options, opened: impl FnOnce(&Gpu) + 'static) -> Result<(), GuiError> {
    let event_loop = EventLoop::<AppEvent>::with_user_event().build().map_err(window_opening::no_display)?;
    termination::watch(event_loop.create_proxy());
    let opened: Option<Opened> = Some(Box::new(opened));
    let mut app = App { proxy: event_loop.create_proxy(), options, opened, running: None, failed: None };
    event_loop.run_app(&mut app).map_err(window_opening::no_display)?;
    let has_lost_threads = app.running.as_mut().is_some_and(|running| running.session.end());
    // Dropping it would wait for the driver's threads.
    app.running = None;
    match app.failed {
        None if has_lost_threads => std::process::exit(0),
        None => Ok(()),
        Some(error) => Err(error),
    }
}

/// The time that the first frame of a new program may delay painting the window.
const FIRST_FRAME: Duration = Duration::from_millis(250);

/// The number of attempts in a row to present a frame that follow each other at once.
const QUICK_ATTEMPTS: u32 = 10;

struct App {
    proxy: EventLoopProxy<AppEvent>,
    options: Options,
    /// `None` after the call.
    opened: Option<Opened>,
    running: Option<Running>,
    failed: Option<GuiError>,
}

/// An open window.
struct Running {
    window: Arc<Window>,
    ctx: egui::Context,
    input: egui_winit::State,
    surface: Surface,
    losses: DeviceLosses,
    proxy: EventLoopProxy<AppEvent>,
    wake: Arc<dyn Fn() + Send + Sync>,
    session: Session,
    shell: Shell,
    held: HeldKeys,
    modifiers: ModifiersState,
    report: Report,
    /// The time of the next painting if nothing happens before.
    paint_at: Option<Instant>,
    painted_at: Instant,
    hidden: bool,
    map_check: MapCheck,
    /// The number of frames in a row that could not be presented.
    failed_frames: u32,
    title: String,
    /// The system's theme preference, if the window system does not report it.
    system_theme: Receiver<egui::Theme>,
    window_file: WindowFile,
    /// The window's size was set by the user and not by the command line.
    keeps_size: bool,
    /// Save which panels are open for the next start.
    keeps_panels: bool,
    restored_sizes: RestoredSizes,
}

impl ApplicationHandler<AppEvent> for App {
    fn resumed(&mut self, event_loop: &ActiveEventLoop) {
        // Systems that suspend a program take its surface back.
        if let Some(running) = &mut self.running {
            running.surface.recreate(&running.window);
            running.hide(false);
            running.paint_soon();
            return;
        }
        match Running::new(event_loop, &self.proxy, &self.options) {
            Ok(running) => {
                if let Some(opened) = self.opened.take() {
                    opened(running.surface.gpu());
                }
                self.running = Some(running);
            }
            Err(e) => {
                self.failed = Some(e);
                event_loop.exit();
            }
        }
    }

    fn suspended(&mut self, _: &ActiveEventLoop) {
        if let Some(running) = &mut self.running {
            running.hide(true);
        }
    }

    fn user_event(&mut self, event_loop: &ActiveEventLoop, event: AppEvent) {
        let Some(running) = &mut self.running else { return };
        match event {
            // The picture or something else is ready: paint at the screen's refresh rate.
            AppEvent::Wake => {
                let now = Instant::now();
                running.session.on_wake(now);
                running.paint_by(running.paced(running.after_first_frame(now)));
            }
            // Handle user input before the next frame of the picture.
            AppEvent::Painted if running.is_due() => {}
            AppEvent::Painted => running.session.painted(Instant::now()),
            AppEvent::Assistive(event) => running.assist(event.window_event),
            AppEvent::Terminate => {
                running.session.apply(FileCommand::Terminate);
                if matches!(running.take_requests(), Next::Exit) {
                    event_loop.exit();
                }
            }
        }
    }

    fn new_events(&mut self, _: &ActiveEventLoop, cause: StartCause) {
        if let (Some(running), StartCause::ResumeTimeReached { .. }) = (&mut self.running, cause) {
            running.paint_at = Some(Instant::now());
            let is_shown = running.hidden && running.map_check.is_mapped_again(&running.window, Instant::now());
            running.hide(running.hidden && !is_shown);
        }
    }

    fn window_event(&mut self, event_loop: &ActiveEventLoop, _: WindowId, event: WindowEvent) {
        let Some(running) = &mut self.running else { return };
        match device_recovery::catch_panic(running, |running| running.on_event(event), |running| &running.session) {
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
            // The window is not visible; the window system reports when that changes.
            _ if running.hidden => running.map_check.next().map_or(ControlFlow::Wait, ControlFlow::WaitUntil),
            None => ControlFlow::Wait,
            Some(_) if running.is_due() => {
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

/// Opens the window's surface on the adapter of the command line, of the environment, or of the settings. A setting that
/// fits none does not keep the window from opening.
fn surface(
    event_loop: &ActiveEventLoop,
    window: &Arc<Window>,
    ordered: Option<&String>,
    settings: &SettingsFile,
    errors: &mut Vec<String>,
) -> Result<Surface, GuiError> {
    let open = |choice| Surface::new(window, event_loop.owned_display_handle(), choice);
    let ordered = ordered.cloned().or_else(|| std::env::var(ADAPTER_VARIABLE).ok());
    let is_set = ordered.is_none();
    match open(AdapterChoice::first_of([ordered, settings.settings().adapter.clone()])) {
        Err(GuiError::Gpu(why @ GpuError::NoSuchAdapter { .. })) if is_set => {
            errors.push(format!("{why}. Another one is used: change \"Graphics adapter\" in the settings"));
            open(AdapterChoice::default())
        }
        opened => opened,
    }
}

impl Running {
    fn new(
        event_loop: &ActiveEventLoop,
        proxy: &EventLoopProxy<AppEvent>,
        options: &Options,
    ) -> Result<Running, GuiError> {
        let state_dir = dirs::state_dir().or_else(dirs::data_local_dir).map(|dir| dir.join("eddy"));
        let mut window_file = WindowFile::new(state_dir.clone());
        let (window_state, mut errors) = window_file.read();
        let attributes = window_opening::attributes(event_loop, options, &window_state.place);
        let window = Arc::new(event_loop.create_window(attributes).map_err(window_opening::no_display)?);
        let mut settings = SettingsFile::new();
        errors.extend(settings.refresh());
        let surface = surface(event_loop, &window, options.adapter.as_ref(), &settings, &mut errors)?;
        let wake: Arc<dyn Fn() + Send + Sync> = {
            let proxy = proxy.clone();
            // Once the window is closed, so is the loop: a failed wake-up is harmless.
            Arc::new(move || {
                let _ = proxy.send_event(AppEvent::Wake);
            })
        };
        let ctx = egui::Context::default();
        theme::apply(&ctx);
        // Ctrl with plus and minus changes the size of code, not the window's zoom.
        ctx.options_mut(|o| o.zoom_with_keyboard = false);
        fonts::install_system(&ctx);
        let mut input = egui_winit::State::new(
            ctx.clone(),
            egui::ViewportId::ROOT,
            &window,
            Some(window.scale_factor() as f32),
            window.theme(),
            Some(surface.gpu().device.limits().max_texture_dimension_2d as usize),
        );
        // Must happen before the window is visible.
        input.init_accesskit(event_loop, &window, proxy.clone());
        let defaults = SessionOptions::default();
        let session_options = SessionOptions {
            draws_on_thread: true,
            frame_limit: options.frame_limit.unwrap_or(defaults.frame_limit),
            state_dir,
            cache_dir: dirs::cache_dir().map(|dir| dir.join("eddy")),
            recovery: session::recovery_folder(),
            trials: TrialSettings::of_this_program(options.compile_timeout),
            camera: options.webcam.clone().unwrap_or_else(|| defaults.camera.clone()),
            audio: hosts::audio(),
            midi: hosts::midi(),
            gamepads: hosts::gamepads(),
            ..defaults
        };
        let mut session = Session::with_options(surface.gpu().clone(), wake.clone(), session_options)?;
        let system_theme = system_theme::watch(wake.clone());
        let mut shell = Shell::new(surface.gpu().clone(), wake.clone(), options.project.is_none());
        let overrides = Overrides { frame_limit: options.frame_limit.is_some(), osc: options.osc };
        shell.restore(settings, &window_state, overrides);
        if options.follow {
            shell.show_picture_alone();
        }
        shell.apply_settings(&ctx).into_iter().for_each(|command| session.apply(command));
        for text in errors {
            session.apply(NoticeCommand::Notify { level: Level::Error, text, path: None });
        }
        if let Some(text) = surface.gpu().hlsl_compiler.as_ref().and_then(HlslCompiler::warning) {
            session.apply(NoticeCommand::Notify { level: Level::Warning, text: text.into(), path: None });
        }
        let report = Report::new(options.json);
        if let Some(project) = &options.project {
            session.apply(FileCommand::Open(project.clone()));
            if options.paused {
                session.apply(HaltCommand::Hold);
            }
            options.set.iter().for_each(|s| session.apply(EditCommand::AssignCustomUniform(s.clone())));
        } else {
            // The gallery covers the picture.
            session.apply(CanvasCommand::Cover(true));
        }
        report.say(json!({ "event": "started", "device": surface.gpu().describe(), "pid": std::process::id() }));
        window.set_visible(true);
        // On X11 the request goes to the window manager, which knows a window only once it is visible.
        if options.size.is_none() && window_state.place.is_maximized {
            window.set_maximized(true);
        }
        let now = Instant::now();
        Ok(Running {
            window,
            ctx,
            input,
            surface,
            losses: DeviceLosses::default(),
            proxy: proxy.clone(),
            wake,
            session,
            shell,
            held: HeldKeys::default(),
            modifiers: ModifiersState::default(),
            report,
            paint_at: Some(now),
            painted_at: now,
            hidden: false,
            map_check: MapCheck::default(),
            failed_frames: 0,
            title: String::new(),
            system_theme,
            window_file,
            keeps_size: options.size.is_none(),
            keeps_panels: !options.follow,
            restored_sizes: RestoredSizes::default(),
        })
    }

    fn on_event(&mut self, event: WindowEvent) -> Result<Next, GuiError> {
        if event == WindowEvent::RedrawRequested {
            return self.frame();
        }
        let response = self.input.on_window_event(&self.window, &event);
        match &event {
            WindowEvent::CloseRequested => {
                self.session.apply(FileCommand::Close);
                // A question needs a visible window.
                if self.hidden && self.session.question().is_some() {
                    self.window.set_minimized(false);
                    self.hide(false);
                }
                self.paint_soon();
                return Ok(self.take_requests());
            }
            WindowEvent::Resized(size) => {
                self.surface.resize(size.width, size.height);
                self.hide(size.width == 0 || size.height == 0);
                if !self.hidden && !self.window.is_maximized() && self.window.fullscreen().is_none() {
                    self.restored_sizes.note(self.place(false));
                }
            }
            WindowEvent::Occluded(hidden) => self.hide(*hidden),
            WindowEvent::Focused(focused) => {
                if !focused {
                    self.held.clear();
                    self.remember();
                }
                self.session.apply(InputCommand::Focus(*focused));
            }
            WindowEvent::KeyboardInput { event, is_synthetic, .. } => {
                self.key(event, *is_synthetic);
                if !self.shell.is_typing(&self.ctx) {
                    clipboard::paste_files(&mut self.input, event, self.modifiers);
                }
            }
            WindowEvent::ModifiersChanged(modifiers) => self.modifiers = modifiers.state(),
            WindowEvent::Destroyed => return Ok(Next::Exit),
            _ => {}
        }
        match &event {
            // The effect of a key release may wait until that of its press is shown.
            WindowEvent::KeyboardInput { event, .. } if event.state == ElementState::Released => {
                self.paint_by(self.after_first_frame(Instant::now()));
            }
            WindowEvent::CursorMoved { .. } | WindowEvent::Moved(_) if !response.repaint => {}
            _ => self.paint_soon(),
        }
        Ok(Next::Go)
    }

    /// The window is no longer visible, or visible again.
    fn hide(&mut self, is_hidden: bool) {
        if std::mem::replace(&mut self.hidden, is_hidden) != is_hidden {
            self.session.apply(CanvasCommand::Hide(is_hidden));
        }
    }

    /// Passes a key on to the shader if the picture has the keyboard focus and the window does not use the key.
    fn key(&mut self, event: &winit::event::KeyEvent, is_synthetic: bool) {
        let is_press = |e: &&egui::Event| matches!(e, egui::Event::Key { pressed: true, .. });
        let press = self.input.egui_input().events.iter().rev().find(is_press);
        let is_ours = press.is_some_and(|event| self.shell.is_action(&self.ctx, event));
        let to_shader = self.shell.picture_has_keys(&self.ctx) && !is_synthetic && !is_ours;
        match self.held.change(event, to_shader) {
            Some(KeyChange::Down(code)) => self.session.apply(InputCommand::KeyDown(code)),
            Some(KeyChange::Up(code)) => self.session.apply(InputCommand::KeyUp(code)),
            None => {}
        }
    }

    /// Answers assistive programs; the accessibility tree is built only while one requests it.
    fn assist(&mut self, event: accesskit_winit::WindowEvent) {
        match event {
            accesskit_winit::WindowEvent::InitialTreeRequested => self.ctx.enable_accesskit(),
            accesskit_winit::WindowEvent::ActionRequested(request) => self.input.on_accesskit_action_request(request),
            accesskit_winit::WindowEvent::AccessibilityDeactivated => self.ctx.disable_accesskit(),
        }
        self.paint_soon();
    }

    /// Returns whether the window is to be painted now.
    fn is_due(&self) -> bool {
        self.paint_at.is_some_and(|at| at <= Instant::now())
    }

    fn paint_soon(&mut self) {
        self.paint_by(Instant::now());
    }

    fn paint_by(&mut self, at: Instant) {
        self.paint_at = Some(self.paint_at.map_or(at, |earlier| earlier.min(at)));
    }

    /// Returns when to paint changes that can wait for the first frame of an edit. That frame wakes the loop: painting
    /// before it would delay it if one processor does both.
    fn after_first_frame(&self, at: Instant) -> Instant {
        if self.session.is_first_frame_coming() { at + FIRST_FRAME } else { at }
    }

    /// Returns when to paint what is ready at a given time. The screen's refresh rate limits the loop; if it does not
    /// (software drivers), this does.
    fn paced(&self, at: Instant) -> Instant {
        // Without vsync the picture is drawn as often as possible.
        if !self.shell.waits_for_screen() {
            return at;
        }
        let interval = self.screen_interval();
        let is_early = self.painted_at + interval.mul_f64(0.75) > at;
        if is_early { at.max(self.painted_at + interval) } else { at }
    }

    fn frame(&mut self) -> Result<Next, GuiError> {
        if self.hidden {
            return Ok(Next::Go);
        }
        let now = Instant::now();
        if let Some(theme) = self.system_theme.try_iter().last() {
            self.input.egui_input_mut().system_theme = Some(theme);
        }
        let raw = self.input.take_egui_input(&self.window);
        let renderer = self.surface.renderer();
        let Frame { output, tick, wants_next } =
            frame::run(&self.ctx, &mut self.shell, &mut self.session, renderer, raw, now);
        self.input.handle_platform_output(&self.window, output.platform_output.clone());
        if let Some(wanted) = self.shell.take_clipboard_request() {
            let text = clipboard::text(&mut self.input, wanted);
            self.input.egui_input_mut().events.push(egui::Event::Paste(text));
            self.paint_soon();
        }
        let delay = output.viewport_output.values().map(|v| v.repaint_delay).min().unwrap_or(Duration::MAX);
        if let Some(texture) = self.shell.take_new_texels(&self.session) {
            self.surface.touch(texture);
        }
        let presented = self.surface.paint(&self.window, output, &self.ctx);
        // Pending window events are handled before it.
        let _ = self.proxy.send_event(AppEvent::Painted);
        self.shell.report(&self.session, &mut self.report, self.surface.size(), &self.ctx, now);
        self.watch_device(now)?;
        self.follow_shell();
        if let Next::Exit = self.take_requests() {
            return Ok(Next::Exit);
        }
        // Repaints that egui requests by itself can wait.
        let mut next = now.checked_add(delay).map(|at| at.max(self.after_first_frame(now)));
        if wants_next {
            next = Some(now);
        }
        if let Some(at) = self.after_failure(presented, now) {
            next = Some(next.map_or(at, |next| next.min(at)));
        }
        if let Some(at) = tick.wake_at {
            let at = at.max(self.paced(now));
            next = Some(next.map_or(at, |n| n.min(at)));
        }
        self.paint_at = match (self.paint_at, next) {
            (Some(a), Some(b)) => Some(a.min(b)),
            (a, b) => a.or(b),
        };
        self.painted_at = now;
        if self.map_check.is_unmapped(&self.window, now) {
            self.hide(true);
        }
        Ok(Next::Go)
    }

    /// Returns when to paint again after a frame that could not be presented. The first attempts follow at once, as the
    /// window is being resized; a surface that is not there yet, as after a suspension, is awaited without haste.
    fn after_failure(&mut self, presented: Presented, now: Instant) -> Option<Instant> {
        if presented != Presented::Again {
            self.failed_frames = 0;
            return None;
        }
        self.failed_frames += 1;
        Some(if self.failed_frames > QUICK_ATTEMPTS { now + self.screen_interval() } else { now })
    }

    /// Recovers from the loss of the window's device.
    fn watch_device(&mut self, now: Instant) -> Result<(), GuiError> {
        let gpu = self.surface.gpu().clone();
        let Running { window, ctx, surface, shell, wake, .. } = self;
        self.losses.watch(&gpu, &mut self.session, now, |session| {
            surface.reopen_device(window, ctx)?;
            session.show_on(surface.gpu().clone())?;
            shell.on_new_device(surface.gpu().clone(), wake.clone());
            Ok(())
        })
    }

    fn take_requests(&mut self) -> Next {
        while let Some(request) = self.session.take_request() {
            match request {
                Request::Exit => {
                    self.remember();
                    return Next::Exit;
                }
                Request::SaveAs { suggested_name } => {
                    self.shell.ask_save_as(&suggested_name);
                    self.paint_soon();
                }
            }
        }
        Next::Go
    }

    /// Saves the window's place and layout for the next start.
    fn remember(&mut self) {
        let (window, dock) = (&self.window, self.shell.dock());
        let is_maximized = window.is_maximized();
        let known = self.window_file.known().place;
        // A maximised window restores the place that it had before.
        let is_restored = !is_maximized && window.fullscreen().is_none() && !self.hidden;
        let now = self.place(is_maximized);
        let place = match (self.keeps_size, is_restored) {
            (false, _) => known,
            (true, true) => now,
            (true, false) => {
                let previous = now.size.and_then(|size| self.restored_sizes.other_than(size));
                WindowPlace { is_maximized, ..previous.unwrap_or(known) }
            }
        };
        let (open, layout) = match self.keeps_panels {
            true => (Some(dock.open_panels().clone()), dock.arrangement()),
            false => (self.window_file.known().open.clone(), self.window_file.known().layout.clone()),
        };
        self.window_file.save_if_changed(WindowState { place, open, layout });
    }

    fn place(&self, is_maximized: bool) -> WindowPlace {
        let size = self.window.inner_size().to_logical::<f64>(self.window.scale_factor());
        let corner = self.window.outer_position().ok().map(|at| (at.x, at.y));
        WindowPlace { size: Some((size.width, size.height)), corner, is_maximized }
    }

    fn screen_interval(&self) -> Duration {
        let millihertz = self.window.current_monitor().and_then(|m| m.refresh_rate_millihertz()).unwrap_or(60_000);
        Duration::from_secs_f64(1000.0 / f64::from(millihertz.clamp(24_000, 1_000_000)))
    }

    /// Applies the window properties that the shell and the session request.
    fn follow_shell(&mut self) {
        let project = self.session.project();
        let title = format!("{}{} – Eddy", if self.session.is_dirty() { "● " } else { "" }, project.name);
        if title != self.title {
            self.window.set_title(&title);
            self.title = title;
        }
        self.surface.set_vsync(self.shell.waits_for_screen());
        let is_full = self.window.fullscreen().is_some();
        if is_full != self.shell.is_fullscreen() {
            self.window.set_fullscreen(self.shell.is_fullscreen().then_some(Fullscreen::Borderless(None)));
        }
    }
}
