//! Passes that draw meshes: the walker's rasterizer compared with the device's, and the results of `eddy trace`, the
//! debugger and the audit for such passes.
//!
//! The two round differently. A device interpolates varyings in single precision, the walker in double, so values are
//! compared with a tolerance. Coverage is decided by corners that are rounded to 1/256 of a pixel, and a position with
//! different last bits may round to another one: near an edge, and where two surfaces meet, a texel may show the other
//! surface. Those texels are counted, and each test states how many it allows.

use crate::support::{gpu, meshes::*, program::Bench, *};
use eddy::{
    debugger::{
        audit,
        trace::{Examiner, Extent, MomentKind, Origin, STEPS, TraceError, Traced, Tracer},
    },
    engine::{BuildOptions, FrameInputs, PassInputs, Pixels, Sources},
    gpu::Gpu,
    media,
    project::{self, Camera, Cull, DepthTest, MeshDraw, Pass, PassName, Project, Stage, TexelFormat},
};
use std::sync::Arc;

const SIZE: (u32, u32) = (48, 32);

/// Returns the inputs and the picture of a pass in a frame of a run.
fn drawn(gpu: &Gpu, project: &Project, pass: &PassName, size: (u32, u32), frame: i32) -> (PassInputs, Pixels) {
    let (media, _) = media::gather(project, None);
    let options = BuildOptions { requested: vec![pass.clone()], skip: false, ..BuildOptions::default() };
    let mut engine = engine_with(gpu, project, &media, &options, size);
    let inputs = |frame: i32| {
        let drag = [3.0 * frame as f32, 1.0 * frame as f32];
        FrameInputs { drag, ..FrameInputs::at_fixed_step(frame, 60.0) }
    };
    (0..frame).for_each(|frame| assert!(engine.draw(&inputs(frame)).is_ok()));
    let read = inspect(&mut engine, &inputs(frame), pass);
    (read, engine.read(pass).unwrap())
}

fn tracer<'p>(project: &Project, pass: &PassName, read: &'p PassInputs) -> Tracer<'p> {
    let index = project.passes.iter().position(|p| p.id == *pass).unwrap();
    let extent = Extent { steps: 0, ..Extent::default() };
    Tracer::new(&Sources::new(project), index, read, extent).unwrap_or_else(|e| panic!("{e}"))
}

/// The result of walking a scene.
#[derive(Debug, Default)]
struct Compared {
    clear: usize,
    covered: usize,
    /// The texels whose difference exceeds the tolerance.
    differing: Vec<String>,
}

/// Walks all texels of a scene's first target.
fn compared(gpu: &Gpu, project: &Project) -> Compared {
    let (read, device) = drawn(gpu, project, &buffer("scene"), SIZE, 0);
    let tracer = tracer(project, &buffer("scene"), &read);
    let mut compared = Compared::default();
    for pixel in (0..SIZE.1).flat_map(|y| (0..SIZE.0).map(move |x| (x, y))) {
        let trace = tracer.trace(pixel).unwrap();
        match trace.origin {
            Origin::Clear => compared.clear += 1,
            _ => compared.covered += 1,
        }
        let (value, texel) =
            (trace.value.expect("a fragment that is not discarded has a value"), texel(&device, pixel.0, pixel.1));
        let close = |(a, b): (&f32, &f32)| a == b || (a - b).abs() <= 1e-5 * b.abs().max(1.0);
        if !value.iter().zip(&texel).all(close) {
            compared.differing.push(format!("{pixel:?}: {value:?}, drawn {texel:?}, {:?}", trace.origin));
        }
    }
    compared
}

#[track_caller]
fn assert_agrees(gpu: &Gpu, what: &str, scene: eddy::project::Pass, allowed: usize) -> Compared {
    let compared = compared(gpu, &whole(scene));
    eprintln!("{what}: {} covered, {} clear, {} off", compared.covered, compared.clear, compared.differing.len());
    assert!(
        compared.differing.len() <= allowed,
        "{what}, {} texels:\n{}",
        compared.differing.len(),
        compared.differing.join("\n")
    );
    compared
}

