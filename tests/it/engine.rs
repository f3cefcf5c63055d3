//! The rules of multipass drawing, tested by pictures.

use crate::support::*;
use eddy::{
    engine::{BuildError, BuildOptions, BuildWork, Builder, Engine, FrameInputs, Program, ValueLook},
    gpu::{GpuError, GpuOptions},
    media::MediaSet,
    project::{Channel, Filter, Input, InputKind, PadPart, PassName, Project, Source, TexelFormat, Wrap},
};

const READS_ALL: &str = "void mainImage(out vec4 o, in vec2 p) {
    // Texel 0 says which frame wrote it, counted from 1; texel 1 what the four channels' texel 0 says.
    if (p.x < 1.0) { o = vec4(float(iFrame + 1)); }
    else { o = vec4(texelFetch(iChannel0, ivec2(0), 0).x, texelFetch(iChannel1, ivec2(0), 0).x,
                    texelFetch(iChannel2, ivec2(0), 0).x, texelFetch(iChannel3, ivec2(0), 0).x); }
}";

#[test]
fn reads_return_the_frame_that_the_pass_order_implies() {
    let Some(gpu) = gpu() else { return };
    let letters = ["A", "B", "C", "D"];
    for order in [[0, 1, 2, 3], [3, 1, 0, 2]] {
        let all = || letters.map(nearest);
        let mut passes: Vec<_> = order.iter().map(|&i: &usize| pass(buffer(letters[i]), READS_ALL, all())).collect();
        passes.push(image(READS_ALL, all()));
        let mut engine = ran(&gpu, &project(passes), (2, 1), 3);
        for (position, &reader) in order.iter().enumerate() {
            let seen = texel(&engine.read(&buffer(letters[reader])).unwrap(), 1, 0);
            for source in 0..4 {
                let source_position = order.iter().position(|&i| i == source).unwrap();
                let expected = if source_position < position { 3.0 } else { 2.0 };
                assert_eq!(seen[source], expected, "{} reads {} in {order:?}", letters[reader], letters[source]);
            }
        }
        // Alpha of Image is forced to 1, so only three of its four reads are kept.
        assert_eq!(texel(&engine.read_image().unwrap(), 1, 0), [3.0, 3.0, 3.0, 1.0]);
    }
}

#[test]
fn a_channel_beyond_the_language_is_an_error_that_names_the_pass() {
    let mut image = image("void mainImage(out vec4 o, in vec2 p) { o = vec4(1.0); }", Default::default());
    image.bindings.set(3, nearest("A"));
    image.bindings.set(7, nearest("A"));
    let project = project(vec![image]);
    let found = eddy::engine::Sources::new(&project).diagnostics;
    let messages: Vec<&str> = found.iter().filter(|d| d.is_error()).map(|d| d.message.as_str()).collect();
    assert_eq!(messages, ["Image has an input for iChannel7, which its language does not have"]);
}

#[test]
fn discard_shows_the_texels_of_a_buffer_two_frames_ago_and_of_image_one_frame_ago() {
    let Some(gpu) = gpu() else { return };
    let code =
        "void mainImage(out vec4 o, in vec2 p) { if (iFrame == 4) discard; o = vec4(float(iFrame), 7.0, 7.0, 7.0); }";
    let image_code = "void mainImage(out vec4 o, in vec2 p) { if (iFrame == 4) discard; o = vec4(float(iFrame) + \
                texelFetch(iChannel0, ivec2(0), 0).y); }";
    let project =
        project(vec![pass(buffer("A"), code, Default::default()), image(image_code, [nearest("A"), None, None, None])]);
    let mut engine = ran(&gpu, &project, (1, 1), 5);
    assert_eq!(texel(&engine.read(&buffer("A")).unwrap(), 0, 0)[0], 2.0);
    assert_eq!(texel(&engine.read_image().unwrap(), 0, 0)[0], 10.0);
}

