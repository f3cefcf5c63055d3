//! The window's surface: paints egui's triangles on the screen.
//!
//! Owns the surface, egui's renderer and the back buffer that is copied to the surface, and recovers from a surface
//! that is outdated, lost or hidden. Knows nothing of what is painted.

use super::{
    GuiError,
    back_buffer::{self, BackBuffer, Painting},
    color_space,
    damage::Area,
    surface_faults::Faults,
};
use crate::gpu::{AdapterChoice, Gpu, GpuError, GpuOptions, loss, of_backends, without_windows};
use egui_wgpu::{Renderer, RendererOptions, ScreenDescriptor};
use std::{
    panic::{AssertUnwindSafe, catch_unwind, resume_unwind},
    sync::Arc,
};
use winit::{dpi::PhysicalSize, event_loop::OwnedDisplayHandle, window::Window};

/// A device that draws on the window, with all that it was opened from.
struct Opened {
    instance: wgpu::Instance,
    surface: wgpu::Surface<'static>,
    adapter: wgpu::Adapter,
    gpu: Gpu,
}

/// Returns the first device that can be opened for the window. The error names the reason of each backend.
fn open(
    window: &Arc<Window>,
    display: &OwnedDisplayHandle,
    choice: &AdapterChoice,
    open_device: impl Fn(&wgpu::Adapter) -> Result<Gpu, GpuError>,
) -> Result<Opened, GuiError> {
    let mut reasons = Vec::new();
    for mut descriptor in Gpu::instance_descriptors() {
        let backends = descriptor.backends;
        descriptor.display = Some(Box::new(display.clone()));
        let instance = wgpu::Instance::new(descriptor);
        let found = match instance.create_surface(window.clone()) {
            Ok(surface) => choice.choose(&instance, Some(&surface)).map(|adapter| (surface, adapter)),
            // No driver of these backends supports windows. wgpu's message names neither the driver nor the device.
            Err(error) => {
                log::debug!("{error}");
                Err(without_windows(&instance))
            }
        };
        let (surface, adapter) = match found {
            Ok(found) => found,
            Err(why) => {
                reasons.push(of_backends(backends, why));
                continue;
            }
        };
        match open_device(&adapter) {
            Ok(gpu) => {
                for why in reasons {
                    log::info!("{} draws the window: {why}", gpu.info.name);
                }
                return Ok(Opened { instance, surface, adapter, gpu });
            }
            Err(why) => reasons.push(why.to_string()),
        }
    }
    Err(GuiError::Gpu(choice.missing_for_window(&reasons)))
}

/// Returns the options for the window's device on an adapter. With the variable `EDDY_TREAT_AS_GPU`, a processor that draws is treated as
/// a GPU: tests use it to run what only GPUs do.
fn options(adapter: AdapterChoice) -> GpuOptions {
    let treat_as_gpu = std::env::var_os("EDDY_TREAT_AS_GPU").is_some();
    GpuOptions { adapter, treat_as_gpu, ..GpuOptions::default() }
}

/// Returns the mode in which frames wait for the screen, or that in which they do not.
fn present_mode(vsync: bool) -> wgpu::PresentMode {
    if vsync { wgpu::PresentMode::AutoVsync } else { wgpu::PresentMode::AutoNoVsync }
}

fn config(
    surface: &wgpu::Surface<'_>,
    adapter: &wgpu::Adapter,
    size: PhysicalSize<u32>,
    vsync: bool,
) -> Result<wgpu::SurfaceConfiguration, GuiError> {
    let mut config = surface
        .get_default_config(adapter, size.width.max(1), size.height.max(1))
        .ok_or_else(|| GuiError::Surface(format!("{} cannot draw on this window", adapter.get_info().name)))?;
    // egui blends in display values, and the picture must arrive byte for byte: no conversion to sRGB.
    let capabilities = surface.get_capabilities(adapter);
    config.format =
        egui_wgpu::preferred_framebuffer_format(&capabilities.formats).map_err(|e| GuiError::Surface(e.to_string()))?;
    // The painting is kept in a back buffer, and copied to the screen where that is supported.
    config.usage |= capabilities.usages & wgpu::TextureUsages::COPY_DST;
    // The values are sRGB's, and a screen with more colours must convert them. A surface without a list of colour spaces
    // chooses by itself.
    let tagged = capabilities.color_spaces(config.format).contains(wgpu::SurfaceColorSpaces::SRGB);
    config.color_space = if tagged { wgpu::SurfaceColorSpace::Srgb } else { wgpu::SurfaceColorSpace::Auto };
    config.present_mode = present_mode(vsync);
    config.desired_maximum_frame_latency = 1;
    Ok(config)
}

fn renderer(gpu: &Gpu, config: &wgpu::SurfaceConfiguration) -> Renderer {
    // Dithering would change the picture's own values.
    let options = RendererOptions { dithering: false, ..Default::default() };
    Renderer::new(&gpu.device, config.format, options)
}

