//! Syntax trees, and the messages for invalid texts.
#![cfg(test)]

use super::*;
use crate::{
    PassKind, Text,
    ast::{Condition, DeclId, DeclKind, ExprId, ExprKind, List, Loc, StmtId, StmtKind, TypeSpecId, TypeSpecKind},
};
use eddy_diag::SourceId;

fn parse_text(text: &str) -> Parsed {
    parse(&PassSource::image(text), None)
}

fn messages(text: &str) -> Vec<String> {
    let parsed = parse_text(text);
    check_guarantees(&parsed);
    parsed.report.diagnostics.iter().map(|d| d.message.clone()).collect()
}

/// Returns the tree as nested parentheses; the text must be valid.
#[track_caller]
fn tree(text: &str) -> String {
    let parsed = parse_text(text);
    assert_eq!(parsed.report.diagnostics.iter().map(|d| &d.message).collect::<Vec<_>>(), [""; 0], "{text}");
    check_guarantees(&parsed);
    parsed.ast.items.iter().map(|&d| decl(&parsed, d)).collect::<Vec<_>>().join(" ")
}

/// Returns the tree of one expression.
#[track_caller]
fn expr_tree(text: &str) -> String {
    let whole = tree(&format!("void f() {{ {text}; }}"));
    whole.strip_prefix("(fn void f () {").unwrap().strip_suffix("})").unwrap().to_owned()
}

/// Checks that exactly these messages are reported, each containing the given part.
#[track_caller]
fn assert_errors(text: &str, parts: &[&str]) {
    let found = messages(text);
    assert_eq!(found.len(), parts.len(), "{text}: {found:#?}");
    for (message, part) in found.iter().zip(parts) {
        assert!(message.contains(part), "{text}: `{part}` is not in: {message}");
    }
}

/// The same for a statement in a function that is followed by another.
#[track_caller]
fn assert_stmt_errors(text: &str, parts: &[&str]) {
    assert_errors(&format!("void f() {{\n    {text}\n    int after = 1;\n}}\nvoid g() {{}}"), parts);
}

fn expr(p: &Parsed, id: ExprId) -> String {
    let e = |id| expr(p, id);
    let name = |s| p.names.get(s).to_owned();
    let args = |list: List<ExprId>| p.ast[list].iter().map(|&a| format!(" {}", e(a))).collect::<String>();
    match p.ast[id].kind {
        ExprKind::Error => "<error>".into(),
        ExprKind::Int(v) => v.to_string(),
        ExprKind::Uint(v) => format!("{v}u"),
        ExprKind::Float(v) => format!("{v:?}"),
        ExprKind::Bool(v) => v.to_string(),
        ExprKind::Name(s) => name(s),
        ExprKind::Call { name: s, args: list } => format!("(call {}{})", name(s), args(list)),
        ExprKind::Construct { ty, args: list } => format!("(new {}{})", type_text(p, ty), args(list)),
        ExprKind::Method { base, name: n } => format!("(method {} {})", e(base), name(n.symbol)),
        ExprKind::Member { base, name: n } => format!("(. {} {})", e(base), name(n)),
        ExprKind::Index { base, index } => format!("([] {} {})", e(base), e(index)),
        ExprKind::Unary { op, operand } => format!("({op:?} {})", e(operand)),
        ExprKind::Postfix { op, operand } => format!("(post{op:?} {})", e(operand)),
        ExprKind::Binary { op, lhs, rhs } => format!("({} {} {})", op.text(), e(lhs), e(rhs)),
        ExprKind::Assign { op, place, value } => {
            format!("({}= {} {})", op.map_or("", |o| o.text()), e(place), e(value))
        }
        ExprKind::Ternary { cond, then, otherwise } => format!("(? {} {} {})", e(cond), e(then), e(otherwise)),
        ExprKind::Comma { lhs, rhs } => format!("(, {} {})", e(lhs), e(rhs)),
    }
}

fn dims(p: &Parsed, list: List<crate::ast::Dim>) -> String {
    p.ast[list].iter().map(|d| format!("[{}]", d.size.map_or(String::new(), |s| expr(p, s)))).collect()
}

