//! The plan of a frame, and the sampler that counts where several channels read one buffer (`shadertoy.md`, section 7).

use super::tiles::TiledDraw;
use eddy_project::{
    Condition, Filter, Input, Pass, PassName, PassSize, Project, Region, SLOTS, Sampler, SamplerRules, Wrap,
};
use eddy_texture::{Dimension, TexelFormat};
use std::{collections::BTreeSet, ops::Range};

/// The use that a compiled pass makes of one channel.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct ChannelFacts {
    /// Some read of it can be reached.
    pub is_read: bool,
    /// Some read can reach a mip level other than 0.
    pub reaches_mips: bool,
}

/// The facts of a compiled pass that the planner needs. Conservative: what may happen counts as happening.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct PassFacts {
    pub channels: [ChannelFacts; SLOTS],
    /// `discard` can be reached, so what the target held before can stay visible.
    pub discards: bool,
}

impl PassFacts {
    /// Reads every channel at every level and discards: what to assume of a pass of which nothing is known.
    pub const ANYTHING: PassFacts =
        PassFacts { channels: [ChannelFacts { is_read: true, reaches_mips: true }; SLOTS], discards: true };
}

/// The frame whose picture of a target a read sees.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum ReadTiming {
    /// The one that has been drawn in this frame already.
    ThisFrame,
    /// The one that was drawn last before that: the reader is the target itself, or is drawn before it. In a group that
    /// is the step before, at its first step the frame before.
    LastFrame,
}

/// The source of a channel's texels.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum TexelSource {
    /// An index into [`FramePlan::targets`].
    Target { index: usize, when: ReadTiming },
    /// A texture that something else than a pass fills.
    External,
    /// No input, or one that no texture can be had for: opaque black, of size 0.
    Nothing,
}

/// A channel of a draw: what it reads and how.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Read {
    pub source: TexelSource,
    pub sampler: Sampler,
    /// Levels beyond 0 may be sampled: the sampler asks for them and the source has them.
    pub mips: bool,
}

/// A texture, or a pair of them, that passes draw into or read.
#[derive(Clone, Debug, PartialEq)]
pub struct Target {
    pub id: PassName,
    /// The place among the pass's targets, from 0.
    pub index: usize,
    pub dimension: Dimension,
    pub size: PassSize,
    pub format: TexelFormat,
    /// Two textures that take turns: somebody reads last frame's picture, or a `discard` can show the one before it.
    pub doubled: bool,
    /// A mip chain is built after each draw.
    pub mips: bool,
}

/// One pass of a frame.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Draw {
    /// Index into [`Project::passes`].
    pub pass: usize,
    /// Indices into [`FramePlan::targets`]; several only where meshes are drawn.
    pub targets: Range<usize>,
    /// The index of one more, behind these, for what [`FramePlan::draw_beside`] asks for.
    pub beside: Option<usize>,
    /// `None` where the compiled pass does not read the channel.
    pub reads: [Option<Read>; SLOTS],
    /// It rasterizes meshes into targets that are cleared first.
    pub draws_meshes: bool,
    /// The pass begins with the texels that the target held.
    pub keeps_content: bool,
    /// Only these texels are drawn; the others are as they were drawn last.
    pub region: Option<Region>,
    /// Before frame 0, and after a reset, its target holds what the project says and no zeros.
    pub has_initial: bool,
    /// So many of the outermost texels are overwritten after it is drawn.
    pub boundary: Option<u32>,
    /// While it is false the draw is left out, and its targets hold what they hold before frame 0.
    pub when: Option<Condition>,
    /// Its picture of before will do while nothing it reads has changed: what it draws depends on nothing else, and on
    /// its own picture of before it does not depend.
    pub is_cacheable: bool,
}

/// The sampler of a fill's picture.
const FILL_SAMPLER: Sampler = Sampler { filter: Filter::Linear, wrap: Wrap::Clamp, vflip: true };

impl Draw {
    /// Indices into [`FramePlan::targets`] of all that is drawn into, in the order of the locations of a fragment.
    pub fn all_targets(&self) -> impl Iterator<Item = usize> + use<> {
        self.targets.clone().chain(self.beside)
    }

