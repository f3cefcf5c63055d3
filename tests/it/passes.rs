//! Tests, by their pictures, of passes with their own size, format, region and step count, and of skipped passes.

use crate::support::*;
use eddy::{
    engine::{BuildOptions, Engine, FrameInputs, Pixels},
    gpu::Gpu,
    media::MediaSet,
    project::{Filter, Group, PassSize, Project, Region, TexelFormat, Wrap},
};

const SHOW: &str = "void mainImage(out vec4 o, in vec2 p) { o = texelFetch(iChannel0, ivec2(p), 0); }";

fn no_skip(gpu: &Gpu, project: &Project, size: (u32, u32)) -> Engine {
    engine_with(
        gpu,
        project,
        &MediaSet::new(),
        &BuildOptions { requested: Vec::new(), skip: false, ..BuildOptions::default() },
        size,
    )
}

/// Asserts that frames are identical with and without skipping, and returns the last.
fn same_with_no_skip(gpu: &Gpu, project: &Project, size: (u32, u32), inputs: &[FrameInputs]) -> Pixels {
    let (mut lean, mut full) = (engine(gpu, project, size), no_skip(gpu, project, size));
    let mut last = None;
    for (i, inputs) in inputs.iter().enumerate() {
        lean.draw(inputs).unwrap();
        full.draw(inputs).unwrap();
        let (a, b) = (lean.read_image().unwrap(), full.read_image().unwrap());
        assert_eq!(a, b, "frame {i}");
        last = Some(a);
    }
    last.unwrap()
}

fn frames(n: i32) -> Vec<FrameInputs> {
    (0..n).map(|f| FrameInputs::at_fixed_step(f, 60.0)).collect()
}

#[test]
fn a_pass_has_its_own_size_which_readers_see() {
    let Some(gpu) = gpu() else { return };
    let a = "void mainImage(out vec4 o, in vec2 p) { o = vec4(iResolution.xy, p); }";
    let show = "void mainImage(out vec4 o, in vec2 p) {
        o = p.x < 1.0 ? vec4(iChannelResolution[0].xy, iResolution.xy) : texture(iChannel0, vec2(1.0)).zwxy; }";
    for (size, expected) in [
        (PassSize::Scale(0.5), [4.0, 3.0]),
        (PassSize::Fixed(3, 40), [3.0, 40.0]),
        (PassSize::Scale(2.0), [14.0, 10.0]),
    ] {
        let mut a = pass(buffer("A"), a, Default::default());
        a.settings.size = size;
        let project = project(vec![a, image(show, [nearest("A"), None, None, None])]);
        let pixels = same_with_no_skip(&gpu, &project, (7, 5), &frames(2));
        let [w, h] = expected;
        assert_eq!(texel(&pixels, 0, 0)[..3], [w, h, 7.0], "{size:?}");
        assert_eq!(texel(&pixels, 1, 0)[..3], [w - 0.5, h - 0.5, w], "{size:?}");
        let mut engine = ran(&gpu, &project, (7, 5), 1);
        let read = engine.read(&buffer("A")).unwrap();
        assert_eq!((read.width as f32, read.height as f32, read.texels.len() as f32), (w, h, w * h));
        engine.show(buffer("A"));
        engine.resize(9, 9).unwrap();
        run(&mut engine, 1, 2);
        assert_eq!(engine.read(&buffer("A")).unwrap().width, size.of((9, 9)).0);
    }
}

