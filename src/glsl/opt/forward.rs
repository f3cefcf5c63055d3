//! Store-to-load forwarding: a load of what is known to be in memory is that value.
//!
//! It is known from a load or a store of a variable, or of a part of one, until something writes there. So terms of two
//! expressions are seen to be the same, and constants reach the place where they are used.

use rustc_hash::{FxHashMap, FxHashSet};

use crate::glsl::ir::rewrite::{self, Rewriter, Rule};
use crate::glsl::{
    ir::{Block, FuncId, Function, GlobalId, Module, Op, Stmt, Value},
    types::{Type, TypeId},
};

/// Places of one variable of which it is known what they hold. All are looked through where one of them is written; a
/// shader that a person wrote knows a few dozen.
const MOST_PLACES: usize = 512;

/// Module-scope variables of which that is known. All are looked through where a loop begins.
const MOST_GLOBALS: usize = 1024;

/// A structure of more scalars is not told apart when it is written as a whole.
const MOST_SCALARS: usize = 256;

pub(super) fn run(module: &mut Module) {
    let written = written_globals(module);
    rewrite::each_function(module, |_, _| Forward::new(&written));
}

/// The globals that each function, or what it calls, writes.
fn written_globals(module: &Module) -> Vec<FxHashSet<GlobalId>> {
    let mut all: Vec<FxHashSet<GlobalId>> = Vec::with_capacity(module.functions.len());
    for f in &module.functions {
        let mut effects = Effects::default();
        effects.block(f, &f.body);
        let mut written: FxHashSet<GlobalId> = effects.written.iter().filter_map(|&root| global(f, root)).collect();
        for callee in effects.called {
            written.extend(&all[callee.index()]);
        }
        all.push(written);
    }
    all
}

fn global(f: &Function, root: Value) -> Option<GlobalId> {
    match f[root] {
        Op::Global(id) => Some(id),
        _ => None,
    }
}

/// What a place is by itself: the same for each value that names it.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
enum Root {
    Var(u32),
    Global(GlobalId),
    Param(u32),
}

fn root(f: &Function, place: Value) -> Root {
    match f[f.root(place)] {
        Op::Var(var) => Root::Var(var.index() as u32),
        Op::Global(id) => Root::Global(id),
        Op::Param(index) => Root::Param(index),
        ref op => unreachable!("{op:?} is no place"),
    }
}

/// A step from a place to a part of it.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
enum Step {
    Part(u32),
    Element(Value),
}

type Path = Vec<Step>;

fn path(f: &Function, mut place: Value) -> Path {
    let mut path = Vec::new();
    loop {
        match f[place] {
            Op::Part { base, index } => {
                path.push(Step::Part(index));
                place = base;
            }
            Op::Element { base, index } => {
                path.push(Step::Element(index));
                place = base;
            }
            _ => break,
        }
    }
    path.reverse();
    path
}

/// What a block writes, and what it calls.
#[derive(Default)]
struct Effects {
    /// Roots.
    written: Vec<Value>,
    /// Places that are stored to.
    stored: Vec<Value>,
    called: Vec<FuncId>,
}

impl Effects {
    fn block(&mut self, f: &Function, block: &Block) {
        for stmt in block {
            match stmt {
                Stmt::Let(value) => {
                    if let Op::Call { function, ref args } = f[*value] {
                        self.called.push(function);
                        let places = args.iter().copied().filter(|&arg| f.is_place(arg));
                        for place in places {
                            self.written.push(f.root(place));
                            self.stored.push(place);
                        }
                    }
                }
                Stmt::Store { place, .. } => {
                    self.written.push(f.root(*place));
                    self.stored.push(*place);
                }
                Stmt::If { accept, reject, .. } => {
                    self.block(f, accept);
                    self.block(f, reject);
                }
                Stmt::Switch { cases, .. } => cases.iter().for_each(|case| self.block(f, &case.body)),
                Stmt::Loop { body, continuing, .. } => {
                    self.block(f, body);
                    self.block(f, continuing);
                }
                _ => {}
            }
        }
    }
}

struct Forward<'a> {
    /// By [`FuncId::index`].
    written: &'a [FxHashSet<GlobalId>],
    /// What places hold, by variable.
    known: FxHashMap<Root, FxHashMap<Path, Value>>,
    in_order: Vec<(Root, Path)>,
    /// How many there were as each block began.
    outer: Vec<usize>,
    globals: usize,
}

impl<'a> Forward<'a> {
    fn new(written: &'a [FxHashSet<GlobalId>]) -> Self {
        Self { written, known: FxHashMap::default(), in_order: Vec::new(), outer: Vec::new(), globals: 0 }
    }

    fn know(&mut self, is_structure: bool, root: Root, path: Path, value: Value) {
        if let Root::Global(_) = root
            && !self.known.contains_key(&root)
        {
            if self.globals >= MOST_GLOBALS {
                return;
            }
            self.globals += 1;
        }
        let places = self.known.entry(root).or_default();
        // Of an array all is forgotten at once.
        if places.len() >= MOST_PLACES && is_structure {
            return;
        }
        places.insert(path.clone(), value);
        self.in_order.push((root, path));
    }

    fn load(&mut self, r: &mut Rewriter<'_>, place: Value, value: Value) -> Option<Value> {
        let (root, path) = (root(&r.f, place), path(&r.f, place));
        if let Some(places) = self.known.get(&root) {
            if let Some(&known) = places.get(&path) {
                return Some(known);
            }
            if let Some((Step::Part(index), outer)) = path.split_last()
                && let Some(&whole) = places.get(outer)
            {
                return Some(part(r, whole, *index));
            }
        }
        self.know(is_structure(r.module, r.f.ty(r.f.root(place))), root, path, value);
        None
    }

