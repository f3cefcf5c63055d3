//! The size of the picture: the requested size, and the size that the device accepts.

use super::{
    command::CanvasCommand,
    drawing::Change,
    open_project::OpenProject,
    view::{About, Level},
};
use eddy_engine::EngineError;

/// The size that the picture should have.
#[derive(Default)]
pub(super) struct Canvas {
    pub viewport: Option<(u32, u32)>,
    pub requested: CanvasSize,
    /// The size requested before any project was opened: each project starts with it.
    pub default_size: CanvasSize,
    /// The size of the recording that plays, or played until now.
    pub replayed: Option<(u32, u32)>,
    /// A size that the device did not accept; it is not retried.
    pub refused: Option<(u32, u32)>,
}

/// The size that the user has requested for the open project.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct CanvasSize {
    /// Ratio of canvas pixels to viewport pixels.
    pub scale: f32,
    pub fixed: Option<(u32, u32)>,
}

impl Default for CanvasSize {
    fn default() -> Self {
        Self { scale: 1.0, fixed: None }
    }
}

impl Canvas {
    /// The canvas of another project, of the size requested before any was opened.
    pub(crate) fn successor(&self) -> Self {
        Self {
            viewport: self.viewport,
            requested: self.default_size,
            default_size: self.default_size,
            ..Self::default()
        }
    }

    pub(crate) fn set_viewport(&mut self, size: (u32, u32)) {
        if self.viewport != Some(size) {
            (self.viewport, self.refused) = (Some(size), None);
        }
    }

    /// Makes both sides smaller.
    pub(crate) fn shrink(&mut self, factor: f64) {
        let side = |side: u32| ((f64::from(side) * factor) as u32).max(1);
        match &mut self.requested.fixed {
            Some((width, height)) => (*width, *height) = (side(*width), side(*height)),
            None => self.requested.scale *= factor as f32,
        }
    }

    /// Size in pixels, at least one each way; `None` before the viewport is known.
    fn size(&self) -> Option<(u32, u32)> {
        let scaled = |v: u32| ((f64::from(v) * f64::from(self.requested.scale)).floor() as u32).max(1);
        self.replayed.or(self.requested.fixed).or_else(|| self.viewport.map(|(w, h)| (scaled(w), scaled(h))))
    }
}

impl OpenProject {
    pub(super) fn apply_canvas(&mut self, command: CanvasCommand) {
        match command {
            // Minimised windows have no area; the picture keeps its size.
            CanvasCommand::SetViewport { width: 0, .. } | CanvasCommand::SetViewport { height: 0, .. } => {}
            CanvasCommand::SetViewport { width, height } => self.canvas.set_viewport((width, height)),
            CanvasCommand::SetScale(scale) => self.set_scale(scale),
            CanvasCommand::SetFixedSize(size) => {
                self.request_size(CanvasSize { fixed: size, ..self.canvas.requested });
            }
            // These are about the window.
            CanvasCommand::Cover(_) | CanvasCommand::Hide(_) => {}
        }
    }

    pub(super) fn set_scale(&mut self, scale: f32) {
        self.dismiss_notices(About::Scale);
        if scale.is_finite() && scale > 0.0 {
            self.request_size(CanvasSize { scale, ..self.canvas.requested });
        } else {
            self.notice_about(About::Scale, Level::Error, format!("the resolution scale must be above 0, not {scale}"));
        }
    }

    /// Sets the requested canvas size: of the open project, or if there is none, of each project to come.
    pub(super) fn request_size(&mut self, size: CanvasSize) {
        self.end_replay("the resolution was changed");
        self.canvas.replayed = None;
        self.canvas.requested = size;
        if self.host.serial == 0 {
            self.canvas.default_size = size;
        }
        self.canvas.refused = None;
    }

    /// Resizes the engine to the canvas size.
    pub(super) fn fit_canvas(&mut self) {
        let Some(size) = self.canvas.size() else { return };
        let is_new = size != self.engine.coming_size() && self.canvas.refused != Some(size);
        self.changes.set_if(is_new, Change::Resize(size));
        if !is_new && self.canvas.refused.is_none() {
            self.dismiss_notices(About::CanvasSize);
        }
    }

    /// The engine draws on a canvas of another size.
    pub(super) fn on_resized(&mut self) {
        self.dismiss_notices(About::CanvasSize);
        self.halt.reset_pace();
        self.host.changed = true;
    }

    /// Handles a canvas size that the device does not accept.
    pub(super) fn on_size_rejected(&mut self, size: (u32, u32), error: &EngineError) {
        self.canvas.refused = Some(size);
        let (width, height) = self.engine.size();
        let text = format!("{error}; the picture stays at {width}x{height}");
        self.notice_about(About::CanvasSize, Level::Error, text);
        self.canvas.replayed = None;
        self.end_replay("its resolution cannot be drawn on this GPU");
    }
}
