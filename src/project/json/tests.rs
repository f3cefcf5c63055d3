//! Tests of Shadertoy's JSON: import, export, and lossless round trips.

use super::{export, holds_several, import, import_one};
use crate::{
    Channel, Filter, Info, Input, InputKind, Media, Origin, Pass, PassName, Project, Sampler, SamplerRules, Source,
    Wrap,
};
use serde_json::{Value, json};

fn input(channel: u32, kind: &str, id: &str, path: &str, wrap: &str) -> Value {
    json!({ "id": id, "filepath": path, "type": kind, "channel": channel, "published": 1,
        "sampler": { "filter": "linear", "wrap": wrap, "vflip": "true", "srgb": "false", "internal": "byte" } })
}

fn pass(kind: &str, output: Option<&str>, inputs: &[Value]) -> Value {
    let outputs: Vec<Value> = output.iter().map(|id| json!({ "id": id, "channel": 0 })).collect();
    json!({ "inputs": inputs, "outputs": outputs, "code": format!("// {kind}"), "name": "any name", "description": "",
        "type": kind })
}

fn shader(passes: &[Value]) -> Value {
    json!({ "ver": "0.1", "renderpass": passes, "info": { "id": "XxXxXx", "name": "Test", "username": "me",
        "description": "d", "tags": ["a", "b"], "date": "1424942564", "viewed": 7, "parentid": null } })
}

fn read(value: &Value) -> Project {
    let (project, warnings) = import(&value.to_string(), "x.json").unwrap();
    assert_eq!(warnings, []);
    project
}

fn refusal(text: &str) -> String {
    import(text, "x.json").expect_err("is refused").to_string()
}

#[test]
fn the_three_formats_yield_the_same_project() {
    let site = shader(&[
        pass("image", None, &[input(1, "buffer", "XsXGR8", "", "clamp"), input(0, "keyboard", "4dXGRr", "", "clamp")]),
        pass("common", None, &[]),
        pass("buffer", Some("XsXGR8"), &[]),
        pass("buffer", Some("4dXGR8"), &[input(2, "cubemap", "4dX3Rr", "", "clamp")]),
    ]);
    let project = read(&site);
    assert_eq!(read(&json!({ "Shader": site })), project);
    assert_eq!(read(&json!([site])), project);
    let ids: Vec<&str> = project.passes.iter().map(|p| p.id.key()).collect();
    assert_eq!(ids, ["buffer_b", "buffer_a", "image"], "buffers in the list's order, by output id, Image last");
    assert_eq!(&*project.common.as_ref().unwrap().text, "// common");
    assert_eq!(project.passes[1].bindings.get(2).unwrap().input, Input::pass(PassName::cube()));
    assert_eq!(project.passes[2].bindings.get(1).unwrap().input, Input::buffer("B"));
    assert_eq!(project.sampler_rules, SamplerRules::Site);
    assert_eq!((project.info.id.as_str(), project.info.author.as_str()), ("XxXxXx", "me"));
    assert_eq!(project.info.extra["viewed"], json!(7));
}

#[test]
fn the_api_spelling_is_accepted() {
    let api = json!({ "Shader": { "ver": "0.1", "info": {}, "renderpass": [
        { "type": "image", "code": "", "outputs": [{ "id": 37, "channel": 0 }], "inputs": [
            { "id": 257, "src": "/media/previz/buffer00.png", "ctype": "buffer", "channel": 0,
              "sampler": { "filter": "mipmap", "wrap": "repeat", "vflip": "false" } },
            { "id": "whatever", "src": "/media/previz/buffer03.png", "ctype": "buffer", "channel": "1" },
            { "id": "XsfGRn", "src": "/media/a/1f7d.jpg", "ctype": "texture", "channel": 2 } ] } ] } });
    let project = read(&api);
    assert_eq!(project.name, "x", "a shader without a name is called after its file");
    let channels = &project.passes[0].bindings;
    let sampler = Sampler { filter: Filter::Mipmap, wrap: Wrap::Repeat, vflip: false };
    assert_eq!(channels.get(0), Some(&Channel { input: Input::buffer("A"), sampler }));
    assert_eq!(channels.get(1).unwrap().input, Input::buffer("D"));
    let wood = Media::Site { id: "XsfGRn".into(), path: "/media/a/1f7d.jpg".into() };
    assert_eq!(channels.get(2).unwrap().input, Input::texture(wood));
}

