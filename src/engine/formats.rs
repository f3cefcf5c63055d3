//! The words of a project in those of the graphics layer.

use eddy_project::{Cull, DepthTest, PassFormat};

pub(super) fn texture_format(format: PassFormat) -> wgpu::TextureFormat {
    use wgpu::TextureFormat as T;
    match format {
        PassFormat::R8 => T::R8Unorm,
        PassFormat::Rg8 => T::Rg8Unorm,
        PassFormat::Rgba8 => T::Rgba8Unorm,
        PassFormat::R16f => T::R16Float,
        PassFormat::Rg16f => T::Rg16Float,
        PassFormat::Rgba16f => T::Rgba16Float,
        PassFormat::R32f => T::R32Float,
        PassFormat::Rg32f => T::Rg32Float,
        PassFormat::Rgba32f => T::Rgba32Float,
    }
}

pub(super) fn cull_mode(cull: Cull) -> Option<wgpu::Face> {
    match cull {
        Cull::Back => Some(wgpu::Face::Back),
        Cull::Front => Some(wgpu::Face::Front),
        Cull::None => None,
    }
}

pub(super) fn compare_function(test: DepthTest) -> wgpu::CompareFunction {
    use wgpu::CompareFunction as C;
    match test {
        DepthTest::Less => C::Less,
        DepthTest::LessEqual => C::LessEqual,
        DepthTest::Equal => C::Equal,
        DepthTest::GreaterEqual => C::GreaterEqual,
        DepthTest::Greater => C::Greater,
        DepthTest::NotEqual => C::NotEqual,
        DepthTest::Always => C::Always,
    }
}
