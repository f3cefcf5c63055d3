//! Runs a program for one pixel: 32-bit words that wrap, evaluation from left to right, and Eddy's guarantees where
//! GLSL leaves behaviour undefined.

use super::{Arg, Base, Expr, FUEL, Link, Logic, Mode, Op, Place, Prefix, Program, Stmt, Ty, VarId};

/// The inputs of a pixel.
pub(crate) struct Inputs<'a> {
    /// Column, row, frame number.
    pub given: [i32; 3],
    /// The contents of the channels: the number of columns, and texels from the bottom left.
    pub channels: [(usize, &'a [[f32; 4]]); 2],
}

/// The program exceeded its limit of steps.
#[derive(Debug)]
pub(crate) struct TooLong;

/// Returns the texel of the program; `steps` counts down.
pub(crate) fn run(program: &Program, inputs: &Inputs<'_>, steps: &mut u32) -> Result<[f32; 4], TooLong> {
    let mut machine = Machine {
        program,
        inputs,
        memory: program.vars.iter().map(|var| vec![0; program.words(&var.ty)]).collect(),
        fuel: FUEL,
        steps,
    };
    for (var, init) in &program.globals {
        machine.statement(&Stmt::Declare(*var, init.clone()))?;
    }
    machine.statements(&program.body)?;
    let (mut r0, mut r1) = (0u32, 7u32);
    for &var in program.globals.iter().map(|(var, _)| var).chain(&program.results) {
        let mut bases = Vec::new();
        bases_of(program, &program.vars[var].ty, &mut bases);
        for (&word, base) in machine.memory[var].iter().zip(bases) {
            let x = convert(word, base, Base::Uint);
            r0 = r0.wrapping_mul(31).wrapping_add(x);
            r1 = (r1 ^ x).wrapping_mul(2_654_435_769).wrapping_add(r1 >> 7);
        }
    }
    Ok([r0 & 65535, r0 >> 16, r1 & 65535, r1 >> 16].map(|half| half as f32))
}

/// Appends the type of each word of a value.
fn bases_of(program: &Program, ty: &Ty, out: &mut Vec<Base>) {
    match ty {
        Ty::Num(base, size) => out.extend(std::iter::repeat_n(*base, (*size).into())),
        Ty::Mat(columns, rows) => out.extend(std::iter::repeat_n(Base::Float, (columns * rows).into())),
        Ty::Array(element, len) => (0..*len).for_each(|_| bases_of(program, element, out)),
        Ty::Struct(id) => program.structs[*id].iter().for_each(|field| bases_of(program, field, out)),
    }
}

enum Flow {
    Next,
    Break,
    Continue,
    Return(Vec<u32>),
}

type Words = Vec<u32>;

struct Machine<'a> {
    program: &'a Program,
    inputs: &'a Inputs<'a>,
    /// By variable: without recursion, one instance is enough.
    memory: Vec<Words>,
    fuel: i32,
    steps: &'a mut u32,
}

