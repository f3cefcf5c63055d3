//! The compile boundary: GLSL ES 3.00 as Shadertoy's authors write it, in; a validated [`naga::Module`] and what it really
//! reads, out.
//!
//! Owns the language: preprocessor, parser, types, built-ins, lowering, [`Reflection`]. Needs no device, no file and no
//! clock, and is not told which project a pass belongs to. What the generated module looks like from outside (bind groups,
//! uniform block, entry point) is fixed in [`interface`], so that the GPU side can be written without reading this one.

pub(crate) mod ast;
pub(crate) mod builtins;
pub(crate) mod check;
pub(crate) mod emit;
pub(crate) mod hir;
pub mod interface;
pub(crate) mod ir;
mod lex;
pub(crate) mod lower;
mod near;
pub mod opt;
pub(crate) mod parse;
mod pieces;
mod preprocess;
pub mod reflection;
mod report;
pub mod services;
pub mod stages;
pub(crate) mod types;

pub use reflection::{ChannelUse, KnobSet, Reflection, UniformSet};
use stages::Interface;
pub use stages::{Attribute, Link, Varying};

use crate::diag::{Diagnostic, SourceId, Span};

/// Which entry point a pass defines, and which uniforms it may name.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum PassKind {
    /// `void mainImage(out vec4, in vec2)`; alpha is forced to 1; may call `st_assert`.
    Image,
    /// `void mainImage(out vec4, in vec2)`; all four channels are stored as written.
    Buffer,
    /// `void mainCubemap(out vec4, in vec2, in vec3, in vec3)`.
    Cubemap,
    /// `vec2 mainSound(int, float)`.
    Sound,
    /// `void main()` that sets `gl_Position`, once for each vertex of a mesh; see [`stages`].
    Vertex,
    /// `void main()` that sets `out` variables, once for each fragment of a mesh.
    Fragment,
}

impl PassKind {
    /// A stage of a program that draws meshes.
    pub fn is_stage(self) -> bool {
        matches!(self, PassKind::Vertex | PassKind::Fragment)
    }
}

/// The type `iChannelN` is declared with. A channel with no input is a `sampler2D`.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum ChannelKind {
    #[default]
    Sampler2D,
    Sampler3D,
    SamplerCube,
}

/// One text, and the id by which diagnostics shall point into it.
#[derive(Clone, Copy, Debug)]
pub struct Text<'a> {
    pub id: SourceId,
    pub text: &'a str,
}

/// A line of a text in whose place another text stands.
#[derive(Clone, Copy, Debug)]
pub struct Include<'a> {
    pub line: Span,
    pub text: Text<'a>,
}

/// A uniform that the author declares beside the language, in an `#iUniform` line. It is in scope everywhere in the texts of
/// the pass, as the site's own uniforms are.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Knob<'a> {
    pub name: &'a str,
    pub kind: KnobKind,
    /// Where its value lies in the block at [`interface::KNOB_BINDING`], in slots of [`interface::KNOB_BYTES`].
    pub slot: u16,
}

/// What a [`Knob`] is in GLSL.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum KnobKind {
    Bool,
    Int,
    Float,
    Vec2,
    Vec3,
    Vec4,
}

/// The value of a `uniform` that a text declares.
#[derive(Clone, Debug, PartialEq)]
pub struct UniformValue {
    pub name: String,
    pub value: GivenValue,
}

/// A value whose type only the declaration knows: lists are vectors, columns of matrices, matrices and arrays.
#[derive(Clone, Debug, PartialEq)]
pub enum GivenValue {
    Bool(bool),
    /// Holds every `int`, `uint` and `float`.
    Number(f64),
    List(Vec<GivenValue>),
}

/// Why nothing can be declared by `name`, if nothing can: it is a keyword, or the language or the site has it already.
pub fn taken(name: &str) -> Option<&'static str> {
    check::taken(name)
}

/// Everything the front end needs to know of a pass.
#[derive(Clone, Copy, Debug)]
pub struct PassSource<'a> {
    pub kind: PassKind,
    pub common: Option<Text<'a>>,
    pub code: Text<'a>,
    /// Of all texts of the pass, those in includes among them; no text includes itself.
    pub includes: &'a [Include<'a>],
    pub channels: [ChannelKind; 4],
    /// Of all texts of the pass, each name once.
    pub knobs: &'a [Knob<'a>],
    /// Of uniforms that a text of the pass may declare, each name once; those it does not declare mean nothing.
    pub values: &'a [UniformValue],
    /// Channels whose texture this device cannot filter though the project asks for it: every filtered read of them is
    /// written as four fetches and a mix (section 8.13 of the OpenGL ES 3.0 specification gives the weights).
    pub bilinear_by_hand: [bool; 4],
    pub driver: Driver,
}

