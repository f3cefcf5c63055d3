//! Tests of merging edits with changes on disk.

use super::*;
use eddy_project::{
    Body, Channel, ControlAddress, ControlTarget, CustomUniformValue, Included, Input, InputKind, PassName, Sampler,
    SamplerRules, Source,
};

fn project(texts: &[(&str, &str)], has_manifest: bool) -> Project {
    let mut project = Project::new("p", Vec::new(), Origin::Folder { path: "/p".into(), has_manifest });
    for (key, text) in texts {
        let name = format!("{key}.glsl");
        let source = Source { path: Some(PathBuf::from("/p").join(&name)), name, text: (*text).into() };
        match *key {
            "common" => project.common = Some(source),
            key => {
                insert_pass(&mut project, Pass::new(PassName::parse(key).unwrap(), source));
            }
        }
    }
    project
}

fn pass(key: &str) -> Tab {
    Tab::Pass(PassName::parse(key).unwrap())
}

fn edit(d: &mut Documents, tab: &Tab, text: &str) {
    d.current_mut().source_mut(tab).unwrap().text = text.into();
}

fn text<'a>(d: &'a Documents, tab: &Tab) -> &'a str {
    &d.current().source(tab).unwrap().text
}

fn rebind(project: &mut Project) {
    let channel = Channel { input: Input::KEYBOARD, sampler: Sampler::BUFFER };
    project.image_mut().unwrap().bindings.set(0, Some(channel));
}

#[test]
fn edits_make_a_tab_dirty_and_undoing_them_makes_it_clean() {
    let mut d = Documents::new(project(&[("common", "c"), ("image", "i")], true));
    assert!(!d.is_dirty());
    edit(&mut d, &Tab::Common, "c2");
    assert_eq!(d.dirty_tabs(), [Tab::Common]);
    assert!(d.is_dirty() && !d.is_tab_dirty(&pass("image")));
    edit(&mut d, &Tab::Common, "c");
    assert!(!d.is_dirty());
    rebind(d.current_mut());
    assert!(d.is_dirty() && d.dirty_tabs().is_empty(), "a channel is no tab's text");
}

#[test]
fn changes_other_than_texts_and_places_are_structural() {
    let scene = eddy_project::presets::load("toon-outline").unwrap().project;
    let geometry = |p: &Project| p.passes.iter().position(|p| !p.body.is_screen()).unwrap();
    assert!(structure::is_same(&scene, &scene.clone()));
    type Change = fn(&mut Project, usize);
    let changes: &[(&str, Change)] = &[
        ("name", |p, _| p.name.push('x')),
        ("info", |p, _| p.info.tags.push("x".into())),
        ("common", |p, _| p.common = p.common.take().xor(Some(p.passes[0].source.clone()))),
        ("a pass less", |p, _| drop(p.passes.pop())),
        ("the order", |p, _| p.passes.reverse()),
        ("a channel", |p, _| {
            let channel = Channel { input: Input::Device(InputKind::Webcam), sampler: Sampler::BUFFER };
            p.passes[0].bindings.set(3, Some(channel));
        }),
        ("sampler rules", |p, _| p.sampler_rules = SamplerRules::Site),
        ("groups", |p, _| p.groups.push(eddy_project::Group { name: "g".into(), passes: vec![], steps: 2 })),
        ("a control", |p, _| {
            let target = ControlTarget::whole("x");
            p.controls.insert(target, ControlAddress::PitchBend { channel: 0 });
        }),
        ("a value", |p, _| drop(p.custom_uniform_values.insert("x".into(), CustomUniformValue::Int(1)))),
        ("size", |p, _| p.passes[0].settings.size = eddy_project::PassSize::Scale(0.25)),
        ("format", |p, _| p.passes[0].settings.format = eddy_project::TexelFormat::R8),
        ("region", |p, _| p.passes[0].settings.region = Some(eddy_project::Region { x: 0, y: 0, width: 1, height: 1 })),
        ("no meshes", |p, i| p.passes[i].body = Body::Screen),
        ("a draw less", |p, i| drop(p.passes[i].body.geometry_mut().unwrap().draws.pop())),
        ("a target more", |p, i| {
            p.passes[i].body.geometry_mut().unwrap().more_targets.push(eddy_project::TexelFormat::R8)
        }),
        ("the camera", |p, i| p.passes[i].body.geometry_mut().unwrap().camera.fov += 1.0),
        ("a stage's file", |p, i| p.passes[i].body.geometry_mut().unwrap().stages[0].name.push('x')),
    ];
    for (what, change) in changes {
        let mut other = scene.clone();
        change(&mut other, geometry(&scene));
        assert!(!structure::is_same(&scene, &other) && !structure::is_same(&other, &scene), "{what}");
        let mut documents = Documents::new(scene.clone());
        *documents.current_mut() = other;
        assert!(documents.is_dirty(), "{what}");
    }
    let mut other = scene.clone();
    for source in other.tab_sources_mut() {
        (source.text, source.path) = ("other".into(), Some("/elsewhere".into()));
    }
    other.passes[0].source.name = "other.glsl".into();
    other.origin = Origin::Unsaved;
    assert!(structure::is_same(&scene, &other) && !structure::has_same_texts(&scene, &other));
}