#[test]
fn formats_round_as_specified_and_read_back_as_floats() {
    let Some(gpu) = gpu() else { return };
    let a = "void mainImage(out vec4 o, in vec2 p) { o = vec4(0.5, -1.0, 1000.0625, 0.25) + p.x * 0.0; }";
    for format in TexelFormat::ALL {
        let mut a = pass(buffer("A"), a, Default::default());
        a.settings.format = format;
        let mips = [reads("A", Filter::Mipmap, Wrap::Repeat), None, None, None];
        let show = "void mainImage(out vec4 o, in vec2 p) { o = textureLod(iChannel0, vec2(0.3), 1.0); }";
        let project = project(vec![a, image(show, mips)]);
        let pixels = same_with_no_skip(&gpu, &project, (4, 4), &frames(1));
        let name = format.name();
        let rounded = |v: f32| match name {
            n if n.ends_with("32f") => v,
            // 11 bits of mantissa: steps of a half at 1000.
            n if n.ends_with("16f") => {
                if v > 100.0 {
                    1000.0
                } else {
                    v
                }
            }
            _ => (v.clamp(0.0, 1.0) * 255.0).round() / 255.0,
        };
        let channels = name.bytes().take_while(u8::is_ascii_alphabetic).count();
        let written = [0.5, -1.0, 1000.0625, 0.25];
        let expected: [f32; 4] = std::array::from_fn(|i| match i {
            i if i < channels => rounded(written[i]),
            3 => 1.0,
            _ => 0.0,
        });
        let mut engine = ran(&gpu, &project, (4, 4), 1);
        let own = texel(&engine.read(&buffer("A")).unwrap(), 3, 3);
        let near = |a: f32, b: f32| (a - b).abs() <= 1.0 / 255.0;
        assert!(own.iter().zip(expected).all(|(a, b)| near(*a, b)), "{name}: {own:?}, expected {expected:?}");
        let through = texel(&pixels, 0, 0);
        assert!(through[..3].iter().zip(expected).all(|(a, b)| near(*a, b)), "{name} with mips: {through:?}");
    }
}

#[test]
fn only_the_region_is_drawn_and_the_rest_is_unchanged() {
    let Some(gpu) = gpu() else { return };
    let count = "void mainImage(out vec4 o, in vec2 p) { o = vec4(float(iFrame + 1), p, 1.0); }";
    let own = "void mainImage(out vec4 o, in vec2 p) { o = texelFetch(iChannel0, ivec2(p), 0) + vec4(1.0, p, 1.0); }";
    for (code, channels) in [(count, Default::default()), (own, [nearest("A"), None, None, None])] {
        let mut a = pass(buffer("A"), code, channels);
        a.settings.region = Some(Region { x: 1, y: 2, width: 2, height: 9 });
        let project = project(vec![a, image(SHOW, [nearest("A"), None, None, None])]);
        let pixels = same_with_no_skip(&gpu, &project, (4, 4), &frames(3));
        for y in 0..4 {
            for x in 0..4 {
                let inside = (1..3).contains(&x) && y >= 2;
                assert_eq!(texel(&pixels, x, y)[0], if inside { 3.0 } else { 0.0 }, "{x},{y}");
            }
        }
    }
    // A first program writes every texel, a second only a region: the others stay unchanged.
    let fill = "void mainImage(out vec4 o, in vec2 p) { o = vec4(7.0); }";
    let show = image(SHOW, [nearest("A"), None, None, None]);
    let mut engine = ran(&gpu, &project(vec![pass(buffer("A"), fill, Default::default()), show.clone()]), (3, 1), 1);
    let mut part = pass(buffer("A"), own, [nearest("A"), None, None, None]);
    part.settings.region = Some(Region { x: 2, y: 0, width: 1, height: 1 });
    let built =
        eddy::engine::Program::build(&gpu, &project(vec![part, show]), &MediaSet::new(), &BuildOptions::default());
    engine.set_program(built.unwrap().program).unwrap();
    run(&mut engine, 1, 4);
    let reds: Vec<f32> = engine.read(&buffer("A")).unwrap().texels.iter().map(|t| t[0]).collect();
    assert_eq!(reds, [7.0, 7.0, 10.0]);
}

