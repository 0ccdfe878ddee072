//! How long the adapter works on a frame, by its own clock.

use std::sync::mpsc::{Receiver, Sender, channel};

use crate::Gpu;

/// What an adapter needs to measure it; browsers do not offer it.
pub(crate) const FEATURES: wgpu::Features =
    wgpu::Features::TIMESTAMP_QUERY.union(wgpu::Features::TIMESTAMP_QUERY_INSIDE_ENCODERS);

/// Frames that may be under way; further ones are not timed.
const N_SLOTS: usize = 4;

/// Two times of 8 bytes.
const N_BYTES: u64 = 16;

/// Times frames: [`GpuTimer::begin`] and [`GpuTimer::end`] around a frame's passes, [`GpuTimer::submitted`] after the
/// encoder was, [`GpuTimer::take`] some frames later.
pub struct GpuTimer {
    queries: wgpu::QuerySet,
    resolved: wgpu::Buffer,
    slots: [Slot; N_SLOTS],
    ns_per_step: f64,
    /// Number of the frame that is being recorded, and its slot.
    recording: Option<(u64, usize)>,
    mapped: (Sender<usize>, Receiver<usize>),
}

struct Slot {
    buffer: wgpu::Buffer,
    /// Number of the frame whose times come; none when free.
    frame: Option<u64>,
}

impl GpuTimer {
    /// `None` where the adapter does not measure it.
    pub fn new(gpu: &Gpu) -> Option<Self> {
        if !gpu.device.features().contains(FEATURES) {
            return None;
        }
        let buffer = |usage| {
            gpu.device.create_buffer(&wgpu::BufferDescriptor {
                label: Some("frame times"),
                size: N_BYTES,
                usage,
                mapped_at_creation: false,
            })
        };
        Some(Self {
            queries: gpu.device.create_query_set(&wgpu::QuerySetDescriptor {
                label: Some("frame times"),
                ty: wgpu::QueryType::Timestamp,
                count: 2,
            }),
            resolved: buffer(wgpu::BufferUsages::QUERY_RESOLVE | wgpu::BufferUsages::COPY_SRC),
            slots: std::array::from_fn(|_| Slot {
                buffer: buffer(wgpu::BufferUsages::COPY_DST | wgpu::BufferUsages::MAP_READ),
                frame: None,
            }),
            ns_per_step: f64::from(gpu.queue.get_timestamp_period()),
            recording: None,
            mapped: channel(),
        })
    }

    /// Before the first pass of a frame; `frame` is the caller's number for it.
    pub fn begin(&mut self, encoder: &mut wgpu::CommandEncoder, frame: u64) {
        let free = self.slots.iter().position(|slot| slot.frame.is_none());
        self.recording = free.map(|slot| (frame, slot));
        if free.is_some() {
            encoder.write_timestamp(&self.queries, 0);
        }
    }

    /// After the last pass.
    pub fn end(&mut self, encoder: &mut wgpu::CommandEncoder) {
        if let Some((_, slot)) = self.recording {
            encoder.write_timestamp(&self.queries, 1);
            encoder.resolve_query_set(&self.queries, 0..2, &self.resolved, 0);
            encoder.copy_buffer_to_buffer(&self.resolved, 0, &self.slots[slot].buffer, 0, N_BYTES);
        }
    }

    /// Once the encoder has been submitted.
    pub fn submitted(&mut self) {
        if let Some((frame, slot)) = self.recording.take() {
            self.slots[slot].frame = Some(frame);
            let sender = self.mapped.0.clone();
            // A buffer that cannot be mapped (the device is lost) is never heard of again.
            self.slots[slot].buffer.map_async(wgpu::MapMode::Read, .., move |result| {
                if result.is_ok() {
                    let _ = sender.send(slot);
                }
            });
        }
    }

    /// The number of a frame that is done and the seconds the adapter worked on it, once for each. News arrive while
    /// the device is polled, as every submission does.
    pub fn take(&mut self) -> Option<(u64, f64)> {
        let slot = &mut self.slots[self.mapped.1.try_recv().ok()?];
        let frame = slot.frame.take()?;
        let times = slot.buffer.get_mapped_range(..).ok().and_then(|bytes| {
            let (times, _) = bytes.as_chunks::<8>();
            Some([u64::from_le_bytes(*times.first()?), u64::from_le_bytes(*times.get(1)?)])
        });
        slot.buffer.unmap();
        let [begun, ended] = times?;
        // A frame takes far less than the 2^53 steps that are exact.
        Some((frame, ended.saturating_sub(begun) as f64 * self.ns_per_step * 1.0e-9))
    }
}
