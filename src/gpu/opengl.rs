//! Work-arounds for OpenGL: targets of 32-bit floats, and filtering across the edges of a cubemap's faces.
//!
//! wgpu-hal 30 grants such targets only with the extensions `GL_ARB_color_buffer_float` and `GL_EXT_color_buffer_float`
//! (`gles/adapter.rs`, `color_buffer_float`). OpenGL 3.0 has them without an extension, and a core context of Mesa
//! lists none. `docs/upstream` has the fix for wgpu.
//!
//! The work-around: wgpu asks the driver which formats it supports only if the adapter does not support all of WebGPU's
//! formats, so the adapter is opened again with the flag for that. Whether the device really draws floats is then tried
//! ([`try_float_targets`]): OpenGL ES 3.0 without the extension does not.

use super::{Gpu, GpuError, Readback, Texture, TextureDescriptor};
use eddy_texture::{TexelFormat, TextureShape};

const FORMATS: wgpu::DownlevelFlags = wgpu::DownlevelFlags::WEBGPU_TEXTURE_FORMAT_SUPPORT;

/// Returns whether wgpu lets a device of this adapter draw into textures of 32-bit floats.
pub(super) fn has_float_targets(adapter: &wgpu::Adapter) -> bool {
    let granted = adapter.get_texture_format_features(wgpu::TextureFormat::Rgba32Float).allowed_usages;
    granted.contains(wgpu::TextureUsages::RENDER_ATTACHMENT)
        || adapter.get_downlevel_capabilities().flags.contains(FORMATS)
}

/// Returns the adapter, on OpenGL with targets of 32-bit floats.
#[cfg(not(target_vendor = "apple"))]
pub(super) fn with_float_targets(instance: &wgpu::Instance, adapter: wgpu::Adapter) -> wgpu::Adapter {
    use wgpu::hal::{Instance, api::Gles};
    if adapter.get_info().backend != wgpu::Backend::Gl || has_float_targets(&adapter) {
        return adapter;
    }
    // SAFETY: the instance is not destroyed, and is only asked for its adapters.
    let exposed = unsafe { instance.as_hal::<Gles>().map(|gl| gl.enumerate_adapters(None)) };
    // A context of OpenGL has one adapter.
    let Some(mut exposed) = exposed.and_then(|adapters| adapters.into_iter().next()) else { return adapter };
    exposed.capabilities.downlevel.flags |= FORMATS;
    // SAFETY: it is an adapter of this instance.
    unsafe { instance.create_adapter_from_hal(exposed) }
}

/// Returns the adapter: wgpu has no OpenGL here.
#[cfg(target_vendor = "apple")]
pub(super) fn with_float_targets(_: &wgpu::Instance, adapter: wgpu::Adapter) -> wgpu::Adapter {
    adapter
}

/// Lets samplers filter across the edges of a cubemap's faces, as everywhere else. OpenGL ES 3.0 always does; OpenGL only
/// where `GL_TEXTURE_CUBE_MAP_SEAMLESS` is enabled, which wgpu-hal 30 leaves out.
#[cfg(not(target_vendor = "apple"))]
pub(super) fn filter_across_faces(device: &wgpu::Device) {
    use glow::HasContext;
    // SAFETY: the device is not destroyed.
    let Some(device) = (unsafe { device.as_hal::<wgpu::hal::api::Gles>() }) else { return };
    let context = device.context().lock();
    if !context.version().is_embedded {
        // SAFETY: the lock has made the context current, and the capability exists since OpenGL 3.2. wgpu-hal needs 3.3.
        unsafe { context.enable(glow::TEXTURE_CUBE_MAP_SEAMLESS) };
    }
}

/// Does nothing: wgpu has no OpenGL here.
#[cfg(target_vendor = "apple")]
pub(super) fn filter_across_faces(_: &wgpu::Device) {}

/// Returns an error if a device on OpenGL does not draw into textures of 32-bit floats.
pub(super) fn try_float_targets(gpu: &Gpu) -> Result<(), GpuError> {
    const VALUE: [f32; 4] = [-2.5, 1e9, 0.1, 7.0];
    let descriptor = TextureDescriptor {
        label: "float target",
        shape: TextureShape::flat(1, 1, TexelFormat::Rgba32f),
        is_target: true,
    };
    let texture = Texture::new(gpu, &descriptor)?;
    let mut encoder =
        gpu.device.create_command_encoder(&wgpu::CommandEncoderDescriptor { label: Some("float target") });
    let [r, g, b, a] = VALUE.map(f64::from);
    texture.clear(gpu, &mut encoder, wgpu::Color { r, g, b, a });
    gpu.queue.submit([encoder.finish()]);
    match Readback::default().rgba32float(gpu, &texture)?[..] {
        [VALUE] => Ok(()),
        _ => Err(no_float_targets(&gpu.info)),
    }
}

/// Returns the error for an adapter that cannot draw into textures of 32-bit floats.
pub(super) fn no_float_targets(info: &wgpu::AdapterInfo) -> GpuError {
    let adapter = format!("{} ({})", info.name, info.backend);
    GpuError::NoDevice { adapter, reason: "it cannot draw into textures of 32-bit floats".to_owned() }
}
