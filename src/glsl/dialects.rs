//! Recognises shaders written for other tools by identifiers that only those tools use, so that one message names the
//! tool instead of many about unknown identifiers.
//!
//! Contains the table of tools and [`name`], which is called only for texts that do not compile: a text that compiles
//! is accepted whatever tool it was written for. A text that defines the entry point of its pass is taken for a
//! Shadertoy shader, whatever other names it uses.

use super::{
    PassKind,
    source::{PassSource, Text},
};
use eddy_diag::{Diagnostic, Span};

/// A tool, the identifiers that its shaders are recognised by, and hints for porting one.
struct Dialect {
    /// Completes "this is ...".
    is: &'static str,
    /// At least one of these words is in the text, outside comments.
    any: &'static [&'static str],
    /// All of these are in the text as well.
    all: &'static [&'static str],
    hints: &'static [&'static str],
}

const ENTRY: &str = "write `void mainImage(out vec4 fragColor, in vec2 fragCoord)` in place of `void main()`, with \
    fragColor for gl_FragColor and fragCoord for gl_FragCoord.xy";
const NOT_GLSL: &str = "write the shader in GLSL ES 3.00, with \
    `void mainImage(out vec4 fragColor, in vec2 fragCoord)` as its entry point";
const SLIDER: &str = "for other inputs use a slider: `#iUniform float level = 0.5 in { 0.0, 1.0 }`";

