//! WGSL for browsers, which are stricter than naga in two points.

/// The start of each text: derivatives are allowed in non-uniform control flow, as in GLSL. WGSL makes that an error
/// unless it is turned off (WGSL specification, section 15.2.1).
const UNIFORMITY: &str = "diagnostic(off, derivative_uniformity);\n";

/// The name of a variable that is always zero, and that no compiler treats as a constant.
const ZERO: &str = "not_constant";

/// Returns the text adapted for browsers. An infinity or NaN is written as its bits; in WGSL that is an error in a
/// constant expression (section 15.7.2), so the bits are combined with a variable.
pub(crate) fn for_browsers(text: &str) -> String {
    const CALL: &str = "bitcast<f32>(";
    let mut out = String::with_capacity(text.len() + UNIFORMITY.len());
    out.push_str(UNIFORMITY);
    let mut rest = text;
    let mut needs_zero = false;
    while let Some(at) = rest.find(CALL) {
        let (before, after) = rest.split_at(at + CALL.len());
        out.push_str(before);
        rest = after;
        let digits = after.find(|c: char| !c.is_ascii_digit()).unwrap_or(after.len());
        let is_literal = after[digits..].starts_with("u)");
        let bits = after[..digits].parse::<u32>().ok().filter(|_| is_literal);
        if bits.is_some_and(|bits| !f32::from_bits(bits).is_finite()) {
            out.push_str(ZERO);
            out.push_str(" | ");
            needs_zero = true;
        }
    }
    out.push_str(rest);
    if needs_zero {
        out.push_str(&format!("\nvar<private> {ZERO}: u32;\n"));
    }
    out
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn only_bits_of_non_finite_numbers_are_hidden() {
        let text = "let a = bitcast<f32>(2143289344u); let b = bitcast<f32>(1065353216u); let c = bitcast<f32>(a);";
        let out = for_browsers(text);
        assert!(out.starts_with(UNIFORMITY));
        assert!(out.contains("bitcast<f32>(not_constant | 2143289344u)"), "{out}");
        assert!(out.contains("bitcast<f32>(1065353216u)") && out.contains("bitcast<f32>(a)"));
        assert_eq!(out.matches("var<private> not_constant: u32;").count(), 1);
        assert!(!for_browsers("let b = 1;").contains("not_constant"));
    }
}
