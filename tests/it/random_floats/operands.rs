//! Random operands, generated from bits by both the program and the test, so that both have the same numbers.

/// The width and height of the picture in pixels; each has its own operands.
pub(super) const SIDE: u32 = 16;

/// The number of operands of an operation; each is a vector of four.
pub(super) const COUNT: usize = 3;

/// The range of magnitudes of an operand.
#[derive(Clone, Copy, Debug)]
pub(super) struct Span {
    /// Powers of two: from 2^low up to the one after 2^high.
    low: i32,
    high: i32,
    is_signed: bool,
    /// One in 16 is a zero.
    has_zeros: bool,
}

impl Span {
    pub(super) const fn new(low: i32, high: i32) -> Self {
        Self { low, high, is_signed: false, has_zeros: false }
    }

    pub(super) const fn signed(self) -> Self {
        Self { is_signed: true, ..self }
    }

    pub(super) const fn or_zero(self) -> Self {
        Self { has_zeros: true, ..self }
    }

    fn operand(self, n: u32) -> f32 {
        let h = hash(n);
        let exponent = self.low + (h % (self.high - self.low + 1) as u32) as i32;
        let sign = if self.is_signed { h & 0x8000_0000 } else { 0 };
        // One in eight is a power of two.
        let mantissa = if (h >> 8).is_multiple_of(8) { 0 } else { hash(h) & 0x7f_ffff };
        let magnitude =
            if self.has_zeros && (h >> 12).is_multiple_of(16) { 0 } else { ((exponent + 127) as u32) << 23 | mantissa };
        f32::from_bits(sign | magnitude)
    }
}

fn hash(n: u32) -> u32 {
    let n = (n ^ n >> 16).wrapping_mul(0x7feb_352d);
    let n = (n ^ n >> 15).wrapping_mul(0x846c_a68b);
    n ^ n >> 16
}

/// Returns the operands of a pixel.
pub(super) fn operands(seed: u32, (x, y): (u32, u32), spans: [Span; COUNT]) -> [[f64; 4]; COUNT] {
    let first = seed.wrapping_add(16 * (x + SIDE * y));
    let number = |k: usize, i: usize| spans[k].operand(first.wrapping_add((4 * k + i) as u32)).into();
    std::array::from_fn(|k| std::array::from_fn(|i| number(k, i)))
}

/// Returns a program that draws the value of an expression over the operands `a`, `b` and `c`.
pub(super) fn program(seed: u32, spans: [Span; COUNT], expression: &str) -> String {
    let operand = |(k, span): (usize, Span)| {
        let Span { low, high, is_signed, has_zeros } = span;
        let parts: Vec<String> = (4 * k..4 * k + 4)
            .map(|at| format!("operand(n + {at}u, {low}, {}u, {is_signed}, {has_zeros})", high - low + 1))
            .collect();
        format!("    vec4 {} = vec4({});\n", ["a", "b", "c"][k], parts.join(", "))
    };
    let operands: String = spans.into_iter().enumerate().map(operand).collect();
    format!(
        "uint hash(uint n) {{
    n = (n ^ n >> 16) * 0x7feb352du;
    n = (n ^ n >> 15) * 0x846ca68bu;
    return n ^ n >> 16;
}}
float operand(uint n, int low, uint count, bool is_signed, bool has_zeros) {{
    uint h = hash(n);
    int exponent = low + int(h % count);
    uint s = is_signed ? h & 0x80000000u : 0u;
    uint mantissa = (h >> 8) % 8u == 0u ? 0u : hash(h) & 0x7fffffu;
    uint magnitude = has_zeros && (h >> 12) % 16u == 0u ? 0u : uint(exponent + 127) << 23 | mantissa;
    return uintBitsToFloat(s | magnitude);
}}
void mainImage(out vec4 o, in vec2 p) {{
    uint n = {seed}u + 16u * (uint(p.x) + {SIDE}u * uint(p.y));
{operands}    o = {expression};
}}
"
    )
}
