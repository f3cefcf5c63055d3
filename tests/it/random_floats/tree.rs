//! Small compositions of operations, whose bounds follow from those of their parts.

use super::{
    operands::Span,
    operations::{Grade, ROUNDING, SINE, ulp},
};

/// The span of every leaf.
pub(super) const LEAVES: Span = Span::new(-2, 1).signed();

/// A number that differs from the exact one by at most `error`.
#[derive(Clone, Copy, Debug)]
pub(super) struct Near {
    pub exact: f64,
    pub error: f64,
}

#[derive(Clone, Debug)]
pub(super) enum Tree {
    /// A component of an operand.
    Leaf(usize, usize),
    Node(Op, Vec<Tree>),
}

/// The operations of a tree. Arguments are kept inside each one's domain: above 0.5, or within a few units.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Op {
    Add,
    Subtract,
    Multiply,
    Divide,
    Sqrt,
    InverseSqrt,
    Sin,
    Cos,
    Exp2,
    Log2,
    Pow,
    Min,
    Max,
    Mix,
    Dot,
    Length,
    Normalize,
}

const OPS: [Op; 17] = [
    Op::Add,
    Op::Subtract,
    Op::Multiply,
    Op::Divide,
    Op::Sqrt,
    Op::InverseSqrt,
    Op::Sin,
    Op::Cos,
    Op::Exp2,
    Op::Log2,
    Op::Pow,
    Op::Min,
    Op::Max,
    Op::Mix,
    Op::Dot,
    Op::Length,
    Op::Normalize,
];

/// Random numbers by `SplitMix64`.
pub(super) struct Random(pub u64);

impl Random {
    fn below(&mut self, count: usize) -> usize {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let x = (self.0 ^ self.0 >> 30).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        let x = (x ^ x >> 27).wrapping_mul(0x94d0_49bb_1331_11eb);
        ((x ^ x >> 31) % count as u64) as usize
    }
}

impl Op {
    fn arguments(self) -> usize {
        match self {
            Op::Sqrt | Op::InverseSqrt | Op::Sin | Op::Cos | Op::Exp2 | Op::Log2 => 1,
            Op::Mix => 3,
            Op::Dot => 4,
            _ => 2,
        }
    }

    fn text(self, args: &[String]) -> String {
        let arg = |i: usize| &args[i];
        // Maps an argument to above 0.5, or into `limit`.
        let above = |i: usize| format!("(abs({}) + 0.5)", args[i]);
        let within = |i: usize, limit: &str| format!("clamp({}, -{limit}, {limit})", args[i]);
        match self {
            Op::Add => format!("({} + {})", arg(0), arg(1)),
            Op::Subtract => format!("({} - {})", arg(0), arg(1)),
            Op::Multiply => format!("({} * {})", arg(0), arg(1)),
            Op::Divide => format!("({} / {})", arg(0), above(1)),
            Op::Sqrt => format!("sqrt({})", above(0)),
            Op::InverseSqrt => format!("inversesqrt({})", above(0)),
            Op::Sin => format!("sin({})", within(0, "3.0")),
            Op::Cos => format!("cos({})", within(0, "3.0")),
            Op::Exp2 => format!("exp2({})", within(0, "4.0")),
            Op::Log2 => format!("log2({})", above(0)),
            Op::Pow => format!("pow({}, {})", above(0), within(1, "2.0")),
            Op::Min => format!("min({}, {})", arg(0), arg(1)),
            Op::Max => format!("max({}, {})", arg(0), arg(1)),
            Op::Mix => format!("mix({}, {}, clamp({}, 0.0, 1.0))", arg(0), arg(1), arg(2)),
            Op::Dot => format!("dot(vec2({}, {}), vec2({}, {}))", arg(0), arg(1), arg(2), arg(3)),
            Op::Length => format!("length(vec2({}, {}))", arg(0), arg(1)),
            Op::Normalize => format!("normalize(vec2({}, {})).x", arg(0), above(1)),
        }
    }

