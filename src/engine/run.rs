//! The engine: a program, its textures over time, and what can be asked of them. How a frame is drawn is in `frame`.

use super::{
    Program,
    bind::{self, DrawBindings, Stock},
    fill::{DrawFills, FillBindings},
    knobs,
    targets::{self, Target},
    uniforms::Uniforms,
};
use crate::{
    gpu::{FloatConverter, Gpu, GpuError, MipMaker, PassTimer, Presenter, Texture, depth_buffer, read_rgba32float},
    graph::Ledger,
    project::{KnobValues, PassId},
};

/// Why a frame could not be drawn or read.
#[derive(Debug, thiserror::Error)]
pub enum EngineError {
    #[error(transparent)]
    Gpu(#[from] GpuError),
    #[error("the project has no pass {0}, or nothing reached it")]
    NoSuchPass(String),
    #[error("{pass} has no target {index}")]
    NoSuchTarget { pass: String, index: usize },
    #[error(transparent)]
    Mesh(#[from] crate::media::mesh::MeshError),
}

/// Time of one pass in one frame.
#[derive(Clone, Debug, PartialEq)]
pub struct PassTime {
    pub pass: PassId,
    pub gpu_millis: f64,
}

/// What one frame was.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct FrameStats {
    /// Passes drawn in this frame, every step of a group counted.
    pub passes_drawn: u64,
    /// Passes left out because nothing they read has changed since they were drawn, and the bytes of texels that were not
    /// written for it.
    pub passes_rested: u64,
    pub bytes_rested: u64,
}

/// A pass's texels. Row 0 is the bottom; no padding.
#[derive(Clone, Debug, PartialEq)]
pub struct Pixels {
    pub width: u32,
    pub height: u32,
    pub texels: Vec<[f32; 4]>,
}

/// Textures, their state over time, and the program that draws them.
pub struct Engine {
    pub(super) gpu: Gpu,
    pub(super) size: (u32, u32),
    pub(super) program: Option<Program>,
    pub(super) targets: Vec<Target>,
    /// Of each draw that draws meshes, the depth buffer.
    pub(super) depths: Vec<Option<wgpu::TextureView>>,
    pub(super) bindings: Vec<DrawBindings>,
    /// Of each draw.
    pub(super) fills: Vec<DrawFills>,
    pub(super) uniforms: Uniforms,
    pub(super) stock: Stock,
    pub(super) mips: MipMaker,
    /// What need not be drawn again.
    pub(super) ledger: Ledger,
    pub(super) shown_keys: Vec<u8>,
    /// How often the keyboard has changed.
    pub(super) key_changes: u64,
    pub(super) display: Display,
    pub(super) timer: Option<PassTimer>,
    /// Of each draw, how often it was done in the newest frame.
    pub(super) steps_drawn: Vec<u32>,
    /// For reading back what is no rgba32float; made when first needed.
    converter: Option<FloatConverter>,
}

/// The 8-bit picture a window shows.
pub(super) struct Display {
    pub presenter: Presenter,
    pub texture: Texture,
    /// `None`: nobody looks.
    shown: Option<PassId>,
    /// The shown target's textures, bound for presenting.
    pub bound: Vec<wgpu::BindGroup>,
    /// Which target that is.
    pub target: usize,
}

impl Engine {
    /// An engine with no program: its picture is black. Fails for a size no target can have.
    pub fn new(gpu: Gpu, width: u32, height: u32) -> Result<Engine, EngineError> {
        gpu.check_size("the canvas", width, height)?;
        let presenter = Presenter::new(&gpu);
        let texture = Presenter::texture(&gpu, width, height)?;
        Ok(Engine {
            size: (width, height),
            program: None,
            targets: Vec::new(),
            depths: Vec::new(),
            bindings: Vec::new(),
            fills: Vec::new(),
            uniforms: Uniforms::new(&gpu, 0, 0, 0),
            stock: Stock::new(&gpu)?,
            mips: MipMaker::new(&gpu),
            ledger: Ledger::default(),
            shown_keys: Vec::new(),
            key_changes: 0,
            display: Display { presenter, texture, shown: None, bound: Vec::new(), target: 0 },
            timer: None,
            steps_drawn: Vec::new(),
            converter: None,
            gpu,
        })
    }

    /// Swaps the whole program. Buffers that the new one has too keep their texels, so an edit does not restart a simulation;
    /// new ones start as the project says, else as zeros. On an error the old program goes on.
    pub fn set_program(&mut self, program: Program) -> Result<(), EngineError> {
        let old = self.remake_targets(&program, self.size)?;
        self.uniforms = Uniforms::new(&self.gpu, program.draws.len(), program.knobs.len(), program.meshes());
        self.ledger = Ledger::new(&program.plan);
        self.steps_drawn.clear();
        self.timer = self.timer.is_some().then(|| timer(&self.gpu, Some(&program))).flatten();
        let values = program.knob_values.clone();
        self.program = Some(program);
        self.set_knobs(&values);
        self.rebind(&old);
        Ok(())
    }