/// The result of presenting a frame.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Presented {
    Shown,
    /// The window is not visible; painting again before it changes is useless.
    Hidden,
    /// The surface was recreated: paint again.
    Again,
}

pub(super) struct Surface {
    display: OwnedDisplayHandle,
    options: GpuOptions,
    instance: wgpu::Instance,
    surface: wgpu::Surface<'static>,
    config: wgpu::SurfaceConfiguration,
    renderer: Renderer,
    back_buffer: BackBuffer,
    gpu: Gpu,
    needs_configure: bool,
    vsync: bool,
    faults: Faults,
    /// The number of times in a row that the surface did not take its size.
    refusals: u32,
}

/// The number of refusals in a row that is reported as an error.
const REFUSALS: u32 = 200;

impl Surface {
    /// Creates a surface for the window, and the device that can draw on it.
    pub(super) fn new(
        window: &Arc<Window>,
        display: OwnedDisplayHandle,
        adapter: AdapterChoice,
    ) -> Result<Surface, GuiError> {
        let options = options(adapter);
        let open_device = |adapter: &wgpu::Adapter| Gpu::from_adapter(adapter, &options);
        let Opened { instance, surface, adapter, gpu } = open(window, &display, &options.adapter, open_device)?;
        let config = config(&surface, &adapter, window.inner_size(), true)?;
        surface.configure(&gpu.device, &config);
        color_space::tag_as_srgb(&surface);
        let renderer = renderer(&gpu, &config);
        Ok(Surface {
            display,
            options,
            instance,
            surface,
            config,
            renderer,
            back_buffer: BackBuffer::default(),
            gpu,
            needs_configure: false,
            vsync: true,
            faults: Faults::of_environment(),
            refusals: 0,
        })
    }

    /// Replaces the lost device and surface with new ones. egui's fonts are kept; all other textures were on the lost
    /// device, and must be recreated by their owners.
    pub(super) fn reopen_device(&mut self, window: &Arc<Window>, ctx: &egui::Context) -> Result<(), GuiError> {
        let options = &self.options;
        let Opened { instance, surface, adapter, gpu } = open(window, &self.display, &options.adapter, |adapter| {
            loss::reopen(loss::RESET_TIMEOUT, || Gpu::from_adapter(adapter, options))
        })?;
        self.config = config(&surface, &adapter, window.inner_size(), self.vsync)?;
        // A window has one swapchain: the old surface must be dropped before a new one is created. That panics if the
        // device was lost while a frame was presented, which then still exists (see `present`).
        let old = std::mem::replace(&mut self.surface, surface);
        if catch_unwind(AssertUnwindSafe(|| drop(old))).is_err() {
            log::warn!("the surface of the lost device could not be released");
        }
        self.surface.configure(&gpu.device, &self.config);
        color_space::tag_as_srgb(&self.surface);
        self.renderer = renderer(&gpu, &self.config);
        self.back_buffer = BackBuffer::default();
        let fonts = egui::epaint::ImageDelta::full(
            ctx.fonts(|fonts| fonts.image()),
            egui::epaint::TextureAtlas::texture_options(),
        );
        self.renderer.update_texture(&gpu.device, &gpu.queue, egui::TextureId::default(), &fonts);
        (self.instance, self.gpu) = (instance, gpu);
        (self.needs_configure, self.refusals) = (false, 0);
        Ok(())
    }

    pub(super) fn gpu(&self) -> &Gpu {
        &self.gpu
    }

    pub(super) fn renderer(&mut self) -> &mut Renderer {
        &mut self.renderer
    }

    /// Marks a texture that egui does not own as changed since the last painting.
    pub(super) fn touch(&mut self, texture: egui::TextureId) {
        self.back_buffer.touch(texture);
    }

    /// Returns the size in physical pixels.
    pub(super) fn size(&self) -> (u32, u32) {
        (self.config.width, self.config.height)
    }

    /// Resizes the surface to the window's new size; an empty one (minimised) is deferred.
    pub(super) fn resize(&mut self, width: u32, height: u32) {
        if width > 0 && height > 0 && (width, height) != self.size() {
            let limit = self.gpu.device.limits().max_texture_dimension_2d;
            (self.config.width, self.config.height) = (width.min(limit), height.min(limit));
            self.needs_configure = true;
        }
    }

    /// Sets whether frames wait for the screen, from the next one on.
    pub(super) fn set_vsync(&mut self, vsync: bool) {
        if std::mem::replace(&mut self.vsync, vsync) != vsync {
            self.config.present_mode = present_mode(vsync);
            self.needs_configure = true;
        }
    }

    /// Replaces the surface by a new one of the window, as after a suspension in which the system has taken it back. What
    /// has been painted is kept.
    pub(super) fn recreate(&mut self, window: &Arc<Window>) {
        match self.instance.create_surface(window.clone()) {
            Ok(surface) => self.surface = surface,
            Err(e) => log::error!("the window's surface was lost and could not be recreated: {e}"),
        }
        self.needs_configure = true;
    }