impl Machine<'_> {
    fn statements(&mut self, list: &[Stmt]) -> Result<Flow, TooLong> {
        for stmt in list {
            match self.statement(stmt)? {
                Flow::Next => {}
                other => return Ok(other),
            }
        }
        Ok(Flow::Next)
    }

    fn statement(&mut self, stmt: &Stmt) -> Result<Flow, TooLong> {
        *self.steps = self.steps.checked_sub(1).ok_or(TooLong)?;
        match stmt {
            Stmt::Declare(var, init) => {
                let value = match init {
                    Some(init) => self.value(init)?,
                    None => vec![0; self.memory[*var].len()],
                };
                self.memory[*var] = value;
            }
            Stmt::Expr(expr) => _ = self.value(expr)?,
            Stmt::If(cond, then, otherwise) => {
                let then = if self.scalar(cond)? != 0 { then } else { otherwise };
                return self.statements(then);
            }
            Stmt::For { init, test, step, body } => {
                if let Some(init) = init {
                    self.statement(init)?;
                }
                while test.as_ref().map_or(Ok(1), |test| self.scalar(test))? != 0 {
                    match self.statements(body)? {
                        Flow::Break => break,
                        Flow::Return(value) => return Ok(Flow::Return(value)),
                        Flow::Next | Flow::Continue => {}
                    }
                    if let Some(step) = step {
                        self.value(step)?;
                    }
                }
            }
            Stmt::While(test, body) => {
                while self.scalar(test)? != 0 {
                    match self.statements(body)? {
                        Flow::Break => break,
                        Flow::Return(value) => return Ok(Flow::Return(value)),
                        Flow::Next | Flow::Continue => {}
                    }
                }
            }
            Stmt::Do(body, test) => loop {
                match self.statements(body)? {
                    Flow::Break => break,
                    Flow::Return(value) => return Ok(Flow::Return(value)),
                    Flow::Next | Flow::Continue => {}
                }
                if self.scalar(test)? == 0 {
                    break;
                }
            },
            Stmt::Switch(value, cases) => {
                let value = self.scalar(value)?;
                let find = |label| cases.iter().position(|(labels, _)| labels.contains(&label));
                let first = find(Some(value)).or_else(|| find(None)).unwrap_or(cases.len());
                for (_, body) in &cases[first..] {
                    match self.statements(body)? {
                        Flow::Next => {}
                        Flow::Break => break,
                        other => return Ok(other),
                    }
                }
            }
            Stmt::Block(list) => return self.statements(list),
            Stmt::Fuel => {
                self.fuel = self.fuel.wrapping_sub(1);
                if self.fuel < 0 {
                    return Ok(Flow::Break);
                }
            }
            Stmt::Break => return Ok(Flow::Break),
            Stmt::Continue => return Ok(Flow::Continue),
            Stmt::Return(value) => {
                return Ok(Flow::Return(value.as_ref().map_or(Ok(Vec::new()), |value| self.value(value))?));
            }
        }
        Ok(Flow::Next)
    }

    /// Returns the words of a variable that a place names, with its indices clamped.
    fn place(&mut self, place: &Place) -> Result<(VarId, Vec<usize>), TooLong> {
        let mut ty = self.program.vars[place.var].ty.clone();
        let mut at: Vec<usize> = (0..self.memory[place.var].len()).collect();
        for link in &place.path {
            let part = self.program.part(&ty, link);
            let size = self.program.words(&part);
            match link {
                Link::Field(index) => {
                    let Ty::Struct(id) = ty else { unreachable!("a field of a type that is not a structure") };
                    let before: usize = self.program.structs[id][..*index].iter().map(|f| self.program.words(f)).sum();
                    at = at[before..before + size].to_vec();
                }
                Link::Index(index) => {
                    let last = ty.extent() as usize - 1;
                    let bits = self.scalar(index)?;
                    let index = match index.ty().base() {
                        Some(Base::Int) if (bits as i32) < 0 => 0,
                        _ => (bits as usize).min(last),
                    };
                    at = at[index * size..][..size].to_vec();
                }
                Link::Swizzle(components) => at = components.iter().map(|&c| at[usize::from(c)]).collect(),
            }
            ty = part;
        }
        Ok((place.var, at))
    }

    fn load(&self, (var, at): &(VarId, Vec<usize>)) -> Words {
        at.iter().map(|&at| self.memory[*var][at]).collect()
    }

    fn store(&mut self, (var, at): &(VarId, Vec<usize>), value: &[u32]) {
        for (&at, &word) in at.iter().zip(value) {
            self.memory[*var][at] = word;
        }
    }

    /// Evaluates an operand; a variable is read only after all operands have been evaluated.
    fn operand(&mut self, expr: &Expr) -> Result<Operand, TooLong> {
        Ok(match expr {
            Expr::Read(place, _) => Operand::Place(self.place(place)?),
            _ => Operand::Value(self.value(expr)?),
        })
    }

    fn read(&self, operand: Operand) -> Words {
        match operand {
            Operand::Value(words) => words,
            Operand::Place(at) => self.load(&at),
        }
    }

    fn both(&mut self, left: &Expr, right: &Expr) -> Result<(Words, Words), TooLong> {
        let (left, right) = (self.operand(left)?, self.operand(right)?);
        Ok((self.read(left), self.read(right)))
    }

    fn scalar(&mut self, expr: &Expr) -> Result<u32, TooLong> {
        Ok(self.value(expr)?[0])
    }

    fn value(&mut self, expr: &Expr) -> Result<Words, TooLong> {
        *self.steps = self.steps.checked_sub(1).ok_or(TooLong)?;
        Ok(match expr {
            Expr::Literal(bits, _) => vec![*bits],
            Expr::Read(place, _) => {
                let at = self.place(place)?;
                self.load(&at)
            }
            Expr::Prefix(op, of, ty) => {
                let value = self.value(of)?;
                let float = ty.base() == Some(Base::Float);
                let each = |bits: u32| match op {
                    Prefix::Negate if float => (-f32::from_bits(bits)).to_bits(),
                    Prefix::Negate => bits.wrapping_neg(),
                    Prefix::BitNot => !bits,
                    Prefix::Not => u32::from(bits == 0),
                };
                value.into_iter().map(each).collect()
            }
            Expr::Binary(op, left, right, ty) => {
                let base = left.ty().base();
                let (l, r) = self.both(left, right)?;
                binary(*op, base.unwrap_or(Base::Int), &l, &r, ty)
            }
            Expr::Logic(Logic::Xor, left, right) => {
                let (l, r) = self.both(left, right)?;
                vec![((l[0] != 0) != (r[0] != 0)).into()]
            }
            Expr::Logic(op, left, right) => {
                let left = self.scalar(left)? != 0;
                let value = match op {
                    Logic::And => left && self.scalar(right)? != 0,
                    Logic::Or => left || self.scalar(right)? != 0,
                    Logic::Xor => unreachable!("handled above"),
                };
                vec![value.into()]
            }
            Expr::Ternary(cond, then, otherwise, _) => {
                let chosen = if self.scalar(cond)? != 0 { then } else { otherwise };
                self.value(chosen)?
            }
            Expr::Convert(to, of) => {
                let from = of.ty().base().expect("a scalar");
                vec![convert(self.scalar(of)?, from, *to)]
            }
            Expr::Construct(ty, parts) => {
                let mut words = Vec::new();
                let parts: Vec<Operand> = parts.iter().map(|part| self.operand(part)).collect::<Result<_, _>>()?;
                for part in parts {
                    words.extend(self.read(part));
                }
                if let (Ty::Num(_, size), 1) = (ty, words.len()) {
                    words = vec![words[0]; (*size).into()];
                }
                words
            }
            Expr::Call(function, args, _) => self.call(*function, args)?,
            Expr::Comma(first, last) => {
                self.value(first)?;
                self.value(last)?
            }
            Expr::Assign(place, value, _) => {
                let at = self.place(place)?;
                let value = self.value(value)?;
                self.store(&at, &value);
                value
            }
            Expr::AssignOp(op, place, value, ty) => {
                let at = self.place(place)?;
                let right = self.value(value)?;
                let left = self.load(&at);
                let result = binary(*op, ty.base().expect("numbers"), &left, &right, ty);
                self.store(&at, &result);
                result
            }
            Expr::Step { place, ty, down, before } => {
                let at = self.place(place)?;
                let old = self.load(&at);
                let base = ty.base().expect("a number");
                let one = if base == Base::Float { 1f32.to_bits() } else { 1 };
                let new = binary(if *down { Op::Sub } else { Op::Add }, base, &old, &[one], ty);
                self.store(&at, &new);
                if *before { new } else { old }
            }
            Expr::Extreme { max, left, right, ty } => {
                let signed = ty.base() == Some(Base::Int);
                let (l, r) = self.both(left, right)?;
                let key = |bits: u32| if signed { i64::from(bits as i32) } else { i64::from(bits) };
                let pick = |(i, &l): (usize, &u32)| {
                    let r = r[i.min(r.len() - 1)];
                    if (key(l) < key(r)) == *max { r } else { l }
                };
                l.iter().enumerate().map(pick).collect()
            }
            Expr::Abs(of) => vec![(self.scalar(of)? as i32).wrapping_abs() as u32],
            Expr::Fetch { channel, at, component } => {
                let (x, y) = self.both(&at.0, &at.1)?;
                let (x, y) = (x[0] as i32, y[0] as i32);
                let (width, texels) = self.inputs.channels[*channel];
                let height = texels.len() / width;
                let inside = (0..width as i32).contains(&x) && (0..height as i32).contains(&y);
                let texel = if inside { texels[y as usize * width + x as usize] } else { [0.0; 4] };
                vec![texel[usize::from(*component)].to_bits()]
            }
            Expr::Given(which) => vec![self.inputs.given[*which] as u32],
        })
    }

    fn call(&mut self, function: usize, args: &[Arg]) -> Result<Words, TooLong> {
        let function = &self.program.functions[function];
        let mut values = Vec::new();
        let mut copies_out = Vec::new();
        for ((param, mode), arg) in function.params.iter().zip(args) {
            values.push(match arg {
                Arg::In(value) => self.operand(value)?,
                Arg::Place(place) => {
                    let at = self.place(place)?;
                    copies_out.push((at.clone(), *param));
                    if *mode == Mode::Inout { Operand::Place(at) } else { Operand::Value(vec![0; at.1.len()]) }
                }
            });
        }
        let values: Vec<Words> = values.into_iter().map(|value| self.read(value)).collect();
        for ((param, _), value) in function.params.iter().zip(values) {
            self.memory[*param] = value;
        }
        let flow = self.statements(&function.body)?;
        for (at, param) in copies_out {
            let value = self.memory[param].clone();
            self.store(&at, &value);
        }
        Ok(match (flow, &function.result) {
            (Flow::Return(value), _) => value,
            (_, Some(ty)) => vec![0; self.program.words(ty)],
            _ => Vec::new(),
        })
    }
}

