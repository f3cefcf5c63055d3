//! A frame: the loop that executes a plan. The only place where passes are encoded, and where the time of each draw is
//! taken.

use super::{
    EngineError, FrameInputs, FrameStats, PassTime, Program,
    bind::draw_fill,
    display::Display,
    host,
    inspect::Capture,
    pipelines::StagePipeline,
    program::DrawBody,
    running::{RemainingRows, Running},
    shared::Shared,
    sound, uniforms,
};
use eddy_glsl::interface::{CHANNEL_GROUP, UNIFORM_GROUP};
use eddy_gpu::Gpu;
use eddy_graph::Draw;
use eddy_project::{Boundary, PassId, Region};

/// The value of a probe that never was there.
pub(super) const NO_VALUE: wgpu::Color = wgpu::Color { r: f64::NAN, g: f64::NAN, b: f64::NAN, a: f64::NAN };

/// The way in which a frame is handed to the device.
pub(super) enum DrawMode<'a, 'b> {
    /// All of it at once.
    Whole,
    /// Each draw by itself, and timed.
    Watched(&'a mut Watch<'b>),
    /// All of it, and what one pass reads is taken before it is drawn.
    Inspected(&'a mut Capture<'b>),
    /// All but a last draw that can be done in pieces, which [`Running::draw_remaining`] does.
    Divided,
    /// The draws that frames to come depend on.
    Lasting,
}

/// Hands in what is encoded, and waits for it.
fn flush(gpu: &Gpu, encoder: &mut wgpu::CommandEncoder) -> Result<(), EngineError> {
    let descriptor = wgpu::CommandEncoderDescriptor { label: Some("a pass of a frame") };
    let full = std::mem::replace(encoder, gpu.device.create_command_encoder(&descriptor));
    gpu.queue.submit([full.finish()]);
    Ok(gpu.wait()?)
}

impl Running {
    /// Draws one frame, and the picture that a display shows.
    pub fn draw(
        &mut self,
        shared: &Shared,
        display: Option<&Display>,
        inputs: &FrameInputs,
        mut mode: DrawMode<'_, '_>,
    ) -> Result<FrameStats, EngineError> {
        self.drop_remaining();
        let mut off = self.turn_off(shared);
        if matches!(mode, DrawMode::Lasting) {
            off.iter_mut().zip(&self.lasting).for_each(|(off, lasts)| *off |= !lasts);
        }
        let gpu = &shared.gpu;
        self.program.externals.iter_mut().for_each(|external| external.update(gpu, inputs));
        self.set_uniforms(gpu, inputs);
        // The same at every step.
        let reads: Vec<Vec<u8>> = (0..self.program.draws.len()).map(|index| self.inputs_of(index)).collect();
        let mut encoder = gpu.device.create_command_encoder(&wgpu::CommandEncoderDescriptor { label: Some("frame") });
        // Stamps of a frame in pieces would not be of one submission.
        let is_in_pieces = matches!(mode, DrawMode::Watched(_) | DrawMode::Divided);
        if let Some(timer) = self.timer.as_mut().filter(|_| !is_in_pieces) {
            timer.begin();
        }
        let left_over = if matches!(mode, DrawMode::Divided) { self.divisible_draw() } else { None };
        if let DrawMode::Watched(watch) = &mut mode {
            // What was handed in before is not this frame's.
            flush(gpu, &mut encoder)?;
            let began = watch.now();
            flush(gpu, &mut encoder)?;
            watch.set_floor(began);
        }
        self.steps_drawn.clear();
        self.steps_drawn.resize(self.program.draws.len(), 0);
        let mut stats = FrameStats::default();
        for run in 0..self.program.plan.runs.len() {
            for _ in 0..self.program.plan.runs[run].steps {
                for index in self.program.plan.runs[run].draws.clone().filter(|index| !off[*index]) {
                    if let DrawMode::Inspected(capture) = &mut mode
                        && capture.wants(&self.program.draws[index])
                    {
                        flush(gpu, &mut encoder)?;
                        capture.take(self, shared, index)?;
                    }
                    if self.is_tiled(index) {
                        stats.passes_drawn += 1;
                        continue;
                    }
                    if !self.is_due(index, &reads[index], &mut stats) {
                        continue;
                    }
                    self.steps_drawn[index] += 1;
                    if left_over == Some(index) {
                        self.rest = Some(RemainingRows { draw: index, row: 0 });
                        gpu.queue.submit([encoder.finish()]);
                        return Ok(stats);
                    }
                    let DrawMode::Watched(watch) = &mut mode else {
                        self.encode(shared, &mut encoder, index, None);
                        continue;
                    };
                    let began = watch.now();
                    self.encode(shared, &mut encoder, index, None);
                    flush(gpu, &mut encoder)?;
                    watch.add(index, began);
                }
            }
        }
        if let Some(timer) = &mut self.timer {
            timer.resolve(&mut encoder);
        }
        if let Some(display) = display {
            display.present(gpu, &mut encoder, &self.targets);
        }
        gpu.queue.submit([encoder.finish()]);
        if let Some(timer) = &mut self.timer {
            timer.submitted();
        }
        Ok(stats)
    }

