//! Device time of each pass by timestamp queries, read without blocking.

use super::{Gpu, loss};
use std::sync::{
    Arc,
    atomic::{AtomicBool, Ordering},
};

/// The number of frames whose times may be in flight. A frame that finds no free slot is not timed.
const SLOTS: usize = 4;

/// The start and end timestamps of the first `capacity` passes of a frame.
pub struct PassTimer {
    capacity: u32,
    period_nanos: f64,
    slots: Vec<Slot>,
    recording: Option<usize>,
    newest: u64,
}

struct Slot {
    queries: wgpu::QuerySet,
    resolved: wgpu::Buffer,
    mapped: wgpu::Buffer,
    state: State,
    frame: u64,
    /// The draw for each pair of timestamps.
    draws: Vec<usize>,
}

enum State {
    Free,
    Recorded,
    Mapping(Arc<AtomicBool>),
}

impl PassTimer {
    /// Returns `None` if the device has no timestamps, or the capacity is 0. Passes beyond the size of a query set are
    /// not timed.
    pub fn new(gpu: &Gpu, capacity: u32) -> Option<Self> {
        if !gpu.has_timestamps || capacity == 0 {
            return None;
        }
        let capacity = capacity.min(wgpu::QUERY_SET_MAX_QUERIES / 2);
        let bytes = u64::from(capacity) * 16;
        let buffer = |label, usage| {
            gpu.device.create_buffer(&wgpu::BufferDescriptor {
                label: Some(label),
                size: bytes,
                usage,
                mapped_at_creation: false,
            })
        };
        let slots = (0..SLOTS)
            .map(|_| Slot {
                queries: gpu.device.create_query_set(&wgpu::QuerySetDescriptor {
                    label: Some("pass times"),
                    ty: wgpu::QueryType::Timestamp,
                    count: capacity * 2,
                }),
                resolved: buffer(
                    "pass times, resolved",
                    wgpu::BufferUsages::QUERY_RESOLVE | wgpu::BufferUsages::COPY_SRC,
                ),
                mapped: buffer("pass times, mapped", wgpu::BufferUsages::COPY_DST | wgpu::BufferUsages::MAP_READ),
                state: State::Free,
                frame: 0,
                draws: Vec::new(),
            })
            .collect();
        Some(Self {
            capacity,
            period_nanos: f64::from(gpu.queue.get_timestamp_period()),
            slots,
            recording: None,
            newest: 0,
        })
    }

    /// Starts a frame.
    pub fn start(&mut self) {
        self.recording = self.slots.iter().position(|s| matches!(s.state, State::Free));
        if let Some(i) = self.recording {
            self.newest += 1;
            self.slots[i].frame = self.newest;
            self.slots[i].draws.clear();
        }
    }

    /// Returns where the frame's next pass writes its timestamps; its time is added to `draw`. `None` beyond the
    /// capacity.
    pub fn writes(&mut self, draw: usize) -> Option<wgpu::RenderPassTimestampWrites<'_>> {
        let slot = &mut self.slots[self.recording?];
        let index = slot.draws.len() as u32;
        if index >= self.capacity {
            return None;
        }
        slot.draws.push(draw);
        Some(wgpu::RenderPassTimestampWrites {
            query_set: &slot.queries,
            beginning_of_pass_write_index: Some(index * 2),
            end_of_pass_write_index: Some(index * 2 + 1),
        })
    }

    /// Called after the frame's last pass, with the same encoder.
    pub fn resolve(&mut self, encoder: &mut wgpu::CommandEncoder) {
        let Some(i) = self.recording else { return };
        let slot = &mut self.slots[i];
        let passes = slot.draws.len() as u32;
        if passes > 0 {
            encoder.resolve_query_set(&slot.queries, 0..passes * 2, &slot.resolved, 0);
            encoder.copy_buffer_to_buffer(&slot.resolved, 0, &slot.mapped, 0, u64::from(passes) * 16);
        }
        slot.state = State::Recorded;
    }

    /// Called after commands were submitted. The frame is complete if they include [`PassTimer::resolve`].
    pub fn submitted(&mut self) {
        let is_resolved = |&mut i: &mut usize| matches!(self.slots[i].state, State::Recorded);
        let Some(i) = self.recording.take_if(is_resolved) else { return };
        let slot = &mut self.slots[i];
        let done = Arc::new(AtomicBool::new(false));
        let signal = done.clone();
        slot.mapped.slice(..).map_async(wgpu::MapMode::Read, move |result| {
            signal.store(result.is_ok(), Ordering::Release);
        });
        slot.state = State::Mapping(done);
    }

    /// Returns the milliseconds of each of `draws` draws in the newest frame that the device has finished since the
    /// last call; 0 for a draw that was skipped. Does not block.
    pub fn newest(&mut self, gpu: &Gpu, draws: usize) -> Option<Vec<f64>> {
        // The error is a device loss, which drawing reports.
        let _ = loss::poll(&gpu.device, wgpu::PollType::Poll);
        let mut best: Option<(u64, Vec<f64>)> = None;
        for slot in &mut self.slots {
            let State::Mapping(done) = &slot.state else { continue };
            if !done.load(Ordering::Acquire) {
                continue;
            }
            if let Ok(bytes) = slot.mapped.slice(..).get_mapped_range() {
                let stamps: Vec<u64> =
                    bytes.chunks_exact(8).take(slot.draws.len() * 2).map(bytemuck::pod_read_unaligned).collect();
                let mut millis = vec![0.0; draws];
                for (draw, s) in slot.draws.iter().zip(stamps.chunks_exact(2)) {
                    // A program of fewer passes may have been installed since.
                    if let Some(sum) = millis.get_mut(*draw) {
                        *sum += s[1].saturating_sub(s[0]) as f64 * self.period_nanos / 1e6;
                    }
                }
                if best.as_ref().is_none_or(|(frame, _)| *frame < slot.frame) {
                    best = Some((slot.frame, millis));
                }
            }
            slot.mapped.unmap();
            slot.state = State::Free;
        }
        best.map(|(_, millis)| millis)
    }
}
