//! Hard cases of which theory says more than a range: symmetry, limits of the device, and what sampling and mip
//! levels reproduce.

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

/// A number between 0 and 1 for a place, which no symmetry relates to its neighbours'.
fn noise(x: usize, y: usize) -> f32 {
    ((x * 7919 + y * 104_729 + 13) % 1009) as f32 / 1009.0
}

type Texel = [f32; 4];

fn field((w, h): (usize, usize), of: impl Fn(usize, usize) -> Texel) -> Vec<Texel> {
    (0..w * h).map(|n| of(n % w, n / w)).collect()
}

/// A field of this size with x and y changed about, and in each texel what `swap` says.
fn transposed(texels: &[Texel], (w, h): (usize, usize), swap: fn(Texel) -> Texel) -> Vec<Texel> {
    field((h, w), |x, y| swap(texels[x * w + y]))
}

fn apart(a: &[Texel], b: &[Texel]) -> f32 {
    a.iter().flatten().zip(b.iter().flatten()).map(|(a, b)| (a - b).abs()).fold(0.0, f32::max)
}

#[test]
fn a_transposed_beginning_has_the_transposed_end() {
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
            let setup = |(w, h): (usize, usize), begin: &[Texel]| {
                let setup = Setup::new(folder, (w as u32, h as u32)).wants(&[name]).state(name, begin);
                match define {
                    Some((key, value)) => setup.define(key, value),
                    // One recipe all over, and nobody who sows: neither is symmetric.
                    None => setup.uniform("sway", 0.0).uniform("map", 0.0).uniform("sower", 0.0),
                }
            };
            let (begin, swap) = match is_flow {
                true => (field(size, fluid), velocities),
                false => (field(size, substances), concentrations),
            };
            let after = |size, begin: &[Texel]| rig.after(&setup(size, begin), 12, name).unwrap().texels().to_vec();
            let straight = transposed(&after(size, &begin), size, swap);
            let turned = after((size.1, size.0), &transposed(&begin, size, swap));
            let error = apart(&straight, &turned);
            // Sums are taken in another order, which rounds otherwise.
            assert!(error < 2e-5, "{folder} {define:?} at {size:?}: {error}");
            // The measure sees what is not symmetric: components that change places on one side alone.
            let wrong = transposed(&after(size, &begin), size, |[a, b, c, d]| [b, a, c, d]);
            assert!(is_flow || apart(&wrong, &turned) > 1e-3, "{folder} at {size:?}");
            let same = transposed(&after(size, &begin), size, concentrations);
            assert!(!is_flow || apart(&same, &turned) > 1e-3, "{folder} at {size:?}");
        }
    }
}

#[test]
fn a_canvas_beyond_what_the_device_draws_is_refused_in_words() {
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
    let said = stability::run(&gpu, &[subject], &options, |_| ()).unwrap_err().to_string();
    let words = format!("of {}x2 pixels: this device draws at most {limit}x{limit}", limit + 1);
    assert!(said.contains(&words), "{said}");
    let bench = Bench::new();
    let run = bench.line(&format!("render feedback --size {}x2 --out picture.png", limit + 1)).expect(2);
    assert!(run.err.contains(&words), "{}", run.err);
    // As large as may be is drawn.
    assert!(Engine::new(gpu, limit, 1).is_ok());
}

#[test]
fn no_texel_hits_the_clamps_but_where_theory_says_so() {
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

/// A buffer with this colour, and a picture that reads it at a place and a level.
fn sampled(colour: &str, at: &str, wrap: Wrap) -> Project {
    let whole =
        pass(buffer("A"), &format!("void mainImage(out vec4 o, in vec2 p) {{ o = {colour}; }}"), [const { None }; 4]);
    let code = format!(
        "void mainImage(out vec4 o, in vec2 p) {{ vec2 uv = p / iResolution.xy; o = textureLod(iChannel0, {at}); }}"
    );
    project(vec![whole, image(&code, [reads("A", Filter::Mipmap, wrap), nearest("A"), None, None])])
}

#[test]
fn a_constant_is_a_constant_beyond_every_edge_and_on_every_level_of_odd_sizes() {
    let Some(gpu) = gpu() else { return };
    for size in [(37, 23), (1, 33), (33, 1), (7, 3), (1, 1)] {
        for wrap in [Wrap::Clamp, Wrap::Repeat] {
            for level in ["0.0", "1.0", "1.5", "2.0", "9.0"] {
                let at = format!("3.0 * uv - 1.0, {level}");
                let mut engine = ran(&gpu, &sampled("vec4(0.3, -2.5, 0.7, 1.0)", &at, wrap), size, 1);
                for t in engine.read_image().unwrap().texels {
                    assert!(apart(&[t], &[[0.3, -2.5, 0.7, 1.0]]) < 1e-6, "{size:?} {wrap:?} level {level}: {t:?}");
                }
            }
        }
    }
}

#[test]
fn a_ramp_stays_one_between_texels_and_on_levels_of_odd_sizes_and_is_level_beyond_its_edge() {
    let Some(gpu) = gpu() else { return };
    let (w, h) = (37u32, 23u32);
    for level in 0..3 {
        let at = format!("uv + vec2(0.3, -0.2) / iResolution.xy, {level}.0");
        let mut engine = ran(&gpu, &sampled("vec4(p.x, p.y, p.x - 2.0 * p.y, 1.0)", &at, Wrap::Clamp), (w, h), 1);
        let pixels = engine.read_image().unwrap();
        // A level's first texel lies half of its width inside.
        let margin = (1 << level) + 2;
        for y in margin..h - margin {
            for x in margin..w - margin {
                let t = pixels.texels[(y * w + x) as usize];
                let (px, py) = (x as f32 + 0.8, y as f32 + 0.3);
                let exact = [px, py, px - 2.0 * py, 1.0];
                // The weights of a sampler have eight bits at least, of a level's texel.
                let least = (1 << level) as f32 * 3.0 / 256.0 + 1e-3;
                assert!(apart(&[t], &[exact]) < least, "level {level} at ({x}, {y}): {t:?}, not {exact:?}");
            }
        }
    }
    // Beyond its edge lies the edge.
    let mut engine =
        engine(&gpu, &sampled("vec4(p.x, p.y, 0.0, 1.0)", "uv + vec2(1.0, 0.0), 0.0", Wrap::Clamp), (w, h));
    run(&mut engine, 0, 1);
    for (n, t) in engine.read_image().unwrap().texels.iter().enumerate() {
        let exact = [w as f32 - 0.5, (n as u32 / w) as f32 + 0.5, 0.0, 1.0];
        assert!(apart(&[*t], &[exact]) < 1e-3, "{n}: {t:?}, not {exact:?}");
    }
}
