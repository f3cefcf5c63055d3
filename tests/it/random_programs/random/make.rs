//! Generates programs: declarations and statements. Expressions are in [`super::values`].

use super::{
    BOOL, Base, Expr, FLOAT, Function, INT, Link, Logic, Mode, Op, Place, Program, Stmt, Ty, UINT, Var, VarId,
};

/// Pseudo-random numbers (Steele, Lea and Flood: SplitMix).
#[derive(Default)]
pub(crate) struct Rng(u64);

impl Rng {
    pub(crate) fn new(seed: u64) -> Self {
        // A factor other than the step below, with which each seed's numbers would be those of the next seed, shifted
        // by one.
        Self(seed.wrapping_mul(0xd134_2543_de82_ef95))
    }

    pub(crate) fn next(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        z ^ (z >> 31)
    }

    pub(crate) fn below(&mut self, count: usize) -> usize {
        (self.next() % count as u64) as usize
    }

    /// Returns true with a probability of `percent` %.
    pub(crate) fn percent(&mut self, percent: usize) -> bool {
        self.below(100) < percent
    }

    pub(crate) fn pick<'a, T>(&mut self, of: &'a [T]) -> &'a T {
        &of[self.below(of.len())]
    }
}

/// Generates the program of a seed.
pub(crate) fn make(seed: u64) -> Program {
    let mut maker = Maker { rng: Rng::new(seed), scopes: vec![Vec::new()], ..Maker::default() };
    maker.program();
    maker.program
}

#[derive(Default)]
pub(super) struct Maker {
    pub rng: Rng,
    pub program: Program,
    /// The variables in scope, from the outermost scope on.
    pub scopes: Vec<Vec<VarId>>,
    /// Variables that only a loop's step may write.
    pub counters: Vec<VarId>,
    /// The counters of the enclosing loops, including those that other statements may write: steps must be able to name
    /// them.
    stepped: Vec<VarId>,
    /// The number of scopes inside the cases of each enclosing switch.
    cases: Vec<usize>,
    /// The result type of the current function.
    result: Option<Ty>,
    in_function: bool,
    loops: usize,
    breakable: usize,
    depth: usize,
    /// The number of statements that may still be generated.
    budget: i32,
}

impl Maker {
    fn program(&mut self) {
        for _ in 0..self.rng.below(3) {
            let count = 1 + self.rng.below(3);
            let fields = (0..count).map(|_| self.any_type()).collect();
            self.program.structs.push(fields);
        }
        for _ in 0..1 + self.rng.below(3) {
            let constant = self.rng.percent(30);
            let ty = if constant { self.table_type() } else { self.any_type() };
            let init = (constant || self.rng.percent(60)).then(|| self.literals(&ty));
            let var = self.var(ty, constant);
            self.program.globals.push((var, init));
            self.scopes[0].push(var);
        }
        for _ in 0..self.rng.below(4) {
            self.function();
        }
        self.budget = 9;
        self.scopes.push(Vec::new());
        let mut body = Vec::new();
        for _ in 0..2 + self.rng.below(3) {
            let declared = self.declaration();
            body.push(declared);
        }
        // An array between two others: a write outside its bounds changes one of them.
        let len = 2 + self.rng.below(5) as u32;
        for ty in [INT, UINT, INT].map(|scalar| Ty::Array(Box::new(scalar), len)) {
            let init = self.rng.percent(50).then(|| self.construct(&ty, 1));
            body.push(self.declare(ty, init));
        }
        while self.budget > 0 {
            self.statement(&mut body);
        }
        self.program.results = self.scopes[1].iter().copied().filter(|&v| !self.program.vars[v].constant).collect();
        self.program.body = body;
    }

    fn var(&mut self, ty: Ty, constant: bool) -> VarId {
        let id = self.program.vars.len();
        self.program.vars.push(Var { name: format!("v{id}"), ty, constant });
        id
    }

    /// Declares a local and adds it to the current scope.
    fn declare(&mut self, ty: Ty, init: Option<Expr>) -> Stmt {
        let var = self.var(ty, false);
        self.scopes.last_mut().expect("a scope").push(var);
        Stmt::Declare(var, init)
    }

