//! Shaders of other programs, tested with the built program: custom shaders of Ghostty and ISF files.

use crate::support::program::{Bench, Npy};

/// Shows the terminal, with the cursor filled green and values of uniforms in the corner.
const FRAME: &str = "
void mainImage(out vec4 fragColor, in vec2 fragCoord) {
    fragColor = texture2D(iChannel0, fragCoord / iResolution.xy);
    vec4 box = iCurrentCursor;
    vec2 low = vec2(box.x, box.y - box.w), high = low + box.zw;
    bool isInside = all(greaterThan(fragCoord, low)) && all(lessThan(fragCoord, high));
    if (isInside) fragColor.rgb = vec3(0, 1, 0);
    if (fragCoord.x < 1 && fragCoord.y < 1) fragColor = vec4(iCurrentCursorStyle, iTimeCursorChange, iFocus, 1);
    if (fragCoord.x > 1 && fragCoord.x < 2 && fragCoord.y < 1) fragColor = vec4(iFrame, iMouse.x, iPalette[21].b, 1);
}
";

fn render(b: &Bench, file: &str, arguments: &[&str]) -> Npy {
    b.eddy(["render", file, "--size", "320x180", "--out", "o.npy"].iter().chain(arguments)).expect(0);
    b.npy("o.npy")
}

#[test]
fn a_ghostty_shader_sees_a_terminal_with_a_moving_cursor() {
    let Some(b) = Bench::with_gpu() else { return };
    b.write("frame.glsl", FRAME);
    let green_box = |picture: &Npy| {
        let is_green = |x: usize, y: usize| picture.at(x, y)[..3] == [0.0, 1.0, 0.0];
        let all: Vec<(usize, usize)> =
            (0..180).flat_map(|y| (0..320).map(move |x| (x, y))).filter(|&(x, y)| is_green(x, y)).collect();
        (all.iter().copied().min().unwrap(), all.len())
    };
    let start = render(&b, "frame.glsl", &["--as", "ghostty", "--mouse", "0:down 9,9"]);
    // A dot of the terminal's font is a pixel here: the cursor is in row 0, column 11.
    assert_eq!(green_box(&start), ((4 + 11 * 6, 180 - 4 - 12), 6 * 12));
    assert_eq!(start.at(0, 0)[..3], [0.0, 0.0, 1.0]);
    // Ghostty counts frames from 1 and has no mouse, and blue is colour 21 of the palette.
    assert_eq!(start.at(1, 0)[..3], [1.0, 0.0, 1.0]);
    let text = (0..320).filter(|&x| start.at(x, 170)[1] > 0.5).count();
    assert!(text > 10, "the prompt has {text} bright dots in this row");
    // Three letters are typed by the time of frame 50: at 0.6 + n * 0.09 s.
    let later = render(&b, "ghostty:frame.glsl", &["--at", "50"]);
    assert_eq!(green_box(&later).0, (4 + 14 * 6, 180 - 4 - 12));
    assert!((later.at(0, 0)[1] - 0.78).abs() < 1e-6);
    // A bar cursor is a dot wide.
    assert_eq!(green_box(&render(&b, "frame.glsl", &["--as", "ghostty", "--at", "549"])).1, 12);
}

#[test]
fn features_that_ghostty_lacks_are_reported() {
    let b = Bench::new();
    b.write("frame.glsl", FRAME);
    let run = b.line("check --for ghostty frame.glsl").expect(0);
    assert!(run.out.contains("ghostty:frame.glsl: ok") || run.out.contains("frame.glsl: ok"), "{}", run.out);
    let output = format!("{}{}", run.out, run.err);
    assert!(output.contains("Ghostty does not set `iMouse`"), "{output}");
    b.write("second.glsl", FRAME.replace("iChannel0", "iChannel1"));
    let run = b.line("check --for ghostty second.glsl").expect(1);
    assert!(format!("{}{}", run.out, run.err).contains("`iChannel1` is not declared"), "{run:?}");
    b.write("slider.glsl", format!("#iUniform float glow = 0.5 in {{ 0.0, 1.0 }}\n{FRAME}"));
    let run = b.line("check --for ghostty slider.glsl").expect(1);
    assert!(format!("{}{}", run.out, run.err).contains("does not know #iUniform"), "{run:?}");
    // Checked as a shader for Shadertoy, it suggests how to open it.
    let run = b.line("check frame.glsl").expect(1);
    assert!(format!("{}{}", run.out, run.err).contains("eddy --as ghostty"), "{run:?}");
    for wrong in ["check --for ghostty missing.glsl", "render --as ghostty . --out o.png"] {
        let run = b.line(wrong);
        assert!(run.code != Some(0) && !run.err.contains("panicked"), "{run:?}");
    }
}

#[test]
fn a_ghostty_shader_cannot_be_exported_or_translated() {
    let b = Bench::new();
    b.write("frame.glsl", FRAME);
    for line in [
        "export ghostty:frame.glsl --out o.json",
        "export ghostty:frame.glsl --out o.html",
        "translate ghostty:frame.glsl --to wgsl",
    ] {
        let run = b.line(line);
        assert!(matches!(run.code, Some(1 | 2)), "{line}: {run:?}");
        assert!(format!("{}{}", run.out, run.err).contains("Ghostty"), "{line}: {run:?}");
    }
    assert_eq!(b.names("."), ["frame.glsl"]);
}

