//! A running program: its textures over time, their bindings, and its pending changes. `frame` draws its frames.

use super::{
    EngineError, FrameInputs,
    bind::{Bindings, draw_fill},
    custom_uniforms,
    frame::Unfinished,
    program::Program,
    resting::Resting,
    shared::Shared,
    targets::{NewTargets, Target},
    uniforms::{self, Uniforms},
};
use eddy_gpu::{PassTimer, Texture, depth_buffer};
use eddy_graph::{Changes, Draw, SliceTimes};
use eddy_project::{CustomUniformValues, PassName};

/// A program with its textures, on a canvas of one size.
pub(super) struct Running {
    pub program: Program,
    pub canvas: (u32, u32),
    pub targets: Vec<Target>,
    /// One per draw; `None` for those without meshes.
    pub depths: Vec<Option<wgpu::TextureView>>,
    pub bindings: Bindings,
    pub uniforms: Uniforms,
    pub changes: Changes,
    /// The reads of draws while custom uniforms keep their values.
    pub resting: Resting,
    /// For each draw, whether its targets have their contents before frame 0 because its condition is false.
    pub is_blank: Vec<bool>,
    /// Measures the passes, if enabled and supported.
    pub timer: Option<PassTimer>,
    /// The number of times that each draw was executed in the newest frame.
    pub steps_drawn: Vec<u32>,
    /// The number of submissions of the newest frame.
    pub submissions: u32,
    /// The rest of the newest frame, if the caller stopped it.
    pub unfinished: Option<Unfinished>,
    /// For each draw, whether later frames depend on it.
    pub lasting: Vec<bool>,
    /// The times of draws, if frames are submitted in slices.
    pub slices: Option<SliceTimes>,
}

/// Returns the times of the draws of a program, if its frames are submitted in slices. A pass that `before` had, too,
/// probably takes as long for each texel as there: most edits change little.
pub(super) fn slice_times(
    shared: &Shared,
    program: &Program,
    canvas: (u32, u32),
    before: Option<&Running>,
) -> Option<SliceTimes> {
    let limit = shared.gpu.slices.as_ref()?.limit;
    let mut times = SliceTimes::new(limit.as_secs_f64() * 1e3, program.draws.len());
    let texels = |program: &Program, draw: &Draw, canvas| {
        let (width, height) = program.plan.targets[draw.targets.start].size.of(canvas);
        f64::from(width) * f64::from(height)
    };
    let known = before.and_then(|before| Some((before, before.slices.as_ref()?)));
    for (n, (compiled, draw)) in program.planned_draws().enumerate() {
        let Some((before, known)) = known else { break };
        let same = before.program.planned_draws().enumerate().find(|(_, (other, _))| other.id == compiled.id);
        let guess =
            same.and_then(|(n, (_, draw))| Some(known.likely(n)? / texels(&before.program, draw, before.canvas)));
        if let Some(of_texel) = guess {
            times.guess(n, of_texel * texels(program, draw, canvas));
        }
    }
    Some(times)
}

/// The number of slices of a frame whose draws are timed by the device. A frame of more takes seconds.
const TIMED_SLICES: u64 = 256;

/// The textures that a program needs in addition to the existing ones.
struct NewTextures {
    targets: NewTargets,
    depths: Vec<Option<wgpu::TextureView>>,
}

impl NewTextures {
    fn make(
        shared: &mut Shared,
        program: &Program,
        canvas: (u32, u32),
        present: &[Target],
    ) -> Result<Self, EngineError> {
        let depths = program.planned_draws().map(|(compiled, draw)| {
            let depth = || {
                let (width, height) = program.plan.targets[draw.targets.start].size.of(canvas);
                depth_buffer(&shared.gpu, &format!("depth of {}", compiled.id.title()), width, height)
            };
            compiled.body.has_depth().then(depth).transpose()
        });
        Ok(Self {
            depths: depths.collect::<Result<_, _>>()?,
            targets: NewTargets::make(&shared.gpu, &mut shared.mips, &program.plan, canvas, present)?,
        })
    }
}

impl Running {
    /// Starts a program in place of `before`. Targets that both have keep their texels; new ones start with their
    /// initial contents, else as zeros. On an error `before` stays.
    pub(crate) fn start(
        shared: &mut Shared,
        program: Program,
        canvas: (u32, u32),
        before: &mut Option<Running>,
    ) -> Result<Running, EngineError> {
        let present = before.as_ref().map_or(&[][..], |running| &running.targets);
        let new = NewTextures::make(shared, &program, canvas, present)?;
        let slices = slice_times(shared, &program, canvas, before.as_ref());
        let mut running = Running {
            canvas,
            targets: before.take().map_or_else(Vec::new, |running| running.targets),
            depths: Vec::new(),
            bindings: Bindings::default(),
            uniforms: Uniforms::new(&shared.gpu, &program),
            changes: Changes::new(&program.plan),
            resting: Resting::default(),
            is_blank: Vec::new(),
            timer: None,
            steps_drawn: Vec::new(),
            submissions: 0,
            unfinished: None,
            lasting: program.plan.lasting_draws(),
            slices,
            program,
        };
        running.uniforms.set_custom_uniforms(
            &shared.gpu,
            custom_uniforms::block(&running.program.custom_uniforms, &running.program.custom_uniform_values),
        );
        running.install_textures(shared, new);
        Ok(running)
    }

    /// Continues with another canvas. Targets keep the overlap; the rest is reset to the contents before frame 0. On an
    /// error nothing changes.
    pub(crate) fn resize(&mut self, shared: &mut Shared, canvas: (u32, u32)) -> Result<(), EngineError> {
        let new = NewTextures::make(shared, &self.program, canvas, &self.targets)?;
        self.slices = slice_times(shared, &self.program, canvas, Some(self));
        self.canvas = canvas;
        self.drop_unfinished();
        self.changes.invalidate();
        self.install_textures(shared, new);
        Ok(())
    }

