//! The 8-bit picture that a window shows.

use super::targets::Target;
use eddy_gpu::{Gpu, GpuError, Presenter, Texture, ValueLook, ValuePainter};
use eddy_project::PassName;

/// Displays the newest texels of one pass.
pub(super) struct Display {
    presenter: Presenter,
    texture: Texture,
    /// `None` if nothing is displayed.
    shown: Option<PassName>,
    /// The bind groups for presenting the target's textures.
    bound: Vec<wgpu::BindGroup>,
    /// The index of the displayed target in the plan.
    target: usize,
    /// Created when values are first displayed.
    painter: Option<ValuePainter>,
    /// True if the target is displayed as values rather than as a picture.
    has_look: bool,
}

impl Display {
    pub(crate) fn new(gpu: &Gpu, (width, height): (u32, u32)) -> Result<Self, GpuError> {
        let (presenter, texture) = (Presenter::new(gpu), Presenter::texture(gpu, width, height)?);
        Ok(Self { presenter, texture, shown: None, bound: Vec::new(), target: 0, painter: None, has_look: false })
    }

    /// The picture, whose first row is the top.
    pub(crate) fn view(&self) -> &wgpu::TextureView {
        &self.texture.level_0
    }

    /// The texture of the picture.
    pub(crate) fn texture(&self) -> &Texture {
        &self.texture
    }

    /// Replaces the texture of the picture.
    pub(crate) fn set_texture(&mut self, texture: Texture) {
        self.texture = texture;
    }

    /// Selects the displayed pass.
    pub(crate) fn show(&mut self, pass: PassName) {
        self.shown = Some(pass);
    }

    /// Displays the pass's values with a look; `None`: as a picture. Requires rebinding.
    pub(crate) fn look(&mut self, gpu: &Gpu, look: Option<ValueLook>) {
        if let Some(look) = &look {
            self.painter.get_or_insert_with(|| ValuePainter::new(gpu)).set(gpu, look);
        }
        self.has_look = look.is_some();
    }

    /// Displays the selected pass, if there is one, from these targets; a pass without a target is black and has the
    /// size of the canvas.
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

    /// Draws the displayed pass's newest texels. Returns whether a pass is displayed.
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