#[test]
fn frame_0_reads_zeros_also_after_a_reset() {
    let Some(gpu) = gpu() else { return };
    let count = "void mainImage(out vec4 o, in vec2 p) { o = texelFetch(iChannel0, ivec2(p), 0) + 1.0; }";
    let show = "void mainImage(out vec4 o, in vec2 p) { o = texelFetch(iChannel0, ivec2(p), 0); }";
    let project = project(vec![
        pass(buffer("A"), count, [nearest("A"), None, None, None]),
        image(show, [nearest("A"), None, None, None]),
    ]);
    let mut engine = ran(&gpu, &project, (3, 2), 3);
    assert_eq!(texel(&engine.read_image().unwrap(), 2, 1), [3.0, 3.0, 3.0, 1.0]);
    engine.reset();
    run(&mut engine, 0, 1);
    assert_eq!(texel(&engine.read(&buffer("A")).unwrap(), 2, 1), [1.0; 4]);
}

#[test]
fn a_resize_keeps_the_overlap_from_the_bottom_left() {
    let Some(gpu) = gpu() else { return };
    let keep = "void mainImage(out vec4 o, in vec2 p) {
        o = iFrame == 0 ? vec4(p, 1.0, 1.0) : texelFetch(iChannel0, ivec2(p), 0); }";
    let show = "void mainImage(out vec4 o, in vec2 p) { o = texelFetch(iChannel0, ivec2(p), 0); }";
    let project = project(vec![
        pass(buffer("A"), keep, [nearest("A"), None, None, None]),
        image(show, [nearest("A"), None, None, None]),
    ]);
    let mut engine = ran(&gpu, &project, (4, 4), 1);
    engine.resize(6, 3).unwrap();
    run(&mut engine, 1, 2);
    let a = engine.read(&buffer("A")).unwrap();
    assert_eq!((a.width, a.height), (6, 3));
    assert_eq!(texel(&a, 3, 2), [3.5, 2.5, 1.0, 1.0]);
    assert_eq!(texel(&a, 4, 0), [0.0; 4]);
}

#[test]
fn filter_wrap_and_mips_are_applied() {
    let Some(gpu) = gpu() else { return };
    let fill = "void mainImage(out vec4 o, in vec2 p) { o = vec4(floor(p), 0.0, 1.0); }";
    let show = "void mainImage(out vec4 o, in vec2 p) {
        // Between texels 0 and 1; half a texel left of the edge; the whole mean.
        o = vec4(textureLod(iChannel0, vec2(0.25, 0.5), 0.0).x, textureLod(iChannel1, vec2(0.0, 0.5), 0.0).x,
                 textureLod(iChannel2, vec2(0.5), 2.0).x, 1.0);
    }";
    let a = |filter, wrap| reads("A", filter, wrap);
    let channels =
        [a(Filter::Linear, Wrap::Clamp), a(Filter::Linear, Wrap::Repeat), a(Filter::Mipmap, Wrap::Clamp), None];
    let project = project(vec![pass(buffer("A"), fill, Default::default()), image(show, channels)]);
    let mut engine = ran(&gpu, &project, (4, 4), 1);
    let [between, edge, mean, _] = texel(&engine.read_image().unwrap(), 0, 0);
    for (got, expected) in [(between, 0.5), (edge, 1.5), (mean, 1.5)] {
        assert!((got - expected).abs() < 0.01, "{got} is not {expected}");
    }
}

#[test]
fn uniforms_have_the_values_of_the_frame_inputs() {
    let Some(gpu) = gpu() else { return };
    let a = "void mainImage(out vec4 o, in vec2 p) {
        int i = int(p.x);
        if (i == 0) o = vec4(iResolution, iTime);
        if (i == 1) o = iMouse;
        if (i == 2) o = iDate;
        if (i == 3) o = vec4(iTimeDelta, iFrameRate, iSampleRate, float(iFrame));
        if (i == 4) o = vec4(iChannelResolution[1], iChannelTime[2]);
    }";
    let show = "void mainImage(out vec4 o, in vec2 p) { o = texelFetch(iChannel0, ivec2(p), 0); }";
    let project = project(vec![
        pass(buffer("A"), a, [None, nearest("A"), None, None]),
        image(show, [nearest("A"), None, None, None]),
    ]);
    let mut engine = engine(&gpu, &project, (5, 1));
    let inputs = FrameInputs {
        mouse: [1.0, 2.0, -3.0, -0.0],
        date: [2026.0, 10.0, 21.0, 3600.5],
        ..FrameInputs::at_fixed_step(30, 60.0)
    };
    engine.draw(&inputs).unwrap();
    let pixels = engine.read(&buffer("A")).unwrap();
    assert_eq!(texel(&pixels, 0, 0), [5.0, 1.0, 1.0, 0.5]);
    assert_eq!(texel(&pixels, 1, 0), [1.0, 2.0, -3.0, -0.0]);
    assert!(texel(&pixels, 1, 0)[3].is_sign_negative());
    assert_eq!(texel(&pixels, 2, 0), inputs.date);
    assert_eq!(texel(&pixels, 3, 0), [1.0 / 60.0, 60.0, 44100.0, 30.0]);
    assert_eq!(texel(&pixels, 4, 0), [5.0, 1.0, 1.0, 0.0]);
}

