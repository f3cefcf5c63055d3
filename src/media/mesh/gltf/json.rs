//! The JSON text of a glTF file: its version, its extensions, and every index, checked before they are used.

use super::{
    document::{Asset, Attributes, Head, Index, Root},
    extensions,
};
use crate::mesh::trouble::ModelError;
use eddy_project::limits;
use serde_json::value::RawValue;

/// Parses and checks the text. After this, every index that Eddy follows is in range.
pub(super) fn document(text: &[u8]) -> Result<Root<'_>, ModelError> {
    let text = plain(text)?;
    measure(text)?;
    let head: Head<'_> = serde_json::from_slice(text).map_err(ModelError::broken)?;
    check_version(&head)?;
    let root: Root<'_> = serde_json::from_slice(text).map_err(ModelError::broken)?;
    extensions::check(&root)?;
    check_indices(&root).map_err(ModelError::broken)?;
    Ok(root)
}

/// Strips the byte order mark that some editors write (section 2.3 forbids it, and readers may skip it), and the zeros
/// with which some programs pad a chunk.
fn plain(text: &[u8]) -> Result<&[u8], ModelError> {
    if text.starts_with(b"\xff\xfe") || text.starts_with(b"\xfe\xff") {
        return Err(ModelError::broken("its JSON is UTF-16 text, and glTF's is UTF-8"));
    }
    let text = text.strip_prefix(b"\xef\xbb\xbf").unwrap_or(text);
    let end = text.iter().rposition(|byte| *byte != 0).map_or(0, |last| last + 1);
    if text[..end].iter().all(u8::is_ascii_whitespace) {
        return Err(ModelError::broken("it is empty"));
    }
    Ok(&text[..end])
}

/// Counts objects and values before they are allocated: an empty object is two bytes of text and hundreds in memory.
fn measure(text: &[u8]) -> Result<(), ModelError> {
    let (mut objects, mut values) = (0, 0);
    let (mut is_string, mut is_escaped) = (false, false);
    for byte in text {
        match byte {
            _ if is_escaped => is_escaped = false,
            b'\\' if is_string => is_escaped = true,
            b'"' => is_string = !is_string,
            _ if is_string => {}
            b'{' => objects += 1,
            b',' | b'[' => values += 1,
            _ => {}
        }
    }
    for (count, limit, what) in [(objects, limits::GLTF_OBJECTS, "objects"), (values, limits::GLTF_VALUES, "values")] {
        if count > limit {
            let excess = format!("its JSON has {count} {what}, but the limit is {limit}");
            return Err(ModelError::TooLarge(excess));
        }
    }
    Ok(())
}

/// By the note of section 3.2: `minVersion` if present, otherwise the major version.
fn check_version(head: &Head<'_>) -> Result<(), ModelError> {
    const NONE: Asset<'_> = Asset { version: None, min_version: None };
    let asset = head.asset.as_ref().unwrap_or(&NONE);
    let Some(version) = asset.version.map(words) else {
        return Err(match head.nodes {
            // glTF 1.0 used objects instead of lists, and its asset was optional.
            Some(nodes) if nodes.get().starts_with('{') => ModelError::Version("1.0".into()),
            _ => ModelError::broken("it has no asset.version, which glTF requires"),
        });
    };
    let numbers = |text: &str| {
        let (major, minor) = text.split_once('.')?;
        Some((major.parse::<u32>().ok()?, minor.parse::<u32>().ok()?))
    };
    let major = version.split('.').next().unwrap_or_default().parse::<u32>();
    match asset.min_version.map(words) {
        Some(least) if numbers(least).is_some_and(|least| least > (2, 0)) => Err(ModelError::Version(least.into())),
        _ if major == Ok(2) => Ok(()),
        _ if major.is_ok() => {
            let minor = if version.contains('.') { "" } else { ".0" };
            Err(ModelError::Version(format!("{version}{minor}")))
        }
        _ => Err(ModelError::broken(format!("its asset.version is {version:?}, not \"2.0\""))),
    }
}

/// Returns a text of the file without its quotes.
fn words(value: &RawValue) -> &str {
    value.get().trim_matches('"')
}

/// Checks that every index is in range.
fn check_indices(root: &Root<'_>) -> Result<(), String> {
    let within = |index: Index, count: usize, what: &dyn Fn() -> String| {
        if (index as usize) < count {
            return Ok(());
        }
        Err(format!("{} {index}, but there are {count}", what()))
    };
    let (accessors, views, nodes) = (root.accessors.len(), root.buffer_views.len(), root.nodes.len());
    for (v, view) in root.buffer_views.iter().enumerate() {
        within(view.buffer, root.buffers.len(), &|| format!("bufferView {v} is in buffer"))?;
    }
    for (a, accessor) in root.accessors.iter().enumerate() {
        let sparse = accessor.sparse.iter().flat_map(|s| [s.indices.buffer_view, s.values.buffer_view]);
        for view in accessor.buffer_view.into_iter().chain(sparse) {
            within(view, views, &|| format!("accessor {a} reads bufferView"))?;
        }
    }
    for (m, mesh) in root.meshes.iter().enumerate() {
        for (p, primitive) in mesh.primitives.iter().enumerate() {
            let has = |attributes: &Attributes, whose: &str| {
                attributes.all().try_for_each(|(name, index)| {
                    within(index, accessors, &|| {
                        format!("primitive {p} of mesh {m} has {} {whose}in accessor", owned(&name))
                    })
                })
            };
            has(&primitive.attributes, "")?;
            primitive.targets.iter().try_for_each(|target| has(target, "of a morph target "))?;
            let indices = primitive.indices.map_or(Ok(()), |index| {
                within(index, accessors, &|| format!("primitive {p} of mesh {m} has its indices in accessor"))
            });
            indices?;
        }
    }
    for (n, node) in root.nodes.iter().enumerate() {
        node.children.iter().try_for_each(|i| within(*i, nodes, &|| format!("node {n} has the child node")))?;
        node.mesh.map_or(Ok(()), |i| within(i, root.meshes.len(), &|| format!("node {n} uses mesh")))?;
        node.skin.map_or(Ok(()), |i| within(i, root.skins.len(), &|| format!("node {n} uses skin")))?;
        let instances = node.extensions.instancing.iter().flat_map(|one| one.attributes.all());
        for (name, index) in instances {
            within(index, accessors, &|| format!("node {n} has the {name} of its instances in accessor"))?;
        }
    }
    for (s, scene) in root.scenes.iter().enumerate() {
        scene.nodes.iter().try_for_each(|i| within(*i, nodes, &|| format!("scene {s} has node")))?;
    }
    for (s, skin) in root.skins.iter().enumerate() {
        skin.joints.iter().try_for_each(|i| within(*i, nodes, &|| format!("skin {s} has the joint node")))?;
        let bind = skin.inverse_bind_matrices;
        bind.map_or(Ok(()), |i| within(i, accessors, &|| format!("skin {s} has its inverseBindMatrices in accessor")))?;
    }
    root.scene.map_or(Ok(()), |i| within(i, root.scenes.len(), &|| "the scene to show is".into()))
}

/// Returns the words for an attribute of a primitive.
fn owned(semantic: &str) -> String {
    if semantic == "POSITION" { "its positions".into() } else { format!("its {semantic}") }
}
