//! A frame: the loop that executes a plan. The only place where passes are encoded.

use super::{
    Engine, EngineError, FrameInputs, FrameStats, PassTime,
    costs::Watch,
    fill::FillParts,
    program::{CompiledDraw, Program},
    uniforms,
};
use crate::{
    glsl::interface::{CHANNEL_GROUP, UNIFORM_GROUP},
    graph::{Draw, Source},
    project::Boundary,
};

impl Engine {
    /// Draws one frame. Does not wait for the device.
    pub fn draw(&mut self, inputs: &FrameInputs) -> Result<FrameStats, EngineError> {
        let Some(program) = self.program.take() else { return Ok(FrameStats::default()) };
        let stats = self.draw_program(&program, inputs, None);
        self.program = Some(program);
        let stats = stats?;
        self.gpu.take_trouble("a frame")?;
        Ok(stats)
    }

    /// As [`Engine::draw`], with the same picture, but hands in each pass by itself and waits for it: how long each takes can then
    /// be told where the device has no timestamps. `now` gives milliseconds since any moment. A frame takes longer so.
    pub fn draw_waited(
        &mut self,
        inputs: &FrameInputs,
        now: &mut dyn FnMut() -> f64,
    ) -> Result<(FrameStats, Vec<PassTime>), EngineError> {
        let Some(program) = self.program.take() else { return Ok(Default::default()) };
        let mut watch = Watch { now, floor: 0.0, millis: vec![0.0; program.draws.len()] };
        let stats = self.draw_program(&program, inputs, Some(&mut watch));
        let times = watch.times(program.draws.iter().map(|d| &d.id));
        self.program = Some(program);
        let stats = stats?;
        self.gpu.take_trouble("a frame")?;
        Ok((stats, times))
    }

    /// Hands in what is encoded, and waits for it.
    fn flush(&self, encoder: &mut wgpu::CommandEncoder) -> Result<(), EngineError> {
        let descriptor = wgpu::CommandEncoderDescriptor { label: Some("a pass of a frame") };
        let full = std::mem::replace(encoder, self.gpu.device.create_command_encoder(&descriptor));
        self.gpu.queue.submit([full.finish()]);
        Ok(self.gpu.wait()?)
    }

    fn draw_program(
        &mut self,
        program: &Program,
        inputs: &FrameInputs,
        mut watch: Option<&mut Watch<'_>>,
    ) -> Result<FrameStats, EngineError> {
        if self.shown_keys != inputs.keyboard.bytes() {
            self.stock.keyboard.write(&self.gpu, inputs.keyboard.bytes());
            self.shown_keys = inputs.keyboard.bytes().to_vec();
            self.key_changes += 1;
        }
        for (index, (compiled, draw)) in program.draws.iter().zip(&program.plan.draws).enumerate() {
            let own = self.targets[draw.targets.start].size();
            self.uniforms.set(index, &uniforms::block(inputs, own, self.size, &compiled.channels));
            let Some(camera) = &compiled.camera else { continue };
            for (n, mesh) in compiled.programs.iter().filter_map(|p| p.mesh.as_ref()).enumerate() {
                let block = mesh.block(camera, inputs, own, self.size);
                self.uniforms.set_geometry(compiled.first_mesh + n, &block);
            }
        }
        self.uniforms.write(&self.gpu);
        // The same at every step.
        let outside: Vec<Vec<u8>> = program
            .draws
            .iter()
            .zip(&program.plan.draws)
            .enumerate()
            .map(|(index, (compiled, draw))| self.outside(index, compiled, draw))
            .collect();
        let mut encoder =
            self.gpu.device.create_command_encoder(&wgpu::CommandEncoderDescriptor { label: Some("frame") });
        // Stamps of a frame in pieces would not be of one submission.
        if let Some(timer) = self.timer.as_mut().filter(|_| watch.is_none()) {
            timer.begin();
        }
        if let Some(watch) = &mut watch {
            // What was handed in before is not this frame's.
            self.flush(&mut encoder)?;
            let began = (watch.now)();
            self.flush(&mut encoder)?;
            watch.floor = (watch.now)() - began;
        }
        self.steps_drawn.clear();
        self.steps_drawn.resize(program.draws.len(), 0);
        let mut stats = FrameStats::default();
        for run in &program.plan.runs {
            for _ in 0..run.steps {
                for index in run.draws.clone() {
                    let began = watch.as_mut().map(|watch| (watch.now)());
                    let is_drawn = self.step(&mut encoder, program, index, &outside[index], &mut stats);
                    self.steps_drawn[index] += u32::from(is_drawn);
                    if let (Some(watch), Some(began), true) = (&mut watch, began, is_drawn) {
                        self.flush(&mut encoder)?;
                        watch.add(index, began);
                    }
                }
            }
        }
        if let Some(timer) = &mut self.timer {
            timer.resolve(&mut encoder);
        }
        let newest = self.targets.get(self.display.target).map_or(0, |t| t.front);
        if let Some(bound) = self.display.bound.get(newest) {
            self.display.presenter.present(&self.gpu, &mut encoder, bound, &self.display.texture);
        }
        self.gpu.queue.submit([encoder.finish()]);
        if let Some(timer) = &mut self.timer {
            timer.submitted();
        }
        Ok(stats)
    }