    /// Returns what a fill of the pass is drawn as. It reads nothing of what the pass reads, but its own picture if it
    /// is one.
    pub fn of_fill(&self, is_picture: bool) -> Draw {
        let read = is_picture.then_some(Read { source: TexelSource::External, sampler: FILL_SAMPLER, mips: false });
        Draw { reads: [read, None, None, None], keeps_content: true, is_cacheable: false, ..self.clone() }
    }
}

/// Draws that follow each other, all done once in order, then again.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Run {
    /// Indices into [`FramePlan::draws`].
    pub draws: Range<usize>,
    /// At least 1.
    pub steps: u32,
}

/// Everything about a frame that can be known before it is drawn.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct FramePlan {
    pub targets: Vec<Target>,
    /// In drawing order.
    pub draws: Vec<Draw>,
    /// The order in which draws are repeated: every draw is in one run.
    pub runs: Vec<Run>,
    /// Passes of the project that no wanted picture needs, as indices into [`Project::passes`].
    pub skipped: Vec<usize>,
    /// The draw that [`FramePlan::tile`] has made one of tiles.
    pub tiled: Option<TiledDraw>,
}

impl FramePlan {
    /// Returns whether a pass draws the target. One that none draws stands for a pass that the project does not have.
    pub fn is_drawn(&self, target: usize) -> bool {
        self.draws.iter().any(|draw| draw.all_targets().any(|drawn| drawn == target))
    }

    /// Adds a target of 32-bit floats, with a name of its own, for a value that the pass of a draw gives beside its
    /// picture. Nobody reads it, and what the pass reads and draws is as before.
    pub fn draw_beside(&mut self, pass: usize, id: PassName) {
        let Some(draw) = self.draws.iter_mut().find(|draw| draw.pass == pass) else { return };
        draw.beside = Some(self.targets.len());
        let own = &self.targets[draw.targets.start];
        let (dimension, size) = (own.dimension, own.size);
        let format = TexelFormat::Rgba32f;
        self.targets.push(Target { id, index: 0, dimension, size, format, doubled: false, mips: false });
    }

    /// Plans a frame of `project`. `facts[i]` belongs to `project.passes[i]`. `wanted` are the passes whose pictures
    /// somebody will look at; empty means Image. Without `skip` everything is drawn, doubled and mipped as the site
    /// would.
    ///
    /// # Panics
    /// If `facts` and the project's passes differ in length.
    pub fn new(project: &Project, facts: &[PassFacts], wanted: &[PassName], skip: bool) -> FramePlan {
        Self::ending_with(project, facts, wanted, skip, None)
    }

