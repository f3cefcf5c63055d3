//! A pass in the form that the CPU interpreter (`walk`) runs: lowered, without optimiser passes and work-arounds, and
//! with the names and spans of the author's text.

pub use super::lower::{Precondition, StatementEvent, UnsetKind};

use super::{
    PassSource,
    ast::{Interner, Loc, Origins},
    check, emit,
    front_end::FrontEnd,
    ir, lower,
    preamble::Preamble,
    stack::on_deep_stack,
    stages::{Link, Varying},
    statements::Statements,
    types::{StructId, TypeId},
    unsequenced,
};
use eddy_diag::{Diagnostic, Span};

/// A program to interpret.
pub struct Walkable {
    pub program: ir::Module,
    names: lower::Names,
    origins: Origins,
    interner: Interner,
    statements: Statements,
    /// Expressions that depend on an undefined order of evaluation, and what is undefined there.
    unsequenced: Vec<(Loc, &'static str)>,
    /// Operations on constants whose results are undefined or not finite numbers.
    faults: Vec<check::Fault>,
    /// Every type as GLSL writes it, by its id; empty unless the program is lowered for stepping.
    type_texts: Vec<String>,
    /// The outputs of a vertex stage.
    pub varyings: Vec<Varying>,
}

/// A value that GLSL leaves undefined, with the declaration that should have initialised it.
#[derive(Clone, Copy, Debug)]
pub struct Unset<'w> {
    /// The zero in its place; or a variable of the function that has no value when the function starts.
    pub value: ir::Value,
    pub kind: UnsetKind,
    pub name: &'w str,
    /// The span of the name.
    pub span: Span,
}

/// The purpose that a program is lowered for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Detail {
    /// Its values are read.
    Values,
    /// It is stepped through, statement by statement.
    Statements,
}

impl Walkable {
    /// Lowers a pass, or a stage of a program that draws meshes. For `preamble` see [`super::compile_linked`]. On
    /// failure the list contains at least one error.
    pub fn new(
        source: &PassSource<'_>,
        link: &Link<'_>,
        preamble: Option<&Preamble>,
        detail: Detail,
    ) -> Result<Self, Vec<Diagnostic>> {
        on_deep_stack(|| Self::lowered(source, FrontEnd::run(source, link, preamble), detail))
    }

    fn lowered(source: &PassSource<'_>, pass: FrontEnd, detail: Detail) -> Result<Self, Vec<Diagnostic>> {
        if pass.has_errors() {
            return Err(pass.diagnostics);
        }
        let is_marked = detail == Detail::Statements;
        let FrontEnd { module, interface, faults, origins, names: interner, .. } = pass;
        let varyings = interface.varyings.clone();
        let marks = lower::Marks { undefined: true, statements: is_marked };
        let options = lower::Options { by_reference: None, table: emit::MIN_UNIFORM_TABLE as usize };
        let lower::Lowered { program, names, .. } = lower::lower(&module, source, options, interface, None, marks);
        ir::verify::assert_kept(&program, "lower");
        let (mut statements, mut type_texts) = Default::default();
        if is_marked {
            statements = Statements::new(&module, &origins, &interner);
            let types = (0..module.types.len()).map(|index| TypeId(index as u32));
            type_texts = types.map(|ty| module.type_text(&interner, ty)).collect();
        }
        let unsequenced = unsequenced::find(&module);
        Ok(Self { program, names, origins, interner, statements, unsequenced, faults, type_texts, varyings })
    }

