//! A thin layer over wgpu: one device, its textures and pipelines, readback, timestamps.
//!
//! Every object has a label. This package knows nothing about shading languages, projects or the callers' purposes.

mod adapter;
mod bindings;
mod buffer;
mod convert;
mod counters;
mod device;
mod direct3d;
mod faces;
mod fences;
mod full_screen;
mod limits;
pub mod loss;
mod mesa;
mod mesh;
mod miniature;
mod mips;
mod opengl;
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

pub use adapter::{ADAPTER_VARIABLE, AdapterChoice, of_backends, without_windows};
pub use bindings::Binding;
pub use buffer::constant_buffer;
pub use convert::FloatConverter;
pub use counters::CounterTargets;
pub use device::{Gpu, GpuError, GpuOptions, Slices};
pub use direct3d::HlslCompiler;
pub use eddy_texture::TextureShape;
pub use limits::check_targets;
pub use mesh::{MeshBuffers, MeshPipelineDescriptor, depth_buffer};
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
