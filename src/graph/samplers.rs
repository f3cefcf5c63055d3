//! The sampler that counts where several channels read one buffer (`shadertoy.md`, section 7).

use eddy_project::{Project, Sampler, SamplerRules};

/// Returns the sampler with which `pass`'s channel `index` is really read; `None` where the channel is empty.
///
/// Some kinds of input, such as the keyboard, are always read in one way. Under [`SamplerRules::Site`] a buffer's filter is that of the last channel
/// of the same pass that reads it, because the site sets it on the texture just before the pass draws, and its wrap
/// that of the last channel of the whole project, because the site sets it once as channels load.
pub fn effective_sampler(project: &Project, pass: usize, index: usize) -> Option<Sampler> {
    let pass = &project.passes[pass];
    let channel = pass.channels[index].as_ref()?;
    let is_shared = channel.input.target().is_some();
    if !is_shared || project.sampler_rules == SamplerRules::PerChannel {
        return Some(channel.sampler());
    }
    let same = |channels: &[Option<eddy_project::Channel>; 4]| {
        channels.iter().flatten().rfind(|c| c.input == channel.input).map(|c| c.sampler)
    };
    let filter = same(&pass.channels)?.filter;
    let wrap = project.passes.iter().rev().find_map(|p| same(&p.channels))?.wrap;
    Some(Sampler { filter, wrap, ..channel.sampler })
}
