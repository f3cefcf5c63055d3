//! Tests of saving: written projects read back unchanged, and no other file is touched.

use super::*;
use crate::{
    Boundary, Channel, Condition, Fill, Filter, Info, Input, InputKind, Pass, PassName, PassSettings, PassSize, Region,
    SLOTS, Sampler, TexelFormat, Wrap, load,
};
use std::{
    fs,
    path::{Path, PathBuf},
};

/// A small random number generator with a seed, so that failing cases can be reproduced.
struct Random(u64);

impl Random {
    fn below(&mut self, n: usize) -> usize {
        self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        ((self.0 >> 33) as usize) % n
    }

    fn of<'a, T: ?Sized>(&mut self, items: &[&'a T]) -> &'a T {
        items[self.below(items.len())]
    }

    fn text(&mut self) -> String {
        let parts = [
            "a",
            "\"",
            "'''",
            "\n",
            "\r\n",
            "\t",
            "\\",
            "é",
            "#",
            " = ",
            "\u{1f600}",
            "[x]",
            "\"\"\"",
            " ",
            "\u{7f}",
            "\0",
        ];
        (0..self.below(9)).map(|_| self.of(&parts)).collect()
    }
}

/// Random valid settings of a pass.
fn any_settings(r: &mut Random, id: &PassName) -> PassSettings {
    let mut settings = PassSettings::default();
    if id.is_buffer() {
        settings.size = match r.below(3) {
            0 => PassSize::Canvas,
            1 => PassSize::Scale(0.25 + r.below(3) as f64),
            _ => PassSize::Fixed(1 + r.below(99) as u32, 7),
        };
        settings.format = TexelFormat::ALL[r.below(TexelFormat::ALL.len())];
    }
    if (id.is_buffer() || id.is_image()) && r.below(2) == 0 {
        settings.region = Some(Region { x: r.below(9) as u32, y: 0, width: 1, height: 5 });
    }
    if (id.is_buffer() || *id == PassName::cube()) && r.below(3) == 0 {
        let text = r.of(&["on", "kind == 3 && !off", " a<1||b>=.5 ", "-(width) != -64"]);
        settings.when = Some(Condition::parse(text).unwrap());
    }
    if id.is_buffer() && r.below(3) == 0 {
        settings.initial = Some(any_fill(r));
    }
    if (id.is_buffer() || id.is_image()) && r.below(3) == 0 {
        settings.boundary = Some(Boundary { width: 1 + r.below(3) as u32, value: any_fill(r) });
    }
    settings
}

fn any_fill(r: &mut Random) -> Fill {
    if r.below(2) == 0 {
        Fill::expression(format!("vec4({})", r.text()))
    } else {
        Fill::file(format!("d/{}x.npy", r.text().replace('\0', "")))
    }
}

fn any_project(seed: u64) -> Project {
    let r = &mut Random(seed);
    let mut ids: BTreeSet<PassName> = BTreeSet::new();
    for _ in 0..r.below(6) {
        let name = r.of(&["A", "B", "C", "D", "E", "blur", "x1", "image", "sound", "common", "buffer", "cubea", "7"]);
        ids.insert(PassName::buffer(name));
    }
    let mut ids: Vec<PassName> = ids.into_iter().collect();
    for i in (1..ids.len()).rev() {
        ids.swap(i, r.below(i + 1));
    }
    ids.extend((r.below(3) == 0).then_some(PassName::cube()));
    ids.push(PassName::image());
    ids.extend((r.below(3) == 0).then_some(PassName::sound()));
    let source = |r: &mut Random, name: String| Source { name, path: None, text: r.text().into() };
    let passes = ids
        .into_iter()
        .map(|id| {
            let bound: Vec<usize> = (0..SLOTS).filter(|_| r.below(2) == 0).collect();
            Pass {
                source: source(r, id.title()),
                bindings: bound.into_iter().map(|slot| (slot, any_channel(r))).collect(),
                settings: any_settings(r, &id),
                body: Default::default(),
                id,
            }
        })
        .collect();
    let extra = serde_json::json!({ "likes": 3, "parent": null, "text": r.text(), "deep": { "a": [1.5, true] } });
    Project {
        name: format!("n{}", r.text()),
        info: Info {
            id: r.text(),
            author: r.text(),
            description: r.text(),
            tags: (0..r.below(3)).map(|_| r.text()).collect(),
            period: None,
            extra: if r.below(2) == 0 { extra.as_object().unwrap().clone() } else { serde_json::Map::default() },
        },
        common: (r.below(2) == 0).then(|| source(r, "Common".into())),
        passes,
        sampler_rules: if r.below(2) == 0 { SamplerRules::Site } else { SamplerRules::PerChannel },
        dialect: Default::default(),
        custom_uniform_values: Default::default(),
        controls: Default::default(),
        groups: Vec::new(),
        includes: Vec::new(),
        origin: Origin::Unsaved,
    }
}

