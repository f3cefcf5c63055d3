use super::*;
use image_dds::ddsfile::{AlphaMode, D3D10ResourceDimension, DxgiFormat, NewDxgiParams};

/// Returns a KTX2 file with one level.
fn ktx2(format: Format, [width, height, depth]: [u32; 3], faces: u32, packed: u32, level: &[u8]) -> Vec<u8> {
    let mut file = b"\xabKTX 20\xbb\r\n\x1a\n".to_vec();
    for field in [format.value(), 1, width, height, depth, 0, faces, 1, packed] {
        file.extend(field.to_le_bytes());
    }
    let descriptor = 104u64;
    // A descriptor of 4 bytes, no keys, no global data.
    for field in [descriptor as u32, 4, 0, 0] {
        file.extend(field.to_le_bytes());
    }
    file.extend([0; 16]);
    for field in [descriptor + 4, level.len() as u64, level.len() as u64] {
        file.extend(field.to_le_bytes());
    }
    file.extend(4u32.to_le_bytes());
    file.extend(level);
    file
}

fn dds(format: DxgiFormat, [width, height, depth]: [u32; 3], is_cube: bool, data: &[u8]) -> Vec<u8> {
    let mut dds = Dds::new_dxgi(NewDxgiParams {
        width,
        height,
        depth: (depth > 0).then_some(depth),
        format,
        mipmap_levels: None,
        array_layers: is_cube.then_some(6),
        caps2: is_cube.then_some(Caps2::CUBEMAP | Caps2::CUBEMAP_ALLFACES),
        is_cubemap: is_cube,
        resource_dimension: if depth > 0 {
            D3D10ResourceDimension::Texture3D
        } else {
            D3D10ResourceDimension::Texture2D
        },
        alpha_mode: AlphaMode::Straight,
    })
    .unwrap();
    dds.data = data.to_vec();
    let mut file = Vec::new();
    dds.write(&mut file).unwrap();
    file
}

fn read_as(bytes: &[u8], dimension: Dimension) -> Result<Texels, String> {
    assert!(kind(bytes).is_some());
    read(bytes, dimension, false, 1 << 20)
}

#[test]
fn pictures_cubemaps_and_volumes_come_from_both_kinds_of_files() {
    let numbers: Vec<u8> = (0..24).collect();
    let grey = |dimension| match dimension {
        Dimension::D2 => {
            [ktx2(Format::R8_UNORM, [4, 6, 0], 1, 0, &numbers), dds(DxgiFormat::R8_UNorm, [4, 6, 0], false, &numbers)]
        }
        Dimension::Cube => {
            [ktx2(Format::R8_UNORM, [2, 2, 0], 6, 0, &numbers), dds(DxgiFormat::R8_UNorm, [2, 2, 0], true, &numbers)]
        }
        Dimension::D3 => {
            [ktx2(Format::R8_UNORM, [2, 3, 4], 1, 0, &numbers), dds(DxgiFormat::R8_UNorm, [2, 3, 4], false, &numbers)]
        }
    };
    for (dimension, level) in [(Dimension::D2, [4, 6, 1]), (Dimension::Cube, [2, 2, 1]), (Dimension::D3, [2, 3, 4])] {
        for (n, file) in grey(dimension).iter().enumerate() {
            let texels = read_as(file, dimension).unwrap_or_else(|error| panic!("{dimension:?} {n}: {error}"));
            assert_eq!((texels.shape.dimension, texels.shape.level(0)), (dimension, level), "{n}");
            assert_eq!((texels.shape.format, &texels.bytes), (TexelFormat::R8, &numbers), "{dimension:?} {n}");
        }
    }
    let flipped = read(&grey(Dimension::D2)[0], Dimension::D2, true, 1 << 20).unwrap();
    assert_eq!(flipped.bytes[..4], [20, 21, 22, 23]);
}

#[test]
fn channels_keep_their_order_and_floats_their_values() {
    let of = |format, level: &[u8]| read_as(&ktx2(format, [1, 1, 0], 1, 0, level), Dimension::D2).unwrap();
    assert_eq!(of(Format::R8G8B8_SRGB, &[1, 2, 3]).bytes, [1, 2, 3, 255]);
    assert_eq!(of(Format::B8G8R8A8_UNORM, &[1, 2, 3, 4]).bytes, [3, 2, 1, 4]);
    let float = of(Format::R32G32B32A32_SFLOAT, bytemuck::cast_slice(&[1f32, -2.5, 1e6, 0.0]));
    assert_eq!(bytemuck::pod_collect_to_vec::<u8, f32>(&float.bytes), [1.0, -2.5, 1e6, 0.0]);
    let grey = of(Format::R16_UNORM, &[0xff, 0x7f]);
    let grey: Vec<f32> = bytemuck::pod_collect_to_vec(&grey.bytes);
    assert_eq!((grey[0], grey[1], grey[2], grey[3]), (32767.0 / 65535.0, 0.0, 0.0, 1.0));
}

