//! The engine: the running program and its operations.

use super::{
    DrawFor, Drawn, EngineError, FrameInputs, FrameStats, Miniature, PassTime, Picture, Pixels, Program, Rows, TexelAt,
    display::Display,
    running::{Running, slice_times},
};
use super::{
    frame::{Caller, Watch},
    inspect::{Capture, PassInputs},
    shared::Shared,
    snapshot::{self, Extent, Snapshot},
    targets::Target,
    viewer::Viewer,
};
use eddy_gpu::{FloatConverter, Gpu, MINIATURE_SIZE, Miniatures, Presenter, Readback, ValueLook};
use eddy_graph::{Purpose, Traffic};
use eddy_project::{CustomUniformValues, PassName};
use eddy_texture::{TexelFormat, TextureShape};
use eddy_video::CameraFrame;
use std::sync::{Arc, atomic::AtomicBool};

/// A device, and the program that runs on it.
pub struct Engine {
    pub(super) shared: Shared,
    canvas: (u32, u32),
    /// True if the canvas may be larger than a target: see [`Engine::for_tiles`].
    is_for_tiles: bool,
    pub(super) running: Option<Running>,
    pub(super) display: Display,
    is_timing: bool,
    /// For reading back formats other than rgba32float; created when first needed.
    converter: Option<FloatConverter>,
    pub(super) readback: Readback,
    /// For panels that show thumbnails of passes; created when first used.
    miniatures: Option<(Miniatures, Readback)>,
    /// For panels that show the values of targets; created when first used.
    viewer: Option<Viewer>,
}

impl Engine {
    /// Creates an engine without a program: its picture is black. Fails for a size that no target can have.
    pub fn new(gpu: Gpu, width: u32, height: u32) -> Result<Engine, EngineError> {
        gpu.check_size("the picture", width, height)?;
        Self::with_display(gpu, (width, height), (width, height))
    }

    /// Returns an engine for a canvas that may be larger than any target: one pass is drawn in tiles
    /// ([`BuildOptions::tile`]). It displays nothing.
    ///
    /// [`BuildOptions::tile`]: super::BuildOptions::tile
    pub fn for_tiles(gpu: Gpu, width: u32, height: u32) -> Result<Engine, EngineError> {
        let engine = Self::with_display(gpu, (width.max(1), height.max(1)), (1, 1))?;
        Ok(Engine { is_for_tiles: true, ..engine })
    }

    fn with_display(gpu: Gpu, canvas: (u32, u32), display: (u32, u32)) -> Result<Engine, EngineError> {
        Ok(Engine {
            canvas,
            is_for_tiles: false,
            running: None,
            display: Display::new(&gpu, display)?,
            is_timing: false,
            converter: None,
            readback: Readback::default(),
            miniatures: None,
            viewer: None,
            shared: Shared::new(gpu)?,
        })
    }

    /// Swaps the whole program. Buffers that both programs have keep their texels, so an edit does not restart a
    /// simulation; new ones start with their initial contents, else as zeros. On an error the old program continues.
    pub fn set_program(&mut self, program: Program) -> Result<(), EngineError> {
        let mut running = Running::start(&mut self.shared, program, self.canvas, &mut self.running)?;
        running.set_timing(&self.shared, self.is_timing);
        self.display.rebind(&self.shared.gpu, self.canvas, &running.targets);
        self.running = Some(running);
        Ok(())
    }

    /// Draws one frame of a program that has never been drawn, on its own canvas, waits for it, and returns the program
    /// unchanged. Passes with a fixed size have it here too. The running program is unaffected.
    pub fn try_out(
        &mut self,
        program: Program,
        canvas: (u32, u32),
        inputs: &FrameInputs,
    ) -> Result<Program, EngineError> {
        let mut running = Running::start(&mut self.shared, program, canvas, &mut None)?;
        running.slices = slice_times(&self.shared, &running.program, canvas, self.running.as_ref());
        let mut caller = Caller { rows: &mut || None, watch: None, capture: None };
        running.draw(&self.shared, None, inputs, Purpose::Frame, &mut caller)?;
        self.shared.gpu.wait()?;
        Ok(running.program)
    }

