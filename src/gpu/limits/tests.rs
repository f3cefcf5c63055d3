use super::*;
use crate::{Texture, TextureDescriptor, testing};
use eddy_texture::{Dimension, TexelFormat, TextureShape};

#[test]
fn bytes_of_targets_are_counted_by_the_rules_of_webgpu() {
    use wgpu::TextureFormat as F;
    assert_eq!(bytes_per_sample(&[F::Rgba32Float; 4]), 64);
    // Eight bits per component count twice.
    assert_eq!(bytes_per_sample(&[F::Rgba8Unorm; 4]), 32);
    // The byte is rounded up for the alignment of the next format.
    assert_eq!(bytes_per_sample(&[F::R8Unorm, F::R32Float]), 8);
}

#[test]
fn limits_are_checked_before_anything_is_created() {
    let Some(gpu) = testing::weak_gpu() else { return };
    let error = |made: Result<(), GpuError>| made.unwrap_err().to_string();
    let texture =
        |shape| Texture::new(&gpu, &TextureDescriptor { label: "a picture", shape, is_target: false }).map(drop);
    let flat = TextureShape::flat(5_000, 16, TexelFormat::R8);
    let volume = TextureShape { width: 8, height: 8, depth: 300, dimension: Dimension::D3, ..flat };
    assert_eq!(error(texture(flat)), "a picture of 5000x16 pixels: this device draws at most 4096x4096");
    assert_eq!(error(texture(volume)), "a picture of 8x8x300 voxels: this device has volumes of at most 256x256x256");
    let float = wgpu::TextureFormat::Rgba32Float;
    assert!(check_targets(&gpu, "Buffer A", &[float; 2]).is_ok());
    let targets = error(check_targets(&gpu, "Buffer A", &[float; 3]));
    assert!(targets.contains("Buffer A take 48 bytes per texel") && targets.contains("at most 32"), "{targets}");
    let group = |binding, count| [(0..count).map(|n| (n, binding)).collect::<Vec<_>>()];
    let picture = Binding::Texture { dimension: wgpu::TextureViewDimension::D2, filterable: true };
    assert!(check_bindings(&gpu, "Image", &group(picture, 16)).is_ok());
    let textures = error(check_bindings(&gpu, "Image", &group(picture, 17)));
    assert_eq!(textures, "Image has 17 textures, but this device allows 16 at once");
    let bytes = error(check_bindings(&gpu, "Image", &group(Binding::Uniform { bytes: 16_400 }, 1)));
    assert!(bytes.contains("16400 bytes") && bytes.contains("16384"), "{bytes}");
}
