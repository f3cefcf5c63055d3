//! Generates expressions.

use super::{
    Arg, BOOL, Base, Expr, FLOAT, INT, Link, Logic, Mode, Op, Place, Prefix, Ty, UINT, VarId,
    make::{Maker, number},
};

impl Maker {
    /// Generates an expression of this type, of at most this depth.
    pub(super) fn value(&mut self, ty: &Ty, depth: usize) -> Expr {
        if depth == 0 || self.rng.percent(25) {
            if let (true, Some(read)) = (self.rng.percent(75), self.read(ty, depth)) {
                return read;
            }
            return self.leaf(ty, depth);
        }
        if self.rng.percent(10)
            && let Some(call) = self.call(Some(ty), depth)
        {
            return call;
        }
        let scalar = self.scalar_type();
        if matches!(ty, Ty::Num(..))
            && self.rng.percent(4)
            && let Some(first) = self.effect_of(&scalar, depth - 1)
        {
            return Expr::Comma(Box::new(first), Box::new(self.value(ty, depth - 1)));
        }
        if self.rng.percent(6) && matches!(ty, Ty::Num(..) | Ty::Mat(..)) {
            let cond = self.value(&BOOL, depth - 1);
            let (then, otherwise) = (self.value(ty, depth - 1), self.value(ty, depth - 1));
            return Expr::Ternary(Box::new(cond), Box::new(then), Box::new(otherwise), ty.clone());
        }
        match ty {
            Ty::Num(Base::Bool, 1) => self.bool(depth),
            Ty::Num(base @ (Base::Int | Base::Uint), size) => self.number(*base, *size, depth),
            _ => match self.read(ty, depth) {
                Some(read) if self.rng.percent(70) => read,
                _ => self.leaf(ty, depth),
            },
        }
    }

    /// Generates an expression without variables.
    fn leaf(&mut self, ty: &Ty, depth: usize) -> Expr {
        match ty {
            Ty::Num(Base::Float, 1) => self.float(depth),
            Ty::Num(Base::Int, 1) if self.rng.percent(30) => Expr::Given(self.rng.below(3)),
            Ty::Num(Base::Int, 1) if self.rng.percent(25) => Expr::Convert(Base::Int, Box::new(self.fetch(depth))),
            Ty::Num(_, 1) => self.literals(ty),
            _ => self.construct(ty, depth),
        }
    }

    /// Generates a float with a small whole value.
    fn float(&mut self, depth: usize) -> Expr {
        if depth == 0 || self.rng.percent(30) {
            return number(self.rng.below(50) as i32, Base::Float);
        }
        if self.rng.percent(30) {
            return self.fetch(depth);
        }
        let of = self.value(&INT, depth - 1);
        let small = Expr::Binary(Op::And, Box::new(of), Box::new(number(4095, Base::Int)), INT);
        Expr::Convert(Base::Float, Box::new(small))
    }

    fn fetch(&mut self, depth: usize) -> Expr {
        let coordinate = |maker: &mut Self| match maker.rng.below(4) {
            _ if depth == 0 => Expr::Given(maker.rng.below(2)),
            0 => maker.value(&INT, depth.min(2) - 1),
            1 => Expr::Given(maker.rng.below(2)),
            _ => {
                let of = maker.value(&INT, depth.min(2) - 1);
                Expr::Binary(Op::And, Box::new(of), Box::new(number(7, Base::Int)), INT)
            }
        };
        let at = (coordinate(self), coordinate(self));
        Expr::Fetch { channel: self.rng.below(2), at: Box::new(at), component: self.rng.below(4) as u8 }
    }

    /// Generates a constant expression.
    pub(super) fn literals(&mut self, ty: &Ty) -> Expr {
        match ty {
            Ty::Num(Base::Bool, 1) => Expr::Literal(self.rng.below(2) as u32, Base::Bool),
            Ty::Num(Base::Float, 1) => number(self.rng.below(50) as i32, Base::Float),
            Ty::Num(base, 1) => {
                let wild = [i32::MIN, i32::MAX, -1, 0, 255, 65536, -65536, 1_000_003];
                let value = match self.rng.below(10) {
                    0 => *self.rng.pick(&wild),
                    1 if *base == Base::Int => -(self.rng.below(9) as i32),
                    _ => self.rng.below(9) as i32,
                };
                number(value, *base)
            }
            Ty::Num(base, size) => {
                let parts = (0..*size).map(|_| self.literals(&Ty::Num(*base, 1))).collect();
                Expr::Construct(ty.clone(), parts)
            }
            Ty::Mat(columns, rows) => {
                let parts = (0..columns * rows).map(|_| self.literals(&FLOAT)).collect();
                Expr::Construct(ty.clone(), parts)
            }
            Ty::Array(element, len) => {
                let parts = (0..*len).map(|_| self.literals(element)).collect();
                Expr::Construct(ty.clone(), parts)
            }
            Ty::Struct(id) => {
                let fields = self.program.structs[*id].clone();
                let parts = fields.iter().map(|field| self.literals(field)).collect();
                Expr::Construct(ty.clone(), parts)
            }
        }
    }