    /// Sets the values of the author's own uniforms from the next frame on; uniforms missing in `values` have their
    /// defaults. Does not compile. Returns whether any value has changed.
    pub fn set_custom_uniforms(&mut self, values: &CustomUniformValues) -> bool {
        self.running.as_mut().is_some_and(|running| running.set_custom_uniforms(&self.shared, values))
    }

    /// Changes the canvas size. Every buffer keeps the overlap, texel for texel from the bottom left; the rest is reset
    /// to the contents before frame 0. On an error nothing changes.
    pub fn resize(&mut self, width: u32, height: u32) -> Result<(), EngineError> {
        if (width, height) == self.canvas {
            return Ok(());
        }
        if self.is_for_tiles {
            if let Some(running) = &mut self.running {
                running.resize(&mut self.shared, (width, height))?;
            }
            self.canvas = (width, height);
            return Ok(());
        }
        self.shared.gpu.check_size("the picture", width, height)?;
        let texture = Presenter::texture(&self.shared.gpu, width, height)?;
        if let Some(running) = &mut self.running {
            running.resize(&mut self.shared, (width, height))?;
        }
        self.canvas = (width, height);
        self.display.set_texture(texture);
        self.rebind_display();
        Ok(())
    }

    /// Resets every buffer to its contents before frame 0: those that the project sets, else zeros.
    pub fn reset(&mut self) {
        if let Some(running) = &mut self.running {
            running.reset(&self.shared);
        }
    }

    /// Draws one frame to show it. Does not wait for the device. A pass that is drawn in tiles is skipped:
    /// [`Engine::draw_tile`] draws it.
    pub fn draw(&mut self, inputs: &FrameInputs) -> Result<FrameStats, EngineError> {
        Ok(self.draw_for(inputs, DrawFor::Frame)?.stats)
    }

    /// Ends frames early while this is set, with [`EngineError::Stopped`]. It only takes effect on a device that is shared
    /// with a window ([`Gpu::slices`]), between two slices of a frame.
    pub fn stop_by(&mut self, stop: Arc<AtomicBool>) {
        self.shared.stop = stop;
    }

    /// Draws one frame for a purpose. Without a program nothing is drawn.
    pub fn draw_for(&mut self, inputs: &FrameInputs, purpose: DrawFor<'_>) -> Result<Drawn, EngineError> {
        let Some(running) = &mut self.running else { return Ok(Drawn { is_whole: true, ..Drawn::default() }) };
        let (shared, display) = (&self.shared, Some(&self.display));
        let mut whole = || Some(u32::MAX);
        let mut caller = Caller { rows: &mut whole, watch: None, capture: None };
        let mut drawn = Drawn::default();
        match purpose {
            DrawFor::Frame => {
                (drawn.stats, drawn.is_whole) = running.draw(shared, display, inputs, Purpose::Frame, &mut caller)?;
            }
            DrawFor::Advance => {
                (drawn.stats, drawn.is_whole) = running.draw(shared, display, inputs, Purpose::Advance, &mut caller)?;
            }
            DrawFor::Timed(now) => {
                let mut watch = Watch::new(now, &running.program);
                caller.watch = Some(&mut watch);
                (drawn.stats, drawn.is_whole) = running.draw(shared, display, inputs, Purpose::Timed, &mut caller)?;
                drawn.times = watch.times(&running.program);
            }
            DrawFor::Inspect(pass) => {
                let none = || EngineError::NoSuchPass(pass.title());
                let index = running.program.draws.iter().position(|draw| draw.id == *pass).ok_or_else(none)?;
                let converter = self.converter.get_or_insert_with(|| FloatConverter::new(&shared.gpu));
                let mut capture = Capture::new(converter);
                caller.capture = Some(&mut capture);
                let purpose = Purpose::Inspect(index);
                (drawn.stats, drawn.is_whole) = running.draw(shared, display, inputs, purpose, &mut caller)?;
                running.check_is_on(pass)?;
                drawn.read = Some(capture.taken.ok_or_else(none)?);
            }
            DrawFor::Bands(rows) => {
                let mut caller = Caller { rows, watch: None, capture: None };
                (drawn.stats, drawn.is_whole) = running.draw(shared, display, inputs, Purpose::Bands, &mut caller)?;
            }
        }
        drawn.submissions = running.submissions;
        self.shared.gpu.take_error("a frame")?;
        Ok(drawn)
    }

