//! The search for the first difference in a traced pixel: its frame is drawn again in the background, and assignments
//! are compared.

use super::{
    assignment::{Assignment, assignments},
    probes::Probes,
};
use crate::trace::{Extent, Number, STEPS, Traced, ulps};
use eddy_background::Control;
use eddy_engine::{BuildOptions, CameraFrame, Engine, FrameInputs, Program, Snapshot, Sources};
use eddy_gpu::Gpu;
use eddy_media as media;
use eddy_project::{CustomUniformValues, PassName};
use std::{path::PathBuf, sync::Arc};

/// An assignment with a different value on the device.
#[derive(Clone, Debug, PartialEq)]
pub struct Divergence {
    pub assignment: Assignment,
    /// The device's value; `None` if it does not reach the assignment that often.
    pub device: Option<Vec<f32>>,
    /// The distance in single-precision numbers; empty if the device does not reach the assignment.
    pub ulps: Vec<u32>,
}

/// The result of a search.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct DivergenceFound {
    pub first: Option<Divergence>,
    /// The number of compared assignments, out of `of`.
    pub compared: usize,
    pub of: usize,
}

/// Finds the first assignment at which the device diverges from the walker, with at most `most` values of the device.
/// `draw` returns such a value, or `None` if the assignment is not reached.
///
/// Bisects if there are more assignments than that: if one agrees, the search continues after it, otherwise before it.
/// The remainder of `most` is used for the earliest ones.
pub fn search<E>(
    assignments: Vec<Assignment>,
    max_probes: usize,
    mut draw: impl FnMut(&Assignment) -> Result<Option<[f32; 4]>, E>,
) -> Result<DivergenceFound, E> {
    let of = assignments.len();
    let mut compared: Vec<Option<Option<Divergence>>> = vec![None; of];
    let mut count = 0;
    let mut parts = |at: usize, count: &mut usize, compared: &mut Vec<Option<Option<Divergence>>>| {
        if compared[at].is_none() {
            *count += 1;
            compared[at] = Some(divergence(&assignments[at], draw(&assignments[at])?));
        }
        Ok(compared[at].as_ref().is_some_and(Option::is_some))
    };
    let mut end = of;
    if of > max_probes {
        let mut start = 0;
        while start < end && count < max_probes {
            let middle = start + (end - start) / 2;
            if parts(middle, &mut count, &mut compared)? { end = middle } else { start = middle + 1 }
        }
    }
    for at in 0..end {
        if count >= max_probes || parts(at, &mut count, &mut compared)? {
            break;
        }
    }
    let first = compared.into_iter().flatten().flatten().next();
    Ok(DivergenceFound { first, compared: count, of })
}

/// Returns the difference of an assignment, if there is one.
fn divergence(assignment: &Assignment, device: Option<[f32; 4]>) -> Option<Divergence> {
    let Some(device) = device else {
        return Some(Divergence { assignment: assignment.clone(), device: None, ulps: Vec::new() });
    };
    let walker = assignment.walker.iter().map(|number| match *number {
        Number::Float(value) => value,
        number => number.as_f64() as f32,
    });
    let ulps: Vec<u32> = walker.zip(device).map(|(walker, device)| ulps(walker, device)).collect();
    let device = Some(device[..ulps.len()].to_vec());
    ulps.iter().any(|ulps| *ulps > 0).then(|| Divergence { assignment: assignment.clone(), device, ulps })
}

/// The limit of the device's values: each is a program to compile.
pub const MAX_PROBES: usize = 48;
/// The limit of steps of the walk: about what fits into half a minute.
pub const MAX_STEPS: usize = 200_000;

/// A traced pixel, and the frames that lead to it.
pub struct DivergenceJob {
    pub gpu: Gpu,
    pub traced: Arc<Traced>,
    pub shown: PassName,
    pub size: (u32, u32),
    pub media_dir: Option<PathBuf>,
    /// The targets before the first of the frames.
    pub snapshot: Arc<Snapshot>,
    /// The camera picture of the last frame. The earlier frames are drawn with it as well: their pictures are not kept.
    pub camera: Option<CameraFrame>,
    /// The last one is the traced one.
    pub frames: Vec<(FrameInputs, CustomUniformValues)>,
}

