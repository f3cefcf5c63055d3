//! The colour space of the window's surface, where `wgpu` does not set it.

/// Tags the surface's layer as sRGB. Without a colour space, macOS sends values unchanged to a screen with more colours than
/// sRGB, which shows them too saturated; `wgpu` leaves it out for sRGB (`metal/surface.rs` of `wgpu-hal` 30). It sets the
/// colour space to none whenever the surface is configured, so this is called after it.
#[cfg(target_os = "macos")]
pub(super) fn tag_as_srgb(surface: &wgpu::Surface<'_>) {
    use objc2_core_graphics::{CGColorSpace, kCGColorSpaceSRGB};
    // SAFETY: the layer is not kept, and is neither configured nor presented meanwhile, as both happen on this thread.
    let Some(surface) = (unsafe { surface.as_hal::<wgpu::hal::api::Metal>() }) else { return };
    // SAFETY: the system defines this constant, which is never changed.
    let space = CGColorSpace::with_name(Some(unsafe { kCGColorSpaceSRGB }));
    surface.render_layer().lock().setColorspace(space.as_deref());
}

/// Does nothing: Windows takes untagged surfaces for sRGB and `wgpu` tags them, X11 has no colour spaces, and compositors of
/// Wayland take surfaces without a description for sRGB.
#[cfg(not(target_os = "macos"))]
pub(super) fn tag_as_srgb(_: &wgpu::Surface<'_>) {}
