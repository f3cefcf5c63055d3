//! Ends loops that may be endless: a GPU driver cannot always stop a shader, and an endless one then blocks the device
//! for every program. An H100 and an H200 (driver 580.159) hung for minutes, each after some 1,300 public shaders; an
//! endless loop is the likely cause.
//!
//! The specification leaves the behaviour of such a loop to the platform (GLSL ES 3.00, section 6.3). Iterations of all
//! loops of an invocation that no counter ends are counted together. (Mesa's llvmpipe itself leaves each loop after
//! 65,535 iterations: `LP_MAX_TGSI_LOOP_ITERATIONS`.)

use crate::{
    ast::Loc,
    ir::{Binary, Block, Function, GlobalId, GlobalKind, Module, Op, Stmt, analysis},
    types::{Scalar, TypeId},
};

pub(super) fn run(program: &mut Module, limit: u32) {
    let mut iterations = None;
    for index in 0..program.functions.len() {
        let mut f = std::mem::take(&mut program.functions[index]);
        let mut body = std::mem::take(&mut f.body);
        block(program, &mut f, &mut body, (&mut iterations, limit));
        f.body = body;
        program.functions[index] = f;
    }
}

fn block(program: &mut Module, f: &mut Function, stmts: &mut Block, (iterations, limit): (&mut Option<GlobalId>, u32)) {
    for stmt in stmts {
        stmt.blocks_mut(|inner| block(program, f, inner, (&mut *iterations, limit)));
        if let Stmt::Loop { body, continuing, break_if } = stmt
            && !analysis::ends(&program.globals, f, body, continuing, *break_if)
        {
            let new = || program.add_global(TypeId::UINT, GlobalKind::Private(None));
            let counted = counted(f, *iterations.get_or_insert_with(new), limit);
            body.splice(0..0, counted);
        }
    }
}

/// Returns statements that count an iteration, and leave the loop when the limit is reached.
fn counted(f: &mut Function, iterations: GlobalId, limit: u32) -> [Stmt; 5] {
    let mut add = |op, ty| f.append(op, ty, Loc::default());
    let place = add(Op::Global(iterations), TypeId::UINT);
    let before = add(Op::Load { place }, TypeId::UINT);
    let one = add(Op::Literal(Scalar::Uint, 1), TypeId::UINT);
    let after = add(Op::Binary { op: Binary::Add, left: before, right: one }, TypeId::UINT);
    let limit = add(Op::Literal(Scalar::Uint, limit), TypeId::UINT);
    let condition = add(Op::Binary { op: Binary::GreaterEqual, left: before, right: limit }, TypeId::BOOL);
    [
        Stmt::Let(before),
        Stmt::Let(after),
        Stmt::Store { place, value: after },
        Stmt::Let(condition),
        Stmt::If { condition, accept: vec![Stmt::Break], reject: Block::new() },
    ]
}

#[cfg(test)]
mod tests {
    use crate::{Driver, PassSource};

    #[test]
    fn loops_without_a_counter_are_bounded() {
        let module = |body: &str, bounded: bool| {
            let code = format!(
                "int g; void f() {{ g--; }} void mainImage(out vec4 o, in vec2 p) {{ o = vec4(0); int m = int(p.x), n = 4; \
                 float t = 0.0; if (p.y > 9.0) n = 5; g = m; {body} }}"
            );
            let driver = Driver { max_loop_iterations: bounded.then_some(1 << 22), ..Driver::default() };
            let compiled = crate::compile(&PassSource { driver, ..PassSource::image(&code) });
            format!("{:?}", compiled.unwrap_or_else(|errors| panic!("{code}: {errors:?}")).module)
        };
        let is_bounded = |body: &str| module(body, true) != module(body, false);
        for body in [
            "for (int i = 0; i < 9; i++) o += sin(p.x + float(i));",
            "for (int i = min(iFrame, 0); i < n; i++) o += sin(p.x + float(i));",
            "for (int i = n; i > 2; i -= 2) { if (p.x > 3.0) continue; o += sin(p.x + float(i)); }",
            "for (uint i = 0u; i != 7u; ++i) { for (int j = 3; j >= 0; j--) o += sin(p.x + float(j)); }",
            "for (int i = 0;; i++) { if (i >= n) break; o += sin(p.x + float(i)); }",
            "for (int i = 0; i < g * 2 + n; i++) o += sin(p.x + float(i));",
            "while (m < 100) { o += sin(p.x + float(m)); m++; }",
            "do { o += sin(p.x + float(m)); m++; } while (m < 100);",
            "for (int i = 0; i <= 99; i += 3) o += sin(p.x + float(i));",
            "while (true) { o += sin(o + p.x); if (++m >= n) break; }",
            "while (true) { o += sin(o + p.x); if (--m <= n) return; }",
        ] {
            assert!(!is_bounded(body), "{body}");
        }
        for body in [
            "while (o.x < 3.0) o += sin(p.x + o);",
            "for (;;) { o += sin(p.x + o); if (o.x > 4.0) break; }",
            "for (float t = 0.0; t < 9.0; t += 0.1) o += sin(p.x + t);",
            "for (int i = 0; i < 9; i++) { if (o.x < 2.0) i = 0; o += sin(p.x + float(i)); }",
            "for (int i = 0; i < 9; i--) o += sin(p.x + float(i));",
            "for (int i = 0; i != 9; i += 2) o += sin(p.x + float(i));",
            "for (int i = 0; i < n; i++) { n++; o += sin(p.x + float(i)); }",
            "for (int i = 0; i > g; i--) { f(); o += sin(p.x + float(i)); }",
            "while (m < 100) { o += sin(p.x + float(m)); if (o.x > 2.0) continue; m++; }",
            "while (m < 100) { o += sin(p.x + float(m)); if (o.x > 2.0) m++; }",
            "do { o += sin(p.x + o); } while (o.x < 3.0);",
            // There may be no number beyond the limit.
            "for (int i = 0; i <= n; i++) o += sin(p.x + float(i));",
            "for (uint i = 9u; i >= 0u; i--) o += sin(p.x + float(i));",
            "for (int i = 0; i < m; i += 2) o += sin(p.x + float(i));",
        ] {
            assert!(is_bounded(body), "{body}");
        }
    }
}