    fn declaration(&mut self) -> Stmt {
        if self.rng.percent(12) {
            let ty = self.table_type();
            let init = self.literals(&ty);
            let var = self.var(ty, true);
            self.scopes.last_mut().expect("a scope").push(var);
            return Stmt::Declare(var, Some(init));
        }
        let ty = self.any_type();
        let init = self.rng.percent(65).then(|| self.value(&ty, 2));
        let declared = self.declare(ty, init);
        if let Stmt::Declare(var, _) = declared {
            self.shadow(var);
        }
        declared
    }

    /// Sometimes renames a variable to one of an outer scope, which is then hidden.
    fn shadow(&mut self, var: VarId) {
        let (_, outer) = self.scopes.split_last().expect("a scope");
        let mut outer: Vec<VarId> = outer.iter().skip(1).flatten().copied().collect();
        outer.retain(|var| !self.stepped.contains(var));
        // A declaration in one case hides names in the next.
        let in_case = self.cases.last() == Some(&self.scopes.len());
        if outer.is_empty() || in_case || self.depth < 2 || !self.rng.percent(15) {
            return;
        }
        let hidden = *self.rng.pick(&outer);
        let name = self.program.vars[hidden].name.clone();
        let taken = self.scopes.last().expect("a scope").iter().any(|&v| self.program.vars[v].name == name);
        if !taken {
            self.program.vars[var].name = name;
        }
    }

    /// Returns the visible variables: those that are not hidden by another one of the same name.
    pub(super) fn visible(&self) -> Vec<VarId> {
        let mut found: Vec<VarId> = Vec::new();
        for &var in self.scopes.iter().rev().flat_map(|scope| scope.iter().rev()) {
            let name = &self.program.vars[var].name;
            if found.iter().all(|&other| self.program.vars[other].name != *name) {
                found.push(var);
            }
        }
        found
    }

    pub(super) fn scalar_type(&mut self) -> Ty {
        [INT, INT, UINT, BOOL][self.rng.below(4)].clone()
    }

    fn number_type(&mut self) -> Ty {
        let size = 1 + self.rng.below(4) as u8;
        Ty::Num(*self.rng.pick(&[Base::Int, Base::Uint, Base::Float]), size)
    }

    pub(super) fn any_type(&mut self) -> Ty {
        match self.rng.below(12) {
            0..=3 => self.scalar_type(),
            4 | 5 => self.number_type(),
            6 => Ty::Mat(2 + self.rng.below(3) as u8, 2 + self.rng.below(3) as u8),
            7 | 8 if !self.program.structs.is_empty() => Ty::Struct(self.rng.below(self.program.structs.len())),
            _ => self.table_type(),
        }
    }

    /// Returns a random array type.
    fn table_type(&mut self) -> Ty {
        let len = if self.rng.percent(4) { 33 + self.rng.below(8) } else { 1 + self.rng.below(6) } as u32;
        let element = match self.rng.below(6) {
            0 if !self.program.structs.is_empty() && len < 7 => Ty::Struct(self.rng.below(self.program.structs.len())),
            1 => self.number_type(),
            _ => self.scalar_type(),
        };
        Ty::Array(Box::new(element), len)
    }

    fn function(&mut self) {
        let inner = vec![self.scopes[0].clone(), Vec::new()];
        let outer = std::mem::replace(&mut self.scopes, inner);
        let mut params = Vec::new();
        for _ in 0..self.rng.below(4) {
            let mode = *self.rng.pick(&[Mode::In, Mode::In, Mode::Out, Mode::Inout, Mode::Inout]);
            let ty = self.any_type();
            let var = self.var(ty, false);
            self.scopes[1].push(var);
            params.push((var, mode));
        }
        let result =
            self.rng.percent(75).then(|| if self.rng.percent(70) { self.scalar_type() } else { self.any_type() });
        self.result = result.clone();
        self.in_function = true;
        self.budget = 1 + self.rng.below(4) as i32;
        let mut body = Vec::new();
        while self.budget > 0 {
            self.statement(&mut body);
        }
        if let Some(ty) = result.clone() {
            let value = self.value(&ty, 2);
            body.push(Stmt::Return(Some(value)));
        }
        self.in_function = false;
        self.scopes = outer;
        self.program.functions.push(Function { params, result, body });
    }

