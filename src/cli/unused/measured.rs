//! Frames in which a pass has the texels of the frame before, by comparing them.

use super::{Finding, Kind, is_drawn, millis};
use crate::{
    cli::machine::RunError,
    engine::{PassCost, PassRole, Pixels},
    playback::offline::Offline,
    project::{PassName, Project},
};
use std::{
    collections::{BTreeMap, HashMap, hash_map::DefaultHasher},
    hash::{Hash, Hasher},
};

/// The observations of a run.
#[derive(Default)]
pub(super) struct Frames {
    passes: BTreeMap<PassName, Seen>,
    /// The picture of each frame, in 8 bits.
    pub pictures: Vec<Vec<u8>>,
}

/// The observations of a pass.
#[derive(Default)]
struct Seen {
    /// A hash of all its texels after the newest frame.
    hash: Option<u64>,
    /// The number of frames that drew it although it has the texels of the frame before.
    repeated: u32,
    /// The number of frames in which Eddy did not draw it as nothing had changed.
    rested: u32,
    /// The number of frames that drew it.
    drawn: u32,
}

/// Draws frames and reads every pass after each.
pub(super) fn draw(offline: &mut Offline, project: &Project, count: u32) -> Result<Frames, RunError> {
    let mut frames = Frames::default();
    for _ in 0..count {
        offline.draw()?;
        let costs = offline.engine()?.pass_costs(project);
        for cost in &costs {
            let PassRole::Drawn { is_cached } = cost.role else { continue };
            let seen = frames.passes.entry(cost.pass.clone()).or_default();
            if is_cached {
                seen.rested += 1;
                continue;
            }
            let layers = project.pass(&cost.pass).map_or(1, |pass| pass.layers());
            let mut hasher = DefaultHasher::new();
            for layer in 0..layers {
                bits(&offline.read(&cost.pass, layer)?).for_each(|bits| bits.hash(&mut hasher));
            }
            let hash = hasher.finish();
            seen.drawn += 1;
            seen.repeated += u32::from(seen.hash == Some(hash));
            seen.hash = Some(hash);
        }
        let picture = offline.read(&PassName::image(), 0)?;
        frames.pictures.push(picture.to_rgba8());
    }
    Ok(frames)
}

fn bits(pixels: &Pixels) -> impl Iterator<Item = u32> {
    pixels.texels.iter().flatten().map(|x| x.to_bits())
}

/// Returns a finding for each pass that repeats itself.
pub(super) fn find(frames: &Frames, costs: &[PassCost], times: &HashMap<PassName, f64>) -> Vec<Finding> {
    let count = frames.pictures.len();
    let mut found = Vec::new();
    for cost in costs.iter().filter(|cost| is_drawn(cost)) {
        let Some(seen) = frames.passes.get(&cost.pass) else { continue };
        if seen.repeated > 0 {
            let share = f64::from(seen.repeated) / f64::from(seen.drawn);
            let message = format!("the texels of the frame before in {} of {count} frames", seen.repeated);
            found.push(Finding {
                ms: millis(times, cost).map(|ms| ms * f64::from(seen.repeated) / count as f64),
                bytes: (cost.moved_bytes as f64 * share) as u64,
                ..Finding::of(Kind::Frames, cost, message)
            });
        }
        if seen.rested > 0 {
            let message = format!("not drawn in {} of {count} frames, as nothing that it reads changed", seen.rested);
            let bytes = cost.moved_bytes * u64::from(seen.rested) / count as u64;
            let ms = millis(times, cost).map(|ms| ms * f64::from(seen.rested) / count as f64);
            found.push(Finding { ms, bytes, skipped: true, ..Finding::of(Kind::Frames, cost, message) });
        }
    }
    found
}