/// Blocks by hand (Khronos Data Format Specification 1.3, chapter 18): both colours of BC1 are equal, BC4 has one
/// value, and all indices are 0.
#[test]
fn blocks_are_decoded() {
    let bc1 = [0x00, 0xf8, 0x00, 0xf8, 0, 0, 0, 0];
    for file in
        [ktx2(Format::BC1_RGB_UNORM_BLOCK, [4, 4, 0], 1, 0, &bc1), dds(DxgiFormat::BC1_UNorm, [4, 4, 0], false, &bc1)]
    {
        let texels = read_as(&file, Dimension::D2).unwrap();
        assert_eq!((texels.shape.format, texels.bytes), (TexelFormat::Rgba8, [255, 0, 0, 255].repeat(16)));
    }
    let bc4 = [77, 77, 0, 0, 0, 0, 0, 0];
    let texels = read_as(&ktx2(Format::BC4_UNORM_BLOCK, [4, 4, 0], 1, 0, &bc4), Dimension::D2).unwrap();
    assert_eq!((texels.shape.format, texels.bytes), (TexelFormat::R8, vec![77; 16]));
}

#[test]
fn compressed_levels_are_decompressed() {
    let level = vec![9u8; 64 * 64];
    let packed = ruzstd::encoding::compress_to_vec(&*level, ruzstd::encoding::CompressionLevel::Fastest);
    assert!(packed.len() < 100);
    let texels = read_as(&ktx2(Format::R8_UNORM, [64, 64, 0], 1, 2, &packed), Dimension::D2).unwrap();
    assert_eq!(texels.bytes, level);
    let short = read_as(&ktx2(Format::R8_UNORM, [64, 65, 0], 1, 2, &packed), Dimension::D2).unwrap_err();
    assert!(short.contains("4160 bytes, and has 4096"), "{short}");
}

#[test]
fn unsupported_files_have_specific_errors() {
    let red = [1u8; 24];
    for (file, dimension, says) in [
        (ktx2(Format::R8_UNORM, [2, 2, 0], 6, 0, &red), Dimension::D2, "kind = \"cubemap\""),
        (ktx2(Format::R8_UNORM, [2, 3, 4], 1, 0, &red), Dimension::D2, "kind = \"volume\""),
        (ktx2(Format::R8_UNORM, [2, 2, 0], 6, 0, &red[..20]), Dimension::Cube, "24 bytes, and has 20"),
        (ktx2(Format::R8_UNORM, [2, 2, 0], 1, 3, &red), Dimension::D2, "ZLIB"),
        (ktx2(Format::ASTC_4x4_UNORM_BLOCK, [4, 4, 0], 1, 0, &red), Dimension::D2, "ASTC_4x4"),
        (ktx2(Format::R8_UNORM, [1 << 20, 2, 0], 1, 0, &red), Dimension::D2, "limit per side"),
        (ktx2(Format::R8_UNORM, [4096, 4096, 0], 1, 0, &red), Dimension::D2, "too much"),
        (ktx2(Format::R8_UNORM, [0, 2, 0], 1, 0, &red), Dimension::D2, "zero pixel width"),
        (dds(DxgiFormat::R8_UNorm, [2, 2, 0], true, &red[..20]), Dimension::Cube, "ends before layer 5"),
        (dds(DxgiFormat::NV12, [2, 2, 0], false, &red), Dimension::D2, "NV12"),
        (b"DDS ".to_vec(), Dimension::D2, "damaged"),
        (KTX2.to_vec(), Dimension::D2, "damaged"),
    ] {
        let error = read_as(&file, dimension).unwrap_err();
        assert!(error.contains(says), "{error}");
    }
}

/// Truncated files and files with changed bytes result in texels or an error.
#[test]
fn damaged_files_do_not_panic() {
    let numbers: Vec<u8> = (0..96).collect();
    let files = [
        ktx2(Format::R8G8B8A8_UNORM, [2, 2, 0], 6, 0, &numbers),
        ktx2(Format::BC7_UNORM_BLOCK, [8, 8, 0], 1, 0, &numbers),
        dds(DxgiFormat::R8G8B8A8_UNorm, [2, 3, 4], false, &numbers),
        dds(DxgiFormat::BC3_UNorm, [8, 8, 0], false, &numbers),
    ];
    let mut state = 1u64;
    let mut random = || {
        state = state.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407);
        (state >> 33) as usize
    };
    for file in &files {
        for n in 0..500 {
            let mut file = file.clone();
            if n < file.len() {
                file.truncate(n);
            } else {
                for _ in 0..1 + random() % 4 {
                    let at = random() % file.len();
                    file[at] = random() as u8;
                }
            }
            for dimension in [Dimension::D2, Dimension::Cube, Dimension::D3] {
                let _ = read(&file, dimension, true, 1 << 20);
            }
        }
    }
}

