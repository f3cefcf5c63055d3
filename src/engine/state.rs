//! The texels that the next frame reads, copied from the device so that another process can continue with them.

use super::{EngineError, run::Engine, running::Running, shared::Shared, targets::Target};
use eddy_gpu::{GpuError, Readback};
use eddy_graph::Carried;
use eddy_project::PassName;
use eddy_texture::TextureShape;

/// The texels of earlier frames that the next frame of a program reads.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct State {
    pub targets: Vec<TargetState>,
}

/// The texels of one target of a pass.
#[derive(Clone, Debug, PartialEq)]
pub struct TargetState {
    pub pass: PassName,
    /// The index among the pass's targets.
    pub index: usize,
    /// The shape of each texture: one level.
    pub shape: TextureShape,
    /// The bytes of the texture that was drawn last, and of the previous one if the pass keeps texels that it does not
    /// draw: rows in texture order without padding, layer by layer.
    pub textures: Vec<Vec<u8>>,
}

/// The storage of one target, for checking the size of a state before it is read.
#[derive(Clone, Debug, PartialEq)]
pub struct TargetForm {
    pub pass: PassName,
    /// The index among the pass's targets.
    pub index: usize,
    /// The shape of each texture: one level.
    pub shape: TextureShape,
    /// The number of its textures.
    pub textures: usize,
    /// True if the next frame reads its contents.
    pub is_read: bool,
}

/// The reason why a program cannot continue with a state.
#[derive(Debug, thiserror::Error)]
pub enum StateError {
    #[error("nothing is kept of {0}, which the next frame reads")]
    Missing(String),
    #[error("{pass} was {was}, and is {is} now")]
    Shape { pass: String, was: String, is: String },
    #[error(transparent)]
    Gpu(#[from] GpuError),
}

/// Returns the number of a target's textures that the next frame reads.
fn kept(carried: Carried, target: &Target) -> usize {
    match carried {
        Carried::Nothing => 0,
        Carried::Newest => 1,
        Carried::All => target.textures.len(),
    }
}

/// The targets that a frame reads, with the number of their textures that it reads.
fn carried(running: &Running) -> impl Iterator<Item = (usize, &Target, usize)> {
    let plan = &running.program.plan;
    let of = move |(index, target)| (index, target, kept(plan.carried(index), target));
    running.targets.iter().enumerate().map(of).filter(|(.., count)| *count > 0)
}

impl Engine {
    /// Returns the passes whose earlier frames the next frame reads.
    pub fn passes_with_state(&self) -> Vec<PassName> {
        let mut passes: Vec<PassName> = Vec::new();
        for (_, target, _) in self.running.iter().flat_map(carried) {
            if !passes.contains(&target.id) {
                passes.push(target.id.clone());
            }
        }
        passes
    }

    /// Returns the storage of every target of the program.
    pub fn state_forms(&self) -> Vec<TargetForm> {
        let Some(running) = &self.running else { return Vec::new() };
        let form = |(index, target): (usize, &Target)| TargetForm {
            pass: target.id.clone(),
            index: target.index,
            shape: target.textures[0].shape.without_mips(),
            textures: target.textures.len(),
            is_read: kept(running.program.plan.carried(index), target) > 0,
        };
        running.targets.iter().enumerate().map(form).collect()
    }

    /// Reads back the texels that the next frame reads. Waits for the device.
    pub fn state(&self) -> Result<State, EngineError> {
        let mut readback = Readback::default();
        let mut state = State::default();
        for (_, target, count) in self.running.iter().flat_map(carried) {
            let order = (0..count).map(|n| &target.textures[(target.front + n) % target.textures.len()]);
            let textures = order.map(|texture| readback.bytes(self.gpu(), texture)).collect::<Result<_, _>>()?;
            state.targets.push(TargetState {
                pass: target.id.clone(),
                index: target.index,
                shape: target.textures[0].shape.without_mips(),
                textures,
            });
        }
        Ok(state)
    }

    /// Restores a state: the next frame reads its texels. Fails without changes if it lacks texels that the program
    /// reads, or has them in another shape. Extra targets are ignored.
    pub fn set_state(&mut self, state: &State) -> Result<(), StateError> {
        let shared = &self.shared;
        self.running.as_mut().map_or(Ok(()), |running| running.set_state(shared, state))
    }
}

impl Running {
    fn set_state(&mut self, shared: &Shared, state: &State) -> Result<(), StateError> {
        let mut found = Vec::new();
        for (place, target, count) in carried(self) {
            let title = target.id.title();
            let of = |kept: &&TargetState| kept.pass == target.id && kept.index == target.index;
            let kept = state.targets.iter().find(of);
            let kept = kept.filter(|kept| kept.textures.len() >= count).ok_or(StateError::Missing(title.clone()))?;
            let shape = target.textures[0].shape.without_mips();
            let is_whole = kept.textures.iter().all(|bytes| bytes.len() as u64 == shape.bytes());
            if kept.shape != shape || !is_whole {
                let (was, is) = (shape_text(kept.shape), shape_text(shape));
                return Err(StateError::Shape { pass: title, was, is });
            }
            found.push((place, count, kept));
        }
        self.drop_unfinished();
        let gpu = &shared.gpu;
        for (place, count, kept) in found {
            let target = &self.targets[place];
            for (n, bytes) in kept.textures.iter().take(count).enumerate() {
                target.textures[(target.front + n) % target.textures.len()].write(gpu, bytes);
            }
            let mut encoder =
                gpu.device.create_command_encoder(&wgpu::CommandEncoderDescriptor { label: Some("state") });
            target.chains.iter().for_each(|chain| shared.mips.build(gpu, &mut encoder, chain));
            gpu.queue.submit([encoder.finish()]);
        }
        self.changes.invalidate();
        self.is_blank.clear();
        gpu.take_error("a state").map_err(Into::into)
    }
}

fn shape_text(shape: TextureShape) -> String {
    format!("{}x{} {}", shape.width, shape.height, shape.format.name())
}