#[test]
fn the_last_wrap_mode_of_a_buffer_wins() {
    let project = read(&shader(&[
        pass("image", None, &[input(0, "buffer", "4dXGR8", "", "clamp")]),
        pass("buffer", Some("4dXGR8"), &[input(0, "buffer", "4dXGR8", "", "repeat")]),
    ]));
    for pass in &project.passes {
        assert_eq!(pass.bindings.get(0).unwrap().sampler.wrap, Wrap::Repeat, "{}", pass.id.key());
    }
}

#[test]
fn buffers_without_a_usable_id_get_a_free_letter_and_a_warning() {
    let value = shader(&[
        pass("image", None, &[]),
        pass("buffer", Some("4dXGR8"), &[]),
        pass("buffer", Some("4dXGR8"), &[]),
        pass("buffer", None, &[]),
        pass("buffer", Some("4sXGR8"), &[]),
        pass("buffer", Some("buffer_blur"), &[]),
    ]);
    let (project, warnings) = import(&value.to_string(), "x.json").unwrap();
    let ids: Vec<&str> = project.passes.iter().map(|p| p.id.key()).collect();
    assert_eq!(ids, ["buffer_a", "buffer_b", "buffer_d", "buffer_c", "buffer_blur", "image"]);
    assert_eq!(warnings.len(), 2, "{warnings:?}");
}

#[test]
fn unknown_inputs_are_dropped_with_a_warning() {
    let value = shader(&[pass(
        "image",
        None,
        &[
            input(7, "buffer", "4dXGR8", "", "clamp"),
            input(0, "hologram", "", "", "clamp"),
            input(1, "buffer", "?", "", ""),
        ],
    )]);
    let (project, warnings) = import(&value.to_string(), "x.json").unwrap();
    assert!(project.passes[0].bindings.is_empty());
    assert_eq!(warnings.len(), 3);
}

#[test]
fn the_last_of_several_image_passes_wins() {
    let image = |code: &str| {
        let mut image = pass("image", None, &[]);
        image["code"] = code.into();
        image
    };
    let value = shader(&[image("// 1"), pass("buffer", Some("4dXGR8"), &[]), image("// 2"), image("// 3")]);
    let (project, warnings) = import(&value.to_string(), "x.json").unwrap();
    let read: Vec<(String, &str)> = project.passes.iter().map(|p| (p.id.title(), &*p.source.text)).collect();
    assert_eq!(read.len(), 2, "{read:?}");
    assert_eq!((read[1].0.as_str(), read[1].1), ("Image", "// 3"));
    let said: Vec<&str> = warnings.iter().map(|w| w.message.as_str()).collect();
    assert_eq!(said, ["the shader has 3 Image passes; only the last one is read"]);
}

