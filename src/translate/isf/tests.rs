use super::{IsfFile, isf};
use eddy_diag::Diagnostic;
use eddy_project::{
    Channel, Input, InputKind, Media, Origin, Pass, PassName, PassSize, Project, Sampler, Source, TexelFormat, Wrap,
};

fn pass(id: PassName, text: &str, reads: &[Input]) -> Pass {
    let mut pass = Pass::new(id.clone(), Source { name: id.key().to_owned(), path: None, text: text.into() });
    for (n, input) in reads.iter().enumerate() {
        pass.bindings.set(n, Some(Channel { sampler: Sampler::BUFFER, ..Channel::new(input.clone()) }));
    }
    pass
}

fn project(passes: Vec<Pass>) -> Project {
    Project::new("glow", passes, Origin::Unsaved)
}

fn image(text: &str) -> Project {
    project(vec![pass(PassName::image(), text, &[])])
}

fn written(project: &Project) -> IsfFile {
    isf(project).unwrap_or_else(|found| panic!("{found:?}"))
}

fn header(file: &IsfFile) -> serde_json::Value {
    let json = file.text.strip_prefix("/*").unwrap().split_once("*/").unwrap().0;
    serde_json::from_str(json).unwrap_or_else(|e| panic!("{e}: {json}"))
}

fn refused(project: &Project) -> Vec<String> {
    let found: Vec<Diagnostic> = isf(project).expect_err("an error");
    found.into_iter().filter(Diagnostic::is_error).map(|d| d.message).collect()
}

#[test]
fn an_image_pass_keeps_its_text() {
    let text = "#iUniform float speed = 2.0 in { 0.0, 5.0 } // how fast\n#iUniform color3 tint = color3(1.0, 0.5, 0.0)\n\
                #iUniform vec3 turn = vec3(1.0)\n#iUniform int rings = 2 in { 1, 4 }\n\
                void mainImage(out vec4 c, in vec2 p) { c = vec4(tint * turn * sin(iTime * speed), float(rings)); }";
    let file = written(&image(text));
    let header = header(&file);
    assert_eq!(header["DESCRIPTION"], "glow");
    let inputs = header["INPUTS"].as_array().unwrap();
    let of =
        |name: &str| inputs.iter().find(|input| input["NAME"] == name).unwrap_or_else(|| panic!("{name}: {inputs:?}"));
    assert_eq!((of("speed")["DEFAULT"].as_f64(), of("speed")["MAX"].as_f64()), (Some(2.0), Some(5.0)));
    assert_eq!(of("speed")["LABEL"], "how fast");
    assert_eq!(of("tint_rgba")["DEFAULT"], serde_json::json!([1.0, 0.5, 0.0, 1.0]));
    assert_eq!(of("turn_y")["TYPE"], "float");
    assert_eq!(of("rings")["VALUES"], serde_json::json!([1, 2, 3, 4]));
    assert!(header.get("PASSES").is_none());
    for line in
        ["#define iTime TIME", "#define tint tint_rgba.rgb", "mainImage(color, gl_FragCoord.xy); color.a = 1.0;"]
    {
        assert!(file.text.contains(line), "{line}\n{}", file.text);
    }
    assert!(!file.text.contains("iMouse") && !file.text.contains("#iUniform"));
    assert_eq!(file.diagnostics, []);
}

