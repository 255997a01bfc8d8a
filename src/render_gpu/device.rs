//! An open GPU, and what its driver complains about.

use crate::adapter::{Adapter, check};
use crate::error::GpuError;
use std::sync::{Arc, Mutex, PoisonError};

/// The first complaint of a driver since it was last asked for.
#[derive(Clone, Debug, Default)]
struct Complaint(Arc<Mutex<Option<GpuError>>>);

impl Complaint {
    /// Keeps a complaint, unless an earlier one waits.
    fn note(&self, error: GpuError) {
        self.0.lock().unwrap_or_else(PoisonError::into_inner).get_or_insert(error);
    }

    fn take(&self) -> Option<GpuError> {
        self.0.lock().unwrap_or_else(PoisonError::into_inner).take()
    }
}

/// An open GPU.
#[derive(Clone, Debug)]
pub struct Gpu {
    /// Makes resources.
    pub device: wgpu::Device,
    /// Takes commands.
    pub queue: wgpu::Queue,
    /// What it is.
    pub adapter: Adapter,
    /// Whether it is reached through OpenGL, for which wgpu 30 writes no shader that says which samples of a pixel it covers
    /// (drivers refuse the assignment to `gl_SampleMask`), and makes no texture of one layer that can be read as layers.
    pub is_opengl: bool,
    complaint: Complaint,
}

impl Gpu {
    /// Opens a GPU with all that it offers.
    #[cfg(not(target_arch = "wasm32"))]
    pub fn open(adapter: &wgpu::Adapter) -> Result<Self, GpuError> {
        let descriptor = wgpu::DeviceDescriptor {
            label: Some("renderer"),
            required_limits: adapter.limits(),
            ..wgpu::DeviceDescriptor::default()
        };
        let (device, queue) = pollster::block_on(adapter.request_device(&descriptor)).map_err(|error| {
            let adapter = Adapter::from(&adapter.get_info()).to_string();
            GpuError::NoDevice { adapter, message: error.to_string() }
        })?;
        Self::shared(adapter, &device, &queue)
    }

    /// A GPU that is open already; its complaints are heard from now on.
    pub fn shared(
        adapter: &wgpu::Adapter,
        device: &wgpu::Device,
        queue: &wgpu::Queue,
    ) -> Result<Self, GpuError> {
        check(adapter)?;
        let complaint = Complaint::default();
        let uncaptured = complaint.clone();
        device.on_uncaptured_error(Arc::new(move |error: wgpu::Error| uncaptured.note(translated(error))));
        let lost = complaint.clone();
        device.set_device_lost_callback(move |reason, message| {
            if reason != wgpu::DeviceLostReason::Destroyed {
                lost.note(GpuError::Lost { message });
            }
        });
        let info = adapter.get_info();
        let is_opengl = info.backend == wgpu::Backend::Gl;
        let (device, queue) = (device.clone(), queue.clone());
        Ok(Gpu { device, queue, adapter: Adapter::from(&info), is_opengl, complaint })
    }

    /// Whether the driver has complained since it was last asked.
    pub fn check(&self) -> Result<(), GpuError> {
        self.complaint.take().map_or(Ok(()), Err)
    }

    /// Waits until all commands are done.
    #[cfg(not(target_arch = "wasm32"))]
    pub fn wait(&self) -> Result<(), GpuError> {
        let waited = self.device.poll(wgpu::PollType::wait_indefinitely());
        self.check()?;
        waited.map(|_| ()).map_err(|error| GpuError::Lost { message: error.to_string() })
    }
}

fn translated(error: wgpu::Error) -> GpuError {
    match error {
        wgpu::Error::OutOfMemory { .. } => GpuError::OutOfMemory,
        wgpu::Error::Validation { description, .. } | wgpu::Error::Internal { description, .. } => {
            GpuError::Refused { message: description }
        }
    }
}
