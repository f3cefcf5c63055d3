//! The container of a glTF file: plain JSON text, or the chunks of a `.glb` (section 4). The content decides which of
//! the two it is, whatever its name.

use crate::mesh::trouble::ModelError;

/// The JSON text of a file, and the binary chunk of a `.glb`.
pub(super) struct Chunks<'a> {
    pub json: &'a [u8],
    pub binary: Option<&'a [u8]>,
}

const HEADER: usize = 12;

pub(super) fn split(bytes: &[u8]) -> Result<Chunks<'_>, ModelError> {
    if !bytes.starts_with(b"glTF") {
        return Ok(Chunks { json: bytes, binary: None });
    }
    let [Some(version), Some(length)] = [number(bytes, 4), number(bytes, 8)] else {
        return Err(ModelError::broken("it ends within its header"));
    };
    match version {
        2 => {}
        // The container of the extension KHR_binary_glTF.
        1 => return Err(ModelError::Version("1.0".into())),
        other => {
            return Err(ModelError::broken(format!("its header gives version {other} of the .glb container, not 2")));
        }
    }
    if (length as usize) < HEADER {
        return Err(ModelError::broken("its header gives a length below that of the header"));
    }
    let Some(mut rest) = bytes.get(HEADER..length as usize) else {
        let there = bytes.len();
        return Err(ModelError::broken(format!("its header says {length} bytes, and the file has {there}")));
    };
    let Some((b"JSON", json)) = chunk(&mut rest)? else {
        return Err(ModelError::broken("its first chunk is not JSON"));
    };
    // Further chunks belong to extensions, and readers ignore them.
    let binary = chunk(&mut rest)?.filter(|(kind, _)| *kind == b"BIN\0").map(|(_, bytes)| bytes);
    Ok(Chunks { json, binary })
}

/// A chunk's type and its bytes.
type Chunk<'a> = (&'a [u8; 4], &'a [u8]);

/// Returns the next chunk; `None` if the rest is shorter than a chunk header.
fn chunk<'a>(rest: &mut &'a [u8]) -> Result<Option<Chunk<'a>>, ModelError> {
    let (Some(length), Some(kind)) = (number(rest, 0), rest.get(4..8).and_then(|kind| kind.first_chunk())) else {
        return Ok(None);
    };
    let (whole, left) = (&rest[8..], rest.len() - 8);
    let Some((bytes, after)) = whole.split_at_checked(length as usize) else {
        return Err(ModelError::broken(format!("a chunk of it says {length} bytes, and {left} are left")));
    };
    *rest = after;
    Ok(Some((kind, bytes)))
}

fn number(bytes: &[u8], at: usize) -> Option<u32> {
    Some(u32::from_le_bytes(*bytes.get(at..at + 4)?.first_chunk()?))
}