#[test]
fn buffers_become_named_passes() {
    let buffer = "#define RATE 0.9\nfloat at(float x) { return x * RATE; }\n\
                  void mainImage(out vec4 c, in vec2 p) { c = texelFetch(iChannel0, ivec2(p), 0) + at(1.0); }";
    let shown = "float at(float x) { return x; }\nvoid mainImage(out vec4 c, in vec2 p) {\n\
                 c = texture(iChannel0, p / iChannelResolution[0].xy) + at(0.0); // texture(iChannel3, p)\n}";
    let id = PassName::buffer("A");
    let mut state = pass(id.clone(), buffer, &[Input::pass(id.clone())]);
    (state.settings.size, state.settings.format) = (PassSize::Scale(0.5), TexelFormat::Rgba16f);
    let file = written(&project(vec![state, pass(PassName::image(), shown, &[Input::pass(id)])]));
    let header = header(&file);
    let first = &header["PASSES"][0];
    assert_eq!(
        (&first["TARGET"], &first["PERSISTENT"], &first["FLOAT"]),
        (&"buffer_a".into(), &true.into(), &true.into())
    );
    assert_eq!(first["WIDTH"], "max(floor($WIDTH*0.5+0.5),1.0)");
    assert_eq!(header["PASSES"][1], serde_json::json!({}));
    for part in [
        "#define at buffer_a_at",
        "#define at image_at",
        "#undef RATE",
        "c = IMG_PIXEL(buffer_a, vec2(ivec2(p)) + 0.5) + at(1.0);",
        "c = IMG_NORM_PIXEL(buffer_a, p / vec3(IMG_SIZE(buffer_a), 1.0).xy) + at(0.0); // texture(iChannel3, p)",
        "if (PASSINDEX == 1) { image_mainImage(color, gl_FragCoord.xy); color.a = 1.0; }",
    ] {
        assert!(file.text.contains(part), "{part}\n{}", file.text);
    }
}

#[test]
fn images_are_imported_or_inputs() {
    let text = "void mainImage(out vec4 c, in vec2 p) { c = texture(iChannel0, p) + textureLod(iChannel1, p, 2.0); }";
    let file = Input::texture(Media::File("pics/a.png".into()));
    let mut shown = pass(PassName::image(), text, &[file, Input::texture(Media::Builtin("marble".into()))]);
    shown.bindings.get_mut(0).unwrap().sampler.wrap = Wrap::Repeat;
    let file = written(&project(vec![shown]));
    let header = header(&file);
    assert_eq!(header["IMPORTED"]["image0"]["PATH"], "pics/a.png");
    assert_eq!(header["INPUTS"], serde_json::json!([{ "NAME": "inputImage", "TYPE": "image" }]));
    assert!(
        file.text.contains("c = IMG_NORM_PIXEL(image0, fract(p)) + IMG_NORM_PIXEL(inputImage, p);"),
        "{}",
        file.text
    );
    let said: Vec<&str> = file.diagnostics.iter().map(|d| &*d.message).collect();
    assert!(
        said.iter().any(|m| m.contains("the host gives this image")) && said.iter().any(|m| m.contains("mip levels")),
        "{said:?}"
    );
}

#[test]
fn features_that_isf_lacks_are_errors() {
    let text = "void mainImage(out vec4 c, in vec2 p) { c = texture(iChannel0, p); }";
    let reads = |text: &str, input: Input| refused(&project(vec![pass(PassName::image(), text, &[input])]));
    assert!(reads(text, Input::KEYBOARD)[0].contains("reads Keyboard"));
    assert!(reads(text, Input::Device(InputKind::Microphone))[0].contains("reads Microphone"));
    assert!(refused(&image(text))[0].contains("has no input"));
    let handed = "vec4 f(sampler2D s, vec2 p) { return texture(s, p); }\nvoid mainImage(out vec4 c, in vec2 p) { c = f(iChannel0, p); }";
    let marble = || Input::texture(Media::Builtin("marble".into()));
    assert!(reads(handed, marble())[0].contains("handed to a function"));
    let grad = text.replace("texture(iChannel0, p)", "textureGrad(iChannel0, p, p, p)");
    assert!(reads(&grad, marble())[0].contains("no `textureGrad`"));
    assert!(refused(&image("void mainImage(out vec4 c, in vec2 p) { c = vec4(x); }"))[0].contains("`x`"));
    let short = "float r(float x) { return x; }\nvoid mainImage(out vec4 c, in vec2 p) { c = vec4(r(1.0)); }";
    let two = project(vec![pass(PassName::buffer("A"), short, &[]), pass(PassName::image(), short, &[])]);
    assert!(refused(&two)[0].contains("components of a vector"));
    let cube = pass(
        PassName::cube(),
        "void mainCubemap(out vec4 c, in vec2 p, in vec3 o, in vec3 d) { c = vec4(d, 1.0); }",
        &[],
    );
    let plain = "void mainImage(out vec4 c, in vec2 p) { c = vec4(1.0); }";
    assert!(refused(&project(vec![cube, pass(PassName::image(), plain, &[])]))[0].contains("no cubemap pass"));
}