fn type_text(p: &Parsed, id: TypeSpecId) -> String {
    let spec = p.ast[id];
    let base = match spec.kind {
        TypeSpecKind::Error => "<error>".into(),
        TypeSpecKind::Basic(basic) => basic.name().to_owned(),
        TypeSpecKind::Named(symbol) => p.names.get(symbol).to_owned(),
        TypeSpecKind::Struct(id) => {
            let def = p.ast[id];
            let fields: Vec<String> = p.ast[def.fields]
                .iter()
                .map(|f| {
                    let names: Vec<String> = p.ast[f.declarators]
                        .iter()
                        .map(|d| format!("{}{}", p.names.get(d.name.symbol), dims(p, d.dims)))
                        .collect();
                    format!("{} {}", type_text(p, f.ty), names.join(","))
                })
                .collect();
            format!("(struct {} {{{}}})", def.name.map_or("", |n| p.names.get(n.symbol)), fields.join("; "))
        }
    };
    base + &dims(p, spec.dims)
}

fn qualifiers(p: &Parsed, list: List<crate::ast::Qualifier>) -> String {
    p.ast[list].iter().map(|q| format!("{:?} ", q.kind).to_lowercase()).collect()
}

fn decl(p: &Parsed, id: DeclId) -> String {
    match p.ast[id].kind {
        DeclKind::Error => "<error>".into(),
        DeclKind::Empty => ";".into(),
        DeclKind::Vars { qualifiers: q, ty, declarators } => {
            let list: Vec<String> = p.ast[declarators]
                .iter()
                .map(|d| {
                    let init = d.init.map_or(String::new(), |i| format!("={}", expr(p, i)));
                    format!("{}{}{init}", p.names.get(d.name.symbol), dims(p, d.dims))
                })
                .collect();
            format!("(var {}{} {})", qualifiers(p, q), type_text(p, ty), list.join(","))
        }
        DeclKind::Precision { precision, ty } => format!("(precision {precision:?} {})", type_text(p, ty)),
        DeclKind::Qualify { qualifiers: q, names } => {
            let list: Vec<&str> = p.ast[names].iter().map(|n| p.names.get(n.symbol)).collect();
            format!("(qualify {}{})", qualifiers(p, q), list.join(","))
        }
        DeclKind::Function(id) => {
            let f = p.ast[id];
            let params: Vec<String> = p.ast[f.params]
                .iter()
                .map(|a| {
                    let name = a.name.map_or(String::new(), |n| format!(" {}", p.names.get(n.symbol)));
                    format!("{}{}{name}{}", qualifiers(p, a.qualifiers), type_text(p, a.ty), dims(p, a.dims))
                })
                .collect();
            let body = f.body.map_or(String::new(), |b| format!(" {}", stmt(p, b)));
            let head = format!("{}{}", qualifiers(p, f.qualifiers), type_text(p, f.result));
            format!("(fn {head} {} ({}){body})", p.names.get(f.name.symbol), params.join(", "))
        }
        DeclKind::Block { qualifiers: q, name, fields, instance, .. } => {
            let instance = instance.map_or("", |i| p.names.get(i.symbol));
            format!("(block {}{} {} {instance})", qualifiers(p, q), p.names.get(name.symbol), p.ast[fields].len())
        }
    }
}