const VERTEX: &str = "in vec3 aPosition; in vec3 aNormal; in vec2 aUv; in vec4 aColor;
out vec3 vNormal; out vec2 vUv; out vec4 vColor; flat out int vNumber;
void main() {
    vNormal = iNormalMatrix * aNormal; vUv = aUv; vColor = aColor; vNumber = gl_VertexID;
    gl_Position = iProjection * iView * iModel * vec4(aPosition, 1.0);
}";

/// Returns a fragment stage that reads the outputs of [`VERTEX`].
fn fragment(body: &str) -> String {
    format!(
        "in vec3 vNormal; in vec2 vUv; flat in int vNumber;\nlayout(location = 0) out vec4 o;\nvoid main() {{ {body} }}"
    )
}

fn rotated(mesh: &str) -> MeshDraw {
    MeshDraw { rotation: [10.0, 20.0, 30.0], position: [0.3, 0.1, -0.2], ..draw(mesh) }
}

/// The inputs of a fragment: varyings, a flat one, the built-in inputs, and their derivatives.
#[test]
fn fragment_inputs_match_the_device() {
    let Some(gpu) = gpu() else { return };
    for (what, body) in [
        ("varyings", "o = vec4(vNormal, vUv.x + vUv.y);"),
        ("flat", "o = vec4(float(vNumber), 0.0, 0.0, 1.0);"),
        ("position", "o = vec4(gl_FragCoord.xyz, 1.0 / gl_FragCoord.w);"),
        ("facing", "o = vec4(gl_FrontFacing ? 1.0 : -1.0);"),
        ("camera", "o = vec4(iCameraPosition, iModel[3].x) + iView[3];"),
    ] {
        for mesh in ["builtin:cube", "builtin:figure", "builtin:plane"] {
            let draws = vec![MeshDraw { cull: Cull::None, ..rotated(mesh) }];
            let compared = assert_agrees(&gpu, what, scene(&fragment(body), &[VERTEX], 1, camera(), draws), 0);
            assert!(compared.covered > 50 && compared.clear > 100, "{what}: {compared:?}");
        }
    }
    let slopes = fragment("o = vec4(dFdx(vUv), dFdy(vUv));");
    // On a face seen edge-on, varyings change by some 10 per pixel, and a difference has the rounding errors of both
    // operands: two texels there differ by a relative 1.5e-5.
    assert_agrees(&gpu, "derivatives", scene(&slopes, &[VERTEX], 1, camera(), vec![rotated("builtin:cube")]), 2);
}

/// Edges through the centres of pixels: from one centre to another, and between two triangles.
#[test]
fn pixel_centres_on_edges_are_covered_as_on_the_device() {
    let Some(gpu) = gpu() else { return };
    // The plane's corners are the centres of the pixels (4, 3) and (20, 19).
    let vertex = "in vec3 aPosition; flat out int vNumber; out vec3 vNormal; out vec2 vUv;
        void main() {
            vNumber = gl_VertexID; vNormal = vec3(1.0); vUv = vec2(0.5);
            vec2 at = vec2(12.5, 11.5) + 8.0 * vec2(aPosition.x, -aPosition.z);
            gl_Position = vec4(at / vec2(24.0, 16.0) - 1.0, 0.0, 1.0);
        }";
    let plane = MeshDraw { cull: Cull::None, ..draw("builtin:plane") };
    let compared =
        assert_agrees(&gpu, "edges", scene(&fragment("o = vec4(1.0);"), &[vertex], 1, straight(), vec![plane]), 0);
    assert_eq!(compared.covered, 16 * 16, "two of the four edges include their centres");
}

#[test]
fn discarded_fragments_show_the_surface_behind() {
    let Some(gpu) = gpu() else { return };
    let holes = fragment("if (fract(6.0 * vUv.x) < 0.5) discard; o = vec4(vUv, 0.0, 1.0);");
    let whole = fragment("o = vec4(vNormal, 2.0);");
    let near = rotated("builtin:cube");
    let far = MeshDraw { fragment: Stage::File(1), scale: 1.5, position: [0.0, 0.0, -2.5], ..near.clone() };
    for draws in [vec![near.clone(), far.clone()], vec![far, near]] {
        // The borders of the holes are at values of a varying, so the last bits decide.
        assert_agrees(&gpu, "discard", scene(&holes, &[VERTEX, &whole], 1, camera(), draws), 2);
    }
}

