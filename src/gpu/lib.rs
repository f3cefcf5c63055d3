//! A thin layer over wgpu: one device, its textures and pipelines, readback, timestamps.
//!
//! Every object has a label. This package knows nothing about shading languages, projects or the callers' purposes.

mod adapter;
mod bindings;
mod buffer;
mod convert;
mod device;
mod fences;
mod full_screen;
pub mod loss;
mod mesa;
mod mesh;
mod miniature;
mod mips;
mod pass;
mod pick;
mod pipeline;
mod present;
mod rasteriser;
mod readback;
mod report;
mod samplers;
mod spirv;
#[cfg(feature = "testing")]
pub mod testing;
mod texture;
mod timer;
mod values;

pub use adapter::{ADAPTER_VARIABLE, AdapterChoice};
pub use bindings::Binding;
pub use buffer::constant_buffer;
pub use convert::FloatConverter;
pub use device::{Gpu, GpuError, GpuOptions, Slices};
pub use eddy_texture::TextureShape;
pub use mesh::{MeshBuffers, MeshPipelineDescriptor, check_targets, depth_buffer};
pub use miniature::{Miniatures, SIZE as MINIATURE_SIZE};
pub use mips::{MipChain, MipMaker};
pub use pick::TexelPicker;
pub use pipeline::{FragmentPipelineDescriptor, Pipeline, Shader};
pub use present::Presenter;
pub use rasteriser::{Rasteriser, lower_background_priority};
pub use readback::Readback;
pub use report::{AdapterReport, DeviceReport, Fault};
pub use samplers::{Address, Filtering, Samplers};
pub use texture::{Texture, TextureDescriptor, texture_format, view_dimension};
pub use timer::PassTimer;
pub use values::{Paint, ValueLook, ValuePainter};
