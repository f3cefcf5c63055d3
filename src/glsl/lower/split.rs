//! Vectors, matrices and structures in memory, taken apart into scalars.
//!
//! OpenGL's compilers do that before all else; a SPIR-V driver keeps a vector that a branch or a loop writes as a whole (lavapipe,
//! in the phis of its SSA form). Then a component that nobody reads is computed all the same, and what puts vectors together
//! counts as work: loops just short enough to be written out, and branches just short enough to become selects, are so with
//! OpenGL only.

use naga::{
    Arena, Block, Expression, Function, Handle, LocalVariable, Range, SampleLevel, Span, Statement, Type, TypeInner,
    UniqueArena,
};

use naga::proc::TypeResolution;

use super::function::Value;

/// What holds more scalars stays memory: to copy it takes an instruction, not one for each of them. Structures that
/// people write have some dozens.
pub(super) const MOST_SCALARS: usize = 256;

/// Takes apart the variables of a function that nothing but loads, stores and constant indices touch: no call is given a pointer
/// to them. What holds an array stays as it is, and what begins with a value.
pub(super) fn split(f: &mut Function, types: &mut UniqueArena<Type>) {
    let mut scalars: Vec<_> = f
        .local_variables
        .iter()
        .map(|(_, variable)| {
            let mut scalars = Vec::new();
            let mut count = 0;
            count_scalars(types, variable.ty, &mut count);
            let whole =
                variable.init.is_some() || count > MOST_SCALARS || !scalars_of(types, variable.ty, &mut scalars);
            if whole || scalars.len() == 1 { Vec::new() } else { scalars }
        })
        .collect();
    let pointers = pointers(f, types, &scalars);
    let mut keep = |pointer: Value| {
        if let Some(pointer) = pointers[pointer.index()] {
            scalars[pointer.variable.index()].clear();
        }
    };
    for (_, expression) in f.expressions.iter() {
        if let Expression::Access { base, .. } = expression {
            keep(*base);
        }
    }
    each_argument(&f.body, &mut keep);
    if scalars.iter().all(Vec::is_empty) {
        return;
    }
    let mut made = Arena::new();
    let mut variables = Arena::new();
    let mut whole = Vec::with_capacity(scalars.len());
    let mut parts = Vec::with_capacity(scalars.len());
    for ((_, variable, span), scalars) in f.local_variables.drain().zip(scalars) {
        whole.push(scalars.is_empty().then(|| variables.append(variable, span)));
        let pointer = |ty| {
            let variable = variables.append(LocalVariable { name: None, ty, init: None }, Span::UNDEFINED);
            made.append(Expression::LocalVariable(variable), Span::UNDEFINED)
        };
        parts.push(scalars.into_iter().map(pointer).collect());
    }
    let expressions = std::mem::take(&mut f.expressions);
    let mut split =
        Split { types, pointers, whole, parts, made, new: Vec::with_capacity(expressions.len()), starts: Vec::new() };
    for (i, expression) in expressions.into_inner().into_iter().enumerate() {
        split.starts.push(split.made.len() as u32);
        let new = split.expression(i, expression);
        split.new.push(new);
    }
    split.starts.push(split.made.len() as u32);
    for init in variables.iter_mut().filter_map(|(_, variable)| variable.init.as_mut()) {
        *init = split.value(*init);
    }
    split.block(&mut f.body);
    f.expressions = split.made;
    f.local_variables = variables;
}

/// A part of a variable.
#[derive(Clone, Copy)]
struct Pointer {
    variable: Handle<LocalVariable>,
    /// How many scalars of the variable precede it.
    before: usize,
    ty: Handle<Type>,
}

struct Split<'a> {
    types: &'a UniqueArena<Type>,
    /// Old expressions that point into variables.
    pointers: Vec<Option<Pointer>>,
    /// What became of variables that stay whole.
    whole: Vec<Option<Handle<LocalVariable>>>,
    /// Pointers to the scalars of the others.
    parts: Vec<Vec<Value>>,
    made: Arena<Expression>,
    /// By index of an old expression; none for pointers into what was taken apart.
    new: Vec<Option<Value>>,
    /// How many new expressions there were before each old one.
    starts: Vec<u32>,
}

