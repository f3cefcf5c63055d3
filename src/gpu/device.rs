//! The device with its known properties, and the priority of threads where the CPU draws.

use super::{AdapterChoice, direct3d::HlslCompiler, faces::Faces, loss, mesa, opengl};
use std::{
    sync::{
        Arc, Mutex,
        atomic::{AtomicBool, Ordering},
    },
    time::Duration,
};

/// The requested device features.
#[derive(Clone, Debug)]
pub struct GpuOptions {
    /// The adapter, where one is to be found.
    pub adapter: AdapterChoice,
    /// Use filtering of 32-bit float textures if the adapter supports it. Otherwise every such read is emulated: this
    /// is used to test the fallback on a device that does not need it.
    pub use_float32_filtering: bool,
    /// Use timestamp queries if the adapter supports them.
    pub use_timestamps: bool,
    /// Let naga add its own checks to shaders (indices, loops, integer division), which Eddy's front end makes
    /// unnecessary: this is used to measure their cost.
    pub runtime_checks: bool,
    /// Use no more than these limits: this is used to test weaker devices.
    pub limits: Option<wgpu::Limits>,
    /// Treat the device as a GPU even if the processor draws: this is used to test what only GPUs do.
    pub treat_as_gpu: bool,
}

impl Default for GpuOptions {
    fn default() -> Self {
        Self {
            adapter: AdapterChoice::default(),
            use_float32_filtering: true,
            use_timestamps: true,
            runtime_checks: false,
            limits: None,
            treat_as_gpu: false,
        }
    }
}

/// The fix for a machine without a graphics device.
const DRIVER_HINT: &str = if cfg!(windows) {
    "Install the newest driver from the maker of the graphics card: those of Windows Update may lack Vulkan"
} else {
    "On Debian or Ubuntu, `apt-get install mesa-vulkan-drivers` installs one that runs on the CPU"
};

/// The errors of the graphics device.
#[derive(Debug, thiserror::Error)]
pub enum GpuError {
    #[error("no graphics device found ({0}). {DRIVER_HINT}")]
    NoAdapter(String),
    #[error(
        "no graphics device can draw on this window: {0}. `eddy render` draws without a window. On Debian or Ubuntu, \
         `apt-get install mesa-vulkan-drivers` installs a device that draws on windows with the CPU"
    )]
    NoWindowAdapter(String),
    #[error("no graphics adapter has {name:?} in its name: {why}")]
    NoSuchAdapter { name: String, why: String },
    #[error("cannot open {adapter}: {reason}")]
    NoDevice { adapter: String, reason: String },
    #[error("{what} of {width}x{height} pixels: this device draws at most {limit}x{limit}")]
    TooLarge { what: String, width: u32, height: u32, limit: u32 },
    #[error("{what} of {width}x{height} pixels: a size must be at least 1")]
    Empty { what: String, width: u32, height: u32 },
    #[error(
        "the targets of {what} take {bytes} bytes per texel, but this device draws into at most {limit} at once: \
         choose smaller formats"
    )]
    TargetsTooLarge { what: String, bytes: u32, limit: u32 },
    #[error("{what} of {width}x{height}x{depth} voxels: this device has volumes of at most {limit}x{limit}x{limit}")]
    VolumeTooLarge { what: String, width: u32, height: u32, depth: u32, limit: u32 },
    #[error("{what} has {count} {kind}, but this device allows {limit} at once")]
    TooMany { what: String, kind: &'static str, count: u32, limit: u32 },
    #[error("the uniforms of {what} take {bytes} bytes, but this device allows {limit}: use fewer or shorter ones")]
    UniformsTooLarge { what: String, bytes: u64, limit: u64 },
    #[error("the graphics device ran out of memory for {0}")]
    OutOfMemory(String),
    #[error(
        "the graphics driver has not answered for {secs} s: a program that hangs the GPU stops every other program on it. \
         End that program, or restart the machine"
    )]
    NoAnswer { secs: u64 },
    #[error("the graphics device was lost: {0}")]
    Lost(String),
    /// wgpu rejected something that Eddy created: Eddy's own bug.
    #[error("this is a bug in Eddy: the graphics layer refused {what}: {reason}")]
    Refused { what: String, reason: String },
}

/// The division of frames into parts that are submitted one after the other.
#[derive(Clone)]
pub struct Slices {
    /// The time that a part may take.
    pub limit: Duration,
    /// Returns milliseconds from an arbitrary origin.
    pub now: Arc<dyn Fn() -> f64 + Send + Sync>,
}

/// An arbitrary limit: 1,000 times the iterations of a long ray march, and few enough to end. The cost of counting them
/// is not measured.
const MAX_LOOP_ITERATIONS: u32 = 1 << 22;