    /// Continues a frame of [`DrawFor::Bands`] that the caller stopped. Returns whether there was one.
    pub fn resume(&mut self, rows: &mut Rows<'_>) -> Result<bool, EngineError> {
        let Some(running) = self.running.as_mut().filter(|running| running.unfinished.is_some()) else {
            return Ok(false);
        };
        let mut caller = Caller { rows, watch: None, capture: None };
        running.execute(&self.shared, Some(&self.display), &mut caller)?;
        Ok(true)
    }

    /// Returns the size of the picture that is drawn in tiles, and the size of the largest tile; `None` if the running
    /// program has no such pass.
    pub fn tiles(&self) -> Option<((u32, u32), (u32, u32))> {
        let running = self.running.as_ref()?;
        let tiled = running.program.plan.tiled?;
        let target = &running.targets[running.program.plan.draws[tiled.draw].targets.start];
        Some((tiled.size.of(self.canvas), target.size()))
    }

    /// Draws and reads a tile of the tiled pass ([`BuildOptions::tile`](super::BuildOptions::tile)), of the newest
    /// frame: the pixels from `x`, `y` on, which are multiples of 4, so that the pixels that a device shades together
    /// are in the same tile. The tile is clipped to the picture. Before each band of it, `rows` returns the number of
    /// rows to draw at once. Waits for the device.
    pub fn draw_tile(&mut self, (x, y): (u32, u32), rows: &mut dyn FnMut() -> u32) -> Result<Pixels, EngineError> {
        let none = || EngineError::NoSuchPass("in tiles".into());
        let (picture, tile) = self.tiles().ok_or_else(none)?;
        let gpu = &self.shared.gpu;
        let running = self.running.as_mut().ok_or_else(none)?;
        let part = |at: u32, all: u32, max_size: u32| all.saturating_sub(at).min(max_size);
        let (width, height) = (part(x, picture.0, tile.0), part(y, picture.1, tile.1));
        let mut rows = || Some(rows());
        let mut caller = Caller { rows: &mut rows, watch: None, capture: None };
        running.draw_tile(&self.shared, ((x, y), (width, height)), &mut caller)?;
        let plan = &running.program.plan;
        let target = plan.tiled.map(|tiled| plan.draws[tiled.draw].targets.start).ok_or_else(none)?;
        let drawn = running.targets[target].newest();
        let texels = if drawn.shape.format == TexelFormat::Rgba32f {
            self.readback.rgba32float(gpu, drawn)?
        } else {
            let converter = self.converter.get_or_insert_with(|| FloatConverter::new(gpu));
            self.readback.rgba32float(gpu, &converter.convert(gpu, drawn)?)?
        };
        let rows = texels.chunks_exact(tile.0 as usize).take(height as usize);
        Ok(Pixels { width, height, texels: rows.flat_map(|row| &row[..width as usize]).copied().collect() })
    }

    /// Copies the contents of every target.
    pub fn snapshot(&self) -> Result<Snapshot, EngineError> {
        self.take_snapshot(Extent::Everything)
    }

    /// Copies only the texels of targets that later frames read: a frame that is drawn after [`Engine::restore`] is
    /// what it would have been, but until then the contents of targets are unspecified.
    pub fn checkpoint(&self) -> Result<Snapshot, EngineError> {
        self.take_snapshot(Extent::Carried)
    }

    fn take_snapshot(&self, extent: Extent) -> Result<Snapshot, EngineError> {
        let snapshot = Snapshot::take(&self.shared.gpu, self.running.as_ref(), extent)?;
        self.shared.gpu.take_error("a snapshot")?;
        Ok(snapshot)
    }

    /// Returns the bytes of the device's memory that [`Engine::checkpoint`] would take.
    pub fn checkpoint_bytes(&self) -> u64 {
        snapshot::bytes(self.running.as_ref(), Extent::Carried)
    }

