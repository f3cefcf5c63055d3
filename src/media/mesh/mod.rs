//! Meshes: glTF 2.0 and OBJ files, and some made by code.
//!
//! Owns what a vertex holds and where it comes from. Normals that a file does not have are made smooth, tangents as
//! MikkTSpace has them where there are texture coordinates. v runs upward, as in the rest of Eddy, so glTF's is turned;
//! a triangle's front is where its corners turn counter-clockwise.

#[cfg(test)]
mod bomb_tests;
mod builtin;
mod gltf;
mod normals;
mod obj;
mod shape;
mod tangents;
#[cfg(test)]
mod tests;

pub use builtin::NAMES;

use crate::project::{
    MeshSource,
    confine::{self, FileError},
    limits, listed, nearest,
};
use bytemuck::{Pod, Zeroable};
use std::path::{Path, PathBuf};

/// The attributes of a vertex as the vertex buffer holds them.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, Pod, Zeroable)]
pub struct Vertex {
    pub position: [f32; 3],
    /// The normal, of length 1.
    pub normal: [f32; 3],
    /// The tangent, of length 1 and along u; the fourth is the sign of the bitangent `cross(normal, tangent)`. Zeros
    /// without uv.
    pub tangent: [f32; 4],
    pub uv: [f32; 2],
    /// White where the mesh says nothing.
    pub color: [f32; 4],
}

impl Vertex {
    /// White, and else zeros.
    pub const PLAIN: Vertex =
        Vertex { position: [0.0; 3], normal: [0.0; 3], tangent: [0.0; 4], uv: [0.0; 2], color: [1.0; 4] };
}

/// Triangles: three indices each, at least one triangle.
#[derive(Clone, Debug, PartialEq)]
pub struct Mesh {
    pub vertices: Vec<Vertex>,
    pub indices: Vec<u32>,
}

impl Mesh {
    /// Memory that it takes.
    pub fn bytes(&self) -> u64 {
        (size_of_val(&*self.vertices) + size_of_val(&*self.indices)) as u64
    }
}

/// An error of loading a mesh.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum MeshError {
    #[error("there is no mesh builtin:{0}")]
    UnknownBuiltin(String),
    #[error(transparent)]
    File(#[from] FileError),
    #[error("{} is relative, and the project has no folder yet to start from", .0.display())]
    NoFolder(PathBuf),
    #[error("{} is no model Eddy knows by its ending", .0.display())]
    UnknownKind(PathBuf),
    #[error("{} is broken: {reason}", path.display())]
    Broken { path: PathBuf, reason: String },
    #[error("{} is too large: {excess}", path.display())]
    TooLarge { path: PathBuf, excess: String },
    #[error("{} names a file: {error}", path.display())]
    Named { path: PathBuf, error: FileError },
}

impl MeshError {
    /// Returns what to do about it.
    pub fn hint(&self) -> String {
        match self {
            MeshError::UnknownBuiltin(name) => match nearest(name, NAMES) {
                Some(near) => format!("did you mean builtin:{near}?"),
                None => format!("there are {}", listed(&NAMES)),
            },
            MeshError::File(error) | MeshError::Named { error, .. } => error.hint(),
            MeshError::NoFolder(_) => "save the project first, and put the model into its folder".into(),
            MeshError::TooLarge { .. } => "simplify the model before it is exported".into(),
            MeshError::UnknownKind(_) => "name a .glb, .gltf or .obj file".into(),
            MeshError::Broken { .. } => "export the model anew".into(),
        }
    }
}

/// An error of a model before the model's name is added.
#[derive(Debug)]
enum Trouble {
    Broken(String),
    TooLarge(String),
    /// An error of a file that the model names.
    Named(FileError),
}

impl Trouble {
    /// Cut short where a parser quotes a whole file.
    fn broken(reason: impl std::fmt::Display) -> Trouble {
        const LONGEST: usize = 400;
        let reason = reason.to_string();
        Trouble::Broken(match reason.char_indices().nth(LONGEST) {
            Some((end, _)) => format!("{}…", &reason[..end]),
            None => reason,
        })
    }

    fn of(self, path: PathBuf) -> MeshError {
        match self {
            Trouble::Broken(reason) => MeshError::Broken { path, reason },
            Trouble::TooLarge(excess) => MeshError::TooLarge { path, excess },
            Trouble::Named(error) => MeshError::Named { path, error },
        }
    }
}

/// The triangles as a file has them, before what it leaves out is made.
#[derive(Debug, Default)]
struct Raw {
    vertices: Vec<Vertex>,
    indices: Vec<u32>,
    has_normals: bool,
    has_tangents: bool,
    has_uv: bool,
}

/// The sizes of a model, counted before any of it is made.
#[derive(Clone, Copy, Debug, Default)]
struct Counts {
    vertices: u64,
    triangles: u64,
    parts: u64,
}

