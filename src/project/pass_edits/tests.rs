use super::*;
use crate::{
    self as project, Channel, FillValue, Filter, Group, Input, Overwrite, PassName, PassSize, Project, Region, Sampler,
    Tab, TexelFormat, Wrap,
};
use std::{
    fs,
    path::{Path, PathBuf},
};

const MANIFEST: &str = "\
# The author's words.
name = \"Waves\"

# What moves.
[passes.buffer_a]
# Slow is fine here.
channels.0 = { buffer = \"A\", filter = \"nearest\" }  # itself

[passes.buffer_b]
channels.0 = { buffer = \"A\" }

[passes.buffer_c]
channels.0 = { buffer = \"B\" }

[groups.solver]  # twenty of them
passes = [\"buffer_a\", \"buffer_b\"]
steps = 20

[passes.image]
channels.0 = { buffer = \"A\", wrap = \"repeat\" }
channels.1 = { buffer = \"C\" }
";

fn buffer(name: &str) -> PassName {
    PassName::buffer(name)
}

/// A project of three buffers on disk.
fn on_disk() -> (tempfile::TempDir, Project) {
    let dir = tempfile::tempdir().unwrap();
    for (name, text) in [("eddy.toml", MANIFEST), ("image.glsl", "// image\n")] {
        fs::write(dir.path().join(name), text).unwrap();
    }
    for name in ["a", "b", "c"] {
        fs::write(dir.path().join(format!("buffer_{name}.glsl")), format!("// text of {name}\n")).unwrap();
    }
    let project = project::load(dir.path().to_str().unwrap()).unwrap().project;
    (dir, project)
}

fn order(project: &Project) -> Vec<&str> {
    project.passes.iter().map(|p| p.id.key()).collect()
}

/// Saves and reopens the project, and asserts that it is unchanged.
fn saved(project: &Project, folder: &Path) -> Project {
    let saved = project::save(project, folder, Overwrite::Refuse).unwrap();
    let read = project::load(folder.to_str().unwrap()).unwrap();
    assert_eq!(read.warnings, []);
    assert_eq!(read.project, saved);
    saved
}

#[test]
fn renaming_a_pass_updates_its_readers_and_its_file() {
    let (dir, mut project) = on_disk();
    let before = project.clone();
    let done = project.edit_passes(&PassEdit::Rename { pass: buffer("A"), name: " Velocity Field ".into() }).unwrap();
    let to = buffer("velocityfield");
    assert_eq!(done, PassEdited { is_changed: true, renamed: Some((buffer("A"), to.clone())) });
    let reads = |id: &PassName, n: usize| project.pass(id).unwrap().bindings.get(n).cloned().unwrap().input;
    assert_eq!(reads(&to, 0), Input::buffer("velocityfield"));
    assert_eq!(reads(&buffer("B"), 0), Input::buffer("velocityfield"));
    assert_eq!(reads(&PassName::image(), 0), Input::buffer("velocityfield"));
    assert_eq!(reads(&PassName::image(), 1), Input::buffer("C"));
    assert_eq!(project.groups[0].passes, [to.clone(), buffer("B")]);

    let after = saved(&project, dir.path());
    assert_eq!(after.pass(&to).unwrap().source.name, "buffer_velocityfield.glsl");
    assert_eq!(&*after.pass(&to).unwrap().source.text, "// text of a\n");
    let text = fs::read_to_string(dir.path().join("eddy.toml")).unwrap();
    for comment in ["# The author's words.", "# What moves.", "# Slow is fine here.", "# itself", "# twenty of them"] {
        assert!(text.contains(comment), "{comment} is lost:\n{text}");
    }
    assert!(text.find("velocityfield").unwrap() < text.find("buffer_b]").unwrap(), "it kept its place:\n{text}");

    // The old file is removed once the new one exists, and only if nothing else has written to it.
    let old = dir.path().join("buffer_a.glsl");
    fs::write(&old, "// somebody else's\n").unwrap();
    assert_eq!(project::remove_renamed(&before, &project, &after), Vec::<PathBuf>::new());
    assert!(old.exists());
    fs::write(&old, "// text of a\n").unwrap();
    assert_eq!(project::remove_renamed(&before, &project, &after), std::slice::from_ref(&old));
    assert!(!old.exists());
    assert_eq!(project::load(dir.path().to_str().unwrap()).unwrap().project, after);
}

#[test]
fn a_file_not_named_after_its_pass_keeps_its_name_and_comments() {
    let (dir, _) = on_disk();
    fs::rename(dir.path().join("buffer_a.glsl"), dir.path().join("waves.glsl")).unwrap();
    let manifest = MANIFEST.replace("# Slow is fine here.", "file = \"waves.glsl\" # Slow is fine here.");
    fs::write(dir.path().join("eddy.toml"), manifest).unwrap();
    let mut project = project::load(dir.path().to_str().unwrap()).unwrap().project;
    let before = project.clone();
    project.edit_passes(&PassEdit::Rename { pass: buffer("A"), name: "glow".into() }).unwrap();
    let after = saved(&project, dir.path());
    assert_eq!(after.pass(&buffer("glow")).unwrap().source.name, "waves.glsl");
    assert!(fs::read_to_string(dir.path().join("eddy.toml")).unwrap().contains("# Slow is fine here."));
    assert!(project::remove_renamed(&before, &project, &after).is_empty());
    assert!(dir.path().join("waves.glsl").exists());
}

#[test]
fn renaming_never_overwrites_a_foreign_file() {
    let (dir, mut project) = on_disk();
    fs::write(dir.path().join("buffer_glow.glsl"), "// not a pass of this project\n").unwrap();
    project.edit_passes(&PassEdit::Rename { pass: buffer("A"), name: "glow".into() }).unwrap();
    let refused = project::save(&project, dir.path(), Overwrite::Refuse);
    assert!(matches!(refused, Err(project::ProjectError::WouldOverwrite { .. })), "{refused:?}");
    assert_eq!(fs::read_to_string(dir.path().join("buffer_glow.glsl")).unwrap(), "// not a pass of this project\n");
    assert_eq!(fs::read_to_string(dir.path().join("eddy.toml")).unwrap(), MANIFEST);
}

#[test]
fn invalid_names_are_rejected_with_the_reason() {
    let (_dir, mut project) = on_disk();
    let before = project.clone();
    let mut rename = |pass: PassName, name: &str| {
        project.edit_passes(&PassEdit::Rename { pass, name: name.into() }).unwrap_err().to_string()
    };
    assert!(rename(buffer("A"), "b").contains("there is a Buffer B already"));
    assert!(rename(buffer("A"), "a/b").contains("letters, digits"));
    assert!(rename(buffer("A"), "  ").contains("letters, digits"));
    assert!(rename(PassName::image(), "x").contains("only buffers"));
    assert!(rename(buffer("nowhere"), "x").contains("there is no Buffer nowhere"));
    assert_eq!(project, before);
    let same = project.edit_passes(&PassEdit::Rename { pass: buffer("A"), name: "Buffer A".into() }).unwrap();
    assert_eq!(same, PassEdited::default());
}

#[test]
fn moving_buffers_keeps_groups_consecutive() {
    let (dir, mut project) = on_disk();
    let mut go = |pass: &str, to: usize| project.edit_passes(&PassEdit::Move { pass: buffer(pass), to }).unwrap();
    // Moving C between A and B, which are one group, adds it to the group.
    go("C", 1);
    assert_eq!(order(&project), ["buffer_a", "buffer_c", "buffer_b", "image"]);
    assert_eq!(project.groups[0].passes, [buffer("A"), buffer("C"), buffer("B")]);
    saved(&project, dir.path());
    // B moves to the front and stays in its group, as they are still consecutive; A leaves its group.
    let mut go = |pass: &str, to: usize| project.edit_passes(&PassEdit::Move { pass: buffer(pass), to }).unwrap();
    go("B", 0);
    assert_eq!(order(&project), ["buffer_b", "buffer_a", "buffer_c", "image"]);
    assert_eq!(project.groups[0].passes, [buffer("B"), buffer("A"), buffer("C")]);
    let again = saved(&project, dir.path());
    assert_eq!(order(&again), ["buffer_b", "buffer_a", "buffer_c", "image"]);
    assert!(project.edit_passes(&PassEdit::Move { pass: PassName::image(), to: 0 }).is_err());
    let far = project.edit_passes(&PassEdit::Move { pass: buffer("B"), to: 99 }).unwrap();
    assert!(far.is_changed);
    assert_eq!(order(&project), ["buffer_a", "buffer_c", "buffer_b", "image"]);
}

#[test]
fn groups_are_created_joined_split_and_removed() {
    let (dir, mut project) = on_disk();
    let group = |name: &str, passes: &[&str], steps: u32| Group {
        name: name.into(),
        passes: passes.iter().map(|p| buffer(p)).collect(),
        steps,
    };
    let mut edit = |edit: PassEdit| project.edit_passes(&edit).unwrap();
    edit(PassEdit::Steps(buffer("C"), 3));
    edit(PassEdit::Steps(buffer("A"), 5));
    assert_eq!(project.groups, [group("solver", &["A", "B"], 5), group("c", &["C"], 3)]);
    saved(&project, dir.path());
    let mut edit = |edit: PassEdit| project.edit_passes(&edit).unwrap();
    edit(PassEdit::WithPrevious(buffer("C"), true));
    assert_eq!(project.groups, [group("solver", &["A", "B", "C"], 5)]);
    let mut edit = |edit: PassEdit| project.edit_passes(&edit).unwrap();
    edit(PassEdit::WithPrevious(buffer("B"), false));
    assert_eq!(project.groups, [group("solver", &["A"], 5), group("b", &["B", "C"], 5)]);
    saved(&project, dir.path());
    let mut edit = |edit: PassEdit| project.edit_passes(&edit).unwrap();
    edit(PassEdit::Steps(buffer("A"), 1));
    edit(PassEdit::Remove(Tab::Pass(buffer("B"))));
    // Its readers would cause warnings.
    edit(PassEdit::Remove(Tab::Pass(buffer("A"))));
    project.pass_mut(&buffer("C")).unwrap().bindings = Default::default();
    project.image_mut().unwrap().bindings.set(0, None);
    assert_eq!(project.groups, [group("b", &["C"], 5)]);
    saved(&project, dir.path());
    assert_eq!(project.edit_passes(&PassEdit::Steps(buffer("C"), 0)), Err(PassEditError::NoSteps));
    let many = project.edit_passes(&PassEdit::Steps(buffer("C"), 1_000_000)).unwrap_err();
    assert!(matches!(many, PassEditError::TooManyDraws(_)), "{many}");
    let first = project.edit_passes(&PassEdit::WithPrevious(buffer("C"), true));
    assert_eq!(first, Err(PassEditError::First("Buffer C".into())));
}

#[test]
fn how_a_pass_is_drawn_and_read_is_saved() {
    let (dir, mut project) = on_disk();
    let region = Region { x: 0, y: 1, width: 64, height: 2 };
    for edit in [
        PassEdit::Size(buffer("A"), PassSize::Scale(0.5)),
        PassEdit::Size(buffer("B"), PassSize::Fixed(64, 32)),
        PassEdit::Format(buffer("A"), TexelFormat::Rg16f),
        PassEdit::Region(buffer("A"), Some(region)),
        PassEdit::Region(PassName::image(), Some(region)),
        PassEdit::Filter(buffer("A"), Filter::Mipmap),
        PassEdit::Wrap(buffer("A"), Wrap::Repeat),
    ] {
        assert!(project.edit_passes(&edit).unwrap().is_changed, "{edit:?}");
    }
    let after = saved(&project, dir.path());
    let a = after.pass(&buffer("A")).unwrap();
    assert_eq!((a.settings.size, a.settings.format), (PassSize::Scale(0.5), TexelFormat::Rg16f));
    let read = Some(Channel {
        input: Input::buffer("A"),
        sampler: Sampler { filter: Filter::Mipmap, wrap: Wrap::Repeat, vflip: true },
    });
    assert_eq!(a.bindings.get(0), read.as_ref());
    assert_eq!(after.image().unwrap().bindings.get(0), read.as_ref());
    let of_c = after.image().unwrap().bindings.get(1).unwrap().sampler;
    assert_eq!(of_c, Sampler::BUFFER, "another buffer's channels stay");
    let refused = [
        PassEdit::Size(buffer("A"), PassSize::Scale(f64::NAN)),
        PassEdit::Size(buffer("A"), PassSize::Fixed(0, 3)),
        PassEdit::Size(PassName::image(), PassSize::Scale(0.5)),
        PassEdit::Format(PassName::image(), TexelFormat::R8),
        PassEdit::Region(buffer("A"), Some(Region { width: 0, ..region })),
        PassEdit::Filter(PassName::image(), Filter::Linear),
        PassEdit::Remove(Tab::image()),
        PassEdit::Remove(Tab::Common),
    ];
    for edit in refused {
        let before = project.clone();
        assert!(project.edit_passes(&edit).is_err(), "{edit:?}");
        assert_eq!(project, before);
    }
}

#[test]
fn initial_contents_and_edges_are_saved() {
    let (dir, mut project) = on_disk();
    let expression = |text: &str| FillValue::Expression(text.into());
    fs::write(dir.path().join("state.npy"), b"not read here").unwrap();
    for edit in [
        PassEdit::Initial(buffer("A"), Some(expression("vec4(0.5)"))),
        PassEdit::Initial(buffer("B"), Some(FillValue::File("state.npy".into()))),
        PassEdit::Boundary(buffer("A"), Some((2, expression("vec4(fragCoord, 0.0, 1.0)")))),
        PassEdit::Boundary(PassName::image(), Some((1, expression("vec4(0.0)")))),
    ] {
        assert!(project.edit_passes(&edit).unwrap().is_changed, "{edit:?}");
    }
    saved(&project, dir.path());
    let mut project = project::load(dir.path().to_str().unwrap()).unwrap().project;
    let settings = |project: &Project, id: &PassName| project.pass(id).unwrap().settings.clone();
    let a = settings(&project, &buffer("A"));
    assert_eq!(a.initial.as_ref().unwrap().value, expression("vec4(0.5)"));
    let boundary = a.boundary.unwrap();
    assert_eq!((boundary.width, boundary.value.value), (2, expression("vec4(fragCoord, 0.0, 1.0)")));
    let written = |project: &Project| settings(project, &buffer("A")).boundary.unwrap().value.written.is_some();
    assert!(written(&project), "a mistake in it is shown where it stands");
    // Changing the width keeps the value's place.
    let edit = PassEdit::Boundary(buffer("A"), Some((3, expression("vec4(fragCoord, 0.0, 1.0)"))));
    project.edit_passes(&edit).unwrap();
    assert!(written(&project) && settings(&project, &buffer("A")).boundary.unwrap().width == 3);
    for edit in [
        PassEdit::Initial(buffer("A"), None),
        PassEdit::Initial(buffer("B"), None),
        PassEdit::Boundary(buffer("A"), None),
        PassEdit::Boundary(PassName::image(), None),
    ] {
        assert!(project.edit_passes(&edit).unwrap().is_changed, "{edit:?}");
    }
    let after = saved(&project, dir.path());
    assert_eq!(settings(&after, &buffer("A")), settings(&on_disk().1, &buffer("A")));
    for edit in [
        PassEdit::Initial(buffer("A"), Some(expression("  "))),
        PassEdit::Initial(buffer("A"), Some(FillValue::File("../state.npy".into()))),
        PassEdit::Initial(PassName::image(), Some(expression("vec4(0.0)"))),
        PassEdit::Boundary(buffer("A"), Some((0, expression("vec4(0.0)")))),
    ] {
        assert!(project.edit_passes(&edit).is_err(), "{edit:?}");
    }
    // Dragging the width is one undo step.
    let dragged = |width| PassEdit::Boundary(buffer("A"), Some((width, expression("vec4(0.0)"))));
    assert!(dragged(1).is_same_kind(&dragged(2)));
}
