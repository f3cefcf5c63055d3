//! Probes: the value of an expression in the code is drawn, without changing other results.

use crate::{
    support::{
        engine_with,
        presets::{bits, buffers},
        *,
    },
    walker_presets::inputs,
};
use eddy::{
    engine::{BuildError, BuildOptions, Builder, Engine, FrameInputs, Program, Sources},
    glsl::Probe,
    media,
    project::{Boundary, Fill, Group, PassName, Project, Region, TexelFormat, presets as all_presets},
};

const SHOW: &str = "void mainImage(out vec4 o, in vec2 p) { o = texelFetch(iChannel0, ivec2(p), 0); }";

/// Returns the probe of the first value of the expression at `text` in a pass.
fn probe_of(project: &Project, id: &PassName, text: &str) -> Option<(PassName, Probe)> {
    let index = project.passes.iter().position(|p| p.id == *id).unwrap();
    let at = project.passes[index].source.text.find(text).unwrap() as u32;
    Some((id.clone(), Probe { source: Project::pass_id(index), at, visit: 0 }))
}

/// While a value is probed, the buffers are drawn as without it, including those of a group and those that the value
/// does not need; the value is of this frame, wherever its pass is in the project.
#[test]
fn a_probe_changes_no_buffer_and_shows_this_frame() {
    let Some(gpu) = gpu() else { return };
    let step = "void mainImage(out vec4 o, vec2 p) { vec4 s = texelFetch(iChannel0, ivec2(p), 0); vec4 t = \
                texelFetch(iChannel1, ivec2(p), 0); o = s * 0.5 + t + vec4(1.0, p, 0.0); }\n";
    let reads = |names: [&str; 2]| [nearest(names[0]), nearest(names[1]), None, None];
    let image_code = "void mainImage(out vec4 o, vec2 p) {\n float one = float(iFrame);\n vec4 a = \
                      texelFetch(iChannel0, ivec2(p), 0);\n o = a + texelFetch(iChannel1, ivec2(p), 0); }\n";
    let mut project = project(vec![
        image(image_code, reads(["a", "b"])),
        pass(buffer("a"), step, reads(["a", "b"])),
        pass(buffer("b"), step, reads(["b", "a"])),
    ]);
    let group = Group { name: "both".into(), passes: vec![buffer("a"), buffer("b")], steps: 3 };
    project.groups.push(group);
    let run = |probe: Option<(PassName, &str)>| {
        let probe = probe.and_then(|(id, text)| probe_of(&project, &id, text));
        let image = || PassName::image();
        let wanted = if probe.is_some() {
            vec![BuildOptions::probed(), buffer("a"), buffer("b")]
        } else {
            vec![image(), buffer("a"), buffer("b")]
        };
        let options = BuildOptions { requested: wanted, probe, ..BuildOptions::default() };
        let mut engine = engine_with(&gpu, &project, &Default::default(), &options, (8, 4));
        (0..5).for_each(|frame| assert!(engine.draw(&FrameInputs::at_fixed_step(frame, 60.0)).is_ok()));
        let read = |engine: &mut Engine, id| engine.read(&id).unwrap().texels;
        let probed = options.probe.is_some().then(|| read(&mut engine, BuildOptions::probed()));
        (read(&mut engine, buffer("a")), read(&mut engine, buffer("b")), probed)
    };
    let (a, b, _) = run(None);
    for (id, text) in [
        (PassName::image(), "a = "),
        (PassName::image(), "one = "),
        (buffer("a"), "s * 0.5"),
        (buffer("b"), "t + vec4"),
    ] {
        let (probed_a, probed_b, value) = run(Some((id.clone(), text)));
        assert!(probed_a == a && probed_b == b, "{text} of {}", id.title());
        let value = value.unwrap();
        match text {
            // The buffers that Image reads are drawn before it, although Image is first in the project.
            "a = " => assert!(value == a),
            "one = " => assert!(value.iter().all(|v| v[0] == 4.0)),
            // In the last step of the group, after `a` was drawn.
            "t + vec4" => assert!(value == a),
            _ => assert!(value.iter().all(|v| v[0] > 0.0)),
        }
    }
}

