//! Shadertoy's ids of buffers, in outputs and inputs.

use crate::PassName;

/// Buffer A to D: name, current id and the numeric id of older API responses.
const BUFFERS: [(&str, &str, &str); 4] =
    [("A", "4dXGR8", "257"), ("B", "XsXGR8", "258"), ("C", "4sXGR8", "259"), ("D", "XdfGR8", "260")];

/// The id of a buffer's output. Buffers that Shadertoy does not have use their key.
pub(super) fn of_buffer(name: &str) -> String {
    match BUFFERS.iter().find(|(n, ..)| *n == name) {
        Some((_, id, _)) => (*id).to_owned(),
        None => PassName::buffer(name).key().to_owned(),
    }
}

/// The buffer with an id.
pub(super) fn buffer(id: &str) -> Option<String> {
    if let Some((name, ..)) = BUFFERS.iter().find(|(_, i, number)| *i == id || *number == id) {
        return Some((*name).to_owned());
    }
    PassName::parse(id.strip_prefix("buffer_").map(|_| id)?)?.buffer_name().map(str::to_owned)
}

/// The path of a buffer's preview picture, which Shadertoy's inputs contain; empty for a buffer that Shadertoy does not
/// have.
pub(super) fn preview(name: &str) -> String {
    match BUFFERS.iter().position(|(n, ..)| *n == name) {
        Some(number) => format!("/media/previz/buffer0{number}.png"),
        None => String::new(),
    }
}

/// The buffer with the path of a preview picture.
pub(super) fn buffer_of_preview(path: &str) -> Option<String> {
    let number: usize = path.rsplit_once("buffer0")?.1.strip_suffix(".png")?.parse().ok()?;
    BUFFERS.get(number).map(|(name, ..)| (*name).to_owned())
}
