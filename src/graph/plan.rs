//! The plan of a frame, and the sampler that applies if several channels read one buffer (`shadertoy.md`, section 7).

use super::tiles::TiledDraw;
use eddy_project::{
    Condition, Filter, Input, MAX_CHANNELS, Pass, PassName, PassSize, Project, Region, Sampler, SamplerRules, Wrap,
};
use eddy_texture::{Dimension, TexelFormat};
use std::{collections::BTreeSet, ops::Range};

/// The use of one channel by a compiled pass.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct ChannelFacts {
    /// Some read of it is reachable.
    pub is_read: bool,
    /// Some read may access a mip level other than 0.
    pub reaches_mips: bool,
    /// The most texels that one draw reads; `None` for any number. With 0 at most the size of the source is asked.
    pub max_texels: Option<u32>,
}

impl ChannelFacts {
    /// Any texel may be read, of any level.
    pub const ANYTHING: ChannelFacts = ChannelFacts { is_read: true, reaches_mips: true, max_texels: None };

    /// Returns whether the result may depend on a texel, and not only on the size of the source.
    pub fn reads_texels(&self) -> bool {
        self.is_read && self.max_texels != Some(0)
    }
}

/// The facts about a compiled pass that the planner needs. Conservative: whatever may happen is assumed to happen.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct PassFacts {
    /// The facts about each channel.
    pub channels: [ChannelFacts; MAX_CHANNELS],
    /// `discard` is reachable, so the previous content of the target can stay visible.
    pub discards: bool,
}

impl PassFacts {
    /// Reads every channel at every level and discards: the assumption for an unknown pass.
    pub const ANYTHING: PassFacts = PassFacts { channels: [ChannelFacts::ANYTHING; MAX_CHANNELS], discards: true };
}

/// The frame whose picture of a target a read sees.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum ReadTiming {
    /// The picture that has already been drawn in this frame.
    ThisFrame,
    /// The picture before that: the reader is the target itself, or is drawn before it. Within a group that is the
    /// previous step, and for its first step the previous frame.
    LastFrame,
}

/// The source of a channel's texels.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum TexelSource {
    /// A target of a pass.
    Target {
        /// An index into [`FramePlan::targets`].
        index: usize,
        /// The frame whose texels are read.
        when: ReadTiming,
    },
    /// A texture that is not filled by a pass.
    External,
    /// No input, or one whose texture is unavailable: opaque black, of size 0.
    Nothing,
}

/// A channel of a draw: its source and sampler.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Read {
    /// The source of the texels.
    pub source: TexelSource,
    /// The sampler that reads them.
    pub sampler: Sampler,
    /// Levels beyond 0 may be sampled: the sampler uses them and the source has them.
    pub mips: bool,
    /// The most texels that one draw reads; `None` for any number, 0 if at most the size is asked.
    pub max_texels: Option<u32>,
}

impl Read {
    /// Returns whether the reader may depend on a texel of the source.
    pub fn reads_texels(&self) -> bool {
        self.max_texels != Some(0)
    }
}

/// A texture, or a pair of them, that passes draw into or read.
#[derive(Clone, Debug, PartialEq)]
pub struct Target {
    /// The pass that draws it.
    pub id: PassName,
    /// The index among the pass's targets, from 0.
    pub index: usize,
    /// The kind of texture.
    pub dimension: Dimension,
    /// Its size in relation to the canvas.
    pub size: PassSize,
    /// The format of its texels.
    pub format: TexelFormat,
    /// Two alternating textures: the last frame's picture is read, or a `discard` can show the previous one.
    pub doubled: bool,
    /// A mip chain is built after each draw.
    pub mips: bool,
}

