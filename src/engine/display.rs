//! The 8-bit picture that a window shows.

use super::targets::Target;
use eddy_gpu::{Gpu, GpuError, Presenter, Texture, ValueLook, ValuePainter};
use eddy_project::PassName;

/// Shows the newest texels of one pass.
pub(super) struct Display {
    presenter: Presenter,
    texture: Texture,
    /// `None`: nobody looks.
    shown: Option<PassName>,
    /// The shown target's textures, bound for presenting.
    bound: Vec<wgpu::BindGroup>,
    /// The place of the shown target in the plan.
    target: usize,
    /// Made when numbers are first to be seen as such.
    painter: Option<ValuePainter>,
    /// The target holds numbers and no picture.
    has_look: bool,
}

impl Display {
    pub(crate) fn new(gpu: &Gpu, (width, height): (u32, u32)) -> Result<Self, GpuError> {
        let (presenter, texture) = (Presenter::new(gpu), Presenter::texture(gpu, width, height)?);
        Ok(Self { presenter, texture, shown: None, bound: Vec::new(), target: 0, painter: None, has_look: false })
    }

    /// The picture, its first row the top.
    pub(crate) fn view(&self) -> &wgpu::TextureView {
        &self.texture.level_0
    }

    /// The texture of the picture.
    pub(crate) fn texture(&self) -> &Texture {
        &self.texture
    }

    /// Takes another texture for its own.
    pub(crate) fn set_texture(&mut self, texture: Texture) {
        self.texture = texture;
    }

    /// Chooses the pass that is shown.
    pub(crate) fn show(&mut self, pass: PassName) {
        self.shown = Some(pass);
    }

    /// Shows what the pass holds as numbers, so; none: as a picture. It must be bound anew.
    pub(crate) fn look(&mut self, gpu: &Gpu, look: Option<ValueLook>) {
        if let Some(look) = &look {
            self.painter.get_or_insert_with(|| ValuePainter::new(gpu)).set(gpu, look);
        }
        self.has_look = look.is_some();
    }

    /// Shows the chosen pass, if one is chosen, from these targets on; a pass without a target is black and of the
    /// canvas's size.
    pub(crate) fn rebind(&mut self, gpu: &Gpu, canvas: (u32, u32), targets: &[Target]) {
        let Some(shown) = &self.shown else { return };
        self.bound.clear();
        let place = targets.iter().position(|t| t.id == *shown);
        let size = place.map_or(canvas, |i| targets[i].size());
        if (self.texture.width(), self.texture.height()) != size {
            match Presenter::texture(gpu, size.0, size.1) {
                Ok(texture) => self.texture = texture,
                Err(error) => log::error!("the picture cannot be shown: {error}"),
            }
        }
        if (self.texture.width(), self.texture.height()) == size
            && let Some(i) = place
        {
            self.target = i;
            let painter = self.painter.as_ref().filter(|_| self.has_look);
            let bind = |texture: &Texture| match painter {
                Some(painter) => painter.bind(gpu, &texture.level_0),
                None => self.presenter.bind(gpu, texture),
            };
            self.bound = targets[i].textures.iter().map(bind).collect();
        }
        let mut encoder = gpu.device.create_command_encoder(&wgpu::CommandEncoderDescriptor { label: Some("show") });
        if !self.present(gpu, &mut encoder, targets) {
            self.texture.clear(gpu, &mut encoder, wgpu::Color::BLACK);
        }
        gpu.queue.submit([encoder.finish()]);
    }

    /// Draws the shown pass's newest texels, if a pass is shown. Says whether one is.
    pub(crate) fn present(&self, gpu: &Gpu, encoder: &mut wgpu::CommandEncoder, targets: &[Target]) -> bool {
        let newest = targets.get(self.target).map_or(0, |t| t.front);
        let Some(bound) = self.bound.get(newest) else { return false };
        match self.painter.as_ref().filter(|_| self.has_look) {
            Some(painter) => painter.present(gpu, encoder, bound, &self.texture),
            None => self.presenter.present(gpu, encoder, bound, &self.texture),
        }
        true
    }
}
