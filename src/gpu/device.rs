//! The device and what was found out about it, and the place of a thread among others where a processor draws.

use super::loss;
use std::sync::{
    Arc, Mutex,
    atomic::{AtomicBool, Ordering},
};

/// The features that are asked of the machine.
#[derive(Clone, Debug)]
pub struct GpuOptions {
    /// Use filtering of 32-bit float textures where the adapter has it. Off, every such read is written by hand: how
    /// the fallback is tested on a device that needs none.
    pub use_float32_filtering: bool,
    /// Use timestamp queries where the adapter has them.
    pub use_timestamps: bool,
    /// Let naga add its own checks to shaders (indices, loops, integer division), which Eddy's front end makes
    /// needless: how their cost is measured.
    pub runtime_checks: bool,
}

impl Default for GpuOptions {
    fn default() -> Self {
        Self { use_float32_filtering: true, use_timestamps: true, runtime_checks: false }
    }
}

/// The machine cannot do what was asked.
#[derive(Debug, thiserror::Error)]
pub enum GpuError {
    #[error(
        "no graphics device found ({0}). On Debian or Ubuntu, `apt-get install mesa-vulkan-drivers` installs one \
         that runs on the CPU"
    )]
    NoAdapter(String),
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
    #[error("{what} has {count} targets, but this device draws into at most {limit} at once")]
    TooManyTargets { what: String, count: u32, limit: u32 },
    #[error("the graphics device ran out of memory for {0}")]
    OutOfMemory(String),
    #[error(
        "the graphics driver has not answered for {secs} s: a program that hangs the GPU stops every other program on it. \
         End that program, or restart the machine"
    )]
    NoAnswer { secs: u64 },
    #[error("the graphics device was lost: {0}")]
    Lost(String),
    /// wgpu refused something Eddy made: Eddy's own bug.
    #[error("this is a bug in Eddy: the graphics layer refused {what}: {reason}")]
    Refused { what: String, reason: String },
}

/// A choice: 1,000 times the rounds of a long ray march, and few enough to end. What counting them costs is not measured.
const MOST_ROUNDS: u32 = 1 << 22;

/// One device and its queue. Cheap to clone; every clone is the same device.
#[derive(Clone)]
pub struct Gpu {
    pub device: wgpu::Device,
    pub queue: wgpu::Queue,
    pub info: wgpu::AdapterInfo,
    /// A linear sampler may read an rgba32f texture.
    pub filters_float32: bool,
    /// Fragment shaders can read storage buffers.
    pub has_storage_buffers: bool,
    /// A program is compiled anew for every frame if one of its branches depends on uniforms alone: lavapipe, Mesa's
    /// Vulkan on the processor, tries how much shorter it becomes with their values in it (`lvp_inline_uniforms.c`).
    pub recompiles_for_uniforms: bool,
    /// Once a fragment that fails the depth test was meant for a target of 16-bit floats, the thread that met it no
    /// longer takes denormal numbers for zeros, and which texels it draws is chance: llvmpipe lets them through to
    /// convert to 16 bits, and returns on a way past the end of that (`generate_unswizzled_blend` in `lp_state_fs.c`).
    /// Programs that may discard test depth on another way.
    pub keeps_denormals: bool,
    /// `atan2(0, 0)` may be NaN, as Direct3D has it; on the site, which then asks for another angle, it is 0.
    pub nan_angle: bool,
    /// Long arrays are to be filled and copied by loops, and initialisers of their zeros left out: lavapipe makes one
    /// store a scalar of each, for which LLVM takes time that grows faster than their square.
    pub wants_array_loops: bool,
    /// A value that a loop computes before its first exit may be wrong after it, for pixels that leave before others
    /// do: gallivm, the compiler of llvmpipe and lavapipe, does not bring loops into loop-closed SSA form.
    pub keeps_loops_open: bool,
    /// A fragment that is discarded runs on to the end of the program: gallivm only keeps it from being written.
    pub runs_discarded: bool,
    /// Arrays that are indexed lie in memory, and are stored to pixel by pixel: gallivm does so.
    pub scatters_arrays: bool,
    /// A loop that counts down to `min(c, x)` ends at `c`: Mesa's compiler takes the one for the other.
    pub misjudges_limits: bool,
    /// A loop over an array by its counter is written out whatever it costs: Mesa's compiler does so.
    pub unrolls_whole_arrays: bool,
    /// Shaders are compiled on the processor by a compiler that takes time and memory out of proportion for large ones,
    /// in this process: LLVM, in lavapipe.
    pub compiles_here: bool,
    /// Rounds after which a shader leaves loops that may never end: it would keep every program from the device, until it
    /// is reset or longer. `None`: on a processor, which has time for others.
    pub most_rounds: Option<u32>,
    /// Timestamps can be written between passes.
    pub has_timestamps: bool,
    pub(super) runtime_checks: bool,
    pub(super) fences: Option<super::fences::FenceKeeper>,
    state: Arc<State>,
}

