//! The output of `scripts/package` and the files of `packaging/` agree with Cargo.toml, with each other and with the
//! files that Eddy opens. `scripts/test-deb` installs a package; it needs a network and root.

use crate::support::{
    program::{Bench, run},
    programs::{failure, has},
};
use std::{
    collections::BTreeSet,
    fs,
    path::{Path, PathBuf},
    process::Command,
};

const ID: &str = "io.github.eddy_shaders.Eddy";
const VERSION: &str = env!("CARGO_PKG_VERSION");

fn root() -> &'static Path {
    Path::new(env!("CARGO_MANIFEST_DIR"))
}

fn text(name: &str) -> String {
    fs::read_to_string(root().join(name)).unwrap_or_else(|e| panic!("{name}: {e}"))
}

/// Returns every text between two markers.
fn all_between<'a>(text: &'a str, from: &str, to: &str) -> Vec<&'a str> {
    text.split(from).skip(1).filter_map(|rest| rest.split_once(to)).map(|(found, _)| found).collect()
}

fn set<'a>(items: impl IntoIterator<Item = &'a str>) -> BTreeSet<&'a str> {
    items.into_iter().collect()
}

fn desktop(key: &str) -> String {
    let file = text(&format!("packaging/linux/{ID}.desktop"));
    let value = file.lines().find_map(|line| line.strip_prefix(key)?.strip_prefix('='));
    value.unwrap_or_else(|| panic!("no {key}")).to_owned()
}

#[test]
fn packages_have_the_version_of_the_manifest() {
    let changelog = text("packaging/debian/changelog");
    assert!(changelog.starts_with(&format!("eddy ({VERSION}-1) ")), "{}", changelog.lines().next().unwrap());
    let metainfo = text(&format!("packaging/linux/{ID}.metainfo.xml"));
    let newest = all_between(&metainfo, "<release version=\"", "\"");
    assert_eq!(newest[0], VERSION);
    assert!(text("packaging/arch/PKGBUILD").contains(&format!("\npkgver={VERSION}\n")));
}

#[test]
fn all_files_have_one_id() {
    assert_eq!((desktop("Icon").as_str(), desktop("StartupWMClass").as_str()), (ID, ID));
    let metainfo = text(&format!("packaging/linux/{ID}.metainfo.xml"));
    assert_eq!(all_between(&metainfo, "<id>", "</id>"), [ID]);
    assert_eq!(all_between(&metainfo, "<launchable type=\"desktop-id\">", "</launchable>"), [format!("{ID}.desktop")]);
    assert!(text("scripts/package").contains(&format!("\nid={ID}\n")));
    assert!(text("scripts/test-deb").contains(&format!("\"{ID}\"")));
    assert!(text(&format!("packaging/flatpak/{ID}.yml")).contains(&format!("\nid: {ID}\n")));
    // Apple allows no `_`.
    assert!(text("packaging/macos/Info.plist").contains(&format!("<string>{}</string>", ID.replace('_', "-"))));
}

#[test]
fn file_types_are_the_same_everywhere() {
    let mime = text(&format!("packaging/linux/{ID}.xml"));
    let described = set(all_between(&mime, "<mime-type type=\"", "\""));
    assert_eq!(described.len(), 3, "{described:?}");
    let types = desktop("MimeType");
    let mut opened = set(types.split_terminator(';'));
    assert!(opened.remove("inode/directory"));
    assert_eq!(opened, described);
    let metainfo = text(&format!("packaging/linux/{ID}.metainfo.xml"));
    assert_eq!(set(all_between(&metainfo, "<mediatype>", "</mediatype>")), described);
}

#[test]
fn files_of_all_registered_types_open() {
    let b = Bench::new();
    let shader = "void mainImage(out vec4 c, in vec2 p) { c = vec4(1.0); }";
    b.write("project/image.glsl", shader);
    let json = serde_json::json!({ "Shader": { "ver": "0.1", "info": {}, "renderpass": [
        { "name": "Image", "type": "image", "code": shader, "inputs": [], "outputs": [{ "id": 37, "channel": 0 }] },
    ] } });
    let mime = text(&format!("packaging/linux/{ID}.xml"));
    let globs = all_between(&mime, "<glob pattern=\"", "\"");
    assert!(globs.len() == 4 && globs.contains(&"*.glsl"), "{globs:?}");
    for glob in globs {
        let (name, content) = match glob.strip_prefix('*') {
            Some(ending) if ending.ends_with(".json") => (format!("toy{ending}"), json.to_string()),
            Some(ending) => (format!("toy{ending}"), shader.into()),
            None => (format!("project/{glob}"), "name = \"Toy\"\n[passes.image]\n".into()),
        };
        b.write(&name, content);
        b.line(&format!("check {name}")).expect(0);
    }
    b.line("check project").expect(0);
}

/// Returns Cargo.toml's `[package.metadata.deb]`.
fn deb() -> toml::Table {
    let manifest: toml::Table = text("Cargo.toml").parse().unwrap();
    manifest["package"]["metadata"]["deb"].as_table().unwrap().clone()
}

fn strings(value: &toml::Value) -> Vec<String> {
    value.as_array().unwrap().iter().map(|item| item.as_str().unwrap().to_owned()).collect()
}