/// An image filter with a persistent buffer, its own vertex shader and inputs.
const TRAILS: &str = r#"/*{
    "ISFVSN": "2",
    "INPUTS": [
        {"NAME": "step", "TYPE": "float", "DEFAULT": 0.25, "MIN": 0.0, "MAX": 1.0},
        {"NAME": "tint", "TYPE": "color", "DEFAULT": [0.0, 0.0, 1.0, 1.0]}
    ],
    "PASSES": [{"TARGET": "sum", "PERSISTENT": true, "FLOAT": true, "WIDTH": "1", "HEIGHT": "1"}, {}]
}*/
#if __VERSION__ <= 120
varying vec2 right;
#else
in vec2 right;
#endif
float start = TIME * 0;
void main() {
    if (PASSINDEX == 0) {
        gl_FragColor = IMG_PIXEL(sum, vec2(0.5)) + vec4(step);
    } else {
        float level = IMG_NORM_PIXEL(sum, vec2(0.5)).r;
        gl_FragColor = vec4(level, right.x, IMG_SIZE(sum).x * tint.b, 1) + start;
    }
}
"#;

#[test]
fn an_isf_file_is_drawn_with_its_passes_and_inputs() {
    let Some(b) = Bench::with_gpu() else { return };
    b.write("trails.fs", TRAILS);
    b.write(
        "trails.vs",
        "varying vec2 right;\nvoid main() {\n    isf_vertShaderInit();\n    right = isf_FragNormCoord + 1.0 / RENDERSIZE;\n}\n",
    );
    b.line("check trails.fs").expect(0);
    b.line("render trails.fs --size 8x4 --at 2 --out o.npy").expect(0);
    let picture = b.npy("o.npy");
    assert_eq!(picture.at(3, 1), [0.75, (3.5 + 1.0) / 8.0, 1.0, 1.0]);
    // The name of the slider, `step`, is a function of GLSL.
    b.line("render trails.fs --size 8x4 --at 0 --set isf_step=0.5 --out o.npy").expect(0);
    assert_eq!(b.npy("o.npy").at(0, 0)[0], 0.5);
    b.write("wrong.fs", TRAILS.replace("vec4(step)", "vec3(step)"));
    b.write("wrong.vs", b.bytes("trails.vs"));
    let run = b.line("check wrong.fs").expect(1);
    assert!(format!("{}{}", run.out, run.err).contains("wrong.fs:17:"), "{run:?}");
    b.write("header.fs", TRAILS.replace("\"FLOAT\": true,", "\"FLOAT\" true,"));
    let run = b.line("check header.fs").expect(1);
    assert!(format!("{}{}", run.out, run.err).contains("header.fs:7:"), "{run:?}");
}

#[test]
fn a_project_exported_as_isf_draws_the_same_picture() {
    let Some(b) = Bench::with_gpu() else { return };
    let state =
        "c = 0.5 * texture(iChannel0, p / iResolution.xy) + vec4(turned(p / iResolution.xy, iTime), 0.0, 1.0) * level;";
    let shown = "vec2 at = p / iResolution.xy;\n    c = texelFetch(iChannel0, ivec2(p), 0) * 0.2 + 0.1 * texture(iChannel0, at.yx);";
    let pass = |body: &str| format!("void mainImage(out vec4 c, in vec2 p) {{\n    {body}\n}}\n");
    b.write("glow/common.glsl", "vec2 turned(vec2 v, float a) { return mat2(cos(a), sin(a), -sin(a), cos(a)) * v; }\n");
    b.write(
        "glow/buffer_a.glsl",
        format!("#iChannel0 \"self\"\n#iUniform float level = 0.75 in {{ 0.0, 1.0 }}\n{}", pass(state)),
    );
    b.write("glow/image.glsl", pass(shown));
    b.line("export glow --to isf --out glow.fs").expect(0);
    for file in ["glow", "glow.fs"] {
        b.line(&format!("render {file} --size 24x16 --at 5 --out {file}.npy")).expect(0);
    }
    let (ours, isf) = (b.npy("glow.npy"), b.npy("glow.fs.npy"));
    let differences =
        ours.texels.iter().zip(&isf.texels).flat_map(|(a, b)| a.iter().zip(b).map(|(a, b)| (a - b).abs()));
    let max_difference = differences.fold(0.0, f32::max);
    // Texels are read at their centres with a filter, whose weights are rounded.
    assert!(max_difference < 5e-3, "{max_difference}");
    assert!(ours.at(3, 3)[0] > 0.01);
    b.write("glow.fs", "another's");
    let run = b.line("export glow --to isf --out glow.fs").expect(2);
    assert!(run.err.contains("--force"), "{}", run.err);
    b.write(
        "keys.glsl",
        "#iChannel0 \"keyboard\"\nvoid mainImage(out vec4 c, in vec2 p) { c = texture(iChannel0, p); }\n",
    );
    let run = b.line("export keys.glsl --out keys.fs").expect(1);
    assert!(run.err.contains("reads Keyboard, which ISF does not have"), "{}", run.err);
}

#[test]
fn features_that_xscreensaver_lacks_are_reported() {
    let b = Bench::new();
    b.image("plain.glsl", "fragColor = vec4(0.5 + 0.5 * sin(iTime), fragCoord / iResolution.xy, 1.0);");
    b.line("check --for xscreensaver plain.glsl").expect(0);
    b.write(
        "keys.glsl",
        "#iChannel0 \"keyboard\"\nvoid mainImage(out vec4 c, in vec2 p) { c = texture(iChannel0, p); }\n",
    );
    let run = b.line("check --for xscreensaver keys.glsl").expect(1);
    assert!(format!("{}{}", run.out, run.err).contains("iChannel0 of Image reads Keyboard"), "{run:?}");
}