#[test]
fn invalid_json_is_rejected_with_a_span() {
    let no_image = shader(&[pass("common", None, &[])]).to_string();
    let two_sounds =
        shader(&[pass("sound", None, &[]), pass("sound", None, &[]), pass("image", None, &[])]).to_string();
    let unknown = shader(&[pass("image", None, &[]), pass("vertex", None, &[])]).to_string();
    let version = shader(&[pass("image", None, &[])]).to_string().replace("0.1", "0.2");
    for (text, expected) in [
        ("", vec!["x.json:1:1", "not JSON", "expected a Shadertoy shader"]),
        ("{\n  \"ver\": \"0.1\",\n  oops }", vec!["x.json:3:3", "not JSON"]),
        ("{\n  \"ver\": \"0.1\", \"renderpass\": [\n    { \"type\": 3 } ] }", vec!["x.json:3:", "invalid type"]),
        ("{ \"ver\": \"0.1\", \"renderpass\": [{ \"type\": \"image\" }] }", vec!["has no \"code\"", "x.json:1:17"]),
        ("{ \"ver\": \"0.1\", \"renderpass\": [{ \"code\": \"\" }] }", vec!["has no \"type\"", "the types are common"]),
        ("{ \"ver\": \"0.1\", \"renderpass\": null }", vec!["\"renderpass\" is null"]),
        ("<!DOCTYPE html>\n<html>", vec!["not JSON", "this is a web page"]),
        ("{ \"Shaders\": 2, \"Results\": [\"a\", \"b\"] }", vec!["list of ids"]),
        ("{ \"Error\": { \"code\": 7 } }", vec!["error of the API", "code"]),
        ("{ \"shaders\": [] }", vec!["list is empty"]),
        ("{ \"shaders\": {} }", vec!["expected a list of shaders"]),
        ("[[{}]]", vec!["a list within a list"]),
        ("{ \"a\": 1, \"b\": 2 }", vec!["has \"a\" and \"b\", and no \"renderpass\"", "\"Shader\""]),
        ("{}", vec!["is empty"]),
        ("[]", vec!["list is empty"]),
        ("[1]", vec!["x.json:1:2", "a bare value"]),
        ("\"text\"", vec!["a bare value"]),
        ("{ \"Error\": \"Shader not found\" }", vec!["x.json:1:3", "error of the API", "Shader not found"]),
        (version.as_str(), vec!["format version \"0.2\"", "\"ver\": \"0.1\""]),
        ("{ \"renderpass\": [] }", vec!["no Image pass"]),
        (no_image.as_str(), vec!["no Image pass"]),
        (two_sounds.as_str(), vec!["two passes named Sound"]),
        (unknown.as_str(), vec!["unknown type \"vertex\""]),
    ] {
        let said = refusal(text);
        for part in expected {
            assert!(said.contains(part), "{text}\ndoes not give {part:?} but\n{said}");
        }
    }
    for depth in [1_000, 200_000] {
        refusal(&"[".repeat(depth));
    }
}