fn any_channel(r: &mut Random) -> Channel {
    let media = match r.below(3) {
        0 => Media::Builtin(r.text()),
        1 => Media::File(format!("d/{}x.png", r.text().replace('\0', "")).into()),
        _ => Media::Site { id: r.text(), path: r.text() },
    };
    let input = match r.below(10) {
        0 | 1 => Input::buffer(r.of(&["A", "B", "blur", "image", "sound", "cubea"])),
        2 => Input::pass(PassName::cube()),
        3 => Input::KEYBOARD,
        4 => Input::Device(InputKind::Microphone),
        5 => Input::Device(InputKind::Webcam),
        6 => Input::texture(media),
        7 => Input::Media { kind: InputKind::Cubemap, media },
        8 => Input::Media { kind: InputKind::Volume, media },
        _ => [
            Input::Media { kind: InputKind::Video, media: media.clone() },
            Input::Media { kind: InputKind::Music, media },
        ][r.below(2)]
        .clone(),
    };
    let filter = [Filter::Nearest, Filter::Linear, Filter::Mipmap][r.below(3)];
    let wrap = [Wrap::Clamp, Wrap::Repeat][r.below(2)];
    Channel { input, sampler: Sampler { filter, wrap, vflip: r.below(2) == 0 } }
}

fn reloaded(path: &Path) -> Project {
    load(path.to_str().unwrap()).unwrap_or_else(|e| panic!("{e}")).project
}

/// A project of one Image pass and Buffer A, saved as a folder.
fn saved_folder(at: &Path) -> Project {
    let dir = tempfile::tempdir().unwrap();
    fs::write(dir.path().join("image.glsl"), "image").unwrap();
    fs::write(dir.path().join("buffer_a.glsl"), "a").unwrap();
    save(&reloaded(dir.path()), at, Overwrite::Refuse).unwrap()
}

#[test]
fn folders_round_trip() {
    let dir = tempfile::tempdir().unwrap();
    for seed in 0..20 {
        let project = any_project(seed);
        let target = dir.path().join(seed.to_string());
        let saved = save(&project, &target, Overwrite::Refuse).unwrap_or_else(|e| panic!("seed {seed}: {e}"));
        assert_eq!(reloaded(&target), saved, "seed {seed}");
        let mut back = saved.clone();
        back.origin = Origin::Unsaved;
        let sources = |p: &mut Project| {
            p.common.iter_mut().chain(p.passes.iter_mut().map(|p| &mut p.source)).for_each(|s| {
                s.name.clear();
                s.path = None;
            });
        };
        let mut original = project.clone();
        sources(&mut back);
        sources(&mut original);
        assert_eq!(back, original, "seed {seed}: nothing but places changed");
        // Another project over the first one's files: the old eddy.toml's content does not stay in the new one.
        let mut next = any_project(seed + 10_000);
        next.origin = saved.origin.clone();
        for pass in &mut next.passes {
            if let Some(old) = saved.pass(&pass.id) {
                (pass.source.name, pass.source.path) = (old.source.name.clone(), old.source.path.clone());
            }
        }
        let saved = save(&next, &target, Overwrite::Allow).unwrap_or_else(|e| panic!("seed {seed}: {e}"));
        assert_eq!(reloaded(&target), saved, "seed {seed}");
    }
}