    /// Restores a snapshot. Returns false without changes if the snapshot is of another program's targets or of another
    /// canvas.
    pub fn restore(&mut self, snapshot: &Snapshot) -> bool {
        self.running.as_mut().is_some_and(|running| running.restore(&self.shared, snapshot))
    }

    /// Captures the inputs of a pass's last draw, without drawing. Waits for the device.
    pub fn inspect(&mut self, pass: &PassName) -> Result<PassInputs, EngineError> {
        let none = || EngineError::NoSuchPass(pass.title());
        let running = self.running.as_ref().ok_or_else(none)?;
        running.check_is_on(pass)?;
        let converter = self.converter.get_or_insert_with(|| FloatConverter::new(&self.shared.gpu));
        let index = running.program.draws.iter().position(|draw| draw.id == *pass).ok_or_else(none)?;
        let mut capture = Capture::after_frame(converter);
        capture.take(running, &self.shared, index)?;
        capture.taken.ok_or_else(none)
    }

    /// Returns the size of a pass in texels, across and up.
    pub fn pass_size(&self, pass: &PassName) -> Option<(u32, u32)> {
        self.targets().iter().find(|t| t.id == *pass).map(Target::size)
    }

    /// Overwrites one of a pass's newest texels with NaN, in a float format, or else with its largest value. For
    /// testing how a project recovers. The position is clamped to the pass's texels.
    pub fn poison(&mut self, pass: &PassName, place: (u32, u32)) -> Result<(), EngineError> {
        // All bits set: an exponent of ones and a mantissa that is not zero.
        self.overwrite(pass, place, |bytes, _| vec![0xff; bytes])
    }

    /// Does the same as [`Engine::poison`] with infinity.
    pub fn make_infinite(&mut self, pass: &PassName, place: (u32, u32)) -> Result<(), EngineError> {
        // An exponent of ones, a mantissa of zeros; the lowest byte comes first.
        self.overwrite(pass, place, |bytes, components| match bytes / components {
            4 => [0x00, 0x00, 0x80, 0x7f].repeat(components),
            2 => [0x00, 0x7c].repeat(components),
            _ => vec![0xff; bytes],
        })
    }

    /// Overwrites one of a pass's newest texels: `texel` receives its number of bytes and of components. A pass that is
    /// off keeps its texels: no frame could have broken one.
    fn overwrite(
        &mut self,
        pass: &PassName,
        (x, y): (u32, u32),
        texel: impl Fn(usize, usize) -> Vec<u8>,
    ) -> Result<(), EngineError> {
        let (gpu, none) = (&self.shared.gpu, || EngineError::NoSuchPass(pass.title()));
        let running = self.running.as_mut().ok_or_else(none)?;
        if running.check_is_on(pass).is_err() {
            return Ok(());
        }
        let target = running.target(pass, 0)?;
        let texture = target.newest();
        let format = texture.shape.format;
        let place = (x.min(texture.width() - 1), y.min(texture.height() - 1));
        texture.write_texel(gpu, place, &texel(format.bytes() as usize, format.components()));
        if let Some(chain) = target.chains.get(target.front) {
            let mut encoder =
                gpu.device.create_command_encoder(&wgpu::CommandEncoderDescriptor { label: Some("poison") });
            self.shared.mips.build(gpu, &mut encoder, chain);
            gpu.queue.submit([encoder.finish()]);
        }
        running.changes.invalidate();
        Ok(())
    }

    /// Returns whether the newest frame shows an outdated frame of a video, as the right one was not decoded in time:
    /// see [`eddy_video::Pace::Live`].
    pub fn is_late(&self) -> bool {
        self.running.as_ref().is_some_and(|running| running.program.externals.iter().any(|external| external.is_late()))
    }

    /// Returns the camera picture in the newest frame. Pass it to another engine by
    /// [`MediaSet::set_camera_picture`](eddy_media::MediaSet::set_camera_picture), so that it can draw the same frame.
    pub fn camera_picture(&self) -> Option<CameraFrame> {
        self.running.as_ref()?.program.externals.iter().find_map(|external| external.camera_picture())
    }