/// The three rows of the second gamepad, its last column and the size; zeros before anything moves.
#[test]
fn gamepads_are_a_texture_of_17_by_12_texels() {
    let Some(gpu) = gpu() else { return };
    let a = "void mainImage(out vec4 o, in vec2 p) {
        if (int(p.x) == 0) o = vec4(texelFetch(iChannel0, ivec2(1, 3), 0).r, texelFetch(iChannel0, ivec2(7, 4), 0).r,
                                    texelFetch(iChannel0, ivec2(7, 5), 0).r, texelFetch(iChannel0, ivec2(16, 3), 0).r);
        else o = vec4(iChannelResolution[0].xy, texture(iChannel0, (vec2(1, 3) + 0.9) / vec2(17, 12)).r, 0.0);
    }";
    let channel = Channel::new(Input::Device(InputKind::Gamepad));
    let project = project(vec![
        pass(buffer("A"), a, [Some(channel), None, None, None]),
        image(
            "void mainImage(out vec4 o, in vec2 p) { o = texelFetch(iChannel0, ivec2(p), 0); }",
            [nearest("A"), None, None, None],
        ),
    ]);
    let mut engine = engine(&gpu, &project, (2, 1));
    engine.draw(&FrameInputs::at_fixed_step(0, 60.0)).unwrap();
    let pixels = engine.read(&buffer("A")).unwrap();
    assert_eq!([texel(&pixels, 0, 0), texel(&pixels, 1, 0)], [[0.0; 4], [17.0, 12.0, 0.0, 0.0]]);
    let mut inputs = FrameInputs::at_fixed_step(1, 60.0);
    inputs.gamepads.connect(1, true);
    inputs.gamepads.move_to(1, PadPart::Axis(1), -0.75);
    inputs.gamepads.move_to(1, PadPart::Button(7), 0.625);
    engine.draw(&inputs).unwrap();
    let pixels = engine.read(&buffer("A")).unwrap();
    assert_eq!(texel(&pixels, 0, 0), [-0.75, 0.625, 1.0, 1.0]);
    assert_eq!(texel(&pixels, 1, 0), [17.0, 12.0, -0.75, 0.0], "read without a filter");
}

#[test]
fn a_new_program_keeps_the_buffers_that_it_shares_with_the_old_one() {
    let Some(gpu) = gpu() else { return };
    let count = "void mainImage(out vec4 o, in vec2 p) { o = texelFetch(iChannel0, ivec2(p), 0) + 1.0; }";
    let by_ten = "void mainImage(out vec4 o, in vec2 p) { o = texelFetch(iChannel0, ivec2(p), 0) + 10.0; }";
    let show = "void mainImage(out vec4 o, in vec2 p) { o = texelFetch(iChannel0, ivec2(p), 0); }";
    let with = |code: &str| {
        project(vec![
            pass(buffer("A"), code, [nearest("A"), None, None, None]),
            image(show, [nearest("A"), None, None, None]),
        ])
    };
    let mut engine = ran(&gpu, &with(count), (1, 1), 3);
    let built = eddy::engine::Program::build(&gpu, &with(by_ten), &MediaSet::new(), &BuildOptions::default()).unwrap();
    engine.set_program(built.program).unwrap();
    run(&mut engine, 3, 4);
    assert_eq!(texel(&engine.read(&buffer("A")).unwrap(), 0, 0)[0], 13.0);
}