    /// Values of the author's own uniforms from the next frame on; what `values` does not name stands at its default. Compiles
    /// nothing. Says whether anything is different now.
    pub fn set_knobs(&mut self, values: &KnobValues) -> bool {
        let knobs = self.program.as_ref().map_or(&[][..], |p| &p.knobs);
        let slots = knobs::block(knobs, values);
        if slots == self.uniforms.knob_slots {
            return false;
        }
        self.gpu.queue.write_buffer(&self.uniforms.knobs, 0, bytemuck::cast_slice(&slots));
        self.uniforms.knob_slots = slots;
        true
    }

    /// New canvas size. Every buffer keeps the overlap, texel for texel from the bottom left; the rest is as before frame 0. On an error
    /// everything stays as it was.
    pub fn resize(&mut self, width: u32, height: u32) -> Result<(), EngineError> {
        if (width, height) == self.size {
            return Ok(());
        }
        self.gpu.check_size("the canvas", width, height)?;
        let texture = Presenter::texture(&self.gpu, width, height)?;
        let mut old = Vec::new();
        if let Some(program) = self.program.take() {
            let result = self.remake_targets(&program, (width, height));
            self.program = Some(program);
            old = result?;
        }
        (self.size, self.display.texture) = ((width, height), texture);
        self.ledger.forget();
        self.rebind(&old);
        Ok(())
    }

    /// Every buffer as before frame 0: as the project says, else zeros.
    pub fn reset(&mut self) {
        let mut encoder =
            self.gpu.device.create_command_encoder(&wgpu::CommandEncoderDescriptor { label: Some("reset") });
        for target in &self.targets {
            target.clear(&self.gpu, &mut encoder, &self.mips);
        }
        self.gpu.queue.submit([encoder.finish()]);
        if let Some(program) = self.program.take() {
            self.fill_initial(&program);
            self.program = Some(program);
        }
        self.ledger.forget();
    }

    /// Texels of a pass, across and up.
    pub fn pass_size(&self, pass: &PassId) -> Option<(u32, u32)> {
        self.targets.iter().find(|t| t.id == *pass).map(Target::size)
    }

    /// Overwrites a texel of a pass's newest ones by NaN, in a format of floats; in any other by its largest value. For who asks
    /// how a project recovers. A place outside of the pass's texels is held inside.
    pub fn poison(&mut self, pass: &PassId, (x, y): (u32, u32)) -> Result<(), EngineError> {
        let target = self.targets.iter().find(|t| t.id == *pass);
        let target = target.ok_or_else(|| EngineError::NoSuchPass(pass.title()))?;
        let texture = target.newest();
        let bytes = texture.raw.format().block_copy_size(None).unwrap_or(4);
        // All bits set: an exponent of ones and a mantissa that is not zero.
        let place = (x.min(texture.width() - 1), y.min(texture.height() - 1));
        texture.write_texel(&self.gpu, place, &vec![0xff; bytes as usize]);
        if let Some(chain) = target.chains.get(target.front) {
            let mut encoder =
                self.gpu.device.create_command_encoder(&wgpu::CommandEncoderDescriptor { label: Some("poison") });
            self.mips.build(&self.gpu, &mut encoder, chain);
            self.gpu.queue.submit([encoder.finish()]);
        }
        self.ledger.forget();
        Ok(())
    }

    pub fn size(&self) -> (u32, u32) {
        self.size
    }

    pub fn gpu(&self) -> &Gpu {
        &self.gpu
    }

    /// The program that is running.
    pub fn program(&self) -> Option<&Program> {
        self.program.as_ref()
    }

    /// Measures the device's time of each pass from the next frame on, where it has timestamps. Off at first, as it costs a
    /// little in every frame. Says whether it can.
    pub fn set_timing(&mut self, on: bool) -> bool {
        self.timer = if on { timer(&self.gpu, self.program.as_ref()) } else { None };
        self.timer.is_some()
    }

    /// GPU times of the passes, all steps of each together, of the newest frame the device has finished, where it has timestamps. Does not wait.
    pub fn pass_times(&mut self) -> Option<Vec<PassTime>> {
        let draws = &self.program.as_ref()?.draws;
        let millis = self.timer.as_mut()?.newest(&self.gpu, draws.len())?;
        Some(draws.iter().zip(millis).map(|(d, gpu_millis)| PassTime { pass: d.id.clone(), gpu_millis }).collect())
    }

    /// The picture of a pass for a window: rgba8unorm, turned so that its first row is the top, values as display values.
    /// Made anew in [`Engine::draw`] for the pass chosen with [`Engine::show`]; black before that. A resize makes a new view.
    pub fn display(&self) -> &wgpu::TextureView {
        &self.display.texture.level_0
    }

    /// Chooses which pass [`Engine::display`] shows, from its newest texels on. Nothing is made for showing before the first
    /// call. A pass that is not drawn shows black.
    pub fn show(&mut self, pass: PassId) {
        self.display.shown = Some(pass);
        self.bind_display();
        let mut encoder =
            self.gpu.device.create_command_encoder(&wgpu::CommandEncoderDescriptor { label: Some("show") });
        let newest = self.targets.get(self.display.target).map_or(0, |t| t.front);
        match self.display.bound.get(newest) {
            Some(bound) => self.display.presenter.present(&self.gpu, &mut encoder, bound, &self.display.texture),
            None => self.display.texture.clear(&self.gpu, &mut encoder),
        }
        self.gpu.queue.submit([encoder.finish()]);
    }