    /// Returns the value and its error bound, from this operation and its arguments.
    fn value(self, grade: Grade, args: &[Near]) -> Near {
        let [a, b] = [args[0], *args.get(1).unwrap_or(&args[0])];
        let above = |x: Near| {
            let exact = x.exact.abs() + 0.5;
            Near { exact, error: x.error + ROUNDING * (exact + x.error) }
        };
        let within = |x: Near, limit: f64| Near { exact: x.exact.clamp(-limit, limit), ..x };
        // Devices may reorder sums, so terms contribute by their magnitudes.
        let sum = |exact: f64, terms: f64, error: f64, roundings: f64| Near {
            exact,
            error: error + roundings * ROUNDING * (terms + error),
        };
        let product = |a: Near, b: Near| a.exact.abs() * b.error + b.exact.abs() * a.error + a.error * b.error;
        let ulps = |exact: f64, vulkan: f64, lavapipe: f64, walker: f64| {
            let count = match grade {
                Grade::Vulkan => vulkan,
                Grade::Lavapipe => lavapipe,
                Grade::Walker => walker,
            };
            count * ulp(exact)
        };
        match self {
            Op::Add => sum(a.exact + b.exact, a.exact.abs() + b.exact.abs(), a.error + b.error, 1.0),
            Op::Subtract => sum(a.exact - b.exact, a.exact.abs() + b.exact.abs(), a.error + b.error, 1.0),
            Op::Multiply => sum(a.exact * b.exact, (a.exact * b.exact).abs(), product(a, b), 2.0),
            Op::Divide => {
                let b = above(b);
                let exact = a.exact / b.exact;
                let error = (a.error + exact.abs() * b.error) / (b.exact - b.error);
                Near { exact, error: error + ulps(exact.abs() + error, 2.5, 1.0, 0.51) }
            }
            Op::Sqrt => {
                let a = above(a);
                let (exact, error) = (a.exact.sqrt(), a.error / (a.exact - a.error).sqrt());
                Near { exact, error: error + ulps(exact + error, 5.0, 1.0, 0.51) }
            }
            Op::InverseSqrt => {
                let a = above(a);
                let (exact, error) = (1.0 / a.exact.sqrt(), a.error / (a.exact - a.error).powf(1.5));
                Near { exact, error: error + ulps(exact + error, 2.0, 2.0, 1.51) }
            }
            Op::Sin | Op::Cos => {
                let a = within(a, 3.0);
                let exact = if self == Op::Sin { a.exact.sin() } else { a.exact.cos() };
                let own = match grade {
                    Grade::Vulkan => SINE,
                    Grade::Lavapipe => SINE_OF_LAVAPIPE,
                    Grade::Walker => ulp(exact),
                };
                Near { exact, error: a.error + own }
            }
            Op::Exp2 => {
                let a = within(a, 4.0);
                let exact = a.exact.exp2();
                let error = exact * (a.error.exp2() - 1.0);
                let own = ulps(exact + error, 3.0 + 2.0 * a.exact.abs(), EXP2_OF_LAVAPIPE, 1.0);
                Near { exact, error: error + own }
            }
            Op::Log2 => {
                let a = above(a);
                let (exact, error) = (a.exact.log2(), 1.5 * a.error / (a.exact - a.error));
                let own = if grade == Grade::Walker { ulp(exact) } else { (3.0 * ulp(exact)).max(LOG2) };
                Near { exact, error: error + own }
            }
            Op::Pow => {
                let (a, b) = (above(a), within(b, 2.0));
                let exact = a.exact.powf(b.exact);
                // The error of the exponent of two.
                let mut error = 1.5 * b.exact.abs() * a.error / (a.exact - a.error) + a.exact.log2().abs() * b.error;
                let exponent = b.exact * a.exact.log2();
                if grade != Grade::Walker {
                    error += b.exact.abs() * (3.0 * ulp(a.exact.log2())).max(LOG2) + ulp(exponent);
                }
                let own = ulps(exact, 3.0 + 2.0 * exponent.abs(), EXP2_OF_LAVAPIPE, 1.0);
                Near { exact, error: exact * (error.exp2() - 1.0) + 1.1 * own }
            }
            Op::Min => Near { exact: a.exact.min(b.exact), error: a.error.max(b.error) },
            Op::Max => Near { exact: a.exact.max(b.exact), error: a.error.max(b.error) },
            Op::Mix => {
                let t = args[2].exact.clamp(0.0, 1.0);
                let terms = a.exact.abs() + b.exact.abs() + a.error + b.error;
                let error =
                    (1.0 - t) * a.error + t * b.error + args[2].error * terms + (a.error + b.error) * args[2].error;
                sum(a.exact * (1.0 - t) + b.exact * t, terms, error, 4.0)
            }
            Op::Dot => {
                let [c, d] = [args[2], args[3]];
                let [left, right] = [a.exact * c.exact, b.exact * d.exact];
                sum(left + right, left.abs() + right.abs(), product(a, c) + product(b, d), 3.0)
            }
            Op::Length => {
                let exact = a.exact.hypot(b.exact);
                sum(exact, exact, a.error + b.error, if grade == Grade::Vulkan { 14.0 } else { 6.0 })
            }
            Op::Normalize => {
                let b = above(b);
                let length = a.exact.hypot(b.exact);
                let error = 2.0 * (a.error + b.error) / (length - a.error - b.error);
                sum(a.exact / length, 1.0, error, if grade == Grade::Vulkan { 16.0 } else { 8.0 })
            }
        }
    }
}

/// The measured bounds of lavapipe, as in [`super::operations`].
const SINE_OF_LAVAPIPE: f64 = 2e-7;
const EXP2_OF_LAVAPIPE: f64 = 6.0;
/// Vulkan's bound for `log2` near 1.
const LOG2: f64 = 1.0 / 2_097_152.0;

impl Tree {
    pub(super) fn random(random: &mut Random, depth: usize) -> Self {
        if depth == 0 || random.below(8) == 0 {
            return Tree::Leaf(random.below(3), random.below(4));
        }
        let op = OPS[random.below(OPS.len())];
        Tree::Node(op, (0..op.arguments()).map(|_| Tree::random(random, depth - 1)).collect())
    }

    pub(super) fn text(&self) -> String {
        match self {
            Tree::Leaf(k, i) => format!("{}.{}", ["a", "b", "c"][*k], ["x", "y", "z", "w"][*i]),
            Tree::Node(op, args) => op.text(&args.iter().map(Tree::text).collect::<Vec<_>>()),
        }
    }

    pub(super) fn value(&self, grade: Grade, operands: &[[f64; 4]; 3]) -> Near {
        match self {
            Tree::Leaf(k, i) => Near { exact: operands[*k][*i], error: 0.0 },
            Tree::Node(op, args) => {
                let args: Vec<Near> = args.iter().map(|arg| arg.value(grade, operands)).collect();
                op.value(grade, &args)
            }
        }
    }
}
