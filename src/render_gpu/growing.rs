//! Buffers that are written every frame and grow when they must.

use wgpu::{Buffer, BufferDescriptor, BufferUsages};

/// A buffer of the GPU that keeps its memory from frame to frame.
#[derive(Clone, Debug)]
pub struct Growing {
    label: &'static str,
    usage: BufferUsages,
    buffer: Buffer,
}

/// Least size \[byte\], so that an empty list can be bound too.
const LEAST: u64 = 4096;

impl Growing {
    /// A small buffer for `usage`.
    pub fn new(device: &wgpu::Device, label: &'static str, usage: BufferUsages) -> Self {
        Growing { label, usage, buffer: create(device, label, usage, LEAST) }
    }

    /// Makes room for `bytes`; true when the buffer was replaced, and its contents are lost.
    pub fn reserve(&mut self, device: &wgpu::Device, bytes: u64) -> bool {
        if bytes <= self.buffer.size() {
            return false;
        }
        let limit = device.limits().max_buffer_size.max(bytes);
        let size = bytes.next_power_of_two().min(limit);
        self.buffer = create(device, self.label, self.usage, size);
        true
    }

    /// The buffer itself.
    pub fn buffer(&self) -> &Buffer {
        &self.buffer
    }
}

fn create(device: &wgpu::Device, label: &'static str, usage: BufferUsages, size: u64) -> Buffer {
    device.create_buffer(&BufferDescriptor { label: Some(label), size, usage, mapped_at_creation: false })
}
