//! Passes are not drawn again while sliders at rest leave nothing to change in them, and no texel differs from those of a
//! program that draws everything. `EDDY_RANDOM_REPLAYS` is the number of random runs, `EDDY_RANDOM_SEED` the first seed.

use crate::support::{
    presets::{preset, preset_with},
    *,
};
use eddy::{
    engine::{BuildOptions, Engine, FrameInputs, PassRole},
    gpu::Gpu,
    media::{self, MediaSet},
    project::{CustomUniform, CustomUniformValue, CustomUniformValues, Project},
};
use std::env;

/// The canvas of random runs.
const SIZE: (u32, u32) = (48, 27);

/// Frames after which values rest and all passes have been looked at.
const SETTLED: i32 = 16;

/// A sequence of pseudo-random numbers: splitmix64 (G. Steele, D. Lea, C. Flood, "Fast splittable pseudorandom number
/// generators", OOPSLA 2014).
struct Random(u64);

impl Random {
    fn next(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        z ^ (z >> 31)
    }

    fn below(&mut self, count: u64) -> u64 {
        self.next() % count
    }
}

/// Passes that each stop to read something at some value of a slider: time, their own picture, a pass of the last frame,
/// a mip level, the texels that a `discard` kept.
fn tricky() -> Project {
    let uniforms = "#iUniform float turning = 0.0 in { 0.0, 2.0 }\n#iUniform int memory = 0 in { 0, 2 }\n\
                    #iUniform bool holes = false\n#iUniform float mixed = 0.0 in { 0.0, 1.0 }\n";
    let with = |code: &str| format!("{uniforms}{code}");
    let a = with(
        "vec3 turned(vec3 p, float time) { float a = turning * time; return vec3(mat2(cos(a), sin(a), -sin(a), cos(a)) \
         * p.xy, p.z); }\nvoid mainImage(out vec4 o, in vec2 p) { o = vec4(turned(vec3(p, 1.0), iTime), 1.0); \
         if (memory > 0) o += 0.5 * texelFetch(iChannel0, ivec2(p), 0); }",
    );
    let b = with(
        "void mainImage(out vec4 o, in vec2 p) { if (holes && mod(p.x + floor(8.0 * iTime), 3.0) < 1.0) discard; \
         o = texelFetch(iChannel0, ivec2(p), 0) + turning * iTime; }",
    );
    let c = with(
        "void mainImage(out vec4 o, in vec2 p) { o = vec4(0.25); for (int i = 0; i < memory; i++) \
         o += texelFetch(iChannel0, ivec2(p) + i, 0); o.y += mixed > 0.5 ? texelFetch(iChannel1, ivec2(p), 0).x : 0.0; }",
    );
    let picture = with(
        "void mainImage(out vec4 o, in vec2 p) { vec2 at = p / iResolution.xy; o = texelFetch(iChannel0, ivec2(p), 0) \
         + texelFetch(iChannel1, ivec2(p), 0); if (mixed > 0.0) o = mix(o, texture(iChannel2, at), mixed); \
         o.z += float(textureSize(iChannel2, 0).x) + float(iFrame) * turning; o.x += 1.0 / (turning * iTime); }",
    );
    project(vec![
        pass(buffer("A"), &a, [nearest("A"), None, None, None]),
        pass(buffer("B"), &b, [nearest("A"), None, None, None]),
        // It reads Image's other source one frame late.
        pass(buffer("C"), &c, [nearest("D"), nearest("B"), None, None]),
        pass(buffer("D"), &b, [nearest("C"), None, None, None]),
        image(&picture, [nearest("B"), nearest("D"), nearest("C"), None]),
    ])
}

fn value(uniform: &CustomUniform, random: &mut Random) -> Option<CustomUniformValue> {
    let (low, high) = uniform.range.map_or((-1.0, 1.0), |range| (range.min[0], range.max[0]));
    let number = match random.below(5) {
        0 | 1 => 0.0_f64.clamp(low, high),
        2 => low,
        3 => high,
        _ => low + (high - low) * random.below(1000) as f64 / 1000.0,
    };
    Some(match uniform.default {
        CustomUniformValue::Bool(_) => CustomUniformValue::Bool(random.below(2) == 1),
        CustomUniformValue::Int(_) => CustomUniformValue::Int(number.round() as i32),
        CustomUniformValue::Float(_) => CustomUniformValue::Float(number),
        _ => return None,
    })
}

fn engine_of(gpu: &Gpu, project: &Project, media: &MediaSet, skip: bool) -> Engine {
    engine_with(gpu, project, media, &BuildOptions { skip, ..BuildOptions::default() }, SIZE)
}

/// Returns the bits of all components of Image.
fn bits(engine: &mut Engine) -> Vec<u32> {
    engine.read_image().unwrap().texels.iter().flatten().map(|x| x.to_bits()).collect()
}