#[test]
fn meshes_are_clipped_at_the_near_and_far_planes() {
    let Some(gpu) = gpu() else { return };
    let near = Camera { near: 0.5, distance: 2.0, ..camera() };
    let floor = MeshDraw { scale: 30.0, position: [0.0, -0.6, 0.0], ..draw("builtin:plane") };
    let body = fragment("o = vec4(vUv, gl_FragCoord.z, 1.0);");
    let compared = assert_agrees(&gpu, "floor", scene(&body, &[VERTEX], 1, near, vec![floor]), 0);
    assert!(compared.covered > 300, "{compared:?}");
    let around = MeshDraw { cull: Cull::None, scale: 2.0, ..rotated("builtin:cube") };
    let compared = assert_agrees(&gpu, "around", scene(&body, &[VERTEX], 1, near, vec![around]), 0);
    assert!(compared.covered > 1000, "{compared:?}");
    let close = Camera { near: 0.5, far: 2.6, distance: 2.2, ..camera() };
    let both =
        assert_agrees(&gpu, "near and far", scene(&body, &[VERTEX], 1, close, vec![rotated("builtin:torus")]), 2);
    assert!(both.clear > 50, "{both:?}");
}

#[test]
fn culling_matches_the_device() {
    let Some(gpu) = gpu() else { return };
    let body = fragment("o = vec4(vNormal, gl_FrontFacing ? 1.0 : 0.5);");
    for cull in Cull::ALL {
        for mesh in ["builtin:cube", "builtin:knot", "builtin:plane"] {
            let draws = vec![MeshDraw { cull, rotation: [50.0, 0.0, 10.0], ..draw(mesh) }];
            assert_agrees(&gpu, &format!("{cull:?} {mesh}"), scene(&body, &[VERTEX], 1, camera(), draws), 2);
        }
    }
}

#[test]
fn every_depth_test_matches_the_device() {
    let Some(gpu) = gpu() else { return };
    let red = fragment("o = vec4(1.0, vUv, 1.0);");
    let green = fragment("o = vec4(2.0, vNormal);");
    // Depths set by the shader in steps, so that many are equal.
    let steps = fragment("o = vec4(3.0, vUv, 0.0); gl_FragDepth = floor(gl_FragCoord.z * 200.0) / 200.0;");
    let stages = [VERTEX, &green, &steps];
    for depth in DepthTest::ALL {
        let first = rotated("builtin:cube");
        let second = MeshDraw { fragment: Stage::File(1), depth, scale: 1.3, ..rotated("builtin:sphere") };
        let what = format!("{depth:?}");
        assert_agrees(&gpu, &what, scene(&red, &stages, 1, camera(), vec![first.clone(), second.clone()]), 1);
        let again = MeshDraw { depth, ..second.clone() };
        assert_agrees(&gpu, &what, scene(&red, &stages, 1, camera(), vec![draw("builtin:sphere"), again]), 1);
        let stepped = MeshDraw { fragment: Stage::File(2), ..first.clone() };
        let farther = MeshDraw { fragment: Stage::File(2), ..second };
        // A step may be within the last bits of a depth.
        assert_agrees(&gpu, &what, scene(&red, &stages, 1, camera(), vec![stepped, farther]), 3);
    }
    let quiet = MeshDraw { color_write: false, ..rotated("builtin:cube") };
    let farther = MeshDraw { fragment: Stage::File(1), scale: 1.4, ..rotated("builtin:sphere") };
    assert_agrees(&gpu, "depth alone", scene(&red, &stages, 1, camera(), vec![quiet, farther.clone()]), 1);
    let open = MeshDraw { depth_write: false, ..rotated("builtin:cube") };
    assert_agrees(&gpu, "no depth", scene(&red, &stages, 1, camera(), vec![open, farther]), 1);
}

