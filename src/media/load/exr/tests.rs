//! EXR files with channels that other picture formats do not have.

use super::*;
use exr::{
    image::{AnyChannel, AnyChannels, Encoding, FlatSamples, Image, Layer},
    math::Vec2,
    meta::{
        attribute::IntegerBounds,
        header::{ImageAttributes, LayerAttributes},
    },
    prelude::WritableImage,
};
use half::f16;

/// Returns a part of 2x1 pixels at a place, with the same values in each channel's pixels.
fn part(name: &str, at: [i32; 2], channels: &[(&str, FlatSamples)]) -> Layer<AnyChannels<FlatSamples>> {
    let list = channels.iter().map(|(name, samples)| AnyChannel::new(*name, samples.clone())).collect();
    let attributes = LayerAttributes { layer_position: Vec2(at[0], at[1]), ..LayerAttributes::named(name) };
    Layer::new((2, 1), attributes, Encoding::SMALL_LOSSLESS, AnyChannels::sort(list))
}

fn file(window: IntegerBounds, parts: Vec<Layer<AnyChannels<FlatSamples>>>) -> Vec<u8> {
    let mut bytes = Cursor::new(Vec::new());
    Image::from_layers(ImageAttributes::new(window), parts).write().to_buffered(&mut bytes).unwrap();
    bytes.into_inner()
}

fn floats(values: [f32; 2]) -> FlatSamples {
    FlatSamples::F32(values.to_vec())
}

fn read_floats(bytes: &[u8]) -> Result<Vec<f32>, String> {
    assert!(is_exr(bytes));
    let texels = read(bytes, Path::new("a.exr"), 1 << 20).map_err(|error| error.to_string())?;
    assert_eq!(texels.shape.format, TexelFormat::Rgba32f);
    Ok(bytemuck::pod_collect_to_vec(&texels.bytes))
}

/// Returns the picture of a file with one part.
fn of_channels(channels: &[(&str, FlatSamples)]) -> Result<Vec<f32>, String> {
    read_floats(&file(IntegerBounds::from_dimensions((2, 1)), vec![part("a", [0, 0], channels)]))
}

#[test]
fn channels_are_chosen_by_name() {
    let [a, b, c, d] = [[0.0, 1.0], [2.0, -3.0], [0.25, 0.5], [0.0, 0.75]].map(floats);
    let halves = FlatSamples::F16([1.0, 0.5].map(f16::from_f32).to_vec());
    for (channels, right) in [
        (&[("R", &a), ("G", &b), ("B", &c)][..], [0.0, 2.0, 0.25, 1.0, 1.0, -3.0, 0.5, 1.0]),
        (&[("R", &a), ("G", &b), ("B", &c), ("A", &d)], [0.0, 2.0, 0.25, 0.0, 1.0, -3.0, 0.5, 0.75]),
        (&[("Y", &c)], [0.25, 0.25, 0.25, 1.0, 0.5, 0.5, 0.5, 1.0]),
        (&[("Y", &c), ("A", &d)], [0.25, 0.25, 0.25, 0.0, 0.5, 0.5, 0.5, 0.75]),
        (&[("R", &b)], [2.0, 0.0, 0.0, 1.0, -3.0, 0.0, 0.0, 1.0]),
        (&[("G", &a), ("Z", &b)], [0.0, 0.0, 0.0, 1.0, 0.0, 1.0, 0.0, 1.0]),
        (&[("Z", &b)], [2.0, 2.0, 2.0, 1.0, -3.0, -3.0, -3.0, 1.0]),
        (&[("depth.Z", &halves)], [1.0, 1.0, 1.0, 1.0, 0.5, 0.5, 0.5, 1.0]),
        (&[("N.X", &d), ("light.R", &a), ("light.G", &b), ("light.B", &c)], [0.0, 2.0, 0.25, 1.0, 1.0, -3.0, 0.5, 1.0]),
        // The layer without a name is the picture, regardless of the order of names.
        (
            &[("R", &c), ("G", &c), ("B", &c), ("Light.R", &a), ("Light.G", &a), ("Light.B", &a)],
            [0.25, 0.25, 0.25, 1.0, 0.5, 0.5, 0.5, 1.0],
        ),
        // A layer's missing green is not taken from another layer.
        (&[("B", &a), ("x.R", &b)], [0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 1.0, 1.0]),
        (&[("x.R", &b), ("Y", &a)], [2.0, 0.0, 0.0, 1.0, -3.0, 0.0, 0.0, 1.0]),
    ] {
        let channels: Vec<(&str, FlatSamples)> = channels.iter().map(|(name, s)| (*name, (*s).clone())).collect();
        let names: Vec<&str> = channels.iter().map(|(name, _)| *name).collect();
        assert_eq!(of_channels(&channels), Ok(right.to_vec()), "{names:?}");
    }
    let whole = FlatSamples::U32(vec![3, 7]);
    assert_eq!(of_channels(&[("id", whole)]), Ok(vec![3.0, 3.0, 3.0, 1.0, 7.0, 7.0, 7.0, 1.0]));
}