impl Split<'_> {
    fn add(&mut self, expression: Expression) -> Value {
        self.made.append(expression, Span::UNDEFINED)
    }

    fn value(&self, old: Value) -> Value {
        self.new[old.index()].expect("no pointer to what was taken apart")
    }

    /// Where an old expression points, if that was taken apart.
    fn taken_apart(&self, old: usize) -> Option<Pointer> {
        self.pointers[old].filter(|pointer| self.whole[pointer.variable.index()].is_none())
    }

    fn expression(&mut self, old: usize, mut expression: Expression) -> Option<Value> {
        if self.taken_apart(old).is_some() {
            return None;
        }
        match &mut expression {
            Expression::LocalVariable(variable) => {
                *variable = self.whole[variable.index()].expect("a variable that stays");
            }
            Expression::Load { pointer } => {
                if let Some(Pointer { variable, mut before, ty }) = self.taken_apart(pointer.index()) {
                    return Some(self.load(variable, &mut before, ty));
                }
            }
            Expression::AccessIndex { base, index } => {
                if let Some(part) = self.component(self.value(*base), *index) {
                    return Some(part);
                }
            }
            _ => {}
        }
        each_operand(&mut expression, |operand| *operand = self.value(*operand));
        Some(self.add(expression))
    }

    /// A part of a value that was put together from as many.
    fn component(&self, value: Value, index: u32) -> Option<Value> {
        match &self.made[value] {
            Expression::Compose { ty, components } if components.len() == extent(self.types, *ty) as usize => {
                Some(components[index as usize])
            }
            _ => None,
        }
    }

    /// Puts a value together from scalars; counts those in `before`.
    fn load(&mut self, variable: Handle<LocalVariable>, before: &mut usize, ty: Handle<Type>) -> Value {
        let extent = extent(self.types, ty);
        if extent == 0 {
            let pointer = self.parts[variable.index()][*before];
            *before += 1;
            return self.add(Expression::Load { pointer });
        }
        let components = (0..extent).map(|i| self.load(variable, before, part(self.types, ty, i))).collect();
        self.add(Expression::Compose { ty, components })
    }

    /// The scalars of a value, in order.
    fn scalars(&mut self, value: Value, ty: Handle<Type>, out: &mut Vec<Value>) {
        let extent = extent(self.types, ty);
        if extent == 0 {
            out.push(value);
        }
        for index in 0..extent {
            let component = self.component(value, index);
            let component = component.unwrap_or_else(|| self.add(Expression::AccessIndex { base: value, index }));
            self.scalars(component, part(self.types, ty, index), out);
        }
    }

    fn block(&mut self, block: &mut Block) {
        let mut made = Block::with_capacity(block.len());
        for (mut statement, span) in std::mem::take(block).span_into_iter() {
            match &mut statement {
                Statement::Emit(range) => {
                    let old = range.index_range();
                    let new = self.starts[old.start as usize]..self.starts[old.end as usize];
                    if new.is_empty() {
                        continue;
                    }
                    *range = Range::from_index_range(new, &self.made);
                }
                Statement::Store { pointer, value } => {
                    let value = self.value(*value);
                    if let Some(Pointer { variable, before, ty }) = self.taken_apart(pointer.index()) {
                        let mut scalars = Vec::new();
                        let first = self.made.len();
                        self.scalars(value, ty, &mut scalars);
                        if self.made.len() > first {
                            made.push(Statement::Emit(self.made.range_from(first)), span);
                        }
                        let pointers = &self.parts[variable.index()][before..];
                        for (&pointer, value) in pointers.iter().zip(scalars) {
                            made.push(Statement::Store { pointer, value }, span);
                        }
                        continue;
                    }
                    statement = Statement::Store { pointer: self.value(*pointer), value };
                }
                Statement::Block(block) => self.block(block),
                Statement::If { condition, accept, reject } => {
                    *condition = self.value(*condition);
                    self.block(accept);
                    self.block(reject);
                }
                Statement::Switch { selector, cases } => {
                    *selector = self.value(*selector);
                    cases.iter_mut().for_each(|case| self.block(&mut case.body));
                }
                Statement::Loop { body, continuing, break_if } => {
                    self.block(body);
                    self.block(continuing);
                    *break_if = break_if.map(|value| self.value(value));
                }
                Statement::Return { value } => *value = value.map(|value| self.value(value)),
                Statement::Call { arguments, result, .. } => {
                    arguments.iter_mut().chain(result).for_each(|value| *value = self.value(*value));
                }
                Statement::Break | Statement::Continue | Statement::Kill => {}
                other => unreachable!("lowering writes no {other:?}"),
            }
            made.push(statement, span);
        }
        *block = made;
    }
}

/// Counts the scalars of a type, and what is neither scalar nor made of parts; stops past [`MOST_SCALARS`].
pub(super) fn count_scalars(types: &UniqueArena<Type>, ty: Handle<Type>, count: &mut usize) {
    match &types[ty].inner {
        TypeInner::Vector { size, .. } => *count += *size as usize,
        TypeInner::Matrix { columns, rows, .. } => *count += *columns as usize * *rows as usize,
        TypeInner::Struct { members, .. } => {
            for member in members {
                if *count > MOST_SCALARS {
                    return;
                }
                count_scalars(types, member.ty, count);
            }
        }
        _ => *count += 1,
    }
}

/// The types of the scalars of a type, in order; `false` if it holds anything else.
fn scalars_of(types: &mut UniqueArena<Type>, ty: Handle<Type>, out: &mut Vec<Handle<Type>>) -> bool {
    match types[ty].inner {
        TypeInner::Scalar(_) => out.push(ty),
        TypeInner::Vector { .. } | TypeInner::Matrix { .. } | TypeInner::Struct { .. } => {
            return (0..extent(types, ty)).all(|index| {
                let part = match types[ty].inner.component_type(index as usize).expect("a part") {
                    TypeResolution::Handle(part) => part,
                    TypeResolution::Value(inner) => types.insert(Type { name: None, inner }, Span::UNDEFINED),
                };
                scalars_of(types, part, out)
            });
        }
        _ => return false,
    }
    true
}