/// Passes that draw meshes do not blend: a colour with alpha replaces the previous one.
#[test]
fn colours_replace_each_other_without_blending() {
    let Some(gpu) = gpu() else { return };
    let faint = fragment("o = vec4(vUv, 1.0, 0.25);");
    let far = MeshDraw { scale: 1.5, position: [0.0, 0.0, -2.5], ..rotated("builtin:cube") };
    let near = MeshDraw { depth_write: false, ..rotated("builtin:cube") };
    assert_agrees(&gpu, "alpha", scene(&faint, &[VERTEX], 1, camera(), vec![far, near]), 1);
    // A stage without the first output does not change the first target.
    let second = "in vec3 vNormal; layout(location = 1) out vec4 o; void main() { o = vec4(vNormal, 1.0); }";
    let draws = vec![MeshDraw { fragment: Stage::File(1), ..rotated("builtin:cube") }];
    let compared = assert_agrees(&gpu, "second", scene(&faint, &[VERTEX, second], 2, camera(), draws), 0);
    assert_eq!(compared.covered, 0);
}

/// Every mesh pass of the presets, at 200 pixels of two frames of a drag.
#[test]
fn mesh_passes_of_presets_match_the_device() {
    let Some(gpu) = gpu() else { return };
    let (mut texels, mut differing) = (0, Vec::new());
    for (name, passes) in
        [("ssao", &["geometry", "backs", "occlusion", "lighting"][..]), ("toon-outline", &["scene"][..])]
    {
        let project = project::presets::load(name).unwrap().project;
        for pass in passes.iter().map(|name| buffer(name)) {
            let Pass { body, settings, .. } = project.pass(&pass).unwrap();
            assert!(!body.is_screen());
            for frame in [0, 31] {
                let (read, device) = drawn(&gpu, &project, &pass, (160, 90), frame);
                let tracer = tracer(&project, &pass, &read);
                let mut wrong = 0;
                for (x, y) in audit::spread((20, 10), read.size) {
                    let trace = tracer.trace((x, y)).unwrap();
                    let (value, texel) = (trace.value.unwrap(), texel(&device, x, y));
                    let close =
                        |(a, b): (&f32, &f32)| a == b || (a - b).abs() <= tolerance(settings.format) * b.abs().max(1.0);
                    texels += 1;
                    if !value.iter().zip(&texel).take(settings.format.components()).all(close) {
                        wrong += 1;
                        let what = format!("{name}, {}, frame {frame}, {x},{y}", pass.title());
                        differing.push(format!("{what}: {value:?}, drawn {texel:?}, {:?}", trace.origin));
                    }
                }
                eprintln!("{name}, {}, frame {frame}: {wrong} of 200", pass.title());
            }
        }
    }
    assert!(
        texels == 2000 && 200 * differing.len() <= texels,
        "{} of {texels}:\n{}",
        differing.len(),
        differing.join("\n")
    );
}

/// Returns the tolerance: one step of 8 bits, some steps of half precision, or the interpolation error of single
/// precision.
fn tolerance(format: TexelFormat) -> f32 {
    match format {
        TexelFormat::R8 | TexelFormat::Rg8 | TexelFormat::Rgba8 => 1.01 / 255.0,
        TexelFormat::R16f | TexelFormat::Rg16f | TexelFormat::Rgba16f => 2e-3,
        TexelFormat::R32f | TexelFormat::Rg32f | TexelFormat::Rgba32f => 2e-5,
    }
}

#[test]
fn eddy_trace_names_the_triangle_and_matches_the_device() {
    let Some(b) = Bench::with_gpu() else { return };
    let run = b.line("trace ssao --pass buffer_backs --pixel 80,40 --frame 2 --size 160x90 --json").expect(0);
    let line = &run.json()[0];
    assert_eq!(line["mesh"]["front"], serde_json::json!(false), "{line}");
    assert!(line["mesh"]["name"].as_str().unwrap().starts_with("builtin:"), "{line}");
    let (value, device) = (line["value"][0].as_f64().unwrap(), line["device"][0].as_f64().unwrap());
    assert!(value < 0.0 && (value - device).abs() <= 1e-6 * device.abs(), "{line}");
    let set = |name: &str| line["steps"].as_array().unwrap().iter().any(|step| step["name"] == name);
    assert!(set("vView") && set("depth"), "{line}");
    // The corner of the picture is not covered.
    let run = b.line("trace ssao --pass buffer_backs --pixel 0,0 --size 160x90 --json").expect(0);
    let line = &run.json()[0];
    assert_eq!((&line["clear"], &line["value"][0]), (&true.into(), &line["device"][0]), "{line}");
    assert_eq!(line["steps"], serde_json::json!([]));
    let run = b.line("trace ssao --pass buffer_backs --pixel 0,0 --size 160x90").expect(0);
    assert!(run.out.contains("no triangle is drawn here"), "{}", run.out);
    let run = b.line("lab precision ssao --pass buffer_backs --pixels 8x6 --size 160x90 --json").expect(0);
    assert!(run.out.contains("\"pixels\":48"), "{}", run.out);
}