    /// Reads a pass's newest texels back; waits for the device.
    pub fn read(&mut self, pass: &PassId) -> Result<Pixels, EngineError> {
        self.read_target(pass, 0)
    }

    /// As [`Engine::read`], of one of the pass's targets.
    pub fn read_target(&mut self, pass: &PassId, index: usize) -> Result<Pixels, EngineError> {
        if !self.targets.iter().any(|t| t.id == *pass) {
            return Err(EngineError::NoSuchPass(pass.title()));
        }
        let target = self.targets.iter().find(|t| t.id == *pass && t.index == index);
        let target = target.ok_or_else(|| EngineError::NoSuchTarget { pass: pass.title(), index })?;
        let newest = target.newest();
        let (width, height) = (newest.width(), newest.height());
        let texels = if newest.raw.format() == wgpu::TextureFormat::Rgba32Float {
            read_rgba32float(&self.gpu, newest)?
        } else {
            let converter = self.converter.get_or_insert_with(|| FloatConverter::new(&self.gpu));
            read_rgba32float(&self.gpu, &converter.convert(&self.gpu, newest)?)?
        };
        Ok(Pixels { width, height, texels })
    }

    /// Makes targets of `program` at `size`, and gives the present ones.
    fn remake_targets(&mut self, program: &Program, size: (u32, u32)) -> Result<Vec<Target>, EngineError> {
        let depth = |(compiled, draw): (&super::program::CompiledDraw, &crate::graph::Draw)| {
            let of = |_| {
                let (width, height) = program.plan.targets[draw.targets.start].size.of(size);
                depth_buffer(&self.gpu, &format!("depth of {}", compiled.id.title()), width, height)
            };
            compiled.camera.map(of).transpose()
        };
        let depths = program.draws.iter().zip(&program.plan.draws).map(depth).collect::<Result<_, _>>()?;
        let made = targets::make(&self.gpu, &mut self.mips, &program.plan, size)?;
        self.depths = depths;
        Ok(std::mem::replace(&mut self.targets, made))
    }

    /// Binds the targets, which hold what `old` held, and else what they hold before frame 0.
    fn rebind(&mut self, old: &[Target]) {
        if let Some(program) = self.program.take() {
            self.bindings = bind::make(&self.gpu, &program, &self.uniforms);
            let fill = |fill: &Option<_>, index| fill.as_deref().map(|f| FillBindings::new(self, f, index));
            let fills = program.draws.iter().enumerate().map(|(index, draw)| DrawFills {
                initial: fill(&draw.initial, index),
                boundary: fill(&draw.boundary, index),
            });
            self.fills = fills.collect();
            self.fill_initial(&program);
            self.program = Some(program);
        }
        for target in &mut self.targets {
            if let Some(before) = old.iter().find(|t| t.id == target.id && t.index == target.index) {
                target.take_over(&self.gpu, &self.mips, before);
            }
        }
        if let Some(shown) = self.display.shown.clone() {
            self.show(shown);
        }
    }

    fn bind_display(&mut self) {
        self.display.bound.clear();
        let shown = self.targets.iter().position(|t| Some(&t.id) == self.display.shown.as_ref());
        let size = shown.map_or(self.size, |i| self.targets[i].size());
        if (self.display.texture.width(), self.display.texture.height()) != size {
            match Presenter::texture(&self.gpu, size.0, size.1) {
                Ok(texture) => self.display.texture = texture,
                Err(error) => {
                    log::error!("the picture cannot be shown: {error}");
                    return;
                }
            }
        }
        if let Some(i) = shown {
            self.display.target = i;
            self.display.bound =
                self.targets[i].textures.iter().map(|t| self.display.presenter.bind(&self.gpu, t)).collect();
        }
    }
}

/// Room for every draw of a frame.
fn timer(gpu: &Gpu, program: Option<&Program>) -> Option<PassTimer> {
    let draws = program.map_or(1, |p| p.plan.draws_a_frame());
    PassTimer::new(gpu, u32::try_from(draws.max(1)).unwrap_or(u32::MAX))
}

impl Pixels {
    /// As a PNG shows them: clamped to 0..1, rounded to 8 bits, NaN as 0, the top row first. The one way from a picture to
    /// bytes: screenshots, `eddy render` and the golden tests share it.
    pub fn to_rgba8(&self) -> Vec<u8> {
        let mut bytes = Vec::with_capacity(self.texels.len() * 4);
        for row in self.texels.chunks_exact(self.width as usize).rev() {
            // `as` turns NaN into 0.
            bytes.extend(row.iter().flatten().map(|v| (v.clamp(0.0, 1.0) * 255.0 + 0.5) as u8));
        }
        bytes
    }
}