#[derive(Default)]
struct State {
    lost: AtomicBool,
    /// The first error nobody asked for, kept until somebody takes it.
    uncaptured: Mutex<Option<String>>,
}

impl Gpu {
    /// A device of its own, for use without a window.
    pub fn new(options: &GpuOptions) -> Result<Gpu, GpuError> {
        let mut reasons = Vec::new();
        for descriptor in Self::instance_descriptors() {
            let instance = wgpu::Instance::new(descriptor);
            let adapter = pollster::block_on(instance.request_adapter(&wgpu::RequestAdapterOptions {
                power_preference: wgpu::PowerPreference::HighPerformance,
                ..Default::default()
            }));
            match adapter {
                Ok(adapter) => return Self::from_adapter(&adapter, options),
                Err(e) => reasons.push(e.to_string()),
            }
        }
        Err(GpuError::NoAdapter(reasons.join("; ")))
    }

    /// Another device on the adapter that `info` is of, from an instance of its own: neither waits in the other's
    /// queue. Threads that a driver starts for it are those of the calling thread. An adapter that is not
    /// found again is chosen as by [`Gpu::new`].
    pub fn another(info: &wgpu::AdapterInfo, options: &GpuOptions) -> Result<Gpu, GpuError> {
        let is_same = |other: &wgpu::AdapterInfo| {
            (&other.name, other.backend, other.vendor, other.device, &other.device_pci_bus_id)
                == (&info.name, info.backend, info.vendor, info.device, &info.device_pci_bus_id)
        };
        for descriptor in Self::instance_descriptors() {
            let instance = wgpu::Instance::new(descriptor);
            let adapters = pollster::block_on(instance.enumerate_adapters(info.backend.into()));
            if let Some(adapter) = adapters.iter().find(|adapter| is_same(&adapter.get_info())) {
                return Self::from_adapter(adapter, options);
            }
        }
        Self::new(options)
    }

    /// Returns how to make the instance, best first, also where a window's surface must be made from it: Vulkan, Metal
    /// or DX12, and OpenGL only where none of them has a device, since merely opening it costs start-up time.
    /// `WGPU_BACKEND` overrides both.
    pub fn instance_descriptors() -> [wgpu::InstanceDescriptor; 2] {
        [wgpu::Backends::PRIMARY, wgpu::Backends::GL].map(|backends| {
            let mut descriptor = wgpu::InstanceDescriptor::new_without_display_handle();
            // Validation layers cost a start-up second and are for people who debug Eddy itself: WGPU_VALIDATION turns
            // them on.
            descriptor.flags = wgpu::InstanceFlags::empty();
            descriptor.backends = backends;
            descriptor.with_env()
        })
    }

