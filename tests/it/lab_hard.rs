//! Hard cases for which theory predicts more than a range: symmetry, limits of the device, and the texels that
//! sampling and mip levels reproduce.

use crate::support::{buffer, engine, gpu, image, nearest, pass, program::Bench, project, ran, reads, run};
use eddy::{
    engine::Engine,
    lab::{
        Extent, Rig, Setup, Shard,
        stability::{
            CheckedProject,
            run::{self as stability, Options},
        },
    },
    project::{Filter, Project, Wrap},
};

/// Returns a number between 0 and 1 for a position, unrelated to its neighbours' by any symmetry.
fn noise(x: usize, y: usize) -> f32 {
    ((x * 7919 + y * 104_729 + 13) % 1009) as f32 / 1009.0
}

type Texel = [f32; 4];

fn field((w, h): (usize, usize), of: impl Fn(usize, usize) -> Texel) -> Vec<Texel> {
    (0..w * h).map(|n| of(n % w, n / w)).collect()
}

/// Returns the field with x and y exchanged, and `swap` applied to each texel.
fn transposed(texels: &[Texel], (w, h): (usize, usize), swap: fn(Texel) -> Texel) -> Vec<Texel> {
    field((h, w), |x, y| swap(texels[x * w + y]))
}

fn max_difference(a: &[Texel], b: &[Texel]) -> f32 {
    a.iter().flatten().zip(b.iter().flatten()).map(|(a, b)| (a - b).abs()).fold(0.0, f32::max)
}

#[test]
fn a_transposed_initial_field_gives_the_transposed_result() {
    let Some(gpu) = gpu() else { return };
    let rig = Rig::new(gpu);
    let concentrations: fn(Texel) -> Texel = |t| t;
    let velocities: fn(Texel) -> Texel = |[u, v, rest, last]| [v, u, rest, last];
    let substances = |x, y| [0.3 * noise(x, y), 0.4 * noise(y + 5, x), 0.0, 1.0];
    let fluid = |x, y| [0.4 * noise(x, y) - 0.2, 0.4 * noise(y + 3, x) - 0.2, 1.0 + 0.1 * noise(x + 7, y), 0.0];
    let sizes = [(37, 23), (16, 9), (24, 24)];
    type Case = (&'static str, Option<(&'static str, &'static str)>, &'static str, bool);
    let cases: [Case; 6] = [
        ("gray_scott_stencil", Some(("STENCIL", "5")), "field", false),
        ("gray_scott_stencil", Some(("STENCIL", "9")), "field", false),
        ("diffusion_stencil", Some(("STENCIL", "9")), "field", false),
        ("fluid_guay", Some(("METHOD", "ONE_PASS")), "field", true),
        ("fluid_guay", Some(("METHOD", "FORWARD_BACKWARD")), "field", true),
        ("reaction-diffusion", None, "a", false),
    ];
    for (folder, define, name, is_flow) in cases {
        for size in sizes {
            let setup = |(w, h): (usize, usize), initial: &[Texel]| {
                let setup = Setup::new(folder, (w as u32, h as u32)).wants(&[name]).state(name, initial);
                match define {
                    Some((key, value)) => setup.define(key, value),
                    // One recipe everywhere and no sowing, which would not be symmetric.
                    None => setup.uniform("sway", 0.0).uniform("map", 0.0).uniform("sower", 0.0),
                }
            };
            let (initial, swap) = match is_flow {
                true => (field(size, fluid), velocities),
                false => (field(size, substances), concentrations),
            };
            let after = |size, initial: &[Texel]| rig.after(&setup(size, initial), 12, name).unwrap().texels().to_vec();
            let straight = transposed(&after(size, &initial), size, swap);
            let turned = after((size.1, size.0), &transposed(&initial, size, swap));
            let error = max_difference(&straight, &turned);
            // Sums are computed in another order, which rounds differently.
            assert!(error < 2e-5, "{folder} {define:?} at {size:?}: {error}");
            // The comparison can fail: components that are exchanged on one side only differ.
            let wrong = transposed(&after(size, &initial), size, |[a, b, c, d]| [b, a, c, d]);
            assert!(is_flow || max_difference(&wrong, &turned) > 1e-3, "{folder} at {size:?}");
            let same = transposed(&after(size, &initial), size, concentrations);
            assert!(!is_flow || max_difference(&same, &turned) > 1e-3, "{folder} at {size:?}");
        }
    }
}

