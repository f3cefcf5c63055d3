//! Drawing one triangle over the whole target.

use super::{Binding, Gpu, bindings};
use bindings::pipeline_layout;

/// The corners of the triangle are at (-1, -1), (3, -1) and (-1, 3).
const TRIANGLE: &str = "
@vertex fn vertex(@builtin(vertex_index) i: u32) -> @builtin(position) vec4<f32> {
    return vec4(f32(i & 1u) * 4.0 - 1.0, f32(i >> 1u) * 4.0 - 1.0, 0.0, 1.0);
}
";

/// Returns the states of targets without blending; the flag enables writing.
pub(super) fn color_targets(targets: &[(wgpu::TextureFormat, bool)]) -> Vec<Option<wgpu::ColorTargetState>> {
    let state = |&(format, is_written): &(wgpu::TextureFormat, bool)| {
        let write_mask = if is_written { wgpu::ColorWrites::ALL } else { wgpu::ColorWrites::empty() };
        Some(wgpu::ColorTargetState { format, blend: None, write_mask })
    };
    targets.iter().map(state).collect()
}

/// Creates a pipeline that draws the triangle with a fragment shader's entry point; no blending, no depth.
pub(super) fn pipeline(
    gpu: &Gpu,
    label: &str,
    layout: &wgpu::PipelineLayout,
    (fragment, entry_point): (&wgpu::ShaderModule, &str),
    targets: &[(wgpu::TextureFormat, bool)],
) -> wgpu::RenderPipeline {
    let targets = color_targets(targets);
    let vertex = gpu.device.create_shader_module(wgpu::ShaderModuleDescriptor {
        label: Some("full-screen triangle"),
        source: wgpu::ShaderSource::Wgsl(TRIANGLE.into()),
    });
    gpu.device.create_render_pipeline(&wgpu::RenderPipelineDescriptor {
        label: Some(label),
        layout: Some(layout),
        vertex: wgpu::VertexState {
            module: &vertex,
            entry_point: Some("vertex"),
            compilation_options: Default::default(),
            buffers: &[],
        },
        primitive: Default::default(),
        depth_stencil: None,
        multisample: Default::default(),
        fragment: Some(wgpu::FragmentState {
            module: fragment,
            entry_point: Some(entry_point),
            // Without this, textures and private variables start as zeros; workgroup memory is not used.
            compilation_options: Default::default(),
            targets: &targets,
        }),
        multiview_mask: None,
        cache: None,
    })
}

/// A fragment shader of Eddy's own that reads values of any format at group 0, binding 0, and a uniform of 32 bytes at
/// binding 1.
pub(super) struct ValuesShader {
    label: &'static str,
    layout: wgpu::BindGroupLayout,
    pipeline: wgpu::RenderPipeline,
    uniform: wgpu::Buffer,
}

impl ValuesShader {
    /// Compiles WGSL with an entry point `fragment` that draws into targets of a format.
    pub(crate) fn new(gpu: &Gpu, label: &'static str, wgsl: &str, target: wgpu::TextureFormat) -> Self {
        let fragment = gpu.device.create_shader_module(wgpu::ShaderModuleDescriptor {
            label: Some(label),
            source: wgpu::ShaderSource::Wgsl(wgsl.into()),
        });
        let values = Binding::Texture { dimension: wgpu::TextureViewDimension::D2, filterable: false };
        let groups = [vec![(0, values), (1, Binding::Uniform { bytes: 32 })]];
        let layout = bindings::layouts(gpu, label, &groups, wgpu::ShaderStages::FRAGMENT).remove(0);
        let pipeline_layout = pipeline_layout(gpu, label, std::slice::from_ref(&layout));
        let pipeline = pipeline(gpu, label, &pipeline_layout, (&fragment, "fragment"), &[(target, true)]);
        let uniform = gpu.device.create_buffer(&wgpu::BufferDescriptor {
            label: Some(label),
            size: 32,
            usage: wgpu::BufferUsages::UNIFORM | wgpu::BufferUsages::COPY_DST,
            mapped_at_creation: false,
        });
        Self { label, layout, pipeline, uniform }
    }