    pub fn size(&self) -> (u32, u32) {
        self.canvas
    }

    /// Returns the minimum traffic of a frame in which every pass whose condition is true is drawn; see
    /// [`FramePlan::traffic`](eddy_graph::FramePlan::traffic).
    pub fn traffic(&self) -> Traffic {
        self.running.as_ref().map_or_else(Traffic::default, Running::traffic)
    }

    pub fn gpu(&self) -> &Gpu {
        &self.shared.gpu
    }

    /// The running program.
    pub fn program(&self) -> Option<&Program> {
        self.running.as_ref().map(|running| &running.program)
    }

    pub(super) fn running(&self) -> Option<&Running> {
        self.running.as_ref()
    }

    fn targets(&self) -> &[Target] {
        self.running.as_ref().map_or(&[], |running| &running.targets)
    }

    /// Enables or disables measuring the device's time of each pass from the next frame on, if it has timestamps. Off
    /// by default, as it costs a little in every frame. Returns whether it is supported.
    pub fn set_timing(&mut self, on: bool) -> bool {
        self.is_timing = on && self.shared.gpu.has_timestamps;
        if let Some(running) = &mut self.running {
            running.set_timing(&self.shared, self.is_timing);
        }
        self.is_timing
    }

    /// The GPU times of the passes, for all steps of each, in the newest frame that the device has finished, if it has
    /// timestamps. Does not wait.
    pub fn pass_times(&mut self) -> Option<Vec<PassTime>> {
        let running = self.running.as_mut()?;
        let draws = &running.program.draws;
        let millis = running.timer.as_mut()?.newest(&self.shared.gpu, draws.len())?;
        Some(draws.iter().zip(millis).map(|(d, gpu_millis)| PassTime { pass: d.id.clone(), gpu_millis }).collect())
    }

    /// The picture of a pass for a window: rgba8unorm, flipped so that its first row is the top, values as display
    /// values. [`Engine::draw`] updates it for the pass selected with [`Engine::show`]; black before that. A resize
    /// creates a new view.
    pub fn display(&self) -> &wgpu::TextureView {
        self.display.view()
    }

    /// Returns the size of [`Engine::display`] in pixels.
    pub fn display_size(&self) -> (u32, u32) {
        let texture = self.display.texture();
        (texture.width(), texture.height())
    }

    /// Selects the pass that [`Engine::display`] shows, starting with its newest texels. Nothing is presented before
    /// the first call. A pass that is not drawn is shown black.
    pub fn show(&mut self, pass: PassName) {
        self.display.show(pass);
        self.rebind_display();
    }

    /// Shows the values of the shown pass, starting with its newest texels; `None`: as a picture.
    pub fn show_values(&mut self, look: Option<ValueLook>) {
        self.display.look(&self.shared.gpu, look);
        self.rebind_display();
    }

    fn rebind_display(&mut self) {
        let targets = self.running.as_ref().map_or(&[][..], |running| &running.targets);
        self.display.rebind(&self.shared.gpu, self.canvas, targets);
    }

    /// Reads back the picture that [`Engine::display`] shows; waits for the device.
    pub fn picture(&mut self) -> Result<Picture, EngineError> {
        let texture = self.display.texture();
        let bytes = self.readback.rgba8(&self.shared.gpu, texture)?;
        Ok(Picture { width: texture.width(), height: texture.height(), bytes })
    }

    /// Reads back a thumbnail of one of a pass's targets, of [`MINIATURE_SIZE`] whatever its shape; waits for the
    /// device.
    pub fn miniature(&mut self, pass: &PassName, index: usize) -> Result<Miniature, EngineError> {
        let gpu = &self.shared.gpu;
        let running = self.running.as_ref().ok_or_else(|| EngineError::NoSuchPass(pass.title()))?;
        let (newest, layer) = running.layer(pass, index)?;
        let (miniatures, readback) = match &mut self.miniatures {
            Some(made) => made,
            none => none.insert((Miniatures::new(gpu)?, Readback::default())),
        };
        let bytes = readback.rgba8(gpu, miniatures.draw(gpu, &newest.readable(gpu, layer, 0)?))?;
        let (width, height) = MINIATURE_SIZE;
        let of = (newest.width(), newest.height());
        Ok(Miniature::new(Picture { width, height, bytes }, of))
    }