#[test]
fn eddy_toml_round_trips() {
    for seed in 1_000..3_000 {
        let mut project = any_project(seed);
        project.info.period = (seed % 2 == 0).then_some(seed as f64 / 7.0);
        let mut writes = Writes::into(Path::new(""), BTreeSet::new());
        if let Some(common) = &mut project.common {
            place(common, "common.glsl".into(), false, Path::new(""), &mut writes).unwrap();
        }
        for pass in &mut project.passes {
            place(&mut pass.source, format!("{}.glsl", pass.id.key()), false, Path::new(""), &mut writes).unwrap();
        }
        let texts: BTreeMap<_, _> = writes.texts().map(|(name, bytes)| (name.clone(), bytes.clone())).collect();
        let text = manifest::write(&project, None, "folder", false);
        let read = manifest::project("", "folder".into(), &text, &Files::in_memory(&texts), Origin::Unsaved);
        let read = read.unwrap_or_else(|e| panic!("seed {seed}: {e}\n{text}")).project;
        assert!(is_equal_but_for_places(&read, &project), "seed {seed}: {read:#?}\n{text}");
        assert_eq!(manifest::write(&read, Some(&text), "folder", false), text, "seed {seed}: written again, the same");
    }
}

#[test]
fn saving_keeps_comments_order_and_spelling() {
    let dir = tempfile::tempdir().unwrap();
    let toml = "# my shader\nname = 'Ink' # a name\ntags = [ \"a\",\n  \"b\" ]\nperiod = 8 # a loop\n\n[passes.image] # last\n\
    channels = { 0 = { buffer = 'a', filter=\"linear\" } }\n\n# the flow\n[passes.Buffer_A]\nfile = \"flow.glsl\"\n\
    channels.1 = { keyboard = true } # keys\n";
    fs::write(dir.path().join("eddy.toml"), toml).unwrap();
    fs::write(dir.path().join("flow.glsl"), "f").unwrap();
    fs::write(dir.path().join("image.glsl"), "i").unwrap();
    let mut project = reloaded(dir.path());
    let text = || fs::read_to_string(dir.path().join("eddy.toml")).unwrap();
    project = save(&project, dir.path(), Overwrite::Refuse).unwrap();
    assert_eq!(text(), toml, "nothing changed, so nothing is written");
    project.name = "Inks".into();
    project.passes[0].bindings.get_mut(1).unwrap().sampler.filter = Filter::Linear;
    project.passes[0].source.text = "g".into();
    save(&project, dir.path(), Overwrite::Refuse).unwrap();
    let expected = toml
        .replace("'Ink' # a name", "\"Inks\" # a name")
        .replace("{ keyboard = true } # keys", "{ keyboard = true, filter = \"linear\" } # keys");
    assert_eq!(text(), expected);
    assert_eq!(fs::read_to_string(dir.path().join("flow.glsl")).unwrap(), "g");
}

#[test]
fn reordered_buffers_keep_their_comments() {
    let dir = tempfile::tempdir().unwrap();
    let toml = "eddy = 1\nname = \"x\"\n\n# first\n[passes.buffer_a]\nfile = \"image.glsl\"\n\n\
    # second\n[passes.buffer_b]\nfile = \"image.glsl\"\n\n[passes.image]\n";
    fs::write(dir.path().join("eddy.toml"), toml).unwrap();
    fs::write(dir.path().join("image.glsl"), "i").unwrap();
    let mut project = reloaded(dir.path());
    project.passes.swap(0, 1);
    save(&project, dir.path(), Overwrite::Refuse).unwrap();
    let text = fs::read_to_string(dir.path().join("eddy.toml")).unwrap();
    assert!(text.find("# second\n[passes.buffer_b]") < text.find("# first\n[passes.buffer_a]"), "{text}");
    assert_eq!(reloaded(dir.path()).passes, project.passes);
}

