//! The JSON text of a glTF file, checked as far as the crate takes it for granted.

use crate::{media::mesh::trouble::Trouble, project::limits};
use gltf::{
    Document,
    json::{Path, Root, Value, deserialize, validation::Checked, validation::Validate},
};

/// Reads and validates the text. After this every index of the document is in range.
pub(super) fn document(text: &[u8]) -> Result<Document, Trouble> {
    measure(text)?;
    let root: Root = deserialize::from_slice(text).map_err(Trouble::broken)?;
    before_validation(&root)?;
    let (mut first, mut more) = (None, 0);
    root.validate(&root, Path::new, &mut |path, error| match first {
        None => first = Some(format!("{}: {error}", path())),
        Some(_) => more += 1,
    });
    match (first, more) {
        (None, _) => Ok(Document::from_json_without_validation(root)),
        (Some(first), 0) => Err(Trouble::broken(first)),
        (Some(first), more) => Err(Trouble::broken(format!("{first}, and {more} mistakes more"))),
    }
}

/// Counts objects and values before they are made: an empty object is two bytes of text and hundreds in memory.
fn measure(text: &[u8]) -> Result<(), Trouble> {
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
            let excess = format!("its JSON holds {count} {what}, and {limit} are the most that Eddy reads");
            return Err(Trouble::TooLarge(excess));
        }
    }
    Ok(())
}

/// Returns what `Root::validate` itself stumbles over: it looks at the accessor of a primitive's positions whether
/// there is one or not (gltf-json 1.4), and copies its bounds for each primitive.
fn before_validation(root: &Root) -> Result<(), Trouble> {
    use gltf::json::mesh::Semantic::Positions;
    for (m, mesh) in root.meshes.iter().enumerate() {
        for (p, primitive) in mesh.primitives.iter().enumerate() {
            let Some(index) = primitive.attributes.get(&Checked::Valid(Positions)) else { continue };
            if index.value() >= root.accessors.len() {
                let (accessor, there) = (index.value(), root.accessors.len());
                return Err(Trouble::broken(format!(
                    "primitive {p} of mesh {m} has its positions in accessor {accessor}, and there are {there}"
                )));
            }
        }
    }
    for (a, accessor) in root.accessors.iter().enumerate() {
        // As many numbers as the largest element has, a 4x4 matrix.
        let is_bound = |v: &Value| v.as_array().is_some_and(|v| v.len() <= 16 && v.iter().all(Value::is_number));
        if !accessor.min.iter().chain(&accessor.max).all(is_bound) {
            return Err(Trouble::broken(format!("min and max of accessor {a} are not lists of at most 16 numbers")));
        }
    }
    Ok(())
}
