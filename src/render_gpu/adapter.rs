//! Which GPU draws.

use crate::error::GpuError;
use std::fmt;
use wgpu::{DeviceType, DownlevelFlags, TextureFormat, TextureFormatFeatureFlags};

/// Which GPU is wanted.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
#[non_exhaustive]
pub enum Choice {
    /// The fastest kind that there is: a card of its own before one in the processor, before one in a virtual machine. A
    /// driver that computes on the CPU is not taken.
    #[default]
    Fastest,
    /// Any that there is, the fastest kind first, and a driver that computes on the CPU last.
    Any,
    /// The first whose name contains this text, in upper or lower case.
    Named(String),
}

impl fmt::Display for Choice {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Choice::Fastest => write!(f, "made of hardware"),
            Choice::Any => write!(f, "of any kind"),
            Choice::Named(name) => write!(f, "named {name}"),
        }
    }
}

/// What is known of a GPU.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Adapter {
    /// Its name.
    pub name: String,
    /// What it is: a card of its own, in the processor, a driver that computes on the CPU.
    pub kind: &'static str,
    /// The interface and the driver that it is reached by.
    pub driver: String,
}

impl fmt::Display for Adapter {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{} ({}, {})", self.name, self.kind, self.driver)
    }
}

impl Adapter {
    /// Whether it is a driver that computes on the CPU.
    pub fn is_software(&self) -> bool {
        self.kind == SOFTWARE
    }
}

/// What a driver that computes on the CPU is called.
const SOFTWARE: &str = "software";

impl From<&wgpu::AdapterInfo> for Adapter {
    fn from(info: &wgpu::AdapterInfo) -> Self {
        let kind = match info.device_type {
            DeviceType::DiscreteGpu => "discrete GPU",
            DeviceType::IntegratedGpu => "integrated GPU",
            DeviceType::VirtualGpu => "virtual GPU",
            DeviceType::Cpu => SOFTWARE,
            DeviceType::Other => "other",
        };
        let driver = [info.backend.to_string(), info.driver.clone(), info.driver_info.clone()];
        let driver: Vec<String> = driver.into_iter().filter(|part| !part.is_empty()).collect();
        Adapter { name: info.name.clone(), kind, driver: driver.join(" ") }
    }
}

/// Names of the GPUs of this machine.
#[cfg(not(target_arch = "wasm32"))]
pub fn adapters() -> Vec<Adapter> {
    enumerate().iter().map(|adapter| Adapter::from(&adapter.get_info())).collect()
}

/// The GPU that is wanted.
#[cfg(not(target_arch = "wasm32"))]
pub(crate) fn pick(choice: &Choice) -> Result<wgpu::Adapter, GpuError> {
    let mut all = enumerate();
    let found: Vec<String> =
        all.iter().map(|adapter| Adapter::from(&adapter.get_info()).to_string()).collect();
    all.sort_by_key(|adapter| rank(adapter.get_info().device_type));
    let fits = |adapter: &wgpu::Adapter| {
        let info = adapter.get_info();
        match choice {
            Choice::Fastest => info.device_type != DeviceType::Cpu,
            Choice::Any => true,
            Choice::Named(name) => info.name.to_lowercase().contains(&name.to_lowercase()),
        }
    };
    match all.into_iter().find(fits) {
        Some(adapter) => Ok(adapter),
        None => Err(GpuError::NoAdapter { wanted: choice.to_string(), found }),
    }
}

#[cfg(not(target_arch = "wasm32"))]
fn enumerate() -> Vec<wgpu::Adapter> {
    let mut descriptor = wgpu::InstanceDescriptor::new_without_display_handle();
    descriptor.backends = wgpu::Backends::VULKAN | wgpu::Backends::METAL | wgpu::Backends::DX12;
    let backends = descriptor.backends;
    pollster::block_on(wgpu::Instance::new(descriptor).enumerate_adapters(backends))
}

#[cfg(not(target_arch = "wasm32"))]
fn rank(kind: DeviceType) -> u8 {
    match kind {
        DeviceType::DiscreteGpu => 0,
        DeviceType::IntegratedGpu => 1,
        DeviceType::VirtualGpu => 2,
        DeviceType::Other => 3,
        DeviceType::Cpu => 4,
    }
}

/// What pictures need of an interface, and WebGL 2 lacks: lists that corners read, meshes that share their buffers.
const NEEDED: DownlevelFlags = DownlevelFlags::VERTEX_STORAGE.union(DownlevelFlags::BASE_VERTEX);

/// Refuses a GPU, or an interface to it, that cannot draw pictures.
pub(crate) fn check(adapter: &wgpu::Adapter) -> Result<(), GpuError> {
    let unsuitable = |message| {
        Err(GpuError::Unsuitable { adapter: Adapter::from(&adapter.get_info()).to_string(), message })
    };
    let lacking = NEEDED - adapter.get_downlevel_capabilities().flags;
    if !lacking.is_empty() {
        return unsuitable(format!("its interface lacks {lacking:?}"));
    }
    let four = TextureFormatFeatureFlags::MULTISAMPLE_X4;
    let lacking = [TextureFormat::Rgba8Unorm, TextureFormat::Depth32Float]
        .into_iter()
        .find(|&format| !adapter.get_texture_format_features(format).flags.contains(four));
    match lacking {
        None => Ok(()),
        Some(format) => unsuitable(format!("it has no four samples a pixel for {format:?}")),
    }
}
