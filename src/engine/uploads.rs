//! Pictures and meshes on the device, without duplicates.

use super::{
    EngineError,
    cache::{ByAddress, Cache},
    mesh_instance::MeshInstance,
};
use eddy_gpu::{Gpu, GpuError, MeshBuffers, MipMaker, Texture, TextureDescriptor};
use eddy_media::{
    MediaSet, Texels,
    mesh::{Mesh, MeshError},
};
use eddy_project::Geometry;
use eddy_texture::Dimension;
use std::sync::Arc;

/// The pictures and meshes of this build and earlier ones.
pub(super) struct Uploads {
    mips: MipMaker,
    /// The key is the texels, and whether the picture has mip levels.
    pictures: Cache<(ByAddress<Texels>, bool), Texture>,
    meshes: Cache<ByAddress<Mesh>, Arc<MeshBuffers>>,
}

impl Uploads {
    pub(crate) fn new(gpu: &Gpu) -> Self {
        Self { mips: MipMaker::new(gpu), pictures: Cache::default(), meshes: Cache::default() }
    }

    pub(crate) fn picture(&mut self, gpu: &Gpu, texels: &Arc<Texels>, mips: bool) -> Result<Texture, GpuError> {
        let key = (ByAddress::of(texels), mips);
        if let Some(texture) = self.pictures.get(&key) {
            return Ok(texture.clone());
        }
        let shape = if mips { texels.shape.with_mips() } else { texels.shape };
        let texture = Texture::new(gpu, &TextureDescriptor { label: "picture", shape, is_target: false })?;
        texture.write(gpu, &texels.bytes);
        if mips && shape.dimension == Dimension::D3 {
            let mut level = texels.clone();
            for n in 1..shape.levels {
                level = Arc::new(level.halved());
                texture.write_level(gpu, n, &level.bytes);
            }
        } else if mips {
            let chain = self.mips.chain(gpu, &texture)?;
            let mut encoder = gpu.device.create_command_encoder(&Default::default());
            self.mips.build(gpu, &mut encoder, &chain);
            gpu.queue.submit([encoder.finish()]);
        }
        self.pictures.insert(key, texture.clone());
        Ok(texture)
    }

    /// Returns the mesh of each draw of a pass, in order.
    pub(crate) fn placed(
        &mut self,
        gpu: &Gpu,
        media: &MediaSet,
        geometry: &Geometry,
    ) -> Result<Vec<MeshInstance>, EngineError> {
        let placed = |draw: &eddy_project::MeshDraw| {
            let mesh = media.mesh(draw).map_err(|error: MeshError| EngineError::from(error))?;
            let buffers = self.mesh(gpu, &draw.mesh.name(), &mesh)?;
            Ok(MeshInstance::new(mesh, buffers, draw))
        };
        geometry.draws.iter().map(placed).collect()
    }

    fn mesh(&mut self, gpu: &Gpu, name: &str, mesh: &Arc<Mesh>) -> Result<Arc<MeshBuffers>, GpuError> {
        let key = ByAddress::of(mesh);
        if let Some(made) = self.meshes.get(&key) {
            return Ok(made.clone());
        }
        let made = Arc::new(MeshBuffers::new(gpu, name, bytemuck::cast_slice(&mesh.vertices), &mesh.indices)?);
        self.meshes.insert(key, made.clone());
        Ok(made)
    }

    /// Ends a build; see [`Cache::end_build`].
    pub(crate) fn end_build(&mut self, is_whole: bool) {
        self.pictures.end_build(is_whole);
        self.meshes.end_build(is_whole);
    }
}