/// The more certain ones first. A word with characters other than letters is searched for literally.
const DIALECTS: &[Dialect] = &[
    Dialect {
        is: "an ISF shader, whose inputs are in the JSON header",
        any: &["isf_FragNormCoord", "IMG_NORM_PIXEL", "IMG_THIS_PIXEL", "IMG_THIS_NORM_PIXEL", "IMG_PIXEL", "IMG_SIZE"],
        all: &[],
        hints: ISF,
    },
    Dialect {
        is: "WGSL, not GLSL",
        any: &["@fragment", "@vertex", "@compute", "@group(", "var<uniform>", "-> @location", "vec4<f32>", "vec2<f32>"],
        all: &[],
        hints: &[NOT_GLSL],
    },
    Dialect { is: "a shader of Godot", any: &["shader_type"], all: &[], hints: &[NOT_GLSL, GODOT] },
    Dialect {
        is: "Metal, not GLSL",
        any: &["metal_stdlib", "[[stage_in]]", "[[position]]", "[[buffer("],
        all: &[],
        hints: &[NOT_GLSL],
    },
    Dialect {
        is: "an effect of ReShade, in HLSL",
        any: &["ReShade.fxh", "ReShade::BackBuffer", "ReShade::GetLinearizedDepth"],
        all: &[],
        hints: &[NOT_GLSL],
    },
    Dialect {
        is: "a shader of Unity, in HLSL",
        any: &[
            "CGPROGRAM",
            "HLSLPROGRAM",
            "CGINCLUDE",
            "HLSLINCLUDE",
            "UnityCG.cginc",
            "SubShader",
            "UnityObjectToClipPos",
        ],
        all: &[],
        hints: &[NOT_GLSL],
    },
    Dialect {
        is: "HLSL, not GLSL",
        any: &[
            "SV_Target",
            "SV_Target0",
            "SV_TARGET",
            "SV_TARGET0",
            "SV_Position",
            "SV_POSITION",
            "cbuffer",
            "SamplerState",
            "Texture2D",
        ],
        all: &[],
        hints: &[NOT_GLSL],
    },
    Dialect {
        is: "a shader of RetroArch",
        any: &[
            "#pragma stage",
            "#pragma parameter",
            "#pragma format",
            "#pragma name",
            "COMPAT_TEXTURE",
            "COMPAT_VARYING",
            "OriginalSize",
            "SourceSize",
            "push_constant",
        ],
        all: &[],
        hints: &[ENTRY, "its Source is an image: `#iChannel0 \"file://pic.png\"`, read with texture(iChannel0, uv)"],
    },
    Dialect {
        is: "a shader of mpv",
        any: &["HOOKED_tex", "HOOKED_pos", "HOOKED_texOff", "HOOKED_raw"],
        all: &[],
        hints: &[ENTRY, PICTURE],
    },
    Dialect {
        is: "a shader of TouchDesigner",
        any: &["sTD2DInputs", "TDOutputSwizzle", "TDInstanceID", "uTD2DInfos"],
        all: &[],
        hints: &[ENTRY, PICTURE],
    },
    Dialect { is: "a shader of OBS Studio, in HLSL", any: &["ViewProj"], all: &["technique"], hints: &[NOT_GLSL] },
    Dialect {
        is: "a shader of Bonzomatic",
        any: &["v2Resolution", "fGlobalTime", "texFFTSmoothed", "texFFTIntegrated", "texPreviousFrame"],
        all: &[],
        hints: &[ENTRY, "fGlobalTime is iTime, v2Resolution is iResolution.xy; there is no FFT of a sound yet"],
    },
    Dialect {
        is: "a shader of KodeLife",
        any: &["VertexData", "inData", "v_texcoord"],
        all: &["spectrum"],
        hints: &[ENTRY, "time is iTime, resolution is iResolution.xy, mouse is iMouse; there is no spectrum yet"],
    },
    Dialect {
        is: "a shader of Kodi's interface",
        any: &["m_unicol", "m_cord0", "m_samp0", "m_attrpos"],
        all: &[],
        hints: &[ENTRY, PICTURE],
    },
    Dialect {
        is: "a window shader of picom",
        any: &["window_shader"],
        all: &[],
        hints: &[
            "write `void mainImage(out vec4 fragColor, in vec2 fragCoord)` in place of `vec4 window_shader()`",
            PICTURE,
        ],
    },
    Dialect {
        is: "a shader of LÖVE",
        any: &["texture_coords", "screen_coords", "love_ScreenSize", "VaryingTexCoord"],
        all: &["effect"],
        hints: &[
            "write `void mainImage(out vec4 fragColor, in vec2 fragCoord)` in place of `vec4 effect(..)`",
            PICTURE,
        ],
    },
    Dialect {
        is: "a shader of GameMaker",
        any: &["gm_BaseTexture", "v_vTexcoord", "v_vColour"],
        all: &[],
        hints: &[ENTRY, PICTURE],
    },
    Dialect {
        is: "a shader of three.js",
        any: &[
            "vUv",
            "modelViewMatrix",
            "projectionMatrix",
            "cameraPosition",
            "viewMatrix",
            "normalMatrix",
            "tDiffuse",
            "vNormal",
            "vPosition",
            "diffuseColor",
        ],
        all: &["main"],
        hints: &[
            ENTRY,
            "vUv is fragCoord / iResolution.xy, its time iTime; varyings of a mesh need a pass that draws one",
        ],
    },
    Dialect {
        is: "a shader of glslViewer or The Book of Shaders",
        any: &["u_resolution", "u_time", "u_mouse"],
        all: &[],
        hints: &[ENTRY, "u_time is iTime, u_resolution is iResolution.xy, u_mouse is iMouse.xy"],
    },
    Dialect {
        is: "a shader of GLSL Sandbox",
        any: &["resolution", "surfacePosition", "backbuffer"],
        all: &["main", "time"],
        hints: &[ENTRY, "time is iTime, resolution is iResolution.xy, mouse is iMouse.xy / iResolution.xy"],
    },
    Dialect {
        is: "a shader of twigl",
        any: &["FC"],
        all: &["r", "t"],
        hints: &[
            "wrap it in `void mainImage(out vec4 o, in vec2 fragCoord) { .. }`, with fragCoord for FC, iTime for t \
             and iResolution.xy for r",
        ],
    },
    // Last, because shaders of other tools have a `#version` and a `main` as well.
    Dialect {
        is: "a plain fragment shader, with a version and a `main` of its own",
        any: &["#version"],
        all: &["main"],
        hints: &[ENTRY, "delete the lines of `#version`, `in` and `out`"],
    },
];

