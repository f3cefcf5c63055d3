//! Loads a mesh by what the project says of it.

use super::{
    builtin,
    error::{MeshError, MeshWarning},
    finish::finished,
    gltf,
    model::{Mesh, Raw},
    obj,
    trouble::Trouble,
};
use crate::project::{MeshSource, confine, limits};
use std::path::Path;

/// Loads a mesh. A file lies in the project's folder `base`, see [`confine`].
pub fn load(source: &MeshSource, base: Option<&Path>) -> Result<Mesh, MeshError> {
    load_within(source, base, limits::MEDIA_BYTES).map(|(mesh, _)| mesh)
}

/// The same where pictures and models may take `room` bytes more, with what is to be said of the mesh.
pub(in crate::media) fn load_within(
    source: &MeshSource,
    base: Option<&Path>,
    room: u64,
) -> Result<(Mesh, Vec<MeshWarning>), MeshError> {
    let (name, base) = match source {
        MeshSource::Builtin(name) => {
            let mesh = builtin::make(name).ok_or_else(|| MeshError::UnknownBuiltin(name.clone()))?;
            return Ok((mesh, Vec::new()));
        }
        MeshSource::File(path) => (path.as_path(), base),
        // What it names lies beside it.
        MeshSource::Picked(path) => (Path::new(path.file_name().unwrap_or_default()), path.parent()),
    };
    let is = |ending: &str| name.extension().is_some_and(|e| e.eq_ignore_ascii_case(ending));
    let is_gltf = is("glb") || is("gltf");
    if !is_gltf && !is("obj") {
        return Err(MeshError::UnknownKind(name.to_owned()));
    }
    let Some(folder) = base else { return Err(MeshError::NoFolder(name.to_owned())) };
    let bytes = confine::read(folder, name, limits::MEDIA_FILE)?;
    let mut mesh = Mesh { vertices: Vec::new(), indices: Vec::new() };
    let mut take = |raw: Raw| -> Result<(), Trouble> {
        mesh.append(finished(raw)?);
        Ok(())
    };
    let done = if is_gltf {
        // What a model names is relative to it.
        let named = |uri: &str, limit| confine::read(folder, confine::relative(&name.to_string_lossy(), uri)?, limit);
        gltf::load(bytes, &named, room, &mut take).map(|()| Vec::new())
    } else {
        obj::load(&bytes, room, &mut take)
    };
    let empty = |mesh: &Mesh| mesh.indices.is_empty().then(|| Trouble::broken("it holds no triangles"));
    match done.and_then(|warnings| empty(&mesh).map_or(Ok(warnings), Err)) {
        Ok(warnings) => Ok((mesh, warnings)),
        Err(trouble) => Err(MeshError::of(trouble, folder.join(name))),
    }
}