impl Counts {
    fn add(&mut self, vertices: u64, triangles: u64) -> Result<(), Trouble> {
        self.vertices = self.vertices.saturating_add(vertices);
        self.triangles = self.triangles.saturating_add(triangles);
        at_most(self.vertices, limits::MODEL_VERTICES, "vertices")?;
        at_most(self.triangles, limits::MODEL_TRIANGLES, "triangles")
    }

    fn add_part(&mut self) -> Result<(), Trouble> {
        self.parts += 1;
        at_most(self.parts, limits::MODEL_PARTS, "parts")
    }

    /// Returns whether there is room for them.
    fn fit(&self, room: u64) -> Result<(), Trouble> {
        if self.vertices * size_of::<Vertex>() as u64 + self.triangles * 12 <= room {
            return Ok(());
        }
        let all = limits::in_bytes(limits::MEDIA_BYTES);
        Err(Trouble::TooLarge(format!("with it the pictures and models of the project take more than {all}")))
    }
}

fn at_most(count: u64, limit: u64, what: &str) -> Result<(), Trouble> {
    if count <= limit {
        return Ok(());
    }
    Err(Trouble::TooLarge(format!("it has more than {limit} {what}, which are the most that Eddy loads of a model")))
}

/// Loads a mesh. A file lies in the project's folder `base`, see [`confine`].
pub fn load(source: &MeshSource, base: Option<&Path>) -> Result<Mesh, MeshError> {
    load_within(source, base, limits::MEDIA_BYTES)
}

/// The same where pictures and models may take `room` bytes more.
pub(super) fn load_within(source: &MeshSource, base: Option<&Path>, room: u64) -> Result<Mesh, MeshError> {
    let name = match source {
        MeshSource::Builtin(name) => {
            return builtin::make(name).ok_or_else(|| MeshError::UnknownBuiltin(name.clone()));
        }
        MeshSource::File(path) => path,
    };
    let is = |ending: &str| name.extension().is_some_and(|e| e.eq_ignore_ascii_case(ending));
    let is_gltf = is("glb") || is("gltf");
    if !is_gltf && !is("obj") {
        return Err(MeshError::UnknownKind(name.clone()));
    }
    let Some(folder) = base else { return Err(MeshError::NoFolder(name.clone())) };
    let bytes = confine::read(folder, name, limits::MEDIA_FILE)?;
    let mut mesh = Mesh { vertices: Vec::new(), indices: Vec::new() };
    let mut take = |raw: Raw| -> Result<(), Trouble> {
        add(&mut mesh, finished(raw)?);
        Ok(())
    };
    let done = if is_gltf {
        // What a model names is relative to it.
        let named = |uri: &str, limit| confine::read(folder, confine::relative(&name.to_string_lossy(), uri)?, limit);
        gltf::load(bytes, &named, room, &mut take)
    } else {
        obj::load(&bytes, room, &mut take)
    };
    let empty = |mesh: &Mesh| mesh.indices.is_empty().then(|| Trouble::broken("it holds no triangles"));
    match done.err().or_else(|| empty(&mesh)) {
        Some(trouble) => Err(trouble.of(folder.join(name))),
        None => Ok(mesh),
    }
}

/// Puts a mesh behind another.
fn add(mesh: &mut Mesh, other: Mesh) {
    if mesh.vertices.is_empty() && mesh.indices.is_empty() {
        *mesh = other;
        return;
    }
    let first = mesh.vertices.len() as u32;
    mesh.vertices.extend(other.vertices);
    mesh.indices.extend(other.indices.into_iter().map(|i| i.wrapping_add(first)));
}

/// A mesh with everything a vertex has.
fn finished(mut raw: Raw) -> Result<Mesh, Trouble> {
    if !raw.indices.len().is_multiple_of(3) {
        return Err(Trouble::broken(format!("{} corners make no whole number of triangles", raw.indices.len())));
    }
    let count = raw.vertices.len();
    if let Some(index) = raw.indices.iter().find(|i| **i as usize >= count) {
        return Err(Trouble::broken(format!("a triangle names vertex {index}, and there are {count}")));
    }
    let broken = |numbers: &[f32]| numbers.iter().any(|x| !x.is_finite());
    for (at, v) in raw.vertices.iter().enumerate() {
        let numbers: [(&[f32], &str); 5] = [
            (&v.position, "position"),
            (&v.normal, "normal"),
            (&v.tangent, "tangent"),
            (&v.uv, "texture coordinate"),
            (&v.color, "colour"),
        ];
        if let Some((_, what)) = numbers.into_iter().find(|(numbers, _)| broken(numbers)) {
            return Err(Trouble::broken(format!("the {what} of vertex {at} is not a number")));
        }
    }
    if !raw.has_normals {
        normals::smooth(&mut raw);
    }
    let needs_tangents = raw.has_uv && !raw.has_tangents;
    if needs_tangents {
        tangents::check(&raw)?;
    }
    let mesh = Mesh { vertices: raw.vertices, indices: raw.indices };
    Ok(if needs_tangents { tangents::with_tangents(mesh) } else { mesh })
}
