//! A mistake is reported once, and its fix corrects it in one step.

use eddy::{
    diag::{Diagnostic, render_all},
    engine::Sources,
    glsl::Driver,
    project::{Project, Tab},
};

fn errors_of(text: &str) -> (Project, Vec<Diagnostic>) {
    let project = Project::of_image("fixes".into(), text.into());
    let compiled = Sources::new(&project).compile_pass(0, Driver::default());
    let found = compiled.map_or_else(|errors| errors, |pass| pass.diagnostics);
    (project, found.into_iter().filter(Diagnostic::is_error).collect())
}

/// Applies the first fix of the first error until there are no errors; returns the text and the number of fixes.
fn apply_fixes(text: &str) -> (String, usize) {
    let mut text = text.to_owned();
    for count in 0..20 {
        let (project, errors) = errors_of(&text);
        let Some(error) = errors.first() else { return (text, count) };
        let shown = || render_all(&errors, &project.sources());
        let fix = error.fixes.first().unwrap_or_else(|| panic!("no fix:\n{}", shown()));
        let span = error.span.unwrap();
        let next = fix.applied(span.source, &text);
        assert_ne!(next, text, "{} does nothing:\n{}", fix.title, shown());
        text = next;
    }
    panic!("the fixes do not end: {text}");
}

const IMAGE: &str = "void mainImage(out vec4 o, in vec2 p) { o = vec4(red); }";

#[test]
fn one_mistake_is_one_error_with_a_fix() {
    for (text, expected) in [
        // A Markdown fence around the text: with and without a language, indented, on one side only, and on the line
        // of code.
        (format!("```glsl\nconst float red = 1.0;\n{IMAGE}\n```\n"), format!("const float red = 1.0;\n{IMAGE}\n")),
        (format!("```\nconst float red = 1.0;\n{IMAGE}\n  ```  "), format!("const float red = 1.0;\n{IMAGE}\n")),
        (format!("````c++\r\nconst float red = 1.0;\r\n{IMAGE}\r\n"), format!("const float red = 1.0;\r\n{IMAGE}\r\n")),
        (format!("const float red = 1.0;\n{IMAGE}\n```"), format!("const float red = 1.0;\n{IMAGE}\n")),
        (format!("``` const float red = 1.0;\n{IMAGE}\n"), format!(" const float red = 1.0;\n{IMAGE}\n")),
        // A character before a directive.
        (
            format!("x#iUniform float red = 0.5 in {{ 0.0, 1.0 }}\n{IMAGE}"),
            format!("#iUniform float red = 0.5 in {{ 0.0, 1.0 }}\n{IMAGE}"),
        ),
        (format!("q #define red 0.5\n{IMAGE}"), format!("#define red 0.5\n{IMAGE}")),
        (format!("1#define red 0.5\n{IMAGE}"), format!("#define red 0.5\n{IMAGE}")),
        (format!("é#define red 0.5\n{IMAGE}"), format!("#define red 0.5\n{IMAGE}")),
        (
            format!("x#if 1\n#define red 0.5\n#endif\n{IMAGE}"),
            format!("#if 1\n#define red 0.5\n#endif\n{IMAGE}"),
        ),
        (
            format!("float f(float x) {{ return x; }} #define red f(0.5)\n{IMAGE}"),
            format!("float f(float x) {{ return x; }} \n#define red f(0.5)\n{IMAGE}"),
        ),
        // A shader of another host.
        (
            "void main()\n{\n    gl_FragColor = vec4(0.5);\n    gl_FragColor.a = 1.0;\n}\n".into(),
            "void mainImage(out vec4 fragColor, in vec2 fragCoord)\n{\n    fragColor = vec4(0.5);\n    fragColor.a = 1.0;\n}\n"
                .into(),
        ),
        (
            "void main(void) { gl_FragColor = vec4(gl_FragCoord.xy, 0.0, 1.0); }".into(),
            "void mainImage(out vec4 fragColor, in vec2 fragCoord) { fragColor = vec4(gl_FragCoord.xy, 0.0, 1.0); }"
                .into(),
        ),
        (
            "void mainImage(out vec4 o, in vec2 p) { gl_FragColor = vec4(0.5); }".into(),
            "void mainImage(out vec4 o, in vec2 p) { o = vec4(0.5); }".into(),
        ),
    ] {
        let (project, errors) = errors_of(&text);
        assert_eq!(errors.len(), 1, "{text}\n{}", render_all(&errors, &project.sources()));
        assert_eq!(apply_fixes(&text), (expected, 1), "{text}");
    }
}