    /// A device of the given adapter: the window's, for example.
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
        if is_lavapipe {
            features |= offered & wgpu::Features::PASSTHROUGH_SHADERS;
        }
        let float = adapter.get_texture_format_features(wgpu::TextureFormat::Rgba32Float).allowed_usages;
        if !float.contains(wgpu::TextureUsages::RENDER_ATTACHMENT) {
            let reason = "it cannot draw into 32-bit float textures".to_owned();
            return Err(GpuError::NoDevice { adapter: info.name, reason });
        }
        let (device, queue) = pollster::block_on(adapter.request_device(&wgpu::DeviceDescriptor {
            label: Some("eddy"),
            required_features: features,
            required_limits: adapter.limits(),
            // Large textures get memory of their own, which is given back when the canvas becomes smaller. Blocks of
            // hundreds of megabytes, as the other hint has them, stay for the sake of one small buffer in each.
            memory_hints: wgpu::MemoryHints::MemoryUsage,
            ..Default::default()
        }))
        .map_err(|e| GpuError::NoDevice { adapter: info.name.clone(), reason: e.to_string() })?;
        if !features.contains(wgpu::Features::FLOAT32_FILTERABLE) {
            log::warn!("{} cannot filter 32-bit float textures: filtered reads use four fetches", info.name);
        }
        // A report about a panic names the newest one.
        log::info!(target: "eddy::device", "{} ({}, {})", info.name, info.backend, info.driver_info);
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
        Ok(Gpu {
            has_storage_buffers: device.limits().max_storage_buffers_per_shader_stage > 0,
            filters_float32: features.contains(wgpu::Features::FLOAT32_FILTERABLE),
            recompiles_for_uniforms: is_lavapipe,
            keeps_denormals: is_lavapipe,
            compiles_here: is_lavapipe,
            wants_array_loops: features.contains(wgpu::Features::PASSTHROUGH_SHADERS),
            runs_discarded: info.name.starts_with("llvmpipe"),
            scatters_arrays: info.name.starts_with("llvmpipe"),
            misjudges_limits: info.driver_info.contains("Mesa"),
            unrolls_whole_arrays: info.driver_info.contains("Mesa"),
            keeps_loops_open: info.name.starts_with("llvmpipe"),
            nan_angle: info.backend == wgpu::Backend::Dx12,
            most_rounds: (info.device_type != wgpu::DeviceType::Cpu).then_some(MOST_ROUNDS),
            runtime_checks: options.runtime_checks,
            fences: is_lavapipe.then(|| super::fences::FenceKeeper::new(&device)),
            has_timestamps: features.contains(wgpu::Features::TIMESTAMP_QUERY),
            device,
            queue,
            info,
            state,
        })
    }

    /// The device is a processor that draws: its time is the machine's.
    pub fn is_cpu(&self) -> bool {
        self.info.device_type == wgpu::DeviceType::Cpu
    }

    /// One line for people: the adapter's name, the backend and the driver.
    pub fn describe(&self) -> String {
        format!("{} ({}, {})", self.info.name, self.info.backend, self.info.driver_info)
    }

    /// Refuses a size that no target can have, before the graphics layer does it with less grace.
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

    /// Runs code that makes graphics objects and turns what the graphics layer says of it into an error, instead of
    /// leaving a broken object behind.
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

    /// Waits until the device has done everything it was given.
    pub fn wait(&self) -> Result<(), GpuError> {
        loss::poll(&self.device, wgpu::PollType::wait_indefinitely()).map_err(GpuError::Lost)?;
        self.take_trouble("a frame")
    }

    /// Returns what went wrong since the last call as an error, if anything did.
    pub fn take_trouble(&self, what: &str) -> Result<(), GpuError> {
        if self.is_lost() {
            return Err(GpuError::Lost("the driver gave up, often because a shader ran too long".into()));
        }
        match self.state.uncaptured.lock().unwrap_or_else(|e| e.into_inner()).take() {
            None => Ok(()),
            Some(reason) => Err(GpuError::Refused { what: what.into(), reason }),
        }
    }
}

/// Lets other threads go before the calling one. On Linux this is a thread's own, and the threads that a driver starts
/// for it have it from it.
pub fn step_back(steps: i32) {
    #[cfg(target_os = "linux")]
    if let Err(error) = rustix::process::nice(steps) {
        log::debug!("a thread keeps its priority: {error}");
    }
    #[cfg(not(target_os = "linux"))]
    let _ = steps;
}