/// A and B pass a number back and forth: A = B + 1, B = 2 A, in a group of `steps`.
fn solver(steps: u32) -> Project {
    let a = "void mainImage(out vec4 o, in vec2 p) { o = texelFetch(iChannel1, ivec2(p), 0) + vec4(1.0, float(iFrame), \
             0.0, 0.0); }";
    let b = "void mainImage(out vec4 o, in vec2 p) { o = 2.0 * texelFetch(iChannel0, ivec2(p), 0); }";
    let reads = || [nearest("A"), nearest("B"), None, None];
    let mut p = project(vec![
        pass(buffer("A"), a, reads()),
        pass(buffer("B"), b, reads()),
        image("void mainImage(out vec4 o, in vec2 p) { o = texelFetch(iChannel1, ivec2(p), 0); }", reads()),
    ]);
    p.groups = vec![Group { name: "g".into(), passes: vec![buffer("A"), buffer("B")], steps }];
    p
}

#[test]
fn a_group_runs_its_steps_in_order_and_reads_the_newest_values() {
    let Some(gpu) = gpu() else { return };
    for steps in [1, 2, 3, 8] {
        let (mut value, mut sum) = (0.0f32, 0.0f32);
        for frame in 0..3 {
            for _ in 0..steps {
                value = 2.0 * (value + 1.0);
                sum = 2.0 * (sum + frame as f32);
            }
        }
        let pixels = same_with_no_skip(&gpu, &solver(steps), (2, 2), &frames(3));
        assert_eq!(texel(&pixels, 1, 1)[..2], [value, sum], "{steps} steps");
    }
    // Drawing frames in one run or in two gives the same picture.
    let (mut whole, mut halves) = (engine(&gpu, &solver(3), (2, 2)), engine(&gpu, &solver(3), (2, 2)));
    run(&mut whole, 0, 4);
    run(&mut halves, 0, 2);
    run(&mut halves, 2, 4);
    assert_eq!(whole.read_image().unwrap(), halves.read_image().unwrap());
}

/// B depends on A and a custom uniform, A on no input, C on the mouse, D on keys; Image on B, C and D.
fn skippable() -> Project {
    let c = |n: &str| nearest(n);
    let fixed = "void mainImage(out vec4 o, in vec2 p) { o = vec4(p, 1.0, 1.0); }";
    let b = "#iUniform float gain = 2.0\nvoid mainImage(out vec4 o, in vec2 p) { o = gain * texelFetch(iChannel0, \
             ivec2(p), 0); }";
    let mouse = "void mainImage(out vec4 o, in vec2 p) { o = iMouse; }";
    let keys = "void mainImage(out vec4 o, in vec2 p) { o = texelFetch(iChannel0, ivec2(32, 0), 0); }";
    let keyboard = eddy::project::Channel::new(eddy::project::Input::KEYBOARD);
    let show = "void mainImage(out vec4 o, in vec2 p) { ivec2 i = ivec2(p);
        o = texelFetch(iChannel0, i, 0) + texelFetch(iChannel1, i, 0) + texelFetch(iChannel2, i, 0) * 0.1; }";
    project(vec![
        pass(buffer("A"), fixed, Default::default()),
        pass(buffer("B"), b, [c("A"), None, None, None]),
        pass(buffer("C"), mouse, Default::default()),
        pass(buffer("D"), keys, [Some(keyboard), None, None, None]),
        image(show, [c("B"), c("C"), c("D"), None]),
    ])
}

