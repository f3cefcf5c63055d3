//! The bytes of a glTF file's buffers, wherever they are.

use crate::{
    media::mesh::trouble::Trouble,
    project::{
        confine::FileError,
        limits::{self, Limit},
        unescaped,
    },
};
use gltf::{
    Document,
    buffer::{Data, Source},
};
use std::borrow::Cow;

/// Reads a file that the model names.
pub(super) type Named<'a> = &'a dyn Fn(&str, Limit) -> Result<Vec<u8>, FileError>;

/// The longest file name that any system takes is shorter.
const LONGEST_NAME: usize = 4096;

/// The bytes of every buffer. `taken`: bytes of the model file itself.
pub(super) fn load<'a>(
    document: &Document,
    mut blob: Option<Cow<'a, [u8]>>,
    named: Named<'_>,
    taken: u64,
) -> Result<Vec<Cow<'a, [u8]>>, Trouble> {
    let mut left = limits::MODEL_FILES.bytes.saturating_sub(taken);
    let mut buffers = Vec::new();
    for buffer in document.buffers() {
        let n = buffer.index();
        let is_in_file = matches!(buffer.source(), Source::Bin);
        let bytes = match buffer.source() {
            Source::Bin => match blob.take() {
                Some(blob) => blob,
                None => return Err(Trouble::broken(format!("buffer {n} names no file, and there is no binary chunk"))),
            },
            // Its length is bounded by that of the file, which holds it in 4 bytes for 3.
            Source::Uri(uri) if uri.starts_with("data:") => {
                let data = Data::from_source(Source::Uri(uri), None);
                data.map_err(|e| Trouble::broken(format!("the data: address of buffer {n}: {e}")))?.0.into()
            }
            Source::Uri(uri) if uri.len() > LONGEST_NAME => {
                return Err(Trouble::broken(format!("the file of buffer {n} has a name of {} bytes", uri.len())));
            }
            Source::Uri(uri) if uri.contains(':') => {
                return Err(Trouble::broken(format!("buffer {n} names {uri}, which is neither a file nor data")));
            }
            Source::Uri(uri) => {
                let mut bytes =
                    named(&unescaped(uri), Limit { bytes: left, ..limits::MODEL_FILES }).map_err(Trouble::Named)?;
                left -= bytes.len() as u64;
                // As the crate does: a length is often rounded up.
                bytes.resize(bytes.len().next_multiple_of(4), 0);
                bytes.into()
            }
        };
        if bytes.len() < buffer.length() {
            let there = bytes.len();
            let whose = if is_in_file { "the binary chunk" } else { "its file" };
            let said = buffer.length();
            return Err(Trouble::broken(format!("buffer {n} has {said} bytes by its byteLength, and {whose} {there}")));
        }
        buffers.push(bytes);
    }
    Ok(buffers)
}
