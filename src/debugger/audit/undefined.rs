//! Results that GLSL ES 3.00 leaves undefined for some operands. Sections are those of its specification.

use eddy_glsl::{
    builtins::{Arg, Builtin},
    ir::{Binary, Op, Value},
    types::{Scalar, Type, TypeId},
    undefined::{DIVISION, SHIFT, conversion},
    walk::{Cell, Shadowed, View},
    walkable::Precondition,
};

/// A sentence about the undefined behaviour, and the operands that cause it.
pub(super) type Reason = (&'static str, String);

/// Returns why the result of an operation is undefined, as far as the operation determines it. `size` returns the size
/// of a level of a channel's texture.
pub(super) fn of_operation(
    view: &View<'_, '_, Shadowed>,
    value: Value,
    size: &dyn Fn(u8, i32) -> [i32; 3],
) -> Option<Reason> {
    // The operations of an expanded function are undefined where the function is.
    if view.function().origin(value).builtin.is_some_and(|builtin| !builtin.undefined_for.is_empty()) {
        return None;
    }
    match *view.op(value) {
        Op::Binary { op: Binary::Divide, left, right } if is_float(view, right) => {
            // Any other dividend results in an infinity (4.5.1), which is reported as such.
            let (x, y) = pairs(&floats(view, left), &floats(view, right)).find(|&(x, y)| x == 0.0 && y == 0.0)?;
            Some(("zero divided by zero is undefined (4.5.1)", format!("{x:?} / {y:?}")))
        }
        Op::Convert { value, to } if is_float(view, value) => {
            let bad = |float: f32| Some((conversion(float, to)?, float));
            let (what, float) = floats(view, value).into_iter().find_map(bad)?;
            Some((what, format!("{}({float:?})", if to == Scalar::Int { "int" } else { "uint" })))
        }
        Op::Fetch { channel, coordinate, level } => {
            let level = ints(view, level).next()? as i32;
            let at: Vec<i32> = ints(view, coordinate).map(|n| n as i32).collect();
            let size = size(channel, level);
            let is_out = at.iter().zip(size).any(|(&at, size)| at < 0 || at >= size);
            is_out.then(|| {
                let numbers = format!("texelFetch(iChannel{channel}, {at:?}, {level}) of {}x{}", size[0], size[1]);
                ("a texel outside the texture is undefined (8.8)", numbers)
            })
        }
        _ => None,
    }
}

/// Returns why a precondition that lowering recorded is violated.
pub(super) fn of_precondition(view: &View<'_, '_, Shadowed>, precondition: &Precondition) -> Option<Reason> {
    match *precondition {
        Precondition::Call(builtin, ref args) => of_call(view, builtin, args),
        Precondition::Divisor(divisor) => ints(view, divisor).any(|n| n == 0).then(|| (DIVISION, "… / 0".into())),
        Precondition::Distance(by) => {
            let far = ints(view, by).find(|&n| n >= 32)?;
            Some((SHIFT, format!("… by {}", far as i32)))
        }
        Precondition::Index(index, len) => {
            let bits = ints(view, index).next()?;
            let is_signed = view.function().ty(index) == TypeId::INT;
            // As an unsigned number, a negative index is large.
            (bits >= len).then(|| {
                let shown = if is_signed { (bits as i32).to_string() } else { bits.to_string() };
                ("an index beyond the end is undefined (4.1.9)", format!("[{shown}] of {len}"))
            })
        }
    }
}

fn of_call(view: &View<'_, '_, Shadowed>, builtin: Builtin, args: &[Value]) -> Option<Reason> {
    let words: Vec<Vec<u32>> = args.iter().map(|&arg| ints(view, arg).collect()).collect();
    let types = &view.module().types;
    let given = args.iter().zip(&words).map(|(&arg, words)| {
        let ty = view.function().ty(arg);
        let columns = if let Type::Matrix { columns, .. } = types.get(ty) { columns.into() } else { 1 };
        Some(Arg { words, scalar: types.scalar(ty)?, columns })
    });
    let given: Vec<Arg<'_>> = given.collect::<Option<_>>()?;
    let (gap, component) = builtin.gap(&given)?;
    let shown = |(index, arg): (usize, &Arg<'_>)| match component {
        _ if !gap.decides.contains(&index) => "…".to_owned(),
        Some(component) => arg.text(component),
        None => (0..arg.words.len()).map(|component| arg.text(component)).collect::<Vec<_>>().join(", "),
    };
    let shown: Vec<String> = given.iter().enumerate().map(shown).collect();
    Some((gap.what, format!("{}({})", builtin.name, shown.join(", "))))
}

fn is_float(view: &View<'_, '_, Shadowed>, value: Value) -> bool {
    matches!(view.value(value).first(), Some(Cell::Float(_)))
        && view.module().types.scalar(view.function().ty(value)) == Some(Scalar::Float)
}

fn floats(view: &View<'_, '_, Shadowed>, value: Value) -> Vec<f32> {
    view.value(value).iter().map(|cell| cell.float().single).collect()
}

fn ints<'v>(view: &'v View<'_, '_, Shadowed>, value: Value) -> impl Iterator<Item = u32> + 'v {
    view.value(value).iter().map(|cell| cell.bits())
}

/// Pairs components; a scalar is paired with each.
fn pairs(a: &[f32], b: &[f32]) -> impl Iterator<Item = (f32, f32)> {
    let at = |all: &[f32], i: usize| if all.len() == 1 { all[0] } else { all[i] };
    (0..a.len().max(b.len())).map(|i| (at(a, i), at(b, i))).collect::<Vec<_>>().into_iter()
}