fn stmt(p: &Parsed, id: StmtId) -> String {
    let list = |list: List<StmtId>| p.ast[list].iter().map(|&s| stmt(p, s)).collect::<Vec<_>>().join(" ");
    let cond = |c| match c {
        Condition::Expr(e) => expr(p, e),
        Condition::Decl(d) => decl(p, d),
    };
    match p.ast[id].kind {
        StmtKind::Error => "<error>".into(),
        StmtKind::Empty => ";".into(),
        StmtKind::Block(body) => format!("{{{}}}", list(body)),
        StmtKind::Expr(e) => expr(p, e),
        StmtKind::Decl(d) => decl(p, d),
        StmtKind::If { cond, then, otherwise } => {
            let otherwise = otherwise.map_or(String::new(), |o| format!(" else {}", stmt(p, o)));
            format!("(if {} {}{otherwise})", expr(p, cond), stmt(p, then))
        }
        StmtKind::For { init, cond: c, step, body } => format!(
            "(for {} {} {} {})",
            stmt(p, init),
            c.map_or("_".into(), cond),
            step.map_or("_".into(), |e| expr(p, e)),
            stmt(p, body)
        ),
        StmtKind::While { cond: c, body } => format!("(while {} {})", cond(c), stmt(p, body)),
        StmtKind::DoWhile { body, cond } => format!("(do {} {})", stmt(p, body), expr(p, cond)),
        StmtKind::Switch { value, body } => format!("(switch {} {{{}}})", expr(p, value), list(body)),
        StmtKind::Case(e) => format!("(case {})", expr(p, e)),
        StmtKind::Default => "(default)".into(),
        StmtKind::Return(e) => format!("(return{})", e.map_or(String::new(), |e| format!(" {}", expr(p, e)))),
        StmtKind::Break => "break".into(),
        StmtKind::Continue => "continue".into(),
        StmtKind::Discard => "discard".into(),
    }
}

/// Checks the invariants that the documentation of the tree promises.
pub(super) fn check_guarantees(p: &Parsed) {
    let tokens = p.origins.tokens.len();
    let loc = |l: Loc| assert!(l.first <= l.last && (l.last.0 as usize) < tokens);
    let mut parents = vec![0; p.ast.exprs.len()];
    for (i, e) in p.ast.exprs.iter().enumerate() {
        loc(e.loc);
        let mut child = |id: ExprId| {
            assert!(id.index() < i, "children come first");
            parents[id.index()] += 1;
            let inner = p.ast[id].loc;
            assert!(e.loc.first <= inner.first && inner.last <= e.loc.last, "a node covers its children");
        };
        match e.kind {
            ExprKind::Call { args, .. } | ExprKind::Construct { args, .. } => {
                p.ast[args].iter().for_each(|&a| child(a));
            }
            ExprKind::Method { base, .. } | ExprKind::Member { base, .. } => child(base),
            ExprKind::Index { base: a, index: b }
            | ExprKind::Binary { lhs: a, rhs: b, .. }
            | ExprKind::Comma { lhs: a, rhs: b }
            | ExprKind::Assign { place: a, value: b, .. } => {
                child(a);
                child(b);
            }
            ExprKind::Unary { operand, .. } | ExprKind::Postfix { operand, .. } => child(operand),
            ExprKind::Ternary { cond, then, otherwise } => [cond, then, otherwise].into_iter().for_each(child),
            _ => {}
        }
    }
    assert!(parents.iter().all(|&n| n <= 1), "one parent at most");
    for (i, s) in p.ast.stmts.iter().enumerate() {
        loc(s.loc);
        let child = |id: StmtId| assert!(id.index() < i);
        match s.kind {
            StmtKind::Block(list) | StmtKind::Switch { body: list, .. } => p.ast[list].iter().for_each(|&s| child(s)),
            StmtKind::If { then, otherwise, .. } => {
                child(then);
                otherwise.into_iter().for_each(child);
            }
            StmtKind::For { init, body, .. } => {
                child(init);
                child(body);
            }
            StmtKind::While { body, .. } | StmtKind::DoWhile { body, .. } => child(body),
            _ => {}
        }
    }
    p.ast.decls.iter().for_each(|d| loc(d.loc));
    p.ast.types.iter().for_each(|t| loc(t.loc));
}