/// One pass of a frame.
#[derive(Clone, Debug, PartialEq)]
pub struct Draw {
    /// Index into [`Project::passes`].
    pub pass: usize,
    /// Indices into [`FramePlan::targets`]; several only if meshes are drawn.
    pub targets: Range<usize>,
    /// The index of an additional target, after these, for [`FramePlan::add_extra_target`].
    pub extra_target: Option<usize>,
    /// `None` if the compiled pass does not read the channel.
    pub reads: [Option<Read>; MAX_CHANNELS],
    /// It rasterizes meshes into targets that are cleared first.
    pub draws_meshes: bool,
    /// The colour with which the targets are cleared first, if any of their texels can show it.
    pub clear: Option<[f32; 4]>,
    /// The pass starts with the previous texels of the target.
    pub keeps_content: bool,
    /// Only these texels are drawn; the others are kept.
    pub region: Option<Region>,
    /// Before frame 0, and after a reset, its target contains the project's initial values instead of zeros.
    pub has_initial: bool,
    /// This number of outermost texels are overwritten after it is drawn.
    pub boundary: Option<u32>,
    /// While it is false, the draw is skipped, and its targets contain what they contain before frame 0.
    pub when: Option<Condition>,
    /// Its previous picture can be reused while nothing it reads has changed: it depends on nothing else, including its
    /// own previous picture.
    pub is_cacheable: bool,
}

/// The sampler of a fill's picture.
const FILL_SAMPLER: Sampler = Sampler { filter: Filter::Linear, wrap: Wrap::Clamp, vflip: true };

impl Draw {
    /// Returns the indices into [`FramePlan::targets`] of all targets it draws into, in the order of fragment
    /// locations.
    pub fn all_targets(&self) -> impl Iterator<Item = usize> + use<> {
        self.targets.clone().chain(self.extra_target)
    }

    /// Returns what decides whether the draw must be executed.
    pub fn dependencies(&self) -> Dependencies {
        let reads_texels = |read: &Option<Read>| read.as_ref().is_some_and(Read::reads_texels);
        Dependencies { channels: self.reads.each_ref().map(reads_texels), is_cacheable: self.is_cacheable }
    }

    /// Returns the same for frames in which more is known of the pass than when it was planned, such as the values of
    /// uniforms. The plan must be one that skips passes.
    pub fn dependencies_with(&self, facts: &PassFacts) -> Dependencies {
        let mut all = self.dependencies();
        for (reads_texels, fact) in all.channels.iter_mut().zip(&facts.channels) {
            *reads_texels &= fact.reads_texels();
        }
        let reads_itself = self.reads.iter().zip(all.channels).any(|(read, reads_texels)| match read {
            Some(Read { source: TexelSource::Target { index, .. }, .. }) => {
                reads_texels && self.targets.contains(index)
            }
            _ => false,
        });
        // After a pass that may discard, both textures of a pair matter, and drawing it twice would make them equal.
        let shows_before = self.keeps_content && self.region.is_none();
        all.is_cacheable |= !reads_itself && !shows_before;
        all
    }

    /// Returns the draw for a fill of the pass. It reads none of the pass's inputs, only its own picture if the fill is
    /// one.
    pub fn of_fill(&self, is_picture: bool) -> Draw {
        let read = is_picture.then_some(Read {
            source: TexelSource::External,
            sampler: FILL_SAMPLER,
            mips: false,
            max_texels: None,
        });
        let mut reads = [const { None }; MAX_CHANNELS];
        reads[0] = read;
        Draw { reads, clear: None, keeps_content: true, is_cacheable: false, ..self.clone() }
    }
}

/// The inputs by which it is decided whether a draw must be executed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Dependencies {
    /// For each channel, whether the result may depend on its texels.
    pub channels: [bool; MAX_CHANNELS],
    /// Equal inputs give equal texels, whatever the target contains.
    pub is_cacheable: bool,
}

/// Consecutive draws that are executed in order, `steps` times.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Run {
    /// Indices into [`FramePlan::draws`].
    pub draws: Range<usize>,
    /// At least 1.
    pub steps: u32,
}

/// Everything about a frame that can be determined before it is drawn.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct FramePlan {
    /// The textures that passes draw into.
    pub targets: Vec<Target>,
    /// In drawing order.
    pub draws: Vec<Draw>,
    /// The repetition of draws: every draw is in exactly one run.
    pub runs: Vec<Run>,
    /// Passes of the project that no requested picture needs, as indices into [`Project::passes`].
    pub skipped: Vec<usize>,
    /// The draw that [`FramePlan::tile`] has turned into tiles.
    pub tiled: Option<TiledDraw>,
}

