//! Encoding a render pass: the one way, because of a fault of one driver.

use super::Gpu;

impl Gpu {
    /// Returns how a colour target begins of which a pass writes every texel. It is cleared, which costs nothing where
    /// the device draws tile by tile; lavapipe, which draws a clearing by itself, begins with what was there.
    pub fn load_what_is_overwritten(&self) -> wgpu::LoadOp<wgpu::Color> {
        if self.fences.is_some() { wgpu::LoadOp::Load } else { wgpu::LoadOp::Clear(wgpu::Color::TRANSPARENT) }
    }

    /// Encodes a render pass of what `draw` draws; it has no occlusion queries for itself.
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
        let begins_cleared = descriptor.color_attachments.iter().flatten().any(is_cleared);
        let descriptor = wgpu::RenderPassDescriptor { occlusion_query_set: Some(&keeper.queries), ..descriptor };
        let mut pass = encoder.begin_render_pass(&descriptor);
        if begins_cleared {
            keeper.hold(&mut pass);
        }
        draw(&mut pass);
        keeper.hold(&mut pass);
    }
}