#[test]
fn precedence() {
    assert_eq!(expr_tree("a + b * c - d / e"), "(- (+ a (* b c)) (/ d e))");
    assert_eq!(expr_tree("a - b - c"), "(- (- a b) c)");
    assert_eq!(
        expr_tree("a << b + c > d == e & f ^ g | h && i ^^ j || k"),
        "(|| (^^ (&& (| (^ (& (== (> (<< a (+ b c)) d) e) f) g) h) i) j) k)"
    );
    assert_eq!(expr_tree("a || b ^^ c && d"), "(|| a (^^ b (&& c d)))");
    assert_eq!(expr_tree("-a * !b + ~c"), "(+ (* (Minus a) (Not b)) (BitNot c))");
    assert_eq!(expr_tree("- -a"), "(Minus (Minus a))");
    assert_eq!(expr_tree("++a - --b"), "(- (Increment a) (Decrement b))");
    assert_eq!(expr_tree("-a++"), "(Minus (postIncrement a))");
    assert_eq!(expr_tree("a = b = c"), "(= a (= b c))");
    assert_eq!(expr_tree("a += b, c *= d"), "(, (+= a b) (*= c d))");
    assert_eq!(expr_tree("a ? b : c ? d : e"), "(? a b (? c d e))");
    assert_eq!(expr_tree("a ? b, c : d = e"), "(? a (, b c) (= d e))");
    assert_eq!(expr_tree("x = a ? b : c"), "(= x (? a b c))");
    assert_eq!(expr_tree("(a + b) * c"), "(* (+ a b) c)");
    assert_eq!(
        expr_tree("a <<= 1, b >>= 2, c &= 3, d |= 4, e ^= 5, f %= 6"),
        "(, (, (, (, (, (<<= a 1) (>>= b 2)) (&= c 3)) (|= d 4)) (^= e 5)) (%= f 6))"
    );
}

#[test]
fn operands() {
    assert_eq!(expr_tree("a.xyz.x"), "(. (. a xyz) x)");
    assert_eq!(expr_tree("a[i][1].b[2]++"), "(postIncrement ([] (. ([] ([] a i) 1) b) 2))");
    assert_eq!(expr_tree("f() + g(1, 2.5, true, 3u)"), "(+ (call f) (call g 1 2.5 true 3u))");
    assert_eq!(expr_tree("f(void)"), "(call f)");
    assert_eq!(expr_tree("f((a, b), c)"), "(call f (, a b) c)");
    assert_eq!(expr_tree("f(a = 1)"), "(call f (= a 1))");
    assert_eq!(expr_tree("vec3(1).xy"), "(. (new vec3 1) xy)");
    assert_eq!(expr_tree("float[2](1., 2.)[0]"), "([] (new float[2] 1.0 2.0) 0)");
    assert_eq!(expr_tree("float[](1., 2.).length()"), "(method (new float[] 1.0 2.0) length)");
    assert_eq!(expr_tree("S[2](a, b)"), "(new S[2] a b)");
    assert_eq!(expr_tree("a[2]"), "([] a 2)");
    assert_eq!(expr_tree("f(a)[0].x"), "(. ([] (call f a) 0) x)");
    assert_eq!(expr_tree("mat2x2(1) * mat3x3(2)"), "(* (new mat2 1) (new mat3 2))");
    assert_eq!(expr_tree("(a).x"), "(. a x)");
    assert_eq!(expr_tree("a[i, j]"), "([] a (, i j))");
}

#[test]
fn statements() {
    assert_eq!(
        tree("void f() { if (a) b; else if (c) {} else d; }"),
        "(fn void f () {(if a b else (if c {} else d))})"
    );
    assert_eq!(tree("void f() { if (a) if (b) c; else d; }"), "(fn void f () {(if a (if b c else d))})");
    assert_eq!(
        tree("void f() { for (int i = 0, j = 1; i < 3; i++, j--) ; }"),
        "(fn void f () {(for (var int i=0,j=1) (< i 3) (, (postIncrement i) (postDecrement j)) ;)})"
    );
    assert_eq!(tree("void f() { for (;;) { break; } }"), "(fn void f () {(for ; _ _ {break})})");
    assert_eq!(
        tree("void f() { for (i = 0; bool b = g(); ) continue; }"),
        "(fn void f () {(for (= i 0) (var bool b=(call g)) _ continue)})"
    );
    assert_eq!(
        tree("void f() { while (bool b = g()) discard; do { } while (a); }"),
        "(fn void f () {(while (var bool b=(call g)) discard) (do {} a)})"
    );
    assert_eq!(
        tree("int f() { switch (a) { case 1: case 2 + 3: b; break; default: return 4; } return; }"),
        "(fn int f () {(switch a {(case 1) (case (+ 2 3)) b break (default) (return 4)}) (return)})"
    );
    assert_eq!(tree("void f() { ; {} { a; } }"), "(fn void f () {; {} {a}})");
}

