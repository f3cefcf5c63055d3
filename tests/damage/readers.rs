//! Malicious texts, sounds, pictures and packets, for the rows of the table in SECURITY.md whose bound is a multiple of
//! the file.

use super::{
    ceilings::{MIB, Row, measure},
    mutate::Random,
};
use eddy::{
    control::osc,
    glsl::{PassKind, PassSource, Text, diagnose},
    media::{self, MediaKey, mesh},
    playback::recording::Recording,
    project::{self, Media, MeshSource},
};
use eddy_diag::SourceId;
use eddy_texture::Dimension;
use image::{DynamicImage, ImageFormat, ImageReader};
use std::{fs, io::Cursor, path::Path};

pub(crate) fn rows() -> Vec<Row> {
    vec![
        images(),
        textures(),
        arrays(),
        sounds(),
        objects(),
        site_json(),
        manifests(),
        isf(),
        shaders(),
        recordings(),
        osc(),
    ]
}

/// Returns one of the texts, so that a generator makes each kind about equally often.
fn one<'t>(random: &mut Random, all: &[&'t str]) -> &'t str {
    all[random.below(all.len())]
}

fn read_picture(path: &Path) -> bool {
    let key = MediaKey { media: Media::Picked(path.into()), dimension: Dimension::D2, vflip: true };
    media::load(&key, None, None).is_ok()
}

/// Images of all other formats, with changed numbers in their headers.
fn images() -> Row {
    let make = |random: &mut Random| {
        let side = 16 + random.below(300) as u32;
        let formats = [ImageFormat::Jpeg, ImageFormat::Gif, ImageFormat::WebP, ImageFormat::Bmp, ImageFormat::Hdr];
        let format = formats[random.below(formats.len())];
        let image = DynamicImage::new_rgb8(side, side);
        let image = if format == ImageFormat::Hdr { DynamicImage::ImageRgb32F(image.to_rgb32f()) } else { image };
        let mut bytes = Cursor::new(Vec::new());
        image.write_to(&mut bytes, format).unwrap();
        let mut bytes = bytes.into_inner();
        if random.below(2) == 0 {
            let at = 2 + random.below(bytes.len().min(200) - 2);
            bytes[at] = random.below(256) as u8;
        }
        bytes
    };
    // The bytes of the decoder's and of Eddy's texels together, for the size in the file.
    let most = |bytes: &[u8]| {
        let size =
            ImageReader::new(Cursor::new(bytes)).with_guessed_format().ok().and_then(|r| r.into_dimensions().ok());
        let texels = size.map_or(0, |(width, height)| u64::from(width) * u64::from(height)).min(512 << 20) as usize;
        40 * texels + 4 * bytes.len() + 4 * MIB
    };
    measure("JPEG, GIF, WebP, BMP, HDR", "a.png", make, read_picture, most)
}

/// DDS files that claim to be larger than they are.
fn textures() -> Row {
    let make = |random: &mut Random| {
        let side = [4u32, 64, 65, 512][random.below(4)];
        let said = [side, side, 4096, 32_768, u32::MAX][random.below(5)];
        let (flags, bits, masks) = match random.below(3) {
            0 => (0x2_0000u32, 8u32, [0xffu32, 0, 0, 0]),
            1 => (0x2_0001, 16, [0xff, 0, 0, 0xff00]),
            _ => (0x41, 32, [0xff, 0xff00, 0xff_0000, 0xff00_0000]),
        };
        let levels = [1, 4, u32::MAX][random.below(3)];
        let mut fields = vec![124, 0x2_1007, side, said, 0, [0, 1, u32::MAX][random.below(3)], levels];
        fields.extend([0; 11]);
        fields.extend([32, flags, 0, bits]);
        fields.extend(masks);
        fields.extend([0x1000, [0, 0xfe00, 0x20_0000][random.below(3)], 0, 0, 0]);
        let mut file = b"DDS ".to_vec();
        file.extend(fields.iter().flat_map(|field| field.to_le_bytes()));
        file.extend(vec![7; (side * side * bits / 8) as usize]);
        file
    };
    // The texels as stored and as decoded: at most 4 bytes for each byte of the file, flipped once.
    measure("DDS", "a.dds", make, read_picture, |file| 12 * file.len() + MIB)
}

