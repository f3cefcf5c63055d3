use super::*;

/// Returns the functions of a text by their first line, each up to its closing brace.
fn functions(text: &str) -> Vec<(&str, &str)> {
    let starts = text.match_indices(") {\n").filter_map(|(at, _)| {
        let line = text[..at].rfind('\n').map_or(0, |n| n + 1);
        let is_function = text[line..].starts_with(|c: char| c.is_ascii_lowercase()) && !text[line..at].contains('=');
        is_function.then_some(line)
    });
    starts
        .filter_map(|from| {
            let body = &text[from..];
            let body = &body[..body.find("\n}\n")? + 3];
            Some((body.split('\n').next()?, body))
        })
        .collect()
}

/// The projects of methods are self-contained, as they are opened and saved; their common parts are copied.
#[test]
fn common_parts_of_methods_are_identical() {
    let mut compared = 0;
    for family in [
        &["diffusion_stencil/common.glsl", "diffusion_blur/common.glsl"][..],
        &["gray_scott_stencil/common.glsl", "gray_scott_blur/common.glsl"],
        &[
            "poisson_jacobi/common.glsl",
            "poisson_sor/common.glsl",
            "poisson_cycle/common.glsl",
            "poisson_chebyshev/common.glsl",
        ],
        &["blur_taps/buffer_source.glsl", "blur_pyramid/buffer_source.glsl"],
    ] {
        let text = |name: &str| METHODS.get_file(name).and_then(|f| f.contents_utf8()).unwrap();
        let first = functions(text(family[0]));
        assert!(!first.is_empty(), "{}", family[0]);
        for other in &family[1..] {
            let others = functions(text(other));
            let both = first.iter().filter_map(|(head, body)| {
                others.iter().find(|(other, _)| other == head).map(|(_, other)| (head, body, other))
            });
            for (head, one, another) in both {
                assert_eq!(one, another, "`{head}` of {} and {other}", family[0]);
                compared += 1;
            }
        }
    }
    assert!(compared >= 10, "{compared}");
}

#[test]
fn steps_are_split_exactly() {
    for (total, most) in [(2000, 32), (625, 32), (157, 32), (1, 1), (7, 0)] {
        let (frames, steps) = frames_of(total, most);
        assert_eq!(frames * steps, total);
        assert!(steps <= most.max(1));
    }
    assert_eq!(frames_of(2000, 32), (80, 25));
}

#[test]
fn fingerprints_depend_on_texts_settings_texels_and_size() {
    let base = || Setup::new("gray_scott_stencil", (8, 8)).define("STENCIL", 5);
    let print = |setup: Setup| setup.fingerprint().unwrap();
    assert_eq!(print(base()), print(base()));
    let texels = [[0.5; 4]; 64];
    let mut others = vec![
        base(),
        base().define("OTHER", 1),
        base().uniform("feed", 0.03),
        base().edit("common", "feed", "food"),
        base().initial("field", "vec4(0.5)"),
        base().state("field", &texels),
        base().state("field", &[[0.25; 4]; 64]),
        base().storage(Storage::Half),
        base().wants_picture(),
        base().restless(),
        Setup::new("gray_scott_stencil", (8, 9)).define("STENCIL", 5),
    ]
    .into_iter()
    .map(print)
    .collect::<Vec<_>>();
    let count = others.len();
    others.sort();
    others.dedup();
    assert_eq!(others.len(), count);
}

#[test]
fn errors_name_missing_parts_of_a_project() {
    let said = |setup: Setup| setup.project().unwrap_err().to_string();
    assert!(said(Setup::new("floor", (8, 8)).uniform("nope", 1.0)).contains("has no uniform nope"));
    let beyond = said(Setup::new("fluid_guay", (8, 8)).uniform("dt", 5.0));
    assert!(beyond.contains("5.0") && beyond.contains("uniform dt") && beyond.contains("0.0 to 4.0"), "{beyond}");
    assert!(said(Setup::new("floor", (8, 8)).steps("nope", 1)).contains("has no group nope"));
    assert!(said(Setup::new("floor", (8, 8)).initial("nope", "vec4(0)")).contains("has no Buffer nope"));
    let far = said(Setup::new("taa", (8, 8)).uniform("gamma", 40.0));
    assert!(far.contains("uniform gamma") && far.contains("0.25 to 4"), "{far}");
    assert!(said(Setup::new("floor", (8, 8)).text("nope", "")).contains("has no Buffer nope"));
    assert!(said(Setup::new("floor", (8, 8)).edit("copy", "nope", "")).contains("has no text `nope`"));
    assert!(said(Setup::new("floor", (8, 8)).edit("common", "nope", "")).contains("has no text `nope`"));
    assert!(said(Setup::new("floor", (8, 8)).given("nope", &[])).contains("has no Buffer nope"));
    let setup = Setup::new("floor", (8, 8)).wants_value("copy", "vec3 nope");
    let said = setup.value_at(&setup.project().unwrap().0).unwrap_err().to_string();
    assert!(said.contains("has no declaration `vec3 nope`"), "{said}");
}
