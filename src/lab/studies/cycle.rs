//! Multigrid cycles on a torus, or in a box with walls, as passes of a project: one for every operation on a grid. The
//! names of cycles and their parts are those of Trottenberg, Oosterlee and Schüller, Multigrid (2001), chapter 2.

use eddy_project::{
    Bindings, Channel, Filter, Input, Pass, PassName, PassSize, Project, Sampler, Source, TexelFormat, Wrap,
};

macro_rules! part {
    ($file:literal) => {
        include_str!(concat!("../../../assets/lab/poisson_cycle/", $file))
    };
}

const SWEPT: &str = part!("swept.glsl");
const FIRST: &str = part!("first.glsl");
const COLOURED: &str = part!("coloured.glsl");
const FIRST_COLOURED: &str = part!("first_coloured.glsl");
const REST: &str = part!("rest.glsl");
const REST_TRANSPOSED: &str = part!("rest_transposed.glsl");
const ADDED: &str = part!("added.glsl");
const GATHERED: &str = part!("gathered.glsl");
const INTERPOLATED: &str = part!("interpolated.glsl");

/// The input texel of a cycle: the pass that contains it, and the component that is used.
#[derive(Clone, Copy, Debug)]
pub struct Component {
    pub pass: &'static str,
    pub component: char,
}

/// A V-cycle by its smoother.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Cycle {
    /// V(2,2): two sweeps of Jacobi's iteration damped by .8 before the correction and two after it.
    Jacobi,
    /// V(1,1): one red-black sweep of Gauss and Seidel before the correction and one after it.
    RedBlack,
    /// Like [`Cycle::RedBlack`], with black first after the correction, and a restriction that is the transpose of the
    /// interpolation. The cycle is a symmetric operator, as a preconditioner of conjugate gradients must be (Tatebe,
    /// The multigrid preconditioned conjugate gradient method, 1993).
    Symmetric,
}