    /// Does the draw that [`DrawMode::Divided`] has left over, so many rows at a time, and waits for each. Before each,
    /// `goes_on` is asked. Says whether all is drawn; if not, another call draws what is left.
    pub fn draw_remaining(
        &mut self,
        shared: &Shared,
        display: &Display,
        rows: u32,
        goes_on: &mut dyn FnMut() -> bool,
    ) -> Result<bool, EngineError> {
        let gpu = &shared.gpu;
        while let Some(RemainingRows { draw, row }) = self.rest {
            if !goes_on() {
                return Ok(false);
            }
            let (width, height) = self.targets[self.program.plan.draws[draw].targets.start].size();
            let end = row.saturating_add(rows.max(1)).min(height);
            let part = Region { x: 0, y: row, width, height: end - row };
            let descriptor = wgpu::CommandEncoderDescriptor { label: Some("rows of a frame") };
            let mut encoder = gpu.device.create_command_encoder(&descriptor);
            self.encode(shared, &mut encoder, draw, Some(part));
            self.rest = (end < height).then_some(RemainingRows { draw, row: end });
            if self.rest.is_none() {
                display.present(gpu, &mut encoder, &self.targets);
            }
            gpu.queue.submit([encoder.finish()]);
            gpu.wait()?;
        }
        Ok(true)
    }

    /// Draws a tile of the picture of the pass that is drawn in tiles: `size` of its pixels from `origin` on, into the
    /// first texels of its target, with the inputs of the newest frame. Before each part of it, `rows` says how many rows
    /// are drawn at once. Waits for each part.
    pub fn draw_tile(
        &mut self,
        shared: &Shared,
        (origin, size): ((u32, u32), (u32, u32)),
        rows: &mut dyn FnMut() -> u32,
    ) -> Result<(), EngineError> {
        let Some(tiled) = self.program.plan.tiled else { return Ok(()) };
        let gpu = &shared.gpu;
        self.uniforms.set_tile_origin(tiled.draw, origin);
        self.uniforms.write(gpu);
        let (mut y, width) = (0, size.0);
        while y < size.1 {
            // Of whole blocks of the pixels that a device shades together.
            let height = rows().max(1).next_multiple_of(4).min(size.1 - y);
            let descriptor = wgpu::CommandEncoderDescriptor { label: Some("a tile") };
            let mut encoder = gpu.device.create_command_encoder(&descriptor);
            self.encode(shared, &mut encoder, tiled.draw, Some(Region { x: 0, y, width, height }));
            gpu.queue.submit([encoder.finish()]);
            gpu.wait()?;
            y += height;
        }
        Ok(())
    }

    fn is_tiled(&self, draw: usize) -> bool {
        self.program.plan.tiled.is_some_and(|tiled| tiled.draw == draw)
    }

    /// Returns the size of the picture of a draw, which in tiles is more than that of its target.
    fn picture_size(&self, draw: usize) -> (u32, u32) {
        match self.program.plan.tiled.filter(|tiled| tiled.draw == draw) {
            Some(tiled) => tiled.size.of(self.canvas),
            None => self.targets[self.program.plan.draws[draw].targets.start].size(),
        }
    }

    fn divisible_draw(&self) -> Option<usize> {
        let is_screen = |index: &usize| matches!(self.program.draws[*index].body, DrawBody::Screen(_));
        self.program.plan.divisible_draw().filter(is_screen)
    }

