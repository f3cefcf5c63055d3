//! Loads a mesh from its description in the project.

use super::{
    builtin,
    error::{MeshError, MeshWarning},
    finish::finished,
    gltf,
    model::{Mesh, Raw},
    obj,
    trouble::{Counts, ModelError},
};
use eddy_project::{MeshSource, Normals, confine, limits};
use std::path::Path;

/// Loads a mesh. A file is in the project's folder `base`, see [`confine`]. `normals` selects how missing normals are
/// made; the default depends on the file format: see [`eddy_project::MeshDraw::normals`].
pub fn load(source: &MeshSource, normals: Option<Normals>, base: Option<&Path>) -> Result<Mesh, MeshError> {
    load_within(source, normals, base, limits::MEDIA_BYTES).map(|loaded| loaded.mesh)
}

/// A mesh with its warnings.
pub(crate) struct Loaded {
    pub mesh: Mesh,
    /// Parts that are not drawn as the file's author may expect.
    pub warnings: Vec<MeshWarning>,
}

/// Does the same, but pictures and models may take `room` bytes more.
pub(crate) fn load_within(
    source: &MeshSource,
    normals: Option<Normals>,
    base: Option<&Path>,
    room: u64,
) -> Result<Loaded, MeshError> {
    let (name, base) = match source {
        MeshSource::Builtin(name) => {
            let mesh = builtin::make(name).ok_or_else(|| MeshError::UnknownBuiltin(name.clone()))?;
            return Ok(Loaded { mesh, warnings: Vec::new() });
        }
        MeshSource::File(path) => (path.as_path(), base),
        // The files that it names are next to it.
        MeshSource::Picked(path) => (Path::new(path.file_name().unwrap_or_default()), path.parent()),
    };
    let is = |ending: &str| name.extension().is_some_and(|e| e.eq_ignore_ascii_case(ending));
    let is_gltf = is("glb") || is("gltf");
    if !is_gltf && !is("obj") {
        return Err(MeshError::UnknownKind(name.to_owned()));
    }
    let Some(folder) = base else { return Err(MeshError::NoFolder(name.to_owned())) };
    let bytes = confine::read(folder, name, limits::MEDIA_FILE)?;
    let normals = normals.unwrap_or(if is_gltf { Normals::Flat } else { Normals::Smooth });
    let mut mesh = Mesh { vertices: Vec::new(), indices: Vec::new() };
    let mut made = Counts::default();
    let mut take = |raw: Raw| -> Result<(), ModelError> {
        // The earlier counts are those of the file; flat normals need three vertices per triangle.
        let parts_corners = normals == Normals::Flat && !raw.has_normals;
        let vertices = if parts_corners { raw.indices.len() } else { raw.vertices.len() };
        made.add(vertices as u64, raw.indices.len() as u64 / 3).and_then(|()| made.fit(room)).map_err(|trouble| {
            match trouble {
                ModelError::TooLarge(excess) if parts_corners => ModelError::TooLarge(format!(
                    "{excess}. It has no normals, and flat normals need three vertices per triangle: set normals = \
                     \"smooth\" in its draw to need fewer"
                )),
                other => other,
            }
        })?;
        mesh.append(finished(raw, normals)?);
        Ok(())
    };
    let done = if is_gltf {
        // File names in a model are relative to it.
        let named = |uri: &str, limit| confine::read(folder, confine::relative(&name.to_string_lossy(), uri)?, limit);
        gltf::load(&bytes, &named, room, &mut take).map(|left_out| (left_out, Vec::new()))
    } else {
        obj::load(&bytes, room, &mut take).map(|warnings| (gltf::IgnoredParts::default(), warnings))
    };
    match done {
        Ok((left_out, _)) if mesh.indices.is_empty() => {
            Err(MeshError::Model { path: folder.join(name), trouble: ModelError::Empty(left_out.only()) })
        }
        Ok((left_out, mut warnings)) => {
            warnings.extend(left_out.beside().map(|what| MeshWarning {
                message: format!("{what} are not drawn"),
                hint: "a pass draws only triangles: export the rest as triangles too".into(),
            }));
            Ok(Loaded { mesh, warnings })
        }
        Err(trouble) => Err(MeshError::Model { path: folder.join(name), trouble }),
    }
}