/// Files that are recognised whatever entry point they have.
const ANY_ENTRY: &[Dialect] = &[
    Dialect {
        is: "a pointer of Git LFS in place of the file",
        any: &["version https://git-lfs.github.com"],
        all: &[],
        hints: &["fetch the file with `git lfs pull`"],
    },
    Dialect {
        is: "a web page, not a shader",
        any: &["<!DOCTYPE", "<!doctype", "<html", "<HTML", "<head>", "<body"],
        all: &[],
        hints: &["save the shader itself: copy its text from the page"],
    },
    Dialect {
        is: "a shader of OBS Studio, in HLSL",
        any: &["VertData", "textureSampler"],
        all: &[],
        hints: &[NOT_GLSL],
    },
    Dialect {
        is: "a shader of KDE's wallpaper plugin that reads the windows",
        any: &["iWindowCount", "iWindows"],
        all: &[],
        hints: &["declare `#iUniform int iWindowCount = 0 in { 0, 8 }` to draw it without windows"],
    },
];

const ISF: &[&str] = &[
    "save it with the ending .fs, and open that: Eddy reads ISF",
    ENTRY,
    "isf_FragNormCoord is fragCoord / iResolution.xy, TIME is iTime, RENDERSIZE is iResolution.xy",
    "an input becomes a slider: `#iUniform float level = 0.5 in { 0.0, 1.0 }`",
];
const GODOT: &str = "UV is fragCoord / iResolution.xy, TIME is iTime, COLOR is fragColor";
const PICTURE: &str = "its input is an image: `#iChannel0 \"file://pic.png\"`, read with texture(iChannel0, uv)";

/// Uniforms of Ghostty's custom shaders, which are Shadertoy programs apart from these.
const GHOSTTY: [&str; 20] = [
    "iCurrentCursor",
    "iPreviousCursor",
    "iCurrentCursorColor",
    "iPreviousCursorColor",
    "iCurrentCursorStyle",
    "iPreviousCursorStyle",
    "iCursorVisible",
    "iTimeCursorChange",
    "iTimeFocus",
    "iFocus",
    "iPalette",
    "iBackgroundColor",
    "iForegroundColor",
    "iCursorColor",
    "iCursorText",
    "iSelectionForegroundColor",
    "iSelectionBackgroundColor",
    "CURSORSTYLE_BLOCK",
    "CURSORSTYLE_BAR",
    "CURSORSTYLE_UNDERLINE",
];

/// Returns one message for a text that did not compile because it was written for another tool; `None` for any other
/// text.
pub(super) fn name(source: &PassSource<'_>, found: &[Diagnostic]) -> Option<Diagnostic> {
    let entry = match source.kind {
        // The text of the file is included.
        PassKind::Main(_) => {
            let file = source.includes.iter().filter(|include| include.line.source == source.code.id);
            let code = file.filter_map(|include| include.text.ok()).next_back().unwrap_or(source.code);
            return name_of_main(code, found);
        }
        PassKind::Image | PassKind::Buffer => "mainImage",
        PassKind::Cubemap => "mainCubemap",
        PassKind::Sound => "mainSound",
        PassKind::Vertex | PassKind::Fragment | PassKind::PlainVertex | PassKind::PlainFragment => return None,
    };
    let first = found.iter().find(|d| d.is_error())?;
    let words = StrippedText::of(source.code.text);
    let span = |at: usize, len: usize| Span::new(source.code.id, at..at + len);
    let named = |is: &str, span: Span, hints: &[&str]| message(is, span, hints, first);
    if let Some((dialect, at)) = find(&words, ANY_ENTRY) {
        return Some(named(dialect.is, span(at, 1), dialect.hints));
    }
    if words.place(entry).is_some() {
        let unknown = |name: &&str| found.iter().any(|d| d.is_error() && d.message.contains(&format!("`{name}`")));
        let name = GHOSTTY.iter().copied().filter(unknown).min_by_key(|name| words.place(name))?;
        let place = words.place(name)?;
        let hints = [
            "open it with a stand-in terminal: eddy --as ghostty FILE",
            "or give it a value: `#iUniform vec4 iCurrentCursor = vec4(200.0, 200.0, 10.0, 20.0)` is one, and \
             `#iUniform float iTimeCursorChange = 0.0` another",
        ];
        let is = format!("a custom shader of Ghostty: `{name}` is a uniform set by the terminal");
        return Some(named(&is, span(place, name.len()), &hints));
    }
    if let Some(range) = isf_header(source.code) {
        let is = DIALECTS.first().map_or("an ISF shader", |isf| isf.is);
        return Some(named(is, span(range.start, range.len()), ISF));
    }
    if let Some(hook) = mpv_hook(source.code.text) {
        return Some(named("a shader of mpv", span(hook.start, hook.len()), &[ENTRY, PICTURE]).hint(SLIDER));
    }
    let (dialect, at) = find(&words, DIALECTS)?;
    let len = dialect.any.iter().filter(|word| words.place(word) == Some(at)).map(|word| word.len()).max()?;
    // Shaders that are ported by their entry point also need sliders for their inputs; WGSL and the like get one hint.
    let mut named = named(dialect.is, span(at, len), dialect.hints);
    if dialect.hints.contains(&ENTRY) {
        named = named.hint(SLIDER);
    }
    Some(named)
}

