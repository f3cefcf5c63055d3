//! Malicious compressed textures, MIDI streams, and messages to the language server, for the rows of the table in
//! SECURITY.md whose bound is a multiple of the input.

use super::{
    ceilings::{MIB, Row, measure},
    mutate::Random,
};
use eddy::{
    control::midi::MidiDecoder,
    lsp,
    media::{self, MediaKey},
    project::{Media, limits},
};
use eddy_texture::Dimension;
use std::{
    fs,
    io::Cursor,
    path::Path,
    time::{Duration, Instant},
};

pub(crate) fn rows() -> Vec<Row> {
    vec![khronos_textures(), midi(), language_server()]
}

/// A frame of Zstandard (RFC 8878) of blocks that repeat a byte: 4 bytes become up to 128 KiB.
fn repeated_byte(size: usize) -> Vec<u8> {
    const BLOCK: usize = 128 << 10;
    // The magic number, no optional fields, a window of 128 KiB.
    let mut frame = vec![0x28, 0xb5, 0x2f, 0xfd, 0, 7 << 3];
    let blocks = size.div_ceil(BLOCK).max(1);
    for n in 0..blocks {
        let length = if n + 1 == blocks { size - n * BLOCK } else { BLOCK };
        let header = u32::from(n + 1 == blocks) | 1 << 1 | (length as u32) << 3;
        frame.extend(&header.to_le_bytes()[..3]);
        frame.push(7);
    }
    frame
}

/// KTX2 files whose level may be compressed, and with sizes that differ from the actual ones.
fn khronos_textures() -> Row {
    const SIDES: [u32; 4] = [4, 64, 65, 512];
    let make = |random: &mut Random| {
        let side = SIDES[random.below(4)];
        let claimed = [side, side, 2048, 32_768, u32::MAX][random.below(5)];
        // R8_UNORM, R8G8B8A8_UNORM, R16_UNORM, R32G32B32A32_SFLOAT and BC1, with the bytes of a block of texels.
        let (format, block, bytes) = [(9u32, 1, 1), (37, 1, 4), (70, 1, 2), (109, 1, 16), (131, 4, 8)][random.below(5)];
        let faces = [1u32, 6, 6, u32::MAX][random.below(4)];
        let layers = [0u32, 0, 2, u32::MAX][random.below(4)];
        let level = (side.div_ceil(block).pow(2) * bytes) as usize * if faces == 6 { 6 } else { 1 };
        let is_packed = random.below(2) == 0;
        let data = if is_packed { repeated_byte(level * [1, 50][random.below(2)]) } else { vec![7; level] };
        let mut file = b"\xabKTX 20\xbb\r\n\x1a\n".to_vec();
        let start = 108u64;
        let fields =
            [format, 1, side, claimed, 0, layers, faces, 1, if is_packed { 2 } else { 0 }, start as u32 - 4, 4, 0, 0];
        file.extend(fields.iter().flat_map(|field| field.to_le_bytes()));
        file.extend([0; 16]);
        let unpacked = [level as u64, u64::MAX][random.below(2)];
        file.extend([start, data.len() as u64, unpacked].iter().flat_map(|field| field.to_le_bytes()));
        file.extend(4u32.to_le_bytes());
        file.extend(data);
        file
    };
    let read = |path: &Path| {
        let media = Media::Picked(path.into());
        let dimensions = [Dimension::D2, Dimension::Cube];
        dimensions
            .iter()
            .any(|d| media::load(&MediaKey { media: media.clone(), dimension: *d, vflip: true }, None, None).is_ok())
    };
    // The texels of all faces and layers declared in the file, as long as they are within the limit.
    let max_bytes = |file: &[u8]| {
        let field = |at: usize| u64::from(u32::from_le_bytes(file[at..at + 4].try_into().unwrap()));
        let count = field(32).max(1).saturating_mul(field(36));
        let texels = field(20).saturating_mul(field(24)).saturating_mul(count);
        let texels = if texels.saturating_mul(4) <= limits::PICTURE_BYTES { texels as usize } else { 0 };
        48 * texels + 3 * file.len() + MIB
    };
    measure("KTX2", "a.ktx2", make, read, max_bytes)
}