#[test]
fn a_fragment_stage_can_be_stepped_and_watched() {
    let Some(gpu) = gpu() else { return };
    let text = "in vec3 vNormal;\nin vec2 vUv;\nlayout(location = 0) out vec4 o;\nfloat twice(float x) { return 2.0 * \
                x; }\nvoid main() {\n    float a = twice(vUv.x);\n    \
                o = vec4(a, vNormal.y, 0.0, 1.0); //@print a + vUv.y\n}\n";
    let own = MeshDraw { fragment: Stage::File(1), ..rotated("builtin:cube") };
    let project = whole(scene(&fragment("o = vec4(1.0);"), &[VERTEX, text], 1, camera(), vec![own]));
    let scene = buffer("scene");
    let (read, device) = drawn(&gpu, &project, &scene, SIZE, 0);
    let traced = Traced::new(project.clone(), &scene, 0, (read.clone(), &device), [0.5, 0.5]).unwrap();
    assert_eq!(traced.tab.title(), "stage_1.glsl");
    assert!(traced.ulps().unwrap().iter().all(|ulps| *ulps < 64), "{:?} {:?}", traced.value, traced.device);
    let a = traced.value.unwrap()[0];
    let mut examiner = Examiner::new(Arc::new(traced));
    let moments = &examiner.traced.history.moments;
    let end = moments.iter().rposition(|moment| moment.kind == MomentKind::Return).unwrap();
    let uv = examiner.watch(end, "vUv").unwrap().numbers;
    assert_eq!(examiner.watch(end, "twice(vUv.x) - a").unwrap().numbers[0].as_f64(), 0.0);
    let depth = examiner.watch(end, "gl_FragCoord.z").unwrap().numbers[0].as_f64();
    assert!(0.0 < depth && depth < 1.0, "{depth}");
    assert!(examiner.watch(end, "iModel[3].x").unwrap().numbers[0].as_f64() > 0.29);
    let printed = examiner.printed();
    assert_eq!((printed.len(), printed[0].tab.title().as_str(), printed[0].line), (1, "stage_1.glsl", 6));
    let sum = printed[0].values[0].1.as_ref().unwrap().numbers[0].as_f64();
    assert!((sum - f64::from(a) - uv[1].as_f64()).abs() < 1e-6, "{sum}");
    // A pixel that no triangle covers cannot be stepped.
    match Traced::new(project, &scene, 0, (read, &device), [0.0, 0.0]) {
        Err(error @ TraceError::Clear((0, 0))) => assert!(error.to_string().contains("pixel 0,0"), "{error}"),
        other => panic!("{other:?}"),
    }
}

#[test]
fn an_audit_follows_varyings_in_both_precisions() {
    let Some(gpu) = gpu() else { return };
    let lossy = fragment("float big = 4000.0 + vUv.x; o = vec4(fract(big * big), vNormal);");
    let project = whole(scene(&lossy, &[VERTEX], 1, camera(), vec![rotated("builtin:cube")]));
    let (read, _) = drawn(&gpu, &project, &buffer("scene"), SIZE, 0);
    let index = project.passes.iter().position(|p| p.id == buffer("scene")).unwrap();
    let pixels = audit::spread((12, 8), SIZE);
    let audit = audit::audit(&Sources::new(&project), index, &read, &pixels, STEPS).unwrap();
    let worst = audit.pixels.iter().map(|pixel| pixel.error).fold(0.0, f64::max);
    assert!(worst > 0.05 && !audit.findings.is_empty(), "{worst}");
    // Varyings have the accuracy of single precision.
    let normals = audit.pixels.iter().flat_map(|p| (1..4).map(|i| (f64::from(p.single[i]) - p.double[i]).abs()));
    assert!(normals.fold(0.0, f64::max) < 1e-6);
    assert!(
        audit.pixels.iter().any(|pixel| pixel.error == 0.0 && pixel.single == [0.0; 4]),
        "some pixels are not covered"
    );
}
