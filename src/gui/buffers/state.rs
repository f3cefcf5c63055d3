//! The state that the panel keeps from frame to frame.

use super::{
    numbers::COMPONENTS,
    zoom::{self, Zoom},
};
use crate::{
    debugger::nonfinite::drawn_passes,
    engine::TexelAt,
    project::{PassName, Project},
    session::{
        Command, Session, ViewCommand,
        buffers::{BufferLook, BufferRead, BufferWatch, Target},
    },
};
use egui::TextureHandle;
use std::sync::Arc;

/// The page that the panel shows.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Page {
    Texels,
    Graph,
}

/// The maximum number of runs of texels that are kept for flashing.
const RUNS: usize = 4096;

/// The window's copy of a target.
pub(super) struct ShownTarget {
    pub read: Arc<BufferRead>,
    pub generation: u64,
    pub texture: TextureHandle,
    /// Runs of texels that are NaN or infinite: the first column, the column after the last, and the row.
    pub runs: Vec<((u32, u32), u32)>,
}

/// The state of the panel.
pub(crate) struct Buffers {
    pub(super) page: Page,
    /// The selected target; `None`: the first one.
    chosen: Option<Target>,
    pub(super) look: BufferLook,
    pub(super) zoom: Zoom,
    /// The zoom of the graph.
    pub(super) sheet: Zoom,
    /// The size, in texels, of the sheet that was placed last.
    pub(super) sheet_of: (u32, u32),
    pub(super) seen: Option<ShownTarget>,
    /// The point below the pointer or the keyboard's cursor in this frame.
    pub(super) under: Option<[f32; 2]>,
    /// The texel of the selected target at that point.
    pub(super) texel: Option<(u32, u32)>,
    /// The size of a texel in points.
    pub(super) scale: Option<f32>,
    /// The numbers that are shown on that texel.
    pub(super) written: Vec<String>,
    /// A texel to bring into view, after a click outside the picture.
    pub(super) reveals: Option<(u32, u32)>,
    /// The panel was visible in this frame.
    is_shown: bool,
    /// Costs of passes are to be gathered.
    pub(super) wants_costs: bool,
    /// The last request to the session.
    sent: BufferWatch,
}

impl Default for Buffers {
    fn default() -> Self {
        Self {
            page: Page::Texels,
            chosen: None,
            look: BufferLook::default(),
            zoom: Zoom::up_to(zoom::OF_TEXELS),
            sheet: Zoom::up_to(zoom::OF_GRAPH),
            sheet_of: (0, 0),
            seen: None,
            under: None,
            texel: None,
            scale: None,
            written: Vec::new(),
            reveals: None,
            is_shown: false,
            wants_costs: false,
            sent: BufferWatch::default(),
        }
    }
}

impl Buffers {
    /// Returns every target of the project's passes, in drawing order.
    pub(super) fn targets(project: &Project) -> Vec<Target> {
        let count = |pass: &PassName| project.pass(pass).map_or(1, |p| p.layers().max(1));
        drawn_passes(project)
            .into_iter()
            .flat_map(|pass| (0..count(&pass)).map(move |index| (pass.clone(), index)))
            .collect()
    }

    /// Returns the selected target.
    pub(super) fn target(&self, project: &Project) -> Option<Target> {
        let all = Self::targets(project);
        let chosen = self.chosen.as_ref().filter(|chosen| all.contains(chosen));
        chosen.or(all.first()).cloned()
    }

    pub(super) fn choose(&mut self, target: Target) {
        self.chosen = Some(target);
        self.page = Page::Texels;
    }

    /// Selects the target `by` places after the selected one.
    pub(super) fn step(&mut self, project: &Project, by: i32) {
        let all = Self::targets(project);
        let Some(shown) = self.target(project) else { return };
        let at = all.iter().position(|target| *target == shown).unwrap_or(0) as i32;
        self.chosen = all.get((at + by).rem_euclid(all.len() as i32) as usize).cloned();
    }