    /// Generates a constructor.
    pub(super) fn construct(&mut self, ty: &Ty, depth: usize) -> Expr {
        let depth = depth.saturating_sub(1);
        let parts: Vec<Ty> = match ty {
            Ty::Num(base, 1) => return self.value(&Ty::Num(*base, 1), depth),
            Ty::Num(base, size) => {
                let first = self.rng.below((*size).into()) as u8;
                let scalar = Ty::Num(*base, 1);
                if first >= 2 {
                    let mut parts = vec![Ty::Num(*base, first)];
                    parts.extend((first..*size).map(|_| scalar.clone()));
                    parts
                } else {
                    vec![scalar; (*size).into()]
                }
            }
            Ty::Mat(columns, rows) if self.rng.percent(50) => vec![Ty::Num(Base::Float, *rows); (*columns).into()],
            Ty::Mat(columns, rows) => vec![FLOAT; (columns * rows).into()],
            Ty::Array(element, len) => vec![(**element).clone(); *len as usize],
            Ty::Struct(id) => self.program.structs[*id].clone(),
        };
        // Longer texts do not test more.
        if self.program.words(ty) > 8 && self.rng.percent(70) {
            return self.literals(ty);
        }
        Expr::Construct(ty.clone(), parts.iter().map(|part| self.value(part, depth)).collect())
    }

    fn bool(&mut self, depth: usize) -> Expr {
        match self.rng.below(8) {
            0 | 1 => {
                let op = *self.rng.pick(&[Logic::And, Logic::Or, Logic::Xor]);
                let left = self.value(&BOOL, depth - 1);
                Expr::Logic(op, Box::new(left), Box::new(self.value(&BOOL, depth - 1)))
            }
            2 => Expr::Prefix(Prefix::Not, Box::new(self.value(&BOOL, depth - 1)), BOOL),
            3 => {
                let ty = self.any_type();
                let op = *self.rng.pick(&[Op::Equal, Op::NotEqual]);
                match (self.read(&ty, depth), self.read(&ty, depth)) {
                    (Some(left), Some(right)) => Expr::Binary(op, Box::new(left), Box::new(right), BOOL),
                    _ => self.leaf(&BOOL, depth),
                }
            }
            _ => {
                let ty = if self.rng.percent(70) { INT } else { UINT };
                let op =
                    *self.rng.pick(&[Op::Less, Op::LessEqual, Op::Greater, Op::GreaterEqual, Op::Equal, Op::NotEqual]);
                let left = self.value(&ty, depth - 1);
                Expr::Binary(op, Box::new(left), Box::new(self.value(&ty, depth - 1)), BOOL)
            }
        }
    }

    /// Generates an expression of ints or uints.
    fn number(&mut self, base: Base, size: u8, depth: usize) -> Expr {
        let ty = Ty::Num(base, size);
        match self.rng.below(14) {
            0 if size == 1 => {
                let other = *self.rng.pick(&[Base::Int, Base::Uint, Base::Bool]);
                let of = self.value(&Ty::Num(other, 1), depth - 1);
                Expr::Convert(base, Box::new(of))
            }
            1 => {
                let op = *self.rng.pick(&[Prefix::Negate, Prefix::BitNot]);
                Expr::Prefix(op, Box::new(self.value(&ty, depth - 1)), ty)
            }
            2 => {
                let left = Box::new(self.value(&ty, depth - 1));
                let right = Box::new(self.value(&ty, depth - 1));
                Expr::Extreme { max: self.rng.percent(50), left, right, ty }
            }
            3 if size == 1 && base == Base::Int => Expr::Abs(Box::new(self.value(&ty, depth - 1))),
            4 if self.rng.percent(40) => self.effect_of(&ty, depth - 1).unwrap_or_else(|| self.leaf(&ty, depth)),
            5 if size == 1 => self.counter().unwrap_or_else(|| self.leaf(&ty, depth)).into_base(base),
            _ => self.arithmetic(&ty, base, size, depth),
        }
    }

    fn arithmetic(&mut self, ty: &Ty, base: Base, size: u8, depth: usize) -> Expr {
        let op = *self.rng.pick(&[
            Op::Add,
            Op::Add,
            Op::Sub,
            Op::Sub,
            Op::Mul,
            Op::Div,
            Op::Rem,
            Op::And,
            Op::Or,
            Op::Xor,
            Op::Shl,
            Op::Shr,
        ]);
        let scalar = Ty::Num(base, 1);
        let shift = matches!(op, Op::Shl | Op::Shr);
        let (left, right) = match self.rng.below(6) {
            0 if size > 1 && !shift => (&scalar, ty),
            1 if size > 1 => (ty, &scalar),
            _ => (ty, ty),
        };
        let left = self.value(left, depth - 1);
        let right = self.second(op, base, right, left.is_constant(&self.program.vars), depth);
        Expr::Binary(op, Box::new(left), Box::new(right), ty.clone())
    }

