//! A pass as the walker takes it: lowered, with no pass of the optimiser and no work-around, and with the names and
//! places of the author's text.

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

/// A program to walk through.
pub struct Walkable {
    pub program: ir::Module,
    names: lower::Names,
    origins: Origins,
    interner: Interner,
    statements: Statements,
    /// Expressions that lean on an order which is undefined, and what is open there.
    unsequenced: Vec<(Loc, &'static str)>,
    /// Operations on constants whose results are open or no finite numbers.
    faults: Vec<check::Fault>,
    /// Every type as GLSL writes it, by its id; none where nobody steps through the program.
    type_texts: Vec<String>,
    /// Holds what a stage of vertices hands on.
    pub varyings: Vec<Varying>,
}

/// A value that GLSL leaves undefined, by the declaration that should have given it one.
#[derive(Clone, Copy, Debug)]
pub struct Unset<'w> {
    /// The zero in its place; or a variable of the function that has no value when the function starts.
    pub value: ir::Value,
    pub kind: UnsetKind,
    pub name: &'w str,
    /// The place of the name.
    pub span: Span,
}

/// Says what a program is lowered for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Detail {
    /// Somebody looks at its values.
    Values,
    /// Somebody steps through it, statement by statement.
    Statements,
}

impl Walkable {
    /// Lowers a pass, or a stage of a program that draws meshes. The `preamble` is as [`super::compile_linked`] has it. On
    /// failure the list holds at least one error.
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
        let options = lower::Options { by_reference: None, table: emit::LEAST_UNIFORM_TABLE as usize };
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

    /// Returns what an expression leans on, if that is an order of evaluation which the language leaves open.
    pub fn unsequenced(&self, loc: Loc) -> Option<&'static str> {
        self.unsequenced.iter().find(|(place, _)| *place == loc).map(|(_, what)| *what)
    }

    /// The operations on constants whose results are undefined, or infinities of finite numbers: the place of each,
    /// whether it is undefined, and what it is.
    pub fn faults(&self) -> impl Iterator<Item = (Span, bool, &'static str)> {
        let span = |fault: &check::Fault| (self.origins.span(fault.loc), fault.is_undefined, fault.what);
        self.faults.iter().map(span)
    }

    /// Returns what the marks of a program that is stepped through stand for.
    pub fn statements(&self) -> &Statements {
        &self.statements
    }

    /// The values of a function that say where control comes to.
    pub fn marks(&self, function: ir::FuncId) -> &[(ir::Value, StatementEvent)] {
        &self.names.functions[function.index()].marks
    }

    /// The author's variables of a function: each by its place in [`Statements::locals`], with the value or place that
    /// it is.
    pub fn variables(&self, function: ir::FuncId) -> impl Iterator<Item = (u32, ir::Value)> {
        let names = &self.names.functions[function.index()];
        names.ids.iter().zip(&names.locals).map(|(id, &(_, value))| (id.index() as u32, value))
    }

    /// The author's variables of the module that the program has, with their names.
    pub fn globals(&self) -> impl Iterator<Item = (&str, ir::GlobalId)> {
        self.names.globals.iter().map(|&(symbol, id, _)| (self.interner.get(symbol), id))
    }

    /// The variables of the module that the device fills: the `in` variables of a stage.
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

    /// A type as GLSL writes it.
    pub fn type_text(&self, ty: TypeId) -> &str {
        self.type_texts.get(ty.0 as usize).map_or("", String::as_str)
    }

    /// Returns where a value is written: for what a macro brought in, the use of the macro.
    pub fn span(&self, loc: Loc) -> Span {
        self.origins.span(loc)
    }

    /// The name of a function; none of the code around the author's.
    pub fn function_name(&self, function: ir::FuncId) -> Option<&str> {
        self.names.functions[function.index()].name.map(|symbol| self.interner.get(symbol))
    }

    /// The author's variables of a function: each with its name and the value or place that it is.
    pub fn locals(&self, function: ir::FuncId) -> impl Iterator<Item = (&str, ir::Value)> {
        self.names.functions[function.index()].locals.iter().map(|&(symbol, value)| (self.interner.get(symbol), value))
    }

    /// The values of a function that stand for what GLSL leaves undefined.
    pub fn undefined(&self, function: ir::FuncId) -> impl Iterator<Item = Unset<'_>> {
        let undefined = |unset: &lower::Unset| Unset {
            value: unset.value,
            kind: unset.kind,
            name: self.interner.get(unset.name),
            span: self.span(unset.loc),
        };
        self.names.functions[function.index()].undefined.iter().map(undefined)
    }

    /// The author's variables of the module that have no value when the program starts.
    pub fn undefined_globals(&self) -> impl Iterator<Item = (ir::GlobalId, &str, Span)> {
        let is_unset = |id: ir::GlobalId| matches!(self.program[id].kind, ir::GlobalKind::Private(None));
        let unset = self.names.globals.iter().filter(move |(_, id, _)| is_unset(*id));
        unset.map(|&(symbol, id, loc)| (id, self.interner.get(symbol), self.span(loc)))
    }

    /// Returns what lowering keeps a device from at an operation, or what the result of a call depends on.
    pub fn precondition(&self, function: ir::FuncId, value: ir::Value) -> Option<&Precondition> {
        self.names.preconditions.get(&(function, value))
    }

    /// The name of a member of a structure.
    pub fn member_name(&self, structure: StructId, index: u32) -> &str {
        self.interner.get(self.names.members[structure.index()][index as usize])
    }

    /// The author's name of a variable of the module.
    pub fn global_name(&self, global: ir::GlobalId) -> Option<&str> {
        let named = self.names.globals.iter().find(|(_, id, _)| *id == global);
        named.map(|&(symbol, ..)| self.interner.get(symbol))
    }
}
