use super::*;
use image::{ImageBuffer, Luma, Rgb, Rgba};

fn picture(media: &Media, vflip: bool, base: Option<&Path>, media_dir: Option<&Path>) -> Result<Texels, MediaError> {
    load(&MediaKey { media: media.clone(), dimension: Dimension::D2, vflip }, base, media_dir)
}

fn load_file(path: &Path, vflip: bool) -> Result<Texels, MediaError> {
    picture(&Media::File(path.file_name().unwrap().into()), vflip, path.parent(), None)
}

#[test]
fn vflip_puts_the_top_row_at_v_one_and_keeps_all_values() {
    let dir = tempfile::tempdir().unwrap();
    let path = dir.path().join("a.png");
    let pixels = vec![1, 2, 3, 4, 128, 129, 130, 0, 250, 251, 252, 253, 9, 8, 7, 6];
    ImageBuffer::<Rgba<u8>, _>::from_raw(2, 2, pixels.clone()).unwrap().save(&path).unwrap();
    let plain = load_file(&path, false).unwrap();
    assert_eq!((plain.shape.width, plain.shape.height, plain.shape.format), (2, 2, TexelFormat::Rgba8));
    assert_eq!(plain.bytes, pixels);
    let flipped = load_file(&path, true).unwrap();
    assert_eq!(flipped.bytes, [&pixels[8..], &pixels[..8]].concat());
}

#[test]
fn a_grey_file_is_still_rgba_and_sixteen_bits_become_eight() {
    let dir = tempfile::tempdir().unwrap();
    let path = dir.path().join("grey.png");
    ImageBuffer::<Luma<u16>, _>::from_raw(2, 1, vec![0x8080u16, 0xffff]).unwrap().save(&path).unwrap();
    assert_eq!(load_file(&path, false).unwrap().bytes, [128, 128, 128, 255, 255, 255, 255, 255]);
}

#[test]
fn a_high_dynamic_range_picture_keeps_values_above_one() {
    let dir = tempfile::tempdir().unwrap();
    let path = dir.path().join("a.hdr");
    ImageBuffer::<Rgb<f32>, _>::from_raw(1, 1, vec![4.0f32, 0.5, 0.25]).unwrap().save(&path).unwrap();
    let texels = load_file(&path, true).unwrap();
    assert_eq!(texels.shape.format, TexelFormat::Rgba32f);
    assert_eq!(bytemuck::pod_collect_to_vec::<u8, f32>(&texels.bytes), [4.0, 0.5, 0.25, 1.0]);
}

#[test]
fn broken_pictures_are_errors() {
    let dir = tempfile::tempdir().unwrap();
    let write = |name: &str, bytes: &[u8]| {
        let path = dir.path().join(name);
        std::fs::write(&path, bytes).unwrap();
        path
    };
    std::fs::create_dir(dir.path().join("sub")).unwrap();
    let good = dir.path().join("good.png");
    ImageBuffer::<Rgba<u8>, _>::from_pixel(64, 64, Rgba([1u8, 2, 3, 4])).save(&good).unwrap();
    let whole = std::fs::read(&good).unwrap();
    // Width 0 and width 2^31-1 in the header, with a correct checksum.
    let with_size = |width: u32, height: u32| {
        let mut bytes = whole.clone();
        bytes[16..20].copy_from_slice(&width.to_be_bytes());
        bytes[20..24].copy_from_slice(&height.to_be_bytes());
        let crc = crc32(&bytes[12..29]);
        bytes[29..33].copy_from_slice(&crc.to_be_bytes());
        bytes
    };
    for (path, expected) in [
        (write("cut.png", &whole[..whole.len() / 2]), "cut.png"),
        (write("empty.png", b""), "truncated"),
        (write("text.png", b"hello, this is no picture at all"), "is not that of a PNG"),
        (write("notes.txt", b"hello, this is no picture at all"), "not a supported image"),
        (write("zero.png", &with_size(0, 64)), "zero.png"),
        (write("huge.png", &with_size(0x7fff_ffff, 0x7fff_ffff)), "huge.png"),
        (
            write("large.png", &with_size(20000, 20000)),
            "large.png: the image has 20000x20000 texels, which take 1600000000 bytes; the limit for an image is \
             512 MiB",
        ),
        (write("long.png", &with_size(40000, 2)), "40000x2 texels, and the limit per side is 32768"),
        (dir.path().join("missing.png"), "cannot read"),
        (dir.path().join("sub"), "folder"),
    ] {
        let error = load_file(&path, false).expect_err(expected);
        assert!(error.to_string().contains(expected), "{path:?}: {error}");
        assert!(!error.hint().is_empty());
    }
}

