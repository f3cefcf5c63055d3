//! A workaround for lavapipe, which may free a fence while one of its threads still uses it.

use std::sync::{
    Arc,
    atomic::{AtomicU32, Ordering},
};

/// The number of passes until a query is reused. Among that many passes there are always some that wait for others, and
/// by then the drawing threads have long left the first.
const QUERIES: u32 = 256;

/// Prevents lavapipe from freeing a fence while one of its threads uses it, which corrupts the heap.
///
/// A thread that has drawn its part of a pass increments the pass's fence under a lock (`lp_fence_signal` in
/// `lp_fence.c`, Mesa 22.3.6 and all later ones so far). `lp_fence_signalled` reads the counter without the lock, so if
/// that thread is preempted before it releases the lock, the driver may consider the pass done, prepare the next one
/// and free the fence; the lock is then released in freed memory. On a busy machine this happened in one of every
/// million small passes.
///
/// A query keeps the fence of the pass that it ends in alive until the query is reused. These queries are empty, after
/// the last draw, so they count nothing and change no program. lavapipe executes a clear as a separate pass before the
/// pass, which gets a query of its own.
#[derive(Clone)]
pub(super) struct FenceKeeper {
    pub queries: wgpu::QuerySet,
    next: Arc<AtomicU32>,
}

impl FenceKeeper {
    pub(crate) fn new(device: &wgpu::Device) -> Self {
        let queries = device.create_query_set(&wgpu::QuerySetDescriptor {
            label: Some("fences"),
            ty: wgpu::QueryType::Occlusion,
            count: QUERIES,
        });
        Self { queries, next: Arc::default() }
    }

    /// Keeps the fence of the preceding draws alive.
    pub(crate) fn hold(&self, pass: &mut wgpu::RenderPass<'_>) {
        pass.begin_occlusion_query(self.next.fetch_add(1, Ordering::Relaxed) % QUERIES);
        pass.end_occlusion_query();
    }
}
