//! Encoding of render passes. All passes use this, because of a driver bug.

use super::Gpu;

impl Gpu {
    /// Returns the load operation for a colour target that a pass overwrites completely. It is cleared, which is free
    /// on devices that draw tile by tile; on lavapipe, where a clear is a separate draw, it is loaded.
    pub fn load_op_dont_care(&self) -> wgpu::LoadOp<wgpu::Color> {
        if self.fences.is_some() { wgpu::LoadOp::Load } else { wgpu::LoadOp::Clear(wgpu::Color::TRANSPARENT) }
    }

    /// Encodes a render pass with the commands of `draw`, which must not use occlusion queries.
    pub fn pass(
        &self,
        encoder: &mut wgpu::CommandEncoder,
        descriptor: wgpu::RenderPassDescriptor<'_>,
        draw: impl FnOnce(&mut wgpu::RenderPass<'_>),
    ) {
        let Some(keeper) = &self.fences else {
            draw(&mut encoder.begin_render_pass(&descriptor));
            return;
        };
        let is_cleared = |a: &wgpu::RenderPassColorAttachment<'_>| matches!(a.ops.load, wgpu::LoadOp::Clear(_));
        let is_cleared_first = descriptor.color_attachments.iter().flatten().any(is_cleared);
        let descriptor = wgpu::RenderPassDescriptor { occlusion_query_set: Some(&keeper.queries), ..descriptor };
        let mut pass = encoder.begin_render_pass(&descriptor);
        if is_cleared_first {
            keeper.hold(&mut pass);
        }
        draw(&mut pass);
        keeper.hold(&mut pass);
    }
}
