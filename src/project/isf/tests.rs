use super::json_of;
use crate::{
    CustomUniformType, Dialect, Input, InputKind, Loaded, Media, Overwrite, PassName, PassSize, Project, ProjectError,
    ShaderForm, Side, Tab, TexelFormat, load, save,
};
use std::{fs, path::Path};

fn open(folder: &Path, name: &str, text: &str) -> Result<Loaded, ProjectError> {
    let file = folder.join(name);
    fs::write(&file, text).unwrap();
    load(file.to_str().unwrap())
}

fn project(text: &str) -> Project {
    open(tempfile::tempdir().unwrap().path(), "a.fs", text).unwrap().project
}

/// Returns the error messages for a header, with the text that each points to.
fn wrong(text: &str) -> Vec<(String, String)> {
    match open(tempfile::tempdir().unwrap().path(), "a.fs", text) {
        Err(ProjectError::Invalid { diagnostics, sources, .. }) => {
            let at = |span: eddy_diag::Span| sources.get(span.source).unwrap().text[span.range()].to_owned();
            diagnostics.into_iter().map(|d| (d.message, d.span.map(at).unwrap_or_default())).collect()
        }
        other => panic!("{other:?}"),
    }
}

const TRAILS: &str = r#"/*{
    "ISFVSN": "2", "DESCRIPTION": "Trails of an image", "CREDIT": "somebody", "CATEGORIES": ["Blur"],
    "INPUTS": [
        {"NAME": "inputImage", "TYPE": "image"},
        {"NAME": "decay", "TYPE": "float", "DEFAULT": 0.9, "MIN": 0.0, "MAX": 1.0, "LABEL": "How much stays"},
        {"NAME": "mode", "TYPE": "long", "VALUES": [0, 1, 2], "LABELS": ["a", "b", "c"], "DEFAULT": 1},
        {"NAME": "flash", "TYPE": "event"},
        {"NAME": "inverted", "TYPE": "bool", "DEFAULT": 1},
        {"NAME": "center", "TYPE": "point2D", "DEFAULT": [0.5, 0.25], "MIN": [0, 0], "MAX": [1, 1]},
        {"NAME": "tint", "TYPE": "color", "DEFAULT": [1, 0.5, 0, 1]},
        {"NAME": "mix", "TYPE": "float", "DEFAULT": 2.0, "MIN": 0.0, "MAX": 1.0}
    ],
    "PASSES": [
        {"TARGET": "trail_1", "PERSISTENT": true, "FLOAT": true},
        {"TARGET": "small", "WIDTH": "floor($WIDTH/2.0)", "HEIGHT": "floor($HEIGHT/2.0)"},
        {}
    ]
}*/
void main() {
    vec4 old = IMG_THIS_PIXEL(trail_1);
    if (PASSINDEX == 0) gl_FragColor = old * decay + IMG_NORM_PIXEL(inputImage, isf_FragNormCoord);
    else gl_FragColor = IMG_NORM_PIXEL(small, center) * tint;
}
"#;

#[test]
fn passes_become_buffers_and_inputs_sliders() {
    let project = project(TRAILS);
    assert_eq!(project.dialect, Dialect::Isf);
    assert_eq!((&*project.info.description, &*project.info.author), ("Trails of an image", "somebody"));
    let ids: Vec<&str> = project.passes.iter().map(|pass| pass.id.key()).collect();
    assert_eq!(ids, ["buffer_trail1", "buffer_small", "image"]);
    assert_eq!(project.passes[0].settings.format, TexelFormat::Rgba32f);
    assert_eq!(
        (project.passes[1].settings.format, project.passes[1].settings.size),
        (TexelFormat::Rgba8, PassSize::Sides(Side::Floor(0.5), Side::Floor(0.5)))
    );
    let image = &project.passes[2].bindings;
    let inputs: Vec<&Input> = image.channels().map(|channel| &channel.input).collect();
    assert!(matches!(inputs[0], Input::Media { media: Media::Builtin(_), .. }));
    assert_eq!(inputs[1..], [&Input::buffer("trail1"), &Input::buffer("small")]);
    let uniforms = project.custom_uniforms();
    assert_eq!(uniforms.diagnostics, []);
    let of = |name: &str| uniforms.get(name).unwrap_or_else(|| panic!("{name}"));
    assert_eq!(of("decay").about, "How much stays");
    assert_eq!((of("mode").ty, of("mode").default.components()), (CustomUniformType::Int, vec![1.0]));
    assert_eq!(of("inverted").default.components(), [1.0]);
    assert_eq!(of("center").default.components(), [0.5, 0.25]);
    assert_eq!(of("tint").default.components(), [1.0, 0.5, 0.0, 1.0]);
    // A default widens the range.
    assert_eq!(of("mix").default.components(), [2.0]);
    assert_eq!(image.names().collect::<Vec<_>>(), [(0, "inputImage"), (1, "trail_1"), (2, "small")]);
    let included: Vec<&str> = project.includes.iter().map(|i| &*i.source.name).collect();
    assert_eq!(included, ["a.fs"]);
    assert_eq!(project.include_lines().missing, []);
}