#[test]
fn unedited_parts_follow_the_disk() {
    let mut d = Documents::new(project(&[("buffer_a", "a"), ("image", "i")], true));
    edit(&mut d, &pass("buffer_a"), "a mine");
    let m = d.merge(project(&[("buffer_a", "a"), ("image", "i2")], true));
    assert_eq!(m, Merge { taken: vec![pass("image")], ..Merge::default() });
    assert_eq!((text(&d, &pass("image")), text(&d, &pass("buffer_a"))), ("i2", "a mine"));
    assert_eq!(d.dirty_tabs(), [pass("buffer_a")]);
}

#[test]
fn the_same_content_again_changes_nothing() {
    let mut d = Documents::new(project(&[("image", "i")], true));
    assert_eq!(d.merge(project(&[("image", "i")], true)), Merge::default());
    edit(&mut d, &pass("image"), "i2");
    assert_eq!(d.merge(project(&[("image", "i2")], true)), Merge::default(), "the disk came to what is here");
    assert!(!d.is_dirty());
}

#[test]
fn edits_on_both_sides_conflict_and_keep_mine_until_resolved() {
    let mut d = Documents::new(project(&[("image", "i")], true));
    edit(&mut d, &pass("image"), "mine");
    let m = d.merge(project(&[("image", "disk")], true));
    assert_eq!(m.conflicts.len(), 1);
    assert_eq!((&*m.conflicts[0].mine, &*m.conflicts[0].disk), ("mine", "disk"));
    assert!(!m.changes_project());
    assert_eq!(text(&d, &pass("image")), "mine");
    assert!(d.is_dirty());
    d.take_text_of_saved(&pass("image"));
    assert_eq!(text(&d, &pass("image")), "disk");
    assert!(!d.is_dirty());
}

#[test]
fn structure_follows_the_disk_and_edited_texts_stay() {
    let mut d = Documents::new(project(&[("image", "i")], true));
    edit(&mut d, &pass("image"), "mine");
    let mut disk = project(&[("buffer_a", "a"), ("image", "i")], true);
    rebind(&mut disk);
    let m = d.merge(disk);
    assert!(m.took_structure && m.conflicts.is_empty() && !m.structure_conflict);
    assert_eq!(text(&d, &pass("buffer_a")), "a");
    assert_eq!(text(&d, &pass("image")), "mine");
    assert!(d.current().image().unwrap().bindings.get(0).is_some());
    assert_eq!(d.dirty_tabs(), [pass("image")]);
}

#[test]
fn structure_changed_on_both_sides_is_a_conflict() {
    let mut d = Documents::new(project(&[("image", "i")], true));
    insert_pass(d.current_mut(), project(&[("buffer_b", "b")], true).passes.remove(0));
    let mut disk = project(&[("image", "i")], true);
    rebind(&mut disk);
    let m = d.merge(disk);
    assert!(m.structure_conflict && !m.took_structure);
    d.take_structure_of_saved();
    assert!(d.current().image().unwrap().bindings.get(0).is_some());
    assert_eq!(text(&d, &pass("buffer_b")), "b", "a text that is nowhere else is not dropped");
}

#[test]
fn text_of_deleted_file_is_kept_and_reported_once() {
    let mut both = project(&[("buffer_a", "a"), ("image", "i")], false);
    rebind(&mut both);
    let mut d = Documents::new(both.clone());
    let m = d.merge(project(&[("image", "i")], false));
    assert!(!m.took_structure, "its readers still read it");
    assert_eq!(m.gone, [pass("buffer_a")]);
    assert_eq!(text(&d, &pass("buffer_a")), "a");
    assert!(d.is_tab_dirty(&pass("buffer_a")));
    assert_eq!(d.merge(project(&[("image", "i")], false)), Merge::default(), "told once");
    d.merge(both);
    assert!(!d.is_dirty(), "it came back");
}