    /// Paints and shows a frame of egui.
    pub(super) fn paint(&mut self, window: &Arc<Window>, output: egui::FullOutput, ctx: &egui::Context) -> Presented {
        match catch_unwind(AssertUnwindSafe(|| self.paint_on_device(window, output, ctx))) {
            Ok(presented) => presented,
            // egui's renderer panics if a lost device cannot allocate memory. Both are replaced.
            Err(_) if self.gpu.is_lost() => Presented::Again,
            Err(panic) => resume_unwind(panic),
        }
    }

    fn paint_on_device(&mut self, window: &Arc<Window>, output: egui::FullOutput, ctx: &egui::Context) -> Presented {
        let egui::FullOutput { shapes, pixels_per_point, mut textures_delta, .. } = output;
        let triangles = ctx.tessellate(shapes, pixels_per_point);
        let (device, queue) = (&self.gpu.device, &self.gpu.queue);
        // Texture changes are applied even if nothing can be shown: egui reports each change once.
        for (id, deltas) in textures_delta.set.drain() {
            for delta in deltas {
                self.renderer.update_texture(device, queue, id, &delta);
                self.back_buffer.update(id, &delta);
            }
        }
        let presented = self.present(window, triangles, pixels_per_point);
        for id in textures_delta.free.drain() {
            self.renderer.free_texture(&id);
        }
        presented
    }

    /// Configures the surface with the window's size. Returns false if it was refused and keeps the old size, to be
    /// retried: configuring waits until the device is idle, and if another thread (a compile, a thumbnail) submits
    /// work meanwhile, wgpu gives up.
    fn configure(&mut self) -> bool {
        let scope = self.gpu.device.push_error_scope(wgpu::ErrorFilter::Validation);
        self.surface.configure(&self.gpu.device, &self.config);
        let refused = pollster::block_on(scope.pop());
        color_space::tag_as_srgb(&self.surface);
        if let Some(error) = &refused {
            self.refusals += 1;
            // Once, and not at each of the following frames.
            let level = if self.refusals == REFUSALS { log::Level::Error } else { log::Level::Debug };
            log::log!(level, "the window could not be resized: {error}");
            // Give the device time to become idle.
            std::thread::sleep(std::time::Duration::from_millis(1));
        } else {
            self.refusals = 0;
        }
        refused.is_none()
    }

    fn present(
        &mut self,
        window: &Arc<Window>,
        triangles: Vec<egui::ClippedPrimitive>,
        pixels_per_point: f32,
    ) -> Presented {
        if self.needs_configure {
            if !self.configure() {
                return Presented::Again;
            }
            self.needs_configure = false;
        }
        let current = match self.faults.next() {
            Some(fault) => fault,
            None => self.surface.get_current_texture(),
        };
        let frame = match current {
            wgpu::CurrentSurfaceTexture::Success(frame) => frame,
            wgpu::CurrentSurfaceTexture::Suboptimal(frame) => {
                self.needs_configure = true;
                frame
            }
            wgpu::CurrentSurfaceTexture::Occluded => return Presented::Hidden,
            wgpu::CurrentSurfaceTexture::Timeout => return Presented::Again,
            wgpu::CurrentSurfaceTexture::Outdated | wgpu::CurrentSurfaceTexture::Validation => {
                self.needs_configure = true;
                return Presented::Again;
            }
            wgpu::CurrentSurfaceTexture::Lost => {
                self.recreate(window);
                return Presented::Again;
            }
        };
        let (device, queue) = (&self.gpu.device, &self.gpu.queue);
        let mut encoder = device.create_command_encoder(&wgpu::CommandEncoderDescriptor { label: Some("window") });
        // Use the actual size of the frame: the window's may have changed since.
        let size_in_pixels = [frame.texture.width(), frame.texture.height()];
        let screen = ScreenDescriptor { size_in_pixels, pixels_per_point };
        let (gpu, renderer) = (&self.gpu, &mut self.renderer);
        let mut commands = if self.config.usage.contains(wgpu::TextureUsages::COPY_DST) {
            let painting = Painting { triangles, screen: &screen, format: frame.texture.format() };
            let (contents, commands) = self.back_buffer.paint(gpu, renderer, &mut encoder, painting);
            encoder.copy_texture_to_texture(
                contents.as_image_copy(),
                frame.texture.as_image_copy(),
                frame.texture.size(),
            );
            commands
        } else {
            let [width, height] = size_in_pixels;
            let whole = [Area { x: 0, y: 0, width, height }];
            let view = frame.texture.create_view(&wgpu::TextureViewDescriptor::default());
            back_buffer::paint_areas(gpu, renderer, &mut encoder, &view, triangles, &screen, &whole)
        };
        commands.push(encoder.finish());
        queue.submit(commands);
        if self.gpu.is_lost() {
            // wgpu neither presents nor discards the texture of a lost device, and the surface cannot be dropped before
            // the texture is. Unwinding releases it (https://github.com/gfx-rs/wgpu/issues/8243); `paint` ends it.
            resume_unwind(Box::new("the device was lost"));
        }
        window.pre_present_notify();
        queue.present(frame);
        Presented::Shown
    }
}