    /// Generates the right side of an operator. Operations that GLSL leaves undefined must not be constant, as the
    /// compiler would fold them in its own way.
    fn second(&mut self, op: Op, base: Base, ty: &Ty, constant: bool, depth: usize) -> Expr {
        let right = self.value(ty, depth - 1);
        match op {
            Op::Shl | Op::Shr if right.is_constant(&self.program.vars) => number(self.rng.below(32) as i32, base),
            Op::Div | Op::Rem if right.is_constant(&self.program.vars) => {
                if constant {
                    // One of the sides must not be constant.
                    let other = self.read(ty, depth).filter(|read| !read.is_constant(&self.program.vars));
                    return other.unwrap_or_else(|| self.non_constant(ty));
                }
                if right.has_zero() { self.non_constant(ty) } else { right }
            }
            _ => right,
        }
    }

    /// Generates an expression that is not constant.
    fn non_constant(&mut self, ty: &Ty) -> Expr {
        let base = ty.base().expect("numbers");
        let of = Expr::Given(self.rng.below(3)).into_base(base);
        match ty {
            Ty::Num(_, 1) => of,
            _ => Expr::Construct(ty.clone(), vec![of]),
        }
    }

    /// Generates a read of a loop's counter, or a value near it.
    fn counter(&mut self) -> Option<Expr> {
        let visible = self.visible();
        let mut counters: Vec<VarId> = self.counters.iter().copied().filter(|v| visible.contains(v)).collect();
        if counters.is_empty() {
            return None;
        }
        let counter = counters.swap_remove(self.rng.below(counters.len()));
        let read = self.counted(counter);
        let base = read.ty().base().expect("a scalar");
        let ty = read.ty();
        let small = Box::new(number(self.rng.below(4) as i32, base));
        let binary = |op| Expr::Binary(op, Box::new(read.clone()), small.clone(), ty.clone());
        Some(match self.rng.below(10) {
            0 => binary(Op::Add),
            1 => binary(Op::Sub),
            2 => binary(Op::Mul),
            3 => binary(Op::And),
            4 => Expr::Binary(Op::Sub, small, Box::new(read), ty),
            5 => Expr::Binary(Op::Rem, Box::new(read), Box::new(number(3, base)), ty),
            6 => Expr::Binary(Op::Shr, Box::new(read), Box::new(number(1, base)), ty),
            _ => read,
        })
    }

    /// Generates an index: often known to be in range, as often not.
    fn index(&mut self, len: u32, depth: usize) -> Expr {
        if self.rng.percent(25) || depth == 0 && self.rng.percent(50) {
            return number(self.rng.below(len as usize) as i32, Base::Int);
        }
        if let (true, Some(counter)) = (self.rng.percent(60), self.counter()) {
            return counter;
        }
        let ty = if self.rng.percent(75) { INT } else { UINT };
        let index = match depth {
            0 => {
                let mut vars = self.visible();
                vars.retain(|&var| self.program.vars[var].ty == ty);
                match vars[..] {
                    [] => Expr::Given(self.rng.below(3)),
                    _ => Expr::Read(Place::whole(*self.rng.pick(&vars)), ty),
                }
            }
            _ => self.value(&ty, depth.min(2) - 1),
        };
        if index.is_constant(&self.program.vars) {
            return number(self.rng.below(len as usize) as i32, Base::Int);
        }
        index
    }

    /// Generates a read of a variable or a part of one.
    fn read(&mut self, ty: &Ty, depth: usize) -> Option<Expr> {
        let place = self.place(ty, depth, false)?;
        Some(Expr::Read(place, ty.clone()))
    }

