//! The bind groups of a pipeline.

use super::Gpu;

/// One slot of a bind group.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Binding {
    /// A uniform buffer of at least this many bytes.
    Uniform { bytes: u64 },
    /// A storage buffer that is only read.
    Storage,
    /// A sampled float texture.
    Texture { dimension: wgpu::TextureViewDimension, filterable: bool },
    /// `filtering`: the sampler may filter, and is then limited to filterable textures.
    Sampler { filtering: bool },
}

impl Binding {
    fn entry(self, binding: u32, visibility: wgpu::ShaderStages) -> wgpu::BindGroupLayoutEntry {
        let ty = match self {
            Binding::Uniform { bytes } => wgpu::BindingType::Buffer {
                ty: wgpu::BufferBindingType::Uniform,
                has_dynamic_offset: false,
                min_binding_size: std::num::NonZero::new(bytes),
            },
            Binding::Storage => wgpu::BindingType::Buffer {
                ty: wgpu::BufferBindingType::Storage { read_only: true },
                has_dynamic_offset: false,
                min_binding_size: None,
            },
            Binding::Texture { dimension, filterable } => wgpu::BindingType::Texture {
                sample_type: wgpu::TextureSampleType::Float { filterable },
                view_dimension: dimension,
                multisampled: false,
            },
            Binding::Sampler { filtering } => wgpu::BindingType::Sampler(if filtering {
                wgpu::SamplerBindingType::Filtering
            } else {
                wgpu::SamplerBindingType::NonFiltering
            }),
        };
        let visibility = match self {
            // Not every device supports storage buffers in vertex shaders.
            Binding::Storage => wgpu::ShaderStages::FRAGMENT,
            _ => visibility,
        };
        wgpu::BindGroupLayoutEntry { binding, visibility, ty, count: None }
    }
}

pub(super) fn layouts(
    gpu: &Gpu,
    label: &str,
    groups: &[Vec<(u32, Binding)>],
    visibility: wgpu::ShaderStages,
) -> Vec<wgpu::BindGroupLayout> {
    let layout = |bindings: &Vec<(u32, Binding)>| {
        let entries: Vec<_> = bindings.iter().map(|(binding, kind)| kind.entry(*binding, visibility)).collect();
        gpu.device.create_bind_group_layout(&wgpu::BindGroupLayoutDescriptor { label: Some(label), entries: &entries })
    };
    groups.iter().map(layout).collect()
}

pub(super) fn pipeline_layout(gpu: &Gpu, label: &str, layouts: &[wgpu::BindGroupLayout]) -> wgpu::PipelineLayout {
    gpu.device.create_pipeline_layout(&wgpu::PipelineLayoutDescriptor {
        label: Some(label),
        bind_group_layouts: &layouts.iter().map(Some).collect::<Vec<_>>(),
        immediate_size: 0,
    })
}
