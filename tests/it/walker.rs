//! The walker compared with the device, and `eddy trace` and `eddy probe` with the built program.

use crate::{
    support::{gpu, program::Bench, *},
    walker_presets::inputs,
};
use eddy::{
    debugger::trace::{self, Event, Extent},
    engine::{BuildOptions, Engine, FrameInputs, Sources},
    media,
    project::{PassName, Project, presets},
};

const SIZE: (u32, u32) = (64, 36);

#[test]
fn a_trace_names_what_the_author_named_in_the_order_of_the_program() {
    let Some(gpu) = gpu() else { return };
    let code = "struct Hit { float d; vec3 n; };
Hit hit(vec2 p, float scale) {
    Hit h;
    h.d = length(p) * scale;
    h.n.y = 1.0;
    return h;
}
void mainImage(out vec4 o, in vec2 p) {
    vec2 uv = p / iResolution.xy;
    float sum = 0.0;
    for (int i = 0; i < 2; i++) {
        sum += hit(uv, 2.0).d;
    }
    o = vec4(sum, uv, 1.0);
}
";
    let project = project(vec![image(code, Default::default())]);
    let mut engine = engine(&gpu, &project, (8, 4));
    let image = PassName::image();
    let read = inspect(&mut engine, &FrameInputs::at_fixed_step(0, 60.0), &image);
    let texts = Sources::new(&project);
    let trace = trace::trace(&texts, 0, &read, (5, 1), Extent::default()).unwrap();
    let sources = project.sources();
    let lines: Vec<String> = trace
        .steps
        .iter()
        .map(|step| {
            let line = step
                .span
                .and_then(|span| sources.line_column(span))
                .map_or(String::new(), |at| format!("{}: ", at.line));
            match &step.event {
                Event::Enter(name) => format!("{name} {{"),
                Event::Leave => "}".into(),
                Event::Iteration(turn) => format!("turn {turn}"),
                Event::Set { name, value } => {
                    format!("{line}{name} = {}", value.iter().map(|n| n.to_string()).collect::<Vec<_>>().join(", "))
                }
            }
        })
        .collect();
    insta::assert_snapshot!(lines.join("\n"));
    let value = trace.value.unwrap();
    assert_eq!(value, texel(&engine.read(&image).unwrap(), 5, 1));
    let length = (5.5f64 / 8.0).hypot(1.5 / 4.0);
    assert!((trace.double.unwrap()[0] - 4.0 * length).abs() < 1e-14, "{:?}", trace.double);
    // With fewer steps kept, the others are counted.
    let short = trace::trace(&texts, 0, &read, (5, 1), Extent { steps: 3, ..Extent::default() }).unwrap();
    assert_eq!((short.steps.len(), short.left_out as usize), (3, trace.steps.len() - 3));
    let outside = trace::trace(&texts, 0, &read, (8, 0), Extent::default()).unwrap_err().to_string();
    assert_eq!(outside, "pixel 8,0 is outside the pass, which has 8 x 4 texels");
    let endless = trace::trace(&texts, 0, &read, (0, 0), Extent { statements: 10, ..Extent::default() }).unwrap_err();
    assert!(endless.to_string().contains("--max-statements"), "{endless}");
}

#[test]
fn eddy_trace_prints_every_step_and_the_distance_from_the_device() {
    let Some(b) = Bench::with_gpu() else { return };
    b.image("p/buffer_a.glsl", "fragColor = texelFetch(iChannel0, ivec2(fragCoord), 0) + vec4(0.25);");
    b.image("p/image.glsl", "vec4 past = texelFetch(iChannel0, ivec2(fragCoord), 0); fragColor = past / 3.0;");
    let run = b.line("trace p --pixel 2,1 --frame 3 --size 4x4 --json").expect(0);
    let line = &run.json()[0];
    assert_eq!((&line["frames"], &line["pass"], &line["left_out"]), (&4.into(), &"image".into(), &0.into()));
    assert_eq!(line["ulps"], serde_json::json!([0, 0, 0, 0]));
    assert_eq!(line["value"], line["device"]);
    let past = line["steps"].as_array().unwrap().iter().find(|step| step["name"] == "past").unwrap();
    assert_eq!(past["value"], serde_json::json!([1.0, 1.0, 1.0, 1.0]));
    assert_eq!((&past["source"], &past["line"]), (&"image.glsl".into(), &2.into()));
    // For the buffer, which reads the previous frame.
    let run = b.line("trace p --pass buffer_a --pixel 0,0 --frame 3 --size 4x4").expect(0);
    assert!(run.out.contains("fragColor = (1.0, 1.0, 1.0, 1.0)") && run.out.contains("(0, 0, 0, 0)"), "{}", run.out);
    b.line("trace p --pixel 4,0 --size 4x4").expect(2);
    b.line("trace p --pixel nowhere --size 4x4").expect(2);
}