    /// Writes the uniforms of every draw.
    fn set_uniforms(&mut self, gpu: &Gpu, inputs: &FrameInputs) {
        let dialect = self.program.dialect;
        self.uniforms.set_host_uniforms(gpu, &host::values(dialect, inputs, self.canvas));
        for (index, (compiled, _)) in self.program.planned_draws().enumerate() {
            let own = self.picture_size(index);
            let mut block = uniforms::block(inputs, own, self.canvas, &compiled.channels);
            host::adapt(dialect, &mut block);
            if compiled.id == PassId::Sound {
                sound::set_offsets(&mut block, inputs);
            }
            self.uniforms.set(index, self.program.plan.layers(index), &block);
            let Some(meshes) = compiled.body.meshes() else { continue };
            for (n, (_, mesh)) in meshes.programs.iter().enumerate() {
                self.uniforms.set_mesh(meshes.first + n, &mesh.block(&meshes.camera, inputs, own, self.canvas));
            }
        }
        self.uniforms.write(gpu);
    }

    /// Returns everything a draw reads that is no target; for [`eddy_graph::Changes::must_draw`].
    fn inputs_of(&self, index: usize) -> Vec<u8> {
        let (compiled, draw) = (&self.program.draws[index], &self.program.plan.draws[index]);
        let mut read = Vec::new();
        if draw.is_cacheable {
            self.uniforms.add_read_by(index, compiled, &mut read);
            for external in compiled.channels.iter().filter_map(|channel| channel.external.as_ref()) {
                read.extend(self.program.externals[external.index].version.to_le_bytes());
            }
        }
        read
    }

    /// Says whether a draw is to be done: it is of some texels, and something that it reads has changed. The answer yes
    /// counts as done.
    fn is_due(&mut self, index: usize, inputs: &[u8], stats: &mut FrameStats) -> bool {
        let Self { program, targets, changes, .. } = self;
        let draw = &program.plan.draws[index];
        let size = targets[draw.targets.start].size();
        let texels = match draw.region {
            None => u64::from(size.0) * u64::from(size.1),
            Some(region) => match region.within(size) {
                Some(region) => u64::from(region.width) * u64::from(region.height),
                None => return false,
            },
        };
        let texels = texels * u64::from(program.plan.layers(index));
        if !changes.must_draw(index, draw, inputs) {
            stats.passes_cached += 1;
            let bytes = draw.all_targets().map(|target| program.plan.targets[target].format.bytes());
            stats.bytes_cached += texels * bytes.sum::<u64>();
            return false;
        }
        stats.passes_drawn += 1;
        true
    }

    /// Encodes one draw, of all texels or of some; of a cube all faces.
    fn encode(&mut self, shared: &Shared, encoder: &mut wgpu::CommandEncoder, index: usize, part: Option<Region>) {
        for layer in 0..self.program.plan.layers(index) {
            self.encode_layer(shared, encoder, (index, layer), part);
        }
        let draw = &self.program.plan.draws[index];
        for target in &mut self.targets[draw.targets.clone()] {
            target.front = target.back();
            if let Some(chain) = target.chains.get(target.front) {
                shared.mips.build(&shared.gpu, encoder, chain);
            }
        }
    }