#[test]
fn eddy_toml_is_added_only_if_the_texts_do_not_suffice() {
    let dir = tempfile::tempdir().unwrap();
    fs::write(dir.path().join("image.glsl"), "i").unwrap();
    fs::write(dir.path().join("buffer_a.glsl"), "a").unwrap();
    let mut project = reloaded(dir.path());
    project.passes[1].source.text = "j".into();
    project = save(&project, dir.path(), Overwrite::Refuse).unwrap();
    assert!(!dir.path().join("eddy.toml").exists());
    assert_eq!(reloaded(dir.path()), project);
    project.passes[1].bindings.set(0, None);
    project = save(&project, dir.path(), Overwrite::Refuse).unwrap();
    assert!(dir.path().join("eddy.toml").exists());
    assert_eq!(reloaded(dir.path()), project);
}

#[test]
fn a_removed_pass_stays_removed_and_its_file_stays() {
    let dir = tempfile::tempdir().unwrap();
    fs::write(dir.path().join("image.glsl"), "i").unwrap();
    fs::write(dir.path().join("buffer_a.glsl"), "a").unwrap();
    fs::write(dir.path().join("common.glsl"), "c").unwrap();
    let mut project = reloaded(dir.path());
    project.passes.remove(0);
    project.common = None;
    project.passes[0].bindings = Default::default();
    let saved = save(&project, dir.path(), Overwrite::Refuse).unwrap();
    assert_eq!(reloaded(dir.path()), saved);
    assert_eq!(fs::read_to_string(dir.path().join("buffer_a.glsl")).unwrap(), "a");
}

#[test]
fn foreign_files_are_not_overwritten_without_asking() {
    let dir = tempfile::tempdir().unwrap();
    let project = saved_folder(&dir.path().join("mine"));
    let other = dir.path().join("other");
    fs::create_dir(&other).unwrap();
    fs::write(other.join("image.glsl"), "precious").unwrap();
    let error = save(&project, &other, Overwrite::Refuse).unwrap_err();
    assert!(
        matches!(&error, ProjectError::WouldOverwrite { paths } if *paths == [other.join("image.glsl")]),
        "{error}"
    );
    assert_eq!(fs::read_to_string(other.join("image.glsl")).unwrap(), "precious");
    assert_eq!(fs::read_dir(&other).unwrap().count(), 1, "nothing was written at all");
    save(&project, &other, Overwrite::Allow).unwrap();
    assert_eq!(fs::read_to_string(other.join("image.glsl")).unwrap(), "image");
    // If several are in the way, all of them are named and kept.
    fs::write(other.join("image.glsl"), "precious").unwrap();
    fs::write(other.join("eddy.toml"), "eddy = 1\nname = \"precious\"\n").unwrap();
    let error = save(&project, &other, Overwrite::Refuse).unwrap_err();
    let all = ["eddy.toml", "image.glsl"].map(|name| other.join(name));
    assert!(matches!(&error, ProjectError::WouldOverwrite { paths } if *paths == all), "{error}");
    let text = error.to_string();
    assert!(all.iter().all(|path| text.contains(path.to_str().unwrap())) && text.contains(" exist and are "), "{text}");
    let kept = dir.path().join("kept/other-0001");
    save(&project, &other, Overwrite::KeepIn(&kept)).unwrap();
    let texts = |name: &str| [&other, &kept].map(|at| fs::read_to_string(at.join(name)).unwrap());
    assert_eq!(texts("image.glsl"), ["image", "precious"]);
    assert!(!texts("eddy.toml")[0].contains("precious") && texts("eddy.toml")[1].contains("precious"));
    // A file that cannot be kept is not replaced.
    fs::write(other.join("image.glsl"), "again").unwrap();
    let blocked = dir.path().join("mine/image.glsl/below");
    let error = save(&project, &other, Overwrite::KeepIn(&blocked)).unwrap_err().to_string();
    assert!(error.starts_with("cannot keep what would be replaced in "), "{error}");
    assert_eq!(fs::read_to_string(other.join("image.glsl")).unwrap(), "again");
    save(&project, &other, Overwrite::Allow).unwrap();
    // A file that appeared in the project's own folder is foreign, too.
    let mut grown = project.clone();
    fs::write(dir.path().join("mine/buffer_b.glsl"), "precious").unwrap();
    let source = Source { name: "Buffer B".into(), path: None, text: "b".into() };
    grown.passes.insert(1, Pass::new(PassName::buffer("B"), source));
    assert!(matches!(
        save(&grown, &dir.path().join("mine"), Overwrite::Refuse),
        Err(ProjectError::WouldOverwrite { .. })
    ));
    assert_eq!(fs::read_to_string(dir.path().join("mine/buffer_b.glsl")).unwrap(), "precious");
}

