//! Markdown pages: links have targets, and repeated content is the same.

use std::{
    fs,
    path::{Path, PathBuf},
};

fn root() -> &'static Path {
    Path::new(env!("CARGO_MANIFEST_DIR"))
}

/// Returns the pages in a folder, by their paths.
fn pages_in(folder: &Path, into: &mut Vec<PathBuf>) {
    for entry in fs::read_dir(folder).unwrap_or_else(|e| panic!("{}: {e}", folder.display())) {
        let path = entry.unwrap().path();
        let name = path.file_name().unwrap_or_default();
        if path.is_dir() && name != "target" && !name.to_string_lossy().starts_with('.') {
            pages_in(&path, into);
        } else if path.extension().is_some_and(|e| e == "md") {
            into.push(path);
        }
    }
}

/// Returns the targets of links and pictures in a page, without those in fenced code or in code within a line.
fn links(page: &str) -> Vec<String> {
    let mut found = Vec::new();
    let mut is_code = false;
    for line in page.lines() {
        is_code ^= line.trim_start().starts_with("```");
        if is_code {
            continue;
        }
        let prose: String = line.split('`').step_by(2).collect::<Vec<_>>().join("code");
        let targets = prose.split("](").skip(1).filter_map(|rest| rest.split_once(')'));
        found.extend(targets.map(|(target, _)| target.to_owned()));
    }
    found
}

/// Returns the anchors of a page's headings, as GitHub generates them.
fn anchors(page: &str) -> Vec<String> {
    let headings = page.lines().filter(|line| line.starts_with('#'));
    let is_kept = |c: &char| c.is_alphanumeric() || matches!(c, ' ' | '-' | '_');
    headings
        .map(|line| line.trim_start_matches('#').trim().to_lowercase().chars().filter(is_kept).collect::<String>())
        .map(|heading| heading.replace(' ', "-"))
        .collect()
}

/// Returns the links of a page whose targets do not exist; `folder` is that of the page.
fn broken(folder: &Path, page: &str) -> Vec<String> {
    let has_target = |link: &String| {
        if link.starts_with("https://") || link.starts_with("http://") {
            return true;
        }
        let (file, anchor) = link.split_once('#').unwrap_or((link, ""));
        let path = folder.join(file);
        let text = if file.is_empty() { Some(page.to_owned()) } else { fs::read_to_string(&path).ok() };
        let has_anchor = || text.is_some_and(|text| anchors(&text).iter().any(|a| a == anchor));
        (file.is_empty() || path.exists()) && (anchor.is_empty() || has_anchor())
    };
    links(page).into_iter().filter(|link| !has_target(link)).collect()
}

#[test]
fn targets_of_links_and_pictures_exist() {
    let mut pages = Vec::new();
    pages_in(root(), &mut pages);
    assert!(pages.len() > 12, "only {} pages were read", pages.len());
    let mut found = Vec::new();
    let mut count = 0;
    for path in &pages {
        let page = fs::read_to_string(path).unwrap();
        count += links(&page).len();
        let shown = path.strip_prefix(root()).unwrap().display();
        found.extend(broken(path.parent().unwrap(), &page).iter().map(|link| format!("{shown}: {link}")));
    }
    assert!(count > 40, "only {count} links were read");
    assert!(found.is_empty(), "{} links have no target:\n{}", found.len(), found.join("\n"));
}

#[test]
fn planted_broken_links_are_caught() {
    let page = "# A page\n\n## One `part`\n\n[a](docs) [b](#one-part) [c](README.md#license) [d](https://x.y/z)\n\
                [e](no.md) ![f](no.png) [g](#two) [h](README.md#no) `[i](code)`\n```\n[j](code)\n```\n";
    assert_eq!(broken(root(), page), ["no.md", "no.png", "#two", "README.md#no"]);
}

/// README.md shows some rows of the table in docs/comparison.md.
#[test]
fn rows_of_the_comparison_are_the_same_in_both_places() {
    let read = |name: &str| fs::read_to_string(root().join(name)).unwrap();
    let rows = |page: &str| -> Vec<String> {
        page.lines()
            .skip_while(|line| !line.starts_with("| | Eddy"))
            .take_while(|l| !l.is_empty())
            .map(str::to_owned)
            .collect()
    };
    let (shown_rows, all) = (rows(&read("README.md")), rows(&read("docs/comparison.md")));
    assert!(shown_rows.len() > 10 && all.len() > shown_rows.len());
    for row in shown_rows {
        assert!(all.contains(&row), "not in docs/comparison.md: {row}");
    }
}

/// Returns the first block of a language on a page.
fn first_block(page: &str, language: &str) -> String {
    let text = fs::read_to_string(root().join(page)).unwrap();
    let (_, rest) = text.split_once(&format!("```{language}\n")).expect("a block of this language");
    rest.split_once("```").expect("its end").0.to_owned()
}

#[test]
fn the_documented_manifest_can_be_loaded() {
    let folder = tempfile::tempdir().unwrap();
    let code = "#iUniform float viscosity = 0.1 in { 0.0, 1.0 }\n#iUniform color3 tint\n";
    let files = [("eddy.toml", first_block("docs/projects.md", "toml").as_str()), ("common.glsl", code)]
        .map(|(name, text)| (name, text.to_owned()));
    let passes = ["buffer_a.glsl", "image.glsl"].map(|name| (name, "void mainImage(out vec4 o, in vec2 p) {}".into()));
    for (name, text) in files.into_iter().chain(passes) {
        fs::write(folder.path().join(name), text).unwrap();
    }
    let loaded = eddy::project::load(folder.path().to_str().unwrap()).unwrap();
    assert_eq!((loaded.project.passes.len(), loaded.project.groups.len()), (2, 1));
}