    fn encode_layer(
        &mut self,
        shared: &Shared,
        encoder: &mut wgpu::CommandEncoder,
        (index, layer): (usize, u32),
        part: Option<Region>,
    ) {
        let Self { program, targets, depths, bindings, timer, .. } = self;
        let (compiled, draw) = (&program.draws[index], &program.plan.draws[index]);
        let size = targets[draw.targets.start].size();
        let (uniforms, channels) = bindings.draws[index].groups(shared, compiled, draw, targets);
        for target in &targets[draw.targets.clone()] {
            if draw.region.is_some() && target.back() != target.front {
                target.newest().copy_overlap(encoder, &target.textures[target.back()]);
            }
        }
        let attach = |index: usize| {
            let load = match draw.beside {
                // What is discarded has no value, nor what lies outside of the region.
                Some(beside) if beside == index && draw.keeps_content => wgpu::LoadOp::Clear(NO_VALUE),
                Some(beside) if beside == index => shared.gpu.load_what_is_overwritten(),
                _ if part.is_some() => wgpu::LoadOp::Load,
                _ => load_op(&shared.gpu, draw, &compiled.body),
            };
            Some(targets[index].textures[targets[index].back()].layer_attachment(layer, load))
        };
        let attachments: Vec<_> = draw.all_targets().map(attach).collect();
        let depth = depths.get(index).and_then(Option::as_ref);
        let descriptor = wgpu::RenderPassDescriptor {
            label: None,
            color_attachments: &attachments,
            depth_stencil_attachment: depth.map(|view| wgpu::RenderPassDepthStencilAttachment {
                view,
                depth_ops: Some(wgpu::Operations { load: wgpu::LoadOp::Clear(1.0), store: wgpu::StoreOp::Discard }),
                stencil_ops: None,
            }),
            timestamp_writes: timer.as_mut().and_then(|t| t.writes(index)),
            ..Default::default()
        };
        let boundary = bindings.fills[index].boundary.as_mut().zip(compiled.boundary.as_ref());
        shared.gpu.pass(encoder, descriptor, |pass| {
            // Row 0 is the bottom, for a scissor too.
            if let Some(region) = draw.region.and_then(|r| r.within(size)) {
                pass.set_scissor_rect(region.x, region.y, region.width, region.height);
            }
            if let Some(part) = part {
                pass.set_scissor_rect(part.x, part.y, part.width, part.height);
            }
            pass.set_bind_group(CHANNEL_GROUP, channels, &[]);
            let begin = |pass: &mut wgpu::RenderPass<'_>, program: &StagePipeline, n: usize| {
                pass.set_pipeline(&program.pipeline.raw);
                pass.set_bind_group(UNIFORM_GROUP, &uniforms[n], &[]);
            };
            match &compiled.body {
                DrawBody::Screen(program) => {
                    begin(pass, program, layer as usize);
                    pass.draw(0..3, 0..1);
                }
                DrawBody::Meshes(meshes) => {
                    for (n, (program, mesh)) in meshes.programs.iter().enumerate() {
                        begin(pass, program, n);
                        pass.set_vertex_buffer(0, mesh.buffers.vertices.slice(..));
                        pass.set_index_buffer(mesh.buffers.indices.slice(..), wgpu::IndexFormat::Uint32);
                        pass.draw_indexed(0..mesh.buffers.count, 0, 0..1);
                    }
                }
            }
            if let (Some((bound, fill)), Some(width)) = (boundary, draw.boundary) {
                for [x, y, width, height] in Boundary::rectangles(width, size) {
                    pass.set_scissor_rect(x, y, width, height);
                    draw_fill(bound, shared, fill, pass);
                }
            }
        });
    }
}

/// Returns what the targets of a draw hold as it begins.
fn load_op(gpu: &Gpu, draw: &Draw, body: &DrawBody) -> wgpu::LoadOp<wgpu::Color> {
    match body {
        _ if draw.keeps_content => wgpu::LoadOp::Load,
        // The triangle covers all, and nothing of it is discarded.
        DrawBody::Screen(_) => gpu.load_what_is_overwritten(),
        DrawBody::Meshes(_) => wgpu::LoadOp::Clear(wgpu::Color::TRANSPARENT),
    }
}

/// A clock, and what it has said of each draw.
pub(super) struct Watch<'a> {
    /// Gives milliseconds since any moment.
    now: &'a mut dyn FnMut() -> f64,
    /// The time of handing in nothing and waiting for it.
    floor: f64,
    /// The milliseconds of each draw, all steps together.
    millis: Vec<f64>,
}

impl<'a> Watch<'a> {
    pub fn new(now: &'a mut dyn FnMut() -> f64, program: &Program) -> Self {
        Self { now, floor: 0.0, millis: vec![0.0; program.draws.len()] }
    }

    pub fn now(&mut self) -> f64 {
        (self.now)()
    }

    /// Takes the time since `began` for that of handing in nothing.
    pub fn set_floor(&mut self, began: f64) {
        self.floor = self.now() - began;
    }

    /// Adds what a draw took since `began`.
    pub fn add(&mut self, draw: usize, began: f64) {
        let millis = self.now() - began - self.floor;
        if let Some(sum) = self.millis.get_mut(draw) {
            *sum += millis.max(0.0);
        }
    }

    /// Returns the time of each pass.
    pub fn times(&self, program: &Program) -> Vec<PassTime> {
        let times = program.draws.iter().zip(&self.millis);
        times.map(|(draw, &gpu_millis)| PassTime { pass: draw.id.clone(), gpu_millis }).collect()
    }
}