impl Cycle {
    fn before(self) -> &'static str {
        if self == Cycle::Jacobi { SWEPT } else { COLOURED }
    }

    fn after(self) -> String {
        match self {
            Cycle::Symmetric => format!("#define TURN 1\n{COLOURED}"),
            _ => self.before().into(),
        }
    }

    fn sweep_from_zero(self) -> &'static str {
        if self == Cycle::Jacobi { FIRST } else { FIRST_COLOURED }
    }

    fn rest(self) -> &'static str {
        if self == Cycle::Symmetric { REST_TRANSPOSED } else { REST }
    }

    /// Returns the passes of a cycle on a grid of `n` texels per side, without the last. It starts with p of the pass
    /// `guess`, or with 0, and the component of `source`. Names start with `prefix`.
    fn passes(self, prefix: &str, n: u32, guess: Option<&str>, (source, component): (&str, char)) -> Vec<Pass> {
        let levels = levels(n);
        let size = |level: u32| PassSize::Fixed(n >> level, n >> level);
        let name = |what: &str, level: u32| format!("{prefix}{what}{level}");
        let of_source = |text: &str| format!("#define F {component}\n{text}");
        let mut passes = Vec::new();
        passes.push(match guess {
            Some(guess) => pass(&name("pre", 0), &of_source(self.before()), size(0), &[guess, source]),
            None => pass(&name("pre", 0), &of_source(self.sweep_from_zero()), size(0), &[source]),
        });
        for level in 1..=levels {
            passes.push(pass(&name("rhs", level), self.rest(), size(level), &[&name("pre", level - 1)]));
            passes.push(pass(&name("pre", level), self.sweep_from_zero(), size(level), &[&name("rhs", level)]));
        }
        let mut below = name("pre", levels);
        for level in (0..levels).rev() {
            passes.push(pass(&name("add", level), ADDED, size(level), &[&name("pre", level), &below]));
            if level > 0 {
                below = name("post", level);
                let added = name("add", level);
                passes.push(pass(&below, &self.after(), size(level), &[&added, &added]));
            }
        }
        passes
    }

    /// Makes a pass the last of a cycle whose others were returned by [`Cycle::passes`].
    fn end(self, prefix: &str, end: &mut Pass) {
        let added = format!("{prefix}add0");
        (end.bindings, end.source.text) = (channels(&[&added, &added]), self.after().into());
    }

    /// Adds a cycle that ends in the pass `result` of the project: (p, f). It starts with p of `guess`, or with 0, and
    /// f of `source`, which may be `result` itself, drawn in the previous frame. The passes are inserted right before
    /// `result`, whose name is their prefix. `n` texels per side, a power of two.
    ///
    /// # Panics
    /// If the project has no such pass.
    pub fn add(self, project: &mut Project, n: u32, guess: Option<&str>, source: Component, result: &str) {
        let passes = self.passes(result, n, guess, (source.pass, source.component));
        self.end(result, insert(project, passes, result));
    }

    /// Adds full multigrid that ends in the pass `field` of the project, whose f it solves for: nested iteration, which
    /// starts each grid with the solution of the coarser one, interpolated by cubics, and draws `cycles` cycles on it
    /// (Trottenberg, Oosterlee and Schüller, section 2.6).
    ///
    /// # Panics
    /// If the project has no pass `field`.
    pub fn add_full(self, project: &mut Project, n: u32, cycles: u32) {
        let coarsest = levels(n);
        let size = |grid: u32| PassSize::Fixed(n >> grid, n >> grid);
        let f = |grid: u32| if grid == 0 { ("field".to_owned(), 'y') } else { (format!("f{grid}"), 'x') };
        let solved = |grid: u32| format!("solved{grid}");
        let mut passes = Vec::new();
        for grid in 1..=coarsest {
            let (finer, component) = f(grid - 1);
            let text = format!("#define F {component}\n{GATHERED}");
            let mut gathered = pass(&f(grid).0, &text, size(grid), &[&finer]);
            gathered.settings.format = TexelFormat::R32f;
            passes.push(gathered);
        }
        let (right, _) = f(coarsest);
        passes.push(pass(&solved(coarsest), self.sweep_from_zero(), size(coarsest), &[&right]));
        let mut last = String::new();
        for grid in (0..coarsest).rev() {
            let (right, component) = f(grid);
            let initial = format!("begun{grid}");
            let text = format!("#define F {component}\n{INTERPOLATED}");
            passes.push(pass(&initial, &text, size(grid), &[&solved(grid + 1), &right]));
            let mut guess = initial;
            for cycle in 1..=cycles {
                last = format!("grid{grid}cycle{cycle}");
                passes.extend(self.passes(&last, n >> grid, Some(&guess), (&guess, 'y')));
                if grid > 0 || cycle < cycles {
                    guess = if cycle < cycles { format!("{last}end") } else { solved(grid) };
                    let mut end = pass(&guess, "", size(grid), &[]);
                    self.end(&last, &mut end);
                    passes.push(end);
                }
            }
        }
        self.end(&last, insert(project, passes, "field"));
    }
}

/// Returns the number of grids below one of `n` texels per side, down to one of two.
fn levels(n: u32) -> u32 {
    n.ilog2().max(2) - 1
}

/// Inserts passes right before another, which is returned.
pub fn insert<'p>(project: &'p mut Project, passes: Vec<Pass>, before: &str) -> &'p mut Pass {
    let id = super::super::setup::pass(before);
    let place = project.passes.iter().position(|p| p.id == id).expect("the project has the pass a cycle ends in");
    let end = place + passes.len();
    project.passes.splice(place..place, passes);
    &mut project.passes[end]
}

/// Returns a buffer of a grid, of (p, f) unless its name indicates that it contains only a right-hand side.
pub fn pass(name: &str, text: &str, size: PassSize, reads: &[&str]) -> Pass {
    let mut pass = Pass {
        id: PassName::buffer(name),
        source: Source { name: format!("buffer_{name}.glsl"), path: None, text: text.into() },
        bindings: channels(reads),
        settings: Default::default(),
        body: Default::default(),
    };
    pass.settings.size = size;
    pass.settings.format = if name.contains("rhs") { TexelFormat::R32f } else { TexelFormat::Rg32f };
    pass
}

/// Returns channels that read buffers texel by texel.
pub fn channels(reads: &[&str]) -> Bindings {
    let sampler = Sampler { filter: Filter::Nearest, wrap: Wrap::Repeat, vflip: true };
    reads.iter().map(|name| Channel { input: Input::buffer(*name), sampler }).enumerate().collect()
}