#[test]
fn an_export_reads_back_as_the_same_project() {
    let channel = |input, filter, wrap, vflip| Some(Channel { input, sampler: Sampler { filter, wrap, vflip } });
    let site = |id: &str, path: &str| Media::Site { id: id.into(), path: path.into() };
    let source = |name: &str, text: &str| Source { name: name.into(), path: None, text: text.into() };
    let pass = |id: PassName, channels: [Option<Channel>; crate::SLOTS]| Pass {
        source: source(&id.title(), "void f() { \"\u{e9}\\n\" }\r\n"),
        id,
        bindings: channels.into(),
        settings: Default::default(),
        body: Default::default(),
    };
    let (n, l, m) = (Filter::Nearest, Filter::Linear, Filter::Mipmap);
    let project = Project {
        name: "A name".into(),
        info: Info {
            id: "abcdef".into(),
            author: "someone".into(),
            description: "line\nline".into(),
            tags: vec!["x".into()],
            period: None,
            extra: serde_json::from_str(r#"{ "likes": 3, "parentid": null, "nested": { "a": [1.5] } }"#).unwrap(),
        },
        common: Some(source("Common", "#define A\n")),
        passes: vec![
            pass(
                PassName::buffer("C"),
                [
                    channel(Input::buffer("blur"), n, Wrap::Clamp, true),
                    channel(Input::texture(Media::Builtin("noise-rgba-64".into())), m, Wrap::Repeat, false),
                    channel(Input::texture(Media::File("dir/pic.png".into())), l, Wrap::Clamp, true),
                    channel(
                        Input::Media { kind: InputKind::Volume, media: site("v", "/media/a/v.bin") },
                        l,
                        Wrap::Repeat,
                        true,
                    ),
                ],
            ),
            pass(
                PassName::buffer("blur"),
                [
                    channel(
                        Input::Media { kind: InputKind::Music, media: site("m", "/media/a/m.mp3") },
                        l,
                        Wrap::Clamp,
                        true,
                    ),
                    channel(
                        Input::Media { kind: InputKind::Music, media: site("s", "https://soundcloud.com/x/y") },
                        l,
                        Wrap::Clamp,
                        true,
                    ),
                    channel(Input::Device(InputKind::Microphone), l, Wrap::Clamp, true),
                    channel(Input::Device(InputKind::Webcam), l, Wrap::Clamp, true),
                ],
            ),
            pass(PassName::cube(), [channel(Input::pass(PassName::cube()), l, Wrap::Clamp, true), None, None, None]),
            pass(
                PassName::image(),
                [
                    None,
                    channel(Input::KEYBOARD, n, Wrap::Clamp, true),
                    channel(
                        Input::Media { kind: InputKind::Cubemap, media: site("c", "/media/a/c.png") },
                        m,
                        Wrap::Clamp,
                        false,
                    ),
                    channel(
                        Input::Media { kind: InputKind::Video, media: site("w", "/media/a/w.webm") },
                        l,
                        Wrap::Clamp,
                        true,
                    ),
                ],
            ),
            pass(PassName::sound(), Default::default()),
        ],
        sampler_rules: SamplerRules::Site,
        dialect: Default::default(),
        custom_uniform_values: Default::default(),
        controls: Default::default(),
        groups: Vec::new(),
        includes: Vec::new(),
        origin: Origin::Unsaved,
    };
    let text = export(&project);
    let (back, warnings) = import(&text, "x.json").unwrap();
    assert_eq!(warnings, []);
    assert_eq!(back, project);
    assert_eq!(export(&back), text);
}

/// The file that a profile's page exports.
fn exported(shaders: &[Value]) -> Value {
    json!({ "userName": "me", "date": "2026-01-01T00:00:00.000Z", "numShaders": shaders.len(), "shaders": shaders })
}

fn called(id: Value, name: &str, code: &str) -> Value {
    let mut one = shader(&[pass("image", None, &[])]);
    (one["info"]["id"], one["info"]["name"], one["renderpass"][0]["code"]) = (id, json!(name), json!(code));
    one
}

#[test]
fn one_of_several_shaders_is_selected_by_id_number_or_name() {
    let list = [
        called(json!("aaaaaa"), "first", "1"),
        called(json!(42), "second", "2"),
        called(json!("aaaaaa"), "third", "3"),
    ];
    for file in [exported(&list), json!(list), json!([{ "Shader": list[0] }, { "Shader": list[1] }, list[2]])] {
        let text = file.to_string();
        assert!(holds_several(&text));
        let (project, warnings) = import(&text, "x.json").unwrap();
        assert_eq!(&*project.passes[0].source.text, "1");
        let said = format!("{warnings:?}");
        assert_eq!(warnings.len(), 1, "{said}");
        assert!(said.contains("has 3 shaders") && said.contains("x.json#aaaaaa (first), x.json#42 (second)"), "{said}");
        assert!(said.contains("x.json#3 (third)"), "an id that another has is none: {said}");
        for (wanted, code) in [("aaaaaa", "1"), ("2", "2"), ("42", "2"), ("3", "3"), ("Third", "3")] {
            let (project, warnings) = import_one(&text, "x.json", Some(wanted)).unwrap();
            assert_eq!((&*project.passes[0].source.text, warnings), (code, Vec::new()), "{wanted}");
        }
        let refused = import_one(&text, "x.json", Some("nobody")).unwrap_err().to_string();
        assert!(refused.contains("none of the 3 shaders") && refused.contains("x.json#42"), "{refused}");
    }
    let one = list[0].to_string();
    assert!(!holds_several(&one) && !holds_several(&exported(&list[..1]).to_string()) && !holds_several("{"));
    assert_eq!(import(&exported(&list[..1]).to_string(), "x.json").unwrap().1, []);
    assert!(import_one(&one, "x.json", Some("aaaaaa")).is_ok());
    assert!(import_one(&one, "x.json", Some("b")).unwrap_err().to_string().contains("has one shader"));
}

#[test]
fn json_of_other_tools_is_accepted() {
    let bare = json!({ "renderpass": [{ "code": "x\r\n", "name": "Image" }, { "code": "", "name": "Buf A", "inputs": null,
        "outputs": null, "type": null }, { "code": "", "type": "Common ", "name": 7 }], "info": null, "extra": [1] });
    let (project, warnings) = import(&bare.to_string(), "x.json").unwrap();
    let said: Vec<&str> = warnings.iter().map(|w| w.message.as_str()).collect();
    assert!(said.len() == 2 && said[0].contains("no \"ver\"") && said[1].contains("Buf A"), "{said:?}");
    let ids: Vec<&str> = project.passes.iter().map(|p| p.id.key()).collect();
    assert_eq!((ids.join(" "), &*project.passes[1].source.text), ("buffer_a image".to_owned(), "x\r\n"));
    let read = |text: &str| import(text, "x.json").unwrap().0;
    // As with `JSON.parse`, the last member wins, an unpaired surrogate is a character, and a number may be infinite.
    let twice = r#"{ "ver": 0.1, "ver": "0.1", "renderpass": [], "renderpass": [ { "type": "image", "code": "a",
        "code": "\/\/ \ud83d \ud83d\ude00", "inputs": [ { "channel": 2.0, "ctype": "keyboard", "type": null, "id": 33 } ] } ],
        "info": { "name": "n", "viewed": 1e999, "likes": 4 } }"#;
    let project = read(twice);
    assert_eq!(&*project.passes[0].source.text, "// \u{fffd} \u{1f600}");
    assert_eq!(project.passes[0].bindings.get(2).unwrap().input, Input::KEYBOARD);
    assert_eq!((&project.info.extra["viewed"], &project.info.extra["likes"]), (&Value::Null, &json!(4)));
    let deep = format!("{}{}", "[".repeat(5000), "]".repeat(5000));
    let text = format!(
        r#"{{ "other": {deep}, "ver": "0.1", "info": {{ "deep": {deep}, "name": "n" }}, "renderpass": [ {{ "type": "image", "code": "" }} ] }}"#
    );
    let (project, warnings) = import(&text, "x.json").unwrap();
    assert_eq!((project.name.as_str(), warnings.len()), ("n", 1), "{warnings:?}");
}

