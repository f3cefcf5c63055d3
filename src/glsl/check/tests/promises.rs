//! Tests the guarantees of `hir` to lowering, for every error-free program: post-order, at most one parent per node, no
//! error types and nodes, types that match, valid places, folded constants.

use crate::{
    ast::List,
    hir::{
        BinaryOp, ExprFlags, ExprId, ExprKind, GlobalStorage, LocalKind, Module, Shape, StmtId, StmtKind, Type, TypeId,
    },
};

/// Panics if a guarantee is violated.
pub(super) fn assert_kept(module: &Module) {
    let mut walk = Walk { module, parents: vec![false; module.exprs.len()] };
    assert!(module.entry.is_some(), "no entry");
    let mut done = vec![false; module.functions.len()];
    for &id in &module.call_order {
        let func = &module[id];
        assert!(func.used);
        assert!(func.calls.iter().all(|callee| done[callee.index()]), "a callee comes after its caller");
        done[id.index()] = true;
        let (start, end) = (func.locals.start, func.locals.end);
        assert!(func.param_count <= end - start);
        for (i, local) in module.locals[start as usize..end as usize].iter().enumerate() {
            assert_eq!(local.kind.is_param(), i < func.param_count as usize);
            assert_eq!(local.value.is_some(), local.kind == LocalKind::Const);
            assert!(local.ty != TypeId::ERROR && local.ty != TypeId::VOID);
        }
        walk.statements(func.body.expect("a body"), func.locals.clone(), func.result);
    }
    for global in &module.globals {
        assert_eq!(global.init.is_some(), global.storage == GlobalStorage::Private && global.init.is_some());
        if let Some(init) = global.init {
            assert_eq!(walk.expr(init, 0..0), global.ty);
        }
        if let Some(value) = global.value {
            assert_eq!(module[value].ty, global.ty);
        }
    }
    for constant in &module.consts {
        assert_eq!(constant.words.len() as u32, words(module, constant.ty), "{:?}", module.types.get(constant.ty));
    }
}

fn words(module: &Module, ty: TypeId) -> u32 {
    match module.types.get(ty) {
        Type::Array { element, len } => len * words(module, element),
        Type::Struct(id) => module[module[id].members].iter().map(|m| words(module, m.ty)).sum(),
        _ => module.types.components(ty).unwrap_or(0),
    }
}

struct Walk<'m> {
    module: &'m Module,
    /// Expressions that have been visited.
    parents: Vec<bool>,
}