fn crc32(bytes: &[u8]) -> u32 {
    !bytes.iter().fold(!0u32, |crc, b| {
        (0..8).fold(crc ^ u32::from(*b), |c, _| if c & 1 == 1 { 0xedb8_8320 ^ (c >> 1) } else { c >> 1 })
    })
}

#[test]
fn files_in_the_media_folder_replace_fallbacks_and_grey_ids_have_one_channel() {
    let dir = tempfile::tempdir().unwrap();
    let grey = Media::Site { id: "4sf3Rn".into(), path: "/media/a/0a40.png".into() };
    let fallback = picture(&grey, true, None, None).unwrap();
    assert_eq!((fallback.shape.width, fallback.shape.height, fallback.shape.format), (64, 64, TexelFormat::R8));
    ImageBuffer::<Rgba<u8>, _>::from_pixel(3, 1, Rgba([7u8, 2, 3, 4])).save(dir.path().join("0a40.png")).unwrap();
    let own = picture(&grey, true, None, Some(dir.path())).unwrap();
    assert_eq!(
        (own.shape.width, own.shape.height, own.shape.format, own.bytes),
        (3, 1, TexelFormat::R8, vec![7, 7, 7])
    );
    let unknown = Media::Site { id: "zzz".into(), path: "/media/a/unknown.jpg".into() };
    assert!(matches!(picture(&unknown, true, None, Some(dir.path())), Err(MediaError::NoStandIn { .. })));
}

#[test]
fn an_unknown_built_in_names_the_nearest() {
    let error = picture(&Media::Builtin("noise-rgb-256".into()), true, None, None).unwrap_err();
    assert!(error.to_string().contains("noise-rgba-256"), "{error}");
    assert!(matches!(picture(&Media::File("a.png".into()), true, None, None), Err(MediaError::NoFolder { .. })));
}

/// Returns the letters of the corners' colours (red, green, blue and white), in reading order.
fn corners(texels: &Texels) -> String {
    let (w, h) = (texels.shape.width as usize, texels.shape.height as usize);
    let name = |[x, y]: [usize; 2]| {
        let at = (y * w + x) * 4;
        match texels.bytes[at..at + 3].iter().map(|c| *c > 127).collect::<Vec<_>>()[..] {
            [true, false, false] => 'r',
            [false, true, false] => 'g',
            [false, false, true] => 'b',
            [true, true, true] => 'w',
            _ => '?',
        }
    };
    [[0, 0], [w - 1, 0], [0, h - 1], [w - 1, h - 1]].map(name).iter().collect()
}

/// Returns a picture of 32 x 16 texels with these corners.
fn quarters() -> image::RgbImage {
    ImageBuffer::from_fn(32, 16, |x, y| match (x < 16, y < 8) {
        (true, true) => Rgb([255, 0, 0]),
        (false, true) => Rgb([0, 255, 0]),
        (true, false) => Rgb([0, 0, 255]),
        (false, false) => Rgb([255, 255, 255]),
    })
}

/// Returns EXIF data with an orientation, as TIFF of either byte order.
fn exif(orientation: u16, big_end_first: bool) -> Vec<u8> {
    let short = |n: u16| if big_end_first { n.to_be_bytes() } else { n.to_le_bytes() };
    let long = |n: u32| if big_end_first { n.to_be_bytes() } else { n.to_le_bytes() };
    let head = if big_end_first { *b"MM" } else { *b"II" };
    let tag = [&short(0x112)[..], &short(3), &long(1), &short(orientation), &short(0)].concat();
    [&head[..], &short(42), &long(8), &short(1), &tag, &long(0)].concat()
}

fn encoded(format: ImageFormat) -> Vec<u8> {
    let mut bytes = Cursor::new(Vec::new());
    quarters().write_to(&mut bytes, format).unwrap();
    bytes.into_inner()
}

