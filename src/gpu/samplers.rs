//! The set of all samplers.

use super::Gpu;

/// The filtering of texels.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Filtering {
    Nearest,
    /// Bilinear in level 0; other levels are never read.
    Linear,
    /// Bilinear, and interpolated between levels.
    Trilinear,
    /// The nearest texel of the requested level.
    NearestOfLevel,
}

/// The addressing of texels beyond the edge.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Address {
    Clamp,
    Repeat,
}

/// Every sampler that a pass can use.
#[derive(Clone, Debug)]
pub struct Samplers([wgpu::Sampler; 8]);

impl Samplers {
    pub fn new(gpu: &Gpu) -> Self {
        let make = |filtering: Filtering, address: Address| {
            let mode = match filtering {
                Filtering::Nearest | Filtering::NearestOfLevel => wgpu::FilterMode::Nearest,
                Filtering::Linear | Filtering::Trilinear => wgpu::FilterMode::Linear,
            };
            let address = match address {
                Address::Clamp => wgpu::AddressMode::ClampToEdge,
                Address::Repeat => wgpu::AddressMode::Repeat,
            };
            let trilinear = filtering == Filtering::Trilinear;
            gpu.device.create_sampler(&wgpu::SamplerDescriptor {
                label: Some(&format!("{filtering:?} {address:?}")),
                address_mode_u: address,
                address_mode_v: address,
                address_mode_w: address,
                mag_filter: mode,
                min_filter: mode,
                mipmap_filter: if trilinear { wgpu::MipmapFilterMode::Linear } else { wgpu::MipmapFilterMode::Nearest },
                lod_min_clamp: 0.0,
                // A GL minification filter without MIPMAP in its name reads level 0, whatever level is requested.
                lod_max_clamp: match filtering {
                    Filtering::Nearest | Filtering::Linear => 0.0,
                    Filtering::Trilinear | Filtering::NearestOfLevel => 32.0,
                },
                ..Default::default()
            })
        };
        use {Address::*, Filtering::*};
        Self([
            make(Nearest, Clamp),
            make(Nearest, Repeat),
            make(Linear, Clamp),
            make(Linear, Repeat),
            make(Trilinear, Clamp),
            make(Trilinear, Repeat),
            make(NearestOfLevel, Clamp),
            make(NearestOfLevel, Repeat),
        ])
    }

    pub fn get(&self, filtering: Filtering, address: Address) -> &wgpu::Sampler {
        &self.0[filtering as usize * 2 + address as usize]
    }
}