impl<'a> PassSource<'a> {
    /// Returns a pass that is one text alone, with four `sampler2D` channels, for a driver that wants nothing special.
    pub fn new(kind: PassKind, code: Text<'a>) -> Self {
        PassSource {
            kind,
            common: None,
            code,
            includes: &[],
            channels: [ChannelKind::Sampler2D; 4],
            knobs: &[],
            values: &[],
            bilinear_by_hand: [false; 4],
            driver: Driver::default(),
        }
    }

    /// Returns an Image pass that is this text alone. Diagnostics point into `SourceId(0)`.
    pub fn image(text: &'a str) -> Self {
        Self::new(PassKind::Image, Text { id: SourceId(0), text })
    }
}

/// What the driver that will run a pass needs of its code; none of it changes a picture.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Driver {
    /// The device reads no storage buffers in a fragment shader: large constant tables are then memory of each invocation,
    /// which costs time to fill.
    pub tables_in_memory: bool,
    /// The driver compiles a program anew for every frame, and keeps what it made, where a branch depends on uniforms alone:
    /// they are read so that it takes them for values of the pixel. Mesa's lavapipe does so (`lvp_inline_uniforms.c`).
    pub opaque_uniforms: bool,
    /// A fragment stage has to be one that may discard, though it never does: Mesa's llvmpipe goes wrong where others fail the
    /// depth test of a target of 16-bit floats.
    pub may_discard: bool,
    /// The angle of (0, 0) is no number on the device: `atan` asks for another one's.
    pub nan_angle: bool,
    /// Long arrays are filled, also with the zeros that they begin with, and copied by loops ([`Compiled::filled_arrays`]):
    /// Mesa's lavapipe takes minutes to compile stores of some hundred scalars one by one.
    pub array_loops: bool,
    /// Each loop that can change variables before its first exit begins with an exit that is never taken. Mesa's gallivm runs a
    /// loop until its last pixel leaves, and does not bring it into loop-closed SSA form (`nir_to_lcssa.c`): a value that all
    /// exits agree on, and which needs no phi for that, is computed anew for pixels that have left.
    pub loop_closing_exits: bool,
    /// What a loop counts down to is hidden: Mesa takes `min(c, x)` for at least `c` there (`nir_loop_analyze.c`).
    pub hidden_limits: bool,
    /// Passes of the optimiser that are left out: for who works on the compiler.
    pub without: opt::PassSet,
}

/// A pass that compiled.
#[derive(Clone, Debug)]
pub struct Compiled {
    /// Validated; one entry point named [`interface::ENTRY_POINT`], of a fragment shader but for [`PassKind::Vertex`].
    pub module: naga::Module,
    pub reflection: Reflection,
    /// What the storage buffer at [`interface::TABLE_BINDING`] holds; empty: the module declares none.
    pub tables: Vec<u8>,
    /// What the uniform buffer at [`interface::UNIFORM_TABLE_BINDING`] holds; empty: the module declares none.
    pub uniform_tables: Vec<u8>,
    /// Bytes that the module reads at [`interface::KNOB_BINDING`]; 0: it declares nothing there.
    pub knob_bytes: u64,
    /// Of a variable without an initialiser, an array of at least so many scalars is written before anything reads it, so that it
    /// need not begin with zeros. `None`: that was not asked for ([`Driver::array_loops`]), or no array is that long.
    pub filled_arrays: Option<u32>,
    /// Warnings and notes; never an error.
    pub diagnostics: Vec<Diagnostic>,
}

/// What is wrong with a pass, without making a program of it: what an editor asks after each pause in typing. Holds errors
/// exactly where [`compile`] would fail.
pub fn diagnose(source: &PassSource<'_>) -> Vec<Diagnostic> {
    check_pass(source).1
}

fn check_pass(source: &PassSource<'_>) -> (hir::Module, Vec<Diagnostic>) {
    check_linked(source, &Link::default()).0
}