/// Returns a JPEG with an APP1 segment after its first marker.
fn jpeg_with(segment: &[u8]) -> Vec<u8> {
    let plain = encoded(ImageFormat::Jpeg);
    let length = (segment.len() as u16 + 2).to_be_bytes();
    [&plain[..2], b"\xff\xe1", &length, segment, &plain[2..]].concat()
}

fn png_with(exif: &[u8]) -> Vec<u8> {
    let plain = encoded(ImageFormat::Png);
    let chunk = [b"eXIf", exif].concat();
    let length = (exif.len() as u32).to_be_bytes();
    [&plain[..33], &length, &chunk, &crc32(&chunk).to_be_bytes(), &plain[33..]].concat()
}

/// Chromium 156 uploads each format to a texture of WebGL 2 like this.
#[test]
fn exif_orientation_is_applied_as_in_browsers() {
    let dir = tempfile::tempdir().unwrap();
    let read = |name: &str, bytes: Vec<u8>| {
        let path = dir.path().join(name);
        std::fs::write(&path, bytes).unwrap();
        let texels = load_file(&path, false).unwrap_or_else(|e| panic!("{name}: {e}"));
        assert_eq!(corners(&load_file(&path, true).unwrap()), {
            let c = corners(&texels);
            format!("{}{}", &c[2..], &c[..2])
        });
        (texels.shape.width, texels.shape.height, corners(&texels))
    };
    let as_stored = (32, 16, "rgbw".to_owned());
    let turned = ["rgbw", "grwb", "wbgr", "bwrg", "rbgw", "brwg", "wgbr", "gwrb"];
    for (orientation, corners) in (1..).zip(turned) {
        let size = if orientation < 5 { (32, 16) } else { (16, 32) };
        let expected = (size.0, size.1, corners.to_owned());
        for big in [false, true] {
            let exif = exif(orientation, big);
            assert_eq!(read("a.jpg", jpeg_with(&[b"Exif\0\0", &exif[..]].concat())), expected, "JPEG {orientation}");
            assert_eq!(read("a.png", png_with(&exif)), expected, "PNG {orientation}");
            let mut webp = Vec::new();
            let mut encoder = image::codecs::webp::WebPEncoder::new_lossless(&mut webp);
            image::ImageEncoder::set_exif_metadata(&mut encoder, exif).unwrap();
            encoder.encode(&quarters(), 32, 16, image::ExtendedColorType::Rgb8).unwrap();
            assert_eq!(read("a.webp", webp), as_stored, "WebP {orientation}");
        }
    }
    // Segments that are ignored: no orientation, an invalid one, a truncated one, other data.
    for segment in [
        &b"Exif\0\0"[..],
        &[b"Exif\0\0", &exif(9, true)[..]].concat(),
        &b"Exif\0\0II*\0\x08\0\0\0\x01\0\x12"[..],
        b"http://ns.adobe.com/xap/1.0/\0<x/>",
    ] {
        assert_eq!(read("a.jpg", jpeg_with(segment)), as_stored);
    }
    assert_eq!(read("a.png", png_with(&exif(0, false))), as_stored);
    // The content decides, not the extension.
    assert_eq!(read("a.gif", jpeg_with(&[b"Exif\0\0", &exif(3, true)[..]].concat())).2, "wbgr");
}