#[test]
fn unchanged_passes_are_skipped_and_changed_ones_are_redrawn() {
    let Some(gpu) = gpu() else { return };
    let mut project = skippable();
    let mut engine = engine(&gpu, &project, (4, 4));
    let mut inputs = FrameInputs::at_fixed_step(0, 60.0);
    let draw = |engine: &mut Engine, inputs: &FrameInputs, what: &str, drawn: u64| {
        let stats = engine.draw(inputs).unwrap();
        assert_eq!((stats.passes_drawn, stats.passes_cached), (drawn, 5 - drawn), "{what}");
        // The picture equals the one with every pass drawn.
        let mut full = no_skip(&gpu, &project, engine.size());
        full.set_custom_uniforms(&project.custom_uniform_values);
        full.draw(inputs).unwrap();
        assert_eq!(engine.read_image().unwrap(), full.read_image().unwrap(), "{what}");
        stats.bytes_cached
    };
    draw(&mut engine, &inputs, "the first frame", 5);
    inputs = FrameInputs::at_fixed_step(1, 60.0);
    assert_eq!(draw(&mut engine, &inputs, "time passes and no pass reads it", 0), 5 * 16 * 16);
    inputs.mouse = [1.0, 2.0, 3.0, 4.0];
    draw(&mut engine, &inputs, "the mouse: C and Image", 2);
    inputs.keyboard.press(32);
    draw(&mut engine, &inputs, "a key: D and Image", 2);
    draw(&mut engine, &inputs, "held", 0);
    engine.resize(5, 3).unwrap();
    draw(&mut engine, &inputs, "a resize", 5);
    engine.reset();
    draw(&mut engine, &inputs, "a reset", 5);
    draw(&mut engine, &inputs, "rest again", 0);
    project.set_custom_uniform("gain=3").unwrap();
    assert!(engine.set_custom_uniforms(&project.custom_uniform_values));
    assert_eq!(engine.draw(&inputs).unwrap().passes_drawn, 2, "a custom uniform: B and Image");
    let mut full = no_skip(&gpu, &project, engine.size());
    full.draw(&inputs).unwrap();
    assert_eq!(engine.read_image().unwrap(), full.read_image().unwrap());
    let built = eddy::engine::Program::build(&gpu, &project, &MediaSet::new(), &BuildOptions::default()).unwrap();
    engine.set_program(built.program).unwrap();
    assert_eq!(engine.draw(&inputs).unwrap().passes_drawn, 5, "a new program");
    assert_eq!(full.draw(&inputs).unwrap().passes_cached, 0, "--no-skip");
}

#[test]
fn skipping_is_exact_for_late_reads_self_reads_and_discards() {
    let Some(gpu) = gpu() else { return };
    let early =
        "void mainImage(out vec4 o, in vec2 p) { o = texelFetch(iChannel0, ivec2(p), 0) + float(int(iMouse.x)); }";
    let fixed = "void mainImage(out vec4 o, in vec2 p) { o = vec4(p * iMouse.y, 0.0, 1.0); }";
    let count =
        "void mainImage(out vec4 o, in vec2 p) { o = texelFetch(iChannel2, ivec2(p), 0) + vec4(0.0, 0.0, 1.0, 0.0); }";
    let holes =
        "void mainImage(out vec4 o, in vec2 p) { if (mod(iMouse.x + p.x, 3.0) < 1.5) discard; o = vec4(iMouse.x); }";
    let show = "void mainImage(out vec4 o, in vec2 p) { ivec2 i = ivec2(p);
        o = texelFetch(iChannel0, i, 0) + 10.0 * texelFetch(iChannel1, i, 0) + texelFetch(iChannel2, i, 0) + \
        texelFetch(iChannel3, i, 0); }";
    let project = project(vec![
        pass(buffer("A"), early, [nearest("B"), None, None, None]),
        pass(buffer("B"), fixed, Default::default()),
        pass(buffer("C"), count, [None, None, nearest("C"), None]),
        pass(buffer("D"), holes, Default::default()),
        image(show, [nearest("A"), nearest("B"), nearest("C"), nearest("D")]),
    ]);
    let mut inputs = frames(12);
    for (i, inputs) in inputs.iter_mut().enumerate() {
        inputs.mouse = [(i / 3) as f32, (i / 5) as f32, 0.0, 0.0];
    }
    let last = same_with_no_skip(&gpu, &project, (4, 4), &inputs);
    assert!(last.texels.iter().any(|t| t[2] >= 12.0), "C has counted");
}