/// Texels of a boundary, and outside a region, are not the values that the pass computes.
#[test]
fn trace_and_audit_know_which_texels_a_pass_does_not_draw() {
    let Some(b) = Bench::with_gpu() else { return };
    b.image("p/buffer_a.glsl", "fragColor = vec4(fragCoord, atan(fragCoord.x, fragCoord.y), 1.0);");
    b.image("p/image.glsl", "fragColor = texelFetch(iChannel0, ivec2(fragCoord), 0);");
    b.write("p/common.glsl", "float twice(float x) { float y = x + x; return y; }\n");
    let manifest = "[passes.image]\nchannels.0 = { buffer = \"A\" }\n[passes.buffer_a]\nregion = [2, 2, 6, 6]\n\
                    initial = \"vec4(7.0)\"\nboundary = { width = 1, value = \"vec4(twice(fragCoord.x), 0.25, iTime, 1.0)\" }\n";
    b.write("p/eddy.toml", manifest);
    let trace = |x: u32, y: u32, more: &str| {
        b.line(&format!("trace p --pass buffer_a --pixel {x},{y} --frame 2 --size 12x10 {more}")).expect(0)
    };
    let json = |x, y| trace(x, y, "--json").json()[0].clone();
    let edge = json(4, 0);
    assert_eq!((&edge["device"], &edge["ulps"]), (&edge["value"], &serde_json::json!([0, 0, 0, 0])), "{edge}");
    assert_eq!(edge["device"][0], serde_json::json!(9.0));
    assert_eq!((&edge["boundary"]["source"], &edge["boundary"]["line"]), (&"eddy.toml".into(), &6.into()), "{edge}");
    assert!(edge["steps"].as_array().unwrap().iter().any(|step| step["name"] == "y"), "{edge}");
    let words = trace(11, 9, "").out;
    assert!(words.contains("in the boundary of the pass: eddy.toml:6:34 overwrites the texel: vec4(twice("), "{words}");
    let kept = json(1, 1);
    assert_eq!(
        (&kept["outside"], &kept["value"]),
        (&serde_json::json!([2, 2, 6, 6]), &serde_json::Value::Null),
        "{kept}"
    );
    assert_eq!((&kept["device"][0], &kept["initial"]["line"]), (&7.0.into(), &5.into()), "{kept}");
    assert!(
        trace(8, 8, "")
            .out
            .contains("6 x 6 texels from 2,2: the texel is not drawn and keeps its initial state from eddy.toml:5")
    );
    let drawn = json(2, 7);
    assert!(drawn["boundary"].is_null() && drawn["outside"].is_null(), "{drawn}");
    assert_eq!((&drawn["value"][0], &drawn["device"][1]), (&2.5.into(), &7.5.into()));
    // A grid over the texels that the pass draws: red is exact in each.
    let run =
        b.line("lab precision p --pass buffer_a --frames 2 --size 12x10 --pixels 3x3 --map m.npy --json").expect(0);
    let audited = &run.json()[0]["double"];
    assert_eq!(audited["pixels"], 9, "{audited}");
    let map = b.npy("m.npy");
    assert!(map.texels.iter().all(|texel| texel[0] == 0.0) && map.texels.iter().any(|texel| texel[2] > 0.0));
    // A region outside the target.
    b.image("q/buffer_a.glsl", "fragColor = vec4(1.0);");
    let manifest = "[passes.image]\nchannels.0 = { buffer = \"A\" }\n[passes.buffer_a]\nregion = [40, 0, 1, 1]\n";
    b.write("q/eddy.toml", manifest);
    b.image("q/image.glsl", "fragColor = texelFetch(iChannel0, ivec2(fragCoord), 0);");
    let run = b.line("lab precision q --pass buffer_a --frames 1 --size 12x10 --json").expect(0);
    assert_eq!(run.json()[0]["double"]["pixels"], 0, "no texel is drawn");
    let run = b.line("trace q --pass buffer_a --size 12x10 --pixel 0,0").expect(0);
    assert!(run.out.contains("keeps its initial zeros"), "{}", run.out);
}