#[test]
fn fixes_correct_common_mistakes() {
    let image = |body: &str| {
        format!("struct Ball {{ vec3 center; float size; }};\nvoid mainImage(out vec4 o, in vec2 p) {{ {body} }}")
    };
    for (wrong, right) in [
        ("o = texture2D(iChannel0, p);", "o = texture(iChannel0, p);"),
        ("o = texture2DLod(iChannel0, p, 0.0);", "o = textureLod(iChannel0, p, 0.0);"),
        ("o = texture2DLodEXT(iChannel0, p, 0.0);", "o = textureLod(iChannel0, p, 0.0);"),
        ("o = texture2DProj(iChannel0, vec3(p, 1.0));", "o = textureProj(iChannel0, vec3(p, 1.0));"),
        ("o = texture2DGradEXT(iChannel0, p, p, p);", "o = textureGrad(iChannel0, p, p, p);"),
        ("o = vec4(lerp(0.0, 1.0, frac(p.x)));", "o = vec4(mix(0.0, 1.0, fract(p.x)));"),
        ("o = vec4(time);", "o = vec4(iTime);"),
        ("o = vec4(p / u_resolution, 0.0, 1.0);", "o = vec4(p / iResolution.xy, 0.0, 1.0);"),
        // Ints in place of floats.
        ("float a = 1; o = vec4(a);", "float a = 1.0; o = vec4(a);"),
        ("float a = -2; o = vec4(a);", "float a = -2.0; o = vec4(a);"),
        ("float a = p.x * 2; o = vec4(a);", "float a = p.x * 2.0; o = vec4(a);"),
        ("o = vec4(max(p.x, 1) + pow(2, p.y));", "o = vec4(max(p.x, 1.0) + pow(2.0, p.y));"),
        ("o = vec4(clamp(p.x, 0, 1));", "o = vec4(clamp(p.x, 0.0, 1.0));"),
        ("int n = 3; float a = n; o = vec4(a);", "int n = 3; float a = float(n); o = vec4(a);"),
        ("int n = 3; float a = n + 1; o = vec4(a);", "int n = 3; float a = float(n + 1); o = vec4(a);"),
        ("vec2 a = p.xyxy; o = a.xyxy;", "vec2 a = (p.xyxy).xy; o = a.xyxy;"),
        ("uint n = 3; o = vec4(n);", "uint n = 3u; o = vec4(n);"),
        // Typing errors.
        ("o = vec4(p / iResolutoin.xy, 0.0, 1.0);", "o = vec4(p / iResolution.xy, 0.0, 1.0);"),
        ("o = vec4(smothstep(0.0, 1.0, p.x));", "o = vec4(smoothstep(0.0, 1.0, p.x));"),
        ("Bal b; o = vec4(b.size);", "Ball b; o = vec4(b.size);"),
        ("Ball b; b.size = 1.0; o = vec4(b.sise);", "Ball b; b.size = 1.0; o = vec4(b.size);"),
        ("o = vec4(p.x \u{2212} 1.0);", "o = vec4(p.x - 1.0);"),
        ("o =\u{a0}vec4(1.0);", "o = vec4(1.0);"),
    ] {
        let (text, count) = apply_fixes(&image(wrong));
        assert_eq!(text, image(right));
        assert!((1..=3).contains(&count), "{wrong}: {count} fixes");
    }
    let (text, _) = apply_fixes("#defin red 0.5\nvoid mainImage(out vec4 o, in vec2 p) { o = vec4(red); }");
    assert!(text.starts_with("#define red"));
}

/// A fix inside a macro's text would change all its uses.
#[test]
fn text_of_a_macro_has_no_fix() {
    let (_, errors) = errors_of("#define N 3\nvoid mainImage(out vec4 o, in vec2 p) { o = vec4(p.x * N); }");
    assert!(errors.len() == 1 && errors[0].fixes.is_empty(), "{errors:?}");
}

/// For any damaged text, the edits of a fix are inside the text and do not overlap.
#[test]
fn fixes_of_damaged_texts_are_inside_them() {
    let text =
        "```\nx#define N 3\nvoid main() { gl_FragColor = texture2D(iChannel0, vec2(1, 2) * 3); int é = 1.0; }\n```\n";
    for cut in (0..text.len()).filter(|cut| text.is_char_boundary(*cut)) {
        for text in [&text[..cut], &text[cut..]] {
            let (project, errors) = errors_of(text);
            for fix in errors.iter().flat_map(|error| &error.fixes) {
                let mut edits: Vec<_> = fix.edits.iter().map(|e| e.span).collect();
                edits.sort_by_key(|span| span.start);
                assert!(edits.windows(2).all(|pair| pair[0].end <= pair[1].start), "{text:?}: {fix:?}");
                for span in edits {
                    let tab = project.tab_of(span.source).unwrap();
                    assert!(tab == Tab::Common || project.source(&tab).unwrap().text.get(span.range()).is_some());
                }
            }
        }
    }
}