impl FramePlan {
    /// Returns whether a pass draws the target. A target that is not drawn represents a pass that the project does not
    /// have.
    pub fn is_drawn(&self, target: usize) -> bool {
        self.draws.iter().any(|draw| draw.all_targets().any(|drawn| drawn == target))
    }

    /// Adds a target of 32-bit floats, with a name of its own, for a value that the pass of a draw outputs in addition
    /// to its picture. No pass reads it, and the pass's other reads and outputs do not change.
    pub fn add_extra_target(&mut self, pass: usize, id: PassName) {
        let Some(draw) = self.draws.iter_mut().find(|draw| draw.pass == pass) else { return };
        draw.extra_target = Some(self.targets.len());
        let own = &self.targets[draw.targets.start];
        let (dimension, size) = (own.dimension, own.size);
        let format = TexelFormat::Rgba32f;
        self.targets.push(Target { id, index: 0, dimension, size, format, doubled: false, mips: false });
    }

    /// Plans a frame of `project`. `facts[i]` belongs to `project.passes[i]`. `wanted` are the passes whose pictures
    /// are requested; empty means Image. Without `skip` everything is drawn, double-buffered and mipped as on
    /// Shadertoy.
    ///
    /// # Panics
    /// If `facts` and the project's passes differ in length.
    pub fn new(project: &Project, facts: &[PassFacts], requested: &[PassName], skip: bool) -> FramePlan {
        Self::ending_with(project, facts, requested, skip, None)
    }

    /// Does the same as [`FramePlan::new`], with the buffer `last` drawn after all other passes.
    pub fn ending_with(
        project: &Project,
        facts: &[PassFacts],
        requested: &[PassName],
        skip: bool,
        last: Option<&PassName>,
    ) -> FramePlan {
        assert_eq!(facts.len(), project.passes.len(), "one PassFacts for each pass");
        let mut order = drawing_order(project, requested);
        order.sort_by_key(|&pass| Some(&project.passes[pass].id) == last);
        let reached = if skip { reached_from(project, facts, requested) } else { order.iter().copied().collect() };
        let mut plan = FramePlan {
            skipped: order.iter().copied().filter(|i| !reached.contains(i)).collect(),
            ..Default::default()
        };
        let drawn: Vec<usize> = order.into_iter().filter(|i| reached.contains(i)).collect();
        for &pass in &drawn {
            plan.targets(project, &project.passes[pass].id);
        }
        for (place, &pass) in drawn.iter().enumerate() {
            let targets = plan.targets(project, &project.passes[pass].id);
            let reads = std::array::from_fn(|channel| {
                let fact = facts[pass].channels[channel];
                let read = (fact.is_read || !skip).then(|| plan.read(project, &drawn, place, channel)).flatten();
                read.map(|read| Read { max_texels: if skip { fact.max_texels } else { None }, ..read })
            });
            let region = project.passes[pass].settings.region;
            // Targets of meshes are always cleared first, with any rules.
            let clear = project.dialect.clear_colour(&project.passes[pass]);
            plan.draws.push(Draw {
                pass,
                targets,
                extra_target: None,
                reads,
                draws_meshes: project.passes[pass].body.is_cleared(),
                clear: clear.filter(|_| facts[pass].discards || project.passes[pass].body.is_cleared()),
                keeps_content: clear.is_none() && (facts[pass].discards || region.is_some() || !skip),
                region,
                has_initial: project.passes[pass].settings.initial.is_some(),
                boundary: project.passes[pass].settings.boundary.as_ref().map(|b| b.width),
                when: project.passes[pass].settings.when.clone(),
                is_cacheable: false,
            });
        }
        plan.runs(project);
        plan.settle(project, facts, skip);
        plan
    }

    /// Returns the indices of the targets of `id`, which are created if necessary.
    fn targets(&mut self, project: &Project, id: &PassName) -> Range<usize> {
        let pass = project.pass_or_empty(id);
        let formats = pass.formats();
        let first = self.targets.iter().position(|t| t.id == *id).unwrap_or_else(|| {
            let size = pass.size();
            let first = self.targets.len();
            self.targets.extend(formats.iter().enumerate().map(|(index, &format)| Target {
                id: id.clone(),
                index,
                dimension: id.row().target.unwrap_or_default(),
                size,
                format,
                doubled: false,
                mips: false,
            }));
            first
        });
        first..first + formats.len()
    }

