//! The costs of each pass: the memory of its textures, its memory traffic, and its time.

use super::Engine;
use eddy_graph::{Draw, FramePlan, PassFacts, Read, ReadTiming, TexelSource, Traffic};
use eddy_project::{Condition, PassName, Project};
use eddy_texture::TexelFormat;

/// Bytes per texel of a depth buffer.
const DEPTH_BYTES: u64 = 4;

/// The clock that measures the milliseconds of passes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum CostClock {
    /// The device's timestamps before and after each pass.
    Timestamps,
    /// The wall clock, on a device without timestamps: each pass is submitted and waited for separately, minus the time
    /// of an empty submission. See [`DrawFor::Timed`](super::DrawFor::Timed).
    Waited,
}

/// The part of a pass in a frame.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum PassRole {
    /// It is drawn; `is_cached` if the newest frame reused its previous picture because none of its inputs had changed.
    Drawn { is_cached: bool },
    /// Its region is outside its texels: there is nothing to draw.
    Outside,
    /// Its condition is false: it is not drawn, and has its contents before frame 0.
    Off,
    /// No pass reads it: it is not drawn.
    Unread,
}

/// A channel of a pass that names another pass, or the pass itself.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct PassRead {
    pub channel: usize,
    pub pass: PassName,
    /// The index among the targets of that pass.
    pub index: usize,
    pub when: ReadTiming,
    /// True if the pass is drawn and its code reads the channel.
    pub is_used: bool,
}

/// The part of a pass in a frame, according to the plan.
#[derive(Clone, Debug, PartialEq)]
pub struct PassCost {
    pub pass: PassName,
    pub role: PassRole,
    /// The condition for drawing it, if it has one.
    pub when: Option<String>,
    /// Texels of its targets.
    pub size: (u32, u32),
    /// The format of each of its targets.
    pub formats: Vec<TexelFormat>,
    /// The number of draws per frame.
    pub steps: u32,
    /// The bytes of its textures on the device, including mip levels, the second texture of a pair and the depth
    /// buffer.
    pub held_bytes: u64,
    /// The minimum bytes that a frame moves for it, for all steps: its own texels are written, and those of each
    /// distinct pass that it reads are read once per step. 0 if it is not drawn.
    pub moved_bytes: u64,
    /// The texels that a frame draws of it, for all steps.
    pub texels: u64,
    /// The passes that its channels name.
    pub reads: Vec<PassRead>,
}

impl Engine {
    /// Returns the costs of each pass of the running program in drawing order, then those of `project` that are not
    /// drawn. Empty without a program. Sound passes are not part of a frame.
    pub fn pass_costs(&self, project: &Project) -> Vec<PassCost> {
        let Some(running) = self.running() else { return Vec::new() };
        let (plan, canvas) = (&running.program.plan, running.canvas);
        // The reads if nothing is omitted: also by passes that are not drawn, and by channels that no code reads.
        let anything = vec![PassFacts::ANYTHING; project.passes.len()];
        let whole = FramePlan::new(project, &anything, &[], false);
        let mut costs: Vec<PassCost> = Vec::new();
        for (index, (compiled, draw)) in running.program.planned_draws().enumerate() {
            let targets = &plan.targets[draw.targets.clone()];
            let size = targets[0].size.of(canvas);
            let is_off = running.is_off(index);
            let step = if is_off { Traffic::default() } else { plan.traffic_of(index, canvas) };
            let steps = plan.steps_of(index);
            let depth = if compiled.body.has_depth() { DEPTH_BYTES } else { 0 };
            costs.push(PassCost {
                pass: compiled.id.clone(),
                when: draw.when.as_ref().map(Condition::to_string),
                role: match draw.region {
                    _ if is_off => PassRole::Off,
                    Some(region) if region.within(size).is_none() => PassRole::Outside,
                    _ => PassRole::Drawn { is_cached: running.steps_drawn.get(index) == Some(&0) },
                },
                size,
                formats: targets.iter().map(|t| t.format).collect(),
                steps,
                held_bytes: targets.iter().map(|t| t.bytes(canvas)).sum::<u64>()
                    + depth * u64::from(size.0) * u64::from(size.1),
                moved_bytes: step.bytes * u64::from(steps),
                texels: step.texels * u64::from(steps),
                reads: reads(&whole, project, &compiled.id, Some(draw)),
            });
        }
        for pass in project.passes.iter().filter(|pass| pass.id.is_picture()) {
            if costs.iter().any(|c| c.pass == pass.id) {
                continue;
            }
            costs.push(PassCost {
                pass: pass.id.clone(),
                role: PassRole::Unread,
                when: pass.settings.when.as_ref().map(Condition::to_string),
                size: pass.size().of(canvas),
                formats: pass.formats(),
                steps: 0,
                // Readers of a pass that is not drawn read zeros, which use memory, too.
                held_bytes: plan.targets.iter().filter(|t| t.id == pass.id).map(|t| t.bytes(canvas)).sum(),
                moved_bytes: 0,
                texels: 0,
                reads: reads(&whole, project, &pass.id, None),
            });
        }
        costs
    }

    /// Returns the clock that measures passes on this device: that of [`Engine::pass_times`] or of
    /// [`DrawFor::Timed`](super::DrawFor::Timed).
    pub fn cost_clock(&self) -> CostClock {
        if self.gpu().has_timestamps { CostClock::Timestamps } else { CostClock::Waited }
    }
}

/// The reads of a pass in a plan of everything, marking those that its draw performs.
fn reads(whole: &FramePlan, project: &Project, pass: &PassName, drawn: Option<&Draw>) -> Vec<PassRead> {
    let is_it = |draw: &&Draw| project.passes[draw.pass].id == *pass;
    let Some(planned) = whole.draws.iter().find(is_it) else { return Vec::new() };
    let read = |(channel, read): (usize, &Option<Read>)| {
        let TexelSource::Target { index, when } = read.as_ref()?.source else { return None };
        let target = &whole.targets[index];
        let used = drawn.and_then(|draw| draw.reads[channel].as_ref());
        let is_used = used.is_some_and(|read| matches!(read.source, TexelSource::Target { .. }));
        Some(PassRead { channel, pass: target.id.clone(), index: target.index, when, is_used })
    };
    planned.reads.iter().enumerate().filter_map(read).collect()
}