#[test]
fn one_file_stores_a_lone_image_and_rejects_more() {
    let dir = tempfile::tempdir().unwrap();
    let path = dir.path().join("plasma.glsl");
    fs::write(&path, "#iChannel0 \"keyboard\"\n").unwrap();
    let mut project = reloaded(&path);
    project.passes[0].source.text = "#iChannel0 \"keyboard\"\nnew".into();
    let saved = save(&project, &path, Overwrite::Refuse).unwrap();
    assert_eq!(reloaded(&path), saved);
    project.passes[0].bindings.set(1, Some(Channel::new(Input::KEYBOARD)));
    let error = save(&project, &path, Overwrite::Refuse).unwrap_err();
    assert!(matches!(error, ProjectError::CannotHold { .. }) && error.to_string().contains("folder"), "{error}");
    let folder = save(&project, &dir.path().join("plasma"), Overwrite::Refuse).unwrap();
    assert_eq!(reloaded(&dir.path().join("plasma")), folder);
    let other = save(&saved, &dir.path().join("b.frag"), Overwrite::Refuse).unwrap();
    assert_eq!(other.name, "b");
    assert!(save(&saved, &dir.path().join("b.frag"), Overwrite::Refuse).is_ok(), "the same text harms nobody");
    assert!(matches!(save(&project, &path, Overwrite::Allow), Err(ProjectError::CannotHold { .. })));
}

#[test]
fn json_is_saved_as_a_file_and_its_project_as_a_folder() {
    let dir = tempfile::tempdir().unwrap();
    let project = saved_folder(&dir.path().join("p"));
    let json = dir.path().join("p.json");
    let from_json = save(&project, &json, Overwrite::Refuse).unwrap();
    assert_eq!(reloaded(&json), from_json);
    assert_eq!(from_json.origin, Origin::Json(json.clone()));
    fs::write(&json, "{}").unwrap();
    assert!(matches!(save(&project, &json, Overwrite::Refuse), Err(ProjectError::WouldOverwrite { .. })));
    let folder = save(&from_json, &dir.path().join("q"), Overwrite::Refuse).unwrap();
    assert_eq!(reloaded(&dir.path().join("q")), folder);
    assert_eq!(folder.sampler_rules, SamplerRules::Site);
}

#[test]
fn pictures_are_copied_into_a_new_folder() {
    let dir = tempfile::tempdir().unwrap();
    let old = dir.path().join("old");
    fs::create_dir_all(old.join("pics")).unwrap();
    fs::write(old.join("pics/a.png"), "inside").unwrap();
    fs::write(dir.path().join("b.png"), "outside").unwrap();
    fs::write(
        old.join("image.glsl"),
        "#iChannel0 \"file://pics/a.png\"\n#iChannel1 \"file://../b.png\"\n#iChannel2 \"file://gone.png\"\n",
    )
    .unwrap();
    let saved = save(&reloaded(&old), &dir.path().join("far/new"), Overwrite::Refuse).unwrap();
    assert_eq!(fs::read_to_string(dir.path().join("far/new/pics/a.png")).unwrap(), "inside");
    let media = |n: usize| match &saved.passes[0].bindings.get(n).unwrap().input {
        Input::Media { media: Media::File(path), .. } => path.clone(),
        other => panic!("{other:?}"),
    };
    assert_eq!(media(0), Path::new("pics/a.png"));
    assert_eq!(media(1), Path::new("../b.png"), "what lies outside is not read, and not carried along");
    assert_eq!(media(2), Path::new("gone.png"));
}