#[test]
fn impossible_sizes_are_rejected_and_leave_the_engine_unchanged() {
    let Some(gpu) = gpu() else { return };
    let show = "void mainImage(out vec4 o, in vec2 p) { o = vec4(0.5); }";
    let mut engine = engine(&gpu, &project(vec![image(show, Default::default())]), (2, 2));
    assert!(matches!(
        engine.resize(0, 4).unwrap_err(),
        eddy::engine::EngineError::Gpu(GpuError::Empty { width: 0, height: 4, .. })
    ));
    let message = engine.resize(1 << 20, 4).unwrap_err().to_string();
    assert!(message.contains("1048576x4") && message.contains("at most"), "{message}");
    run(&mut engine, 0, 1);
    assert_eq!(engine.size(), (2, 2));
    assert_eq!(texel(&engine.read_image().unwrap(), 1, 1), [0.5, 0.5, 0.5, 1.0]);
}

#[test]
fn emulated_bilinear_filtering_matches_the_samplers() {
    let (Some(gpu), Some(plain)) =
        (gpu(), gpu_with(&GpuOptions { use_float32_filtering: false, ..Default::default() }))
    else {
        return;
    };
    let fill = "void mainImage(out vec4 o, in vec2 p) { o = fract(sin(vec4(p.x, p.y, p.x * p.y, p.x + p.y)) * 43.7); }";
    let show = "void mainImage(out vec4 o, in vec2 p) {
        vec2 uv = p / iResolution.xy * 1.7 - 0.3;
        o = 0.4 * texture(iChannel0, uv) + 0.3 * texture(iChannel1, uv + 0.11) + 0.3 * textureLod(iChannel2, uv, 1.5);
    }";
    let a = |filter, wrap| reads("A", filter, wrap);
    let channels =
        [a(Filter::Linear, Wrap::Clamp), a(Filter::Linear, Wrap::Repeat), a(Filter::Mipmap, Wrap::Repeat), None];
    let project = project(vec![pass(buffer("A"), fill, Default::default()), image(show, channels)]);
    let picture = |gpu| {
        let mut engine = ran(gpu, &project, (37, 23), 1);
        engine.read_image().unwrap()
    };
    assert!(!plain.filters_float32);
    let (by_sampler, emulated) = (picture(&gpu), picture(&plain));
    let worst = by_sampler
        .texels
        .iter()
        .flatten()
        .zip(emulated.texels.iter().flatten())
        .map(|(a, b)| (a - b).abs())
        .fold(0.0, f32::max);
    assert!(worst <= 1.0 / 255.0, "differs by {worst}");
}

/// The k-th of three texts, each of which is used by eight of the buffers of [`many_buffers`].
fn step_text(k: usize, n: u32) -> String {
    format!(
        "void mainImage(out vec4 o, in vec2 p) {{ o = texelFetch(iChannel0, ivec2(p), 0) + noise({k}.0) + {n}.0; }}\n"
    )
}

/// 24 buffers with three different texts, each reading the previous one, and Image.
fn many_buffers() -> Project {
    let name = |i: usize| format!("b{i}");
    let mut passes: Vec<_> = (0..24)
        .map(|i| pass(buffer(&name(i)), &step_text(i % 3, 0), [nearest(&name((i + 23) % 24)), None, None, None]))
        .collect();
    passes.push(image(&show(1), [nearest("b23"), None, None, None]));
    let common =
        Source { name: "Common".into(), path: None, text: "float noise(float x) { return x * 0.5; }\n".into() };
    Project { common: Some(common), ..project(passes) }
}

fn show(n: u32) -> String {
    format!("void mainImage(out vec4 o, in vec2 p) {{ o = texelFetch(iChannel0, ivec2(p), 0) * noise({n}.0); }}\n")
}

fn edit(project: &mut Project, pass: &PassName, code: &str) {
    project.pass_mut(pass).unwrap().source.text = code.into();
}

fn work(stages: usize, pipelines: usize) -> BuildWork {
    BuildWork { stages, pipelines }
}

/// Builds the program, installs it and draws three frames.
fn rebuild(builder: &mut Builder, engine: &mut Engine, project: &Project) -> (BuildWork, Vec<[f32; 4]>) {
    let built = builder.build(project, &MediaSet::new(), &BuildOptions::default()).unwrap_or_else(|e| panic!("{e:?}"));
    engine.set_program(built.program).unwrap();
    engine.reset();
    run(engine, 0, 3);
    (built.work, engine.read_image().unwrap().texels)
}

