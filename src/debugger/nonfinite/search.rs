//! The search for the first NaN among the recent frames, which are drawn again in the background.

use super::texels::{NonfiniteTexels, drawn_passes, find_origin, stored_components};
use crate::trace::STEPS;
use eddy_background::{Control, Count};
use eddy_diag::Span;
use eddy_engine::{BuildOptions, CameraFrame, Engine, FrameInputs, Program, Snapshot};
use eddy_gpu::Gpu;
use eddy_media as media;
use eddy_project::TextLocation;
use eddy_project::{CustomUniformValues, PassName, Project};
use std::{path::PathBuf, sync::Arc};

/// The first texels that are not finite.
#[derive(Clone, Debug, PartialEq)]
pub struct FirstNonfinite {
    pub pass: PassName,
    pub frame: i32,
    /// The first from the bottom left, and the number of such texels of the pass in that frame.
    pub texel: (u32, u32),
    pub value: [f32; 4],
    pub texels: usize,
    /// They are older than the kept frames, of which this is the oldest.
    pub is_older: bool,
    /// The operation; `None` if the value can only come from the pass's format or from a texel that it reads.
    pub origin: Option<NonfiniteOperation>,
}

/// An operation whose result is not finite.
#[derive(Clone, Debug, PartialEq)]
pub struct NonfiniteOperation {
    pub message: &'static str,
    /// `None` for code that Eddy adds to the author's.
    pub place: Option<TextLocation>,
    /// The author's text there, its first line.
    pub text: String,
    /// The operands there, as in `pow(-0.5, 2)`.
    pub numbers: String,
}

/// The result of a search.
#[derive(Clone, Debug, PartialEq)]
pub enum SearchEnd {
    /// The first texel that is not finite.
    Found(Box<FirstNonfinite>),
    /// Every texel is finite in this range of frames.
    Nowhere { first: i32, last: i32 },
}

/// Frames, and what is needed to draw them.
pub struct SearchJob {
    pub gpu: Gpu,
    pub project: Project,
    pub shown: PassName,
    pub size: (u32, u32),
    pub media_dir: Option<PathBuf>,
    /// The targets before the first of the frames.
    pub snapshot: Arc<Snapshot>,
    /// The camera picture of the last frame. The earlier frames are drawn with it as well: their pictures are not kept.
    pub camera: Option<CameraFrame>,
    pub frames: Vec<(FrameInputs, CustomUniformValues)>,
}

/// Draws the frames again by a separate engine, and checks the texels of each. The progress counts frames.
pub fn search(job: SearchJob, control: &Control<Count>) -> Result<SearchEnd, String> {
    let SearchJob { gpu, project, shown, size, media_dir, snapshot, camera, frames } = job;
    let (mut media, _) = media::gather(&project, media_dir.as_deref());
    media.set_camera_picture(camera);
    let requested = project.image_and(&shown);
    let options = BuildOptions { requested, ..BuildOptions::default() };
    let built = Program::build(&gpu, &project, &media, &options).map_err(|e| e.to_string())?;
    let mut engine = Engine::new(gpu, size.0, size.1).map_err(|e| e.to_string())?;
    engine.set_program(built.program).map_err(|e| e.to_string())?;
    if !engine.restore(&snapshot) {
        return Err("the kept frames belong to another program: reset and search again".into());
    }
    let passes = drawn_passes(&project);
    let first = frames.first().map_or(0, |(inputs, _)| inputs.frame);
    if let Some(found) = first_nonfinite(&mut engine, &project, &passes, first - 1) {
        return Ok(SearchEnd::Found(Box::new(FirstNonfinite { is_older: true, ..found })));
    }
    for (index, (inputs, values)) in frames.iter().enumerate() {
        control.check()?;
        control.report(Count { done: index, of: frames.len() });
        engine.set_custom_uniforms(values);
        engine.draw(inputs).map_err(|e| e.to_string())?;
        if let Some(found) = first_nonfinite(&mut engine, &project, &passes, inputs.frame) {
            let read = engine.inspect(&found.pass).map_err(|e| e.to_string())?;
            let origin = find_origin(&project, &found.pass, &read, found.texel, STEPS).map_err(|e| e.to_string())?;
            let origin = origin.map(|finding| NonfiniteOperation {
                message: finding.kind.message(),
                place: finding.span.and_then(|span| TextLocation::new(span, &project.sources(), &project)),
                text: finding.span.map_or_else(String::new, |span| first_line(&project, span)),
                numbers: finding.numbers,
            });
            return Ok(SearchEnd::Found(Box::new(FirstNonfinite { origin, ..found })));
        }
    }
    let last = frames.last().map_or(0, |(inputs, _)| inputs.frame);
    Ok(SearchEnd::Nowhere { first, last })
}

/// Returns the first pass whose newest texels are not all finite.
fn first_nonfinite(engine: &mut Engine, project: &Project, passes: &[PassName], frame: i32) -> Option<FirstNonfinite> {
    passes.iter().find_map(|pass| {
        // A pass that no picture needs is not drawn, and has no texels.
        let pixels = engine.read(pass).ok()?;
        let NonfiniteTexels { first, count } = NonfiniteTexels::find(&pixels, stored_components(project, pass))?;
        let value = pixels.texels[(first.1 * pixels.width + first.0) as usize];
        let pass = pass.clone();
        Some(FirstNonfinite { pass, frame, texel: first, value, texels: count, is_older: false, origin: None })
    })
}

fn first_line(project: &Project, span: Span) -> String {
    let sources = project.sources();
    let text = sources.get(span.source).and_then(|source| source.text.get(span.range()));
    text.and_then(|text| text.lines().next()).unwrap_or_default().to_owned()
}