#[test]
fn declarations() {
    assert_eq!(
        tree("const float a = 1., b[2] = float[2](1., 2.), c;"),
        "(var const float a=1.0,b[2]=(new float[2] 1.0 2.0),c)"
    );
    assert_eq!(tree("float[3] a; vec2 b[];"), "(var float[3] a) (var vec2 b[])");
    assert_eq!(tree("struct S { float a, b[2]; vec3 c; } s, t[2];"), "(var (struct S {float a,b[2]; vec3 c}) s,t[2])");
    assert_eq!(tree("struct { int a; } s;"), "(var (struct  {int a}) s)");
    assert_eq!(
        tree("struct S { int a; }; S s = S(1); S[2] t;"),
        "(var (struct S {int a}) ) (var S s=(call S 1)) (var S[2] t)"
    );
    assert_eq!(tree("struct S { int a; }, s;"), "(var (struct S {int a}) s)");
    assert_eq!(
        tree("void f(void); float g(const in vec2, out float a, inout int b[2], highp S);"),
        "(fn void f ()) (fn float g (const in vec2, out float a, inout int b[2], precision(high) S))"
    );
    assert_eq!(tree("precision highp float; invariant a, b; ;"), "(precision High float) (qualify invariant a,b) ;");
    assert_eq!(
        tree("uniform sampler2D t; flat in int i; layout(location = 1) out vec4 o;"),
        "(var uniform sampler2D t) (var flat in int i) (var layout(0..1) out vec4 o)"
    );
    assert_eq!(tree("uniform Block { float a; vec2 b; } c;"), "(block uniform Block 2 c)");
    assert_eq!(tree("highp float f() { return 1.; }"), "(fn precision(high) float f () {(return 1.0)})");
    assert_eq!(
        tree("float[2] f() { S s; S(1); s[0] = 1; S[1](a); S[1] t; }"),
        "(fn float[2] f () {(var S s) (call S 1) (= ([] s 0) 1) (new S[1] a) (var S[1] t)})"
    );
    assert_eq!(tree("float buffer, sampler, texture2D, sampleX;"), "(var float buffer,sampler,texture2D,sampleX)");
    assert_eq!(tree(""), "");
}

#[test]
fn long_chains_are_legal_and_deep_ones_are_not() {
    let chain = |n: usize, op: &str| format!("void f() {{ x = a{}; }}", format!("{op}a").repeat(n));
    assert_eq!(messages(&chain(100_000, "+")), [""; 0]);
    assert_eq!(messages(&chain(100_000, ",")), [""; 0]);
    assert_eq!(messages(&chain(100_000, ".x")).len(), 0);
    assert_eq!(messages(&format!("void f() {{ a{}; }}", "[0]".repeat(100_000))), [""; 0]);
    for deep in [
        format!("void f() {{ x = {}a{}; }}", "(".repeat(100_000), ")".repeat(100_000)),
        format!("void f() {{ x = {}a{}; }}", "f(".repeat(100_000), ")".repeat(100_000)),
        format!("void f() {{ x = {}a{}; }}", "a[".repeat(100_000), "]".repeat(100_000)),
        format!("void f() {{ x = {}a; }}", "-".repeat(100_001).replace("--", "- -")),
        format!("void f() {{ {}a; }}", "x = ".repeat(100_000)),
        format!("void f() {{ {}a; }}", "x ? y : ".repeat(100_000)),
        format!("void f() {{ {}{} }}", "{".repeat(100_000), "}".repeat(100_000)),
        format!("void f() {{ {}; }}", "if (a) ".repeat(100_000)),
        format!("void f() {{ {}; }}", "if (a) b; else ".repeat(100_000)),
        format!("void f() {{ x = {}a; }}", "a + (".repeat(100_000)),
    ] {
        let found = messages(&deep);
        let is_reported = |m: &String| m.contains("300 levels deep") || m.contains("10000 levels deep");
        assert!(found.first().is_some_and(is_reported), "{}: {found:?}", &deep[..40]);
        assert!(found.len() <= 2, "{}: {found:?}", &deep[..40]);
    }
    // As deep as ANGLE's parser, which keeps 10,000 symbols.
    for (open, close) in [("(", ")"), ("- ", ""), ("abs(", ")"), ("float(", ")"), ("(1.0 + ", ")"), ("a[", "]")] {
        let text = format!("void f() {{ x = {}a{}; }}", open.repeat(9_990), close.repeat(9_990));
        assert_eq!(messages(&text), [""; 0], "{open}");
    }
}

