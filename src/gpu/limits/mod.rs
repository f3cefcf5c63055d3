//! The limits of a device, which are checked before anything is created: an error names what exceeds which limit.

#[cfg(test)]
mod tests;

use super::{Binding, Gpu, GpuError};
use eddy_texture::{Dimension, TextureShape};

impl Gpu {
    /// Rejects a size in pixels that no target can have.
    pub fn check_size(&self, what: &str, width: u32, height: u32) -> Result<(), GpuError> {
        if width == 0 || height == 0 {
            return Err(GpuError::Empty { what: what.into(), width, height });
        }
        let limit = self.device.limits().max_texture_dimension_2d;
        if width > limit || height > limit {
            return Err(GpuError::TooLarge { what: what.into(), width, height, limit });
        }
        Ok(())
    }

    /// Rejects a texture that the device does not have.
    pub fn check_shape(&self, what: &str, shape: TextureShape) -> Result<(), GpuError> {
        match shape.dimension {
            Dimension::D3 => self.check_volume(what, [shape.width, shape.height, shape.depth]),
            Dimension::D2 | Dimension::Cube => self.check_size(what, shape.width, shape.height),
        }
    }

    fn check_volume(&self, what: &str, size: [u32; 3]) -> Result<(), GpuError> {
        let limit = self.device.limits().max_texture_dimension_3d;
        let [width, height, depth] = size;
        match size.iter().any(|side| *side > limit) {
            true => Err(GpuError::VolumeTooLarge { what: what.into(), width, height, depth, limit }),
            false => Ok(()),
        }
    }
}

/// Returns an error if the device does not support targets of these formats together, by the rule of WebGPU,
/// "calculating color attachment bytes per sample".
pub fn check_targets(gpu: &Gpu, what: &str, formats: &[wgpu::TextureFormat]) -> Result<(), GpuError> {
    let limits = gpu.device.limits();
    let bytes = bytes_per_sample(formats);
    if bytes > limits.max_color_attachment_bytes_per_sample {
        let limit = limits.max_color_attachment_bytes_per_sample;
        return Err(GpuError::TargetsTooLarge { what: what.into(), bytes, limit });
    }
    check_count(what, "targets", formats.len(), limits.max_color_attachments)
}

fn bytes_per_sample(formats: &[wgpu::TextureFormat]) -> u32 {
    formats.iter().fold(0u32, |sum, format| {
        let align = format.target_component_alignment().unwrap_or(1);
        sum.next_multiple_of(align) + format.target_pixel_byte_cost().unwrap_or(0)
    })
}

fn check_count(what: &str, kind: &'static str, count: usize, limit: u32) -> Result<(), GpuError> {
    let count = count as u32;
    if count > limit { Err(GpuError::TooMany { what: what.into(), kind, count, limit }) } else { Ok(()) }
}

/// Returns an error if a shader stage cannot read all of these at once.
pub(super) fn check_bindings(gpu: &Gpu, what: &str, groups: &[Vec<(u32, Binding)>]) -> Result<(), GpuError> {
    let limits = gpu.device.limits();
    let of_kind = |is: fn(&Binding) -> bool| groups.iter().flatten().filter(|(_, binding)| is(binding)).count();
    let counts = [
        ("textures", of_kind(|b| matches!(b, Binding::Texture { .. })), limits.max_sampled_textures_per_shader_stage),
        ("samplers", of_kind(|b| matches!(b, Binding::Sampler { .. })), limits.max_samplers_per_shader_stage),
        (
            "uniform buffers",
            of_kind(|b| matches!(b, Binding::Uniform { .. })),
            limits.max_uniform_buffers_per_shader_stage,
        ),
        ("storage buffers", of_kind(|b| matches!(b, Binding::Storage)), limits.max_storage_buffers_per_shader_stage),
    ];
    for (kind, count, limit) in counts {
        check_count(what, kind, count, limit)?;
    }
    let bytes = groups.iter().flatten().filter_map(|(_, binding)| match binding {
        Binding::Uniform { bytes } => Some(*bytes),
        _ => None,
    });
    let (bytes, limit) = (bytes.max().unwrap_or(0), limits.max_uniform_buffer_binding_size);
    if bytes > limit { Err(GpuError::UniformsTooLarge { what: what.into(), bytes, limit }) } else { Ok(()) }
}

/// Returns an error if the device does not pass this many values from a vertex to a fragment shader.
pub(super) fn check_varyings(gpu: &Gpu, what: &str, vertex: &naga::Module) -> Result<(), GpuError> {
    let result = vertex.entry_points.first().and_then(|entry| entry.function.result.as_ref());
    let members = result.map(|result| &vertex.types[result.ty].inner);
    let Some(naga::TypeInner::Struct { members, .. }) = members else { return Ok(()) };
    let is_passed = |binding: &Option<naga::Binding>| matches!(binding, Some(naga::Binding::Location { .. }));
    let count = members.iter().filter(|member| is_passed(&member.binding)).count();
    check_count(what, "varyings", count, gpu.device.limits().max_inter_stage_shader_variables)
}