#[test]
fn a_last_pass_with_a_target_is_shown() {
    let project = project(
        "/*{\"PASSES\": [{\"TARGET\": \"state\", \"PERSISTENT\": true}]}*/\nvoid main() { gl_FragColor = IMG_THIS_PIXEL(state); }",
    );
    let ids: Vec<&str> = project.passes.iter().map(|pass| pass.id.key()).collect();
    assert_eq!(ids, ["buffer_state", "image"]);
    let channels = &project.passes[1].bindings;
    assert_eq!(channels.get(0).map(|c| &c.input), Some(&Input::buffer("state")));
    assert!(project.stateful_passes().contains(&PassName::buffer("state")));
}

#[test]
fn audio_is_an_image_with_one_row() {
    let project = project(
        "/*{\"INPUTS\": [{\"NAME\": \"fft\", \"TYPE\": \"audioFFT\", \"MAX\": 64}]}*/\n\
         void main() { gl_FragColor = IMG_NORM_PIXEL(fft, vec2(0.5)); }",
    );
    assert_eq!(project.passes[0].id, PassName::buffer("fft"));
    assert_eq!(project.passes[0].settings.size, PassSize::Fixed(64, 1));
    assert_eq!(project.image().unwrap().bindings.get(0).map(|c| &c.input), Some(&Input::buffer("fft")));
}

#[test]
fn a_vertex_shader_beside_it_is_included_too() {
    let dir = tempfile::tempdir().unwrap();
    fs::write(
        dir.path().join("a.vs"),
        "varying vec2 left;\nvoid main() { isf_vertShaderInit(); left = isf_FragNormCoord; }",
    )
    .unwrap();
    let text = "/*{\"ISFVSN\": \"2\"}*/\nvarying vec2 left;\nvoid main() { gl_FragColor = vec4(left, 0.0, 1.0); }";
    let project = open(dir.path(), "a.fs", text).unwrap().project;
    let mut included: Vec<&str> = project.includes.iter().map(|i| &*i.source.name).collect();
    included.sort_unstable();
    assert_eq!(included, ["a.fs", "a.vs"]);
    assert_eq!(project.main_tab(), Tab::Included("a.fs".into()));
}

#[test]
fn line_comments_may_precede_the_header() {
    let text = "// Somebody\n\n// 2016\n/*{\"ISFVSN\": \"2\"}*/\nvoid main() { gl_FragColor = vec4(1.0); }";
    let (start, json) = json_of(Path::new("a.fs"), text).unwrap();
    assert_eq!((json, &text[start..start + 3]), ("{\"ISFVSN\": \"2\"}", "{\"I"));
    assert_eq!(project(text).dialect, Dialect::Isf);
}

#[test]
fn a_trailing_comma_is_a_warning() {
    let text = "/*{\"CREDIT\": \"a,]\", \"INPUTS\": [{\"NAME\": \"b\", \"TYPE\": \"float\", }, ],}*/\n\
                void main() { gl_FragColor = vec4(b); }";
    let loaded = open(tempfile::tempdir().unwrap().path(), "a.fs", text).unwrap();
    assert_eq!(&*loaded.project.info.author, "a,]");
    assert!(loaded.project.custom_uniforms().get("b").is_some());
    let [warning] = &loaded.warnings[..] else { panic!("{:?}", loaded.warnings) };
    assert!(warning.message.contains("is not JSON"), "{warning:?}");
    assert_eq!(warning.span.map(|span| &text[span.range()]), Some(","));
    assert!(!wrong(&text.replace("[{", "[,{"))[0].0.is_empty());
}