#[test]
fn radiance_pictures_of_every_orientation_are_upright() {
    let dir = tempfile::tempdir().unwrap();
    let path = dir.path().join("a.hdr");
    let read = |bytes: &[u8]| {
        std::fs::write(&path, bytes).unwrap();
        load_file(&path, false)
    };
    // Red of upright texel (x, y), from the top, is 10 y + x.
    let (width, height) = (3usize, 2usize);
    for (axes, place) in [
        ("-Y 2 +X 3", (&|line, along| [along, line]) as &dyn Fn(usize, usize) -> [usize; 2]),
        ("-Y 2 -X 3", &|line, along| [2 - along, line]),
        ("+Y 2 +X 3", &|line, along| [along, 1 - line]),
        ("+Y 2 -X 3", &|line, along| [2 - along, 1 - line]),
        ("+X 3 -Y 2", &|line, along| [line, along]),
        ("-X 3 -Y 2", &|line, along| [2 - line, along]),
        ("+X 3 +Y 2", &|line, along| [line, 1 - along]),
        ("-X 3 +Y 2", &|line, along| [2 - line, 1 - along]),
    ] {
        let (lines, texels) = if axes.as_bytes()[1] == b'Y' { (height, width) } else { (width, height) };
        let mut bytes = format!("#?RGBE\n# made by a test\nEXPOSURE=2 and more\n\n{axes}\n").into_bytes();
        for (line, along) in (0..lines).flat_map(|line| (0..texels).map(move |along| (line, along))) {
            let [x, y] = place(line, along);
            bytes.extend([(10 * y + x) as u8, 64, 0, 128 + 8]);
        }
        let texels = read(&bytes).unwrap_or_else(|e| panic!("{axes}: {e}"));
        assert_eq!((texels.shape.width, texels.shape.height), (3, 2), "{axes}");
        let numbers: Vec<f32> = bytemuck::pod_collect_to_vec(&texels.bytes);
        let reds: Vec<f32> = numbers.iter().copied().step_by(4).collect();
        assert_eq!(reds, [0.0, 1.0, 2.0, 10.0, 11.0, 12.0], "{axes}");
        assert_eq!(numbers[1..4], [64.0, 0.0, 1.0], "{axes}");
    }
    // The three encodings of a scanline: texels, runs of texels, and runs of each component.
    let head = "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 1 +X 8\n".as_bytes();
    let flat = [1, 2, 3, 136].repeat(8);
    let old = [1, 2, 3, 136, 1, 1, 1, 7];
    let new = [2, 2, 0, 8, 136, 1, 136, 2, 136, 3, 136, 136];
    let first = read(&[head, &flat].concat()).unwrap();
    assert!(first.bytes == read(&[head, &old].concat()).unwrap().bytes);
    assert!(first.bytes == read(&[head, &new].concat()).unwrap().bytes);
    let xyz = read(b"#?RADIANCE\nFORMAT=32-bit_rle_xyze\n\n-Y 1 +X 1\n\0\0\0\0").unwrap_err();
    assert!(xyz.to_string().ends_with("a.hdr: its colours are CIE XYZ, and Eddy reads RGB: ra_xyze -r converts them"));
    let long = read(b"#?RGBE\n\n+X 40000 +Y 1\n").unwrap_err().to_string();
    assert!(long.contains("the limit per side is 32768"), "{long}");
}

#[test]
fn errors_name_the_unsupported_format() {
    let dir = tempfile::tempdir().unwrap();
    for (name, bytes, kind) in [
        ("a.tif", &b"II*\0\x08\0\0\0"[..], "TIFF"),
        ("a.png", b"8BPS\0\x01", "PSD"),
        ("a", b"<svg xmlns='http://www.w3.org/2000/svg'/>", "SVG"),
        ("a.AVIF", b"\0\0\0\x1cftypavif\0\0\0\0", "AVIF"),
    ] {
        let path = dir.path().join(name);
        std::fs::write(&path, bytes).unwrap();
        let error = load_file(&path, true).unwrap_err();
        let says = format!("{name} is a {kind} image, which is not supported; supported are PNG, JPEG");
        assert!(error.to_string().contains(&says) && error.hint().contains("PNG"), "{error}");
    }
}

#[test]
fn the_first_frame_of_an_animation_is_loaded() {
    let dir = tempfile::tempdir().unwrap();
    let path = dir.path().join("a.png");
    let chunk = |kind: &[u8; 4], data: &[u8]| {
        let body = [kind, data].concat();
        [&(data.len() as u32).to_be_bytes()[..], &body, &crc32(&body).to_be_bytes()].concat()
    };
    let plain = encoded(ImageFormat::Png);
    let find = |kind: &[u8]| plain.windows(4).position(|w| w == kind).unwrap() - 4;
    let (data, end) = (find(b"IDAT"), find(b"IEND"));
    let control = chunk(b"acTL", &[0, 0, 0, 1, 0, 0, 0, 0]);
    let [w, h] = [32u32, 16].map(u32::to_be_bytes);
    let frame = chunk(b"fcTL", &[&[0; 4][..], &w, &h, &[0; 8], &[0, 1, 0, 1, 0, 0]].concat());
    // The default image as the first frame, and a frame after a separate default image, which is black.
    let whole = [&plain[..data], &control, &frame, &plain[data..]].concat();
    let mut black = Cursor::new(Vec::new());
    image::RgbImage::new(32, 16).write_to(&mut black, ImageFormat::Png).unwrap();
    let black = black.into_inner();
    let end_chunk = black.len() - 12;
    let first_data = &plain[data + 8..end - 4];
    let moved = chunk(b"fdAT", &[&1u32.to_be_bytes()[..], first_data].concat());
    let other = [&black[..33], &control, &black[33..end_chunk], &frame, &moved, &black[end_chunk..]].concat();
    for bytes in [whole, other] {
        std::fs::write(&path, bytes).unwrap();
        assert_eq!(corners(&load_file(&path, false).unwrap()), "rgbw");
    }
    let mut gif = Vec::new();
    let mut encoder = image::codecs::gif::GifEncoder::new(&mut gif);
    for picture in [quarters(), image::RgbImage::new(32, 16)] {
        encoder.encode_frame(image::Frame::new(DynamicImage::from(picture).into_rgba8())).unwrap();
    }
    drop(encoder);
    std::fs::write(&path, gif).unwrap();
    assert_eq!(corners(&load_file(&path, false).unwrap()), "rgbw");
}

