//! The values of variables at a moment, and the names that are visible there.

use super::{
    super::number::Number,
    record::{Call, History, Moment, MomentKind, NONE, NamedValue, Value, Variable, Write},
};
use eddy_glsl::{
    statements::StatementPoint,
    types::{Scalar, Type, TypeId},
    walk::cells,
};

impl History {
    /// Returns the active calls at a moment, the innermost first, each with a moment in it: for a caller the moment of
    /// the call.
    pub fn stack(&self, at: usize) -> Vec<(&Call, usize)> {
        let Some(moment) = self.moments.get(at) else { return Vec::new() };
        let mut found = Vec::new();
        let (mut call, mut at) = (Some(moment.call), at);
        while let Some(index) = call {
            let this = &self.calls[index as usize];
            found.push((this, at));
            (call, at) = (this.parent, this.from as usize);
        }
        found
    }

    /// Returns the visible variables at a moment, the function's own first, without hidden ones.
    pub fn visible(&self, at: usize) -> Vec<NamedValue> {
        let names = self.names(at);
        names
            .into_iter()
            .filter_map(|(name, _)| self.value(at, &name).map(|value| NamedValue { name, value }))
            .collect()
    }

    /// Returns the visible variables with their types, without hidden ones.
    pub(in crate::trace) fn names(&self, at: usize) -> Vec<(String, String)> {
        let mut names: Vec<(String, String)> = Vec::new();
        let mut add = |name: &str, ty: TypeId| {
            if !name.is_empty() && names.iter().all(|(there, _)| there != name) {
                names.push((name.to_owned(), self.walkable.type_text(ty).to_owned()));
            }
        };
        self.locals(at).into_iter().rev().for_each(|(variable, _)| add(&variable.name, variable.ty));
        names.reverse();
        let mut add = |name: &str, ty: TypeId| {
            if !name.is_empty() && names.iter().all(|(there, _)| there != name) {
                names.push((name.to_owned(), self.walkable.type_text(ty).to_owned()));
            }
        };
        self.globals.iter().for_each(|variable| add(&variable.name, variable.ty));
        names
    }

    /// Returns the author's writable variables of the module, with their types: no `in` variables of a stage.
    pub(in crate::trace) fn global_names(&self) -> impl Iterator<Item = (&str, &str)> {
        let inputs: Vec<_> = self.walkable.inputs().collect();
        let inputs = self.walkable.globals().filter(|(_, id)| inputs.contains(id)).map(|(name, _)| name);
        let inputs: Vec<&str> = inputs.collect();
        let names = self.globals.iter().map(|variable| (variable.name.as_str(), self.walkable.type_text(variable.ty)));
        names.filter(move |(name, _)| !inputs.contains(name))
    }

    /// Returns the visible variables of the function, the outermost first, with their indices among its slots.
    fn locals(&self, at: usize) -> Vec<(&Variable, Option<usize>)> {
        let Some(moment) = self.moments.get(at) else { return Vec::new() };
        let when = match moment.kind {
            MomentKind::Statement => StatementPoint::Before,
            MomentKind::Iteration(_) | MomentKind::Test | MomentKind::Step => StatementPoint::Within,
            MomentKind::Return => StatementPoint::After,
        };
        self.locals_when(moment, when)
    }

    pub(super) fn locals_when(&self, moment: &Moment, when: StatementPoint) -> Vec<(&Variable, Option<usize>)> {
        let variables = &self.variables[self.calls[moment.call as usize].function as usize];
        let statements = self.walkable.statements();
        let find = |local: u32| {
            let slot = variables.iter().position(|variable| variable.local == Some(local));
            slot.map(|slot| (&variables[slot], Some(slot)))
        };
        statements.visible(moment.statement, when).into_iter().filter_map(find).collect()
    }

    /// Returns the value of a name; `None` if the program has nothing of this name.
    pub fn value(&self, at: usize, name: &str) -> Option<Value> {
        let local = self.locals(at).into_iter().rev().find(|(variable, _)| variable.name == name);
        let (variable, slot) = match local {
            Some((variable, slot)) => (variable, self.calls[self.moments[at].call as usize].slots as usize + slot?),
            None => self.global(name)?,
        };
        Some(self.of(variable.ty, self.words_at(at, variable, slot)))
    }

    /// Returns the value of a variable of the module, even if a local hides it.
    pub(in crate::trace) fn global_words(&self, at: usize, name: &str) -> Option<Vec<u32>> {
        let (variable, slot) = self.global(name)?;
        Some(self.words_at(at, variable, slot))
    }

    fn global(&self, name: &str) -> Option<(&Variable, usize)> {
        let slot = self.globals.iter().position(|variable| variable.name == name)?;
        Some((&self.globals[slot], slot))
    }

    /// Returns the function's result, at its end.
    pub fn result(&self, at: usize) -> Option<Value> {
        let moment = self.moments.get(at).filter(|moment| moment.kind == MomentKind::Return)?;
        let call = &self.calls[moment.call as usize];
        let variables = &self.variables[call.function as usize];
        // The result is the only variable that is not the author's.
        let slot = variables.iter().position(|variable| variable.local.is_none())?;
        let variable = &variables[slot];
        (variable.ty != TypeId::VOID)
            .then(|| self.of(variable.ty, self.words_at(at, variable, call.slots as usize + slot)))
    }

    /// Returns the words of a variable at a moment: its writes before that, the newest first, until all words are
    /// known. Words that were never written are zero, as defined here.
    pub(super) fn words_at(&self, at: usize, variable: &Variable, slot: usize) -> Vec<u32> {
        if let Some(constant) = &variable.constant {
            return constant.clone();
        }
        let end = self.moments[at].writes;
        let mut words = vec![0; cells(&self.walkable.program, variable.ty)];
        let (mut known, mut left) = (vec![false; words.len()], words.len());
        let mut write = self.slots.get(slot).copied().unwrap_or(NONE);
        while write != NONE && left > 0 {
            let Write { words: from, offset, count, previous } = self.writes[write as usize];
            if write < end {
                for i in 0..count as usize {
                    let place = offset as usize + i;
                    if place < known.len() && !std::mem::replace(&mut known[place], true) {
                        words[place] = self.words[from as usize + i];
                        left -= 1;
                    }
                }
            }
            write = previous;
        }
        words
    }

    pub(super) fn of(&self, ty: TypeId, words: Vec<u32>) -> Value {
        let mut numbers = Vec::with_capacity(words.len());
        self.numbers(ty, &mut words.iter().copied(), &mut numbers);
        let is_vector =
            matches!(self.walkable.program.types.get(ty), Type::Vector { scalar: Scalar::Float, size: 3 | 4 });
        Value { type_text: self.walkable.type_text(ty).to_owned(), numbers, is_vector, words }
    }

    fn numbers(&self, ty: TypeId, words: &mut impl Iterator<Item = u32>, out: &mut Vec<Number>) {
        let program = &self.walkable.program;
        match program.types.get(ty) {
            Type::Scalar(scalar) => out.extend(words.next().map(|word| Number::of(scalar, word))),
            _ => (0..program.extent(ty)).for_each(|i| self.numbers(program.part(ty, i), words, out)),
        }
    }
}
