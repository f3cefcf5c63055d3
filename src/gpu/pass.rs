//! Encoding a render pass: the one way, because of a fault of one driver.

use super::Gpu;
use std::sync::{
    Arc,
    atomic::{AtomicU32, Ordering},
};

/// Passes until a query is written again. Among so many there are always some that wait for others, and by then the threads
/// that draw have long left the first.
const QUERIES: u32 = 256;

/// Keeps lavapipe from freeing a fence while one of its threads is inside it, which spoils the heap.
///
/// A thread that has drawn its part of a pass counts up the pass's fence under a lock (`lp_fence_signal` in `lp_fence.c`, Mesa
/// 22.3.6 and all later ones so far). `lp_fence_signalled` reads the count without the lock, so the driver may take the pass for
/// done, prepare the next and drop the fence, before that thread, should it lose the processor there, gives the lock back:
/// into memory that is another's by then. On a busy machine that was one of every million small passes.
///
/// A query holds the fence of the pass it ends in until it is written again. These begin and end after the last draw, so they
/// count nothing and change no program. lavapipe draws a clearing by itself, as a pass before the pass, which gets its own.
#[derive(Clone)]
pub(super) struct FenceKeeper {
    queries: wgpu::QuerySet,
    next: Arc<AtomicU32>,
}

impl FenceKeeper {
    pub fn new(device: &wgpu::Device) -> Self {
        let queries = device.create_query_set(&wgpu::QuerySetDescriptor {
            label: Some("fences"),
            ty: wgpu::QueryType::Occlusion,
            count: QUERIES,
        });
        Self { queries, next: Arc::default() }
    }

    /// Holds the fence of what has been drawn just now.
    fn hold(&self, pass: &mut wgpu::RenderPass<'_>) {
        pass.begin_occlusion_query(self.next.fetch_add(1, Ordering::Relaxed) % QUERIES);
        pass.end_occlusion_query();
    }
}

impl Gpu {
    /// How a colour target begins of which a pass writes every texel. Cleared, which costs nothing where the device draws tile
    /// by tile; lavapipe, which draws a clearing by itself, begins with what was there.
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
