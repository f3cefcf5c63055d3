//! Passes with a condition (`when` in `eddy.toml`): which of them are off, and the contents of their targets then.
//!
//! A target of a pass that is off has its contents before frame 0. So a frame depends on its inputs, on the values of
//! uniforms and on what frames before it drew, and not on when a condition was last true: replayed runs, snapshots and
//! frames in any order give the same bytes.

use super::{EngineError, encode::NO_VALUE, program::Program, running::Running, shared::Shared};
use eddy_graph::Traffic;
use eddy_project::{CustomUniformType, PassName};

impl Program {
    /// Returns the value of a uniform's slot for a condition. `None` if it is unknown or not a single number.
    fn single_value(&self, slots: &[[u32; 4]], name: &str) -> Option<f64> {
        let at = self.custom_uniforms.iter().position(|uniform| uniform.name == name)?;
        let word = slots.get(at)?[0];
        match self.custom_uniforms[at].ty {
            CustomUniformType::Bool => Some(f64::from(u8::from(word != 0))),
            CustomUniformType::Int => Some(f64::from(word as i32)),
            CustomUniformType::Float => Some(f64::from(f32::from_bits(word))),
            _ => None,
        }
    }
}

impl Running {
    /// Returns whether the condition of a draw is false.
    pub(crate) fn is_off(&self, draw: usize) -> bool {
        let slots = self.uniforms.custom_uniforms();
        let value = |name: &str| self.program.single_value(slots, name);
        let condition = self.program.plan.draws[draw].when.as_ref();
        condition.is_some_and(|condition| !condition.holds(&value, self.canvas))
    }

    /// Returns for each draw whether its condition is false. Resets the targets of those that have become false to
    /// their contents before frame 0.
    pub(crate) fn turn_off(&mut self, shared: &Shared) -> Vec<bool> {
        let off: Vec<bool> = (0..self.program.draws.len()).map(|draw| self.is_off(draw)).collect();
        self.is_blank.resize(off.len(), false);
        let new: Vec<usize> = (0..off.len()).filter(|draw| off[*draw] && !self.is_blank[*draw]).collect();
        for (is_blank, is_off) in self.is_blank.iter_mut().zip(&off) {
            *is_blank = *is_off;
        }
        if new.is_empty() {
            return off;
        }
        let gpu = &shared.gpu;
        let mut encoder = gpu.device.create_command_encoder(&wgpu::CommandEncoderDescriptor { label: Some("off") });
        for &index in &new {
            let draw = &self.program.plan.draws[index];
            for target in draw.targets.clone() {
                self.targets[target].clear(gpu, &mut encoder, &shared.mips);
            }
            if let Some(beside) = draw.extra_target {
                self.targets[beside].textures.iter().for_each(|texture| texture.clear(gpu, &mut encoder, NO_VALUE));
            }
            self.changes.blanked(index, draw);
        }
        gpu.queue.submit([encoder.finish()]);
        let starts: Vec<usize> = new.iter().map(|index| self.program.plan.draws[*index].targets.start).collect();
        self.fill_initial(shared, |target| starts.contains(&target));
        off
    }

    /// Returns an error for a pass whose condition is false: its code runs for no texel.
    pub(crate) fn check_is_on(&self, pass: &PassName) -> Result<(), EngineError> {
        let off =
            (0..self.program.draws.len()).find(|draw| self.program.draws[*draw].id == *pass && self.is_off(*draw));
        let when = off.and_then(|draw| self.program.plan.draws[draw].when.as_ref());
        when.map_or(Ok(()), |when| Err(EngineError::Off { pass: pass.title(), when: when.to_string() }))
    }

    /// Marks targets of passes that are off to be filled again if their initial texels may depend on uniforms.
    pub(crate) fn forget_blank_fills(&mut self) {
        for (is_blank, draw) in self.is_blank.iter_mut().zip(&self.program.plan.draws) {
            *is_blank &= !draw.has_initial;
        }
    }

    /// Returns the minimum traffic of a frame in which every pass whose condition is true is drawn.
    pub(crate) fn traffic(&self) -> Traffic {
        let mut sum = Traffic::default();
        for draw in (0..self.program.draws.len()).filter(|draw| !self.is_off(*draw)) {
            let (step, steps) = (self.program.plan.traffic_of(draw, self.canvas), self.program.plan.steps_of(draw));
            sum.bytes += step.bytes * u64::from(steps);
            sum.texels += step.texels * u64::from(steps);
        }
        sum
    }
}