    /// Does the same as [`FramePlan::new`], with the buffer `last` drawn after all other passes.
    pub fn ending_with(
        project: &Project,
        facts: &[PassFacts],
        wanted: &[PassName],
        skip: bool,
        last: Option<&PassName>,
    ) -> FramePlan {
        assert_eq!(facts.len(), project.passes.len(), "one PassFacts for each pass");
        let mut order = drawing_order(project, wanted);
        order.sort_by_key(|&pass| Some(&project.passes[pass].id) == last);
        let reached = if skip { reached_from(project, facts, wanted) } else { order.iter().copied().collect() };
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
                let used = facts[pass].channels[channel].is_read || !skip;
                used.then(|| plan.read(project, &drawn, place, channel)).flatten()
            });
            let region = project.passes[pass].settings.region;
            // Where meshes are drawn everything is cleared first, on the site's terms or not.
            let is_cleared = project.passes[pass].body.is_cleared();
            plan.draws.push(Draw {
                pass,
                targets,
                beside: None,
                reads,
                draws_meshes: is_cleared,
                keeps_content: !is_cleared && (facts[pass].discards || region.is_some() || !skip),
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

    /// Indices of the targets of `id`, made if there are none.
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

    /// Groups of the project, and each other draw by itself. What nobody reaches is left out of a group.
    fn runs(&mut self, project: &Project) {
        let group_of = |draw: &Draw| {
            let id = &project.passes[draw.pass].id;
            project.groups.iter().position(|g| g.passes.contains(id))
        };
        let mut begin = 0;
        while begin < self.draws.len() {
            let group = group_of(&self.draws[begin]);
            let same = |draw: &&Draw| group.is_some() && group_of(draw) == group;
            let end = begin + self.draws[begin..].iter().take_while(same).count().max(1);
            let steps = group.map_or(1, |g| project.groups[g].steps.max(1));
            self.runs.push(Run { draws: begin..end, steps });
            begin = end;
        }
    }

    /// Returns the number of draws of a frame in which everything has changed, each step and each face of a cube
    /// counted.
    pub fn draws_a_frame(&self) -> u64 {
        let draws = |run: &Run| run.draws.clone().map(|draw| u64::from(self.layers(draw))).sum::<u64>();
        self.runs.iter().map(|run| draws(run) * u64::from(run.steps)).sum()
    }

    /// Returns how many times the pass of a draw is drawn for one picture: once, and for each face of a cube.
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
        Some(Read { source, sampler: sampler.unwrap_or(Sampler::BUFFER), mips: false })
    }

    fn target_read(
        &mut self,
        project: &Project,
        drawn: &[usize],
        place: usize,
        id: &PassName,
        index: usize,
    ) -> TexelSource {
        // A buffer without a pass holds zeros. A cube of them would take 48 MiB to say less than an empty channel.
        if id.has_faces() && project.pass(id).is_none() {
            return TexelSource::Nothing;
        }
        let earlier = drawn[..place].iter().any(|&p| project.passes[p].id == *id);
        let Some(index) = self.targets(project, id).nth(index) else { return TexelSource::Nothing };
        TexelSource::Target { index, when: if earlier { ReadTiming::ThisFrame } else { ReadTiming::LastFrame } }
    }

    /// Decides what each target needs, now that every read is known.
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
            // What a cleared target held before cannot show.
            let is_cleared = |p: usize| project.passes[p].body.is_cleared();
            let discards = drawn_by.is_some_and(|p| facts[p].discards && !is_cleared(p));
            // Image keeps the canvas of one frame before, and Sound its block before; only buffers take turns.
            let takes_turns = id.is_readable() && drawn_by.is_some();
            let doubled = takes_turns && (!skip || discards || !reads_of(Some(ReadTiming::LastFrame)).is_empty());
            // The site asks every pass of the project, also one that nobody looks at.
            let sampler_asks = (0..project.passes.len()).any(|p| {
                (0..SLOTS).any(|c| {
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
            let reads_itself = draw
                .reads
                .iter()
                .flatten()
                .any(|r| matches!(r.source, TexelSource::Target { index, .. } if own.contains(&index)));
            let shows_before = facts[draw.pass].discards && !project.passes[draw.pass].body.is_cleared();
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

/// Buffers in the project's order, then the cubemap, then Image. Sound makes no picture, and is drawn only for who wants
/// a block of its samples.
fn drawing_order(project: &Project, wanted: &[PassName]) -> Vec<usize> {
    let id = |i: usize| &project.passes[i].id;
    let is_drawn = |i: &usize| id(*i).is_picture() || wanted.contains(id(*i));
    let mut order: Vec<usize> = (0..project.passes.len()).filter(is_drawn).collect();
    order.sort_by(|&a, &b| id(a).drawing_order(id(b)));
    order
}

/// Passes that some wanted picture needs, now or in a frame to come.
fn reached_from(project: &Project, facts: &[PassFacts], wanted: &[PassName]) -> BTreeSet<usize> {
    let index_of = |id: &PassName| project.passes.iter().position(|p| p.id == *id);
    let image = [PassName::image()];
    let mut todo: Vec<usize> =
        if wanted.is_empty() { &image[..] } else { wanted }.iter().filter_map(index_of).collect();
    let mut reached = BTreeSet::new();
    while let Some(pass) = todo.pop() {
        if !reached.insert(pass) {
            continue;
        }
        for (slot, channel) in project.passes[pass].bindings.iter() {
            let is_read = facts[pass].channels.get(slot).is_some_and(|fact| fact.is_read);
            let read = Some(channel).filter(|_| is_read).and_then(|c| c.input.target());
            todo.extend(read.and_then(|(id, _)| index_of(id)));
        }
    }
    reached
}

/// Returns the sampler with which `pass`'s channel `index` is really read; `None` where the channel is empty.
///
/// Some kinds of input, such as the keyboard, are always read in one way. Under [`SamplerRules::Site`] a buffer's filter
/// is that of the last channel of the same pass that reads it, because the site sets it on the texture just before the
/// pass draws, and its wrap that of the last channel of the whole project, because the site sets it once as channels
/// load.
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
