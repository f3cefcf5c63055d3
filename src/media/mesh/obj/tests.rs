//! Tests of OBJ files in the forms in which programs write them, and of the errors of broken ones.

use super::*;

/// A quad in the plane z = 0.
const QUAD: &str = "v -1 -1 0\nv 1 -1 0\nv 1 1 0\nv -1 1 0\n";

/// Returns the triangles of a text by their corners' positions, and its warnings.
fn read(text: impl AsRef<[u8]>) -> Result<(Vec<Vertex>, Vec<MeshWarning>), ModelError> {
    let mut corners = Vec::new();
    let warnings = load(text.as_ref(), 1 << 30, &mut |raw| {
        corners.extend(raw.indices.iter().map(|i| raw.vertices[*i as usize]));
        Ok(())
    })?;
    Ok((corners, warnings))
}

fn places(text: impl AsRef<[u8]>) -> Vec<[f32; 3]> {
    let (corners, warnings) = read(text).unwrap();
    assert_eq!(warnings, []);
    corners.iter().map(|v| v.position).collect()
}

fn quad() -> Vec<[f32; 3]> {
    let [a, b, c, d] = [[-1.0, -1.0, 0.0], [1.0, -1.0, 0.0], [1.0, 1.0, 0.0], [-1.0, 1.0, 0.0]];
    vec![a, b, c, a, c, d]
}

/// Returns the line of an error, its message and its hint.
fn error(text: impl AsRef<[u8]>) -> (usize, String, String) {
    match read(text) {
        Err(ModelError::Line { line, reason, hint: fix }) => (line, reason, fix),
        other => panic!("{other:?}"),
    }
}

#[test]
fn every_encoding_and_line_end_gives_the_same_shape() {
    let text = format!("# a quad\n{QUAD}f 1 2 3 4\n");
    assert_eq!(places(&text), quad());
    let utf16 = |mark: &str, bytes: fn(u16) -> [u8; 2]| -> Vec<u8> {
        format!("{mark}{text}").encode_utf16().flat_map(bytes).collect()
    };
    let others: [(&str, Vec<u8>); 9] = [
        ("a byte order mark", format!("\u{feff}{QUAD}f 1 2 3 4\n").into()),
        ("UTF-16, big end first", utf16("\u{feff}", u16::to_be_bytes)),
        ("UTF-16, little end first", utf16("\u{feff}", u16::to_le_bytes)),
        ("UTF-16 without a mark", utf16("", u16::to_le_bytes)),
        ("Latin-1", [b"o Stra\xdfe\nusemtl \xfcber \\\ng \xe9\n", text.as_bytes()].concat()),
        ("two bytes a line end", text.replace('\n', "\r\n").into()),
        ("line ends of old Macs", text.replace('\n', "\r").into()),
        ("no line end at the end", text.trim_end().into()),
        ("zeros behind the end", format!("{text}\0\0\0").into()),
    ];
    for (what, bytes) in others {
        assert_eq!(places(bytes), quad(), "{what}");
    }
}

#[test]
fn statements_with_any_spacing_continuation_and_comments_are_read() {
    for face in [
        "f 1 2 \\\n 3 4",
        "f 1 2\\\n3 4",
        "f \\\r\n1 \\  \r\n2 3 4",
        "\tf  1\t2 3   4  ",
        "f 1 2 3 4 # of a room",
        "f 1 2 3 4#",
        "# its folder is C:\\models\\\nf 1 2 3 4",
        "f -4 -3 -2 -1",
        "f +1 2 03 4",
        "f 1// 2/ 3/ 4//",
        "f 1/0 2/0 3/0 4/0/0",
        "f 1/9/9 2/9/9 3/9/9 4/9/9",
        "fo 1 2 3 4",
        "g\no\ns off\nmtllib a file.mtl\nusemtl\nvp 0.5\ncstype bezier\nend\nf 1 2 3 4\nf\nf 1\nf 2 1\nl 1 2 3\np 1",
    ] {
        assert_eq!(places(format!("{QUAD}{face}")), quad(), "{face}");
    }
    // Faces may precede their vertices.
    assert_eq!(places(format!("f 1 2 3 4\n{QUAD}")), quad());
    let numbers = "v -1. -1.0e0 +0 1.0\nv +1 -.1e1 0 0.5\nv 1D0 1 0 0.2 0.4 0.6\nv -1 1 0 1 0 0 0.5\nf 1 2 3 4";
    assert_eq!(places(numbers), quad(), "the weight of a vertex is for curves");
}