    fn block(&mut self, statements: usize) -> Vec<Stmt> {
        self.scopes.push(Vec::new());
        let list = self.statements(statements);
        self.scopes.pop();
        list
    }

    /// Generates statements in the current scope.
    fn statements(&mut self, statements: usize) -> Vec<Stmt> {
        self.depth += 1;
        let mut list = Vec::new();
        for _ in 0..statements {
            self.statement(&mut list);
        }
        self.depth -= 1;
        list
    }

    fn statement(&mut self, out: &mut Vec<Stmt>) {
        self.budget -= 1;
        let nest = self.depth < 3 && self.budget > 0;
        let stmt = match self.rng.below(20) {
            0..=2 => self.declaration(),
            3..=5 if nest => {
                let cond = self.condition();
                let then = 1 + self.rng.below(2);
                let then = self.block(then);
                let otherwise = if self.rng.percent(40) { self.block(1) } else { Vec::new() };
                Stmt::If(cond, then, otherwise)
            }
            6..=9 if nest => self.any_loop(out),
            10 | 11 if nest => self.switch(),
            12 if self.breakable > 0 => {
                let cond = self.condition();
                Stmt::If(cond, vec![Stmt::Break], Vec::new())
            }
            13 | 14 if self.loops > 0 => {
                let cond = self.condition();
                Stmt::If(cond, vec![Stmt::Continue], Vec::new())
            }
            15 if self.in_function => {
                let cond = self.condition();
                let value = self.result.clone().map(|ty| self.value(&ty, 2));
                Stmt::If(cond, vec![Stmt::Return(value)], Vec::new())
            }
            16 if nest => Stmt::Block(self.block(2)),
            _ => Stmt::Expr(self.effect()),
        };
        out.push(stmt);
    }

    pub(super) fn condition(&mut self) -> Expr {
        loop {
            let cond = self.value(&BOOL, 2);
            if !cond.is_constant(&self.program.vars) {
                return cond;
            }
        }
    }

    /// Generates a loop; its counter may be declared before it.
    fn any_loop(&mut self, out: &mut Vec<Stmt>) -> Stmt {
        match self.rng.below(10) {
            0..=5 => self.counting_loop(),
            6 | 7 => self.while_loop(out),
            8 => {
                let mut body = self.loop_body(Vec::new());
                body.insert(0, Stmt::Fuel);
                Stmt::Do(body, self.condition())
            }
            _ => {
                let step = self.rng.percent(70).then(|| self.effect());
                let test = self.rng.percent(60).then(|| self.condition());
                let mut body = self.loop_body(Vec::new());
                body.insert(0, Stmt::Fuel);
                Stmt::For { init: None, test, step, body }
            }
        }
    }

    fn loop_body(&mut self, scope: Vec<VarId>) -> Vec<Stmt> {
        self.loops += 1;
        self.breakable += 1;
        self.scopes.push(scope);
        let count = 1 + self.rng.below(3);
        let body = self.statements(count);
        self.scopes.pop();
        self.loops -= 1;
        self.breakable -= 1;
        body
    }