/// A device and its queue. Cheap to clone; every clone is the same device.
#[derive(Clone)]
pub struct Gpu {
    pub device: wgpu::Device,
    pub queue: wgpu::Queue,
    pub info: wgpu::AdapterInfo,
    /// Linear samplers support rgba32f textures.
    pub filters_float32: bool,
    /// Fragment shaders can read storage buffers.
    pub has_storage_buffers: bool,
    /// A program is recompiled for every frame if one of its branches depends on uniforms alone: lavapipe, Mesa's
    /// Vulkan on the CPU, tries how much shorter it becomes with their values inlined (`lvp_inline_uniforms.c`).
    pub recompiles_for_uniforms: bool,
    /// Denormals are kept nondeterministically. After a fragment that fails the depth test was meant for a target of
    /// 16-bit floats, the thread that processed it no longer flushes denormal numbers to zero, and which texels that
    /// thread draws is chance: llvmpipe enables denormals for the conversion to 16 bits, and returns early without
    /// resetting that (`generate_unswizzled_blend` in `lp_state_fs.c`). Programs that may discard do the depth test on
    /// another path.
    pub keeps_denormals: bool,
    /// `atan2(0, 0)` may be NaN, as in Direct3D; on Shadertoy, which then computes another angle, it is 0.
    pub nan_angle: bool,
    /// The minimum or maximum of a number and NaN may be NaN, where GPUs return the number. Some drivers that draw on
    /// the CPU do so, which SPIR-V allows.
    pub nan_extremes: bool,
    /// Long arrays must be filled and copied by loops, and their zero initialisers omitted: lavapipe turns them into
    /// one store per scalar, for which LLVM takes more than quadratic time.
    pub wants_array_loops: bool,
    /// A value that a loop computes before its first exit may be wrong after the loop, for pixels that leave earlier
    /// than others: gallivm, the compiler of llvmpipe and lavapipe, does not convert loops to loop-closed SSA form.
    pub keeps_loops_open: bool,
    /// A discarded fragment runs on to the end of the program: gallivm only masks its writes.
    pub runs_discarded: bool,
    /// Indexed arrays are in memory, and are stored to pixel by pixel: gallivm does so.
    pub scatters_arrays: bool,
    /// A loop that counts down to `min(c, x)` ends at `c`: Mesa's compiler confuses the two.
    pub misjudges_limits: bool,
    /// A loop over an array by its counter is always unrolled, regardless of the cost: Mesa's compiler does so.
    pub unrolls_whole_arrays: bool,
    /// Shaders are compiled for the CPU in this process, by a compiler whose time and memory grow out of proportion for
    /// large shaders: LLVM in lavapipe, Subzero in SwiftShader.
    pub compiles_here: bool,
    /// The number of iterations after which a shader leaves loops that may be endless: they would block the device for
    /// all programs until a reset or longer. `None` on a CPU, which can be shared.
    pub max_loop_iterations: Option<u32>,
    /// The compiler of shaders on Direct3D 12; `None` on other backends.
    pub hlsl_compiler: Option<HlslCompiler>,
    /// Timestamps can be written between passes.
    pub has_timestamps: bool,
    /// A window is painted on this device too: engines submit their frames in slices, so that painting runs in between.
    pub slices: Option<Slices>,
    /// Modules are given to the driver as SPIR-V where that should differ from what wgpu writes (`spirv`).
    pub(super) passes_spirv: bool,
    pub(super) treat_as_gpu: bool,
    pub(super) runtime_checks: bool,
    pub(super) fences: Option<super::fences::FenceKeeper>,
    /// Present where a face of a cubemap cannot be read through a view of its own.
    pub(super) faces: Option<Arc<Faces>>,
    state: Arc<State>,
}

#[derive(Default)]
struct State {
    lost: AtomicBool,
    /// The first uncaptured error, stored until it is taken.
    uncaptured: Mutex<Option<String>>,
}

impl Gpu {
    /// Opens a separate device, for use without a window.
    pub fn new(options: &GpuOptions) -> Result<Gpu, GpuError> {
        let mut reasons = Vec::new();
        for descriptor in Self::instance_descriptors() {
            let instance = wgpu::Instance::new(descriptor);
            match options.adapter.choose(&instance, None) {
                Ok(adapter) => return Self::from_adapter(&adapter, options),
                Err(why) => reasons.push(why),
            }
        }
        Err(options.adapter.missing(&reasons))
    }