#[test]
fn eddy_probe_draws_the_value_of_an_expression() {
    let Some(b) = Bench::with_gpu() else { return };
    b.image("p/common.glsl", "");
    b.write("p/common.glsl", "float half_of(float x) { return 0.5 * x; }\n");
    b.write(
        "p/image.glsl",
        "void mainImage(out vec4 o, in vec2 p) {\n    float s = 0.0;\n    for (int i = 0; i < 4; i++) {\n        \
         if (p.x > 2.0) s += half_of(p.x) + float(i);\n    }\n    \
         vec2 uv = p / iResolution.xy;\n    o = vec4(uv, s, 0.0);\n}\n",
    );
    let probe = |at: &str, more: &str| {
        let run = b.line(&format!("probe p {at} --size 4x2 --pixel 3,1 --json {more}")).expect(0);
        run.json()[0].clone()
    };
    // `uv` at its declaration, the literal, and a variable that is read.
    assert_eq!(probe("image:6:11", "")["value"], serde_json::json!([0.875, 0.75, 0.0, 1.0]));
    assert_eq!(probe("image:7:15", "")["value"][2], serde_json::json!(0.0));
    assert_eq!(probe("image:7:14", "")["value"], serde_json::json!([0.875, 0.75, 0.0, 1.0]));
    // The third iteration of the loop, which only half of the pixels reach; and a function of Common.
    let third = probe("image:4:47", "--visit 2");
    assert_eq!((&third["value"], &third["visited"]), (&serde_json::json!([2.0, 2.0, 2.0, 1.0]), &4.into()), "{third}");
    let call = probe("common:1:38", "--out v.npy");
    assert_eq!((&call["value"][0], &call["min"][0]), (&serde_json::json!(1.75), &serde_json::json!(1.25)), "{call}");
    let npy = b.npy("v.npy");
    assert!(npy.at(3, 0)[0] == 1.75 && npy.at(0, 0).iter().all(|x| x.is_nan()));
    assert!(probe("image:4:47", "--visit 9")["value"].is_null());
    for wrong in ["image:99:1", "buffer_b:1:1", "image"] {
        b.line(&format!("probe p {wrong} --size 4x2")).expect(2);
    }
    b.line("probe p image:8:1 --size 4x2").expect(1);
}

/// Drivers compute `atan` by a polynomial; the walker's is correctly rounded.
#[test]
fn eddy_trace_names_the_first_assignment_that_differs_on_the_device() {
    let Some(b) = Bench::with_gpu() else { return };
    let code = |root: &str| {
        format!(
            "float grown(float x) {{\n    float y = x + 0.5;\n    return y;\n}}\n\
             void mainImage(out vec4 o, in vec2 p) {{\n    float s = 0.0;\n    for (int i = 0; i < 3; i++) {{\n        \
             s += grown(p.x);\n    }}\n    float t = {root};\n    vec2 v = vec2(t, s) * 2.0;\n    \
             o = vec4(v, texelFetch(iChannel0, ivec2(p), 0).x, 1.0);\n}}\n"
        )
    };
    b.write("p/eddy.toml", "eddy = 1\n[passes.buffer_a]\nchannels.0 = { buffer = \"A\" }\n[passes.image]\nchannels.0 = { buffer = \"A\" }\n");
    b.image("p/buffer_a.glsl", "fragColor = texelFetch(iChannel0, ivec2(fragCoord), 0) + 1.;");
    let json =
        |more: &str| b.line(&format!("trace p --pixel 2,1 --size 4x4 --json {more}")).expect(0).json()[0].clone();
    b.write("p/image.glsl", code("atan(p.x, p.y)"));
    let traced = json("--frame 3");
    assert_eq!((&traced["value"][2], &traced["device"][2]), (&4.0.into(), &4.0.into()), "{traced}");
    assert!(traced["ulps"][0].as_u64() > Some(0), "use another operation that is not exact on devices: {traced}");
    let parted = &traced["parted"];
    let first = &parted["first"];
    assert_eq!(
        (&first["source"], &first["line"], &first["column"], &first["text"], &first["name"]),
        (&"image.glsl".into(), &10.into(), &15.into(), &"atan(p.x, p.y)".into(), &"t".into()),
        "{parted}"
    );
    assert!(first["ulps"][0].as_u64() > Some(0) && first["walker"][0] != first["device"][0], "{parted}");
    let compared = parted["compared"].as_u64().unwrap();
    assert!(compared >= 4 && Some(compared) < parted["assignments"].as_u64(), "y and s thrice, then t: {parted}");
    let words = b.line("trace p --pixel 2,1 --size 4x4").expect(0).out;
    assert!(words.contains("differs first at image.glsl:10:15: atan(p.x, p.y)"), "{words}");
    // With fewer probes the binary search starts in the middle, and 0 probes disable it.
    assert_eq!(json("--probes 4")["parted"]["compared"], 4);
    assert!(json("--probes 0")["parted"].is_null());
    b.write("p/image.glsl", code("0.25 * p.x"));
    let agrees = json("--frame 3");
    assert!(agrees["ulps"] == serde_json::json!([0, 0, 0, 0]) && agrees["parted"].is_null(), "{agrees}");
}

