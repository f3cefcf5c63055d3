//! A pass from its texts to a module, through every room of the compiler, and what comes of it.

use super::{
    check,
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

/// Returns what is wrong with a pass, without making a program of it: what an editor asks after each pause in typing.
/// Holds errors exactly where [`compile`] would fail.
pub fn diagnose(source: &PassSource<'_>) -> Vec<Diagnostic> {
    check_pass(source, &Link::default(), None).0.diagnostics
}

/// Returns the name of the function that most of a pass without errors lies in, with all calls written out.
pub fn bulk(source: &PassSource<'_>) -> Option<Span> {
    check_pass(source, &Link::default(), None).0.bulk
}

/// The expression that is probed, and the visit.
type Probed = Option<(hir::ExprId, u32)>;

/// Checks a pass, and finds what is probed in it.
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

/// Compiles one pass. On failure the list holds at least one error; warnings may stand among them.
pub fn compile(source: &PassSource<'_>) -> Result<Compiled, Diagnostics> {
    compile_linked(source, &Link::default(), None)
}

/// Compiles a pass, or one stage of a program that draws meshes. There the vertex stage comes first: what it gives
/// ([`super::Reflection::varyings`]) is part of the fragment stage's [`Link`]. The `preamble` is of the pass's own
/// Common; it saves time and changes nothing.
pub fn compile_linked(
    source: &PassSource<'_>,
    link: &Link<'_>,
    preamble: Option<&Preamble>,
) -> Result<Compiled, Diagnostics> {
    Ok(on_deep_stack(|| compile_seen(source, link, preamble, |_, _| {}))?)
}

/// The text of the intermediate representation of a pass, as lowering made it and after each pass of the optimiser; or
/// before and after the one of this name alone.
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

/// Compiles; `seen` gets the program under the name of each pass that made it.
pub(super) fn compile_seen(
    source: &PassSource<'_>,
    link: &Link<'_>,
    preamble: Option<&Preamble>,
    mut seen: impl FnMut(&str, &ir::Module),
) -> Result<Compiled, Vec<Diagnostic>> {
    let (pass, probed) = check_pass(source, link, preamble);
    if pass.has_errors() {
        return Err(pass.diagnostics);
    }
    let FrontEnd { module: mut checked, interface, diagnostics, .. } = pass;
    lower::arrays_to_constants(&mut checked, emit::LEAST_STORAGE_TABLE);
    let options = lower::Options {
        by_reference: source.driver.array_loops.then_some(emit::LEAST_COPY),
        table: emit::LEAST_UNIFORM_TABLE as usize,
    };
    let lower::Lowered { mut program, mut reflection, .. } =
        lower::lower(&checked, source, options, interface, probed, lower::Marks::default());
    opt::optimise(&mut program, source.driver.without, &mut seen);
    emit::work_arounds::apply(&mut program, source);
    ir::verify::assert_kept(&program, "work-arounds");
    seen("work-arounds", &program);
    let inlined_size = program.inlined_sizes().pop().unwrap_or(0);
    let emit::Emitted { module, tables, custom_uniform_bytes, initialized_arrays } =
        emit::emit(&program, source, &mut reflection);
    let emit::TableBytes { uniform: uniform_tables, storage: tables } = tables;
    let compiled = Compiled {
        module,
        reflection,
        tables,
        uniform_tables,
        custom_uniform_bytes,
        initialized_arrays,
        inlined_size,
        diagnostics,
    };
    // wgpu validates each module that it is given.
    if cfg!(debug_assertions)
        && let Err(bug) = compiled.validate()
    {
        return Err(compiled.diagnostics.into_iter().chain([bug]).collect());
    }
    Ok(compiled)
}

impl Compiled {
    /// Asks naga whether the module is valid, as wgpu does where a device gets it. An error is a bug of this compiler,
    /// never the author's.
    pub fn validate(&self) -> Result<(), Diagnostic> {
        on_deep_stack(|| emit::validate(&self.module)).map(drop).map_err(|reason| {
            let bug = format!("this is a bug in Eddy: the generated program is not valid: {reason}");
            Diagnostic::error(None, bug).hint("the program itself is correct; please report it with this text")
        })
    }
}

/// Checks Common the way the site does: alone, with only `iDate` and `iSampleRate` in scope. An empty list means that
/// the site would accept it; what it would refuse comes back as warnings, because Eddy runs such a project all the
/// same. `custom_uniforms` are those Common declares.
pub fn check_common(
    common: Text<'_>,
    includes: &[Include<'_>],
    custom_uniforms: &[CustomUniform<'_>],
) -> Vec<Diagnostic> {
    let parsed = parse::parse_common(&pieces::of(&[common], includes));
    // A Common that cannot be read is reported with each pass; only what is wrong with it alone is said here.
    if parsed.report.has_errors() {
        return Vec::new();
    }
    check::check_common(&parsed.ast, &parsed.origins, &parsed.names, custom_uniforms)
}

/// A pass that compiled.
#[derive(Clone, Debug)]
pub struct Compiled {
    /// Valid ([`Compiled::validate`]); one entry point named [`super::interface::ENTRY_POINT`], of a fragment shader
    /// but for [`super::PassKind::Vertex`].
    pub module: naga::Module,
    pub reflection: Reflection,
    /// Says what the storage buffer at [`super::interface::TABLE_BINDING`] holds; empty: the module declares none.
    pub tables: Vec<u8>,
    /// Says what the uniform buffer at [`super::interface::UNIFORM_TABLE_BINDING`] holds; empty: the module declares
    /// none.
    pub uniform_tables: Vec<u8>,
    /// Bytes that the module reads at [`super::interface::CUSTOM_UNIFORM_BINDING`]; 0: it declares nothing there.
    pub custom_uniform_bytes: u64,
    /// An array of at least so many scalars that has no initialiser is written before anything reads it, so that it
    /// need not begin with zeros. `None`: that was not asked for ([`super::Driver::array_loops`]), or no array is that
    /// long.
    pub initialized_arrays: Option<u32>,
    /// Statements of the program with all calls written out, as drivers compile it.
    pub inlined_size: u64,
    /// Warnings and notes; never an error.
    pub diagnostics: Vec<Diagnostic>,
}