    /// Returns what is undefined about an expression if it depends on an undefined order of evaluation.
    pub fn unsequenced(&self, loc: Loc) -> Option<&'static str> {
        self.unsequenced.iter().find(|(place, _)| *place == loc).map(|(_, what)| *what)
    }

    /// Returns the operations on constants whose results are undefined, or infinities of finite numbers: the span of
    /// each, whether it is undefined, and its description.
    pub fn faults(&self) -> impl Iterator<Item = (Span, bool, &'static str)> {
        let span = |fault: &check::Fault| (self.origins.span(fault.loc), fault.is_undefined, fault.what);
        self.faults.iter().map(span)
    }

    /// Returns the statements that the marks of a program lowered for stepping refer to.
    pub fn statements(&self) -> &Statements {
        &self.statements
    }

    /// Returns the values of a function that mark statement events.
    pub fn marks(&self, function: ir::FuncId) -> &[(ir::Value, StatementEvent)] {
        &self.names.functions[function.index()].marks
    }

    /// Returns the author's variables of a function: each with its index in [`Statements::locals`], and its value or
    /// place.
    pub fn variables(&self, function: ir::FuncId) -> impl Iterator<Item = (u32, ir::Value)> {
        let names = &self.names.functions[function.index()];
        names.ids.iter().zip(&names.locals).map(|(id, &(_, value))| (id.index() as u32, value))
    }

    /// Returns the author's globals that exist in the program, with their names.
    pub fn globals(&self) -> impl Iterator<Item = (&str, ir::GlobalId)> {
        self.names.globals.iter().map(|&(symbol, id, _)| (self.interner.get(symbol), id))
    }

    /// Returns the globals that the device fills: the `in` variables of a stage.
    pub fn inputs(&self) -> impl Iterator<Item = ir::GlobalId> {
        let entry = self.program.functions.last();
        let filled = |stmt: &ir::Stmt, entry: &ir::Function| {
            let ir::Stmt::Store { place, value } = stmt else { return None };
            let is_input =
                matches!(entry[*value], ir::Op::Input(ir::Input::Attribute { .. } | ir::Input::Varying { .. }));
            match entry[entry.root(*place)] {
                ir::Op::Global(global) if is_input => Some(global),
                _ => None,
            }
        };
        entry.into_iter().flat_map(move |entry| entry.body.iter().filter_map(move |stmt| filled(stmt, entry)))
    }

    /// Returns a type as GLSL writes it.
    pub fn type_text(&self, ty: TypeId) -> &str {
        self.type_texts.get(ty.0 as usize).map_or("", String::as_str)
    }

    /// Returns the span of a location: for a macro expansion, that of the macro's use.
    pub fn span(&self, loc: Loc) -> Span {
        self.origins.span(loc)
    }

    /// Returns the name of a function; `None` for generated code.
    pub fn function_name(&self, function: ir::FuncId) -> Option<&str> {
        self.names.functions[function.index()].name.map(|symbol| self.interner.get(symbol))
    }

    /// Returns the author's variables of a function: each with its name, and its value or place.
    pub fn locals(&self, function: ir::FuncId) -> impl Iterator<Item = (&str, ir::Value)> {
        self.names.functions[function.index()].locals.iter().map(|&(symbol, value)| (self.interner.get(symbol), value))
    }

    /// Returns the values of a function that replace values which GLSL leaves undefined.
    pub fn undefined(&self, function: ir::FuncId) -> impl Iterator<Item = Unset<'_>> {
        let undefined = |unset: &lower::Unset| Unset {
            value: unset.value,
            kind: unset.kind,
            name: self.interner.get(unset.name),
            span: self.span(unset.loc),
        };
        self.names.functions[function.index()].undefined.iter().map(undefined)
    }

    /// Returns the author's globals that have no value when the program starts.
    pub fn undefined_globals(&self) -> impl Iterator<Item = (ir::GlobalId, &str, Span)> {
        let is_unset = |id: ir::GlobalId| matches!(self.program[id].kind, ir::GlobalKind::Private(None));
        let unset = self.names.globals.iter().filter(move |(_, id, _)| is_unset(*id));
        unset.map(|&(symbol, id, loc)| (id, self.interner.get(symbol), self.span(loc)))
    }

    /// Returns the precondition that lowering ensures for an operation, or what the result of a call depends on.
    pub fn precondition(&self, function: ir::FuncId, value: ir::Value) -> Option<&Precondition> {
        self.names.preconditions.get(&(function, value))
    }

    /// Returns the name of a member of a structure.
    pub fn member_name(&self, structure: StructId, index: u32) -> &str {
        self.interner.get(self.names.members[structure.index()][index as usize])
    }

    /// Returns the author's name of a global.
    pub fn global_name(&self, global: ir::GlobalId) -> Option<&str> {
        let named = self.names.globals.iter().find(|(_, id, _)| *id == global);
        named.map(|&(symbol, ..)| self.interner.get(symbol))
    }
}