    /// Creates runs for the groups of the project, and one for each other draw. Unreachable passes are omitted from a
    /// group.
    fn runs(&mut self, project: &Project) {
        let group_of = |draw: &Draw| {
            let id = &project.passes[draw.pass].id;
            project.groups.iter().position(|g| g.passes.contains(id))
        };
        let mut first = 0;
        while first < self.draws.len() {
            let group = group_of(&self.draws[first]);
            let same = |draw: &&Draw| group.is_some() && group_of(draw) == group;
            let end = first + self.draws[first..].iter().take_while(same).count().max(1);
            let steps = group.map_or(1, |g| project.groups[g].steps.max(1));
            self.runs.push(Run { draws: first..end, steps });
            first = end;
        }
    }

    /// Returns the number of draws of a frame in which everything has changed, counting each step and each face of a
    /// cube.
    pub fn draws_per_frame(&self) -> u64 {
        let draws = |run: &Run| run.draws.clone().map(|draw| u64::from(self.layers(draw))).sum::<u64>();
        self.runs.iter().map(|run| draws(run) * u64::from(run.steps)).sum()
    }

    /// Returns how often the pass of a draw is drawn for one picture: once, or once per face of a cube.
    pub fn layers(&self, draw: usize) -> u32 {
        self.targets[self.draws[draw].targets.start].dimension.layers()
    }

    fn read(&mut self, project: &Project, drawn: &[usize], place: usize, channel: usize) -> Option<Read> {
        let pass = drawn[place];
        let sampler = effective_sampler(project, pass, channel);
        let source = match project.passes[pass].bindings.get(channel).map(|c| &c.input) {
            None => TexelSource::Nothing,
            Some(Input::Pass { id, target }) => self.target_read(project, drawn, place, id, *target),
            Some(Input::Media { .. } | Input::Device(_)) => TexelSource::External,
        };
        Some(Read { source, sampler: sampler.unwrap_or(Sampler::BUFFER), mips: false, max_texels: None })
    }

    fn target_read(
        &mut self,
        project: &Project,
        drawn: &[usize],
        place: usize,
        id: &PassName,
        index: usize,
    ) -> TexelSource {
        // A buffer without a pass contains zeros. A cube of them would use 48 MiB for no more than an empty channel.
        if id.has_faces() && project.pass(id).is_none() {
            return TexelSource::Nothing;
        }
        let earlier = drawn[..place].iter().any(|&p| project.passes[p].id == *id);
        let Some(index) = self.targets(project, id).nth(index) else { return TexelSource::Nothing };
        TexelSource::Target { index, when: if earlier { ReadTiming::ThisFrame } else { ReadTiming::LastFrame } }
    }

