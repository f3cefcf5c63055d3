//! A work-around for lavapipe, which may free a fence that one of its threads is still inside of.

use std::sync::{
    Arc,
    atomic::{AtomicU32, Ordering},
};

/// Passes until a query is written again. Among so many there are always some that wait for others, and by then the
/// threads that draw have long left the first.
const QUERIES: u32 = 256;

/// Keeps lavapipe from freeing a fence while one of its threads is inside it, which spoils the heap.
///
/// A thread that has drawn its part of a pass counts up the pass's fence under a lock (`lp_fence_signal` in
/// `lp_fence.c`, Mesa 22.3.6 and all later ones so far). `lp_fence_signalled` reads the count without the lock, so the
/// driver may take the pass for done, prepare the next and drop the fence, before that thread, should it lose the
/// processor there, gives the lock back: into memory that is another's by then. On a busy machine that was one of every
/// million small passes.
///
/// A query holds the fence of the pass it ends in until it is written again. These begin and end after the last draw,
/// so they count nothing and change no program. lavapipe draws a clearing by itself, as a pass before the pass, which
/// gets its own.
#[derive(Clone)]
pub(super) struct FenceKeeper {
    pub queries: wgpu::QuerySet,
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
    pub fn hold(&self, pass: &mut wgpu::RenderPass<'_>) {
        pass.begin_occlusion_query(self.next.fetch_add(1, Ordering::Relaxed) % QUERIES);
        pass.end_occlusion_query();
    }
}