#[test]
fn a_cubemap_is_six_files_or_one() {
    let dir = tempfile::tempdir().unwrap();
    let cube = |name: &str, vflip| {
        let key = MediaKey { media: Media::File(name.into()), dimension: Dimension::Cube, vflip };
        load(&key, Some(dir.path()), None)
    };
    let save = |name: &str, width, height, value: u8| {
        let image = ImageBuffer::from_pixel(width, height, Rgba([value, 0, 0, 255]));
        image.save(dir.path().join(name)).unwrap();
    };
    save("sky.png", 4, 4, 10);
    for n in 1..6u8 {
        let error = cube("sky.png", false).unwrap_err().to_string();
        assert!(n == 1 || error.contains(&format!("sky_{n}.png")), "{error}");
        save(&format!("sky_{n}.png"), 4, 4, 10 + n);
    }
    let faces = |cube: Texels| cube.bytes.chunks_exact(64).map(|face| face[0]).collect::<Vec<_>>();
    assert_eq!(faces(cube("sky.png", false).unwrap()), [10, 11, 12, 13, 14, 15]);
    assert_eq!(faces(cube("sky.png", true).unwrap()), [10, 11, 13, 12, 14, 15]);
    save("sky_3.png", 8, 8, 0);
    assert!(cube("sky.png", false).unwrap_err().to_string().contains("face -y has 8x8"));
    save("cross.png", 16, 12, 7);
    let cross = cube("cross.png", false).unwrap();
    assert_eq!((cross.shape.dimension, cross.shape.width), (Dimension::Cube, 4));
    save("wide.png", 15, 4, 7);
    assert!(cube("wide.png", false).unwrap_err().hint().contains("cross"));
}

#[test]
fn volumes_of_shadertoy_are_loaded() {
    let dir = tempfile::tempdir().unwrap();
    let mut file = b"BIN\0\x02\0\0\0\x01\0\0\0\x01\0\0\0\x01\0\0\0".to_vec();
    file.extend([5, 6]);
    std::fs::write(dir.path().join("v.bin"), file).unwrap();
    let volume = |name: &str| {
        let key = MediaKey { media: Media::File(name.into()), dimension: Dimension::D3, vflip: false };
        load(&key, Some(dir.path()), None)
    };
    assert_eq!(volume("v.bin").unwrap().bytes, [5, 6]);
    std::fs::write(dir.path().join("w.bin"), b"BIN").unwrap();
    let error = volume("w.bin").unwrap_err();
    assert!(error.to_string().contains("within its header") && error.hint().contains("20 bytes"), "{error}");
}

#[test]
fn a_stack_of_pictures_is_a_volume() {
    let dir = tempfile::tempdir().unwrap();
    for n in 8..12u8 {
        let image = ImageBuffer::from_pixel(2, 1, Rgba([n, 0, 0, 255]));
        image.save(dir.path().join(format!("brain_{n:03}.png"))).unwrap();
    }
    let key = MediaKey { media: Media::File("brain_009.png".into()), dimension: Dimension::D3, vflip: false };
    let volume = load(&key, Some(dir.path()), None).unwrap();
    assert_eq!(volume.shape.level(0), [2, 1, 3]);
    assert_eq!(volume.bytes.chunks_exact(8).map(|slice| slice[0]).collect::<Vec<_>>(), [9, 10, 11]);
}
