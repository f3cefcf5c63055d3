//! Pipelines that draw meshes, and their vertex, index and depth buffers.

use super::{
    Binding, Gpu, GpuError, Pipeline, Shader,
    bindings::{layouts, pipeline_layout},
    full_screen::color_targets,
    limits::{check_bindings, check_varyings},
    pipeline::shader_modules,
};

const DEPTH: wgpu::TextureFormat = wgpu::TextureFormat::Depth32Float;

/// A vertex and a fragment shader for triangles.
pub struct MeshPipelineDescriptor<'a> {
    pub label: &'a str,
    pub vertex: Shader<'a>,
    pub fragment: Shader<'a>,
    pub entry_point: &'a str,
    /// Bind groups from 0, visible to both shaders.
    pub groups: &'a [Vec<(u32, Binding)>],
    /// Bytes per vertex, and the attributes: location, number of floats, offset in bytes.
    pub stride: u64,
    pub attributes: &'a [(u32, u8, u64)],
    /// Formats, and whether the fragment shader writes to the target.
    pub targets: &'a [(wgpu::TextureFormat, bool)],
    /// The front is counter-clockwise in GL's terms.
    pub cull: Option<wgpu::Face>,
    pub depth: wgpu::CompareFunction,
    pub depth_write: bool,
}

impl Pipeline {
    /// Creates a pipeline for meshes; as with [`Pipeline::new`], the modules must be valid.
    pub fn for_meshes(gpu: &Gpu, descriptor: MeshPipelineDescriptor<'_>) -> Result<Pipeline, GpuError> {
        let d = descriptor;
        check_bindings(gpu, d.label, d.groups)?;
        check_varyings(gpu, d.label, d.vertex.module)?;
        let layouts = layouts(gpu, d.label, d.groups, wgpu::ShaderStages::VERTEX_FRAGMENT);
        let attributes: Vec<_> = d
            .attributes
            .iter()
            .map(|&(shader_location, floats, offset)| {
                let format = match floats {
                    1 => wgpu::VertexFormat::Float32,
                    2 => wgpu::VertexFormat::Float32x2,
                    3 => wgpu::VertexFormat::Float32x3,
                    _ => wgpu::VertexFormat::Float32x4,
                };
                wgpu::VertexAttribute { format, offset, shader_location }
            })
            .collect();
        let targets = color_targets(d.targets);
        let raw = gpu.guarded(d.label, || {
            let [vertex, fragment] = shader_modules(gpu, d.label, [d.vertex, d.fragment], d.groups);
            gpu.device.create_render_pipeline(&wgpu::RenderPipelineDescriptor {
                label: Some(d.label),
                layout: Some(&pipeline_layout(gpu, d.label, &layouts)),
                vertex: wgpu::VertexState {
                    module: &vertex,
                    entry_point: Some(d.entry_point),
                    compilation_options: Default::default(),
                    buffers: &[Some(wgpu::VertexBufferLayout {
                        array_stride: d.stride,
                        step_mode: wgpu::VertexStepMode::Vertex,
                        attributes: &attributes,
                    })],
                },
                primitive: wgpu::PrimitiveState {
                    // Row 0 is the bottom, so the shader flips y, and with it the winding of every triangle.
                    front_face: wgpu::FrontFace::Cw,
                    cull_mode: d.cull,
                    ..Default::default()
                },
                depth_stencil: Some(wgpu::DepthStencilState {
                    format: DEPTH,
                    depth_write_enabled: Some(d.depth_write),
                    depth_compare: Some(d.depth),
                    stencil: Default::default(),
                    bias: Default::default(),
                }),
                multisample: Default::default(),
                fragment: Some(wgpu::FragmentState {
                    module: &fragment,
                    entry_point: Some(d.entry_point),
                    compilation_options: Default::default(),
                    targets: &targets,
                }),
                multiview_mask: None,
                cache: None,
            })
        })?;
        Ok(Pipeline { raw, layouts })
    }
}

/// A mesh on the device.
pub struct MeshBuffers {
    pub vertices: wgpu::Buffer,
    /// 32 bits each.
    pub indices: wgpu::Buffer,
    pub count: u32,
}

impl MeshBuffers {
    pub fn new(gpu: &Gpu, label: &str, vertices: &[u8], indices: &[u32]) -> Result<MeshBuffers, GpuError> {
        let make = |bytes: &[u8], usage: wgpu::BufferUsages| {
            let size = bytes.len() as u64;
            if size > gpu.device.limits().max_buffer_size {
                return Err(GpuError::OutOfMemory(format!("{label} ({size} bytes in one buffer)")));
            }
            let buffer = gpu.guarded(label, || {
                gpu.device.create_buffer(&wgpu::BufferDescriptor {
                    label: Some(label),
                    size,
                    usage: usage | wgpu::BufferUsages::COPY_DST,
                    mapped_at_creation: false,
                })
            })?;
            gpu.queue.write_buffer(&buffer, 0, bytes);
            Ok(buffer)
        };
        Ok(MeshBuffers {
            vertices: make(vertices, wgpu::BufferUsages::VERTEX)?,
            indices: make(bytemuck::cast_slice(indices), wgpu::BufferUsages::INDEX)?,
            count: indices.len() as u32,
        })
    }
}

/// Creates a depth buffer of 32-bit floats.
pub fn depth_buffer(gpu: &Gpu, label: &str, width: u32, height: u32) -> Result<wgpu::TextureView, GpuError> {
    gpu.check_size(label, width, height)?;
    let texture = gpu.guarded(label, || {
        gpu.device.create_texture(&wgpu::TextureDescriptor {
            label: Some(label),
            size: wgpu::Extent3d { width, height, depth_or_array_layers: 1 },
            mip_level_count: 1,
            sample_count: 1,
            dimension: wgpu::TextureDimension::D2,
            format: DEPTH,
            usage: wgpu::TextureUsages::RENDER_ATTACHMENT,
            view_formats: &[],
        })
    })?;
    Ok(texture.create_view(&Default::default()))
}