    /// Determines the properties of each target, now that every read is known.
    fn settle(&mut self, project: &Project, facts: &[PassFacts], skip: bool) {
        for index in 0..self.targets.len() {
            let (id, own_index) = (self.targets[index].id.clone(), self.targets[index].index);
            let reads_of = |when: Option<ReadTiming>| {
                self.draws
                    .iter()
                    .flat_map(|d| d.reads.iter().enumerate().map(move |(c, r)| (d.pass, c, r)))
                    .filter(move |(_, _, r)| {
                        matches!(r, Some(Read { source: TexelSource::Target { index: i, when: w }, .. })
                            if *i == index && when.is_none_or(|when| when == *w))
                    })
                    .map(|(pass, channel, _)| (pass, channel))
                    .collect::<Vec<_>>()
            };
            let drawn_by = self.draws.iter().find(|d| d.targets.contains(&index)).map(|d| d.pass);
            // The previous content of a cleared target cannot be visible.
            let is_cleared = |p: usize| project.dialect.clear_colour(&project.passes[p]).is_some();
            let discards = drawn_by.is_some_and(|p| facts[p].discards && !is_cleared(p));
            // Image keeps the canvas of the previous frame, and Sound its previous block; only buffers alternate.
            let takes_turns = id.is_readable() && drawn_by.is_some();
            let doubled = takes_turns && (!skip || discards || !reads_of(Some(ReadTiming::LastFrame)).is_empty());
            // Shadertoy considers every pass of the project, including those that are not shown.
            let sampler_asks = (0..project.passes.len()).any(|p| {
                (0..MAX_CHANNELS).any(|c| {
                    project.passes[p].bindings.get(c).is_some_and(|ch| ch.input.target() == Some((&id, own_index)))
                        && effective_sampler(project, p, c).is_some_and(|s| s.filter == Filter::Mipmap)
                })
            });
            let reached = reads_of(None).iter().any(|&(p, c)| facts[p].channels[c].reaches_mips);
            let mips = sampler_asks && (reached || !skip);
            let target = &mut self.targets[index];
            (target.doubled, target.mips) = (doubled, mips);
        }
        for draw in &mut self.draws {
            let own = draw.targets.clone();
            let reads_itself = draw.reads.iter().flatten().any(|r| {
                r.reads_texels() && matches!(r.source, TexelSource::Target { index, .. } if own.contains(&index))
            });
            let is_cleared = project.dialect.clear_colour(&project.passes[draw.pass]).is_some();
            let shows_before = facts[draw.pass].discards && !is_cleared;
            draw.is_cacheable = skip && !shows_before && !reads_itself;
            for read in draw.reads.iter_mut().flatten() {
                read.mips = read.sampler.filter == Filter::Mipmap
                    && match read.source {
                        TexelSource::Target { index, .. } => self.targets[index].mips,
                        TexelSource::External => true,
                        TexelSource::Nothing => false,
                    };
            }
        }
    }
}

/// Buffers in the project's order, then the cubemap, then Image. Sound has no picture, and is drawn only if a block of
/// its samples is requested.
fn drawing_order(project: &Project, requested: &[PassName]) -> Vec<usize> {
    let id = |i: usize| &project.passes[i].id;
    let is_drawn = |i: &usize| id(*i).is_picture() || requested.contains(id(*i));
    let mut order: Vec<usize> = (0..project.passes.len()).filter(is_drawn).collect();
    order.sort_by(|&a, &b| id(a).drawing_order(id(b)));
    order
}

/// Returns the passes that some requested picture needs, now or in a later frame.
fn reached_from(project: &Project, facts: &[PassFacts], requested: &[PassName]) -> BTreeSet<usize> {
    let index_of = |id: &PassName| project.passes.iter().position(|p| p.id == *id);
    let image = [PassName::image()];
    let mut todo: Vec<usize> =
        if requested.is_empty() { &image[..] } else { requested }.iter().filter_map(index_of).collect();
    let mut reached = BTreeSet::new();
    while let Some(pass) = todo.pop() {
        if !reached.insert(pass) {
            continue;
        }
        for (slot, channel) in project.passes[pass].bindings.iter() {
            // A source of which only the size is asked need not be drawn.
            let is_read = facts[pass].channels.get(slot).is_some_and(ChannelFacts::reads_texels);
            let read = Some(channel).filter(|_| is_read).and_then(|c| c.input.target());
            todo.extend(read.and_then(|(id, _)| index_of(id)));
        }
    }
    reached
}

/// Returns the sampler with which `pass`'s channel `index` is actually read; `None` if the channel is empty.
///
/// Some kinds of input, such as the keyboard, always have the same sampler. Under [`SamplerRules::Site`] a buffer's
/// filter is that of the last channel of the same pass that reads it, because Shadertoy sets it on the texture just
/// before the pass draws, and its wrap is that of the last channel of the whole project, because Shadertoy sets it once
/// when channels load.
pub fn effective_sampler(project: &Project, pass: usize, index: usize) -> Option<Sampler> {
    let pass = &project.passes[pass];
    let channel = pass.bindings.get(index)?;
    let is_shared = channel.input.target().is_some();
    if !is_shared || project.sampler_rules == SamplerRules::PerChannel {
        return Some(channel.sampler());
    }
    let same = |pass: &Pass| pass.bindings.channels().rfind(|c| c.input == channel.input).map(|c| c.sampler);
    let filter = same(pass)?.filter;
    let wrap = project.passes.iter().rev().find_map(same)?.wrap;
    Some(Sampler { filter, wrap, ..channel.sampler })
}