    /// Sets the uniform for all following draws.
    pub(crate) fn set<T: bytemuck::NoUninit>(&self, gpu: &Gpu, words: [T; 8]) {
        gpu.queue.write_buffer(&self.uniform, 0, bytemuck::cast_slice(&words));
    }

    /// Binds the values to read.
    pub(crate) fn bind(&self, gpu: &Gpu, values: &wgpu::TextureView) -> wgpu::BindGroup {
        gpu.device.create_bind_group(&wgpu::BindGroupDescriptor {
            label: Some(self.label),
            layout: &self.layout,
            entries: &[
                wgpu::BindGroupEntry { binding: 0, resource: wgpu::BindingResource::TextureView(values) },
                wgpu::BindGroupEntry { binding: 1, resource: self.uniform.as_entire_binding() },
            ],
        })
    }

    /// Draws into a target; `draw` selects values and parts of the target.
    pub(crate) fn draw(
        &self,
        gpu: &Gpu,
        encoder: &mut wgpu::CommandEncoder,
        target: wgpu::RenderPassColorAttachment<'_>,
        draw: impl FnOnce(&mut wgpu::RenderPass<'_>),
    ) {
        let descriptor = wgpu::RenderPassDescriptor {
            label: Some(self.label),
            color_attachments: &[Some(target)],
            ..Default::default()
        };
        gpu.pass(encoder, descriptor, |pass| {
            pass.set_pipeline(&self.pipeline);
            draw(pass);
        });
    }
}

/// A fragment shader of Eddy's own that reads one picture.
pub(super) struct PictureShader {
    label: &'static str,
    fragment: wgpu::ShaderModule,
    layout: wgpu::BindGroupLayout,
    pipeline_layout: wgpu::PipelineLayout,
}

impl PictureShader {
    /// Compiles WGSL with an entry point `fragment` that reads a `texture_2d<f32>` at group 0, binding 0.
    pub(crate) fn new(gpu: &Gpu, label: &'static str, wgsl: &str) -> Self {
        let fragment = gpu.device.create_shader_module(wgpu::ShaderModuleDescriptor {
            label: Some(label),
            source: wgpu::ShaderSource::Wgsl(wgsl.into()),
        });
        let entry = wgpu::BindGroupLayoutEntry {
            binding: 0,
            visibility: wgpu::ShaderStages::FRAGMENT,
            ty: wgpu::BindingType::Texture {
                sample_type: wgpu::TextureSampleType::Float { filterable: false },
                view_dimension: wgpu::TextureViewDimension::D2,
                multisampled: false,
            },
            count: None,
        };
        let layout = gpu
            .device
            .create_bind_group_layout(&wgpu::BindGroupLayoutDescriptor { label: Some(label), entries: &[entry] });
        let pipeline_layout = pipeline_layout(gpu, label, std::slice::from_ref(&layout));
        Self { label, fragment, layout, pipeline_layout }
    }

    /// Creates the pipeline for targets of a format.
    pub(crate) fn pipeline(&self, gpu: &Gpu, target: wgpu::TextureFormat) -> wgpu::RenderPipeline {
        pipeline(gpu, self.label, &self.pipeline_layout, (&self.fragment, "fragment"), &[(target, true)])
    }

    /// Binds the picture to read.
    pub(crate) fn bind(&self, gpu: &Gpu, picture: &wgpu::TextureView) -> wgpu::BindGroup {
        gpu.device.create_bind_group(&wgpu::BindGroupDescriptor {
            label: Some(self.label),
            layout: &self.layout,
            entries: &[wgpu::BindGroupEntry { binding: 0, resource: wgpu::BindingResource::TextureView(picture) }],
        })
    }

    /// Draws into every texel of a target.
    pub(crate) fn draw(
        &self,
        gpu: &Gpu,
        encoder: &mut wgpu::CommandEncoder,
        pipeline: &wgpu::RenderPipeline,
        picture: &wgpu::BindGroup,
        target: wgpu::RenderPassColorAttachment<'_>,
    ) {
        let descriptor = wgpu::RenderPassDescriptor {
            label: Some(self.label),
            color_attachments: &[Some(target)],
            ..Default::default()
        };
        gpu.pass(encoder, descriptor, |pass| {
            pass.set_pipeline(pipeline);
            pass.set_bind_group(0, picture, &[]);
            pass.draw(0..3, 0..1);
        });
    }
}
