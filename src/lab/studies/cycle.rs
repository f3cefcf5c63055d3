//! Multigrid V-cycles on a torus as passes of a project: one for every thing that is done on a grid.

use eddy_project::{Channel, Filter, Input, Pass, PassId, PassSize, Project, Sampler, Source, TexelFormat, Wrap};

const SWEPT: &str = include_str!("../../../assets/lab/poisson_cycle/swept.glsl");
const FIRST: &str = include_str!("../../../assets/lab/poisson_cycle/first.glsl");
const REST: &str = include_str!("../../../assets/lab/poisson_cycle/rest.glsl");
const ADDED: &str = include_str!("../../../assets/lab/poisson_cycle/added.glsl");

/// A texel of what a cycle begins with: where its pass is called, and the component that counts.
#[derive(Clone, Copy, Debug)]
pub struct Component {
    pub pass: &'static str,
    pub component: char,
}

/// Adds a V(2,2) cycle that ends in the pass `result` of the project: (p, f). It begins with p of `guess` and f of
/// `source`, which `result` may be, drawn in the frame before. The passes stand right before `result`. `n` texels a
/// side, a power of two.
///
/// # Panics
/// If the project has no such pass.
pub fn add(project: &mut Project, n: u32, guess: &'static str, source: Component, result: &str) {
    let levels = n.ilog2().max(2) - 1;
    let size = |level: u32| PassSize::Fixed(n >> level, n >> level);
    let name = |what: &str, level: u32| format!("{what}{level}");
    let mut passes = Vec::new();
    let text = format!("#define F {}\n{SWEPT}", source.component);
    passes.push(pass(&name("pre", 0), &text, size(0), &[guess, source.pass]));
    for level in 1..=levels {
        passes.push(pass(&name("rhs", level), REST, size(level), &[&name("pre", level - 1)]));
        passes.push(pass(&name("pre", level), FIRST, size(level), &[&name("rhs", level)]));
    }
    let mut below = name("pre", levels);
    for level in (0..levels).rev() {
        passes.push(pass(&name("add", level), ADDED, size(level), &[&name("pre", level), &below]));
        if level > 0 {
            below = name("post", level);
            passes.push(pass(&below, SWEPT, size(level), &[&name("add", level), &name("add", level)]));
        }
    }
    let id = super::super::setup::pass(result);
    let place = project.passes.iter().position(|p| p.id == id).expect("the project has the pass a cycle ends in");
    let end = &mut project.passes[place];
    (end.channels, end.source.text) = (channels(&["add0", "add0"]), SWEPT.into());
    project.passes.splice(place..place, passes);
}

fn pass(name: &str, text: &str, size: PassSize, reads: &[&str]) -> Pass {
    let mut pass = Pass {
        id: PassId::Buffer(name.to_owned()),
        source: Source { name: format!("buffer_{name}.glsl"), path: None, text: text.into() },
        channels: channels(reads),
        settings: Default::default(),
    };
    pass.settings.size = size;
    pass.settings.format = if name.starts_with("rhs") { TexelFormat::R32f } else { TexelFormat::Rg32f };
    pass
}

fn channels(reads: &[&str]) -> [Option<Channel>; 4] {
    let sampler = Sampler { filter: Filter::Nearest, wrap: Wrap::Repeat, vflip: true };
    std::array::from_fn(|n| reads.get(n).map(|name| Channel { input: Input::buffer(*name), sampler }))
}
