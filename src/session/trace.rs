//! Traces a pixel of the picture: from the click to the execution that led to its value, and to the first assignment
//! that differs on the device.
//!
//! The inputs of the pass are read after the frame, from textures that still have them, so that nothing is drawn again
//! and no simulation advances. The interpreter and the search run on threads of their own.

use super::{
    drawing::{Device, Tasks, Ticket},
    open_project::OpenProject,
    read_back::{Inspect, Inspected, TakeReplay},
    recent::KeptBreakpoint,
};
use eddy_background::{Background, Status, Wake};
use eddy_debugger::{
    divergence::{self, DivergenceFound, DivergenceJob},
    trace::Traced,
};
use eddy_engine::{CameraFrame, EngineError};
use eddy_playback::run::{Replay, ReplayFrom};
use eddy_project::{PassName, Project};
use std::{sync::Arc, thread::JoinHandle};

/// A pixel of a pass: its place in the picture, from 0 to 1 across and up.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct TracedPixel {
    pub pass: PassName,
    pub at: [f32; 2],
}

struct TraceJob {
    project: Project,
    at: [f32; 2],
    frame: i32,
    inspected: Inspected,
}

/// The state of a trace as a front end shows it.
#[derive(Clone, Copy, Debug, Default)]
pub struct TraceView<'s> {
    /// The newest result, even while another trace is running.
    pub traced: Option<&'s Arc<Traced>>,
    pub is_under_way: bool,
    /// The reason why there is none.
    pub trouble: Option<&'s str>,
}

pub(super) struct PixelTrace {
    walk: Background<TraceJob, (), Arc<Traced>>,
    /// The traced pixel; it is traced again whenever its picture changes.
    pixel: Option<TracedPixel>,
    input: Ticket<Result<Inspected, EngineError>>,
    pub divergence: Divergence,
    /// The debugger's breakpoints, which are kept until the project is opened again.
    pub breakpoints: Vec<KeptBreakpoint>,
}

impl PixelTrace {
    pub(crate) fn new(wake: Wake) -> Self {
        let work = |job: TraceJob, _: &_| {
            let TraceJob { project, at, frame, inspected: Inspected { pass, inputs, picture } } = job;
            Traced::new(project, &pass, frame, (inputs, &picture), at).map(Arc::new).map_err(|e| e.to_string())
        };
        let walk = Background::lazy("trace", "the CPU interpreter", wake.clone(), work);
        let divergence = Divergence::new(wake);
        Self { walk, pixel: None, input: Ticket::default(), divergence, breakpoints: Vec::new() }
    }

    /// Cancels the work, and returns its threads.
    pub(crate) fn close(self) -> [Option<JoinHandle<()>>; 2] {
        [self.walk.abandon(), self.divergence.background.abandon()]
    }

    /// Traces another pixel, or none.
    pub(crate) fn want(&mut self, pixel: Option<TracedPixel>) {
        if pixel.is_none() {
            self.divergence.clear();
        }
        match self.walk.result() {
            // The trace of the previous pixel stays until there is a new one.
            Some(Ok(_)) if pixel.is_some() => self.walk.cancel(),
            _ => self.walk.clear(),
        }
        if pixel.is_some() {
            self.walk.request();
        }
        (self.pixel, self.input) = (pixel, Ticket::default());
    }

    pub(crate) fn request_input(&mut self, tasks: &mut Tasks) {
        if let Some(pixel) = &self.pixel
            && self.walk.take_request()
        {
            self.input = tasks.add(Inspect(pixel.pass.clone()));
        }
    }

    /// Requests the input again: the device that was to deliver it is lost.
    pub(crate) fn renew_request(&mut self) {
        self.walk.renew_request();
        self.divergence.background.renew_request();
    }

    /// Takes finished results. Returns whether there is a new one.
    pub(crate) fn poll(&mut self) -> bool {
        self.walk.poll() | self.divergence.background.poll()
    }