/// Does the same for a complete fragment shader, which may be of a tool whose textures and stages Eddy does not have.
fn name_of_main(code: Text<'_>, found: &[Diagnostic]) -> Option<Diagnostic> {
    let first = found.iter().find(|d| d.is_error())?;
    let words = StrippedText::of(code.text);
    let drawn = ["glslViewer", "GLSL Sandbox", "Bonzomatic", "twigl", "ISF", "plain"];
    let (dialect, at) = find(&words, ANY_ENTRY)
        .or_else(|| find(&words, DIALECTS))
        .filter(|(dialect, _)| !drawn.iter().any(|name| dialect.is.contains(name)))?;
    let hints: Vec<&str> = dialect.hints.iter().copied().filter(|hint| *hint != ENTRY).collect();
    Some(message(dialect.is, Span::new(code.id, at..at + 1), &hints, first))
}

/// Returns the message that names a tool, with the first error that the compiler reported.
fn message(is: &str, span: Span, hints: &[&str], first: &Diagnostic) -> Diagnostic {
    let mut diagnostic = Diagnostic::error(span, format!("this is {is}"));
    diagnostic.hints.extend(hints.iter().map(|&hint| hint.to_owned()));
    if let Some(at) = first.span.filter(|at| at.range() != span.range()) {
        diagnostic = diagnostic.label(at, first.message.clone());
    }
    diagnostic
}

/// Returns the first tool of a table whose words are in a text, and the place of the first of them.
fn find<'t>(words: &StrippedText, table: &'t [Dialect]) -> Option<(&'t Dialect, usize)> {
    table.iter().find_map(|dialect| {
        let at = dialect.any.iter().filter_map(|word| words.place(word)).min()?;
        dialect.all.iter().all(|word| words.place(word).is_some()).then_some((dialect, at))
    })
}

/// Returns the range of the first line of an ISF shader's JSON header, the comment at the start of its text.
fn isf_header(code: Text<'_>) -> Option<std::ops::Range<usize>> {
    let text = code.text.trim_start_matches('\u{feff}').trim_start();
    let json = text.strip_prefix("/*")?;
    let json = &json[..json.find("*/")?];
    let keys = ["\"ISFVSN\"", "\"INPUTS\"", "\"PASSES\"", "\"IMPORTED\"", "\"CATEGORIES\""];
    let is_isf = json.trim_start().starts_with('{') && keys.iter().any(|key| json.contains(key));
    let start = code.text.len() - text.len();
    is_isf.then(|| start..start + text.lines().next().map_or(0, str::len))
}

