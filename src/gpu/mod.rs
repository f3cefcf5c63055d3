//! A thin layer over wgpu: one device, its textures and pipelines, readback, timestamps.
//!
//! Every object carries a label. Knows nothing of shaders' languages, of projects or of who draws what.

mod buffer;
mod convert;
mod device;
mod mips;
mod pipeline;
mod present;
mod readback;
mod samplers;
mod texture;
mod timer;

pub use buffer::constant_buffer;
pub use convert::to_rgba32float;
pub use device::{Gpu, GpuError, GpuOptions};
pub use mips::{MipChain, MipMaker};
pub use pipeline::{Binding, FragmentPipeline, FragmentPipelineDescriptor};
pub use present::Presenter;
pub use readback::read_rgba32float;
pub use samplers::{Address, Filtering, Samplers};
pub use texture::{Texture, TextureDescriptor, mip_levels};
pub use timer::PassTimer;
