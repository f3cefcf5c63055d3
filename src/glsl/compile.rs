//! The pipeline that compiles a pass from its texts to a module, and its results.

use super::{
    ast::Origins,
    check,
    count::{Counting, Prepared},
    diagnostics::Diagnostics,
    emit,
    front_end::FrontEnd,
    hir, ir, lower, opt, parse, pieces,
    preamble::Preamble,
    probe,
    reflection::Reflection,
    source::{CustomUniform, Include, PassSource, Text},
    stack::on_deep_stack,
    stages::Link,
};
use eddy_diag::{Diagnostic, Span};

/// Returns the diagnostics of a pass without generating a program: an editor requests them after each pause in typing.
/// There are errors exactly where [`compile`] would fail.
pub fn diagnose(source: &PassSource<'_>) -> Vec<Diagnostic> {
    check_pass(source, &Link::default(), None).0.diagnostics
}

/// Returns the name of the function that makes up the largest part of an error-free pass, with all calls inlined.
pub fn largest_function(source: &PassSource<'_>) -> Option<Span> {
    check_pass(source, &Link::default(), None).0.largest_function
}

/// The expression that is probed, and the visit.
type Probed = Option<(hir::ExprId, u32)>;

/// Checks a pass, and finds the probed expression in it.
fn check_pass(source: &PassSource<'_>, link: &Link<'_>, preamble: Option<&Preamble>) -> (FrontEnd, Probed) {
    let mut pass = FrontEnd::run(source, link, preamble);
    let Some(wanted) = source.probe else { return (pass, None) };
    let Some((expr, _)) = probe::find(&pass.module, &pass.origins, &wanted) else {
        let nothing = "there is nothing to probe here: put the caret on an expression";
        pass.diagnostics.push(Diagnostic::error(None, nothing));
        return (pass, None);
    };
    (pass, Some((expr, wanted.visit)))
}

/// Compiles one pass. On failure the list contains at least one error, and possibly warnings.
pub fn compile(source: &PassSource<'_>) -> Result<Compiled, Diagnostics> {
    compile_linked(source, &Link::default(), None)
}

/// Compiles a pass, or one stage of a program that draws meshes. Compile the vertex stage first: its outputs
/// ([`super::Reflection::varyings`]) are part of the fragment stage's [`Link`]. The `preamble` is that of the pass's
/// own Common; it saves time and does not change the result.
pub fn compile_linked(
    source: &PassSource<'_>,
    link: &Link<'_>,
    preamble: Option<&Preamble>,
) -> Result<Compiled, Diagnostics> {
    Ok(on_deep_stack(|| compile_seen(source, link, preamble, |_, _| {}))?)
}

/// Returns the text of the intermediate representation of a pass after lowering and after each pass of the optimiser;
/// with `pass`, only before and after the optimiser pass of that name.
pub fn dump_ir(
    source: &PassSource<'_>,
    link: &Link<'_>,
    preamble: Option<&Preamble>,
    pass: Option<&str>,
) -> Result<String, Vec<Diagnostic>> {
    let mut out = String::new();
    let mut before: Option<(String, String)> = None;
    let seen = |name: &str, program: &ir::Module| {
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
    };
    on_deep_stack(|| compile_seen(source, link, preamble, seen))?;
    Ok(out)
}

/// An optimised program, before work-arounds for drivers.
struct Lowered {
    program: ir::Module,
    reflection: Reflection,
    origins: Origins,
    /// Warnings and notes.
    diagnostics: Vec<Diagnostic>,
}

fn lowered(
    source: &PassSource<'_>,
    link: &Link<'_>,
    preamble: Option<&Preamble>,
    seen: &mut impl FnMut(&str, &ir::Module),
) -> Result<Lowered, Vec<Diagnostic>> {
    let (pass, probed) = check_pass(source, link, preamble);
    if pass.has_errors() {
        return Err(pass.diagnostics);
    }
    let FrontEnd { module: mut checked, interface, diagnostics, origins, .. } = pass;
    lower::arrays_to_constants(&mut checked, emit::MIN_STORAGE_TABLE);
    let options = lower::Options {
        by_reference: source.driver.array_loops.then_some(emit::MIN_COPY),
        table: emit::MIN_UNIFORM_TABLE as usize,
    };
    let lower::Lowered { mut program, reflection, .. } =
        lower::lower(&checked, source, options, interface, probed, lower::Marks::default());
    opt::optimise(&mut program, source.driver.disabled_optimisations, seen);
    Ok(Lowered { program, reflection, origins, diagnostics })
}

/// Divides a pass into blocks. Also returns what it reads, and its warnings and notes.
pub(super) fn prepare_counting(
    source: &PassSource<'_>,
    link: &Link<'_>,
    preamble: Option<&Preamble>,
) -> Result<(Prepared, Reflection, Vec<Diagnostic>), Vec<Diagnostic>> {
    let Lowered { program, reflection, origins, diagnostics } = lowered(source, link, preamble, &mut |_, _| {})?;
    Ok((Prepared::new(program, source, &origins), reflection, diagnostics))
}