    /// Picks a place of this type.
    fn place(&mut self, ty: &Ty, depth: usize, to_write: bool) -> Option<Place> {
        let mut vars = self.visible();
        vars.retain(|var| {
            let declared = &self.program.vars[*var];
            // Float counters are read as ints, and not written.
            let counter = self.counters.contains(var);
            let float = declared.ty == FLOAT && counter;
            !(float || to_write && (declared.constant || counter))
        });
        for _ in 0..8 {
            if vars.is_empty() {
                return None;
            }
            let var = *self.rng.pick(&vars);
            let mut place = Place::whole(var);
            let mut at = self.program.vars[var].ty.clone();
            while at != *ty {
                let link = match &at {
                    Ty::Num(_, 1) => break,
                    Ty::Num(_, size) => match ty {
                        Ty::Num(_, 1) if self.rng.percent(50) => {
                            Link::Index(Box::new(self.index((*size).into(), depth)))
                        }
                        Ty::Num(_, wanted) if wanted <= size || !to_write => {
                            let mut components: Vec<u8> = (0..*size).collect();
                            let take = |maker: &mut Self, components: &mut Vec<u8>| {
                                components.swap_remove(maker.rng.below(components.len()))
                            };
                            let picked = (0..*wanted).map(|_| match to_write {
                                true => take(self, &mut components),
                                false => *self.rng.pick(&components),
                            });
                            Link::Swizzle(picked.collect())
                        }
                        _ => break,
                    },
                    Ty::Struct(id) => Link::Field(self.rng.below(self.program.structs[*id].len())),
                    Ty::Mat(..) | Ty::Array(..) => Link::Index(Box::new(self.index(at.extent(), depth))),
                };
                // A swizzle of another base type cannot lead to this type.
                if matches!(link, Link::Swizzle(_)) && at.base() != ty.base() {
                    break;
                }
                at = self.program.part(&at, &link);
                place.path.push(link);
            }
            if at == *ty {
                return Some(place);
            }
        }
        None
    }

    /// Generates an expression with side effects.
    pub(super) fn effect(&mut self) -> Expr {
        for _ in 0..6 {
            if let (true, Some(call)) = (self.rng.percent(20), self.call(None, 2)) {
                return call;
            }
            let ty = match self.rng.below(10) {
                0 => self.any_type(),
                1 => Ty::Num(*self.rng.pick(&[Base::Int, Base::Uint, Base::Float]), 1 + self.rng.below(4) as u8),
                2 => FLOAT,
                _ => self.scalar_type(),
            };
            if let Some(effect) = self.effect_of(&ty, 3) {
                return effect;
            }
        }
        Expr::Given(0)
    }

    /// Generates an assignment of this type.
    fn effect_of(&mut self, ty: &Ty, depth: usize) -> Option<Expr> {
        let place = self.place(ty, depth.min(2), true)?;
        let whole = matches!(ty.base(), Some(Base::Int | Base::Uint));
        let base = ty.base().unwrap_or(Base::Int);
        Some(match self.rng.below(8) {
            0 if whole && *ty == Ty::Num(base, 1) => {
                let (down, before) = (self.rng.percent(50), self.rng.percent(50));
                Expr::Step { place, ty: ty.clone(), down, before }
            }
            1..=3 if whole => {
                let op =
                    *self.rng.pick(&[Op::Add, Op::Sub, Op::Mul, Op::Div, Op::Rem, Op::And, Op::Or, Op::Xor, Op::Shl]);
                let mut value = match op {
                    Op::Shl => number(self.rng.below(32) as i32, base),
                    _ => self.second(op, base, ty, false, depth.max(1)),
                };
                // The guarded text names the place twice.
                let pure = |value: &Expr| !value.has_effects();
                if matches!(op, Op::Div | Op::Rem) && !(pure(&value) && place.indices().all(pure)) {
                    value = self.value(ty, 0);
                    return Some(Expr::Assign(place, Box::new(value), ty.clone()));
                }
                Expr::AssignOp(op, place, Box::new(value), ty.clone())
            }
            _ => Expr::Assign(place, Box::new(self.value(ty, depth)), ty.clone()),
        })
    }

    /// Generates a call of a function with this result type; of any function if no value is needed.
    fn call(&mut self, result: Option<&Ty>, depth: usize) -> Option<Expr> {
        let functions = &self.program.functions;
        let fits = |at: &usize| result.is_none() || functions[*at].result.as_ref() == result;
        let candidates: Vec<usize> = (0..functions.len()).filter(fits).collect();
        if candidates.is_empty() {
            return None;
        }
        let function = *self.rng.pick(&candidates);
        let params = self.program.functions[function].params.clone();
        let mut args = Vec::new();
        for (param, mode) in params {
            let ty = self.program.vars[param].ty.clone();
            args.push(match mode {
                Mode::In => Arg::In(self.value(&ty, depth.saturating_sub(1).min(1))),
                _ => Arg::Place(self.place(&ty, depth.min(1), true)?),
            });
        }
        let ty = self.program.functions[function].result.clone().unwrap_or(INT);
        Some(Expr::Call(function, args, ty))
    }
}

impl Expr {
    /// Converts the expression if it is not of that type.
    fn into_base(self, base: Base) -> Expr {
        if self.ty().base() == Some(base) { self } else { Expr::Convert(base, Box::new(self)) }
    }

    /// Returns whether a constant may contain a zero.
    fn has_zero(&self) -> bool {
        match self {
            Expr::Literal(bits, _) => *bits == 0,
            Expr::Construct(_, parts) => parts.iter().any(Expr::has_zero),
            _ => true,
        }
    }
}