/// Returns the range of the first `//!HOOK` line, which every mpv shader has: its function names come from it.
fn mpv_hook(text: &str) -> Option<std::ops::Range<usize>> {
    let mut start = 0;
    text.split_inclusive('\n').find_map(|line| {
        let range = start..start + line.trim_end().len();
        start += line.len();
        line.starts_with("//!HOOK").then_some(range)
    })
}

/// A text with its comments removed.
struct StrippedText {
    text: String,
}

impl StrippedText {
    /// Replaces comments with blanks, so that byte positions do not change.
    fn of(text: &str) -> StrippedText {
        let mut out = text.as_bytes().to_vec();
        let mut at = 0;
        while at < out.len() {
            let rest = &out[at..];
            let len = if rest.starts_with(b"//") {
                memchr::memchr(b'\n', rest).unwrap_or(rest.len())
            } else if rest.starts_with(b"/*") {
                memchr::memmem::find(&rest[2..], b"*/").map_or(rest.len(), |end| end + 4)
            } else {
                at += 1;
                continue;
            };
            out[at..at + len].fill(b' ');
            at += len;
        }
        StrippedText { text: String::from_utf8(out).unwrap_or_default() }
    }

    /// Returns the position of the first occurrence of a word, or of a literal that is not a word.
    fn place(&self, word: &str) -> Option<usize> {
        let is_letter = |byte: Option<&u8>| byte.is_some_and(|b| b.is_ascii_alphanumeric() || *b == b'_');
        let bytes = self.text.as_bytes();
        memchr::memmem::find_iter(bytes, word).find(|&at| {
            let (before, after) = (at.checked_sub(1).and_then(|i| bytes.get(i)), bytes.get(at + word.len()));
            let starts = !is_letter(word.as_bytes().first()) || !is_letter(before);
            let ends = !is_letter(word.as_bytes().last()) || !is_letter(after);
            starts && ends
        })
    }
}

#[cfg(test)]
mod tests {
    use crate::{self as glsl, PassKind, PassSource, Text};
    use eddy_diag::SourceId;

    fn messages(code: &str) -> Vec<String> {
        let source = PassSource::new(PassKind::Image, Text { id: SourceId(0), text: code });
        glsl::diagnose(&source).into_iter().map(|d| format!("{}: {}", d.severity.name(), d.message)).collect()
    }