/// Draws a random run twice, with and without skipping, and compares the pictures. In the middle the run goes back to a
/// snapshot. Returns the number of passes that were skipped.
fn replay(gpu: &Gpu, name: &str, project: &Project, seed: u64) -> u64 {
    let mut random = Random(seed);
    let (media, _) = media::gather(project, None);
    let mut engines = [true, false].map(|skip| engine_of(gpu, project, &media, skip));
    let uniforms = engines[0].program().unwrap().custom_uniforms().to_vec();
    let mut values: CustomUniformValues = project.custom_uniform_values.clone();
    let (mut mouse, mut frame, mut skipped) = ([0.0; 4], 0, 0);
    let mut saved = None;
    for step in 0..4 {
        for _ in 0..=random.below(3) {
            let Some(uniform) = uniforms.get(random.below(uniforms.len().max(1) as u64) as usize) else { break };
            if let Some(value) = value(uniform, &mut random) {
                values.insert(uniform.name.clone(), value);
            }
        }
        if random.below(3) == 0 {
            mouse = [0; 4].map(|_| random.below(40) as f32 - 8.0);
        }
        let length = if random.below(3) == 0 { 3 } else { SETTLED + random.below(6) as i32 };
        let end = frame + length;
        while frame < end {
            let inputs = FrameInputs { mouse, ..FrameInputs::at_fixed_step(frame, 60.0) };
            for engine in &mut engines {
                engine.set_custom_uniforms(&values);
            }
            skipped += engines[0].draw(&inputs).unwrap().passes_cached;
            engines[1].draw(&inputs).unwrap();
            if frame % 4 == 0 || end - frame <= 2 || length - (end - frame) < 2 {
                let [with, without] = engines.each_mut().map(bits);
                assert!(with == without, "{name}, seed {seed}, frame {frame}: {values:?}");
            }
            frame += 1;
        }
        if step == 1 {
            saved = Some((engines.each_ref().map(|engine| engine.checkpoint().unwrap()), frame));
        }
        if let (2, Some((snapshots, at))) = (step, &saved) {
            for (engine, snapshot) in engines.iter_mut().zip(snapshots) {
                assert!(engine.restore(snapshot));
            }
            frame = *at;
        }
    }
    skipped
}

#[test]
fn random_runs_are_equal_with_and_without_skipping() {
    let Some(gpu) = gpu() else { return };
    let number = |name, default| env::var(name).ok().map_or(default, |text| text.parse().unwrap());
    let (count, first) = (number("EDDY_RANDOM_REPLAYS", 5), number("EDDY_RANDOM_SEED", 1));
    let names = ["gbuffer-edges", "gaussian-blur", "gbuffer-ssao-ssr", "toon-outline", "self-advection"];
    let mut skipped = 0;
    for seed in first..first + count {
        skipped += match seed % 8 {
            n if n < 6 && count < 20 || n < 3 => replay(&gpu, "tricky", &tricky(), seed),
            _ => {
                let name = names[(seed / 2) as usize % names.len()];
                replay(&gpu, name, &preset(name), seed)
            }
        };
    }
    assert!(skipped > 0, "nothing was skipped");
}

#[test]
fn presets_whose_sliders_stop_the_picture_draw_nothing() {
    let Some(gpu) = gpu() else { return };
    for (name, sliders) in [
        ("gbuffer-edges", &["turning=0", "redraws=0"][..]),
        ("gaussian-blur", &["turning=0"]),
        ("gbuffer-ssao-ssr", &["turning=0"]),
        ("toon-outline", &["spin=0"]),
    ] {
        let project = preset_with(name, sliders);
        let (media, _) = media::gather(&project, None);
        let mut engine = engine_of(&gpu, &project, &media, true);
        run(&mut engine, 0, SETTLED);
        let inputs = |frame| FrameInputs::at_fixed_step(frame, 60.0);
        assert_eq!(engine.draw(&inputs(SETTLED)).unwrap().passes_drawn, 0, "{name}");
        let still = bits(&mut engine);
        // A slider that moves has its effect in the same frame.
        let mut values = project.custom_uniform_values.clone();
        let moved = sliders[0].split('=').next().unwrap();
        values.insert(moved.to_owned(), CustomUniformValue::Float(1.0));
        assert!(engine.set_custom_uniforms(&values));
        assert!(engine.draw(&inputs(SETTLED + 1)).unwrap().passes_drawn > 0, "{name}");
        assert!(bits(&mut engine) != still, "{name}");
        engine.set_custom_uniforms(&project.custom_uniform_values);
        engine.draw(&inputs(SETTLED + 2)).unwrap();
        assert!(bits(&mut engine) == still, "{name}");
    }
}

#[test]
fn a_pass_whose_size_alone_is_asked_is_not_drawn() {
    let Some(gpu) = gpu() else { return };
    let a = "void mainImage(out vec4 o, in vec2 p) { o = vec4(iTime); }";
    let picture = "void mainImage(out vec4 o, in vec2 p) { o = vec4(textureSize(iChannel0, 0), 0, 1); }";
    let project =
        project(vec![pass(buffer("A"), a, [None, None, None, None]), image(picture, [nearest("A"), None, None, None])]);
    let media = MediaSet::new();
    let mut engine = engine_of(&gpu, &project, &media, true);
    assert_eq!(engine.draw(&FrameInputs::at_fixed_step(0, 60.0)).unwrap().passes_drawn, 1);
    assert_eq!(engine.draw(&FrameInputs::at_fixed_step(1, 60.0)).unwrap().passes_drawn, 0);
    assert_eq!(texel(&engine.read_image().unwrap(), 0, 0)[..2], [SIZE.0 as f32, SIZE.1 as f32]);
    let costs = engine.pass_costs(&project);
    let role = |name: &str| costs.iter().find(|cost| cost.pass.title() == name).unwrap();
    assert_eq!(role("Buffer A").role, PassRole::Unread);
    // Image writes its own texels and reads none.
    assert_eq!(role("Image").moved_bytes, u64::from(SIZE.0 * SIZE.1) * 16);
}