    /// Reads back a picture of the values of one of a pass's targets, in the style of `look`; waits for the device.
    pub fn picture_of_values(
        &mut self,
        pass: &PassName,
        index: usize,
        look: &ValueLook,
    ) -> Result<Picture, EngineError> {
        let gpu = &self.shared.gpu;
        let running = self.running.as_ref().ok_or_else(|| EngineError::NoSuchPass(pass.title()))?;
        let (newest, layer) = running.layer(pass, index)?;
        Ok(self.viewer.get_or_insert_with(|| Viewer::new(gpu)).paint(gpu, newest, layer, look)?)
    }

    /// Reads the texel of each drawn target at a position from 0 to 1 across and up; waits for the device once.
    pub fn texels_at(&mut self, at: [f32; 2]) -> Result<Vec<TexelAt>, EngineError> {
        let gpu = &self.shared.gpu;
        let Some(running) = &self.running else { return Ok(Vec::new()) };
        let plan = &running.program.plan;
        let is_drawn = |(index, _): &(usize, &Target)| plan.is_drawn(*index);
        let layers = |(index, target): (usize, &'_ Target)| {
            (0..target.newest().shape.layers()).map(move |layer| (index, layer)).collect::<Vec<_>>()
        };
        let places: Vec<(usize, u32)> = running.targets.iter().enumerate().filter(is_drawn).flat_map(layers).collect();
        let view = |&(index, layer): &(usize, u32)| running.targets[index].newest().readable(gpu, layer, 0);
        let views = places.iter().map(view).collect::<Result<Vec<_>, _>>()?;
        let texels = self.viewer.get_or_insert_with(|| Viewer::new(gpu)).texels(gpu, &views, at)?;
        let values = places.iter().zip(texels).map(|((index, layer), value)| {
            let target = &running.targets[*index];
            let (width, height) = target.size();
            let texel = |part: f32, size: u32| ((part * size as f32) as u32).min(size.saturating_sub(1));
            TexelAt {
                pass: target.id.clone(),
                index: target.index.max(*layer as usize),
                texel: (texel(at[0], width), texel(at[1], height)),
                components: plan.targets[*index].format.components() as u8,
                value,
            }
        });
        Ok(values.collect())
    }

    /// Returns the format of one of a pass's targets or of a face of its cubemap, if the running program has it.
    pub fn format(&self, pass: &PassName, index: usize) -> Option<TexelFormat> {
        self.running.as_ref()?.layer(pass, index).ok().map(|(texture, _)| texture.shape.format)
    }

    /// Reads a pass's newest texels back; waits for the device.
    pub fn read(&mut self, pass: &PassName) -> Result<Pixels, EngineError> {
        self.read_target(pass, 0)
    }

    /// Reads the newest texels of Image back; waits for the device.
    pub fn read_image(&mut self) -> Result<Pixels, EngineError> {
        self.read(&PassName::image())
    }

    /// Does the same as [`Engine::read`] for one of the pass's targets, or for one of a cubemap's faces in the order +x,
    /// -x, +y, -y, +z, -z.
    pub fn read_target(&mut self, pass: &PassName, index: usize) -> Result<Pixels, EngineError> {
        let gpu = &self.shared.gpu;
        let running = self.running.as_ref().ok_or_else(|| EngineError::NoSuchPass(pass.title()))?;
        let (newest, layer) = running.layer(pass, index)?;
        let (width, height) = (newest.width(), newest.height());
        let texels = if newest.shape == TextureShape::flat(width, height, TexelFormat::Rgba32f) {
            Readback::default().rgba32float(gpu, newest)?
        } else {
            let converter = self.converter.get_or_insert_with(|| FloatConverter::new(gpu));
            Readback::default().rgba32float(gpu, &converter.convert_level(gpu, newest, (layer, 0))?)?
        };
        Ok(Pixels { width, height, texels })
    }
}