    /// Installs new textures. They take over the contents of the present ones, and else start with those
    /// before frame 0.
    fn install_textures(&mut self, shared: &Shared, new: NewTextures) {
        self.depths = new.depths;
        self.is_blank.clear();
        let (old, is_new) = new.targets.replace(&self.program.plan, &mut self.targets);
        self.bindings = Bindings::new(&shared.gpu, &self.program, &self.uniforms);
        self.fill_initial(shared, |target| is_new[target]);
        let plan = &self.program.plan;
        let is_taken_over = |(index, _): &(usize, &mut Target)| is_new[*index] && plan.is_drawn(*index);
        for (_, target) in self.targets.iter_mut().enumerate().filter(is_taken_over) {
            if let Some(before) = old.iter().find(|t| t.id == target.id && t.index == target.index) {
                target.take_over(&shared.gpu, &shared.mips, before);
            }
        }
    }

    /// Sets values of the author's own uniforms. Returns whether any has changed.
    pub(crate) fn set_custom_uniforms(&mut self, shared: &Shared, values: &CustomUniformValues) -> bool {
        let slots = custom_uniforms::block(&self.program.custom_uniforms, values);
        let is_changed = self.uniforms.set_custom_uniforms(&shared.gpu, slots);
        if is_changed {
            self.forget_blank_fills();
        }
        is_changed
    }

    /// Drops the rest of a frame that was stopped. The next frame draws everything.
    pub(crate) fn drop_unfinished(&mut self) {
        if self.unfinished.take().is_some() {
            self.changes.invalidate();
        }
    }

    /// Sets every target to its state before frame 0.
    pub(crate) fn reset(&mut self, shared: &Shared) {
        self.drop_unfinished();
        let descriptor = wgpu::CommandEncoderDescriptor { label: Some("reset") };
        let mut encoder = shared.gpu.device.create_command_encoder(&descriptor);
        for target in &self.targets {
            target.clear(&shared.gpu, &mut encoder, &shared.mips);
        }
        shared.gpu.queue.submit([encoder.finish()]);
        self.fill_initial(shared, |_| true);
        self.changes.invalidate();
    }

    /// Draws the contents before frame 0 of the targets whose index in the plan is selected.
    pub(crate) fn fill_initial(&mut self, shared: &Shared, is_named: impl Fn(usize) -> bool) {
        let Self { program, canvas, targets, bindings, uniforms, .. } = self;
        if !program.draws.iter().any(|draw| draw.initial.is_some()) {
            return;
        }
        let inputs = FrameInputs::at_fixed_step(0, 60.0);
        for (index, (compiled, draw)) in program.planned_draws().enumerate() {
            let own = targets[draw.targets.start].size();
            let layers = program.plan.layers(index);
            uniforms.set(index, layers, &uniforms::block(&inputs, own, *canvas, &compiled.channels));
        }
        uniforms.write(&shared.gpu);
        let descriptor = wgpu::CommandEncoderDescriptor { label: Some("initial") };
        let mut encoder = shared.gpu.device.create_command_encoder(&descriptor);
        for ((compiled, draw), bound) in program.planned_draws().zip(&mut bindings.fills) {
            let (Some(fill), Some(bound)) = (&compiled.initial, &mut bound.initial) else { continue };
            if !is_named(draw.targets.start) {
                continue;
            }
            let target = &targets[draw.targets.start];
            for texture in &target.textures {
                let load = shared.gpu.load_op_dont_care();
                let descriptor = wgpu::RenderPassDescriptor {
                    label: Some("initial"),
                    color_attachments: &[Some(texture.attachment(load))],
                    ..Default::default()
                };
                shared.gpu.pass(&mut encoder, descriptor, |pass| draw_fill(bound, shared, fill, pass));
            }
            for chain in &target.chains {
                shared.mips.build(&shared.gpu, &mut encoder, chain);
            }
        }
        shared.gpu.queue.submit([encoder.finish()]);
    }

    /// Turns measuring on or off. Allocates queries for every draw of a frame.
    pub(crate) fn set_timing(&mut self, shared: &Shared, on: bool) {
        let parts = if self.slices.is_some() { TIMED_SLICES } else { 0 };
        let draws = u32::try_from(self.program.plan.draws_per_frame().max(1) + parts).unwrap_or(u32::MAX);
        self.timer = if on { PassTimer::new(&shared.gpu, draws) } else { None };
    }

    /// The target of a pass by its index among the pass's targets.
    pub(crate) fn target(&self, pass: &PassName, index: usize) -> Result<&Target, EngineError> {
        let own = || self.targets.iter().filter(|t| t.id == *pass);
        if own().next().is_none() {
            return Err(EngineError::NoSuchPass(pass.title()));
        }
        own().find(|t| t.index == index).ok_or_else(|| EngineError::NoSuchTarget { pass: pass.title(), index })
    }

    /// Returns the newest texture of one of a pass's targets, and layer 0 of it; for a cubemap its one target, and face
    /// `index` in the order of [`eddy_texture::Face::ALL`].
    pub(crate) fn layer(&self, pass: &PassName, index: usize) -> Result<(&Texture, u32), EngineError> {
        let first = self.target(pass, 0)?.newest();
        if first.shape.layers() == 1 {
            return Ok((self.target(pass, index)?.newest(), 0));
        }
        let face = u32::try_from(index).ok().filter(|face| *face < first.shape.layers());
        let face = face.ok_or_else(|| EngineError::NoSuchTarget { pass: pass.title(), index })?;
        Ok((first, face))
    }
}
