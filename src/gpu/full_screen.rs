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

/// A fragment shader of Eddy's own that reads one picture of any format at group 0, binding 0, and in some cases a
/// uniform of 32 bytes at binding 1.
pub(super) struct PictureShader {
    label: &'static str,
    fragment: wgpu::ShaderModule,
    layout: wgpu::BindGroupLayout,
    pipeline_layout: wgpu::PipelineLayout,
    uniform: Option<wgpu::Buffer>,
}

impl PictureShader {
    /// Compiles WGSL with an entry point `fragment` that reads a `texture_2d<f32>`.
    pub(crate) fn new(gpu: &Gpu, label: &'static str, wgsl: &str) -> Self {
        Self::with_optional_uniform(gpu, label, wgsl, None)
    }

    /// Compiles WGSL that reads the uniform as well.
    pub(crate) fn with_uniform(gpu: &Gpu, label: &'static str, wgsl: &str) -> Self {
        let uniform = gpu.device.create_buffer(&wgpu::BufferDescriptor {
            label: Some(label),
            size: 32,
            usage: wgpu::BufferUsages::UNIFORM | wgpu::BufferUsages::COPY_DST,
            mapped_at_creation: false,
        });
        Self::with_optional_uniform(gpu, label, wgsl, Some(uniform))
    }

    fn with_optional_uniform(gpu: &Gpu, label: &'static str, wgsl: &str, uniform: Option<wgpu::Buffer>) -> Self {
        let fragment = gpu.device.create_shader_module(wgpu::ShaderModuleDescriptor {
            label: Some(label),
            source: wgpu::ShaderSource::Wgsl(wgsl.into()),
        });
        let picture = Binding::Texture { dimension: wgpu::TextureViewDimension::D2, filterable: false };
        let mut group = vec![(0, picture)];
        group.extend(uniform.is_some().then_some((1, Binding::Uniform { bytes: 32 })));
        let layout = bindings::layouts(gpu, label, &[group], wgpu::ShaderStages::FRAGMENT).remove(0);
        let pipeline_layout = pipeline_layout(gpu, label, std::slice::from_ref(&layout));
        Self { label, fragment, layout, pipeline_layout, uniform }
    }

    /// Creates the pipeline for targets of a format.
    pub(crate) fn pipeline(&self, gpu: &Gpu, target: wgpu::TextureFormat) -> wgpu::RenderPipeline {
        pipeline(gpu, self.label, &self.pipeline_layout, (&self.fragment, "fragment"), &[(target, true)])
    }

    /// Sets the uniform for all following draws.
    pub(crate) fn set<T: bytemuck::NoUninit>(&self, gpu: &Gpu, words: [T; 8]) {
        if let Some(uniform) = &self.uniform {
            gpu.queue.write_buffer(uniform, 0, bytemuck::cast_slice(&words));
        }
    }

    /// Binds the picture to read.
    pub(crate) fn bind(&self, gpu: &Gpu, picture: &wgpu::TextureView) -> wgpu::BindGroup {
        let entry = |binding, resource| wgpu::BindGroupEntry { binding, resource };
        let mut entries = vec![entry(0, wgpu::BindingResource::TextureView(picture))];
        entries.extend(self.uniform.as_ref().map(|uniform| entry(1, uniform.as_entire_binding())));
        let layout = &self.layout;
        let descriptor = wgpu::BindGroupDescriptor { label: Some(self.label), layout, entries: &entries };
        gpu.device.create_bind_group(&descriptor)
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
        self.draw_parts(gpu, encoder, pipeline, target, |pass| {
            pass.set_bind_group(0, picture, &[]);
            pass.draw(0..3, 0..1);
        });
    }

    /// Draws into a target; `draw` selects pictures and parts of the target.
    pub(crate) fn draw_parts(
        &self,
        gpu: &Gpu,
        encoder: &mut wgpu::CommandEncoder,
        pipeline: &wgpu::RenderPipeline,
        target: wgpu::RenderPassColorAttachment<'_>,
        draw: impl FnOnce(&mut wgpu::RenderPass<'_>),
    ) {
        let descriptor = wgpu::RenderPassDescriptor {
            label: Some(self.label),
            color_attachments: &[Some(target)],
            ..Default::default()
        };
        gpu.pass(encoder, descriptor, |pass| {
            pass.set_pipeline(pipeline);
            draw(pass);
        });
    }
}
