//! The search for the first difference in a traced pixel: its frame is drawn again beside the picture.

use super::{
    assignment::assignments,
    probes::Probes,
    search::{DivergenceFound, search},
};
use crate::trace::{Extent, STEPS, Traced};
use eddy_background::Control;
use eddy_engine::{BuildOptions, Engine, FrameInputs, Program, Snapshot, Sources};
use eddy_gpu::Gpu;
use eddy_media as media;
use eddy_project::{CustomUniformValues, PassId};
use std::{path::PathBuf, sync::Arc};

/// Values of the device that are drawn at most: each is a program to compile.
pub const MOST: usize = 48;
/// Steps of the walk that are looked at: half a minute of a person's time is not enough for more.
pub const STEPS_KEPT: usize = 200_000;

/// A traced pixel, and the frames that lead to it.
pub struct DivergenceJob {
    pub gpu: Gpu,
    pub traced: Arc<Traced>,
    pub shown: PassId,
    pub size: (u32, u32),
    pub media_dir: Option<PathBuf>,
    /// The targets before the first of the frames.
    pub snapshot: Arc<Snapshot>,
    /// The last one is the traced one.
    pub frames: Vec<(FrameInputs, CustomUniformValues)>,
}

/// Draws the frame of a traced pixel again by an engine of its own, and finds the first assignment that differs there.
pub fn find(job: DivergenceJob, control: &Control<()>) -> Result<DivergenceFound, String> {
    let DivergenceJob { gpu, traced, shown, size, media_dir, snapshot, mut frames } = job;
    let (project, pass) = (&traced.project, &traced.pass);
    let Some((inputs, values)) = frames.pop().filter(|(inputs, _)| inputs.frame == traced.frame) else {
        return Err("the shown frame has changed: trace the pixel again".into());
    };
    let (media, _) = media::gather(project, media_dir.as_deref());
    let mut wanted = vec![PassId::Image];
    wanted.extend((shown != PassId::Image && project.pass(&shown).is_some()).then_some(shown));
    let options = BuildOptions { wanted, ..BuildOptions::default() };
    let built = Program::build(&gpu, project, &media, &options).map_err(|e| e.to_string())?;
    let mut engine = Engine::new(gpu, size.0, size.1).map_err(|e| e.to_string())?;
    engine.set_program(built.program).map_err(|e| e.to_string())?;
    if !engine.restore(&snapshot) {
        return Err("the kept frames belong to another program: draw a frame and trace the pixel again".into());
    }
    for (inputs, values) in &frames {
        control.check()?;
        engine.set_custom_uniforms(values);
        engine.draw(inputs).map_err(|e| e.to_string())?;
    }
    let trace = traced.trace(Extent { statements: STEPS, steps: STEPS_KEPT }).map_err(|e| e.to_string())?;
    let assignments = assignments(&Sources::new(project), traced.index(), &trace);
    let before = engine.snapshot().map_err(|e| e.to_string())?;
    let mut probes = Probes::new((engine, before), (project, &media), options, pass.clone(), (inputs, values));
    search(assignments, MOST, |assignment| probes.value(assignment, traced.pixel)).map_err(|e| e.to_string())
}
