//! A description of the machine's devices, for bug reports.

use super::{Gpu, GpuError, GpuOptions, HlslCompiler, loss};

/// The properties of an adapter, as reported by its driver.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct AdapterReport {
    pub name: String,
    /// `vulkan`, `metal`, `dx12` or `gl`.
    pub backend: String,
    /// In wgpu's terms: `Cpu`, `DiscreteGpu`.
    pub device_type: String,
    pub driver: String,
    pub driver_info: String,
    /// PCI ids, 0 if there are none.
    pub vendor: u32,
    pub device: u32,
    /// The names of the features of WebGPU and wgpu that it supports.
    pub features: Vec<String>,
}

/// An open device, and its properties known to Eddy.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct DeviceReport {
    pub adapter: String,
    pub backend: String,
    /// The compiler of shaders on Direct3D 12, with the path of its library; `None` on other backends.
    pub hlsl_compiler: Option<String>,
    /// The features that Eddy has enabled.
    pub features: Vec<String>,
    pub limits: Vec<(&'static str, u64)>,
    pub faults: Vec<Fault>,
}

/// A driver bug that Eddy works around.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Fault {
    /// The name in `gpu/device.rs`.
    pub name: &'static str,
    pub about: &'static str,
}

impl AdapterReport {
    fn of(adapter: &wgpu::Adapter) -> Self {
        let info = adapter.get_info();
        Self {
            backend: info.backend.to_string(),
            device_type: format!("{:?}", info.device_type),
            name: info.name,
            driver: info.driver,
            driver_info: info.driver_info,
            vendor: info.vendor,
            device: info.device,
            features: names(adapter.features()),
        }
    }

    /// Lists the adapters of the machine without opening a device. Those of OpenGL are listed if there are no others,
    /// like in [`Gpu::new`].
    pub fn all() -> Result<Vec<Self>, GpuError> {
        loss::open_with_timeout(|| Ok(Self::found()))
    }

    fn found() -> Vec<Self> {
        for descriptor in Gpu::instance_descriptors() {
            let backends = descriptor.backends;
            let instance = wgpu::Instance::new(descriptor);
            let found = pollster::block_on(instance.enumerate_adapters(backends));
            if !found.is_empty() {
                return found.iter().map(Self::of).collect();
            }
        }
        Vec::new()
    }
}

fn names(features: wgpu::Features) -> Vec<String> {
    features.iter_names().map(|(name, _)| name.to_lowercase()).collect()
}

impl DeviceReport {
    /// Describes the device that Eddy draws with on this machine. Returns an error if there is none.
    pub fn of_default() -> Result<Self, GpuError> {
        loss::open_with_timeout(|| Gpu::new(&GpuOptions::default())).map(|gpu| Self::of(&gpu))
    }

    pub fn of(gpu: &Gpu) -> Self {
        let limits = gpu.device.limits();
        let limits = [
            ("max_texture_dimension_2d", u64::from(limits.max_texture_dimension_2d)),
            ("max_texture_dimension_3d", u64::from(limits.max_texture_dimension_3d)),
            ("max_sampled_textures_per_shader_stage", u64::from(limits.max_sampled_textures_per_shader_stage)),
            ("max_samplers_per_shader_stage", u64::from(limits.max_samplers_per_shader_stage)),
            ("max_storage_buffers_per_shader_stage", u64::from(limits.max_storage_buffers_per_shader_stage)),
            ("max_uniform_buffers_per_shader_stage", u64::from(limits.max_uniform_buffers_per_shader_stage)),
            ("max_uniform_buffer_binding_size", limits.max_uniform_buffer_binding_size),
            ("max_storage_buffer_binding_size", limits.max_storage_buffer_binding_size),
            ("max_buffer_size", limits.max_buffer_size),
            ("max_vertex_attributes", u64::from(limits.max_vertex_attributes)),
            ("max_inter_stage_shader_variables", u64::from(limits.max_inter_stage_shader_variables)),
            ("max_color_attachments", u64::from(limits.max_color_attachments)),
            ("max_color_attachment_bytes_per_sample", u64::from(limits.max_color_attachment_bytes_per_sample)),
        ];
        Self {
            adapter: gpu.info.name.clone(),
            backend: gpu.info.backend.to_string(),
            hlsl_compiler: gpu.hlsl_compiler.as_ref().map(HlslCompiler::describe),
            features: names(gpu.device.features()),
            limits: limits.into(),
            faults: faults(gpu),
        }
    }
}

/// Returns the known driver bugs that [`Gpu`] has found.
fn faults(gpu: &Gpu) -> Vec<Fault> {
    let all = [
        (!gpu.filters_float32, "no_float32_filtering", "textures of 32-bit floats are filtered by four fetches"),
        (!gpu.has_storage_buffers, "no_storage_buffers", "large constant tables lie in memory of each pixel"),
        (!gpu.has_timestamps, "no_timestamps", "times of passes are measured on the CPU"),
        (
            gpu.compiles_here,
            "compiles_here",
            "shaders are compiled on the CPU; large ones are tried in another process",
        ),
        (gpu.recompiles_for_uniforms, "recompiles_for_uniforms", "uniforms that decide branches are hidden"),
        (gpu.keeps_denormals, "keeps_denormals", "passes with 16-bit floats are compiled as if they could discard"),
        (
            gpu.hlsl_compiler == Some(HlslCompiler::Fxc),
            "slow_hlsl_compiler",
            "FXC takes minutes for some shaders; put dxcompiler.dll beside eddy.exe",
        ),
        (gpu.nan_angle, "nan_angle", "atan(0, 0) is asked of other numbers"),
        (gpu.nan_extremes, "nan_extremes", "minima and maxima are those that ignore NaN"),
        (gpu.wants_array_loops, "wants_array_loops", "long arrays are filled and copied by loops"),
        (gpu.keeps_loops_open, "keeps_loops_open", "loops begin with an exit that is never taken"),
        (gpu.runs_discarded, "runs_discarded", "loops end where a pixel is discarded"),
        (gpu.scatters_arrays, "scatters_arrays", "reads of small arrays choose among their elements"),
        (gpu.misjudges_limits, "misjudges_limits", "limits that loops count down to are hidden"),
        (gpu.unrolls_whole_arrays, "unrolls_whole_arrays", "counters that index arrays in nested loops are hidden"),
    ];
    all.into_iter().filter(|(is_there, ..)| *is_there).map(|(_, name, about)| Fault { name, about }).collect()
}