#[test]
fn debian_depends_on_the_libraries_opened_at_run_time() {
    let setup = text("scripts/setup");
    let opened: Vec<&str> = setup
        .lines()
        .filter_map(|line| line.trim().strip_prefix("want_library "))
        .map(|rest| rest.split_whitespace().nth(1).unwrap())
        .collect();
    assert!(opened.len() >= 9, "{opened:?}");
    let deb = deb();
    let depends = strings(&deb["depends"]);
    assert_eq!(depends[0], "$auto");
    for library in opened {
        assert!(depends.iter().any(|d| d == library), "{library} is in scripts/setup and not in Cargo.toml");
    }
    assert!(strings(&deb["recommends"]).iter().any(|r| r.starts_with("mesa-vulkan-drivers")));
    assert!(root().join(deb["changelog"].as_str().unwrap()).is_file());
}

/// Returns the files in a folder and its subfolders, as paths relative to it.
fn files_in(folder: &Path) -> BTreeSet<String> {
    let mut found = BTreeSet::new();
    let mut open = vec![folder.to_owned()];
    while let Some(next) = open.pop() {
        for entry in fs::read_dir(&next).unwrap() {
            let path: PathBuf = entry.unwrap().path();
            if path.is_dir() {
                open.push(path);
            } else {
                found.insert(path.strip_prefix(folder).unwrap().to_str().unwrap().to_owned());
            }
        }
    }
    found
}

#[cfg(target_os = "linux")]
#[test]
fn a_package_has_man_pages_completions_icons_and_metadata() {
    let b = Bench::new();
    let mut script = Command::new("sh");
    script.arg(root().join("scripts/package")).args(["share", "--binary", env!("CARGO_BIN_EXE_eddy"), "--out"]);
    run(script.arg(b.path("."))).expect(0);
    let files = files_in(&b.path("share"));
    let has_file = |name: &str| assert!(files.contains(name), "no {name} in {files:#?}");
    for (shell, name) in [
        ("bash", "bash-completion/completions/eddy"),
        ("zsh", "zsh/site-functions/_eddy"),
        ("fish", "fish/vendor_completions.d/eddy.fish"),
        ("powershell", "eddy/completions.ps1"),
    ] {
        let completions = b.bytes(&format!("share/{name}"));
        assert!(String::from_utf8(completions).unwrap().contains("translate"), "{shell}");
    }
    let help = b.line("help").expect(0).out;
    let commands =
        all_between(&help, "Commands:\n", "\n\n")[0].lines().map(|line| line.split_whitespace().next().unwrap());
    let commands: Vec<&str> = commands.filter(|command| *command != "help").collect();
    assert!(commands.len() > 10, "{help}");
    for command in commands {
        has_file(&format!("man/man1/eddy-{command}.1.gz"));
    }
    has_file("man/man1/eddy.1.gz");
    for size in [16, 24, 32, 48, 64, 128, 256, 512] {
        let icon = b.png(&format!("share/icons/hicolor/{size}x{size}/apps/{ID}.png"));
        assert_eq!(icon.dimensions(), (size, size));
        // The corners are transparent, as the icon is a rounded square with the shader's two colours.
        assert_eq!((icon.get_pixel(0, 0)[3], icon.get_pixel(size / 2, size / 4)[3]), (0, 255), "{size}");
    }
    for (name, check) in [
        (format!("applications/{ID}.desktop"), &["desktop-file-validate"][..]),
        (format!("metainfo/{ID}.metainfo.xml"), &["appstreamcli", "validate", "--no-net", "--strict"]),
        (format!("mime/packages/{ID}.xml"), &["xmllint", "--noout"]),
    ] {
        has_file(&name);
        if has(check[0]) {
            let errors = failure(Command::new(check[0]).args(&check[1..]).arg(b.path(format!("share/{name}"))));
            assert_eq!(errors, None, "{name}");
        }
    }
}

/// Returns the words after `scripts/package` in a text.
fn formats_in(text: &str) -> BTreeSet<&str> {
    let words = text.split("scripts/package ").skip(1).filter_map(|rest| rest.split_whitespace().next());
    words.map(|word| word.trim_matches(['`', ',', '.'])).filter(|word| word.chars().all(char::is_alphabetic)).collect()
}

#[test]
fn docs_and_workflows_name_existing_formats() {
    let script = text("scripts/package");
    let listed = script.lines().skip_while(|line| !line.starts_with("# Makes packages")).skip(1);
    let listed = listed.map_while(|line| line.strip_prefix("#   ")?.split_whitespace().next());
    let listed: BTreeSet<&str> = listed.collect();
    assert_eq!(listed.len(), 10, "{listed:?}");
    let names = [
        "docs/packages.md",
        ".github/workflows/release.yml",
        "packaging/arch/PKGBUILD",
        "packaging/flatpak/io.github.eddy_shaders.Eddy.yml",
    ];
    for name in names {
        let text = text(name);
        let named = formats_in(&text);
        assert!(!named.is_empty(), "{name}");
        let unknown: Vec<_> = named.difference(&listed).collect();
        assert!(unknown.is_empty(), "{name} names {unknown:?}, and scripts/package has {listed:?}");
    }
    let refused = run(Command::new("sh").arg(root().join("scripts/package")).arg("rpm"));
    assert_eq!(refused.code, Some(2));
    for format in listed {
        assert!(refused.err.contains(&format!("  {format} ")), "{}", refused.err);
    }
}
