//! Encodes one draw. The only place where passes are encoded.

use super::{bind::draw_fill, pipelines::StagePipeline, program::DrawBody, running::Running, shared::Shared};
use eddy_glsl::interface::{CHANNEL_GROUP, UNIFORM_GROUP};
use eddy_gpu::Gpu;
use eddy_graph::Draw;
use eddy_project::{Boundary, Region};

/// The value of a probe that was not evaluated.
pub(super) const NO_VALUE: wgpu::Color = wgpu::Color { r: f64::NAN, g: f64::NAN, b: f64::NAN, a: f64::NAN };

impl Running {
    /// Encodes a layer of a draw: all of its texels, or those of `part`.
    pub(crate) fn encode(
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
                target.newest().copy_overlap(&shared.gpu, encoder, &target.textures[target.back()]);
            }
        }
        let attach = |index: usize| {
            let load = match draw.extra_target {
                // Discarded pixels, and those outside the region, have no value.
                Some(beside) if beside == index && draw.keeps_content => wgpu::LoadOp::Clear(NO_VALUE),
                Some(beside) if beside == index => shared.gpu.load_op_dont_care(),
                // The first part clears the whole target.
                _ if part.is_some_and(|part| draw.clear.is_none() || (part.x, part.y) != (0, 0)) => wgpu::LoadOp::Load,
                _ => load_op(&shared.gpu, draw),
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
            // Row 0 is the bottom, for a scissor rectangle too.
            if let Some(region) = draw.region.and_then(|r| r.within(size)) {
                pass.set_scissor_rect(region.x, region.y, region.width, region.height);
            }
            if let Some(part) = part {
                pass.set_scissor_rect(part.x, part.y, part.width, part.height);
            }
            pass.set_bind_group(CHANNEL_GROUP, channels, &[]);
            let set_state = |pass: &mut wgpu::RenderPass<'_>, program: &StagePipeline, n: usize| {
                pass.set_pipeline(&program.pipeline.raw);
                pass.set_bind_group(UNIFORM_GROUP, &uniforms[n], &[]);
            };
            match &compiled.body {
                DrawBody::Screen(program) => {
                    set_state(pass, program, layer as usize);
                    pass.draw(0..3, 0..1);
                }
                DrawBody::Meshes(meshes) => {
                    for (n, (program, mesh)) in meshes.programs.iter().enumerate() {
                        set_state(pass, program, n);
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

/// Returns the load operation of the targets of a draw.
fn load_op(gpu: &Gpu, draw: &Draw) -> wgpu::LoadOp<wgpu::Color> {
    if draw.keeps_content {
        wgpu::LoadOp::Load
    } else if let Some(colour) = draw.clear {
        let [r, g, b, a] = colour.map(f64::from);
        wgpu::LoadOp::Clear(wgpu::Color { r, g, b, a })
    } else {
        // The triangle covers every texel, and none is discarded.
        gpu.load_op_dont_care()
    }
}