    /// A structure was written: what is known of its members is known of those of the memory.
    fn know_members(&mut self, r: &Rewriter<'_>, root: Root, path: &Path, value: Value) {
        for index in 0..r.module.extent(r.f.ty(value)) {
            let Some(member) = known_part(r, value, index) else { continue };
            let mut path = path.clone();
            path.push(Step::Part(index));
            if is_structure(r.module, r.f.ty(member)) {
                self.know_members(r, root, &path, member);
            } else {
                self.know(true, root, path, member);
            }
        }
    }

    /// Something is written to a place: what is known of other members of a structure stays.
    fn forget(&mut self, f: &Function, module: &Module, place: Value) {
        let root = root(f, place);
        let Some(places) = self.known.get_mut(&root) else { return };
        let members = members(f, module, place);
        let ty = f.ty(f.root(place));
        places.retain(|path, _| {
            let other = leading_members(module, ty, path);
            let shared = members.len().min(other.len());
            members[..shared] != other[..shared]
        });
        if places.is_empty() {
            self.known.remove(&root);
            self.globals -= usize::from(matches!(root, Root::Global(_)));
        }
    }

    fn forget_globals(&mut self, written: impl Fn(GlobalId) -> bool) {
        self.known.retain(|root, _| !matches!(root, Root::Global(id) if written(*id)));
        self.globals = self.known.keys().filter(|root| matches!(root, Root::Global(_))).count();
    }

    fn forget_all_of(&mut self, f: &Function, module: &Module, effects: &Effects) {
        for &place in &effects.stored {
            self.forget(f, module, place);
        }
        for callee in &effects.called {
            let written = &self.written[callee.index()];
            self.forget_globals(|id| written.contains(&id));
        }
    }
}

fn is_structure(module: &Module, ty: TypeId) -> bool {
    matches!(module.types.get(ty), Type::Struct(_))
}

/// The members of structures that lead to a place or, where it lies within something else, to that.
fn members(f: &Function, module: &Module, place: Value) -> Vec<u32> {
    leading_members(module, f.ty(f.root(place)), &path(f, place))
}

fn leading_members(module: &Module, mut ty: TypeId, path: &[Step]) -> Vec<u32> {
    let mut members = Vec::new();
    for step in path {
        match *step {
            Step::Part(index) if is_structure(module, ty) => {
                members.push(index);
                ty = module.part(ty, index);
            }
            _ => break,
        }
    }
    members
}

/// A part of a value that was put together from as many.
fn known_part(r: &Rewriter<'_>, value: Value, index: u32) -> Option<Value> {
    match &r.f[value] {
        Op::Compose { ty, parts } if parts.len() == r.module.extent(*ty) as usize => Some(parts[index as usize]),
        _ => None,
    }
}

fn part(r: &mut Rewriter<'_>, value: Value, index: u32) -> Value {
    known_part(r, value, index).unwrap_or_else(|| r.add(Op::Part { base: value, index }))
}

impl Rule for Forward<'_> {
    fn operation(&mut self, r: &mut Rewriter<'_>, value: Value, op: &Op) -> Option<Value> {
        match *op {
            Op::Load { place } => self.load(r, place, value),
            Op::Call { function, ref args } => {
                for &place in args.iter().filter(|&&arg| r.f.is_place(arg)) {
                    self.forget(&r.f, r.module, place);
                }
                let written = &self.written[function.index()];
                self.forget_globals(|id| written.contains(&id));
                None
            }
            _ => None,
        }
    }

    fn store(&mut self, r: &mut Rewriter<'_>, place: Value, value: Value) {
        let (f, module) = (&r.f, r.module);
        self.forget(f, module, place);
        let ty = f.ty(place);
        match module.types.get(ty) {
            Type::Scalar(_) | Type::Vector { .. } if is_whole(f, module, place) => {
                let in_structure = is_structure(module, f.ty(f.root(place)));
                self.know(in_structure, root(f, place), path(f, place), value);
            }
            Type::Struct(_) if is_whole(f, module, place) && module.scalars_up_to(ty, MOST_SCALARS) <= MOST_SCALARS => {
                self.know_members(r, root(f, place), &path(f, place), value);
            }
            _ => {}
        }
    }

    fn enter(&mut self) {
        self.outer.push(self.in_order.len());
    }

    fn leave(&mut self, _: &Rewriter<'_>) {
        let first = self.outer.pop().expect("a block was entered");
        // What was written in it is forgotten already.
        for (root, path) in self.in_order.drain(first..) {
            if let Some(places) = self.known.get_mut(&root) {
                places.remove(&path);
                if places.is_empty() {
                    self.known.remove(&root);
                    self.globals -= usize::from(matches!(root, Root::Global(_)));
                }
            }
        }
    }

    fn enter_loop(&mut self, r: &Rewriter<'_>, body: &Block, continuing: &Block) {
        let mut effects = Effects::default();
        effects.block(&r.f, body);
        effects.block(&r.f, continuing);
        self.forget_all_of(&r.f, r.module, &effects);
    }
}

/// Whether a place is a variable or a member of structures: no part of an array, matrix or vector.
fn is_whole(f: &Function, module: &Module, place: Value) -> bool {
    members(f, module, place).len() == path(f, place).len()
}
