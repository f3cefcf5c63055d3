//! A program as text: as an author writes it, or with everything written out that GLSL leaves to the implementation.

use super::{Arg, Base, Expr, FUEL, Function, Link, Logic, Mode, Op, Place, Prefix, Program, Stmt, Ty};
use std::fmt::Write;

/// The form of the text.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Form {
    Plain,
    /// Every index is clamped, every variable initialised to zero, every division and shift guarded in the text.
    Explicit,
    /// As `Explicit`, but indices are clamped to one element fewer: a test of the comparison itself.
    Wrong,
}

/// Divisions as defined by Eddy.
const DIVISIONS: &str = "\
int quotient(int n, int d) { if (d == 0) return n; if (d == -1) return 0 - n; return n / d; }
int remainder(int n, int d) {
    if (d == 0 || d == -1) return 0;
    int r = n - (n / d) * d;
    if (r != 0 && (r ^ d) < 0) r += d;
    return r;
}
uint quotient(uint n, uint d) { if (d == 0u) return n; return n / d; }
uint remainder(uint n, uint d) { if (d == 0u) return 0u; return n % d; }
";

/// Returns the text of a pass.
pub(crate) fn print(program: &Program, form: Form) -> String {
    let mut printer = Printer { program, form, out: String::new(), depth: 0, result: None };
    printer.program();
    printer.out
}

struct Printer<'a> {
    program: &'a Program,
    form: Form,
    out: String,
    depth: usize,
    /// The result type of the current function.
    result: Option<Ty>,
}