/// Compiles the counting variants of a pass: see [`Counting::new`].
pub(super) fn compile_counting(
    source: &PassSource<'_>,
    link: &Link<'_>,
    preamble: Option<&Preamble>,
    per_draw: usize,
) -> Result<Counting, Vec<Diagnostic>> {
    let (prepared, reflection, diagnostics) = prepare_counting(source, link, preamble)?;
    let counters = prepared.table.counters;
    let mut variants = Vec::new();
    for start in (0..counters).step_by(per_draw) {
        source.cancel.check();
        let mut program = prepared.variant(start..(start + per_draw).min(counters));
        ir::verify::assert_kept(&program, "counting");
        emit::work_arounds::apply(&mut program, source);
        let mut reflection = reflection.clone();
        let emitted = emit::emit(&program, source, &mut reflection);
        variants.push(finished(emitted, 0, reflection, diagnostics.clone())?);
    }
    Ok(Counting { table: prepared.table, variants, per_draw })
}

/// Compiles a pass; `seen` is called with the program after each compiler pass, and the name of that pass.
pub(super) fn compile_seen(
    source: &PassSource<'_>,
    link: &Link<'_>,
    preamble: Option<&Preamble>,
    mut seen: impl FnMut(&str, &ir::Module),
) -> Result<Compiled, Vec<Diagnostic>> {
    let Lowered { mut program, mut reflection, diagnostics, .. } = lowered(source, link, preamble, &mut seen)?;
    let specialisable = opt::specialise::Specialisable::new(&program).filter(|_| !source.kind.is_plain());
    for (channel, read) in reflection.channels.iter_mut().zip(opt::specialise::Reads::of(&program).channels) {
        (channel.texels, channel.components) = (read.texels, read.components);
    }
    emit::work_arounds::apply(&mut program, source);
    ir::verify::assert_kept(&program, "work-arounds");
    seen("work-arounds", &program);
    let inlined_size = program.inlined_sizes().pop().unwrap_or(0);
    let emitted = emit::emit(&program, source, &mut reflection);
    Ok(Compiled { specialisable, ..finished(emitted, inlined_size, reflection, diagnostics)? })
}

fn finished(
    emitted: emit::Emitted,
    inlined_size: u64,
    reflection: Reflection,
    diagnostics: Vec<Diagnostic>,
) -> Result<Compiled, Vec<Diagnostic>> {
    let emit::Emitted { module, tables, custom_uniform_bytes, initialized_arrays } = emitted;
    let emit::TableBytes { uniform: uniform_tables, storage: tables } = tables;
    let compiled = Compiled {
        module,
        reflection,
        tables,
        uniform_tables,
        custom_uniform_bytes,
        initialized_arrays,
        inlined_size,
        specialisable: None,
        diagnostics,
    };
    // wgpu validates every module that it receives.
    if cfg!(debug_assertions)
        && let Err(bug) = compiled.validate()
    {
        return Err(compiled.diagnostics.into_iter().chain([bug]).collect());
    }
    Ok(compiled)
}

impl Compiled {
    /// Validates the module with naga, as wgpu does when it creates a shader. An error is a bug of this compiler, never
    /// the author's.
    pub fn validate(&self) -> Result<(), Diagnostic> {
        on_deep_stack(|| emit::validate(&self.module)).map(drop).map_err(|reason| {
            let bug = format!("this is a bug in Eddy: the generated program is not valid: {reason}");
            Diagnostic::error(None, bug).hint("the program itself is correct; please report it with this text")
        })
    }
}

/// Checks Common as Shadertoy does: alone, with only `iDate` and `iSampleRate` in scope. An empty list means that
/// Shadertoy would accept it; what it would reject is returned as warnings, because Eddy runs such a project anyway.
/// `custom_uniforms` are those that Common declares.
pub fn check_common(
    common: Text<'_>,
    includes: &[Include<'_>],
    custom_uniforms: &[CustomUniform<'_>],
) -> Vec<Diagnostic> {
    let parsed = parse::parse_common(&pieces::of(&[common], includes, false));
    // A Common that does not parse is reported with each pass; only errors of Common alone are reported here.
    if parsed.report.has_errors() {
        return Vec::new();
    }
    check::check_common(&parsed.ast, &parsed.origins, &parsed.names, custom_uniforms)
}

/// A pass that compiled.
#[derive(Clone, Debug)]
pub struct Compiled {
    /// Valid ([`Compiled::validate`]). It has one entry point, named [`super::interface::ENTRY_POINT`]: a fragment
    /// shader, except for [`super::PassKind::Vertex`].
    pub module: naga::Module,
    pub reflection: Reflection,
    /// The contents of the storage buffer at [`super::interface::TABLE_BINDING`]; if empty, the module declares none.
    pub tables: Vec<u8>,
    /// The contents of the uniform buffer at [`super::interface::UNIFORM_TABLE_BINDING`]; if empty, the module declares
    /// none.
    pub uniform_tables: Vec<u8>,
    /// Bytes that the module reads at [`super::interface::CUSTOM_UNIFORM_BINDING`]; if 0, it declares nothing there.
    pub custom_uniform_bytes: u64,
    /// Arrays of at least this many scalars that have no initialiser are written before they are read, so that they
    /// need not be zeroed first. `None` if this was not requested ([`super::Driver::array_loops`]), or if no array is
    /// that long.
    pub initialized_arrays: Option<u32>,
    /// Statements of the program with all calls inlined, which is what drivers compile.
    pub inlined_size: u64,
    /// For finding out what it reads at given values of custom uniforms; `None` if it is very large or a plain shader.
    pub specialisable: Option<opt::specialise::Specialisable>,
    /// Warnings and notes; never an error.
    pub diagnostics: Vec<Diagnostic>,
}