/// Undefined, but the walker must predict this device's result.
#[test]
fn out_of_range_float_to_int_conversions_match_the_device() {
    let Some(b) = Bench::with_gpu() else { return };
    b.image("p.glsl", "vec2 p = fragCoord * 1e20; fragColor = vec4(int(p.x), int(-p.x), uint(p.y), uint(-p.y));");
    let run = b.line("trace p.glsl --pixel 2,1 --size 4x4 --json").expect(0);
    assert_eq!(run.json()[0]["ulps"], serde_json::json!([0, 0, 0, 0]), "{}", run.out);
}

/// Without a file name, the name is derived from the place of the expression.
#[test]
fn eddy_probe_writes_the_requested_format() {
    let Some(b) = Bench::with_gpu() else { return };
    b.write("p/common.glsl", "float half_of(float x) { return 0.5 * x; }\n");
    b.image("p/image.glsl", "fragColor = vec4(half_of(fragCoord.x));");
    let run = b.line("probe p image:2:18 --size 4x2 --pixel 3,1 --format npy").expect(0);
    assert!(run.out.contains("written to p_image_2_18.npy"), "{}", run.out);
    assert_eq!(b.npy("p_image_2_18.npy").at(3, 1)[0], 1.75);
    let run = b.line("probe p common:1:38 --size 4x2 --format png --json").expect(0);
    assert_eq!(run.json()[0]["written"], "p_common_1_38.png");
    assert_eq!(b.png("p_common_1_38.png").dimensions(), (4, 2));
    // Existing files are not overwritten without `--out`.
    b.write("p_image_2_18.npy", "mine");
    let again = b.line("probe p image:2:18 --size 4x2 --format npy").expect(2);
    assert!(again.err.contains("p_image_2_18.npy already exists") && again.err.contains("--out"), "{}", again.err);
    assert_eq!(b.bytes("p_image_2_18.npy"), b"mine");
    b.line("probe p image:2:18 --size 4x2 --out p_image_2_18.npy").expect(0);
    assert_eq!(b.npy("p_image_2_18.npy").at(0, 0)[0], 0.25);
    assert_eq!(b.names("."), ["p", "p_common_1_38.png", "p_image_2_18.npy"]);
}

/// The debugger copies a pass's inputs after the frame: they must equal those that the pass read while it was drawn.
#[test]
fn inputs_of_a_pass_are_unchanged_after_the_frame() {
    let Some(gpu) = gpu() else { return };
    let mut seen = 0;
    for name in presets::names() {
        let mut project = presets::load(name).unwrap().project;
        // A pass that is not drawn runs no code.
        project.passes.iter_mut().for_each(|pass| pass.settings.when = None);
        let (media, _) = media::gather(&project, None);
        let pictures: Vec<_> = project.passes.iter().filter(|pass| pass.id.is_picture()).collect();
        let options = BuildOptions {
            requested: pictures.iter().map(|pass| pass.id.clone()).collect(),
            ..BuildOptions::default()
        };
        let mut engine = engine_with(&gpu, &project, &media, &options, SIZE);
        (0..3).for_each(|frame| assert!(engine.draw(&inputs(frame)).is_ok()));
        for (frame, pass) in (3..).zip(pictures) {
            let read = inspect(&mut engine, &inputs(frame), &pass.id);
            let before = engine.read(&pass.id).unwrap();
            let Ok(after) = engine.inspect(&pass.id) else { continue };
            assert!(after == read, "{name}, {}", pass.id.title());
            assert_eq!(engine.read(&pass.id).unwrap().texels.len(), before.texels.len());
            seen += 1;
        }
    }
    assert!(seen > 60, "{seen} passes");
}