#[test]
fn images_read_by_pixel_have_the_resolution_of_the_picture() {
    let text = "/*{\"INPUTS\": [{\"NAME\": \"inputImage\", \"TYPE\": \"image\"}]}*/\n\
                void main() { gl_FragColor = IMG_PIXEL(inputImage, gl_FragCoord.xy); }";
    let scaled = project(text);
    assert_eq!(scaled.passes[0].id, PassName::buffer("inputimage"));
    assert_eq!(scaled.passes[0].settings.size, PassSize::Canvas);
    let of = |project: &Project, n: usize| project.passes[n].bindings.get(0).map(|c| c.input.clone());
    assert!(matches!(of(&scaled, 0), Some(Input::Media { media: Media::Builtin(_), .. })));
    assert_eq!(of(&scaled, 1), Some(Input::buffer("inputimage")));
    let plain = project(&text.replace("IMG_PIXEL(inputImage, gl_FragCoord.xy)", "IMG_THIS_PIXEL(inputImage)"));
    assert!(matches!(of(&plain, 0), Some(Input::Media { media: Media::Builtin(_), .. })));
}

#[test]
fn image_uniforms_are_declared_and_keywords_renamed() {
    let project = project(
        "/*{\"INPUTS\": [{\"NAME\": \"left\", \"TYPE\": \"image\"}, {\"NAME\": \"smooth\", \"TYPE\": \"float\"}]}*/\n\
         void mainImage(out vec4 c) { c = IMG_NORM_PIXEL(left, _left_imgRect.zw / _left_imgSize); }\n\
         void main() { mainImage(gl_FragColor); gl_FragColor *= smooth; }",
    );
    let image = project.image().unwrap();
    let text = &*image.source.text;
    let line = "vec4 _left_imgRect = vec4(vec2(0.0), IMG_SIZE(left));";
    assert!(text.lines().any(|known| known == line), "{text}");
    assert!(!text.contains("_left_flip"));
    assert!(project.custom_uniforms().get("isf_smooth").is_some());
}

#[test]
fn header_errors_have_a_span() {
    let file =
        |header: &str| format!("/*{header}*/\nvoid main() {{ gl_FragColor = vec4(isf_FragNormCoord, a, 1.0); }}");
    let said = wrong(&file("{\"INPUTS\": [ , ]}"));
    assert!(said[0].0.contains("cannot be read"), "{said:?}");
    let said = wrong(&file("{\"INPUTS\": [{\"NAME\": \"a\", \"TYPE\": \"number\"}]}"));
    assert_eq!(said, [("the input \"a\" has the unknown type \"number\"".to_owned(), "\"number\"".to_owned())]);
    let said = wrong(&file("{\"INPUTS\": [{\"NAME\": \"a b\", \"TYPE\": \"float\"}]}"));
    assert!(said[0].0.contains("not a name"), "{said:?}");
    let said = wrong(&file("{\"PASSES\": [{\"TARGET\": \"a_b\"}, {\"TARGET\": \"ab\"}, {}]}"));
    assert!(said[0].0.contains("two passes draw"), "{said:?}");
    let size = "\"WIDTH\": \"$WIDTH*$HEIGHT\", \"HEIGHT\": \"1\"";
    let said = wrong(&file(&format!("{{\"PASSES\": [{{\"TARGET\": \"row\", {size}}}, {{}}]}}")));
    assert!(said[0].0.contains("the size of pass 0 is not supported"), "{said:?}");
    let inputs: Vec<String> = (0..17).map(|n| format!("{{\"NAME\": \"a{n}\", \"TYPE\": \"image\"}}")).collect();
    let reads = "/*{\"INPUTS\": [".to_owned()
        + &inputs.join(", ")
        + "]}*/\nvoid main() { gl_FragColor = vec4(0.0)"
        + &(0..17).map(|n| format!(" + IMG_THIS_PIXEL(a{n})")).collect::<String>()
        + "; }";
    assert!(wrong(&reads)[0].0.contains("reads 17 images"));
    // Images that the text does not read use no channel.
    let sixteen = project(&reads.replace(" + IMG_THIS_PIXEL(a16)", ""));
    assert_eq!(sixteen.image().unwrap().bindings.iter().count(), 16);
}