/// Parts of a value of a type: components, columns, members. None of a scalar.
fn extent(types: &UniqueArena<Type>, ty: Handle<Type>) -> u32 {
    match &types[ty].inner {
        TypeInner::Vector { size, .. } => *size as u32,
        TypeInner::Matrix { columns, .. } => *columns as u32,
        TypeInner::Struct { members, .. } => members.len() as u32,
        _ => 0,
    }
}

/// The type of a part, for which [`scalars_of`] was asked.
fn part(types: &UniqueArena<Type>, ty: Handle<Type>, index: u32) -> Handle<Type> {
    match types[ty].inner.component_type(index as usize).expect("a part") {
        TypeResolution::Handle(part) => part,
        TypeResolution::Value(inner) => types.get(&Type { name: None, inner }).expect("types of parts are there"),
    }
}

/// What each expression points to, if that is a part of a variable of these scalars that constant indices lead to.
fn pointers(f: &Function, types: &UniqueArena<Type>, scalars: &[Vec<Handle<Type>>]) -> Vec<Option<Pointer>> {
    let mut pointers: Vec<Option<Pointer>> = Vec::with_capacity(f.expressions.len());
    for (_, expression) in f.expressions.iter() {
        pointers.push(match *expression {
            Expression::LocalVariable(variable) if !scalars[variable.index()].is_empty() => {
                Some(Pointer { variable, before: 0, ty: f.local_variables[variable].ty })
            }
            Expression::AccessIndex { base, index } => pointers[base.index()].map(|base| {
                let skipped = (0..index).map(|index| count(types, part(types, base.ty, index)));
                let before = base.before + skipped.sum::<usize>();
                Pointer { before, ty: part(types, base.ty, index), ..base }
            }),
            _ => None,
        });
    }
    pointers
}

/// How many scalars a type holds.
fn count(types: &UniqueArena<Type>, ty: Handle<Type>) -> usize {
    match extent(types, ty) {
        0 => 1,
        extent => (0..extent).map(|index| count(types, part(types, ty, index))).sum(),
    }
}

/// Visits the arguments of all calls.
fn each_argument(block: &Block, visit: &mut impl FnMut(Value)) {
    for statement in block {
        match statement {
            Statement::Call { arguments, .. } => arguments.iter().for_each(|&argument| visit(argument)),
            Statement::Block(block) => each_argument(block, visit),
            Statement::If { accept, reject, .. } => {
                each_argument(accept, visit);
                each_argument(reject, visit);
            }
            Statement::Switch { cases, .. } => cases.iter().for_each(|case| each_argument(&case.body, visit)),
            Statement::Loop { body, continuing, .. } => {
                each_argument(body, visit);
                each_argument(continuing, visit);
            }
            _ => {}
        }
    }
}

/// Visits the operands of an expression that lowering makes.
fn each_operand(expression: &mut Expression, mut visit: impl FnMut(&mut Value)) {
    use Expression as E;
    match expression {
        E::Literal(_)
        | E::Constant(_)
        | E::ZeroValue(_)
        | E::FunctionArgument(_)
        | E::GlobalVariable(_)
        | E::LocalVariable(_)
        | E::CallResult(_) => {}
        E::Compose { components, .. } => components.iter_mut().for_each(visit),
        E::Access { base: a, index: b } | E::Binary { left: a, right: b, .. } => [a, b].into_iter().for_each(visit),
        E::AccessIndex { base: a, .. }
        | E::Splat { value: a, .. }
        | E::Swizzle { vector: a, .. }
        | E::Load { pointer: a }
        | E::Unary { expr: a, .. }
        | E::Derivative { expr: a, .. }
        | E::Relational { argument: a, .. }
        | E::As { expr: a, .. } => visit(a),
        E::Select { condition, accept, reject } => [condition, accept, reject].into_iter().for_each(visit),
        E::Math { arg, arg1, arg2, arg3, .. } => {
            visit(arg);
            [arg1, arg2, arg3].into_iter().flatten().for_each(visit);
        }
        E::ImageSample { image, sampler, coordinate, array_index, offset, level, depth_ref, .. } => {
            [image, sampler, coordinate].into_iter().for_each(&mut visit);
            [array_index, offset, depth_ref].into_iter().flatten().for_each(&mut visit);
            match level {
                SampleLevel::Auto | SampleLevel::Zero => {}
                SampleLevel::Exact(level) | SampleLevel::Bias(level) => visit(level),
                SampleLevel::Gradient { x, y } => {
                    visit(x);
                    visit(y);
                }
            }
        }
        E::ImageLoad { image, coordinate, array_index, sample, level } => {
            [image, coordinate].into_iter().for_each(&mut visit);
            [array_index, sample, level].into_iter().flatten().for_each(visit);
        }
        E::ImageQuery { image, query } => {
            visit(image);
            if let naga::ImageQuery::Size { level: Some(level) } = query {
                visit(level);
            }
        }
        other => unreachable!("lowering makes no {other:?}"),
    }
}