#[test]
fn one_error_has_one_message() {
    assert_stmt_errors("float a = 1.0", &["missing `;` after `1.0`"]);
    assert_stmt_errors("a = b", &["missing `;` after `b`"]);
    assert_stmt_errors("f(a)", &["missing `;` after `)`"]);
    assert_stmt_errors("return", &["missing `;` after `return`"]);
    assert_stmt_errors("a = b c;", &["missing an operator or `;` between `b` and `c`"]);
    assert_stmt_errors("float a = 2.0 b;", &["missing an operator or `;` between `2.0` and `b`"]);
    assert_stmt_errors("a = ;", &["`=` needs a value on its right, found `;`"]);
    assert_stmt_errors("a = b +;", &["`+` needs a value on its right"]);
    assert_stmt_errors("float a =\n    float b = 1.0;", &["`=` needs a value on its right"]);
    assert_stmt_errors("a = (b + c;", &["missing `)` after `c`"]);
    assert_stmt_errors("a = f(b, c;", &["missing `)` after `c`"]);
    assert_stmt_errors("a = b + c);", &["`)` closes nothing"]);
    assert_stmt_errors("a = b[1;", &["missing `]` after `1`"]);
    assert_stmt_errors("a = b[];", &["need an index"]);
    assert_stmt_errors("a = f(b, );", &["a value is missing between `,` and `)`"]);
    assert_stmt_errors("a = f(, b);", &["a value is missing between `(` and `,`"]);
    assert_stmt_errors("a = ();", &["empty"]);
    assert_stmt_errors("a = b ? c;", &["`:` and the other value"]);
    assert_stmt_errors("a ** b;", &["`**`"]);
    assert_stmt_errors("a->b;", &["`->`"]);
    assert_stmt_errors("if (a === b) {}", &["`===`"]);
    assert_stmt_errors("if (a <> b) {}", &["`<>`"]);
    assert_stmt_errors("if (a and b) {}", &["expected an operator or `)`, found `and`"]);
    assert_stmt_errors("if a > b { c; }", &["must be in parentheses"]);
    assert_stmt_errors("if (a > b { c; }", &["missing `)` after `b`"]);
    assert_stmt_errors("if () { c; }", &["a condition is missing"]);
    assert_stmt_errors("if (a) then { c; }", &["`then`"]);
    assert_stmt_errors("if (a) { } elseif (b) { } else { }", &["`elseif`"]);
    assert_stmt_errors("if (a); b; else c;", &["`else` without an `if`"]);
    assert_stmt_errors("for (int i = 0, i < 3, i++) { }", &["expected `;`, found `<`"]);
    assert_stmt_errors("for (int i = 0; i < 3) { }", &["expected `;`, found `)`"]);
    assert_stmt_errors("for (int i = 0; i <; i++) { j; }", &["`<` needs a value"]);
    assert_stmt_errors("for (int i = 0; i < 3; i++ { j; }", &["missing `)` after `++`"]);
    assert_stmt_errors("while (int i) { }", &["a condition that declares"]);
    assert_stmt_errors("do { } while a;", &["must be in parentheses"]);
    assert_stmt_errors("do { } until (a);", &["`while` and the condition"]);
    assert_stmt_errors("switch (a) case 1: b;", &["expected `{`"]);
    assert_stmt_errors("switch (a) { case 1; b; }", &["ends with `:`"]);
    assert_stmt_errors("float a[2] = {1.0, 2.0};", &["lists in braces"]);
    assert_stmt_errors("a = {1.0, 2.0};", &["lists in braces"]);
    assert_stmt_errors("vec3 a(1.0, 2.0);", &["with `=`"]);
    assert_stmt_errors("f(float a);", &["`float` is a type"]);
    assert_stmt_errors("a = vec3;", &["`vec3` is a type"]);
    assert_stmt_errors("retrun a;", &["`retrun` is not a keyword"]);
    assert_stmt_errors("float2 a = b; a.x;", &["no type `float2`"]);
    assert_stmt_errors("let a = 1.0;", &["`let` cannot declare"]);
    assert_stmt_errors("var a = 1.0;", &["`var` cannot declare"]);
    assert_stmt_errors("const a = 1.0;", &["without a type"]);
    assert_stmt_errors("float input = 1.0; input += input;", &["`input` is a reserved word"]);
    assert_stmt_errors("double a = 1.0;", &["`double` is a reserved word"]);
    assert_stmt_errors("static const float a = 1.0;", &["`static` is a reserved word"]);
    assert_stmt_errors("goto a;", &["`goto` is a reserved word"]);
    assert_stmt_errors("float image2DArrayShadow = 1.0;", &["`image2DArrayShadow` is a reserved word"]);
    assert_stmt_errors("float if = 1.0;", &["which is a keyword"]);
    assert_stmt_errors("float 2a = 1.0;", &["`2a` is not a number"]);
    assert_stmt_errors("a.length(1);", &["takes no arguments"]);
    assert_stmt_errors("a.push(1);", &["methods"]);
    assert_stmt_errors("a.;", &["after `.`"]);
    assert_stmt_errors("float gl_a, b__c, webgl_d;", &["`gl_`", "two underscores", "webgl_"]);
    assert_stmt_errors("a = 1.0 / 08;", &["octal"]);
    assert_stmt_errors("a = \u{201c}b\u{201d};", &["no meaning", "no meaning"]);
    assert_stmt_errors("a = b \u{2212} c;", &["only looks like `-`"]);
    assert_stmt_errors("float x; float g(float a) { return a; }", &["cannot be defined inside"]);
}