/// A buffer draws a probed value together with its picture, in the same pass: the frame has no additional pass, and
/// every texel of every pass is identical.
#[test]
fn a_probe_of_any_buffer_of_the_presets_changes_no_texel() {
    let Some(gpu) = gpu() else { return };
    let mut seen = 0;
    for name in all_presets::names() {
        let project = all_presets::load(name).unwrap().project;
        let (media, _) = media::gather(&project, None);
        let all: Vec<PassName> = buffers(&project).cloned().collect();
        let mut builder = Builder::new(gpu.clone());
        let mut drawn = |probe: Option<(PassName, Probe)>| {
            let probed = probe.iter().map(|_| BuildOptions::probed());
            let wanted = all.iter().cloned().chain(probed).collect();
            let options = BuildOptions { requested: wanted, probe, ..BuildOptions::default() };
            let built = builder.build(&project, &media, &options).unwrap_or_else(|e| panic!("{name}: {e}"));
            let passes = built.program.plan().draws_per_frame();
            let mut engine = Engine::new(gpu.clone(), 64, 36).unwrap();
            engine.set_program(built.program).unwrap();
            (0..3).for_each(|frame| assert!(engine.draw(&inputs(frame)).is_ok()));
            let texels: Vec<_> = all.iter().map(|id| bits(&engine.read(id).unwrap())).collect();
            let value = options.probe.map(|_| engine.read(&BuildOptions::probed()).unwrap());
            (passes, texels, value)
        };
        let (passes, texels, _) = drawn(None);
        let mut texts: Vec<&str> = Vec::new();
        for (index, pass) in project.passes.iter().enumerate() {
            let text = &*pass.source.text;
            if pass.id.is_image() || !pass.id.is_picture() || !pass.body.is_screen() || texts.contains(&text) {
                continue;
            }
            texts.push(text);
            let places: Vec<usize> = text.match_indices(" = ").map(|(at, _)| at + 3).collect();
            let sources = Sources::new(&project);
            let is_value = |at: &usize| {
                let probe = Probe { source: Project::pass_id(index), at: *at as u32, visit: 0 };
                sources.probed(index, &probe).map(|_| probe)
            };
            // One in the middle of its text.
            let Some(probe) = places[places.len() / 2..].iter().find_map(is_value) else { continue };
            let (passes_probed, texels_probed, value) = drawn(Some((pass.id.clone(), probe)));
            assert_eq!(passes_probed, passes, "{name}, {}", pass.id.title());
            let others: Vec<String> =
                (0..all.len()).filter(|&i| texels_probed[i] != texels[i]).map(|i| all[i].title()).collect();
            assert_eq!(others, [""; 0], "{name}, {} probed at {}", pass.id.title(), probe.at);
            assert!(value.is_some_and(|v| !v.texels.is_empty()));
            seen += 1;
        }
    }
    assert!(seen > 40, "{seen} passes");
}

/// Where a pass discards, and outside its region, no value was evaluated; its boundary contains the author's texels,
/// and the probe the value that the pass evaluated there.
#[test]
fn undrawn_texels_have_no_probe_value() {
    let Some(gpu) = gpu() else { return };
    let code = "void mainImage(out vec4 o, vec2 p) { float x = p.x + float(iFrame); if (p.y > 3.0) discard; \
                o = texelFetch(iChannel0, ivec2(p), 0) + x; }\n";
    for format in [TexelFormat::Rgba8, TexelFormat::R16f, TexelFormat::Rgba32f] {
        let mut a = pass(buffer("A"), code, [nearest("A"), None, None, None]);
        a.settings.format = format;
        a.settings.initial = Some(Fill::expression("vec4(0.5)"));
        a.settings.boundary = Some(Boundary { width: 1, value: Fill::expression("vec4(0.25)") });
        a.settings.region = Some(Region { x: 0, y: 0, width: 5, height: 8 });
        let project = project(vec![a, image(SHOW, [nearest("A"), None, None, None])]);
        let drawn = |probe: Option<(PassName, Probe)>| {
            let probed = if probe.is_none() { PassName::image() } else { BuildOptions::probed() };
            let options = BuildOptions { requested: vec![buffer("A"), probed.clone()], probe, ..Default::default() };
            let mut engine = engine_with(&gpu, &project, &Default::default(), &options, (6, 4));
            run(&mut engine, 0, 3);
            (bits(&engine.read(&buffer("A")).unwrap()), engine.read(&probed).unwrap())
        };
        let (plain, _) = drawn(None);
        let (texels, value) = drawn(probe_of(&project, &buffer("A"), "x = "));
        assert_eq!(texels, plain, "{format:?}");
        for (x, y) in (0..4).flat_map(|y| (0..6).map(move |x| (x, y))) {
            let [first, ..] = texel(&value, x, y);
            let expected = x as f32 + 2.5;
            assert!(if x < 5 && y < 3 { first == expected } else { first.is_nan() }, "{format:?} {x} {y}: {first}");
        }
    }
}

#[test]
fn a_geometry_pass_cannot_be_probed() {
    let Some(gpu) = gpu() else { return };
    let project = all_presets::load("ssao").unwrap().project;
    let pass = project.passes.iter().find(|p| !p.body.is_screen()).unwrap().id.clone();
    let probe = Some((pass, Probe { source: Project::COMMON_ID, at: 0, visit: 0 }));
    let options = BuildOptions { requested: vec![BuildOptions::probed()], probe, ..Default::default() };
    let (media, _) = media::gather(&project, None);
    let Err(BuildError::Diagnostics { diagnostics, .. }) = Program::build(&gpu, &project, &media, &options) else {
        panic!("the pass is probed");
    };
    assert!(diagnostics.iter().any(|d| d.message.contains("cannot be probed")), "{diagnostics:?}");
}
