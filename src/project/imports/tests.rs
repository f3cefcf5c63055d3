use super::*;
use crate::{Input, InputKind, Media, Origin, PassName};

const SHADER: &str = r#"{"ver":"0.1","info":{"name":"Rings"},"renderpass":[
    {"type":"buffer","name":"Buffer A","inputs":[],"outputs":[{"id":"4dXGR8","channel":0}],
     "code":"void mainImage(out vec4 o, vec2 p) { o = vec4(1); }"},
    {"type":"image","name":"Image","outputs":[],"code":"void mainImage(out vec4 o, vec2 p) { o = vec4(1); }",
     "inputs":[{"id":"4dXGR8","channel":2,"type":"buffer","filepath":"/media/previz/buffer00.png",
                "sampler":{"filter":"nearest","wrap":"clamp","vflip":"true"}}]}]}"#;

fn project(text: &str) -> crate::Project {
    match import_of_text(text) {
        Ok(TextImport::Project(loaded)) => loaded.project,
        other => panic!("{other:?}"),
    }
}

fn refused(text: &str) -> String {
    import_of_text(text).expect_err(text).to_string()
}

#[test]
fn shadertoy_json_is_a_project_with_its_channels() {
    for text in [SHADER.to_owned(), format!("\u{feff}\n  {SHADER}\n"), format!("[{SHADER}]")] {
        let project = project(&text);
        assert_eq!((&*project.name, &project.origin), ("Rings", &Origin::Unsaved));
        let image = project.image().unwrap();
        assert_eq!(image.bindings.get(2).unwrap().input, Input::buffer("A"));
    }
    assert!(refused("{\"a\": 1}").contains("no \"renderpass\""));
    assert!(refused("{").contains("not JSON"));
}

#[test]
fn glsl_is_an_image_pass_with_channel_lines() {
    let text = "#iChannel1 \"keyboard\"\r\nvoid mainImage(out vec4 o, in vec2 p) { o = vec4(1.0); }\r\n";
    let project = project(text);
    let image = project.image().unwrap();
    assert_eq!(image.bindings.get(1).unwrap().input, Input::KEYBOARD);
    assert!(!image.source.text.contains('\r'));
    // Also on a single line.
    self::project("void mainImage(out vec4 o, in vec2 p) { o = vec4(1.0); }");
    self::project("// a shader\nvoid mainImage(out vec4 o, in vec2 p) { o = vec4(1.0); }");
}

#[test]
fn paths_are_opened_and_web_addresses_are_explained() {
    let dir = tempfile::tempdir().unwrap();
    let file = dir.path().join("a b.glsl");
    std::fs::write(&file, "").unwrap();
    let place = |text: &str| match import_of_text(text) {
        Ok(TextImport::Place(place)) => place,
        other => panic!("{text}: {other:?}"),
    };
    let path = file.to_str().unwrap();
    assert_eq!(place(path), path);
    assert_eq!(place(&format!("\"{path}\"\n")), path);
    assert_eq!(place(&format!("file://{}", path.replace(' ', "%20"))), path);
    assert_eq!(place("fluid"), "fluid");
    for address in ["https://www.shadertoy.com/view/XslGRr", "shadertoy.com/view/XslGRr", "http://Shadertoy.com/"] {
        assert!(refused(address).contains("bookmarklet"), "{address}");
    }
    assert!(refused("https://example.org/a.glsl").contains("save the file"));
    assert!(refused("file:///no/such/file.glsl").contains("no file /no/such/file.glsl"));
    assert!(refused("/no/such/file.glsl").contains("no file"));
    assert!(refused("  \n").contains("clipboard is empty"));
    assert!(refused("Dear diary").contains("Dear diary"));
    assert!(refused("Dear diary,\ntoday").contains("mainImage"));
}

#[test]
fn files_are_classified_by_their_names() {
    let dir = tempfile::tempdir().unwrap();
    let kind = |name: &str| kind_of_file(&dir.path().join(name));
    assert_eq!(kind_of_file(dir.path()), FileKind::Project);
    for (name, expected) in [
        ("image.GLSL", FileKind::Project),
        ("a.frag", FileKind::Project),
        ("a.json", FileKind::Project),
        ("eddy.toml", FileKind::Project),
        ("a.PNG", FileKind::Picture),
        ("a.hdr", FileKind::Picture),
        ("fox.glb", FileKind::Model),
        ("a.obj", FileKind::Model),
        ("run-0001.replay", FileKind::Recording),
        ("a.mp3", FileKind::Sound),
        ("a.MP4", FileKind::Video),
        ("a.OGG", FileKind::Sound),
        ("a.docx", FileKind::Unknown),
        ("a", FileKind::Unknown),
    ] {
        assert_eq!(kind(name), expected, "{name}");
    }
}

#[test]
fn files_that_are_dropped_together_may_be_one_project() {
    let parts = |names: &[&'static str]| {
        let paths: Vec<&'static Path> = names.iter().map(|name| Path::new(*name)).collect();
        folder_of_parts(&paths)
    };
    assert_eq!(parts(&["/p/buffer_a.glsl", "/p/image.glsl"]), Some(Path::new("/p")));
    assert_eq!(parts(&["/p/eddy.toml", "/p/x.glsl"]), Some(Path::new("/p")));
    assert_eq!(parts(&["/p/image.glsl"]), None, "one file is that file");
    assert_eq!(parts(&["/p/buffer_a.glsl", "/p/other.glsl"]), None);
    assert_eq!(parts(&["/p/image.glsl", "/q/buffer_a.glsl"]), None);
}

#[test]
fn a_picture_goes_to_a_free_channel() {
    let mut project = new_for(Path::new("/there/photo.png"), false);
    assert_eq!(project.name, "photo");
    assert_eq!(project.free_channel(&PassName::image()), Some(0));
    project.read_picture(&PassName::image(), 0, Path::new("/there/photo.png"));
    assert_eq!(project.free_channel(&PassName::image()), Some(1));
    project.image_mut().unwrap().source.text = "texture(iChannel3, p)".into();
    assert_eq!(project.free_channel(&PassName::image()), Some(3));
    for channel in 1..4 {
        project.read_picture(&PassName::image(), channel, Path::new("/there/photo.png"));
    }
    assert_eq!(project.free_channel(&PassName::image()), None);
    project.read_sound(&PassName::image(), 2, Path::new("/there/song.mp3"));
    let input = project.image().unwrap().bindings.get(2).unwrap().input.clone();
    assert_eq!((input.kind(), input.media()), (InputKind::Music, Some(&Media::Picked("/there/song.mp3".into()))));
}

#[test]
fn a_model_is_put_before_the_camera() {
    let fit = wire::Fit::of_corners([-10.0, 0.0, 90.0], [10.0, 40.0, 110.0]);
    assert!((fit.scale * 600f64.sqrt() - 1.4).abs() < 0.01, "{fit:?}");
    assert!((fit.position[2] + 100.0 * fit.scale).abs() < 1e-3 && fit.position[0] == 0.0, "{fit:?}");
    let point = wire::Fit::of_corners([1.0; 3], [1.0; 3]);
    assert_eq!((point.scale, point.position), (1.0, [-1.0; 3]));
}