#[test]
fn attributes_need_all_corners_of_a_face() {
    let text = "v 0 0 0\nv 1 0 0 0.5 0.25 0\nv 0 1 0\nvt 0.5\nvt 0.25 0.75 9\nvn 0 0 -2\nvn 0 0 0\n\
                f 1/1/1 2/2/1 3/2/2\nf 1//1 2//1 3//1\nf 1/1 2 3/2\n";
    let mut raws = Vec::new();
    let keep = &mut |raw| {
        raws.push(raw);
        Ok(())
    };
    assert_eq!(load(text.as_bytes(), 1 << 30, keep).unwrap(), []);
    let found: Vec<_> = raws.iter().map(|raw| (raw.has_uv, raw.has_normals, raw.indices.len())).collect();
    assert_eq!(found, [(false, false, 3), (false, true, 3), (true, true, 3)]);
    let whole = &raws[2].vertices;
    assert_eq!(whole.iter().map(|v| v.uv).collect::<Vec<_>>(), [[0.5, 0.0], [0.25, 0.75], [0.25, 0.75]]);
    assert_eq!([whole[0].normal, whole[2].normal], [[0.0, 0.0, -1.0], [0.0, 1.0, 0.0]]);
    assert_eq!([whole[0].color, whole[1].color], [[1.0; 4], [0.5, 0.25, 0.0, 1.0]]);
    assert!(raws[0].vertices.iter().all(|v| v.uv == [0.0; 2]));
}

#[test]
fn errors_name_the_line_the_word_and_the_fix() {
    for (line, text, reason, fix) in [
        (1, "v 0,5 0 0", "0,5 is not a number: it has a decimal comma", "with a point: 0.5 for 0,5"),
        (2, "\nv 1,2,3", "1,2,3 is not a number", "separate the numbers"),
        (1, "v 0 zero 0", "zero is not a number", "0.25"),
        (3, "# a\rv 0 0 0\r\nv 1 2", "3 numbers, 4 with a weight or 6 with a colour, but this has 2", "export"),
        (1, "v 1 2 3 4 5", "but this has 5", "export"),
        (1, "vn 0 1", "a normal has 3 numbers, but this has 2", "export"),
        (1, "vt", "a texture coordinate has 1 to 3 numbers, but this has none", "export"),
        (1, "vt 0.5 1.0x", "1.0x is not a number", "0.25"),
        (5, "f 1 2 7", "7 uses vertex 7, but the file has 4", "truncated"),
        (6, "vt 0 0\nf 1/1 2/2 3/1", "2/2 uses texture coordinate 2, but the file has 1", "truncated"),
        (6, "vn 0 0 1\nf 1//1 2//1 3//-2", "3//-2 uses normal -2, but only 1 come before it", "counts back"),
        (6, "f 1 2 \\\n9 3", "9 uses vertex 9", "truncated"),
        (5, "f 0 4 1", "0 uses vertex 0", "counts from 1"),
        (5, "f 1 2 c", "c is not a corner of a face", "v/vt/vn"),
        (5, "f 1.0 2 3", "1.0 is not a corner", "whole numbers"),
        (5, "f 1/1/1/1 2 3", "1/1/1/1 is not a corner", "v/vt/vn"),
        (5, "f 1 /2 3", "/2 is not a corner", "v/vt/vn"),
        (5, "f 99999999999999999999 2 3", "uses vertex 99999999999999999999, but the file has 4", "truncated"),
        (5, "f 1 2 \u{1}", "\\u{1} is not a corner", "whole numbers"),
    ] {
        let text = if text.contains('f') && !text.contains("v 0 zero") { format!("{QUAD}{text}") } else { text.into() };
        let (at, says, hint) = error(&text);
        assert!(says.contains(reason) && hint.contains(fix) && at == line, "{text:?}: line {at}: {says} ({hint})");
    }
    let long = error(format!("v {} 0 0", "x".repeat(1 << 20)));
    assert!(long.1.len() < 100, "{}", long.1.len());
}

#[test]
fn ignored_parts_of_a_model_are_warnings() {
    let warned = |text: String, words: &str| {
        let (corners, warnings) = read(&text).unwrap();
        assert!(warnings.len() == 1 && warnings[0].message.contains(words), "{text}: {warnings:?}");
        corners.iter().map(|v| v.position).collect::<Vec<_>>()
    };
    let broken = "v 1.#IND 0 0\nv nan 0 0\nv 1e99 0 0\nf 5 1 2\nf 1 6 7\nf 1 2 3 4\n";
    assert_eq!(warned(format!("{QUAD}{broken}"), "line 5: 1.#IND is not a number; faces"), quad());
    let normals = "vn 0 -nan(ind) 1\nf 1//1 2//1 3//1 4//1\n";
    assert_eq!(
        warned(format!("{QUAD}{normals}"), "line 5: -nan(ind) is not a number; faces with such a normal"),
        quad()
    );
    assert_eq!(warned(format!("{QUAD}f 0 1 2 3\n"), "line 5: a face uses vertex 0"), quad());
    assert_eq!(warned(format!("{QUAD}f 1 2 3 4\ncurv 0 1 1 2\n"), "line 6: its curves and surfaces"), quad());
    // A triangle without an area replaces a missing mesh.
    let nothing = "it has no triangles, so nothing of it is drawn (vertices: 4, lines: 1, points: 1)";
    assert_eq!(warned(format!("{QUAD}l 1 2 3 4\np 1\n"), nothing), [[-1.0, -1.0, 0.0]; 3]);
    let all = error(format!("{QUAD}v 0 inf 0\nf 1 2 5\n"));
    assert!(all.0 == 5 && all.1.contains("the position of a vertex is not a number (inf)"), "{all:?}");
    for text in ["", "# nothing but words\n", "what this is\nnobody knows\n"] {
        assert!(matches!(read(text), Err(ModelError::Broken(reason)) if reason.contains("no triangles")), "{text}");
    }
}