/// Returns a ray marcher of some 500 lines, with one sphere per line.
fn long_marcher() -> String {
    let spheres: String = (0..480)
        .map(|i| {
            let angle = f64::from(i) * 0.37;
            let (x, y) = (angle.cos() * 1.5, angle.sin() * 1.5);
            format!("    d = min(d, length(p - vec3({x:.3}, {y:.3}, {:.3})) - 0.1);\n", 3.0 + f64::from(i % 7))
        })
        .collect();
    format!(
        "float map(vec3 p) {{\n    float d = p.z - 20.0;\n    d = abs(d);\n{spheres}    return d;\n}}\n\
         void mainImage(out vec4 o, in vec2 c) {{\n    vec2 uv = (c - 0.5 * iResolution.xy) / iResolution.y;\n    \
         vec3 rd = normalize(vec3(uv, 1.0 + 0.01 * iTime));\n    float t = 0.0;\n    \
         for (int i = 0; i < 100; i++) {{\n        \
         float d = map(rd * t);\n        if (d < 0.001) break;\n        t += d;\n    }}\n    \
         o = vec4(vec3(t / 20.0), 1.0);\n}}\n"
    )
}

/// `cargo test --test it walker::cost_of -- --ignored --nocapture`
#[test]
#[ignore = "prints times, which are meaningful only on an idle machine"]
fn cost_of_a_probe_and_a_traced_pixel() {
    let Some(gpu) = gpu() else { return };
    let median = |mut list: Vec<f64>| {
        list.sort_by(f64::total_cmp);
        list[list.len() / 2]
    };
    let inputs = |frame: i32| FrameInputs::at_fixed_step(frame, 60.0);
    let mut projects: Vec<(String, Project)> = ["taa", "gallery-of-tricks", "fluid", "brick-breaker", "bloom"]
        .iter()
        .map(|name| ((*name).to_owned(), presets::load(name).unwrap().project))
        .collect();
    projects.push(("long marcher".into(), project(vec![image(&long_marcher(), Default::default())])));
    for (name, project) in projects {
        let (media, _) = media::gather(&project, None);
        let index = project.image_index().unwrap();
        let text = &project.passes[index].source.text;
        let ids = project.passes.iter().map(|p| p.id.clone()).filter(PassName::is_picture);
        let buffers: Vec<PassName> = ids.filter(|id| !id.is_image()).collect();
        let engine = |probe: Option<(PassName, eddy::glsl::Probe)>| {
            let own = if probe.is_some() { BuildOptions::probed() } else { PassName::image() };
            let wanted = [own].into_iter().chain(buffers.clone()).collect();
            let options = BuildOptions { requested: wanted, probe, ..BuildOptions::default() };
            engine_with(&gpu, &project, &media, &options, (640, 360))
        };
        let millis = |engine: &mut Engine, frame| {
            let start = std::time::Instant::now();
            engine.draw(&inputs(frame)).unwrap();
            gpu.wait().unwrap();
            start.elapsed().as_secs_f64() * 1e3
        };
        let sources = Sources::new(&project);
        let places: Vec<usize> = text.match_indices(" = ").map(|(at, _)| at + 3).collect();
        for at in [0, places.len() / 2, places.len().saturating_sub(1)].map(|i| places[i]) {
            let probe = eddy::glsl::Probe { source: Project::pass_id(index), at: at as u32, visit: 0 };
            let Some(found) = sources.probed(index, &probe) else { continue };
            // Frames of both alternate, as other processes affect the times.
            let (mut picture, mut probed) = (engine(None), engine(Some((PassName::image(), probe))));
            let pairs = (0..24).map(|frame| (millis(&mut picture, frame), millis(&mut probed, frame)));
            let pairs: Vec<(f64, f64)> = pairs.skip(3).collect();
            let ratio = median(pairs.iter().map(|(picture, probed)| probed / picture).collect());
            let frame = median(pairs.iter().map(|(picture, _)| *picture).collect());
            println!("{name}: {} at {at}: x {ratio:.3} of {frame:.2} ms", found.type_text);
        }
        let mut picture = engine(None);
        for frame in 0..3 {
            millis(&mut picture, frame);
        }
        for place in [[0.5, 0.5], [0.3, 0.6]] {
            let (read, drawn) = (picture.inspect(&PassName::image()).unwrap(), picture.read_image().unwrap());
            let start = std::time::Instant::now();
            let taken = (read, &drawn);
            let traced = trace::Traced::new(project.clone(), &PassName::image(), 2, taken, place).unwrap();
            let millis = start.elapsed().as_secs_f64() * 1e3;
            let (lines, moments) = (text.lines().count(), traced.history.moments.len());
            println!("{name}: {lines} lines, {moments} moments in {millis:.2} ms");
        }
    }
}