#[test]
fn an_edit_rebuilds_only_what_it_changes() {
    let Some(gpu) = gpu() else { return };
    let (mut builder, mut engine) = (Builder::new(gpu.clone()), Engine::new(gpu.clone(), 2, 2).unwrap());
    let mut rebuild = |project: &Project| {
        let (work, picture) = rebuild(&mut builder, &mut engine, project);
        let mut fresh = engine_with(&gpu, project, &MediaSet::new(), &BuildOptions::default(), (2, 2));
        run(&mut fresh, 0, 3);
        assert_eq!(picture, fresh.read_image().unwrap().texels, "the same as a fresh engine");
        (work, picture)
    };
    let mut project = many_buffers();
    let (first, before) = rebuild(&project);
    assert_eq!(first, work(4, 4), "25 passes over four texts");
    assert_eq!(rebuild(&project).0, work(0, 0), "nothing has changed");

    edit(&mut project, &PassName::image(), &show(2));
    let (one, after) = rebuild(&project);
    assert_eq!(one, work(1, 1));
    assert_ne!(before, after);

    edit(&mut project, &PassName::image(), &show(1));
    assert_eq!(rebuild(&project), (work(0, 0), before), "the previous text again");

    edit(&mut project, &buffer("b7"), &step_text(1, 5));
    assert_eq!(rebuild(&project).0, work(1, 1), "one of eight passes with the same text");

    edit(&mut project, &PassName::image(), &format!("// a word\n{}", show(1)));
    assert_eq!(rebuild(&project).0, work(1, 0), "identical code needs no new pipeline");

    project.passes[3].settings.format = TexelFormat::Rg32f;
    assert_eq!(rebuild(&project).0, work(0, 1), "a new format needs a new pipeline of the same stage");

    project.common.as_mut().unwrap().text = "float noise(float x) { return x * 0.3 + 0.1; }\n".into();
    assert_eq!(rebuild(&project).0, work(5, 6), "Common is part of every stage");

    project.common.as_mut().unwrap().text = "float noise(float x) { return x * 0.3 + 0.1; }\nfloat unused;\n".into();
    assert_eq!(rebuild(&project).0, work(5, 0), "unused code of Common changes no stage");
}

#[test]
fn a_broken_edit_discards_no_built_stages() {
    let Some(gpu) = gpu() else { return };
    let (mut builder, mut engine) = (Builder::new(gpu.clone()), Engine::new(gpu, 2, 2).unwrap());
    let project = many_buffers();
    let (_, before) = rebuild(&mut builder, &mut engine, &project);
    let mut broken = project.clone();
    for n in 0..5 {
        edit(&mut broken, &PassName::image(), &format!("{} {n}", show(1)));
        let built = builder.build(&broken, &MediaSet::new(), &BuildOptions::default());
        assert!(matches!(built, Err(BuildError::Diagnostics { .. })));
    }
    assert_eq!(rebuild(&mut builder, &mut engine, &project), (work(0, 0), before));
}

/// Passes with the same text share its diagnostics, each at its own place.
#[test]
fn errors_of_a_shared_text_are_reported_for_each_of_its_passes() {
    let Some(gpu) = gpu() else { return };
    let mut builder = Builder::new(gpu);
    let mut project = many_buffers();
    let broken = "void mainImage(out vec4 o, in vec2 p) { o = lenght(p); }\n";
    let broken_passes = [2, 7, 11];
    for pass_index in broken_passes {
        let id = project.passes[pass_index].id.clone();
        edit(&mut project, &id, broken);
    }
    for _ in 0..2 {
        let built = builder.build(&project, &MediaSet::new(), &BuildOptions::default());
        let Err(BuildError::Diagnostics { diagnostics, sources }) = built else { panic!("it compiles") };
        let places: Vec<_> = diagnostics.iter().map(|d| d.span.unwrap()).collect();
        let at = broken.find("lenght").unwrap();
        assert!(places.iter().all(|span| span.range() == (at..at + 6)), "{diagnostics:?}");
        let names: Vec<_> = places.iter().map(|span| sources.get(span.source).unwrap().name.clone()).collect();
        assert_eq!(names, broken_passes.map(|pass_index| project.passes[pass_index].source.name.clone()));
    }
}