    /// Generates `for (int i = a; i < b; i += c)` with steps of every kind, among them some that are much greater than
    /// the range.
    fn counting_loop(&mut self) -> Stmt {
        let base = *self.rng.pick(&[Base::Int, Base::Int, Base::Int, Base::Uint, Base::Float]);
        let ty = Ty::Num(base, 1);
        let down = self.rng.percent(30);
        let (low, high) = (self.rng.below(3) as i32, 2 + self.rng.below(4) as i32);
        let (start, bound) = if down { (high, low) } else { (low, high) };
        let start = number(start, base);
        let (start, bound) = match self.rng.below(6) {
            0 if base == Base::Int => (self.value(&INT, 1), number(bound, base)),
            1 if base != Base::Float => (start, self.value(&ty, 1)),
            _ => (start, number(bound, base)),
        };
        let counter = self.var(ty.clone(), false);
        let place = || Place::whole(counter);
        let op = match down {
            true => *self.rng.pick(&[Op::Greater, Op::GreaterEqual, Op::Greater, Op::NotEqual]),
            false => *self.rng.pick(&[Op::Less, Op::LessEqual, Op::Less, Op::NotEqual]),
        };
        let op = if base == Base::Float && op == Op::NotEqual { Op::Less } else { op };
        let read = Box::new(Expr::Read(place(), ty.clone()));
        let plain = Expr::Binary(op, read.clone(), Box::new(bound.clone()), BOOL);
        let mut test = match (self.rng.below(10), op) {
            (0, Op::Less) => Expr::Binary(Op::Greater, Box::new(bound), read, BOOL),
            (1, _) => Expr::Logic(Logic::And, Box::new(plain), Box::new(self.value(&BOOL, 1))),
            _ => plain,
        };
        let add = if down { Op::Sub } else { Op::Add };
        let by = match self.rng.below(8) {
            0 => 100,
            1 if base != Base::Float => 2_000_000_000,
            2 => 3,
            3 => 2,
            _ => 1,
        };
        let step = match self.rng.below(3) {
            0 if by == 1 => Expr::Step { place: place(), ty: ty.clone(), down, before: self.rng.percent(50) },
            _ => Expr::AssignOp(add, place(), Box::new(number(by, base)), ty.clone()),
        };
        let free = base != Base::Float && self.rng.percent(20);
        if !free {
            self.counters.push(counter);
        }
        // The step is in the scope of the declaration, too.
        self.scopes.push(vec![counter]);
        let step = if self.rng.percent(60) {
            let other = if self.rng.percent(70) { self.indexed_by(counter) } else { None };
            let other = Box::new(other.unwrap_or_else(|| self.effect_with_value()));
            match self.rng.percent(70) {
                true => Expr::Comma(Box::new(step), other),
                false => Expr::Comma(other, Box::new(step)),
            }
        } else {
            step
        };
        if base == Base::Float && self.rng.percent(30) {
            test = Expr::Logic(Logic::Or, Box::new(test), Box::new(Expr::Literal(0, Base::Bool)));
        }
        self.scopes.pop();
        let mut body = self.loop_body(vec![counter]);
        if !free {
            self.counters.pop();
        }
        body.insert(0, Stmt::Fuel);
        Stmt::For {
            init: Some(Box::new(Stmt::Declare(counter, Some(start)))),
            test: Some(test),
            step: Some(step),
            body,
        }
    }

    /// Generates an operand of a comma: not a `void`, an array or a structure.
    fn effect_with_value(&mut self) -> Expr {
        loop {
            let effect = self.effect();
            let void = matches!(effect, Expr::Call(function, ..) if self.program.functions[function].result.is_none());
            if !void && matches!(effect.ty(), Ty::Num(..)) {
                return effect;
            }
        }
    }

    /// Generates `a[i] = ..` if an array is visible.
    fn indexed_by(&mut self, counter: VarId) -> Option<Expr> {
        let arrays: Vec<VarId> = self.visible();
        let arrays: Vec<VarId> = arrays
            .into_iter()
            .filter(|&var| {
                let var = &self.program.vars[var];
                matches!(&var.ty, Ty::Array(element, _) if matches!(**element, Ty::Num(_, 1))) && !var.constant
            })
            .collect();
        if arrays.is_empty() {
            return None;
        }
        let var = *self.rng.pick(&arrays);
        let Ty::Array(element, _) = self.program.vars[var].ty.clone() else { return None };
        let index = self.counted(counter);
        let place = Place { var, path: vec![Link::Index(Box::new(index))] };
        let value = self.value(&element, 1);
        Some(Expr::Assign(place, Box::new(value), *element))
    }