/// Returns a DDS file of Direct3D 9: flags, bits per texel and the masks of its channels.
fn dds9(
    [width, height]: [u32; 2],
    flags: u32,
    bits: u32,
    masks: [u32; 4],
    levels: u32,
    caps2: u32,
    data: &[u8],
) -> Vec<u8> {
    let mut fields = vec![124, 0x2_1007, height, width, 0, 0, levels];
    fields.extend([0; 11]);
    fields.extend([32, flags, 0, bits]);
    fields.extend(masks);
    fields.extend([0x1000, caps2, 0, 0, 0]);
    let mut file = b"DDS ".to_vec();
    file.extend(fields.iter().flat_map(|field| field.to_le_bytes()));
    file.extend(data);
    file
}

#[test]
fn dds_bit_masks_are_decoded() {
    const LUMINANCE: u32 = 0x2_0000;
    let read = |flags, bits, masks, data: &[u8]| {
        let texels = read_as(&dds9([2, 1], flags, bits, masks, 1, 0, data), Dimension::D2).unwrap();
        (texels.shape.format, texels.bytes)
    };
    let rgba8 = |bytes: [u8; 8]| (TexelFormat::Rgba8, bytes.to_vec());
    assert_eq!(read(LUMINANCE, 8, [0xff, 0, 0, 0], &[7, 250]), rgba8([7, 7, 7, 255, 250, 250, 250, 255]));
    assert_eq!(read(LUMINANCE | 1, 16, [0xff, 0, 0, 0xff00], &[7, 9, 250, 4]), rgba8([7, 7, 7, 9, 250, 250, 250, 4]));
    assert_eq!(read(LUMINANCE | 1, 8, [0xf, 0, 0, 0xf0], &[0x31, 0xf8]), rgba8([17, 17, 17, 51, 136, 136, 136, 255]));
    assert_eq!(read(2, 8, [0, 0, 0, 0xff], &[7, 250]), rgba8([0, 0, 0, 7, 0, 0, 0, 250]));
    assert_eq!(read(0x40, 16, [0xf800, 0x7e0, 0x1f, 0], &[0, 0xf8, 0xe0, 7]), rgba8([255, 0, 0, 255, 0, 255, 0, 255]));
    assert_eq!(read(0x40, 8, [0xe0, 0x1c, 3, 0], &[0xe0, 3]), rgba8([255, 0, 0, 255, 0, 0, 255, 255]));
    // 16 bits of luminance do not fit into a byte.
    let (format, bytes) = read(LUMINANCE, 16, [0xffff, 0, 0, 0], &[0xff, 0xff, 0, 0x80]);
    let floats: Vec<f32> = bytes.chunks_exact(4).map(|b| f32::from_le_bytes(b.try_into().unwrap())).collect();
    assert_eq!((format, floats[0], floats[3]), (TexelFormat::Rgba32f, 1.0, 1.0));
    assert!((floats[4] - 32768.0 / 65535.0).abs() < 1e-6, "{floats:?}");
    // Each face of a cubemap is followed by its mip levels.
    let data: Vec<u8> = (0..6).flat_map(|face| [face, face, face, face, 99]).collect();
    let cube = dds9([2, 2], LUMINANCE, 8, [0xff, 0, 0, 0], 2, 0xfe00, &data);
    let texels = read_as(&cube, Dimension::Cube).unwrap();
    let faces: Vec<u8> = texels.bytes.chunks_exact(16).map(|face| face[0]).collect();
    assert_eq!(faces, [0, 1, 2, 3, 4, 5]);
    for cut in [0, 1, 127, 128, 130, cube.len() - 5] {
        assert!(super::read(&cube[..cut], Dimension::Cube, false, 1 << 20).is_err(), "{cut}");
    }
    // More levels than possible.
    let many = dds9([2, 2], 0x41, 32, [0xff, 0xff00, 0xff_0000, 0xff00_0000], u32::MAX, 0, &[7; 20]);
    assert_eq!(read_as(&many, Dimension::D2).unwrap().bytes, [7; 16]);
    let wide = dds9([16384, 16384], LUMINANCE, 8, [0xff, 0, 0, 0], 1, 0, &[]);
    assert!(read_as(&wide, Dimension::D2).unwrap_err().contains("too much"));
}
