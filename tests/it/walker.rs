//! The walker against the device, and `eddy trace` and `eddy probe` on the built program.

use crate::support::{gpu, program::Bench, *};
use eddy::{
    engine::{BuildOptions, Engine, FrameInputs, Program, Sources},
    media,
    project::{self, PassBody, presets},
    session::trace::{self, Event, Extent},
};

const SIZE: (u32, u32) = (64, 36);
/// Targets of 8 bits round, and samplers weigh their texels by 8 bits.
const LEAST: f32 = 1.01 / 255.0;

/// Every pass of every preset that draws no meshes, walked at a few pixels of the fourth frame of a drag. The last bits
/// of `sin` and its like differ between a device and the walker, and a loop may then take another turn: of all pixels,
/// no more than one in fifty may be off by more than a step of 8 bits, and each pass must agree in most.
#[test]
fn the_presets_are_walked_to_the_texels_that_the_device_draws() {
    let Some(gpu) = gpu() else { return };
    let (mut walked, mut off) = (0, Vec::new());
    for name in presets::names() {
        let project = project::load(&format!("presets/{name}")).unwrap().project;
        let (media, _) = media::gather(&project, None);
        let texts = Sources::new(&project);
        for (index, pass) in project.passes.iter().enumerate() {
            // Beyond a region, and at a boundary, the texels are not what the pass computes.
            let is_whole = pass.settings.region.is_none() && pass.settings.boundary.is_none();
            if !is_whole || !matches!(pass.settings.body, PassBody::Screen) {
                continue;
            }
            let options = BuildOptions { wanted: vec![pass.id.clone()], skip: false, ..BuildOptions::default() };
            let built = Program::build(&gpu, &project, &media, &options).unwrap();
            let mut engine = Engine::new(gpu.clone(), SIZE.0, SIZE.1).unwrap();
            engine.set_program(built.program).unwrap();
            let inputs = |frame: i32| FrameInputs {
                mouse: [20.0 + 4.0 * frame as f32, 18.0, 20.0, 18.0],
                ..FrameInputs::at_fixed_step(frame, 60.0)
            };
            (0..3).for_each(|frame| assert!(engine.draw(&inputs(frame)).is_ok()));
            let (_, read) = engine.draw_inspected(&inputs(3), &pass.id).unwrap();
            let drawn = engine.read(&pass.id).unwrap();
            let count = pass.settings.format.components();
            let mut wrong = 0;
            const PIXELS: [(u32, u32); 6] = [(0, 0), (63, 35), (31, 17), (32, 20), (9, 30), (50, 6)];
            for (x, y) in PIXELS {
                let pixel = (x % read.size.0, y % read.size.1);
                let found = trace::trace(&texts, index, &read, pixel, Extent { steps: 0, ..Extent::default() });
                let found = found.unwrap_or_else(|e| panic!("{name}, {}: {e}", pass.id.title()));
                let texel = texel(&drawn, pixel.0, pixel.1);
                walked += 1;
                let close = |(a, b): (&f32, &f32)| a == b || (a - b).abs() <= LEAST * b.abs().max(1.0);
                // What is discarded keeps what it held.
                let Some(value) = found.value else { continue };
                if !value.iter().zip(&texel).take(count).all(close) {
                    wrong += 1;
                    off.push(format!("{name}, {} at {pixel:?}: {value:?}, drawn {texel:?}", pass.id.title()));
                }
            }
            assert!(2 * wrong <= PIXELS.len(), "{name}, {}:\n{}", pass.id.title(), off.join("\n"));
        }
    }
    assert!(walked > 300 && 50 * off.len() <= walked, "{} of {walked}:\n{}", off.len(), off.join("\n"));
}

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
    let built = Program::build(&gpu, &project, &Default::default(), &Default::default()).unwrap();
    let mut engine = Engine::new(gpu, 8, 4).unwrap();
    engine.set_program(built.program).unwrap();
    let image = eddy::project::PassId::Image;
    let (_, read) = engine.draw_inspected(&FrameInputs::at_fixed_step(0, 60.0), &image).unwrap();
    let texts = Sources::new(&project);
    let trace = trace::trace(&texts, 0, &read, (5, 1), Extent::default()).unwrap();
    let sources = project.sources();
    let told: Vec<String> = trace
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
                Event::Turn(turn) => format!("turn {turn}"),
                Event::Set { name, value } => {
                    format!("{line}{name} = {}", value.iter().map(|n| n.to_string()).collect::<Vec<_>>().join(", "))
                }
            }
        })
        .collect();
    insta::assert_snapshot!(told.join("\n"));
    let value = trace.value.unwrap();
    assert_eq!(value, texel(&engine.read(&image).unwrap(), 5, 1));
    let length = (5.5f64 / 8.0).hypot(1.5 / 4.0);
    assert!((trace.double.unwrap()[0] - 4.0 * length).abs() < 1e-14, "{:?}", trace.double);
    // Fewer steps are kept, and the rest is counted.
    let short = trace::trace(&texts, 0, &read, (5, 1), Extent { steps: 3, ..Extent::default() }).unwrap();
    assert_eq!((short.steps.len(), short.left_out as usize), (3, trace.steps.len() - 3));
    let outside = trace::trace(&texts, 0, &read, (8, 0), Extent::default()).unwrap_err().to_string();
    assert_eq!(outside, "pixel 8,0 is outside of the pass, which has 8 x 4 texels");
    let endless = trace::trace(&texts, 0, &read, (0, 0), Extent { statements: 10, ..Extent::default() }).unwrap_err();
    assert!(endless.to_string().contains("--max-statements"), "{endless}");
}

#[test]
fn eddy_trace_tells_every_step_and_the_distance_from_the_device() {
    let Some(_) = gpu() else { return };
    let b = Bench::new();
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
    // Of the buffer: what it reads is the frame before.
    let run = b.line("trace p --pass buffer_a --pixel 0,0 --frame 3 --size 4x4").expect(0);
    assert!(run.out.contains("fragColor = (1.0, 1.0, 1.0, 1.0)") && run.out.contains("(0, 0, 0, 0)"), "{}", run.out);
    b.line("trace p --pixel 4,0 --size 4x4").expect(2);
    b.line("trace p --pixel nowhere --size 4x4").expect(2);
}

#[test]
fn eddy_probe_draws_the_value_of_an_expression() {
    let Some(_) = gpu() else { return };
    let b = Bench::new();
    b.image("p/common.glsl", "");
    b.write("p/common.glsl", "float half_of(float x) { return 0.5 * x; }\n");
    b.write(
        "p/image.glsl",
        "void mainImage(out vec4 o, in vec2 p) {\n    float s = 0.0;\n    for (int i = 0; i < 4; i++) {\n        if (p.x > 2.0) \
         s += half_of(p.x) + float(i);\n    }\n    vec2 uv = p / iResolution.xy;\n    o = vec4(uv, s, 0.0);\n}\n",
    );
    let probe = |at: &str, more: &str| {
        let run = b.line(&format!("probe p {at} --size 4x2 --pixel 3,1 --json {more}")).expect(0);
        run.json()[0].clone()
    };
    // `uv` where it is declared, the literal, and a variable that is used.
    assert_eq!(probe("image:6:11", "")["value"], serde_json::json!([0.875, 0.75, 0.0, 1.0]));
    assert_eq!(probe("image:7:15", "")["value"][2], serde_json::json!(0.0));
    assert_eq!(probe("image:7:14", "")["value"], serde_json::json!([0.875, 0.75, 0.0, 1.0]));
    // The third turn of the loop, where only half of the pixels come by; and a function of Common.
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