    fn traced(&self) -> Option<&Arc<Traced>> {
        self.walk.result().and_then(|result| result.as_ref().ok())
    }
}

/// The search for the first difference from the device in a traced pixel.
pub(super) struct Divergence {
    background: Background<DivergenceJob, (), DivergenceFound>,
    of: Option<Arc<Traced>>,
    input: Ticket<Option<(Replay, Option<CameraFrame>)>>,
}

impl Divergence {
    fn new(wake: Wake) -> Self {
        let background = Background::lazy("divergence", "the search", wake, divergence::find);
        Self { background, of: None, input: Ticket::default() }
    }

    fn clear(&mut self) {
        self.background.clear();
        (self.of, self.input) = (None, Ticket::default());
    }

    pub(crate) fn request_input(&mut self, tasks: &mut Tasks) {
        if self.background.take_request() {
            self.input = tasks.add(TakeReplay(ReplayFrom::Newest));
        }
    }
}
impl OpenProject {
    /// The search for the first difference from the device in the traced pixel
    /// ([`ToolCommand::FindDivergence`](super::ToolCommand::FindDivergence)); `None` if it was not requested.
    pub(crate) fn divergence(&self) -> Option<Status<'_, (), DivergenceFound>> {
        let Divergence { background, of, .. } = &self.trace.divergence;
        of.as_ref().zip(self.trace.traced()).filter(|(of, traced)| Arc::ptr_eq(of, traced))?;
        background.status()
    }

    /// The trace of the chosen pixel ([`ToolCommand::Trace`](super::ToolCommand::Trace)).
    pub(crate) fn trace(&self) -> TraceView<'_> {
        TraceView {
            traced: self.trace.traced(),
            is_under_way: self.trace.walk.is_under_way(),
            trouble: self.trace.walk.result().and_then(|result| result.as_ref().err()).map(String::as_str),
        }
    }

    /// Starts that search.
    pub(super) fn want_divergence(&mut self) {
        let traced = self.trace.traced().cloned();
        let divergence = &mut self.trace.divergence;
        divergence.clear();
        if traced.is_some() {
            divergence.background.request();
        }
        divergence.of = traced;
    }

    /// Submits the inputs that the traced pass read; after another frame the pixel is traced again.
    pub(super) fn trace_pixel(&mut self, has_frame: bool) {
        let PixelTrace { walk, pixel: Some(pixel), input, .. } = &mut self.trace else { return };
        let Some(input) = input.take() else {
            if has_frame {
                walk.request();
            }
            return;
        };
        self.host.changed = true;
        match (input.output, self.engine.project().cloned()) {
            (Ok(inspected), Some(project)) => {
                let frame = self.playback.frame();
                walk.start(TraceJob { project, at: pixel.at, frame, inspected });
            }
            (Ok(_), None) => walk.cancel(),
            (Err(e), _) => walk.fail(e.to_string()),
        }
    }

    /// Submits the frames up to the traced one.
    pub(super) fn find_divergence(&mut self, device: &Device) {
        let Some(input) = self.trace.divergence.input.take() else { return };
        self.host.changed = true;
        let Divergence { background, of: Some(traced), .. } = &mut self.trace.divergence else { return };
        let Some((Replay { snapshot, frames }, camera)) = input.output else {
            return background.fail(
                "no earlier frames are kept at this resolution: reset, play and trace again; very large buffers are never \
                 kept",
            );
        };
        match device.wait() {
            Err(e) => background.fail(e.to_string()),
            Ok(gpu) => background.start(DivergenceJob {
                gpu,
                traced: traced.clone(),
                shown: self.picture.shown.clone(),
                size: self.engine.size(),
                media_dir: self.host.options.media_dir.clone(),
                snapshot,
                camera,
                frames: frames.into_iter().map(|frame| (frame.inputs, (*frame.values).clone())).collect(),
            }),
        }
    }
}