    /// Returns a counter as an int or uint.
    pub(super) fn counted(&mut self, counter: VarId) -> Expr {
        let ty = self.program.vars[counter].ty.clone();
        let read = Expr::Read(Place::whole(counter), ty.clone());
        if ty == FLOAT { Expr::Convert(Base::Int, Box::new(read)) } else { read }
    }

    /// Generates `int n = 4; while (n >= 1) { ..; n--; }`.
    fn while_loop(&mut self, out: &mut Vec<Stmt>) -> Stmt {
        let ty = if self.rng.percent(75) { INT } else { UINT };
        let base = ty.base().expect("a scalar");
        let down = self.rng.percent(50);
        let start = number(if down { 3 + self.rng.below(4) as i32 } else { 0 }, base);
        let declared = self.declare(ty.clone(), Some(start));
        let Stmt::Declare(counter, _) = declared else { unreachable!("a declaration") };
        out.push(declared);
        let place = Place::whole(counter);
        let (op, bound) = if down {
            (*self.rng.pick(&[Op::Greater, Op::GreaterEqual]), self.rng.below(3))
        } else {
            (*self.rng.pick(&[Op::Less, Op::LessEqual]), 2 + self.rng.below(5))
        };
        let read = Box::new(Expr::Read(place.clone(), ty.clone()));
        let mut test = Expr::Binary(op, read, Box::new(number(bound as i32, base)), BOOL);
        if self.rng.percent(25) {
            test = Expr::Logic(Logic::And, Box::new(test), Box::new(self.value(&BOOL, 1)));
        }
        let free = self.rng.percent(30);
        if !free {
            self.counters.push(counter);
        }
        self.stepped.push(counter);
        let mut body = self.loop_body(Vec::new());
        self.stepped.pop();
        // The variable is still in scope after the loop, so it remains a counter.
        let by = *self.rng.pick(&[1, 1, 1, 2, 1_500_000_000]);
        let op = if down { Op::Sub } else { Op::Add };
        let step = Stmt::Expr(Expr::AssignOp(op, place, Box::new(number(by, base)), ty));
        let at = self.rng.below(body.len() + 1);
        if self.rng.percent(25) {
            // At the start, as declarations of the body hide names that the condition may use.
            let cond = self.condition();
            body.insert(0, Stmt::If(cond, vec![step], Vec::new()));
        } else {
            body.insert(at, step);
        }
        body.insert(0, Stmt::Fuel);
        Stmt::While(test, body)
    }

    fn switch(&mut self) -> Stmt {
        let ty = if self.rng.percent(80) { INT } else { UINT };
        let base = ty.base().expect("a scalar");
        let value = self.value(&ty, 2);
        let value = match self.rng.percent(70) && !value.is_constant(&self.program.vars) {
            true => Expr::Binary(Op::And, Box::new(value), Box::new(number(3, base)), ty),
            false => value,
        };
        let mut labels: Vec<Option<u32>> = (0..1 + self.rng.below(5)).map(|i| Some(i as u32)).collect();
        if self.rng.percent(60) {
            labels.insert(self.rng.below(labels.len() + 1), None);
        }
        let mut cases: Vec<(Vec<Option<u32>>, Vec<Stmt>)> = Vec::new();
        self.breakable += 1;
        self.scopes.push(Vec::new());
        self.cases.push(self.scopes.len());
        while !labels.is_empty() {
            let count = if labels.len() > 1 && self.rng.percent(20) { 2 } else { 1 };
            let taken = labels.drain(..count).collect();
            let count = 1 + self.rng.below(2);
            // A variable declared in one case is visible in the next, but may be uninitialised: it is not used there.
            let before = self.scopes.last().expect("a scope").len();
            let mut body = self.statements(count);
            self.scopes.last_mut().expect("a scope").truncate(before);
            if self.rng.percent(60) {
                body.push(Stmt::Break);
            }
            cases.push((taken, body));
        }
        self.scopes.pop();
        self.cases.pop();
        self.breakable -= 1;
        Stmt::Switch(value, cases)
    }
}

pub(super) fn number(value: i32, base: Base) -> Expr {
    Expr::Literal(if base == Base::Float { (value as f32).to_bits() } else { value as u32 }, base)
}