#[test]
fn utf_16_files_and_single_shaders_of_a_file_are_opened() {
    let dir = tempfile::tempdir().unwrap();
    let file = dir.path().join("all.json");
    let text = exported(&[called(json!("a"), "first", "1"), called(json!("b"), "second", "2")]).to_string();
    let bytes: Vec<u8> = format!("\u{feff}{text}").encode_utf16().flat_map(u16::to_le_bytes).collect();
    std::fs::write(&file, bytes).unwrap();
    let open = |name: &str| crate::load(&format!("{}{name}", file.display()));
    let first = open("").unwrap();
    assert_eq!((first.project.name.as_str(), first.warnings.len()), ("first", 1));
    let second = open("#b").unwrap();
    assert_eq!((second.project.name.as_str(), second.warnings.len()), ("second", 0));
    let Origin::Json(path) = &second.project.origin else { panic!("{:?}", second.project.origin) };
    assert_eq!(crate::load(path.to_str().unwrap()).unwrap().project, second.project, "it is found again");
    assert_eq!(crate::stem(path.to_str().unwrap()), "all_b");
    assert!(open("#c").unwrap_err().to_string().contains("none of the 2 shaders"));
    // The other shader would be lost.
    for project in [&first.project, &second.project] {
        let refused = crate::save(project, &file, crate::Overwrite::Refuse);
        assert!(matches!(refused, Err(crate::ProjectError::WouldOverwrite { .. })), "{refused:?}");
    }
}