#[cfg(unix)]
#[test]
fn links_and_permissions_stay_and_read_only_files_are_rejected() {
    use std::os::unix::fs::{PermissionsExt, symlink};
    let dir = tempfile::tempdir().unwrap();
    let real = dir.path().join("real.glsl");
    let link = dir.path().join("link.glsl");
    fs::write(&real, "old").unwrap();
    fs::set_permissions(&real, fs::Permissions::from_mode(0o640)).unwrap();
    symlink(&real, &link).unwrap();
    let mut project = reloaded(&link);
    project.passes[0].source.text = "new".into();
    save(&project, &link, Overwrite::Refuse).unwrap();
    assert!(link.is_symlink());
    assert_eq!(fs::read_to_string(&real).unwrap(), "new");
    assert_eq!(fs::metadata(&real).unwrap().permissions().mode() & 0o777, 0o640);
    fs::set_permissions(&real, fs::Permissions::from_mode(0o440)).unwrap();
    project.passes[0].source.text = "newer".into();
    let error = save(&project, &link, Overwrite::Allow).unwrap_err().to_string();
    assert!(error.contains("write-protected") && error.contains("real.glsl"), "{error}");
    assert_eq!(fs::read_to_string(&real).unwrap(), "new");
}

#[test]
fn failure_to_create_a_folder_names_its_path() {
    let dir = tempfile::tempdir().unwrap();
    fs::write(dir.path().join("file"), "").unwrap();
    let error = save(&any_project(1), &dir.path().join("file/below"), Overwrite::Allow).unwrap_err().to_string();
    assert!(error.contains("file/below"), "{error}");
}

/// Part of the next test, run in a process with a small limit for file sizes.
#[cfg(unix)]
#[test]
#[ignore = "started by a_full_disk_loses_nothing"]
fn save_on_a_full_disk() {
    let folder = PathBuf::from(std::env::var_os("EDDY_TEST_FOLDER").expect("set by a_full_disk_loses_nothing"));
    let mut project = reloaded(&folder);
    for pass in &mut project.passes {
        pass.source.text = if pass.id.is_image() { "x".repeat(100_000).into() } else { "small and new".into() };
    }
    let error = save(&project, &folder, Overwrite::Refuse).unwrap_err();
    assert!(matches!(&error, ProjectError::Io { path, .. } if path.ends_with("image.glsl")), "{error}");
}

/// A limit for file sizes fails writes like a full disk, and needs no privileges to set up.
#[cfg(unix)]
#[test]
fn a_full_disk_loses_nothing() {
    let dir = tempfile::tempdir().unwrap();
    let folder = dir.path().join("p");
    let before = saved_folder(&folder);
    let files = |at: &Path| -> BTreeMap<PathBuf, Vec<u8>> {
        fs::read_dir(at).unwrap().map(|e| e.unwrap().path()).map(|p| (p.clone(), fs::read(p).unwrap())).collect()
    };
    let old = files(&folder);
    let run = std::process::Command::new("sh")
        .args(["-c", "trap '' XFSZ; ulimit -f 16; exec \"$0\" --exact save::tests::save_on_a_full_disk --ignored"])
        .arg(std::env::current_exe().unwrap())
        .env("EDDY_TEST_FOLDER", &folder)
        .output()
        .unwrap();
    let said = String::from_utf8_lossy(&run.stdout).into_owned();
    assert!(run.status.success() && said.contains("1 passed"), "{said}");
    assert_eq!(files(&folder), old, "every old file is there, and nothing beside them");
    assert_eq!(reloaded(&folder), before);
}
