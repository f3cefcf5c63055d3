use super::*;

#[test]
fn every_method_has_all_its_files() {
    let mut sharing = 0;
    for dir in METHODS.dirs() {
        let name = dir.path().file_name().unwrap().to_str().unwrap();
        if !LIBRARY.has(name) {
            continue;
        }
        let loaded = project::presets::load_embedded(&LIBRARY, name).unwrap_or_else(|e| panic!("{name}: {e}"));
        let lines = loaded.project.include_lines();
        assert!(lines.missing.is_empty() && lines.diagnostics.is_empty(), "{name}: {lines:?}");
        let has = |source: &project::Source| dir.get_file(dir.path().join(&source.name)).is_some();
        sharing += usize::from(!loaded.project.tab_sources().all(has) || !lines.lines.is_empty());
    }
    assert!(sharing > 20, "{sharing} methods share files");
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
        base().edit("common", "SPLIT 0", "SPLIT 1"),
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