#[test]
fn a_size_beyond_the_device_is_rejected_with_the_limit() {
    let Some(gpu) = gpu() else { return };
    let limit = gpu.device.limits().max_texture_dimension_2d;
    let subject = CheckedProject::load("feedback", &[]).unwrap();
    let options = Options {
        out: None,
        extent: Extent::Quick,
        size: Some((limit + 1, 2)),
        shard: Shard::WHOLE,
        only: Some("left alone".into()),
    };
    let error = stability::run(&gpu, &[subject], &options, |_| ()).unwrap_err().to_string();
    let expected = format!("of {}x2 pixels: this device draws at most {limit}x{limit}", limit + 1);
    assert!(error.contains(&expected), "{error}");
    let bench = Bench::new();
    let run = bench.line(&format!("render feedback --size {}x2 --out picture.png", limit + 1)).expect(2);
    assert!(run.err.contains(&expected), "{}", run.err);
    // The largest size is accepted.
    assert!(Engine::new(gpu, limit, 1).is_ok());
}

#[test]
fn texels_reach_the_clamps_only_where_theory_predicts() {
    let Some(gpu) = gpu() else { return };
    let rig = Rig::new(gpu);
    // The limits of density in solver.glsl.
    let hits = |form: f64| {
        let setup = Setup::new("fluid", (96, 54)).uniform("form", form).uniform("viscosity", 0.0).wants(&["c"]);
        let texels = rig.after(&setup, 200, "c").unwrap().component(2);
        texels[96..].iter().filter(|density| !(0.501..=2.999).contains(*density)).count()
    };
    assert_eq!(hits(1.0), 0);
    assert!(hits(0.0) > 100, "the published form is unstable without viscosity, and its clamps hide it: {}", hits(0.0));
}

/// A buffer with this colour, and a picture that reads it at `at`, a position and a level.
fn sampled(colour: &str, at: &str, wrap: Wrap) -> Project {
    let source =
        pass(buffer("A"), &format!("void mainImage(out vec4 o, in vec2 p) {{ o = {colour}; }}"), [const { None }; 4]);
    let code = format!(
        "void mainImage(out vec4 o, in vec2 p) {{ vec2 uv = p / iResolution.xy; o = textureLod(iChannel0, {at}); }}"
    );
    project(vec![source, image(&code, [reads("A", Filter::Mipmap, wrap), nearest("A"), None, None])])
}

#[test]
fn a_constant_is_sampled_unchanged_beyond_edges_and_on_all_levels_of_odd_sizes() {
    let Some(gpu) = gpu() else { return };
    for size in [(37, 23), (1, 33), (33, 1), (7, 3), (1, 1)] {
        for wrap in [Wrap::Clamp, Wrap::Repeat] {
            for level in ["0.0", "1.0", "1.5", "2.0", "9.0"] {
                let at = format!("3.0 * uv - 1.0, {level}");
                let mut engine = ran(&gpu, &sampled("vec4(0.3, -2.5, 0.7, 1.0)", &at, wrap), size, 1);
                for t in engine.read_image().unwrap().texels {
                    assert!(
                        max_difference(&[t], &[[0.3, -2.5, 0.7, 1.0]]) < 1e-6,
                        "{size:?} {wrap:?} level {level}: {t:?}"
                    );
                }
            }
        }
    }
}

#[test]
fn a_ramp_is_sampled_linearly_on_levels_of_odd_sizes_and_clamped_beyond_edges() {
    let Some(gpu) = gpu() else { return };
    let (w, h) = (37u32, 23u32);
    for level in 0..3 {
        let at = format!("uv + vec2(0.3, -0.2) / iResolution.xy, {level}.0");
        let mut engine = ran(&gpu, &sampled("vec4(p.x, p.y, p.x - 2.0 * p.y, 1.0)", &at, Wrap::Clamp), (w, h), 1);
        let pixels = engine.read_image().unwrap();
        // The first texel of a level is centred half of its width inside.
        let margin = (1 << level) + 2;
        for y in margin..h - margin {
            for x in margin..w - margin {
                let t = pixels.texels[(y * w + x) as usize];
                let (px, py) = (x as f32 + 0.8, y as f32 + 0.3);
                let exact = [px, py, px - 2.0 * py, 1.0];
                // The weights of a sampler have at least eight bits, relative to a texel of the level.
                let tolerance = (1 << level) as f32 * 3.0 / 256.0 + 1e-3;
                assert!(
                    max_difference(&[t], &[exact]) < tolerance,
                    "level {level} at ({x}, {y}): {t:?}, not {exact:?}"
                );
            }
        }
    }
    // Beyond the edge, the edge is repeated.
    let mut engine =
        engine(&gpu, &sampled("vec4(p.x, p.y, 0.0, 1.0)", "uv + vec2(1.0, 0.0), 0.0", Wrap::Clamp), (w, h));
    run(&mut engine, 0, 1);
    for (n, t) in engine.read_image().unwrap().texels.iter().enumerate() {
        let exact = [w as f32 - 0.5, (n as u32 / w) as f32 + 0.5, 0.0, 1.0];
        assert!(max_difference(&[*t], &[exact]) < 1e-3, "{n}: {t:?}, not {exact:?}");
    }
}