/// An evaluated operand: its value, or the place to read.
enum Operand {
    Value(Words),
    Place((VarId, Vec<usize>)),
}

fn convert(bits: u32, from: Base, to: Base) -> u32 {
    match (from, to) {
        (Base::Float, Base::Int) => f32::from_bits(bits) as i32 as u32,
        (Base::Float, Base::Uint) => f32::from_bits(bits) as u32,
        (Base::Float, Base::Bool) => u32::from(f32::from_bits(bits) != 0.0),
        (Base::Int, Base::Float) => (bits as i32 as f32).to_bits(),
        (Base::Uint | Base::Bool, Base::Float) => (bits as f32).to_bits(),
        (Base::Int | Base::Uint, Base::Bool) => u32::from(bits != 0),
        _ => bits,
    }
}

/// Applies an operator to each component; `ty` is the result's type, `base` that of the left side.
fn binary(op: Op, base: Base, l: &[u32], r: &[u32], ty: &Ty) -> Words {
    match op {
        Op::Equal | Op::NotEqual => {
            let same = match base {
                // No matrix or structure contains a NaN or a negative zero.
                Base::Float => l.iter().zip(r).all(|(&l, &r)| f32::from_bits(l) == f32::from_bits(r)),
                _ => l == r,
            };
            return vec![u32::from(same == (op == Op::Equal))];
        }
        _ => {}
    }
    let count = match ty {
        Ty::Num(_, size) => usize::from(*size),
        _ => l.len().max(r.len()),
    };
    let each = |i: usize| {
        let (l, r) = (l[i.min(l.len() - 1)], r[i.min(r.len() - 1)]);
        if base == Base::Float { float(op, f32::from_bits(l), f32::from_bits(r)) } else { int(op, base, l, r) }
    };
    (0..count).map(each).collect()
}