    const OTHERS: [(&str, &str); 24] = [
        ("an ISF shader", "/*{ \"ISFVSN\": \"2\", \"INPUTS\": [] }*/\nvoid main() { gl_FragColor = vec4(level); }"),
        ("an ISF shader", "void main() { gl_FragColor = IMG_NORM_PIXEL(inputImage, isf_FragNormCoord); }"),
        ("WGSL", "@fragment\nfn main(@location(0) uv: vec2<f32>) -> @location(0) vec4<f32> { return vec4<f32>(1.0); }"),
        ("Godot", "shader_type canvas_item;\nvoid fragment() { COLOR = vec4(UV, 0.0, 1.0); }"),
        ("Metal", "using namespace metal;\nfragment float4 f(V in [[stage_in]]) { return float4(1); }"),
        ("Unity", "Shader \"A\" { SubShader { Pass { CGPROGRAM\n#pragma fragment frag\nENDCG } } }"),
        ("HLSL", "float4 main(float2 uv : TEXCOORD0) : SV_Target { return float4(uv, 0, 1); }"),
        ("HLSL", "cbuffer A : register(b0) { float4 c; };\nTexture2D t;"),
        ("ReShade", "#include \"ReShade.fxh\"\nfloat4 f() { return tex2D(ReShade::BackBuffer, 0); }"),
        (
            "RetroArch",
            "#pragma stage fragment\nlayout(location = 0) in vec2 vTexCoord;\nvoid main() { FragColor = x; }",
        ),
        (
            "RetroArch",
            "#if defined(VERTEX)\nCOMPAT_ATTRIBUTE vec4 a;\n#else\nCOMPAT_VARYING vec2 b;\n#endif\nvoid main(){}",
        ),
        (
            "a plain fragment shader",
            "#version 300 es\nprecision highp float;\nout vec4 o;\nvoid main() { o = vec4(1.0); }",
        ),
        (
            "mpv",
            "// a licence\n\n//!DESC double\n//!HOOK MAIN\n//!BIND MAIN\nvec4 hook() { return MAIN_texOff(vec2(0.0)); }",
        ),
        ("mpv", "//!HOOK LUMA\nvec4 hook() { return HOOKED_tex(HOOKED_pos); }"),
        ("TouchDesigner", "out vec4 c;\nvoid main() { c = TDOutputSwizzle(texture(sTD2DInputs[0], vUV.st)); }"),
        ("Bonzomatic", "uniform float fGlobalTime;\nuniform vec2 v2Resolution;\nvoid main(void) { }"),
        ("KodeLife", "uniform vec3 spectrum;\nin VertexData { vec4 v_position; } inData;\nvoid main(void) { }"),
        ("Kodi", "uniform vec4 m_unicol;\nvoid main() { gl_FragColor = m_unicol; }"),
        ("picom", "in vec2 texcoord;\nvec4 window_shader() { return default_post_processing(vec4(1.0)); }"),
        ("three.js", "varying vec2 vUv;\nvoid main() { gl_FragColor = vec4(vUv, 0.0, 1.0); }"),
        ("Book of Shaders", "uniform vec2 u_resolution;\nvoid main() { gl_FragColor = vec4(u_resolution, 0., 1.); }"),
        ("GLSL Sandbox", "uniform float time;\nuniform vec2 resolution;\nvoid main() { gl_FragColor = vec4(time); }"),
        ("twigl", "vec2 p=(FC.xy*2.-r)/r.y;o.rgb+=vec3(length(p)-t);"),
        (
            "GameMaker",
            "varying vec2 v_vTexcoord;\nvoid main() { gl_FragColor = texture2D(gm_BaseTexture, v_vTexcoord); }",
        ),
    ];

    #[test]
    fn shaders_of_other_tools_get_one_message() {
        for (tool, code) in OTHERS {
            let found = messages(code);
            assert_eq!(found.len(), 1, "{tool}: {found:?}");
            assert!(found[0].starts_with("error: this is ") && found[0].contains(tool), "{tool}: {found:?}");
        }
    }

    #[test]
    fn shadertoy_shaders_keep_their_own_messages() {
        let main = "void mainImage(out vec4 o, in vec2 p) { o = vec4(p, 0.0, 1.0); }\n";
        for (_, code) in OTHERS {
            let commented = format!("/* {} */\n{main}", code.replace("*/", ""));
            assert_eq!(messages(&commented), [""; 0], "{code}");
        }
        let typo = "uniform vec2 u_resolution;\nvoid mainImage(out vec4 o, in vec2 p) { o = vec4(qq); }";
        assert!(messages(typo).iter().any(|d| d.contains("`qq`")), "{:?}", messages(typo));
        let plain = messages("void main() { gl_FragColor = vec4(1.0); }");
        assert!(plain.len() == 1 && !plain[0].contains("this is "), "{plain:?}");
    }

    #[test]
    fn missing_ghostty_uniforms_name_ghostty() {
        let code = "void mainImage(out vec4 o, in vec2 p) { o = iCurrentCursor + iPreviousCursor; }";
        let found = messages(code);
        assert!(found.len() == 1 && found[0].contains("Ghostty") && found[0].contains("iCurrentCursor"), "{found:?}");
        let given = format!("uniform vec4 iCurrentCursor, iPreviousCursor;\n{code}");
        assert!(!messages(&given).iter().any(|d| d.contains("Ghostty")));
        let typo = format!("uniform vec4 iCurrentCursor, iPreviousCursor;\nfloat f() {{ return qq; }}\n{code}");
        assert!(messages(&typo).iter().any(|d| d.contains("`qq`")));
    }
}