    /// Everything a draw reads that is no target; for [`crate::graph::Ledger::is_due`].
    fn outside(&self, index: usize, compiled: &CompiledDraw, draw: &Draw) -> Vec<u8> {
        if !draw.can_rest {
            return Vec::new();
        }
        let mut seen = self.uniforms.seen_by(index, compiled);
        if draw.reads.iter().flatten().any(|r| r.source == Source::Keyboard) {
            seen.extend(self.key_changes.to_le_bytes());
        }
        seen
    }

    /// Does one draw, if it is due; whether it was.
    fn step(
        &mut self,
        encoder: &mut wgpu::CommandEncoder,
        program: &Program,
        index: usize,
        outside: &[u8],
        stats: &mut FrameStats,
    ) -> bool {
        let (compiled, draw) = (&program.draws[index], &program.plan.draws[index]);
        let size = self.targets[draw.targets.start].size();
        let texels = match draw.region {
            None => u64::from(size.0) * u64::from(size.1),
            Some(region) => match region.within(size) {
                Some(region) => u64::from(region.width) * u64::from(region.height),
                None => return false,
            },
        };
        if !self.ledger.is_due(index, draw, outside) {
            stats.passes_rested += 1;
            let bytes = program.plan.targets[draw.targets.clone()].iter().map(|t| t.format.bytes());
            stats.bytes_rested += texels * bytes.sum::<u64>();
            return false;
        }
        stats.passes_drawn += 1;
        let (uniforms, channels) = self.bindings[index].groups(&self.gpu, &self.stock, compiled, draw, &self.targets);
        let targets = &self.targets[draw.targets.clone()];
        for target in targets {
            if draw.region.is_some() && target.back() != target.front {
                target.newest().copy_overlap(encoder, &target.textures[target.back()]);
            }
        }
        let load = match compiled.camera {
            _ if draw.keeps_content => wgpu::LoadOp::Load,
            // The triangle covers all, and nothing of it is discarded.
            None => self.gpu.load_what_is_overwritten(),
            Some(_) => wgpu::LoadOp::Clear(wgpu::Color::TRANSPARENT),
        };
        let attachments: Vec<_> = targets
            .iter()
            .map(|target| {
                Some(wgpu::RenderPassColorAttachment {
                    view: &target.textures[target.back()].level_0,
                    depth_slice: None,
                    resolve_target: None,
                    ops: wgpu::Operations { load, store: wgpu::StoreOp::Store },
                })
            })
            .collect();
        let depth = self.depths.get(index).and_then(Option::as_ref);
        let descriptor = wgpu::RenderPassDescriptor {
            label: None,
            color_attachments: &attachments,
            depth_stencil_attachment: depth.map(|view| wgpu::RenderPassDepthStencilAttachment {
                view,
                depth_ops: Some(wgpu::Operations { load: wgpu::LoadOp::Clear(1.0), store: wgpu::StoreOp::Discard }),
                stencil_ops: None,
            }),
            timestamp_writes: self.timer.as_mut().and_then(|t| t.writes(index)),
            ..Default::default()
        };
        let boundary = self.fills.get_mut(index).and_then(|f| f.boundary.as_mut()).zip(compiled.boundary.as_ref());
        let parts = FillParts { gpu: &self.gpu, stock: &self.stock };
        self.gpu.pass(encoder, descriptor, |pass| {
            // Row 0 is the bottom, for a scissor too.
            if let Some(region) = draw.region.and_then(|r| r.within(size)) {
                pass.set_scissor_rect(region.x, region.y, region.width, region.height);
            }
            for (program, uniforms) in compiled.programs.iter().zip(uniforms) {
                pass.set_pipeline(&program.pipeline.raw);
                pass.set_bind_group(UNIFORM_GROUP, uniforms, &[]);
                pass.set_bind_group(CHANNEL_GROUP, channels, &[]);
                match &program.mesh {
                    None => pass.draw(0..3, 0..1),
                    Some(mesh) => {
                        pass.set_vertex_buffer(0, mesh.buffers.vertices.slice(..));
                        pass.set_index_buffer(mesh.buffers.indices.slice(..), wgpu::IndexFormat::Uint32);
                        pass.draw_indexed(0..mesh.buffers.count, 0, 0..1);
                    }
                }
            }
            if let (Some((bound, fill)), Some(width)) = (boundary, draw.boundary) {
                for [x, y, width, height] in Boundary::rectangles(width, size) {
                    pass.set_scissor_rect(x, y, width, height);
                    bound.draw(&parts, fill, pass);
                }
            }
        });
        for target in &mut self.targets[draw.targets.clone()] {
            target.front = target.back();
            if let Some(chain) = target.chains.get(target.front) {
                self.mips.build(&self.gpu, encoder, chain);
            }
        }
        true
    }
}
