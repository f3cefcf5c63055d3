//! Skips draws while the author's uniforms rest: with their values as constants, a draw may read less than its
//! program can, for example no time where the speed is 0. Such a draw is executed only when what it then reads changes.
//!
//! All draws use the program that was built; the values are only used to find out what it depends on. So a value that
//! moves has its effect in the same frame, and no texel differs.

use super::{compiled::channel_facts, program::Program, uniforms::UniformReads};
use eddy_glsl::{
    interface::UniformBlock,
    opt::specialise::{MAX_SECONDS, Reads},
};
use eddy_graph::{ChannelFacts, Dependencies, PassFacts};

/// The number of frames after which a value rests. A slider that is being dragged seldom keeps its value that long.
const RESTING_FRAMES: u32 = 8;

/// The size of the programs that one frame specialises, in values: a millisecond or two.
const SIZE_PER_FRAME: usize = 4000;

/// The reads of a program's draws at the present values of custom uniforms.
#[derive(Default)]
pub(super) struct Resting {
    /// The values of the newest frame.
    slots: Vec<[u32; 4]>,
    /// The number of frames since the last change of a value.
    frames: u32,
    draws: Vec<State>,
}

#[derive(Clone, Copy, Default)]
enum State {
    /// Not determined yet.
    #[default]
    Unknown,
    /// The draw reads no less than for other values.
    Same,
    Less(RestingReads),
}

/// The inputs that a draw depends on at the present values of custom uniforms, apart from these.
#[derive(Clone, Copy)]
pub(super) struct RestingReads {
    pub uniforms: UniformReads,
    pub dependencies: Dependencies,
}

impl Resting {
    /// Takes the values of a frame that is about to be drawn, with those of the host after the author's own. Finds out
    /// what some more draws read once the values rest.
    pub(crate) fn update(&mut self, program: &Program, slots: &[[u32; 4]]) {
        if !program.skips {
            return;
        }
        // The values of the host move with time.
        let slots = &slots[..program.custom_uniforms.len().min(slots.len())];
        if self.draws.len() != program.draws.len() || self.slots.len() != slots.len() {
            *self = Self { slots: slots.to_vec(), frames: 0, draws: vec![State::Unknown; program.draws.len()] };
        } else if self.slots != slots {
            let is_changed = |slot: &u16| {
                let slot = usize::from(*slot);
                self.slots.get(slot) != slots.get(slot)
            };
            for (state, draw) in self.draws.iter_mut().zip(&program.draws) {
                if draw.custom_uniforms.iter().any(is_changed) {
                    *state = State::Unknown;
                }
            }
            self.slots.copy_from_slice(slots);
            self.frames = 0;
        }
        self.frames += 1;
        if self.frames < RESTING_FRAMES {
            return;
        }
        let mut size = 0;
        for (index, state) in self.draws.iter_mut().enumerate() {
            if size >= SIZE_PER_FRAME {
                break;
            }
            if matches!(state, State::Unknown) {
                size += program.draws[index].specialisable.iter().map(|stage| stage.size()).sum::<usize>();
                *state = state_of(program, index, slots);
            }
        }
    }

    /// Returns what a draw depends on, if that is known to be less than for other values.
    pub(crate) fn reads(&self, draw: usize) -> Option<&RestingReads> {
        match self.draws.get(draw) {
            Some(State::Less(reads)) => Some(reads),
            _ => None,
        }
    }
}

/// Finds out what a draw reads at these values.
fn state_of(program: &Program, index: usize, slots: &[[u32; 4]]) -> State {
    let (compiled, draw) = (&program.draws[index], &program.plan.draws[index]);
    let all = UniformReads::of(compiled);
    if compiled.specialisable.is_empty() {
        return State::Same;
    }
    let mut uniforms = UniformReads { uniforms: eddy_glsl::UniformSet::empty(), geometry: false };
    let mut facts = PassFacts::default();
    for Reads { uniforms: read, geometry, channels, discards } in
        compiled.specialisable.iter().map(|stage| stage.reads(slots))
    {
        uniforms.uniforms |= read;
        uniforms.geometry |= geometry;
        facts.discards |= discards;
        for (all, used) in facts.channels.iter_mut().zip(channels) {
            *all = joined(*all, channel_facts(used));
        }
    }
    uniforms.uniforms &= all.uniforms;
    uniforms.geometry &= all.geometry;
    let dependencies = draw.dependencies_with(&facts);
    if uniforms == all && dependencies == draw.dependencies() {
        return State::Same;
    }
    State::Less(RestingReads { uniforms, dependencies })
}

fn joined(a: ChannelFacts, b: ChannelFacts) -> ChannelFacts {
    ChannelFacts {
        is_read: a.is_read || b.is_read,
        reaches_mips: a.reaches_mips || b.reaches_mips,
        max_texels: match (a.is_read, b.is_read) {
            (true, true) => a.max_texels.zip(b.max_texels).map(|(a, b)| a.saturating_add(b)),
            (true, false) => a.max_texels,
            _ => b.max_texels,
        },
    }
}

/// Returns whether a frame is one for which [`Reads`] hold.
pub(super) fn is_ordinary(block: &UniformBlock) -> bool {
    let is_time = |seconds: f32| seconds.is_sign_positive() && seconds <= MAX_SECONDS;
    let side = (1 << 20) as f32;
    [block.time, block.time_delta, block.frame_rate].into_iter().all(is_time)
        && block.mouse.into_iter().all(|at| (-side..=side).contains(&at))
}