impl Printer<'_> {
    fn program(&mut self) {
        let program = self.program;
        if self.form != Form::Plain {
            self.out.push_str(DIVISIONS);
            for size in 2..=4 {
                self.vector_divisions(size);
            }
        }
        for (id, fields) in program.structs.iter().enumerate() {
            let fields: String = fields
                .iter()
                .enumerate()
                .map(|(i, ty)| format!("{};", self.declaration(ty, &format!(" f{i}"))))
                .collect();
            let _ = writeln!(self.out, "struct S{id} {{ {fields} }};");
        }
        let _ = writeln!(self.out, "int fuel = {FUEL};\nint px, py;");
        for (var, init) in &program.globals {
            self.statement(&Stmt::Declare(*var, init.clone()));
        }
        for (id, function) in program.functions.iter().enumerate() {
            self.function(id, function);
        }
        self.out.push_str(
            "uint r0 = 0u, r1 = 7u;\nvoid mix_in(uint x) { r0 = r0 * 31u + x; r1 = (r1 ^ x) * \
                           2654435769u + (r1 >> 7u); }\n",
        );
        self.out.push_str("void mainImage(out vec4 o, in vec2 p) {\n  px = int(p.x); py = int(p.y);\n");
        self.depth = 1;
        self.statements(&program.body);
        for &var in program.globals.iter().map(|(var, _)| var).chain(&program.results) {
            let (name, ty) = (program.vars[var].name.clone(), program.vars[var].ty.clone());
            self.mix_in(&name, &ty);
        }
        self.out
            .push_str("  o = vec4(float(r0 & 65535u), float(r0 >> 16u), float(r1 & 65535u), float(r1 >> 16u));\n}\n");
    }

    /// Mixes each scalar of a variable into the results.
    fn mix_in(&mut self, name: &str, ty: &Ty) {
        match ty {
            Ty::Num(_, 1) => _ = writeln!(self.out, "  mix_in(uint({name}));"),
            Ty::Num(base, size) => {
                (0..*size).for_each(|i| self.mix_in(&format!("{name}[{i}]"), &Ty::Num(*base, 1)));
            }
            Ty::Mat(columns, rows) => {
                (0..*columns).for_each(|i| self.mix_in(&format!("{name}[{i}]"), &Ty::Num(Base::Float, *rows)));
            }
            // With one statement per scalar of a long array, drivers compile for minutes.
            Ty::Array(element, len) if self.program.words(ty) > 8 => {
                let counter = format!("k{}", name.matches('[').count());
                let _ = writeln!(self.out, "  for (int {counter} = 0; {counter} < {len}; {counter}++) {{");
                self.mix_in(&format!("{name}[{counter}]"), element);
                self.out.push_str("  }\n");
            }
            Ty::Array(element, len) => (0..*len).for_each(|i| self.mix_in(&format!("{name}[{i}]"), element)),
            Ty::Struct(id) => {
                for (i, field) in self.program.structs[*id].iter().enumerate() {
                    self.mix_in(&format!("{name}.f{i}"), field);
                }
            }
        }
    }

    fn vector_divisions(&mut self, size: u8) {
        for (base, scalar) in [("ivec", "int"), ("uvec", "uint")] {
            let vector = format!("{base}{size}");
            for name in ["quotient", "remainder"] {
                let parts: Vec<_> = (0..size).map(|i| format!("{name}(n[{i}], d[{i}])")).collect();
                let parts = parts.join(", ");
                let _ = writeln!(self.out, "{vector} {name}({vector} n, {vector} d) {{ return {vector}({parts}); }}");
                let _ = writeln!(
                    self.out,
                    "{vector} {name}({vector} n, {scalar} d) {{ return {name}(n, {vector}(d)); }}\n\
                     {vector} {name}({scalar} n, {vector} d) {{ return {name}({vector}(n), d); }}"
                );
            }
        }
    }

    fn line(&mut self, text: &str) {
        let _ = writeln!(self.out, "{:1$}{text}", "", 2 * self.depth);
    }

    fn function(&mut self, id: usize, function: &Function) {
        let result = function.result.as_ref().map_or("void".into(), |ty| self.declaration(ty, ""));
        let params: Vec<_> = function
            .params
            .iter()
            .map(|(var, mode)| {
                let var = &self.program.vars[*var];
                let mode = match mode {
                    Mode::In => "",
                    Mode::Out => "out ",
                    Mode::Inout => "inout ",
                };
                format!("{mode}{}", self.declaration(&var.ty, &format!(" {}", var.name)))
            })
            .collect();
        self.line(&format!("{result} g{id}({}) {{", params.join(", ")));
        self.depth = 1;
        if self.form != Form::Plain {
            for (var, _) in function.params.iter().filter(|(_, mode)| *mode == Mode::Out) {
                let var = &self.program.vars[*var];
                let zero = self.zero(&var.ty);
                self.line(&format!("{} = {zero};", var.name));
            }
        }
        self.result = function.result.clone();
        self.statements(&function.body);
        self.depth = 0;
        self.line("}");
    }

    /// Returns a type followed by the declared name; `name` starts with a space.
    fn declaration(&self, ty: &Ty, name: &str) -> String {
        format!("{}{name}", self.ty(ty))
    }

    fn ty(&self, ty: &Ty) -> String {
        match ty {
            Ty::Num(base, 1) => match base {
                Base::Int => "int",
                Base::Uint => "uint",
                Base::Bool => "bool",
                Base::Float => "float",
            }
            .into(),
            Ty::Num(base, size) => {
                let letter = match base {
                    Base::Int => "i",
                    Base::Uint => "u",
                    Base::Bool => "b",
                    Base::Float => "",
                };
                format!("{letter}vec{size}")
            }
            Ty::Mat(columns, rows) => format!("mat{columns}x{rows}"),
            Ty::Array(element, len) => match &**element {
                Ty::Array(..) => unreachable!("GLSL ES 3.00 has no arrays of arrays"),
                element => format!("{}[{len}]", self.ty(element)),
            },
            Ty::Struct(id) => format!("S{id}"),
        }
    }

    fn zero(&self, ty: &Ty) -> String {
        let parts = match ty {
            Ty::Num(Base::Bool, 1) => return "false".into(),
            Ty::Num(base, _) => vec![literal(0, *base)],
            Ty::Mat(..) => vec!["0.0".into()],
            Ty::Array(element, len) => vec![self.zero(element); *len as usize],
            Ty::Struct(id) => self.program.structs[*id].iter().map(|field| self.zero(field)).collect(),
        };
        format!("{}({})", self.ty(ty), parts.join(", "))
    }

    fn statements(&mut self, list: &[Stmt]) {
        list.iter().for_each(|stmt| self.statement(stmt));
    }

    fn block(&mut self, list: &[Stmt]) {
        self.depth += 1;
        self.statements(list);
        self.depth -= 1;
    }

    fn declare(&self, stmt: &Stmt) -> String {
        let Stmt::Declare(var, init) = stmt else { return format!("{};", self.effect(stmt)) };
        let var = &self.program.vars[*var];
        let constant = if var.constant { "const " } else { "" };
        let declared = format!("{constant}{}", self.declaration(&var.ty, &format!(" {}", var.name)));
        match init {
            Some(init) => format!("{declared} = {};", self.expr(init)),
            None if self.form == Form::Plain => format!("{declared};"),
            None => format!("{declared} = {};", self.zero(&var.ty)),
        }
    }

    fn effect(&self, stmt: &Stmt) -> String {
        match stmt {
            Stmt::Expr(expr) => self.expr(expr),
            other => unreachable!("{other:?}"),
        }
    }

    fn statement(&mut self, stmt: &Stmt) {
        match stmt {
            Stmt::Declare(..) | Stmt::Expr(_) => {
                let text = self.declare(stmt);
                self.line(&text);
            }
            Stmt::If(cond, then, otherwise) => {
                let cond = self.expr(cond);
                self.line(&format!("if ({cond}) {{"));
                self.block(then);
                if !otherwise.is_empty() {
                    self.line("} else {");
                    self.block(otherwise);
                }
                self.line("}");
            }
            Stmt::For { init, test, step, body } => {
                let init = init.as_ref().map_or(";".into(), |init| self.declare(init));
                let test = test.as_ref().map_or(String::new(), |test| self.expr(test));
                let step = step.as_ref().map_or(String::new(), |step| self.expr(step));
                self.line(&format!("for ({init} {test}; {step}) {{"));
                self.block(body);
                self.line("}");
            }
            Stmt::While(test, body) => {
                let test = self.expr(test);
                self.line(&format!("while ({test}) {{"));
                self.block(body);
                self.line("}");
            }
            Stmt::Do(body, test) => {
                self.line("do {");
                self.block(body);
                let test = self.expr(test);
                self.line(&format!("}} while ({test});"));
            }
            Stmt::Switch(value, cases) => {
                let unsigned = value.ty().base() == Some(Base::Uint);
                let value = self.expr(value);
                self.line(&format!("switch ({value}) {{"));
                for (labels, body) in cases {
                    for label in labels {
                        match label {
                            Some(bits) if unsigned => self.line(&format!("case {bits}u:")),
                            Some(bits) => self.line(&format!("case {}:", *bits as i32)),
                            None => self.line("default:"),
                        }
                    }
                    self.block(body);
                }
                self.line("}");
            }
            Stmt::Block(list) => {
                self.line("{");
                self.block(list);
                self.line("}");
            }
            Stmt::Fuel => self.line("if (--fuel < 0) break;"),
            Stmt::Break => self.line("break;"),
            Stmt::Continue => self.line("continue;"),
            Stmt::Return(None) => self.line("return;"),
            Stmt::Return(Some(value)) => {
                let value = self.expr(value);
                self.line(&format!("return {value};"));
            }
        }
    }

    fn place(&self, place: &Place) -> String {
        let var = &self.program.vars[place.var];
        let (mut text, mut ty) = (var.name.clone(), var.ty.clone());
        for link in &place.path {
            match link {
                Link::Field(index) => _ = write!(text, ".f{index}"),
                Link::Swizzle(components) => {
                    text.push('.');
                    text.extend(components.iter().map(|&c| char::from(b"xyzw"[usize::from(c)])));
                }
                Link::Index(index) => {
                    let inner = self.expr(index);
                    let last = ty.extent().saturating_sub(if self.form == Form::Wrong { 2 } else { 1 });
                    let guarded = self.form != Form::Plain && !index.is_constant(&self.program.vars);
                    _ = match (guarded, index.ty().base()) {
                        (false, _) => write!(text, "[{inner}]"),
                        (true, Some(Base::Uint)) => write!(text, "[min({inner}, {last}u)]"),
                        (true, _) => write!(text, "[clamp({inner}, 0, {last})]"),
                    };
                }
            }
            ty = self.program.part(&ty, link);
        }
        text
    }

    fn list(&self, parts: &[Expr]) -> String {
        parts.iter().map(|part| self.expr(part)).collect::<Vec<_>>().join(", ")
    }

    fn expr(&self, expr: &Expr) -> String {
        let explicit = self.form != Form::Plain;
        match expr {
            Expr::Literal(bits, base) => literal(*bits, *base),
            Expr::Read(place, _) => self.place(place),
            Expr::Prefix(op, of, _) => {
                let op = match op {
                    Prefix::Negate => "-",
                    Prefix::BitNot => "~",
                    Prefix::Not => "!",
                };
                format!("({op}{})", self.operand(of))
            }
            Expr::Binary(op, left, right, _) => {
                let (l, r) = (self.expr(left), self.expr(right));
                let constant = left.is_constant(&self.program.vars) && right.is_constant(&self.program.vars);
                match op {
                    Op::Div if explicit && !constant => format!("quotient({l}, {r})"),
                    Op::Rem if explicit && !constant => format!("remainder({l}, {r})"),
                    Op::Shl | Op::Shr if explicit && !right.is_constant(&self.program.vars) => {
                        let mask = if right.ty().base() == Some(Base::Uint) { "31u" } else { "31" };
                        format!("({l} {} ({r} & {mask}))", symbol(*op))
                    }
                    _ => format!("({l} {} {r})", symbol(*op)),
                }
            }
            Expr::Logic(op, left, right) => {
                let op = match op {
                    Logic::And => "&&",
                    Logic::Or => "||",
                    Logic::Xor => "^^",
                };
                format!("({} {op} {})", self.expr(left), self.expr(right))
            }
            Expr::Ternary(cond, then, otherwise, _) => {
                format!("({} ? {} : {})", self.expr(cond), self.expr(then), self.expr(otherwise))
            }
            Expr::Convert(base, of) => format!("{}({})", self.ty(&Ty::Num(*base, 1)), self.expr(of)),
            Expr::Construct(ty, parts) => format!("{}({})", self.ty(ty), self.list(parts)),
            Expr::Call(function, args, _) => {
                let args: Vec<_> = args
                    .iter()
                    .map(|arg| match arg {
                        Arg::In(value) => self.expr(value),
                        Arg::Place(place) => self.place(place),
                    })
                    .collect();
                format!("g{function}({})", args.join(", "))
            }
            Expr::Comma(first, last) => format!("({}, {})", self.expr(first), self.expr(last)),
            Expr::Assign(place, value, _) => format!("({} = {})", self.place(place), self.expr(value)),
            Expr::AssignOp(op, place, value, _) => {
                let (at, right) = (self.place(place), self.expr(value));
                match op {
                    // The divisor has no side effects, so the place may be read before it.
                    Op::Div if explicit => format!("({at} = quotient({at}, {right}))"),
                    Op::Rem if explicit => format!("({at} = remainder({at}, {right}))"),
                    _ => format!("({at} {}= {right})", symbol(*op)),
                }
            }
            Expr::Step { place, down, before, .. } => {
                let (at, op) = (self.place(place), if *down { "--" } else { "++" });
                if *before { format!("({op}{at})") } else { format!("({at}{op})") }
            }
            Expr::Extreme { max, left, right, .. } => {
                format!("{}({}, {})", if *max { "max" } else { "min" }, self.expr(left), self.expr(right))
            }
            Expr::Abs(of) => format!("abs({})", self.expr(of)),
            Expr::Fetch { channel, at, component } => {
                let (x, y) = (self.expr(&at.0), self.expr(&at.1));
                format!("texelFetch(iChannel{channel}, ivec2({x}, {y}), 0)[{component}]")
            }
            Expr::Given(which) => ["px", "py", "iFrame"][*which].into(),
        }
    }

    /// Returns the operand of a prefix operator: `- -1` must not become `--1`.
    fn operand(&self, of: &Expr) -> String {
        let text = self.expr(of);
        if text.starts_with(['-', '+']) { format!("({text})") } else { text }
    }
}

fn literal(bits: u32, base: Base) -> String {
    match base {
        Base::Int if bits as i32 == i32::MIN => "(-2147483647 - 1)".into(),
        Base::Int if (bits as i32) < 0 => format!("({})", bits as i32),
        Base::Int => format!("{bits}"),
        Base::Uint => format!("{bits}u"),
        Base::Bool => (if bits != 0 { "true" } else { "false" }).into(),
        Base::Float => format!("{:?}", f32::from_bits(bits)),
    }
}

fn symbol(op: Op) -> &'static str {
    match op {
        Op::Add => "+",
        Op::Sub => "-",
        Op::Mul => "*",
        Op::Div => "/",
        Op::Rem => "%",
        Op::And => "&",
        Op::Or => "|",
        Op::Xor => "^",
        Op::Shl => "<<",
        Op::Shr => ">>",
        Op::Less => "<",
        Op::LessEqual => "<=",
        Op::Greater => ">",
        Op::GreaterEqual => ">=",
        Op::Equal => "==",
        Op::NotEqual => "!=",
    }
}
