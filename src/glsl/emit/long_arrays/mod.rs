//! Long arrays in forms that Mesa's lavapipe compiles quickly.
//!
//! Mesa expands a store or a copy of a whole array, and the zero initialiser that naga's SPIR-V writer adds to every
//! variable, to one memory access per scalar, all of them of one variable. LLVM's time for these grows faster than
//! their square (`InstCombinePass` visits all accesses of a variable whenever it has changed one): a local `float
//! a[500]` delays the first frame by half a minute. A program with long arrays therefore
//! - writes the initial zeros of arrays by loops ([`fill`]), and reports this, so that the initialisers can be left out
//!   ([`crate::Compiled::initialized_arrays`]);
//! - copies long arrays by loops, and tables into those that are initialised with constants ([`copy`]; the tables are
//!   created where constants are emitted, and calls pass and return long values by pointer,
//!   [`super::context::Emitter::is_long`]).

mod copy;
mod fill;
mod sizes;
mod writer;

use rustc_hash::FxHashSet;

use naga::{
    AddressSpace, Binding, Block, BuiltIn, EntryPoint, Expression, GlobalVariable, Handle, LocalVariable,
    MemoryDecorations, Module, Scalar, Span, Type, TypeInner,
};

pub(crate) use copy::MIN_COPY;
use sizes::Sizes;
use writer::{MIN_ARRAY, Writer};

/// The total number of scalars in a program's uninitialised arrays from which on the program is changed at all. 100
/// zeros take lavapipe 0.4 s, 160 take 1.5 s, 256 take 6 s.
const MIN_SCALARS: u32 = 128;

/// The number of scalars up to which a program's arrays are zeroed by blocks of a few known elements, each of them a
/// loop of one iteration that drivers cannot recognise as such. 500 take lavapipe 3 s, 800 take 7 s, and a second by
/// loops; frames are then as fast as with initialisers, and take up to twice as long with loops.
const MAX_IN_BLOCKS: u32 = 512;

/// Rewrites all long arrays to these forms. `filled` are globals that are stored as a whole before anything else,
/// `written_first` variables of each function, the entry point last, that are written before they are read.
///
/// Returns the length in scalars from which on every array is zeroed, or has another value, before it is read, although
/// its variable had no initialiser; `None` if the program has few of them and was left unchanged.
pub(super) fn write(
    module: &mut Module,
    filled: &FxHashSet<Handle<GlobalVariable>>,
    written_first: &[FxHashSet<Handle<LocalVariable>>],
) -> Option<u32> {
    let sizes = Sizes::new(&module.types);
    drop_zero_initialisers(module);
    let globals: Vec<_> = module
        .global_variables
        .iter()
        .filter(|(_, v)| v.space == AddressSpace::Private && v.init.is_none() && sizes.longest(v.ty) >= MIN_ARRAY)
        .map(|(handle, v)| (handle, v.ty))
        .collect();
    let functions = module.functions.iter().map(|(_, f)| f).chain(module.entry_points.iter().map(|e| &e.function));
    let locals = functions.flat_map(|f| f.local_variables.iter().filter(|(_, v)| v.init.is_none()).map(|(_, v)| v.ty));
    let long = globals.iter().map(|(_, ty)| *ty).chain(locals.filter(|ty| sizes.longest(*ty) >= MIN_ARRAY));
    let scalars = long.fold(0u32, |sum, ty| sum.saturating_add(sizes.scalars(ty)));
    if scalars < MIN_SCALARS {
        return None;
    }
    let uint = module.types.insert(Type { name: None, inner: TypeInner::Scalar(Scalar::U32) }, Span::UNDEFINED);
    let opaque = module.entry_points.iter().all(|e| never_negative(e).is_some()).then(|| {
        let (space, memory_decorations) = (AddressSpace::Private, MemoryDecorations::empty());
        let opaque = GlobalVariable { name: None, space, binding: None, ty: uint, init: None, memory_decorations };
        module.global_variables.append(opaque, Span::UNDEFINED)
    });
    let Module { types, global_variables, functions, entry_points, .. } = module;
    let variables: Vec<_> = global_variables.iter().map(|(_, v)| (v.ty, v.space)).collect();
    let in_blocks = scalars <= MAX_IN_BLOCKS;
    let mut written_first = written_first.iter();
    let mut write = |function, opaque_bit, filled: &[_]| {
        let written_first = written_first.next().expect("a set for each function");
        let (sizes, globals) = (&sizes, &variables[..]);
        let mut writer = Writer { types, sizes, globals, uint, opaque, in_blocks, function };
        let mut start = Block::new();
        if let Some(bit) = opaque_bit {
            writer.set_opaque(bit, &mut start);
        }
        writer.rewrite(filled, written_first, start);
    };
    for (_, function) in functions.iter_mut() {
        write(function, None, &[]);
    }
    let globals: Vec<_> = globals.into_iter().filter(|(global, _)| !filled.contains(global)).collect();
    for entry in entry_points {
        let bit = never_negative(entry);
        write(&mut entry.function, bit, &globals);
    }
    Some(MIN_ARRAY)
}

/// Removes initialisers that are a single zero value: naga writes zeros without them.
fn drop_zero_initialisers(module: &mut Module) {
    let Module { global_expressions, constants, global_variables, functions, entry_points, .. } = module;
    let is_zero = |mut init: Handle<Expression>| loop {
        match global_expressions[init] {
            Expression::ZeroValue(_) => return true,
            Expression::Constant(constant) => init = constants[constant].init,
            _ => return false,
        }
    };
    for (_, variable) in global_variables.iter_mut() {
        variable.init = variable.init.filter(|&init| !is_zero(init));
    }
    let functions = functions.iter_mut().map(|(_, f)| f).chain(entry_points.iter_mut().map(|e| &mut e.function));
    for function in functions {
        for (_, variable) in function.local_variables.iter_mut() {
            variable.init = variable.init.filter(|&init| match function.expressions[init] {
                Expression::ZeroValue(_) => false,
                Expression::Constant(constant) => !is_zero(constants[constant].init),
                _ => true,
            });
        }
    }
}

/// Returns an argument whose first bit is never set, although no driver knows that: the pixel position, or the vertex
/// index.
fn never_negative(entry: &EntryPoint) -> Option<(u32, BuiltIn)> {
    (0..).zip(&entry.function.arguments).find_map(|(index, argument)| match argument.binding {
        Some(Binding::BuiltIn(built_in @ (BuiltIn::Position { .. } | BuiltIn::VertexIndex))) => Some((index, built_in)),
        _ => None,
    })
}