fn arrays() -> Row {
    let make = |random: &mut Random| {
        let side = [8u64, 64, 300][random.below(3)];
        let said = [side, side, 30_000, 1 << 40, u64::MAX][random.below(5)];
        let (kind, bytes) = [("<f4", 4), ("<f8", 8), ("|u1", 1)][random.below(3)];
        let header = format!("{{'descr': '{kind}', 'fortran_order': False, 'shape': ({side}, {said}), }}\n");
        let mut file = b"\x93NUMPY\x01\0".to_vec();
        file.extend((header.len() as u16).to_le_bytes());
        file.extend(header.bytes());
        file.extend(vec![0; (side * side * bytes) as usize]);
        file
    };
    // A byte becomes four floats.
    measure("NPY", "a.npy", make, read_picture, |file| 20 * file.len() + MIB)
}

/// WAV files with few samples per second, and with wrong sizes.
fn sounds() -> Row {
    let make = |random: &mut Random| {
        let rate = [1_000u32, 8_000, 44_100, 768_000, 1, u32::MAX][random.below(6)];
        let channels = [1u16, 2, 32, 33, u16::MAX][random.below(5)];
        let data = vec![128u8; 64 << random.below(13)];
        let size = [data.len() as u32, 0, u32::MAX][random.below(3)];
        let mut file = b"RIFF\xff\xff\xff\xffWAVEfmt \x10\0\0\0\x01\0".to_vec();
        file.extend(channels.to_le_bytes());
        file.extend(rate.to_le_bytes());
        file.extend(rate.wrapping_mul(channels.into()).to_le_bytes());
        file.extend(channels.to_le_bytes());
        file.extend(b"\x08\0data");
        file.extend(size.to_le_bytes());
        file.extend(data);
        file
    };
    let read = |path: &Path| {
        let (name, base) = (path.file_name().unwrap(), path.parent());
        media::sound_preview(&Media::File(name.into()), base, 1_200).is_ok()
    };
    // 44.1 frames of 8 bytes per byte at 1,000 samples per second, and two copies while they are resampled; at most for
    // 20 minutes.
    measure("WAV", "a.wav", make, read, |file| 3 * 8 * 45 * file.len() + 16 * MIB)
}

fn objects() -> Row {
    let make = |random: &mut Random| {
        let mut text = String::from("v 0 0 0\nv 1 0 0\nv 0 1 0\n");
        let count = 1 << random.below(13);
        match random.below(6) {
            0 => text.push_str(&"f 1 2 3\n".repeat(count)),
            1 => text.push_str(&format!("f {}\n", "1 2 3 ".repeat(count))),
            2 => text.push_str(&"g a b c\no x\nusemtl y\nf 1 2 3\n".repeat(count)),
            3 => text.push_str(&"v 0 0 0\nvt 0 0\nvn 0 0 1\n".repeat(count)),
            4 => text.push_str(&format!("f 1 2 {}\n", i64::MAX)),
            _ => text.push_str(&"f -1 -2 -3\nv 1 1 1\n".repeat(count)),
        }
        text.into_bytes()
    };
    let read = |path: &Path| {
        let name = path.file_name().unwrap();
        mesh::load(&MeshSource::File(name.into()), None, path.parent()).is_ok()
    };
    // `f 1 2 3` has 8 bytes, and makes three vertices of 64 bytes and the entries of a lookup table.
    measure("OBJ", "a.obj", make, read, |file| 160 * file.len() + MIB)
}

/// Repeats a text so often that a file has up to a few 100 kB.
fn repeated(random: &mut Random, text: &str) -> String {
    text.repeat(1 + (1 << random.below(18)) / text.len())
}