#[test]
fn texts_with_other_comments_are_not_isf() {
    for text in [
        "/* a shader */ void main() { gl_FragColor = vec4(1.0); }",
        "/*{\"INPUTS\": []}*/\nvoid mainImage(out vec4 c, in vec2 p) { c = vec4(1.0); }",
        "/*{\"INPUTS\": []}",
        "// {\"INPUTS\": []}",
        "",
    ] {
        assert!(json_of(Path::new("a.fs"), text).is_none(), "{text}");
    }
}

#[test]
fn an_empty_header_needs_the_isf_extension() {
    let of = |name: &str, text: &str| ShaderForm::of(Path::new(name), text);
    let text = "/* { } */\nvoid main() { gl_FragColor = vec4(1.0); }";
    assert_eq!(
        (of("a.fs", text), of("a.glsl", text)),
        (ShaderForm::Program(Dialect::Isf), ShaderForm::Program(Dialect::Plain))
    );
    assert_eq!(project(text).dialect, Dialect::Isf);
    assert_eq!(of("a.glsl", &text.replace("{ }", "{\"CREDIT\": \"\"}")), ShaderForm::Program(Dialect::Isf));
    assert_eq!(
        of("a.fs", "/* { a } */\nvoid main() { gl_FragColor = vec4(1.0); }"),
        ShaderForm::Program(Dialect::Plain)
    );
}

#[test]
fn an_import_without_a_path_is_not_a_cubemap() {
    let loaded = |import: &str| {
        let text = format!(
            "/*{{\"IMPORTED\": {{\"buf\": {import}}}}}*/\nvoid main() {{ gl_FragColor = vec4(textureSize(buf, 0), 0, 1); }}"
        );
        open(tempfile::tempdir().unwrap().path(), "a.fs", &text).unwrap()
    };
    for (import, said, kind) in [
        ("{\"PASSINDEX\": 0}", "the imported image \"buf\" has no PATH", InputKind::Texture),
        ("{\"PATH\": [\"a.png\"]}", "is a cubemap of several files", InputKind::Cubemap),
    ] {
        let loaded = loaded(import);
        let [warning] = &loaded.warnings[..] else { panic!("{:?}", loaded.warnings) };
        assert!(!warning.is_error() && warning.message.contains(said), "{warning:?}");
        let channel = loaded.project.image().unwrap().bindings.get(0).unwrap().clone();
        assert_eq!(channel.input.row().kind, kind);
    }
}

#[test]
fn saving_writes_the_edited_file() {
    let dir = tempfile::tempdir().unwrap();
    let mut project = open(dir.path(), "a.fs", TRAILS).unwrap().project;
    let file = dir.path().join("a.fs");
    let tab = Tab::Included("a.fs".into());
    let edited = TRAILS.replace("* tint", "+ tint");
    project.source_mut(&tab).unwrap().text = edited.clone().into();
    project.includes[0].is_edited = true;
    let saved = save(&project, &file, Overwrite::Refuse).unwrap();
    assert_eq!(fs::read_to_string(&file).unwrap(), edited);
    assert_eq!(saved.source(&tab).map(|s| &*s.text), Some(&*edited));
    assert_eq!(fs::read_dir(dir.path()).unwrap().count(), 1);
    let mut other = project.clone();
    other.source_mut(&Tab::Common).unwrap().text = "// mine".into();
    assert!(matches!(save(&other, &file, Overwrite::Refuse), Err(ProjectError::CannotHold { .. })));
    let mut other = project.clone();
    other.info.description = "mine".into();
    assert!(matches!(save(&other, &file, Overwrite::Refuse), Err(ProjectError::CannotHold { .. })));
    project.custom_uniform_values.insert("decay".into(), crate::CustomUniformValue::Float(0.5));
    assert!(matches!(save(&project, &file, Overwrite::Refuse), Err(ProjectError::CannotHold { .. })));
    // As a folder it is an ordinary project that contains the file.
    let folder = dir.path().join("as_folder");
    let moved = save(&project, &folder, Overwrite::Refuse).unwrap();
    assert_eq!(moved.dialect, Dialect::Isf);
    assert_eq!(load(folder.to_str().unwrap()).unwrap().project.passes.len(), 3);
}
