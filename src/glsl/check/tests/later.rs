//! Features of versions of GLSL after ES 3.00, in texts of any version; Shadertoy's language does not have them.

use super::dialects::{body, errors, source};
use crate::{Dialect, Version, compile, diagnose, hir::Builtin};

pub(super) const LATER: Dialect = Dialect::Any(Version { number: 450, is_es: false });

fn later() -> impl Iterator<Item = Builtin> {
    Builtin::all().filter(|builtin| builtin.since > 0)
}

/// Returns the errors of statements in the body of an entry point.
pub(super) fn of_statements(dialect: Dialect, statements: &str) -> Vec<String> {
    errors(dialect, &body(statements).replace("x / 2;", "x / 2.0;"))
}

#[test]
fn names_of_later_functions_are_free() {
    assert!(later().count() > 20);
    for name in later().map(|builtin| builtin.name) {
        let text = format!(
            "struct S {{ float {name}; }};\nvec2 {name}(vec2 a) {{ return a * 2.0; }}\nvec2 {name}(S a) {{ return vec2(a.{name}); }}\n\
             float f(float {name}) {{ return {name}; }}\n\
             void mainImage(out vec4 c, in vec2 p) {{ c = vec4({name}(p), {name}(S(1.0))); float {name} = f(p.x); c += {name}; }}"
        );
        for dialect in [Dialect::Shadertoy, Dialect::Ghostty, LATER] {
            let said = diagnose(&source(dialect, &text));
            assert!(said.is_empty(), "{dialect:?}: {said:?}");
            compile(&source(dialect, &text)).unwrap();
        }
        let text = format!("float {name} = 2.0;\nvoid mainImage(out vec4 c, in vec2 p) {{ c = vec4({name}); }}");
        for dialect in [Dialect::Shadertoy, LATER] {
            assert_eq!(errors(dialect, &text), [""; 0], "{name}");
        }
    }
}

#[test]
fn later_functions_exist_from_their_version_on() {
    for (name, until) in [("fma(p, p, p)", 400), ("vec2(textureQueryLevels(iChannel0))", 430), ("dFdxFine(p)", 450)] {
        let statements = format!("c = vec4({name}, 0, 1);");
        let unknown = |dialect| of_statements(dialect, &statements).join("\n");
        assert!(unknown(Dialect::Shadertoy).contains("there is no function"), "{name}");
        assert_eq!(unknown(Dialect::Ghostty).contains("there is no function"), until > 430, "{name}");
        assert_eq!(unknown(LATER), "", "{name}");
    }
}

#[test]
fn ints_become_uints_before_floats() {
    let statements = "uint u = uint(p.x); uint m = min(u, 1); uint n = clamp(u, 0, 7); \
                      uint carry; uint s = uaddCarry(u, 1, carry); u = bitfieldInsert(u, 3, 0, 2); \
                      float x = max(u, 0.5); c = vec4(m, n, s + carry, x + u);";
    assert_eq!(of_statements(LATER, statements), [""; 0]);
    for wrong in ["int carry; uaddCarry(1u, 1u, carry);", "float c2 = bitCount(p.x);", "frexp(p.x, 1);"] {
        assert_eq!(of_statements(LATER, &format!("{wrong} c = vec4(1);")).len(), 1, "{wrong}");
    }
}

#[test]
fn gathered_component_is_a_constant_from_0_to_3() {
    let gather =
        |args: &str| of_statements(LATER, &format!("int i = int(p.x); c = textureGather(iChannel0, p{args});"));
    assert_eq!(gather(""), [""; 0]);
    assert_eq!(gather(", 1 + 2"), [""; 0]);
    assert_eq!(gather(", 4"), ["`textureGather` has no component 4: 0 to 3 are x, y, z and w"]);
    assert_eq!(gather(", i"), ["the component of `textureGather` must be a constant expression"]);
    let offset = "ivec2 i = ivec2(p); c = textureGatherOffset(iChannel0, p, i);";
    assert_eq!(of_statements(LATER, offset), ["the offset of `textureGatherOffset` must be a constant expression"]);
}

#[test]
fn bits_outside_of_the_number_are_undefined() {
    let said = diagnose(&source(LATER, &body("const int n = bitfieldExtract(1, 30, 4); c = vec4(n);")));
    assert!(said.iter().any(|d| d.message == "`bitfieldExtract` is undefined for this value; 0 is used"), "{said:?}");
}
