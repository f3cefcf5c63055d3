//! The bytes of a glTF file's buffers, wherever they are stored.

use super::{
    document::{Index, Root},
    extensions,
};
use crate::mesh::trouble::ModelError;
use data_url::DataUrl;
use eddy_project::{
    confine::FileError,
    limits::{self, Limit},
    unescaped,
};
use std::borrow::Cow;

/// Reads a file that the model names.
pub(super) type Named<'a> = &'a dyn Fn(&str, Limit) -> Result<Vec<u8>, FileError>;

/// No system accepts a longer file name.
const LONGEST_NAME: usize = 4096;

/// The bytes of every buffer; `None` if the file names none. That is not an error until the buffer is read: it may be a
/// placeholder for data that an extension compresses.
pub(super) struct Buffers<'a>(Vec<Option<Cow<'a, [u8]>>>);

impl<'a> Buffers<'a> {
    /// Loads all buffers. `taken` is the number of bytes of the model file itself.
    pub(super) fn load(
        root: &Root<'_>,
        mut binary: Option<&'a [u8]>,
        named: Named<'_>,
        taken: u64,
    ) -> Result<Buffers<'a>, ModelError> {
        let mut left = limits::MODEL_FILES.bytes.saturating_sub(taken);
        let mut buffers = Vec::with_capacity(root.buffers.len());
        for (n, buffer) in root.buffers.iter().enumerate() {
            let uri = buffer.uri.as_ref().map(|uri| &*uri.0);
            let mut bytes: Cow<'a, [u8]> = match uri {
                // The binary chunk belongs to the first buffer (section 3.6.1.2).
                None => match binary.take().filter(|_| n == 0) {
                    Some(binary) => binary.into(),
                    None => {
                        buffers.push(None);
                        continue;
                    }
                },
                // Its length is bounded by that of the file, which stores 3 bytes in 4, or one byte in one.
                Some(uri) if is_data(uri) => match data(uri) {
                    Ok(bytes) => bytes.into(),
                    Err(why) => return Err(ModelError::broken(format!("the data: address of buffer {n} {why}"))),
                },
                Some(uri) if uri.len() > LONGEST_NAME => {
                    return Err(ModelError::broken(format!("buffer {n} has a file name of {} bytes", uri.len())));
                }
                Some(uri) if uri.contains(':') => {
                    return Err(ModelError::broken(format!(
                        "buffer {n} refers to {uri}, which is neither a file nor data"
                    )));
                }
                Some(uri) => {
                    let limit = Limit { bytes: left, ..limits::MODEL_FILES };
                    let bytes = named(&unescaped(uri), limit).map_err(ModelError::Named)?;
                    left -= bytes.len() as u64;
                    bytes.into()
                }
            };
            // Lengths are often rounded up, and files cut to the last byte.
            if (bytes.len().next_multiple_of(4) as u64) < buffer.byte_length {
                let whose = match uri {
                    None => "the binary chunk".into(),
                    Some(uri) if is_data(uri) => "its data: address".into(),
                    Some(uri) => format!("its file {}", ModelError::short(&unescaped(uri))),
                };
                let (said, there) = (buffer.byte_length, bytes.len());
                return Err(ModelError::broken(format!(
                    "buffer {n} has {said} bytes by its byteLength, and {whose} {there}"
                )));
            }
            if !bytes.len().is_multiple_of(4) {
                let whole = bytes.len().next_multiple_of(4);
                bytes.to_mut().resize(whole, 0);
            }
            buffers.push(Some(bytes));
        }
        Ok(Buffers(buffers))
    }

    /// Returns the total number of bytes.
    pub(super) fn bytes(&self) -> u64 {
        self.0.iter().flatten().map(|bytes| bytes.len() as u64).sum()
    }

    /// Returns the bytes of a buffer view, whose index must be in range.
    pub(super) fn view(&self, root: &Root<'_>, view: Index) -> Result<&[u8], ModelError> {
        let described = &root.buffer_views[view as usize];
        let buffer = described.buffer;
        let Some(whole) = &self.0[buffer as usize] else {
            return Err(match (&described.extensions.ext_meshopt, &described.extensions.khr_meshopt) {
                (Some(_), _) => extensions::meshopt("EXT_meshopt_compression"),
                (_, Some(_)) => extensions::meshopt("KHR_meshopt_compression"),
                _ => ModelError::broken(format!("buffer {buffer} has no file, and there is no binary chunk for it")),
            });
        };
        let range = || {
            let start = usize::try_from(described.byte_offset).ok()?;
            whole.get(start..start.checked_add(usize::try_from(described.byte_length).ok()?)?)
        };
        range().ok_or_else(|| ModelError::broken(format!("bufferView {view} reaches beyond buffer {buffer}")))
    }
}

/// Returns whether a URI contains its data itself. Schemes are case-insensitive (RFC 3986, section 3.1).
fn is_data(uri: &str) -> bool {
    uri.get(..5).is_some_and(|scheme| scheme.eq_ignore_ascii_case("data:"))
}

fn data(uri: &str) -> Result<Vec<u8>, &'static str> {
    let url = DataUrl::process(uri).map_err(|_| "has no comma before its data")?;
    url.decode_to_vec().map(|(bytes, _)| bytes).map_err(|_| "is not valid base64")
}
