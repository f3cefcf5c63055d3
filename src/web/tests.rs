//! Tests of whole pages: their size, their bytes, and texts that look like markup.

use crate::{PLAYER_BYTES, Page, export, page};
use eddy_project::{Channel, Condition, Input, Media, Origin, Pass, PassName, Project, Source, load, presets};

fn source(name: &str, text: &str) -> Source {
    Source { name: name.into(), path: None, text: text.into() }
}

fn image(text: &str) -> Project {
    Project::of_image("p".into(), text.into())
}

fn plain() -> Project {
    image("void mainImage(out vec4 o, in vec2 p) { o = vec4(1.0); }")
}

fn exported(project: &Project) -> Page {
    export(project, None).unwrap_or_else(|errors| panic!("{errors:?}"))
}

/// Returns the description in a page.
fn description(html: &str) -> serde_json::Value {
    let start = html.find("id=\"project\">").unwrap() + "id=\"project\">".len();
    let end = start + html[start..].find("</script>").unwrap();
    serde_json::from_str(&html[start..end]).unwrap()
}

#[test]
fn player_is_within_its_size_limit() {
    let bytes = exported(&plain()).html.len();
    assert!(bytes <= PLAYER_BYTES, "{bytes} bytes");
    assert!(bytes > PLAYER_BYTES / 2, "the control: {bytes} bytes are no player");
}

#[test]
fn the_same_project_gives_the_same_bytes() {
    for name in ["fluid", "ssao", "nocturne", "sky-spheres"] {
        let project = load(name).unwrap().project;
        assert_eq!(exported(&project).html, exported(&project).html, "{name}");
    }
}

#[test]
fn every_preset_is_exported_with_all_its_passes() {
    for name in presets::names() {
        let project = load(name).unwrap().project;
        let page = exported(&project);
        let data = description(&page.html);
        assert_eq!(data["passes"].as_array().unwrap().len(), project.passes.len(), "{name}");
        assert!(!data["codes"].as_array().unwrap().iter().any(|code| code.as_str().unwrap().contains("#iUniform")));
    }
}

#[test]
fn condition_is_an_expression_tree() {
    let mut project = plain();
    let mut buffer =
        Pass::new(PassName::buffer("A"), source("A", "void mainImage(out vec4 o, in vec2 p) { o = vec4(1.0); }"));
    buffer.settings.when = Some(Condition::parse("!(width < 640.5) && -1 != 0 || false").unwrap());
    project.passes.insert(0, buffer);
    let data = description(&exported(&project).html);
    let tree = serde_json::json!(["||", ["&&", ["!", ["<", "width", 640.5]], ["!=", ["-", 1.0], 0.0]], 0.0]);
    assert_eq!(data["passes"][0]["when"], tree);
    assert!(data["passes"][1].get("when").is_none());
}

/// The text of a shader, names and descriptions never end their element.
#[test]
fn project_texts_are_not_parsed_as_markup() {
    let mut project = image(
        "// </script><script>alert(1)</script><!-- \u{2028}\nvoid mainImage(out vec4 o, in vec2 p) { o = vec4(1.0); }",
    );
    project.name = "</title><script>\"'&".into();
    project.info.author = "\"><img src=x>".into();
    project.info.description = "{script}</script>".into();
    let html = exported(&project).html;
    let plain = exported(&plain()).html;
    for mark in ["<script", "</script>", "<!--", "<img", "</title>", "<meta"] {
        // One is written by the author.
        let extra = usize::from(mark == "<meta");
        assert_eq!(html.matches(mark).count(), plain.matches(mark).count() + extra, "{mark}");
    }
    let data = description(&html);
    assert_eq!(data["name"], "</title><script>\"'&");
    assert!(data["codes"][1].as_str().unwrap().contains("</script><script>alert(1)</script><!-- \u{2028}\n"));
}

/// The page contains no address, and its policy allows none.
#[test]
fn page_contains_no_address() {
    let html = exported(&load("fluid").unwrap().project).html;
    let script = page::script();
    assert!(html.contains("default-src 'none'; script-src 'sha256-"), "{}", &html[..900]);
    for word in
        ["http:", "https:", "fetch(", "XMLHttpRequest", "WebSocket", "import(", "eval(", "<link rel=\"stylesheet"]
    {
        assert!(!script.contains(word) && !html[..html.find("id=\"project\"").unwrap()].contains(word), "{word}");
    }
}

#[test]
fn line_numbers_are_those_of_the_texts() {
    let mut project = image("#include \"a.glsl\"\nvoid mainImage(out vec4 o, in vec2 p) { o = vec4(f()); }");
    project.includes.push(eddy_project::Included {
        source: source("a.glsl", "#iUniform float k = 1.0\nfloat f() { return k; }"),
        trouble: None,
        is_limit: false,
        is_edited: false,
    });
    project.common = Some(source("Common", "float g() { return 1.0; }"));
    let data = description(&exported(&project).html);
    assert_eq!(data["codes"][0], "#line 1 1\nfloat g() { return 1.0; }\n");
    let blank = " ".repeat("#iUniform float k = 1.0".len());
    let wanted = format!(
        "#line 1 2\n#line 1 3\n{blank}\nfloat f() {{ return k; }}\n#line 2 2\nvoid mainImage(out vec4 o, in vec2 p) {{ o = vec4(f()); }}\n"
    );
    assert_eq!(data["codes"][1], wanted);
    assert_eq!(data["texts"], serde_json::json!(["player", "Common", "Image", "a.glsl"]));
    assert_eq!((&data["uniforms"][0]["name"], &data["passes"][0]["uniforms"]), (&"k".into(), &serde_json::json!([0])));
}

#[test]
fn compile_errors_are_returned() {
    let errors = export(&image("void mainImage(out vec4 o, in vec2 p) { o = oops; }"), None).unwrap_err();
    assert!(errors[0].message.contains("oops"), "{errors:?}");
}

#[test]
fn textures_are_embedded_once() {
    let noise = || Some(Channel::new(Input::texture(Media::Builtin("noise-rgba-64".into()))));
    let text = "void mainImage(out vec4 o, in vec2 p) { o = texture(iChannel0, p) + texture(iChannel1, p); }";
    let image = Pass { bindings: [noise(), noise()].into(), ..Pass::new(PassName::image(), source("Image", text)) };
    let page = exported(&Project::new("p", vec![image], Origin::Unsaved));
    let data = description(&page.html);
    assert_eq!(data["media"].as_array().unwrap().len(), 1);
    assert_eq!((&data["media"][0]["w"], &data["media"][0]["format"]), (&64.into(), &"rgba8".into()));
    assert_eq!(data["passes"][0]["channels"][1]["m"], 0);
    assert!(page.media_bytes > 1000 && page.html.len() < PLAYER_BYTES + page.media_bytes + 2000);
}

#[test]
fn missing_media_is_a_warning_and_black() {
    let video = Some(Channel::new(Input::Media {
        kind: eddy_project::InputKind::Video,
        media: Media::Picked("/nowhere/a.mkv".into()),
    }));
    let text = "void mainImage(out vec4 o, in vec2 p) { o = texture(iChannel0, p); }";
    let image = Pass { bindings: [video].into(), ..Pass::new(PassName::image(), source("Image", text)) };
    let page = exported(&Project::new("p", vec![image], Origin::Unsaved));
    assert!(page.diagnostics.iter().any(|d| d.message.starts_with("iChannel0 of Image: ")), "{:?}", page.diagnostics);
    assert_eq!(description(&page.html)["passes"][0]["channels"][0]["in"], "none");
}
