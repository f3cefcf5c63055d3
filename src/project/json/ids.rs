//! The site's ids of buffers: what one writes and what an input reads.

use crate::PassName;

/// Buffer A to D. The API's older answers have the numbers.
const BUFFERS: [(&str, &str, &str); 4] =
    [("A", "4dXGR8", "257"), ("B", "XsXGR8", "258"), ("C", "4sXGR8", "259"), ("D", "XdfGR8", "260")];

/// Id of a buffer's output. A further buffer, which the site does not have, is known by its key.
pub(super) fn of_buffer(name: &str) -> String {
    match BUFFERS.iter().find(|(n, ..)| *n == name) {
        Some((_, id, _)) => (*id).to_owned(),
        None => PassName::buffer(name).key().to_owned(),
    }
}

/// The buffer an id stands for.
pub(super) fn buffer(id: &str) -> Option<String> {
    if let Some((name, ..)) = BUFFERS.iter().find(|(_, i, number)| *i == id || *number == id) {
        return Some((*name).to_owned());
    }
    PassName::parse(id.strip_prefix("buffer_").map(|_| id)?)?.buffer_name().map(str::to_owned)
}

/// Path of a buffer's preview picture, which the site's inputs carry; empty for a buffer that the site does not have.
pub(super) fn preview(name: &str) -> String {
    match BUFFERS.iter().position(|(n, ..)| *n == name) {
        Some(number) => format!("/media/previz/buffer0{number}.png"),
        None => String::new(),
    }
}

/// The buffer a preview picture's path stands for.
pub(super) fn buffer_of_preview(path: &str) -> Option<String> {
    let number: usize = path.rsplit_once("buffer0")?.1.strip_suffix(".png")?.parse().ok()?;
    BUFFERS.get(number).map(|(name, ..)| (*name).to_owned())
}