#[test]
fn pass_removed_from_manifest_is_dropped_unless_unsaved() {
    let both = [("buffer_a", "a"), ("image", "i")];
    let mut d = Documents::new(project(&both, true));
    let m = d.merge(project(&[("image", "i")], true));
    assert!(m.took_structure && m.gone.is_empty());
    assert_eq!(d.current().passes.len(), 1);

    let mut d = Documents::new(project(&both, true));
    edit(&mut d, &pass("buffer_a"), "mine");
    let m = d.merge(project(&[("image", "i")], true));
    assert_eq!(m.gone, [pass("buffer_a")]);
    assert_eq!(text(&d, &pass("buffer_a")), "mine");
}

#[test]
fn passes_are_inserted_in_drawing_order() {
    let p = project(
        &[("image", ""), ("sound", ""), ("buffer_c", ""), ("cube_a", ""), ("buffer_a", ""), ("buffer_b", "")],
        true,
    );
    let keys: Vec<&str> = p.passes.iter().map(|p| p.id.key()).collect();
    assert_eq!(keys, ["buffer_a", "buffer_b", "buffer_c", "cube_a", "image", "sound"]);
}

#[test]
fn a_diff_names_each_side() {
    let lines = diff("a\nb\nc\n", "a\nB\nc\r\n");
    assert!(lines.contains(&DiffLine::Both("a".into())));
    assert!(lines.contains(&DiffLine::Disk("b".into())) && lines.contains(&DiffLine::Mine("B".into())));
}

/// The files of a deleted folder disappear one after the other: one may be missed while the others are there.
#[test]
fn included_files_that_were_lost_are_restored() {
    let included = |name: &str, text: &str| Included {
        source: Source { name: name.into(), path: None, text: text.into() },
        trouble: text.is_empty().then(|| "there is no file".to_owned()),
        is_limit: false,
        is_edited: false,
    };
    let mut project = Project::of_image("p".into(), "".into());
    project.includes = vec![included("a.glsl", "#include \"b.glsl\""), included("b.glsl", "b")];
    let mut documents = Documents::new(project.clone());
    // The first one names the second one, which is not looked for any more.
    documents.take_includes(vec![included("a.glsl", ""), included("c.glsl", "c")]);
    documents.take_includes(vec![included("a.glsl", "")]);
    assert!(documents.restore_includes() && !documents.restore_includes());
    let texts = |project: &Project| {
        let mut all: Vec<_> = project.includes.iter().map(|i| i.source.text.to_string()).collect();
        all.sort();
        all
    };
    assert_eq!(texts(documents.current()), ["#include \"b.glsl\"", "b", "c"]);
    assert_eq!(texts(documents.saved()), texts(documents.current()));
    // What is read again and no longer included is forgotten.
    documents.take_includes(vec![included("a.glsl", "a")]);
    documents.restore_includes();
    assert_eq!(texts(documents.current()), ["a"]);
}

/// A read of files that started before a save completes after it.
#[test]
fn stale_read_of_included_files_does_not_undo_a_save() {
    let included = |text: &str, is_edited: bool| Included {
        source: Source { name: "lib.glsl".into(), path: None, text: text.into() },
        trouble: None,
        is_limit: false,
        is_edited,
    };
    let lib = Tab::Included("lib.glsl".into());
    let mut project = Project::of_image("p".into(), "".into());
    project.includes = vec![included("old", false)];
    let mut documents = Documents::new(project.clone());
    documents.set_text(&lib, "new");
    assert!(documents.is_dirty() && documents.current().includes[0].is_edited);
    let late = documents.current().includes.clone();
    documents.take_includes(late.clone());
    assert!(documents.is_tab_dirty(&lib), "nothing has changed");
    documents.take_includes(Vec::new());
    assert!(documents.is_tab_dirty(&lib), "what is edited stays though nothing includes it");
    // Saved, and no longer included.
    project.includes.clear();
    let _ = documents.set_saved(project.clone());
    documents.take_includes(late.clone());
    assert!(!documents.is_dirty() && documents.current().source(&lib).is_none());
    // Saved, and still included.
    project.includes = vec![included("new", false)];
    let _ = documents.set_saved(project);
    documents.take_includes(late);
    assert!(!documents.is_dirty() && !documents.current().includes[0].is_edited);
    documents.set_text(&lib, "newer");
    documents.set_text(&lib, "new");
    assert!(!documents.is_dirty());
}
