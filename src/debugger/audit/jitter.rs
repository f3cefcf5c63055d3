//! Measures how much a value changes with different roundings: Monte Carlo arithmetic (Stott Parker, "Monte Carlo
//! Arithmetic", 1997), where the perturbed numbers also decide control flow.

use super::run::walk;
use crate::{
    fragment::{PassFragments, PixelContent},
    trace::TraceError,
};
use eddy_engine::{PassInputs, Sources};
use eddy_glsl::{
    ir::{FuncId, Math, Module, Op, Value},
    walk::{Cell, Observer, Shadowed},
    walkable::Detail,
};

/// The error in ULPs that Vulkan allows for an arc tangent ("Precision and Operation of SPIR-V Instructions"), by which
/// it defines the arc sine and cosine; drivers make use of it.
const ARC_TANGENT_ULPS: i32 = 4096;

/// Randomly changes the last bit of each rounded result.
struct Jitter<'m> {
    program: &'m Module,
    state: u64,
}

impl Jitter<'_> {
    /// Returns -1, 0 or 1, by `SplitMix64`.
    fn random_step(&mut self) -> i32 {
        self.state = self.state.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let x = (self.state ^ (self.state >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        let x = (x ^ (x >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        ((x ^ (x >> 31)) % 3) as i32 - 1
    }
}

impl Observer<Shadowed> for Jitter<'_> {
    fn correct(&mut self, function: FuncId, value: Value, cells: &mut [Cell<Shadowed>]) {
        let by = match self.program[function][value] {
            Op::Math { fun: Math::Asin | Math::Acos | Math::Atan | Math::Atan2, .. } => ARC_TANGENT_ULPS,
            _ => 1,
        };
        for cell in cells {
            if let Cell::Float(x) = cell
                && x.single.is_normal()
                && f64::from(x.single) != x.double
            {
                // A value without rounding, for example a whole number, is the same on every device.
                x.single = f32::from_bits(x.single.to_bits().wrapping_add_signed(by * self.random_step()));
            }
        }
    }
}

/// Walks `project.passes[index]` for a pixel with the last bits of all rounded results perturbed at random, seeded by
/// `seed`.
pub fn add_jitter(
    sources: &Sources<'_>,
    index: usize,
    inputs: &PassInputs,
    pixel: (u32, u32),
    (limit, seed): (u64, u64),
) -> Result<[f32; 4], TraceError> {
    let pass = PassFragments::new(sources, index, inputs, Detail::Values, limit)?;
    let PixelContent::Fragment(at) = pass.at(pixel)? else { return Ok([0.0; 4]) };
    let mut jitter = Jitter { program: &at.walkable.program, state: seed };
    Ok(walk(&at, &mut jitter)?.map(|x| x.single))
}
