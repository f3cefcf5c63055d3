use super::*;
use crate::{CustomUniformValue, Media, TexelFormat, load};
use std::fs;

/// Returns the project of a file, and its conversion.
fn converted(name: &str, text: &str) -> Result<Converted, ConversionError> {
    let dir = tempfile::tempdir().unwrap();
    let path = dir.path().join(name);
    fs::write(&path, text).unwrap();
    to_shadertoy(&load(&path.display().to_string()).unwrap().project)
}

/// Returns the converted text of Image.
fn image(name: &str, text: &str) -> String {
    converted(name, text).unwrap().project.image().unwrap().source.text.to_string()
}

#[test]
fn uniforms_are_set_before_the_text_runs() {
    let text = "#version 300 es\nprecision highp float;\nuniform float u_time; // seconds\nuniform vec2 u_resolution;\n\
                uniform vec2 u_mouse;\nout vec4 color;\nfloat half_of(float u_time) { return u_time * 0.5; }\n\
                void main() {\n    color = vec4(gl_FragCoord.xy / u_resolution, half_of(u_time), 1.0);\n}\n";
    let expected = "\
// Image of a.frag, a shader for glslViewer, The Book of Shaders, glslCanvas, glslEditor.

float u_time;
vec2 u_resolution;
vec4 color = vec4(0.0);

void setInputs() {
    u_time = iTime;
    u_resolution = iResolution.xy;
}

// #version 300 es
 // seconds
float half_of(float u_time) { return u_time * 0.5; }
void drawPixel() {
    color = vec4(gl_FragCoord.xy / u_resolution, half_of(u_time), 1.0);
}

void mainImage(out vec4 fragColor, in vec2 fragCoord) {
    setInputs();
    drawPixel();
    fragColor = color;
    fragColor = vec4(fragColor.rgb * clamp(fragColor.a, 0.0, 1.0), 1.0);
}
";
    assert_eq!(image("a.frag", text), expected);
}

#[test]
fn textures_become_channels_and_feedback_a_buffer() {
    let text = "uniform sampler2D backbuffer, other;\nuniform vec2 resolution, otherResolution;\nuniform float time;\n\
                struct S { float other; };\nvoid main() {\n    S s = S(1.0);\n    gl_FragColor = s.other * \
                texture2D(backbuffer, gl_FragCoord.xy / resolution) + texture2D(other, otherResolution);\n}\n";
    let made = converted("a.frag", text).unwrap().project;
    let names: Vec<String> = made.passes.iter().map(|pass| pass.id.title()).collect();
    assert_eq!(names, ["Buffer A", "Image"]);
    let buffer = &made.passes[0];
    assert_eq!(buffer.bindings.get(0).unwrap().input, Input::buffer("A"));
    assert!(matches!(buffer.bindings.get(1).unwrap().input.media(), Some(Media::Builtin(_))));
    assert_eq!((buffer.bindings.names().count(), buffer.settings.format), (0, TexelFormat::Rgba8));
    let body = "s.other * texture(iChannel0, gl_FragCoord.xy / resolution) + texture(iChannel1, otherResolution);";
    assert!(buffer.source.text.contains(body), "{}", buffer.source.text);
    assert!(buffer.source.text.contains("otherResolution = vec2(textureSize(iChannel1, 0).xy);"));
    assert!(buffer.source.text.contains("struct S { float other; };"));
    assert_eq!(made.passes[1].bindings.get(0).unwrap().input, Input::buffer("A"));
}

#[test]
fn sliders_keep_their_values() {
    let dir = tempfile::tempdir().unwrap();
    let path = dir.path().join("a.frag");
    fs::write(&path, "uniform float u_time;\nuniform float sample; // how much\nuniform mat2 m;\nvoid main() { gl_FragColor = vec4(sample * u_time); }").unwrap();
    let mut project = load(&path.display().to_string()).unwrap().project;
    project.custom_uniform_values.insert("sample".into(), CustomUniformValue::Float(0.25));
    let made = to_shadertoy(&project).unwrap().project;
    let text = &made.image().unwrap().source.text;
    assert!(text.contains("#iUniform float sample_ = 0.25 in { 0.0, 1.0 } // how much\n"), "{text}");
    assert!(text.contains("vec4(sample_ * u_time)") && !text.contains("mat2"), "{text}");
    let sliders = made.custom_uniforms().list;
    assert_eq!((sliders.len(), &sliders[0].default), (1, &CustomUniformValue::Float(0.25)));
    assert!(made.custom_uniform_values.is_empty());
}

#[test]
fn globals_that_are_not_constant_are_set_where_their_conditions_hold() {
    let text = "uniform float time;\nuniform vec2 resolution;\n#define T (time * 2.0)\nconst float a = 1.0, b = T;\n\
                #ifdef X\nfloat c = 2.0;\n#else\nfloat c = b + a;\n#endif\nvoid main() { gl_FragColor = vec4(c); }\n";
    let made = image("a.frag", text);
    assert!(made.contains(" float a = 1.0, b;\n#ifdef X\nfloat c = 2.0;\n#else\nfloat c;\n#endif\n"), "{made}");
    assert!(made.contains("    b = T;\n#ifdef X\n#else\n    c = b + a;\n#endif\n}\n"), "{made}");
    assert!(made.contains("    setInputs();\n    setGlobals();\n    drawPixel();\n"), "{made}");
}

#[test]
fn discarded_pixels_have_the_colour_of_the_cleared_target() {
    let text = "uniform float time;\nuniform vec2 resolution;\nfloat f(float x) { if (x > 0.5) discard; return x; }\n\
                void main() { if (time > f(0.2)) discard; else gl_FragColor = vec4(1.0); }\n";
    let made = image("a.frag", text);
    assert!(made.contains("if (x > 0.5) { isDiscarded = true; return 0.0; } return x;"), "{made}");
    assert!(made.contains("if (time > f(0.2)) { isDiscarded = true; return; } else pixelColor"), "{made}");
    assert!(made.contains("    if (isDiscarded) fragColor = vec4(0.0, 0.0, 0.0, 0.0);\n"), "{made}");
}

#[test]
fn what_shadertoy_lacks_is_refused() {
    let names = ["a", "b", "c", "d", "e"];
    let declared: String = names.map(|name| format!("uniform sampler2D tex_{name};\n")).concat();
    let read = names.map(|name| format!("texture2D(tex_{name}, vec2(0.5))")).join(" + ");
    let text = format!("{declared}uniform float u_time;\nvoid main() {{ gl_FragColor = {read}; }}\n");
    let error = converted("a.frag", &text).unwrap_err().to_string();
    assert_eq!(
        error,
        "Image reads 5 textures, and a pass of Shadertoy at most 4: tex_a, tex_b, tex_c, tex_d and tex_e"
    );
    let own = Project::of_image("a".into(), "void mainImage(out vec4 o, vec2 p) { o = vec4(1); }".into());
    assert_eq!(to_shadertoy(&own), Err(ConversionError::IsShadertoy));
}
