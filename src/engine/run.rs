//! Frames: the loop that executes a plan.

use super::{
    FrameInputs, Program,
    bind::{self, DrawBindings, Stock, UNIFORM_STRIDE},
    targets::{self, Target},
};
use crate::{
    glsl::interface::UniformBlock,
    gpu::{Gpu, GpuError, MipMaker, PassTimer, Presenter, Texture, read_rgba32float},
    project::PassId,
};

/// Why a frame could not be drawn or read.
#[derive(Debug, thiserror::Error)]
pub enum EngineError {
    #[error(transparent)]
    Gpu(#[from] GpuError),
    #[error("the project has no pass {0}, or nothing reached it")]
    NoSuchPass(String),
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
    /// Passes drawn in this frame.
    pub passes_drawn: usize,
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
    gpu: Gpu,
    size: (u32, u32),
    program: Option<Program>,
    targets: Vec<Target>,
    bindings: Vec<DrawBindings>,
    uniforms: Uniforms,
    stock: Stock,
    mips: MipMaker,
    /// Which texture of a doubled target the next frame draws into.
    phase: usize,
    shown_keys: Vec<u8>,
    display: Display,
    timer: Option<PassTimer>,
}

/// All passes' uniform blocks in one buffer, written once a frame.
struct Uniforms {
    buffer: wgpu::Buffer,
    bytes: Vec<u8>,
}

impl Uniforms {
    fn new(gpu: &Gpu, passes: usize) -> Self {
        let bytes = vec![0; passes.max(1) * UNIFORM_STRIDE as usize];
        let buffer = gpu.device.create_buffer(&wgpu::BufferDescriptor {
            label: Some("uniforms"),
            size: bytes.len() as u64,
            usage: wgpu::BufferUsages::UNIFORM | wgpu::BufferUsages::COPY_DST,
            mapped_at_creation: false,
        });
        Self { buffer, bytes }
    }
}

/// The 8-bit picture a window shows.
struct Display {
    presenter: Presenter,
    texture: Texture,
    /// `None`: nobody looks.
    shown: Option<PassId>,
    /// The shown target's textures, by phase, bound for presenting.
    bound: Vec<wgpu::BindGroup>,
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
            bindings: Vec::new(),
            uniforms: Uniforms::new(&gpu, 0),
            stock: Stock::new(&gpu)?,
            mips: MipMaker::new(&gpu),
            phase: 0,
            shown_keys: Vec::new(),
            display: Display { presenter, texture, shown: None, bound: Vec::new() },
            timer: None,
            gpu,
        })
    }

    /// Swaps the whole program. Buffers that the new one has too keep their texels, so an edit does not restart a simulation;
    /// new ones start as zeros. On an error the old program goes on.
    pub fn set_program(&mut self, program: Program) -> Result<(), EngineError> {
        self.remake_targets(&program, self.size)?;
        self.uniforms = Uniforms::new(&self.gpu, program.draws.len());
        self.timer = self.timer.is_some().then(|| PassTimer::new(&self.gpu, program.draws.len() as u32)).flatten();
        self.program = Some(program);
        self.rebind();
        Ok(())
    }

    /// New canvas size. Every buffer keeps the overlap, texel for texel from the bottom left; the rest is 0. On an error
    /// everything stays as it was.
    pub fn resize(&mut self, width: u32, height: u32) -> Result<(), EngineError> {
        if (width, height) == self.size {
            return Ok(());
        }
        self.gpu.check_size("the canvas", width, height)?;
        let texture = Presenter::texture(&self.gpu, width, height)?;
        if let Some(program) = self.program.take() {
            let result = self.remake_targets(&program, (width, height));
            self.program = Some(program);
            result?;
        }
        (self.size, self.display.texture) = ((width, height), texture);
        self.rebind();
        Ok(())
    }

    /// Every buffer back to zeros, as before frame 0.
    pub fn reset(&mut self) {
        let mut encoder =
            self.gpu.device.create_command_encoder(&wgpu::CommandEncoderDescriptor { label: Some("reset") });
        for target in &self.targets {
            target.clear(&mut encoder, &self.mips);
        }
        self.gpu.queue.submit([encoder.finish()]);
    }

    /// Draws one frame. Does not wait for the device.
    pub fn draw(&mut self, inputs: &FrameInputs) -> Result<FrameStats, EngineError> {
        let Some(program) = &self.program else { return Ok(FrameStats::default()) };
        if self.shown_keys != inputs.keyboard.bytes() {
            self.stock.keyboard.write(&self.gpu, inputs.keyboard.bytes());
            self.shown_keys = inputs.keyboard.bytes().to_vec();
        }
        for (compiled, slot) in program.draws.iter().zip(self.uniforms.bytes.chunks_exact_mut(UNIFORM_STRIDE as usize))
        {
            let block = uniform_block(inputs, self.size, &compiled.channels);
            slot[..size_of::<UniformBlock>()].copy_from_slice(bytemuck::bytes_of(&block));
        }
        self.gpu.queue.write_buffer(&self.uniforms.buffer, 0, &self.uniforms.bytes);
        let mut encoder =
            self.gpu.device.create_command_encoder(&wgpu::CommandEncoderDescriptor { label: Some("frame") });
        if let Some(timer) = &mut self.timer {
            timer.begin(program.draws.len() as u32);
        }
        for (index, ((compiled, draw), bindings)) in
            program.draws.iter().zip(&program.plan.draws).zip(&self.bindings).enumerate()
        {
            let target = &self.targets[draw.target];
            let load =
                if draw.keeps_content { wgpu::LoadOp::Load } else { wgpu::LoadOp::Clear(wgpu::Color::TRANSPARENT) };
            let mut pass = encoder.begin_render_pass(&wgpu::RenderPassDescriptor {
                label: None,
                color_attachments: &[Some(wgpu::RenderPassColorAttachment {
                    view: &target.at(self.phase).level_0,
                    depth_slice: None,
                    resolve_target: None,
                    ops: wgpu::Operations { load, store: wgpu::StoreOp::Store },
                })],
                timestamp_writes: self.timer.as_ref().and_then(|t| t.writes(index as u32)),
                ..Default::default()
            });
            pass.set_pipeline(&compiled.pipeline.raw);
            pass.set_bind_group(crate::glsl::interface::UNIFORM_GROUP, &bindings.uniforms, &[]);
            pass.set_bind_group(crate::glsl::interface::CHANNEL_GROUP, &bindings.channels[self.phase], &[]);
            pass.draw(0..3, 0..1);
            drop(pass);
            if let Some(chain) = target.chain_at(self.phase) {
                self.mips.build(&mut encoder, chain);
            }
        }
        if let Some(timer) = &mut self.timer {
            timer.resolve(&mut encoder);
        }
        if !self.display.bound.is_empty() {
            let bound = &self.display.bound[self.phase % self.display.bound.len()];
            self.display.presenter.present(&mut encoder, bound, &self.display.texture);
        }
        self.gpu.queue.submit([encoder.finish()]);
        if let Some(timer) = &mut self.timer {
            timer.submitted();
        }
        self.phase = 1 - self.phase;
        self.gpu.take_trouble("a frame")?;
        Ok(FrameStats { passes_drawn: program.draws.len() })
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
        let passes = self.program.as_ref().map_or(0, |p| p.draws.len() as u32);
        self.timer = if on { PassTimer::new(&self.gpu, passes.max(1)) } else { None };
        self.timer.is_some()
    }

    /// GPU times of the passes of the newest frame the device has finished, where it has timestamps. Does not wait.
    pub fn pass_times(&mut self) -> Option<Vec<PassTime>> {
        let millis = self.timer.as_mut()?.newest(&self.gpu)?;
        let draws = &self.program.as_ref()?.draws;
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
        match self.display.bound.get((1 - self.phase) % self.display.bound.len().max(1)) {
            Some(bound) => self.display.presenter.present(&mut encoder, bound, &self.display.texture),
            None => self.display.texture.clear(&mut encoder),
        }
        self.gpu.queue.submit([encoder.finish()]);
    }

    /// Reads a pass's newest texels back; waits for the device.
    pub fn read(&mut self, pass: &PassId) -> Result<Pixels, EngineError> {
        let target = self.targets.iter().find(|t| t.id == *pass).ok_or(EngineError::NoSuchPass(pass.title()))?;
        let texels = read_rgba32float(&self.gpu, target.at(1 - self.phase))?;
        Ok(Pixels { width: self.size.0, height: self.size.1, texels })
    }

    /// Targets of `program` at `size`, holding what the present ones hold.
    fn remake_targets(&mut self, program: &Program, size: (u32, u32)) -> Result<(), EngineError> {
        let old = std::mem::take(&mut self.targets);
        match targets::make(&self.gpu, &mut self.mips, &program.plan, size, old, self.phase) {
            Ok(made) => self.targets = made,
            Err((error, old)) => {
                self.targets = old;
                return Err(error.into());
            }
        }
        Ok(())
    }

    fn rebind(&mut self) {
        if let Some(program) = &self.program {
            self.bindings = bind::make(&self.gpu, &self.stock, program, &self.targets, &self.uniforms.buffer);
        }
        if let Some(shown) = self.display.shown.clone() {
            self.show(shown);
        }
    }

    fn bind_display(&mut self) {
        let shown = self.targets.iter().find(|t| Some(&t.id) == self.display.shown.as_ref());
        self.display.bound = shown.map_or(Vec::new(), |target| {
            target.textures.iter().map(|t| self.display.presenter.bind(&self.gpu, t)).collect()
        });
    }
}

fn uniform_block(
    inputs: &FrameInputs,
    (width, height): (u32, u32),
    channels: &[super::program::BoundChannel; 4],
) -> UniformBlock {
    let canvas = [width as f32, height as f32, 1.0];
    let resolution = |c: &super::program::BoundChannel| if c.is_canvas_sized { canvas } else { c.resolution };
    UniformBlock {
        resolution: canvas,
        time: inputs.time_secs as f32,
        mouse: inputs.mouse,
        date: inputs.date,
        time_delta: inputs.time_delta_secs,
        frame_rate: inputs.frame_rate,
        sample_rate: 44100.0,
        frame: inputs.frame,
        channel_time: [[0.0; 4]; 4],
        channel_resolution: std::array::from_fn(|i| {
            let [x, y, z] = resolution(&channels[i]);
            [x, y, z, 0.0]
        }),
        time_offset: 0.0,
        sample_offset: 0,
        pad: [0; 2],
        channel_loaded: std::array::from_fn(|i| i32::from(resolution(&channels[i])[0] > 0.0)),
    }
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