/// Unchanged targets are kept; others keep the texels that fit both sizes or formats.
#[test]
fn buffers_keep_their_texels_when_their_size_or_format_changes() {
    let Some(gpu) = gpu() else { return };
    let count = "void mainImage(out vec4 o, in vec2 p) { o = texelFetch(iChannel0, ivec2(p), 0) + 1.0; }";
    let show = "void mainImage(out vec4 o, in vec2 p) { o = textureLod(iChannel0, vec2(0.5), 9.0); }";
    let a = |filter| reads("A", filter, Wrap::Clamp);
    let mut project = project(vec![
        pass(buffer("A"), count, [nearest("A"), None, None, None]),
        image(show, [a(Filter::Nearest), None, None, None]),
    ]);
    let mut engine = ran(&gpu, &project, (4, 4), 3);
    // Mips on and off, and a double-buffered target that becomes single-buffered.
    for (drawn, change) in (3..).zip(["mips", "none", "no mips", "single"]) {
        match change {
            "mips" => project.passes[1].bindings.set(0, a(Filter::Mipmap)),
            "no mips" => project.passes[1].bindings.set(0, a(Filter::Nearest)),
            "single" => edit(&mut project, &buffer("A"), "void mainImage(out vec4 o, in vec2 p) { o = vec4(9.0); }"),
            _ => {}
        }
        let built = Program::build(&gpu, &project, &MediaSet::new(), &BuildOptions::default()).unwrap();
        engine.set_program(built.program).unwrap();
        assert_eq!(texel(&engine.read(&buffer("A")).unwrap(), 3, 3)[0], drawn as f32, "{change}");
        run(&mut engine, drawn, drawn + 1);
    }
    assert_eq!(texel(&engine.read_image().unwrap(), 0, 0), [9.0, 9.0, 9.0, 1.0]);
}

#[test]
fn texels_at_a_position_and_pictures_of_values() {
    let Some(gpu) = gpu() else { return };
    let place = "void mainImage(out vec4 o, in vec2 p) { o = vec4(p.x, p.y, iResolution.x, 2.0); }";
    let both = "void mainImage(out vec4 o, in vec2 p) {
        o = texelFetch(iChannel0, ivec2(0), 0) + texelFetch(iChannel1, ivec2(0), 0);
    }";
    let mut project = project(vec![
        pass(buffer("A"), place, Default::default()),
        pass(buffer("B"), place, Default::default()),
        image(both, [nearest("A"), nearest("B"), None, None]),
    ]);
    project.passes[1].settings.size = eddy::project::PassSize::Scale(0.5);
    project.passes[1].settings.format = TexelFormat::Rg16f;
    let mut engine = ran(&gpu, &project, (8, 4), 1);
    let texels = engine.texels_at([0.8, 0.3]).unwrap();
    let described: Vec<_> = texels.iter().map(|t| (t.pass.clone(), t.texel, t.components)).collect();
    assert_eq!(described, [(buffer("A"), (6, 1), 4), (buffer("B"), (3, 0), 2), (PassName::image(), (6, 1), 4)]);
    assert_eq!((texels[0].value, texels[1].value), ([6.5, 1.5, 8.0, 2.0], [3.5, 0.5, 0.0, 1.0]));
    assert_eq!(engine.texels_at([1.0, 1.0]).unwrap()[0].texel, (7, 3), "the edge belongs to the last texel");

    let look = ValueLook { low: 0.0, high: 8.0, channel: Some(0), ..ValueLook::default() };
    let picture = engine.picture_of_values(&buffer("A"), 0, &look).unwrap();
    let shade = |x: usize| picture.bytes[4 * x];
    assert_eq!((picture.width, picture.height), (8, 4));
    assert!((i32::from(shade(3)) - 112).abs() <= 1, "3.5 of 8 is {}", shade(3));
    // Four NaN in a buffer are shown as NaN, in violet, and not as a gap of a probe.
    engine.poison(&buffer("A"), (0, 3)).unwrap();
    let violet = engine.picture_of_values(&buffer("A"), 0, &look).unwrap().bytes[..3].to_vec();
    assert_eq!(violet, [204, 26, 230]);
    let gap = ValueLook { has_gaps: true, ..look };
    assert_ne!(engine.picture_of_values(&buffer("A"), 0, &gap).unwrap().bytes[..3], violet);
}
