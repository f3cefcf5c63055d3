//! Bloom presets: a spot keeps its light and its position everywhere, at every size.

use crate::support::{preset::*, *};
use eddy::{
    engine::{BuildOptions, Engine},
    gpu::Gpu,
    media::MediaSet,
    project::{PassName, Project},
};

/// A lit texel at the mouse.
const SPOT: &str = "void mainImage(out vec4 o, in vec2 p) { o = vec4(ivec2(p) == ivec2(iMouse.xy) ? 1.0 : 0.0); }";

/// Returns an engine whose Buffer A is the spot, and that probes the light in Image before its tone curve: the first
/// value of a variable there.
fn bloom_of_a_spot(gpu: &Gpu, name: &str, size: (u32, u32)) -> Engine {
    let custom_uniforms = if name == "bloom" { &["strength=1"][..] } else { &["strength=1", "calm=false"] };
    let mut project = preset(name, custom_uniforms);
    replace(&mut project, "A", SPOT);
    let index = project.image_index().unwrap();
    let declaration = if name == "bloom" { "vec3 light" } else { "vec3 wide" };
    let start = project.passes[index].source.text.find(declaration).expect(declaration);
    let at = (start + declaration.len() - 1) as u32;
    let options = BuildOptions::default().probing(PassName::image(), Project::pass_id(index), at);
    engine_with(gpu, &project, &MediaSet::new(), &options, size)
}

/// Returns the sum of the light, and the distance of its centroid from the spot in pixels.
fn total_and_shift(engine: &mut Engine, at: [u32; 2]) -> (f64, f64) {
    engine.draw(&at_frame(0, Some(at.map(|v| v as f32)))).unwrap();
    let pixels = engine.read(&BuildOptions::probed()).unwrap();
    let mut moments = [0.0; 3];
    for (i, t) in pixels.texels.iter().enumerate() {
        let (x, y, light) = (i as u32 % pixels.width, i as u32 / pixels.width, f64::from(t[0]));
        moments[0] += light;
        moments[1] += light * (f64::from(x) - f64::from(at[0]));
        moments[2] += light * (f64::from(y) - f64::from(at[1]));
    }
    (moments[0], moments[1].hypot(moments[2]) / moments[0])
}

#[test]
fn a_spot_keeps_its_light_and_its_place_at_every_phase_and_size() {
    let Some(gpu) = gpu() else { return };
    for (name, sizes) in [
        ("bloom", &[(320, 180), (333, 187), (187, 333), (321, 179)][..]),
        ("bloom-sized", &[(320, 180), (333, 187), (321, 179)]),
    ] {
        for &size in sizes {
            let mut engine = bloom_of_a_spot(&gpu, name, size);
            let (mut low, mut high, mut furthest) = (f64::MAX, 0.0f64, 0.0f64);
            // In the middle, where no light reaches an edge, over all phases of a texel of level 4 along either axis:
            // the two steps are coprime to 16.
            for i in 0..16u32 {
                let at = [size.0 / 2 - 8 + 7 * i % 16, size.1 / 2 - 8 + (11 * i + 3) % 16];
                let (sum, shift) = total_and_shift(&mut engine, at);
                (low, high, furthest) = (low.min(sum), high.max(sum), furthest.max(shift));
            }
            println!("{name} at {size:?}: {low:.4} to {high:.4} of a spot, moved by {furthest:.3} pixels at most");
            assert!(low > 0.99 && high < 1.01, "{name} at {size:?}: {low} to {high} of a spot's light");
            assert!(furthest < 0.25, "{name} at {size:?}: moved by {furthest} pixels");
        }
    }
}

#[test]
fn light_is_kept_at_the_edges_of_the_picture() {
    let Some(gpu) = gpu() else { return };
    // The pyramids of the last three sizes have texels that are partly beyond the picture's upper and right edges.
    for size in [(320, 180), (333, 187), (321, 179), (349, 201)] {
        for name in ["bloom", "bloom-sized"] {
            let mut engine = bloom_of_a_spot(&gpu, name, size);
            let (right, top) = (size.0 - 1, size.1 - 1);
            for at in [[0, 0], [right, top], [0, size.1 / 2], [right, size.1 / 2], [size.0 / 2, 3], [right - 8, 5]] {
                let (sum, _) = total_and_shift(&mut engine, at);
                assert!((sum - 1.0).abs() < 0.01, "{name} at {size:?}: {sum} of a spot at {at:?}");
            }
        }
    }
}

/// A dark wall with one texel of value 1e6.
const FIREFLY: &str = "void mainImage(out vec4 o, in vec2 p) { o = vec4(ivec2(p) == ivec2(iMouse.xy) ? 1e6 : 0.05); }";

#[test]
fn one_extremely_bright_texel_does_not_flash() {
    let Some(gpu) = gpu() else { return };
    for name in ["bloom", "bloom-sized"] {
        let shown = |custom_uniforms: &[&str]| {
            let mut project = preset(name, custom_uniforms);
            replace(&mut project, "A", FIREFLY);
            let mut engine = engine(&gpu, &project, (320, 180));
            engine.draw(&at_frame(0, Some([160.0, 90.0]))).unwrap();
            picture(&mut engine).texels
        };
        let (with, without) = (shown(&[]), shown(&["strength=0"]));
        let brighter = with.iter().zip(&without).map(|(a, b)| f64::from(a[1] - b[1]));
        let mean = brighter.clone().sum::<f64>() / with.len() as f64;
        let far = brighter.enumerate().filter(|(i, _)| {
            let (x, y) = ((i % 320) as f64 - 160.0, (i / 320) as f64 - 90.0);
            x.hypot(y) > 12.0
        });
        let far = far.map(|(_, d)| d).fold(0.0, f64::max);
        println!("{name}: the picture brighter by {mean:.4}, beyond 12 pixels by {far:.4} at most");
        assert!(mean < 0.005 && far < 0.06, "{name}: brighter by {mean}, beyond 12 pixels by {far}");
    }
}