#[test]
fn mistakes_at_file_scope() {
    assert_errors("float a = 1.0\nfloat b;", &["missing `;` after `1.0`"]);
    assert_errors("a = 1.0;\nfloat b;", &["statements belong inside functions"]);
    assert_errors("float f(float a { return a; }\nfloat b;", &["missing `)` after `a`"]);
    // `a` may be a type: the checker decides.
    assert_errors("float f(a) { return b; }\nfloat b;", &[]);
    assert_errors("float f(float a = 1.0) { return a; }\nfloat b;", &["no default parameter values"]);
    assert_errors("float f(float& a) { return a; }\nfloat b;", &["no pointers"]);
    assert_errors("float f(float a) return a;\nfloat b;", &["expected `{` or `;`"]);
    assert_errors("struct S { float a = 1.0; vec2 b; };\nS s;", &["cannot have an initial value"]);
    assert_errors("struct S { float f() { return 1.0; } vec2 b; };\nS s;", &["have no functions"]);
    assert_errors("struct S { float a; }\nfloat b;", &["missing `;` after `}`"]);
    assert_errors("struct S : T { float a; };", &["cannot extend"]);
    assert_errors("function f() { }\nfloat b;", &["`function` cannot declare"]);
    assert_errors("enum A { B };\nfloat b;", &["`enum` is a reserved word"]);
    assert_errors("void f() { a; } }\nvoid g() { }", &["`}` closes nothing"]);
    assert_errors("void f() { a; }\n  b; }\n}\nvoid g() { c; }", &["statements belong inside functions"]);
    assert_errors("void f() {\n if (a) {\n b;\n}\nvoid g() { }\nvoid h() { }", &["missing `}`: `g` starts inside `f`"]);
    assert_errors("void g() { }\nvoid f() {\n if (a) {\n b;\n}\n", &["missing `}` at the end"]);
    assert_errors("void f() { if (a) b; }\nreturn 1;\nfor (;;) { }\nvoid g() { }", &["`return` is outside"]);
    assert_errors("%", &["expected a declaration"]);
    assert_errors("float a; b", &["statements belong inside functions"]);
    assert_errors(
        "#define F(x) x\nvoid f() { F(1, 2); float a = F(1, 2) + 1.0; }",
        &["takes 1 argument", "takes 1 argument"],
    );
    assert_errors("#define BAD float a = ;\nvoid f() { BAD }\nvoid g() { BAD }", &["`=` needs a value"]);
}