    /// Opens another device on the adapter of `info`, from a separate instance, so that neither waits in the other's
    /// queue. Threads that a driver starts for it inherit from the calling thread. If the adapter is not found again,
    /// one is chosen as by [`Gpu::new`].
    pub fn on_adapter(info: &wgpu::AdapterInfo, options: &GpuOptions) -> Result<Gpu, GpuError> {
        let is_same = |other: &wgpu::AdapterInfo| {
            (&other.name, other.backend, other.vendor, other.device, &other.device_pci_bus_id)
                == (&info.name, info.backend, info.vendor, info.device, &info.device_pci_bus_id)
        };
        for descriptor in Self::instance_descriptors() {
            let instance = wgpu::Instance::new(descriptor);
            let adapters = pollster::block_on(instance.enumerate_adapters(info.backend.into()));
            if let Some(adapter) = adapters.into_iter().find(|adapter| is_same(&adapter.get_info())) {
                return Self::from_adapter(&opengl::with_float_targets(&instance, adapter), options);
            }
        }
        Self::new(options)
    }

    /// Returns the instance descriptors to try, in order of preference, also for an instance that a window's surface is
    /// created from: Vulkan, Metal or DX12, and OpenGL only if none of them has a device, since merely opening it costs
    /// start-up time. `WGPU_BACKEND` overrides both.
    pub fn instance_descriptors() -> [wgpu::InstanceDescriptor; 2] {
        [wgpu::Backends::PRIMARY, wgpu::Backends::GL].map(|backends| {
            let mut descriptor = wgpu::InstanceDescriptor::new_without_display_handle();
            // Validation layers add a second to the start and are meant for debugging Eddy itself: WGPU_VALIDATION
            // turns them on.
            descriptor.flags = wgpu::InstanceFlags::empty();
            descriptor.backends = backends;
            descriptor.with_env()
        })
    }

    /// Opens a device of the given adapter, for example the window's.
    pub fn from_adapter(adapter: &wgpu::Adapter, options: &GpuOptions) -> Result<Gpu, GpuError> {
        let info = adapter.get_info();
        let offered = adapter.features();
        let mut features = wgpu::Features::empty();
        if options.use_float32_filtering {
            features |= offered & wgpu::Features::FLOAT32_FILTERABLE;
        }
        if options.use_timestamps {
            features |= offered & wgpu::Features::TIMESTAMP_QUERY;
        }
        let is_lavapipe = info.backend == wgpu::Backend::Vulkan && info.name.starts_with("llvmpipe");
        if info.backend == wgpu::Backend::Vulkan {
            features |= offered & wgpu::Features::PASSTHROUGH_SHADERS;
        }
        if !opengl::has_float_targets(adapter) {
            return Err(opengl::no_float_targets(&info));
        }
        let (device, queue) = pollster::block_on(adapter.request_device(&wgpu::DeviceDescriptor {
            label: Some("eddy"),
            required_features: features,
            required_limits: options.limits.iter().fold(adapter.limits(), |all, some| all.or_worse_values_from(some)),
            // Large textures get dedicated memory, which is released when the canvas becomes smaller. With the other
            // hint, blocks of hundreds of megabytes stay allocated as long as each contains a small buffer.
            memory_hints: wgpu::MemoryHints::MemoryUsage,
            ..Default::default()
        }))
        .map_err(|e| GpuError::NoDevice { adapter: info.name.clone(), reason: e.to_string() })?;
        if !features.contains(wgpu::Features::FLOAT32_FILTERABLE) {
            log::warn!("{} cannot filter 32-bit float textures: filtered reads use four fetches", info.name);
        }
        let mesa = mesa::version(&info.driver_info);
        let passes_spirv = features.contains(wgpu::Features::PASSTHROUGH_SHADERS);
        let is_llvmpipe = info.name.starts_with("llvmpipe");
        // A report about a panic names the newest device.
        log::info!(target: "eddy::device", "{} ({}, {})", info.name, info.backend, info.driver_info);
        let hlsl_compiler = HlslCompiler::of(info.backend);
        if let Some(warning) = hlsl_compiler.as_ref().and_then(HlslCompiler::warning) {
            log::warn!("{warning}");
        }
        let state = Arc::new(State::default());
        let lost = state.clone();
        device.set_device_lost_callback(move |reason, message| {
            if reason != wgpu::DeviceLostReason::Destroyed {
                log::error!("graphics device lost: {message}");
                lost.lost.store(true, Ordering::Relaxed);
            }
        });
        let errors = state.clone();
        device.on_uncaptured_error(Arc::new(move |error: wgpu::Error| {
            log::error!("graphics layer: {error}");
            errors.uncaptured.lock().unwrap_or_else(|e| e.into_inner()).get_or_insert(error.to_string());
        }));
        let gpu = Gpu {
            has_storage_buffers: device.limits().max_storage_buffers_per_shader_stage > 0,
            filters_float32: features.contains(wgpu::Features::FLOAT32_FILTERABLE),
            recompiles_for_uniforms: is_lavapipe,
            keeps_denormals: is_lavapipe,
            // A GPU's compiler takes milliseconds where LLVM takes seconds; SwiftShader and WARP compile as LLVM does.
            compiles_here: info.device_type == wgpu::DeviceType::Cpu,
            passes_spirv,
            wants_array_loops: is_lavapipe && passes_spirv,
            runs_discarded: is_llvmpipe,
            scatters_arrays: is_llvmpipe,
            misjudges_limits: info.driver_info.contains("Mesa") && mesa::misjudges_limits(mesa),
            unrolls_whole_arrays: info.driver_info.contains("Mesa"),
            keeps_loops_open: is_llvmpipe && mesa::keeps_loops_open(mesa),
            nan_extremes: passes_spirv && info.device_type == wgpu::DeviceType::Cpu && mesa::has_nan_extremes(mesa),
            nan_angle: info.backend == wgpu::Backend::Dx12,
            max_loop_iterations: (info.device_type != wgpu::DeviceType::Cpu).then_some(MAX_LOOP_ITERATIONS),
            hlsl_compiler,
            slices: None,
            treat_as_gpu: options.treat_as_gpu,
            runtime_checks: options.runtime_checks,
            fences: is_lavapipe.then(|| super::fences::FenceKeeper::new(&device)),
            faces: (info.backend == wgpu::Backend::Gl).then(Arc::default),
            has_timestamps: features.contains(wgpu::Features::TIMESTAMP_QUERY),
            device,
            queue,
            info,
            state,
        };
        if gpu.info.backend == wgpu::Backend::Gl {
            opengl::filter_across_faces(&gpu.device);
            opengl::try_float_targets(&gpu)?;
        }
        Ok(gpu)
    }