/// Draws the frame of a traced pixel again by a separate engine, and finds the first assignment that differs there.
pub fn find(job: DivergenceJob, control: &Control<()>) -> Result<DivergenceFound, String> {
    let DivergenceJob { gpu, traced, shown, size, media_dir, snapshot, camera, mut frames } = job;
    let (project, pass) = (&traced.project, &traced.pass);
    let Some((inputs, values)) = frames.pop().filter(|(inputs, _)| inputs.frame == traced.frame) else {
        return Err("the shown frame has changed: trace the pixel again".into());
    };
    let (mut media, _) = media::gather(project, media_dir.as_deref());
    media.set_camera_picture(camera);
    let requested = project.image_and(&shown);
    let options = BuildOptions { requested, ..BuildOptions::default() };
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
    let trace = traced.trace(Extent { statements: STEPS, steps: MAX_STEPS }).map_err(|e| e.to_string())?;
    let assignments = assignments(&Sources::new(project), traced.index(), &trace);
    let before = engine.snapshot().map_err(|e| e.to_string())?;
    let mut probes = Probes::new((engine, before), (project, &media), options, pass.clone(), (inputs, values));
    search(assignments, MAX_PROBES, |assignment| probes.value(assignment, traced.pixel)).map_err(|e| e.to_string())
}

#[cfg(test)]
mod tests {
    use super::*;
    use eddy_diag::{SourceId, Span};
    use eddy_glsl::Probe;
    use std::convert::Infallible;

    fn all(count: usize) -> Vec<Assignment> {
        let one = |visit: usize| Assignment {
            name: "x".into(),
            span: Span::new(SourceId(1), 0..1),
            probe: Probe { source: SourceId(1), at: 0, visit: visit as u32 },
            walker: vec![Number::Float(visit as f32)],
        };
        (0..count).map(one).collect()
    }

    /// Returns the visit that is reported, and how many were compared, where those with `is_off` differ.
    fn reported(count: usize, max_probes: usize, is_off: impl Fn(u32) -> bool) -> (Option<u32>, usize) {
        let draw = |assignment: &Assignment| {
            let visit = assignment.probe.visit;
            Ok::<_, Infallible>(Some([visit as f32 + if is_off(visit) { 0.5 } else { 0.0 }, 0.0, 0.0, 1.0]))
        };
        let Ok(found) = search(all(count), max_probes, draw);
        assert!(found.compared <= max_probes && found.of == count);
        (found.first.map(|first| first.assignment.probe.visit), found.compared)
    }

    #[test]
    fn few_assignments_are_compared_in_order() {
        assert_eq!(reported(10, 32, |_| false), (None, 10));
        assert_eq!(reported(10, 32, |visit| visit == 3 || visit > 6), (Some(3), 4));
    }

    #[test]
    fn many_assignments_are_bisected() {
        let (first, compared) = reported(10_000, 32, |visit| visit >= 7_123);
        assert_eq!((first, compared), (Some(7_123), 32));
        // One that vanishes again is found if it is early.
        assert_eq!(reported(10_000, 32, |visit| visit == 4 || visit >= 7_123).0, Some(4));
        assert_eq!(reported(10_000, 32, |_| false), (None, 32));
    }

    #[test]
    fn unreached_assignment_is_a_divergence() {
        let Ok(found) = search(all(3), 9, |_| Ok::<_, Infallible>(None));
        let first = found.first.unwrap();
        assert_eq!((first.device, first.ulps.len(), found.compared), (None, 0, 1));
        // NaN equals NaN, and both zeros are equal.
        let Ok(found) = search(all(1), 9, |_| Ok::<_, Infallible>(Some([-0.0, f32::NAN, 0.0, 1.0])));
        assert_eq!(found.first, None);
    }
}