fn float(op: Op, l: f32, r: f32) -> u32 {
    match op {
        Op::Add => (l + r).to_bits(),
        Op::Sub => (l - r).to_bits(),
        Op::Less => (l < r).into(),
        Op::LessEqual => (l <= r).into(),
        Op::Greater => (l > r).into(),
        Op::GreaterEqual => (l >= r).into(),
        other => unreachable!("{other:?} of floats"),
    }
}

fn int(op: Op, base: Base, l: u32, r: u32) -> u32 {
    let signed = base == Base::Int;
    let order = if signed { (l as i32).cmp(&(r as i32)) } else { l.cmp(&r) };
    match op {
        Op::Add => l.wrapping_add(r),
        Op::Sub => l.wrapping_sub(r),
        Op::Mul => l.wrapping_mul(r),
        Op::Div if r == 0 => l,
        Op::Div if signed => (l as i32).wrapping_div(r as i32) as u32,
        Op::Div => l / r,
        Op::Rem if r == 0 => 0,
        Op::Rem if signed => {
            let (l, r) = (l as i32, r as i32);
            let rest = l.wrapping_rem(r);
            // The result has the divisor's sign.
            (if rest != 0 && (rest ^ r) < 0 { rest + r } else { rest }) as u32
        }
        Op::Rem => l % r,
        Op::And => l & r,
        Op::Or => l | r,
        Op::Xor => l ^ r,
        Op::Shl => l << (r & 31),
        Op::Shr if signed => ((l as i32) >> (r & 31)) as u32,
        Op::Shr => l >> (r & 31),
        Op::Less => order.is_lt().into(),
        Op::LessEqual => order.is_le().into(),
        Op::Greater => order.is_gt().into(),
        Op::GreaterEqual => order.is_ge().into(),
        Op::Equal | Op::NotEqual => unreachable!("compared as whole values"),
    }
}
