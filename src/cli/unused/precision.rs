//! Bits of formats that the picture does not need: each pass of 32-bit floats is drawn with 16 bits instead, and the
//! pictures of all frames are compared.

use super::{Finding, Kind, is_drawn};
use crate::{
    cli::machine::RunError,
    engine::{BuildOptions, PassCost},
    gpu::Gpu,
    media::MediaSet,
    playback::{offline::Offline, script::ScriptedInputs},
    project::{PassName, Project, TexelFormat},
};

/// The largest difference of an 8-bit picture that counts as invisible: one level.
const MAX_LEVELS: u8 = 1;

/// The run that formats are tried in.
pub(super) struct Test<'a> {
    pub gpu: &'a Gpu,
    pub media: &'a MediaSet,
    pub size: (u32, u32),
    pub inputs: &'a ScriptedInputs,
    /// The picture of each frame with the formats of the project.
    pub pictures: &'a [Vec<u8>],
}

impl Test<'_> {
    /// Returns a finding for each pass whose format may have 16 bits.
    pub(super) fn find(&self, project: &Project, costs: &[PassCost]) -> Result<Vec<Finding>, RunError> {
        let mut found = Vec::new();
        for cost in costs.iter().filter(|cost| is_drawn(cost) && cost.pass != PassName::image()) {
            let [format] = cost.formats[..] else { continue };
            let Some(half) = half_of(format) else { continue };
            let mut changed = project.clone();
            let Some(pass) = changed.pass_mut(&cost.pass) else { continue };
            pass.settings.format = half;
            if pass.formats() != [half] {
                continue;
            }
            let Some(levels) = self.largest_difference(&changed)? else { continue };
            let count = self.pictures.len();
            let message = match levels {
                0 => format!("with format = \"{}\" the picture is the same in {count} frames, in 8 bits", half.name()),
                _ => format!("with format = \"{}\" the picture differs by {levels}/255 in {count} frames", half.name()),
            };
            found.push(Finding { bytes: cost.held_bytes / 2, ..Finding::of(Kind::Precision, cost, message) });
        }
        Ok(found)
    }

    /// Returns the largest difference of a component from the pictures, in levels of 255; `None` if it is visible.
    fn largest_difference(&self, project: &Project) -> Result<Option<u8>, RunError> {
        let mut offline = Offline::new(self.gpu, self.size, self.inputs.clone())?;
        offline.build(project, self.media, &BuildOptions::default())?;
        let mut largest = 0;
        for picture in self.pictures {
            offline.draw()?;
            let other = offline.read(&PassName::image(), 0)?.to_rgba8();
            if other.len() != picture.len() {
                return Ok(None);
            }
            largest = picture.iter().zip(&other).map(|(a, b)| a.abs_diff(*b)).fold(largest, u8::max);
            if largest > MAX_LEVELS {
                return Ok(None);
            }
        }
        Ok(Some(largest))
    }
}

/// Returns the format with 16 bits in place of 32.
fn half_of(format: TexelFormat) -> Option<TexelFormat> {
    match format {
        TexelFormat::R32f => Some(TexelFormat::R16f),
        TexelFormat::Rg32f => Some(TexelFormat::Rg16f),
        TexelFormat::Rgba32f => Some(TexelFormat::Rgba16f),
        _ => None,
    }
}