/// MIDI streams: controllers with running status, interleaved messages, and random bytes.
fn midi() -> Row {
    let make = |random: &mut Random| match random.below(5) {
        0 => [&[0xb0u8][..], &[7, 64].repeat(1 << random.below(15))].concat(),
        1 => [&[0xb0u8][..], &[99, 1, 98, 2, 6, 3, 38, 4].repeat(1 << random.below(13))].concat(),
        2 => [&[0xf0u8][..], &vec![1; 1 << random.below(17)]].concat(),
        3 => [0x90u8, 0xf8, 60, 0xf8].repeat(1 << random.below(14)),
        _ => (0..1 << random.below(17)).map(|_| random.below(256) as u8).collect(),
    };
    let read = |path: &Path| {
        let (bytes, mut events) = (fs::read(path).unwrap(), Vec::new());
        let mut decoder = MidiDecoder::default();
        let now = Instant::now();
        decoder.feed(&bytes, now, &mut events);
        decoder.feed(&bytes[..bytes.len() / 2], now + Duration::from_millis(1), &mut events);
        !events.is_empty()
    };
    // Two bytes are an event, and a growing list exists twice for a moment.
    measure("MIDI", "a.midi", make, read, |bytes| 160 * bytes.len() + MIB)
}

/// A session with an editor that opens a text and sends another message.
fn language_server() -> Row {
    let framed = |text: &str| format!("Content-Length: {}\r\n\r\n{text}", text.len());
    let make = move |random: &mut Random| {
        let repeated = |random: &mut Random, text: &str| text.repeat(1 + (1 << random.below(18)) / text.len());
        let open = |text: &str| {
            let document =
                format!(r#"{{"uri":"file:///nowhere/a.glsl","languageId":"glsl","version":1,"text":"{text}"}}"#);
            format!(r#"{{"jsonrpc":"2.0","method":"textDocument/didOpen","params":{{"textDocument":{document}}}}}"#)
        };
        let other = |params: &str| format!(r#"{{"jsonrpc":"2.0","id":9,"method":"unknown","params":{params}}}"#);
        let more = match random.below(9) {
            0 => framed(&open(&repeated(random, "// a comment\\n"))),
            1 => framed(&open(&repeated(random, "\\u0020"))),
            2 => framed(&other(&format!("[{}0]", repeated(random, "0,")))),
            3 => framed(&other(&repeated(random, "["))),
            4 => framed(&other(&format!(r#"{{"a":"{}"}}"#, repeated(random, "a")))),
            5 => framed(&other("[]")).repeat(1 + random.below(2_000)),
            6 => format!("{}\r\n", repeated(random, "x: y")),
            7 => format!("Content-Length: {}\r\n\r\nx", [u64::MAX, 64 << 20, 65 << 20][random.below(3)]),
            _ => framed(&repeated(random, "x")),
        };
        let start = framed(r#"{"jsonrpc":"2.0","id":1,"method":"initialize","params":{"capabilities":{}}}"#)
            + &framed(r#"{"jsonrpc":"2.0","method":"initialized","params":{}}"#);
        let end =
            framed(r#"{"jsonrpc":"2.0","id":2,"method":"shutdown"}"#) + &framed(r#"{"jsonrpc":"2.0","method":"exit"}"#);
        (start + &more + &end).into_bytes()
    };
    let read = |path: &Path| matches!(lsp::serve(Cursor::new(fs::read(path).unwrap()), std::io::sink()), Ok(0));
    // A number of two bytes becomes a value of 32, in a growing list; a text is read by the front end.
    measure("messages to eddy lsp", "a.lsp", make, read, |stream| 100 * stream.len() + 16 * MIB)
}
