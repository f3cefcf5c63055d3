//! Programs with the values of custom uniforms as constants, and what they read then.
//!
//! A specialised program is never drawn. It is only asked what it reads, so that a pass that reads nothing that has
//! changed is not drawn again. That is exact: the general program computes the same texels as the specialised one,
//! whatever the inputs that the specialised one does not read, so its texels do not depend on these.
//!
//! It must hold for any arithmetic of a driver. So only facts are used that follow with every rounding, contraction
//! and flush to zero ([`number`]), for inputs that are as [`Assumptions`] say.
//!
//! Each round folds all functions with what the round before found out about variables, parameters and results
//! ([`fold`]), and removes what has lost its use ([`sweep`]).

mod fold;
mod number;
mod reads;
mod summary;
mod sweep;
#[cfg(test)]
mod tests;

pub use reads::Reads;

use crate::ir::{Module, Op, verify};
use std::sync::Arc;
use summary::Summary;

/// The largest `iTime`, `iTimeDelta` or `iFrameRate` for which the results of [`Specialisable::reads`] hold. They hold
/// for no negative one, not even -0.
pub const MAX_SECONDS: f32 = 1e9;

/// The most values of a program that is specialised. Larger ones would take longer than a frame may be delayed.
const MAX_VALUES: usize = 60_000;

/// Nested calls and variables need a round each; hardly any program needs more.
const MAX_ROUNDS: usize = 5;

/// The inputs that are taken as known.
struct Assumptions<'a> {
    /// The words of the custom uniforms by their slots; later slots are unknown.
    slots: &'a [[u32; 4]],
}

/// A program that can be specialised. Its debug output is empty, as it belongs to a stage that already shows its code.
#[derive(Clone)]
pub struct Specialisable(Arc<Module>);

impl std::fmt::Debug for Specialisable {
    fn fmt(&self, _: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        Ok(())
    }
}

impl Specialisable {
    /// Returns a copy of an optimised program, unless it is too large.
    pub(crate) fn new(program: &Module) -> Option<Self> {
        let values: usize = program.functions.iter().map(|f| f.len()).sum();
        (values <= MAX_VALUES).then(|| Self(Arc::new(program.clone())))
    }

    /// Returns the number of values in the program: the time to specialise it is about proportional.
    pub fn size(&self) -> usize {
        self.0.functions.iter().map(|f| f.len()).sum()
    }

    /// Returns what the program reads while the custom uniforms of the first slots have these words. Holds for frames
    /// in which `iTime`, `iTimeDelta` and `iFrameRate` are between 0 and [`MAX_SECONDS`], and not -0, and the components
    /// of `iMouse` between -2^20 and 2^20.
    pub fn reads(&self, slots: &[[u32; 4]]) -> Reads {
        Reads::of(&self.specialised(slots).0)
    }

    /// Returns the texels across and up, from the first one on, outside of which the program never fetches one of a
    /// channel, whatever the values of custom uniforms; `None` if that is not known, or if the channel is also read with
    /// filters.
    pub fn fetched_extent(&self, channel: u8) -> Option<(u32, u32)> {
        let (module, last) = self.specialised(&[]);
        let is_filtered = |op: &Op| match *op {
            Op::Sample { channel: read, .. } | Op::Gather { channel: read, .. } => read == channel,
            _ => false,
        };
        if module.functions.iter().any(|f| f.values().any(|(_, op)| is_filtered(op))) {
            return None;
        }
        let [x, y, ..] = last.coordinates(channel);
        let end = |number: Option<number::Number>| Some(number?.max.clamp(0.0, f64::from(1 << 30)) as u32 + 1);
        end(x).zip(end(y))
    }

    /// Returns the specialised program, and what its last round found.
    fn specialised(&self, slots: &[[u32; 4]]) -> (Module, Summary) {
        let mut module = (*self.0).clone();
        let assumptions = Assumptions { slots };
        let mut known = Summary::default();
        let mut size = usize::MAX;
        for _ in 0..MAX_ROUNDS {
            let mut found = Summary::of_initial(&module);
            for index in 0..module.functions.len() {
                let f = std::mem::take(&mut module.functions[index]);
                let f = fold::function(&module, index, f, &assumptions, &known, &mut found);
                module.functions[index] = f;
            }
            let functions = module.functions.len();
            sweep::run(&mut module);
            verify::assert_kept(&module, "specialise");
            let values = module.functions.iter().map(|f| f.len()).sum();
            let is_same = module.functions.len() == functions;
            // Facts belong to functions by their numbers.
            known = if is_same { found } else { Summary::default() };
            if is_same && values == size {
                break;
            }
            size = values;
        }
        (module, known)
    }
}