impl Walk<'_> {
    fn statements(&mut self, list: List<StmtId>, locals: std::ops::Range<u32>, result: TypeId) {
        for &id in &self.module[list] {
            let expr = |walk: &mut Self, id| walk.expr(id, locals.clone());
            let mut nested: Vec<List<StmtId>> = Vec::new();
            match self.module[id].kind {
                StmtKind::Block(list) => nested.push(list),
                StmtKind::Expr(value) => {
                    expr(self, value);
                }
                StmtKind::Declare { local, init } => {
                    assert!(locals.contains(&(local.index() as u32)));
                    assert_eq!(self.module[local].kind, LocalKind::Var);
                    if let Some(init) = init {
                        assert_eq!(expr(self, init), self.module[local].ty);
                    }
                }
                StmtKind::If { cond, then, otherwise } => {
                    assert_eq!(expr(self, cond), TypeId::BOOL);
                    nested.extend([then, otherwise]);
                }
                StmtKind::For { init, test, step, body } => {
                    if let Some(test) = test {
                        assert_eq!(expr(self, test), TypeId::BOOL);
                    }
                    if let Some(step) = step {
                        expr(self, step);
                    }
                    nested.extend([init, body]);
                }
                StmtKind::DoWhile { body, test } => {
                    assert_eq!(expr(self, test), TypeId::BOOL);
                    nested.push(body);
                }
                StmtKind::Switch { value, cases } => {
                    let ty = expr(self, value);
                    assert!(ty == TypeId::INT || ty == TypeId::UINT);
                    let mut seen = Vec::new();
                    for case in &self.module[cases] {
                        assert!(case.is_default || !case.values.is_empty());
                        seen.extend_from_slice(&self.module[case.values]);
                        nested.push(case.body);
                    }
                    let count = seen.len();
                    seen.sort_unstable();
                    seen.dedup();
                    assert_eq!(seen.len(), count, "labels are distinct");
                }
                StmtKind::Return(value) => {
                    assert_eq!(value.map_or(TypeId::VOID, |value| expr(self, value)), result);
                }
                StmtKind::Break | StmtKind::Continue | StmtKind::Discard => {}
            }
            for list in nested {
                self.statements(list, locals.clone(), result);
            }
        }
    }

    /// Checks an expression and its operands, and returns its type.
    fn expr(&mut self, root: ExprId, locals: std::ops::Range<u32>) -> TypeId {
        let mut stack = vec![root];
        while let Some(id) = stack.pop() {
            assert!(!std::mem::replace(&mut self.parents[id.index()], true), "{id:?} has two parents");
            let children = self.node(id, &locals);
            assert!(children.iter().all(|child| child.index() < id.index()), "{id:?} comes before a child");
            stack.extend(children);
        }
        self.module[root].ty
    }

    /// Checks one node, and returns its children.
    fn node(&self, id: ExprId, locals: &std::ops::Range<u32>) -> Vec<ExprId> {
        let module = self.module;
        let expr = module[id];
        let types = &module.types;
        let ty = |id: ExprId| module[id].ty;
        let place = |id: ExprId| assert!(module[id].flags.contains(ExprFlags::PLACE), "{:?} is no place", module[id]);
        assert!(expr.ty != TypeId::ERROR, "{expr:?}");
        let folded = matches!(expr.kind, ExprKind::Literal(_) | ExprKind::Const(_));
        assert_eq!(folded, expr.flags.contains(ExprFlags::CONSTANT), "{expr:?}");
        match expr.kind {
            ExprKind::Error => panic!("an error is reachable"),
            ExprKind::Literal(_) => {
                assert!(matches!(types.get(expr.ty), Type::Scalar(_)));
                vec![]
            }
            ExprKind::Const(value) => {
                assert_eq!(module[value].ty, expr.ty);
                vec![]
            }
            ExprKind::Local(local) => {
                assert!(locals.contains(&(local.index() as u32)));
                assert!(module[local].kind != LocalKind::Const);
                assert_eq!(module[local].ty, expr.ty);
                vec![]
            }
            ExprKind::Global(global) => {
                assert!(module[global].storage != GlobalStorage::Const);
                assert_eq!(module[global].ty, expr.ty);
                vec![]
            }
            ExprKind::Uniform(_) | ExprKind::CustomUniform(_) | ExprKind::Channel(_) | ExprKind::BuiltinVar(_) => {
                vec![]
            }
            ExprKind::Member { base, index } => {
                let Type::Struct(of) = types.get(ty(base)) else { panic!("a member of no struct") };
                assert_eq!(module[module[of].members][index as usize].ty, expr.ty);
                vec![base]
            }
            ExprKind::Swizzle { base, swizzle } => {
                let size = types.components(ty(base)).unwrap();
                assert!(swizzle.iter().all(|i| (i as u32) < size));
                vec![base]
            }
            ExprKind::Index { base, index } => {
                assert_eq!(types.element(ty(base)), Some(expr.ty));
                assert!(ty(index) == TypeId::INT || ty(index) == TypeId::UINT);
                vec![base, index]
            }
            ExprKind::Unary { operand, .. } => {
                assert_eq!(ty(operand), expr.ty);
                vec![operand]
            }
            ExprKind::Binary { op, shape, lhs, rhs } => {
                self.shape(op, shape, ty(lhs), ty(rhs));
                vec![lhs, rhs]
            }
            ExprKind::Logical { lhs, rhs, .. } => {
                assert!(ty(lhs) == TypeId::BOOL && ty(rhs) == TypeId::BOOL && expr.ty == TypeId::BOOL);
                vec![lhs, rhs]
            }
            ExprKind::Ternary { cond, then, otherwise } => {
                assert!(ty(cond) == TypeId::BOOL && ty(then) == expr.ty && ty(otherwise) == expr.ty);
                vec![cond, then, otherwise]
            }
            ExprKind::Comma { lhs, rhs } => {
                assert_eq!(ty(rhs), expr.ty);
                vec![lhs, rhs]
            }
            ExprKind::Assign { place: to, value } => {
                place(to);
                assert!(ty(to) == expr.ty && ty(value) == expr.ty);
                vec![to, value]
            }
            ExprKind::AssignOp { op, shape, place: to, value } => {
                place(to);
                assert_eq!(ty(to), expr.ty);
                self.shape(op, shape, ty(to), ty(value));
                vec![to, value]
            }
            ExprKind::IncDec { place: to, .. } => {
                place(to);
                assert_eq!(ty(to), expr.ty);
                vec![to]
            }
            ExprKind::Convert(value) => {
                assert_eq!(types.components(ty(value)), types.components(expr.ty));
                assert_ne!(types.scalar(ty(value)), types.scalar(expr.ty));
                assert!(!matches!(types.get(ty(value)), Type::Matrix { .. }));
                vec![value]
            }
            ExprKind::Splat(value) => {
                assert!(matches!(types.get(ty(value)), Type::Scalar(_)));
                assert_eq!(types.scalar(ty(value)), types.scalar(expr.ty));
                vec![value]
            }
            ExprKind::Vector(args) | ExprKind::Matrix(args) => {
                let wanted = types.components(expr.ty).unwrap();
                let mut filled = 0;
                for &arg in &module[args] {
                    assert!(filled < wanted, "an argument is wholly unused");
                    assert_eq!(types.scalar(ty(arg)), types.scalar(expr.ty));
                    filled += types.components(ty(arg)).unwrap();
                }
                assert!(filled >= wanted);
                module[args].to_vec()
            }
            ExprKind::MatrixDiagonal(value) => {
                assert_eq!(ty(value), TypeId::FLOAT);
                vec![value]
            }
            ExprKind::MatrixResize(value) => {
                assert!(matches!(types.get(ty(value)), Type::Matrix { .. }) && ty(value) != expr.ty);
                vec![value]
            }
            ExprKind::Struct(args) => {
                let Type::Struct(of) = types.get(expr.ty) else { panic!("no struct") };
                assert!(module[args].iter().map(|&a| ty(a)).eq(module[module[of].members].iter().map(|m| m.ty)));
                module[args].to_vec()
            }
            ExprKind::Array(args) => {
                let Type::Array { element, len } = types.get(expr.ty) else { panic!("no array") };
                assert!(module[args].len() == len as usize && module[args].iter().all(|&a| ty(a) == element));
                module[args].to_vec()
            }
            ExprKind::Call { func, args } => {
                assert!(module[func].body.is_some() && module[func].result == expr.ty);
                assert_eq!(module[args].len(), module.params(func).len());
                for (&arg, param) in module[args].iter().zip(module.params(func)) {
                    assert_eq!(ty(arg), param.ty);
                    if param.kind.copies_out() {
                        place(arg);
                    }
                    if matches!(types.get(param.ty), Type::Sampler { .. }) {
                        assert!(matches!(module[arg].kind, ExprKind::Channel(_) | ExprKind::Local(_)));
                    }
                }
                module[args].to_vec()
            }
            ExprKind::Builtin { builtin, args } => {
                builtin.writes.iter().for_each(|&at| place(module[args][at]));
                module[args].to_vec()
            }
        }
    }

    fn shape(&self, op: BinaryOp, shape: Shape, lhs: TypeId, rhs: TypeId) {
        let types = &self.module.types;
        let scalar = |ty| matches!(types.get(ty), Type::Scalar(_));
        let matrix = |ty| matches!(types.get(ty), Type::Matrix { .. });
        let shift = matches!(op, BinaryOp::Shl | BinaryOp::Shr);
        match shape {
            Shape::Same if shift => assert_eq!(types.components(lhs), types.components(rhs)),
            Shape::Same => assert!(lhs == rhs && !(op == BinaryOp::Mul && matrix(lhs))),
            Shape::ScalarLeft => assert!(scalar(lhs) && !scalar(rhs)),
            Shape::ScalarRight => assert!(!scalar(lhs) && scalar(rhs)),
            Shape::MatVec => assert!(op == BinaryOp::Mul && matrix(lhs) && !matrix(rhs)),
            Shape::VecMat => assert!(op == BinaryOp::Mul && !matrix(lhs) && matrix(rhs)),
            Shape::MatMat => assert!(op == BinaryOp::Mul && matrix(lhs) && matrix(rhs)),
        }
    }
}