#[test]
fn several_errors_have_several_messages() {
    assert_errors(
        "void f() {\n float a = ;\n b = c d;\n if (e f) { g; }\n for (int i = 0; i < 3; i++ { j }\n}\nfloat k = (1.0;\nvoid l() { m( ; }",
        &[
            "`=` needs a value",
            "between `c` and `d`",
            "found `f`",
            "missing `)` after `++`",
            "missing `;` after `j`",
            "missing `)` after `1.0`",
            "expected an expression, found `;`",
        ],
    );
    let many = format!("void f() {{ {} }}", "a b c;\n".repeat(1000));
    assert_eq!(messages(&many).len(), crate::report::MAX_ERRORS);
}

#[test]
fn declarators_before_an_error_stay_declared() {
    let parsed = parse_text("void f() { float a = 1.0 +, b = 2.0; }");
    let shown: Vec<String> = parsed.ast.items.iter().map(|&d| decl(&parsed, d)).collect();
    assert_eq!(shown, ["(fn void f () {(var float a=<error>,b=2.0)})"]);
}

#[test]
fn qualifiers_after_a_type_are_reported_once_and_accepted() {
    for (text, hint) in [
        ("vec3 const k = vec3(1.0);", "write `const vec3 k`"),
        ("float highp x;", "write `highp float x`"),
        ("vec3 uniform u;", "write `uniform vec3 u`"),
        ("highp vec3 const k = vec3(1.0);", "write `const vec3 k`"),
        ("float[2] const k = float[2](1.0, 2.0);", "write `const float[2] k`"),
        ("float const k = 1.0, l = 2.0;", "write `const float k`"),
        ("float highp f() { return 1.0; }", "write `highp float f`"),
        ("void f(int in x, vec2 inout y) {}", "write `in int x`"),
        ("void f() { for (int const i = 0; i < 1;) {} }", "write `const int i`"),
        ("void f() { while (bool const b = true) {} }", "write `const bool b`"),
        ("struct S { float mediump a; };", "write `mediump float a`"),
        ("struct S { int a; }; S const s = S(1);", "write `const S s`"),
        ("struct S { int a; } const s = S(1);", "write `const` before the type"),
        ("vec4 layout(location = 0) out c;", "write `layout(location = 0) out vec4 c`"),
    ] {
        let parsed = parse_text(text);
        let found: Vec<_> =
            parsed.report.diagnostics.iter().filter(|d| d.message.contains("before the type")).collect();
        assert_eq!(found.len(), parsed.report.diagnostics.len(), "{text}: {:?}", parsed.report.diagnostics);
        assert!(!found.is_empty() && found[0].hints == [hint], "{text}: {found:?}");
    }
    // The declaration is valid: a size that is `const` is accepted.
    assert_eq!(messages("int const n = 2;\nfloat a[n];\nS\nconst int m = 1;").len(), 2);
}

#[test]
fn old_keywords_have_fixes_for_the_stage() {
    for (kind, text, hint) in [
        (PassKind::PlainVertex, "attribute vec3 p;", "GLSL ES 3.00 uses `in` instead"),
        (PassKind::PlainVertex, "varying vec2 uv;", "GLSL ES 3.00 uses `out` instead"),
        (PassKind::PlainFragment, "varying vec2 uv;", "GLSL ES 3.00 uses `in` instead"),
        (PassKind::Image, "varying vec2 uv;", "GLSL ES 3.00 uses `in` and `out` instead; a pass needs neither"),
    ] {
        let parsed = parse(&PassSource::new(kind, Text { id: SourceId(0), text }), None);
        assert_eq!(parsed.report.diagnostics[0].hints, [hint], "{text}");
    }
}