    /// Returns a description for users: the adapter's name, the backend and the driver.
    pub fn describe(&self) -> String {
        format!("{} ({}, {})", self.info.name, self.info.backend, self.info.driver_info)
    }

    /// Returns the same device for engines that share it with a window.
    pub fn in_slices(&self, slices: Slices) -> Gpu {
        Gpu { slices: Some(slices), ..self.clone() }
    }

    /// Returns whether both are the same device.
    pub fn is_same_device(&self, other: &Gpu) -> bool {
        // Ids of wgpu's devices are those of their instances.
        Arc::ptr_eq(&self.state, &other.state)
    }

    /// Runs code that creates graphics objects, and returns an error of the graphics layer instead of a broken object.
    pub(super) fn guarded<T>(&self, what: &str, make: impl FnOnce() -> T) -> Result<T, GpuError> {
        let validation = self.device.push_error_scope(wgpu::ErrorFilter::Validation);
        let memory = self.device.push_error_scope(wgpu::ErrorFilter::OutOfMemory);
        let internal = self.device.push_error_scope(wgpu::ErrorFilter::Internal);
        let made = make();
        let refused = |reason: String| GpuError::Refused { what: what.into(), reason };
        let internal = pollster::block_on(internal.pop()).map(|e| refused(e.to_string()));
        let memory = pollster::block_on(memory.pop()).map(|_| GpuError::OutOfMemory(what.into()));
        let validation = pollster::block_on(validation.pop()).map(|e| refused(e.to_string()));
        match memory.or(validation).or(internal) {
            Some(error) => Err(error),
            None => Ok(made),
        }
    }

    /// Marks the device as lost.
    #[cfg(feature = "testing")]
    pub(super) fn mark_lost(&self) {
        self.state.lost.store(true, Ordering::Relaxed);
    }

    pub fn is_lost(&self) -> bool {
        self.state.lost.load(Ordering::Relaxed)
    }

    /// Waits until the device has finished all submitted work.
    pub fn wait(&self) -> Result<(), GpuError> {
        loss::poll(&self.device, wgpu::PollType::wait_indefinitely()).map_err(GpuError::Lost)?;
        self.take_error("a frame")
    }

    /// Returns the uncaptured error since the last call, if there was one.
    pub fn take_error(&self, what: &str) -> Result<(), GpuError> {
        if self.is_lost() {
            return Err(GpuError::Lost("the driver gave up, often because a shader ran too long".into()));
        }
        match self.state.uncaptured.lock().unwrap_or_else(|e| e.into_inner()).take() {
            None => Ok(()),
            Some(reason) => Err(GpuError::Refused { what: what.into(), reason }),
        }
    }
}
