//! GLSL ES 3.00 leaves results undefined by the operands of an operation. Sections are those of its specification.

use eddy_glsl::{
    ir::{Binary, Math, Op, Value},
    types::Scalar,
    walk::{Cell, Shadowed, View},
};

/// Returns why the result of an operation is undefined, and the numbers that make it so. `text` is what the author
/// wrote there, and `size` gives the size of a level of a channel's texture.
pub fn reason<'t>(
    view: &View<'_, '_, Shadowed>,
    op: &Op,
    text: &dyn Fn() -> &'t str,
    size: &dyn Fn(u8, i32) -> [i32; 3],
) -> Option<(&'static str, String)> {
    let floats = |value: Value| view.value(value).iter().map(|cell| cell.float().single).collect::<Vec<f32>>();
    let one = |what: &'static str, name: &str, arg: Value, is_bad: &dyn Fn(f32) -> bool| {
        let bad = floats(arg).into_iter().find(|&x| is_bad(x))?;
        Some((what, format!("{name}({bad:?})")))
    };
    match *op {
        Op::Math { fun, arg, arg1, arg2, .. } if is_float(view, arg) => match fun {
            Math::Sqrt => one("the square root of a negative number is undefined (8.2)", "sqrt", arg, &|x| x < 0.0),
            Math::InverseSqrt if text().starts_with("normalize") => {
                one("normalize of a zero vector is undefined (8.5)", "inversesqrt", arg, &|x| x <= 0.0)
            }
            Math::InverseSqrt => {
                one("inversesqrt is undefined for 0 and below (8.2)", "inversesqrt", arg, &|x| x <= 0.0)
            }
            Math::Log => one("the logarithm of 0 and below is undefined (8.2)", "log", arg, &|x| x <= 0.0),
            Math::Log2 => one("the logarithm of 0 and below is undefined (8.2)", "log2", arg, &|x| x <= 0.0),
            Math::Asin => one("asin is undefined outside -1 to 1 (8.1)", "asin", arg, &|x| x.abs() > 1.0),
            Math::Acos => one("acos is undefined outside -1 to 1 (8.1)", "acos", arg, &|x| x.abs() > 1.0),
            Math::Acosh => one("acosh is undefined below 1 (8.1)", "acosh", arg, &|x| x < 1.0),
            Math::Atanh => one("atanh is undefined at and beyond -1 and 1 (8.1)", "atanh", arg, &|x| x.abs() >= 1.0),
            Math::Pow => {
                let bad = |&(x, y): &(f32, f32)| x < 0.0 || (x == 0.0 && y <= 0.0);
                let (x, y) = pairs(&floats(arg), &floats(arg1?)).find(bad)?;
                let what = match x < 0.0 {
                    true => "pow of a negative base is undefined (8.2)",
                    false => "pow of 0 is undefined unless the exponent is above 0 (8.2)",
                };
                Some((what, format!("pow({x:?}, {y:?})")))
            }
            Math::Atan2 => {
                let (y, x) = pairs(&floats(arg), &floats(arg1?)).find(|&(y, x)| x == 0.0 && y == 0.0)?;
                Some(("the angle of (0, 0) is undefined (8.1)", format!("atan({y:?}, {x:?})")))
            }
            Math::SmoothStep => {
                let (a, b) = pairs(&floats(arg), &floats(arg1?)).find(|(a, b)| a >= b)?;
                Some((SMOOTHSTEP, format!("smoothstep({a:?}, {b:?}, …)")))
            }
            Math::Clamp => {
                let (low, high) = pairs(&floats(arg1?), &floats(arg2?)).find(|(low, high)| low > high)?;
                Some(("clamp is undefined where minVal is above maxVal (8.3)", format!("clamp(…, {low:?}, {high:?})")))
            }
            _ => None,
        },
        // The width of `smoothstep` whose edges are not known, see `lower`.
        Op::Binary { op: Binary::Divide, right, .. } if is_float(view, right) && text().starts_with("smoothstep") => {
            let Op::Binary { op: Binary::Subtract, left, right } = *view.op(right) else { return None };
            let (b, a) = pairs(&floats(left), &floats(right)).find(|(b, a)| a >= b)?;
            Some((SMOOTHSTEP, format!("smoothstep({a:?}, {b:?}, …)")))
        }
        Op::Binary { op: Binary::Divide, left, right } if is_float(view, right) => {
            // Any other number gives an infinity (4.5.1), which is told as such.
            let (x, y) = pairs(&floats(left), &floats(right)).find(|&(x, y)| x == 0.0 && y == 0.0)?;
            Some(("zero divided by zero is undefined (4.5.1)", format!("{x:?} / {y:?}")))
        }
        Op::Binary { op: Binary::Divide | Binary::Modulo, right, .. } => {
            // `lower` keeps every divisor from 0.
            let divisor = match *view.op(right) {
                Op::Select { reject, .. } => reject,
                Op::Math { fun: Math::Max, arg, .. } => arg,
                _ => return None,
            };
            let is_zero = ints(view, divisor).any(|n| n == 0);
            is_zero.then(|| ("an integer divided by zero is undefined (5.9)", "… / 0".into()))
        }
        Op::Binary { op: Binary::ShiftLeft | Binary::ShiftRight, right, .. } => {
            // `lower` keeps the low five bits.
            let mut by = right;
            if let Op::Splat { value, .. } = *view.op(by) {
                by = value;
            }
            let Op::Binary { op: Binary::And, left, .. } = *view.op(by) else { return None };
            let far = ints(view, left).find(|&n| n >= 32)?;
            Some((
                "a shift by as many bits as there are, or by a negative number, is undefined (5.9)",
                format!("… by {}", far as i32),
            ))
        }
        Op::Convert { value, to: Scalar::Int } if is_float(view, value) => {
            let far = floats(value).into_iter().find(|&x| !((-2_147_483_648.0..2_147_483_648.0).contains(&x)))?;
            Some(("converting a number out of range to int is undefined (5.4.1)", format!("int({far:?})")))
        }
        Op::Convert { value, to: Scalar::Uint } if is_float(view, value) => {
            let far = floats(value).into_iter().find(|&x| !(x > -1.0 && x < 4_294_967_296.0))?;
            Some(("converting a number out of range to uint is undefined (5.4.1)", format!("uint({far:?})")))
        }
        Op::Element { index, .. } => {
            // `lower` clamps every index.
            let Op::Math { fun: Math::Min, arg, arg1: Some(last), .. } = *view.op(index) else { return None };
            let (signed, asked) = match *view.op(arg) {
                Op::Math { fun: Math::Max, arg, .. } => (true, arg),
                _ => (false, arg),
            };
            let (asked, last) = (ints(view, asked).next()?, ints(view, last).next()?);
            let is_out = if signed { (asked as i32) < 0 || asked as i32 > last as i32 } else { asked > last };
            is_out.then(|| {
                let shown = if signed { (asked as i32).to_string() } else { asked.to_string() };
                ("an index beyond the end is undefined (4.1.9)", format!("[{shown}] of {}", last + 1))
            })
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

const SMOOTHSTEP: &str = "smoothstep is undefined unless its first edge is below the second (8.3)";

fn is_float(view: &View<'_, '_, Shadowed>, value: Value) -> bool {
    matches!(view.value(value).first(), Some(Cell::Float(_)))
        && view.module().types.scalar(view.function().ty(value)) == Some(Scalar::Float)
}

fn ints<'v>(view: &'v View<'_, '_, Shadowed>, value: Value) -> impl Iterator<Item = u32> + 'v {
    view.value(value).iter().map(|cell| cell.bits())
}

/// Components side by side; a scalar goes with each.
fn pairs(a: &[f32], b: &[f32]) -> impl Iterator<Item = (f32, f32)> {
    let at = |all: &[f32], i: usize| if all.len() == 1 { all[0] } else { all[i] };
    (0..a.len().max(b.len())).map(|i| (at(a, i), at(b, i))).collect::<Vec<_>>().into_iter()
}