    /// Starts a frame of the panel.
    pub(super) fn start_frame(&mut self) {
        (self.is_shown, self.wants_costs) = (true, false);
        (self.under, self.texel, self.scale) = (None, None, None);
        self.written.clear();
    }

    /// Forgets the texture, whose device is lost.
    pub(crate) fn forget_texture(&mut self) {
        self.seen = None;
    }

    /// Takes over the session's newest picture of the selected target.
    pub(super) fn update(&mut self, ctx: &egui::Context, session: &Session, target: &Target) {
        let Some((read, generation)) = session.buffer().filter(|(read, _)| read.target == *target) else {
            self.seen = None;
            return;
        };
        if self.seen.as_ref().is_some_and(|seen| seen.generation == generation) {
            return;
        }
        let picture = &read.picture;
        let size = [picture.width as usize, picture.height as usize];
        let image = egui::ColorImage::from_rgba_unmultiplied(size, &picture.bytes);
        // Nearest filtering when magnified; linear when several texels share a pixel.
        let options =
            egui::TextureOptions { magnification: egui::TextureFilter::Nearest, ..egui::TextureOptions::LINEAR };
        let runs = runs(read);
        match &mut self.seen {
            Some(seen) => {
                seen.texture.set(image, options);
                (seen.read, seen.generation, seen.runs) = (read.clone(), generation, runs);
            }
            None => {
                let texture = ctx.load_texture("buffer", image, options);
                self.seen = Some(ShownTarget { read: read.clone(), generation, texture, runs });
            }
        }
    }

    /// Returns whether costs of passes are visible.
    pub(crate) fn wants_costs(&self) -> bool {
        self.is_shown && self.wants_costs
    }

    /// Ends a frame of the window: targets that were not visible are no longer read back.
    pub(crate) fn end_frame(&mut self, session: &Session) -> Option<Command> {
        let shown = std::mem::take(&mut self.is_shown) && self.page == Page::Texels;
        let watch = match self.target(session.project()).filter(|_| shown) {
            Some(target) => BufferWatch { shown: Some((target, self.look)), under: self.under },
            None => BufferWatch::default(),
        };
        if !shown {
            self.seen = None;
        }
        if watch == self.sent {
            return None;
        }
        self.sent = watch.clone();
        Some(Command::View(ViewCommand::WatchBuffers(watch)))
    }
}

/// Returns the title of a target.
pub(super) fn title(project: &Project, (pass, index): &Target) -> String {
    match project.pass(pass).map(|p| p.layer_name(*index)).filter(|name| !name.is_empty()) {
        Some(name) => format!("{} · {name}", pass.title()),
        None => pass.title(),
    }
}

/// Returns the components of a texel in words.
pub(super) fn words(texel: &TexelAt, letters: usize) -> Vec<String> {
    let stored = usize::from(texel.components).clamp(1, 4);
    let one = |i: usize| format!("{} {}", COMPONENTS[i], super::numbers::fitted(texel.value[i], letters));
    (0..stored).map(one).collect()
}

fn runs(read: &BufferRead) -> Vec<((u32, u32), u32)> {
    let mut runs: Vec<((u32, u32), u32)> = Vec::new();
    if read.nonfinite.is_none() {
        return runs;
    }
    let (pixels, stored) = (&read.pixels, usize::from(read.components).min(4));
    for (at, texel) in pixels.texels.iter().enumerate() {
        if texel[..stored].iter().all(|x| x.is_finite()) {
            continue;
        }
        let (x, y) = (at as u32 % pixels.width, at as u32 / pixels.width);
        let count = runs.len();
        match runs.last_mut() {
            Some(((_, end), row)) if *row == y && *end == x => *end += 1,
            _ if count == RUNS => break,
            _ => runs.push(((x, x + 1), y)),
        }
    }
    runs
}
