use super::*;
use image::{ImageBuffer, Luma, Rgb, Rgba};

fn load_file(path: &Path, vflip: bool) -> Result<Texels, MediaError> {
    load(&Media::File(path.file_name().unwrap().into()), vflip, path.parent(), None)
}

#[test]
fn vflip_puts_the_top_row_at_v_one_and_no_value_is_changed() {
    let dir = tempfile::tempdir().unwrap();
    let path = dir.path().join("a.png");
    let pixels = vec![1, 2, 3, 4, 128, 129, 130, 0, 250, 251, 252, 253, 9, 8, 7, 6];
    ImageBuffer::<Rgba<u8>, _>::from_raw(2, 2, pixels.clone()).unwrap().save(&path).unwrap();
    let plain = load_file(&path, false).unwrap();
    assert_eq!((plain.width, plain.height, plain.format), (2, 2, TexelFormat::Rgba8));
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
    assert_eq!(texels.format, TexelFormat::Rgba32Float);
    assert_eq!(bytemuck::pod_collect_to_vec::<u8, f32>(&texels.bytes), [4.0, 0.5, 0.25, 1.0]);
}

#[test]
fn broken_pictures_are_clear_errors() {
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
    // Width 0 and width 2^31-1 in the header, with its checksum made right.
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
        (write("empty.png", b""), "cut short"),
        (write("text.png", b"hello, this is no picture at all"), "damaged"),
        (write("notes.txt", b"hello, this is no picture at all"), "not a picture of a known kind"),
        (write("zero.png", &with_size(0, 64)), "zero.png"),
        (write("huge.png", &with_size(0x7fff_ffff, 0x7fff_ffff)), "huge.png"),
        (
            write("large.png", &with_size(20000, 20000)),
            "large.png: the picture has 20000x20000 texels, which take 1600000000 bytes; a picture may take 512 \
            MiB",
        ),
        (write("long.png", &with_size(40000, 2)), "40000x2 texels, and a side may have 32768"),
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
fn a_file_of_the_sites_name_wins_over_the_fallback_and_grey_ids_are_one_channel() {
    let dir = tempfile::tempdir().unwrap();
    let grey = Media::Site { id: "4sf3Rn".into(), path: "/media/a/0a40.png".into() };
    let fallback = load(&grey, true, None, None).unwrap();
    assert_eq!((fallback.width, fallback.height, fallback.format), (64, 64, TexelFormat::R8));
    ImageBuffer::<Rgba<u8>, _>::from_pixel(3, 1, Rgba([7u8, 2, 3, 4])).save(dir.path().join("0a40.png")).unwrap();
    let own = load(&grey, true, None, Some(dir.path())).unwrap();
    assert_eq!((own.width, own.height, own.format, own.bytes), (3, 1, TexelFormat::R8, vec![7, 7, 7]));
    let unknown = Media::Site { id: "zzz".into(), path: "/media/a/unknown.jpg".into() };
    assert!(matches!(load(&unknown, true, None, Some(dir.path())), Err(MediaError::NoStandIn { .. })));
}

#[test]
fn an_unknown_built_in_names_the_nearest() {
    let error = load(&Media::Builtin("noise-rgb-256".into()), true, None, None).unwrap_err();
    assert!(error.to_string().contains("noise-rgba-256"), "{error}");
    assert!(matches!(load(&Media::File("a.png".into()), true, None, None), Err(MediaError::NoFolder { .. })));
}