#[test]
fn the_first_part_with_a_picture_is_read() {
    let bounds = IntegerBounds::from_dimensions((2, 1));
    let [a, b] = [[0.5, 1.0], [2.0, 3.0]].map(floats);
    let depth = part("depth", [0, 0], &[("Z", a.clone())]);
    let red = part("red", [0, 0], &[("R", a.clone())]);
    let color = part("color", [0, 0], &[("R", b.clone()), ("G", a.clone()), ("B", b.clone())]);
    let right = Ok(vec![2.0, 0.5, 2.0, 1.0, 3.0, 1.0, 3.0, 1.0]);
    assert_eq!(read_floats(&file(bounds, vec![depth.clone(), red.clone(), color])), right);
    assert_eq!(
        read_floats(&file(bounds, vec![depth.clone(), red])).map(|t| t[..4].to_vec()),
        Ok(vec![0.5, 0.0, 0.0, 1.0])
    );
    let motion = part("motion", [0, 0], &[("x", a), ("y", b)]);
    let why = read_floats(&file(bounds, vec![depth, motion])).unwrap_err();
    assert!(why.contains("its channels are Z, x and y"), "{why}");
}

#[test]
fn pixels_are_placed_in_the_display_window() {
    let window = IntegerBounds::new((-1, 5), (3, 2));
    let file = file(window, vec![part("a", [1, 6], &[("Y", floats([0.5, 1.0]))])]);
    let mut right = vec![0.0; 24];
    right[20..].copy_from_slice(&[0.5, 0.5, 0.5, 1.0]);
    assert_eq!(read_floats(&file), Ok(right), "the second pixel is outside");
}

#[test]
fn damaged_and_large_files_are_errors() {
    let whole = file(IntegerBounds::from_dimensions((2, 1)), vec![part("a", [0, 0], &[("Y", floats([0.5, 1.0]))])]);
    for at in MAGIC.len()..whole.len() {
        assert!(read_floats(&whole[..at]).is_err(), "cut at {at}");
        for damage in [0x01, 0x80, 0xff] {
            let mut bytes = whole.clone();
            bytes[at] ^= damage;
            // Only checks that it returns: a window may have moved, or a channel may have been renamed.
            let _ = read_floats(&bytes);
        }
    }
    let sized = |size| {
        let wide = file(IntegerBounds::new((0, 0), size), vec![part("a", [0, 0], &[("Y", floats([0.5, 1.0]))])]);
        read(&wide, Path::new("a.exr"), u64::MAX).unwrap_err().to_string()
    };
    assert!(sized((40_000, 1)).contains("40000x1 texels, and the limit per side"));
    assert!(sized((8192, 8192)).contains("8192x8192 texels, which take 1073741824 bytes"));
}