/// As [`check_pass`], with what the rest of the program says of a stage.
fn check_linked(source: &PassSource<'_>, link: &Link<'_>) -> ((hir::Module, Vec<Diagnostic>), Interface) {
    let parsed = parse::parse(source);
    let mut checked = check::check(&parsed.ast, &parsed.origins, &parsed.names, source);
    let interface =
        stages::interface(&checked.module, &parsed.names, &parsed.origins, source.kind, link, &mut checked.diagnostics);
    let mut all = report::Report::default();
    parsed.diagnostics.into_iter().chain(checked.diagnostics).for_each(|d| all.add(d));
    // As the author reads the text.
    all.diagnostics.sort_by_key(|d| d.span.map(|s| (s.source, s.start)));
    ((checked.module, all.diagnostics), interface)
}

/// Compiles one pass. On failure the list holds at least one error; warnings may stand among them.
pub fn compile(source: &PassSource<'_>) -> Result<Compiled, Vec<Diagnostic>> {
    compile_linked(source, &Link::default())
}

/// Compiles one stage of a program that draws meshes. The vertex stage comes first: what it gives
/// ([`Reflection::varyings`]) is part of the fragment stage's [`Link`].
pub fn compile_linked(source: &PassSource<'_>, link: &Link<'_>) -> Result<Compiled, Vec<Diagnostic>> {
    compile_seen(source, link, |_, _| {})
}

/// The text of the intermediate representation of a pass, as lowering made it and after each pass of the optimiser; or before
/// and after the one of this name alone.
pub fn dump_ir(source: &PassSource<'_>, link: &Link<'_>, pass: Option<&str>) -> Result<String, Vec<Diagnostic>> {
    let mut out = String::new();
    let mut before: Option<(String, String)> = None;
    compile_seen(source, link, |name, program| {
        let mut write = |name: &str, text: &str| out.push_str(&format!("; after {name}\n{text}\n"));
        let text = ir::print::print(program);
        match pass {
            None => write(name, &text),
            Some(pass) if pass == name => {
                if let Some((name, text)) = &before {
                    write(name, text);
                }
                write(name, &text);
            }
            Some(_) => before = Some((name.to_owned(), text)),
        }
    })?;
    Ok(out)
}

/// Compiles; `seen` gets the program under the name of each pass that made it.
fn compile_seen(
    source: &PassSource<'_>,
    link: &Link<'_>,
    seen: impl FnMut(&str, &ir::Module),
) -> Result<Compiled, Vec<Diagnostic>> {
    let ((mut checked, mut diagnostics), interface) = check_linked(source, link);
    if diagnostics.iter().any(Diagnostic::is_error) {
        return Err(diagnostics);
    }
    lower::arrays_to_constants(&mut checked);
    let lower::Lowered { mut program, mut reflection } = lower::lower(&checked, source, interface);
    opt::optimise(&mut program, source.driver.without, seen);
    let emit::Emitted { module, tables, knob_bytes, filled_arrays } = emit::emit(&program, source, &mut reflection);
    if let Err(reason) = emit::validate(&module) {
        let bug =
            Diagnostic::error(None, format!("this is a bug in Eddy: the generated program is not valid: {reason}"));
        diagnostics.push(bug.hint("the program itself is right; please report it with this text"));
        return Err(diagnostics);
    }
    let emit::TableBytes { uniform: uniform_tables, storage: tables } = tables;
    Ok(Compiled { module, reflection, tables, uniform_tables, knob_bytes, filled_arrays, diagnostics })
}

/// Checks Common the way the site does: alone, with only `iDate` and `iSampleRate` in scope. An empty list means that the
/// site would accept it; what it would refuse comes back as warnings, because Eddy runs such a project all the same. `knobs` are those Common declares.
pub fn check_common(common: Text<'_>, includes: &[Include<'_>], knobs: &[Knob<'_>]) -> Vec<Diagnostic> {
    let pieces = pieces::of(&[common], includes);
    let parsed = parse::parse_texts(&pieces, preprocess::Unit::CommonAlone);
    let refused = parsed.diagnostics.iter().any(Diagnostic::is_error);
    // A Common that cannot be read is reported with each pass; only what is wrong with it alone is said here.
    if refused { Vec::new() } else { check::check_common(&parsed.ast, &parsed.origins, &parsed.names, knobs) }
}