fn site_json() -> Row {
    let make = |random: &mut Random| {
        let input = r#"{"id":1,"src":"/media/a/x.png","ctype":"texture","channel":0,"sampler":{"filter":"mipmap","wrap":"repeat","vflip":"true","srgb":"false","internal":"byte"}},"#;
        let pass = |inputs: &str, code: &str| {
            let inputs = inputs.trim_end_matches(',');
            format!(
                r#"{{"inputs":[{inputs}],"outputs":[{{"id":37,"channel":0}}],"code":"{code}","name":"Image","type":"image"}}"#
            )
        };
        let code = one(random, &["\\n", "x", "//\\n", "#include \\\"a\\\"\\n", "\\u00e9"]);
        let (passes, more) = match random.below(7) {
            0 => (pass(&repeated(random, input), ""), String::new()),
            1 => (vec![pass("", ""); 1 + random.below(2_000)].join(","), String::new()),
            2 => (pass("", &repeated(random, code)), String::new()),
            3 => (pass("", ""), format!(r#","x":[{}0]"#, repeated(random, "0,"))),
            4 => (pass("", ""), format!(r#","x":{}"#, repeated(random, "["))),
            5 => (
                pass("", ""),
                format!(
                    r#","info":{{"id":"x","name":"{}","tags":[{}"a"]}}"#,
                    repeated(random, "n"),
                    repeated(random, "\"t\",")
                ),
            ),
            _ => (pass("", &repeated(random, "#iUniform float a = 1.0\\n")), String::new()),
        };
        format!(r#"{{"ver":"0.1","renderpass":[{passes}]{more}}}"#).into_bytes()
    };
    let read = |path: &Path| project::load(path.to_str().unwrap()).is_ok();
    measure("JSON of Shadertoy", "a.json", make, read, |file| 40 * file.len() + MIB)
}

fn manifests() -> Row {
    let make = |random: &mut Random| {
        let text = match random.below(11) {
            10 => {
                let lines = (0..1 << random.below(15)).map(|n| format!("a{n}.b.c.d.e.f.g.h.i.j = 1\n"));
                lines.collect::<String>() + "[passes.image]\n"
            }
            7 => format!("description = \"{}\"\n[passes.image]", repeated(random, "n")),
            8 => format!("[passes.image]\n{}", repeated(random, "# a comment\n")),
            9 => format!("tags = [{}]\n[passes.image]", repeated(random, "\"t\",")),
            0 => format!("[uniforms]\n{}", (0..random.below(3_000)).map(|n| format!("a{n} = 1\n")).collect::<String>()),
            1 => (0..random.below(2_000)).map(|n| format!("[passes.buffer_{n}x]\n")).collect(),
            2 => format!("x = {}", repeated(random, "[")),
            3 => format!("x = [{}]", repeated(random, "0,")),
            4 => format!("[info]\nname = \"{}\"", repeated(random, "n")),
            5 => repeated(random, "a.b.c.d.e.f.g = 1\n"),
            _ => format!("[passes.image]\nwhen = \"{}\"", repeated(random, "!(")),
        };
        text.into_bytes()
    };
    let read = |path: &Path| {
        let folder = path.parent().unwrap();
        fs::write(folder.join("image.glsl"), "void mainImage(out vec4 c, in vec2 p) { c = vec4(1.0); }").unwrap();
        project::load(folder.to_str().unwrap()).is_ok()
    };
    measure("eddy.toml", "eddy.toml", make, read, |file| (96 * MIB).min(400 * file.len()) + 8 * file.len() + MIB)
}

fn isf() -> Row {
    let make = |random: &mut Random| {
        let float = r#"{"NAME":"a","TYPE":"float","DEFAULT":0.5,"MIN":0.0,"MAX":1.0},"#;
        let header = match random.below(6) {
            0 => format!(
                r#""INPUTS":[{}]"#,
                (0..random.below(1_000))
                    .map(|n| float.replace("\"a\"", &format!("\"a{n}\"")))
                    .collect::<String>()
                    .trim_end_matches(',')
            ),
            1 => format!(
                r#""PASSES":[{}]"#,
                (0..random.below(900)).map(|n| format!(r#"{{"TARGET":"t{n}"}},"#)).collect::<String>() + "{}"
            ),
            2 => format!(r#""DESCRIPTION":"{}""#, repeated(random, "d")),
            3 => format!(r#""PASSES":[{{"TARGET":"t","WIDTH":"{}"}}]"#, repeated(random, "(")),
            4 => format!(r#""INPUTS":{}"#, repeated(random, "[")),
            _ => format!(r#""INPUTS":[{{"NAME":"a","TYPE":"long","VALUES":[{}0]}}]"#, repeated(random, "1,")),
        };
        format!("/*{{\"ISFVSN\":\"2\",{header}}}*/\nvoid main() {{ gl_FragColor = vec4(1.0); }}\n").into_bytes()
    };
    let read = |path: &Path| project::load(path.to_str().unwrap()).is_ok();
    // Each pass of the file is wrapped in a text of 2 kB.
    measure("ISF", "a.fs", make, read, |file| 200 * file.len() + 4 * MIB)
}

/// The front end, which parses a pass and reports its errors.
fn shaders() -> Row {
    let make = |random: &mut Random| {
        let main = "void mainImage(out vec4 c, in vec2 p) { c = vec4(1.0); }\n";
        let text = match random.below(10) {
            0 => repeated(random, "float f;\n"),
            1 => format!("float f() {{ return {}1.0; }}", repeated(random, "1.0 + ")),
            2 => repeated(random, "#if 0\n#elif 1\n#endif\n"),
            3 => repeated(random, "#define A A A A\n"),
            4 => format!("#define A x x x x\n#define B A A A A\n#define C B B B B\n{}", repeated(random, "C ")),
            5 => format!("float f() {{ {} }}", repeated(random, "{ int i; } ")),
            6 => repeated(random, "float f(float x) { return sin(x); }\n"),
            7 => format!("const float a[] = float[]({}0.0);", repeated(random, "1.0,")),
            8 => format!("void f() {{ {} }}", repeated(random, "nothing(1); ")),
            _ => repeated(random, "struct S { float a; vec3 b[3]; };\n"),
        };
        format!("{text}\n{main}").into_bytes()
    };
    let read = |path: &Path| {
        let text = fs::read_to_string(path).unwrap();
        let source = PassSource::new(PassKind::Image, Text { id: SourceId(0), text: &text });
        !diagnose(&source).iter().any(eddy_diag::Diagnostic::is_error)
    };
    // A token, its place, its expression and its type; a macro may expand to 2^20 tokens of a few bytes.
    measure("GLSL", "a.glsl", make, read, |file| 64 * file.len() + 128 * MIB)
}

fn recordings() -> Row {
    let head = include_str!("../saved/recordings/date.replay");
    let make = move |random: &mut Random| {
        let text = match random.below(5) {
            0 => head.to_owned(),
            1 => format!("{head}{}", repeated(random, "{\"time\":1.5,\"date\":[2026.0,10.0,29.0,1000.5]}\n")),
            2 => format!("{head}{}", repeated(random, "[")),
            3 => repeated(random, "x"),
            _ => head.replacen('1', &repeated(random, "9"), 1),
        };
        text.into_bytes()
    };
    let read = |path: &Path| Recording::read(std::io::BufReader::new(fs::File::open(path).unwrap())).is_ok();
    measure("recording", "a.replay", make, read, |file| 60 * file.len() + MIB)
}

fn osc() -> Row {
    let make = |random: &mut Random| {
        let padded = |text: &str| {
            let mut bytes = text.as_bytes().to_vec();
            bytes.resize(text.len() / 4 * 4 + 4, 0);
            bytes
        };
        let message = |count: usize| {
            let tags = format!(",{}", "f".repeat(count));
            [padded("/a/b"), padded(&tags), vec![0; 4 * count]].concat()
        };
        let one = message(1 + random.below(70));
        match random.below(4) {
            0 => one,
            1 => {
                let element = [&(one.len() as u32).to_be_bytes()[..], &one].concat();
                [b"#bundle\0".to_vec(), vec![0; 8], element.repeat(1 + random.below(1_100))].concat()
            }
            2 => {
                let mut nested = one;
                for _ in 0..random.below(12) {
                    nested = [b"#bundle\0".to_vec(), vec![0; 8], (nested.len() as u32).to_be_bytes().to_vec(), nested]
                        .concat();
                }
                nested
            }
            _ => one[..random.below(one.len())].to_vec(),
        }
    };
    let read = |path: &Path| osc::decode(&fs::read(path).unwrap()).is_ok();
    measure("OSC packet", "a.osc", make, read, |packet| 40 * packet.len() + MIB)
}
