use super::{
    Breakpoint, Event, Examiner, Extent, Iteration, MomentKind, Number, Step, Traced, Tracer,
    travel::{self, Direction, StepKind},
    ulps,
};
use eddy_engine::{PassInputs, Pixels, Sources, TextureCopy};
use eddy_project::{PassName, Project, Tab, limits};
use std::sync::Arc;

const CODE: &str = "float glow = 0.25;
struct Hit { float d; vec3 at; };
float map(vec3 p, inout float steps) {
    const float one = 1.0; steps += one;
    return length(p - vec3(0.0, 0.0, 10.0)) - 1.0;
}
void mainImage(out vec4 o, in vec2 c) {
    vec3 p = vec3(0.0), rd = vec3(0.0, 0.0, 1.0);
    float steps = 0.0;
    Hit hit;
    for (int i = 0; i < 40; i++) {
        float d = map(p, steps) * 0.5;
        p += rd * d; //@print d
        hit.at.z = p.z;
        if (d < 0.001)
            break;
    }
    glow *= 2.0;
    o = vec4(p, steps);
}
";

fn traced(code: &str) -> Traced {
    let project = Project::of_image("Untitled".into(), code.into());
    let drawn = Pixels { width: 4, height: 4, texels: vec![[0.0, 0.0, 1.0, 1.0]; 16] };
    Traced::new(project, &PassName::image(), 3, (inputs(), &drawn), [0.3, 0.3]).unwrap()
}

fn inputs() -> PassInputs {
    PassInputs {
        face: 0,
        uniforms: bytemuck::Zeroable::zeroed(),
        custom_uniforms: Vec::new(),
        channels: std::array::from_fn(|_| TextureCopy::black()),
        size: (4, 4),
        meshes: Vec::new(),
    }
}

/// Returns the line, from 1, of a moment.
fn line(traced: &Traced, at: usize) -> usize {
    traced.place(traced.history.span(at).unwrap()).unwrap().1 + 1
}

fn lines(traced: &Traced, mut at: usize, stride: StepKind, direction: Direction, count: usize) -> Vec<usize> {
    let mut found = Vec::new();
    while let Some(next) = travel::step(&traced.history, at, stride, direction).filter(|_| found.len() < count) {
        found.push(line(traced, next));
        at = next;
    }
    found
}

fn first_moment(traced: &Traced) -> usize {
    travel::end(&traced.history, Direction::Back).unwrap()
}

fn number(traced: &Traced, at: usize, name: &str) -> f64 {
    traced.history.value(at, name).unwrap_or_else(|| panic!("no {name}")).numbers[0].as_f64()
}

#[test]
fn stepping_into_over_and_out_works_in_both_directions() {
    use {Direction::*, StepKind::*};
    let traced = traced(CODE);
    let first = first_moment(&traced);
    assert_eq!(line(&traced, first), 8);
    // Two variables are declared in one line; the head of a loop is one stop at its start.
    assert_eq!(lines(&traced, first, Into, Forward, 9), [8, 9, 10, 11, 12, 4, 5, 5, 13]);
    assert_eq!(lines(&traced, first, Over, Forward, 10), [8, 9, 10, 11, 12, 13, 14, 15, 11, 12]);
    let inside = (0..).find(|at| line(&traced, *at) == 5).unwrap();
    let out = travel::step(&traced.history, inside, Out, Forward).unwrap();
    assert_eq!((line(&traced, out), traced.history.depth(out)), (13, 0));
    let back = travel::step(&traced.history, inside, Out, Back).unwrap();
    assert_eq!((line(&traced, back), traced.history.stack(inside).len()), (12, 2));
    // Backwards over the call, and into it from its end.
    assert_eq!(lines(&traced, out, Over, Back, 2), [12, 11]);
    assert_eq!(lines(&traced, out, Into, Back, 3), [5, 5, 4]);
    // Each direction ends, and every step forward is one step back.
    let last = travel::end(&traced.history, Forward).unwrap();
    assert_eq!(travel::step(&traced.history, last, Into, Forward), None);
    assert_eq!(travel::step(&traced.history, first, Into, Back), None);
    assert_eq!(travel::step(&traced.history, first, Out, Forward), Some(last));
    let there = lines(&traced, first, Into, Forward, usize::MAX);
    let mut and_back = lines(&traced, last, Into, Back, usize::MAX);
    and_back.reverse();
    assert_eq!(there[..there.len() - 1], and_back[1..]);
}

#[test]
fn variables_have_their_values_at_each_moment() {
    let traced = traced(CODE);
    let history = &traced.history;
    // At the start of the third iteration.
    let third = history.moments.iter().position(|m| m.kind == MomentKind::Iteration(3)).unwrap();
    let names: Vec<String> = history.visible(third).into_iter().map(|shown| shown.name).collect();
    assert_eq!(names, ["o", "c", "p", "rd", "steps", "hit", "i", "glow"]);
    assert_eq!([number(&traced, third, "i"), number(&traced, third, "steps")], [2.0, 2.0]);
    // The distance is halved each time: 4.5, then 2.25.
    let z = 4.5 + 2.25;
    assert_eq!(history.value(third, "p").unwrap().numbers[2], Number::Float(z));
    let hit = history.value(third, "hit").unwrap();
    assert_eq!((hit.type_text.as_str(), &hit.numbers[3]), ("Hit", &Number::Float(z)));
    assert!(history.value(third, "d").is_none(), "it is of the block that is not entered");
    // In the call, where the caller's variable has the callee's name.
    let call = history.moments.iter().rposition(|m| m.kind == MomentKind::Return && history.depth(0) == 0).unwrap();
    assert_eq!(call, history.moments.len() - 1);
    let callee = (third..).find(|at| history.depth(*at) == 1).unwrap();
    assert_eq!([number(&traced, callee, "steps"), number(&traced, callee + 1, "steps")], [2.0, 3.0]);
    assert_eq!(number(&traced, callee + 1, "one"), 1.0, "a constant, which nothing declares while it runs");
    assert!(history.value(third, "one").is_none());
    let end = (callee..).find(|at| history.moments[*at].kind == MomentKind::Return).unwrap();
    let result = history.result(end).unwrap();
    assert_eq!(result.numbers, [Number::Float(10.0 - z - 1.0)]);
    // A global before and after it is written, and the output of the pass.
    let last = history.moments.len() - 1;
    assert_eq!([number(&traced, 0, "glow"), number(&traced, last, "glow")], [0.25, 0.5]);
    let drawn: Vec<f64> = history.value(last, "o").unwrap().numbers.iter().map(|n| n.as_f64()).collect();
    assert_eq!(drawn[..3].iter().map(|x| *x as f32).collect::<Vec<_>>(), traced.value.unwrap()[..3]);
    assert_eq!((traced.pixel, traced.frame), ((1, 1), 3));
}

#[test]
fn loop_iterations_are_listed_as_rows() {
    let traced = traced(CODE);
    let history = &traced.history;
    let inside = history.moments.iter().position(|m| m.kind == MomentKind::Iteration(2)).unwrap();
    let iterations = history.iterations(inside);
    let of = |iteration: &Iteration, name: &str| {
        let values = history.iteration_values(iteration);
        values.iter().find(|shown| shown.name == name).unwrap().value.numbers[0].as_f64()
    };
    let rows: Vec<(f64, f64)> = iterations.iter().map(|iteration| (of(iteration, "i"), of(iteration, "d"))).collect();
    assert_eq!(rows[..3], [(0.0, 4.5), (1.0, 2.25), (2.0, 1.125)]);
    // 4.5 / 2^13 < 0.001.
    assert_eq!((rows.len(), rows.last().unwrap().0), (14, 13.0));
    assert!(iterations[1].first <= inside && inside <= iterations[1].end);
    assert_eq!(history.iterations(0), []);
    assert_eq!(history.iterations(history.moments.len() - 1), []);
}

#[test]
fn watch_expressions_have_the_meaning_of_the_code() {
    let mut examiner = Examiner::new(Arc::new(traced(CODE)));
    let third = examiner.traced.history.moments.iter().position(|m| m.kind == MomentKind::Iteration(3)).unwrap();
    let mut watch = |expression: &str| {
        let value = examiner.watch(third, expression);
        value.map(|value| (value.type_text, value.numbers.iter().map(|n| n.as_f64()).collect::<Vec<_>>()))
    };
    assert_eq!(watch("p.zx * 2.0"), Ok(("vec2".into(), vec![13.5, 0.0])));
    assert_eq!(watch("i == 2 && steps < 2.5"), Ok(("bool".into(), vec![1.0])));
    assert_eq!(watch("hit.at.z + glow"), Ok(("float".into(), vec![7.0])));
    assert_eq!(watch("map(p, steps)"), Ok(("float".into(), vec![2.25])));
    assert_eq!(watch("mat2(i)"), Ok(("mat2".into(), vec![2.0, 0.0, 0.0, 2.0])));
    assert_eq!(watch("steps"), Ok(("float".into(), vec![2.0])), "the call has its own copy");
    assert_eq!(watch("iResolution.x"), Ok(("float".into(), vec![0.0])));
    let wrong = watch("nothing + 1.0").unwrap_err();
    assert!(wrong.contains("nothing"), "{wrong}");
    assert_eq!(watch("hit, glow").unwrap().1, [0.25]);
    assert!(watch("i = ").is_err() && watch("").is_err() && watch("p += ; }").is_err());
    assert!(watch("discard").is_err() && watch("mainImage(o, c)").is_err());
}

#[test]
fn conditional_breakpoints_stop_in_both_directions() {
    use Direction::*;
    let mut examiner = Examiner::new(Arc::new(traced(CODE)));
    let traced = examiner.traced.clone();
    let image = Tab::image();
    let at_line = |line: usize, condition: &str| {
        [Breakpoint { tab: image.clone(), line: line - 1, condition: condition.into(), is_on: true }]
    };
    let first = first_moment(&traced);
    let stop = examiner.continue_to_breakpoint(first, &at_line(14, "i == 7 && d < 1.0"), Forward).unwrap();
    assert_eq!((line(&traced, stop), number(&traced, stop, "i")), (14, 7.0));
    let before = examiner.continue_to_breakpoint(stop, &at_line(14, ""), Back).unwrap();
    assert_eq!(number(&traced, before, "i"), 6.0);
    assert_eq!(examiner.continue_to_breakpoint(stop, &at_line(14, "i == 7"), Forward), None);
    assert_eq!(examiner.continue_to_breakpoint(stop, &at_line(14, "i == 99"), Back), None);
    // A line of Image without a statement is mapped to the next statement.
    let slid = examiner.continue_to_breakpoint(first, &at_line(2, ""), Forward).unwrap();
    assert_eq!(line(&traced, slid), 4);
    // An invalid condition stops, and has an error.
    assert!(examiner.continue_to_breakpoint(first, &at_line(14, "i =="), Forward).is_some());
    assert!(examiner.is_true_at(stop, "p").is_err() && examiner.is_true_at(stop, "d").unwrap());
    let off = Breakpoint { is_on: false, ..at_line(14, "")[0].clone() };
    assert_eq!(examiner.continue_to_breakpoint(first, &[off], Forward), None);
    let to = examiner.run_to(first, (&image, 17), Forward).unwrap();
    assert_eq!((line(&traced, to), examiner.run_to(to, (&image, 17), Forward)), (18, None));
}

#[test]
fn print_comments_show_values_at_their_position() {
    let code = CODE.replace(
        "    glow *= 2.0;",
        "    if (p.z > 1.0) { glow *= 2.0; } else { //@print p\n glow = 0.0; }\n    //@print glow",
    );
    let mut examiner = Examiner::new(Arc::new(traced(&code)));
    let printed = examiner.printed();
    let reported: Vec<(usize, &str, usize)> =
        printed.iter().map(|p| (p.line + 1, p.expression.as_str(), p.values.len())).collect();
    assert_eq!(reported, [(13, "d", 14), (18, "p", 0), (20, "glow", 1)]);
    let numbers = |index: usize| -> Vec<f64> {
        printed[index].values.iter().map(|(_, value)| value.as_ref().unwrap().numbers[0].as_f64()).collect()
    };
    assert_eq!((&numbers(0)[..3], numbers(2)), (&[4.5, 2.25, 1.125][..], vec![0.5]));
}

#[test]
fn endless_loop_has_a_partial_history() {
    let traced = traced(
        "void mainImage(out vec4 o, in vec2 c) { float x = 1.0; for (;;) { x += 1.0; if (x < 0.0) break; } \
         o = vec4(x); }",
    );
    assert!(traced.is_endless && traced.value.is_none() && !traced.history.moments.is_empty());
    assert!(traced.history.is_cut);
}

#[test]
fn ulps_count_single_precision_steps() {
    let next = |x: f32| f32::from_bits(x.to_bits() + 1);
    assert_eq!([ulps(1.0, 1.0), ulps(1.0, next(1.0)), ulps(next(-1.0), -1.0), ulps(0.0, -0.0)], [0, 1, 1, 0]);
    assert_eq!([ulps(f32::from_bits(1), -f32::from_bits(1)), ulps(f32::NAN, f32::NAN)], [2, 0]);
    assert_eq!([ulps(1.0, f32::NAN), ulps(f32::INFINITY, f32::MAX)], [u32::MAX, 1]);
}

#[test]
fn undrawn_texel_reports_its_origin() {
    use eddy_project::{Boundary, Fill, Region};
    let mut project = Project::of_image("Untitled".into(), CODE.into());
    let settings = &mut project.passes[0].settings;
    settings.region = Some(Region { x: 1, y: 1, width: 2, height: 3 });
    let refused = |project: &eddy_project::Project, place| {
        let drawn = Pixels { width: 4, height: 4, texels: vec![[0.0; 4]; 16] };
        Traced::new(project.clone(), &PassName::image(), 3, (inputs(), &drawn), place)
            .map(|_| ())
            .map_err(|e| e.to_string())
    };
    let kept = "pixel 0,1 is outside the region of the pass, 2 x 3 texels from 1,1: it is not drawn and keeps its \
                value";
    assert_eq!(refused(&project, [0.1, 0.3]), Err(kept.into()));
    assert_eq!(refused(&project, [0.3, 0.3]), Ok(()));
    let value = Fill::expression("vec4(fragCoord, 0, 1)");
    project.passes[0].settings.boundary = Some(Boundary { width: 1, value });
    let edge = "pixel 0,1 is in the boundary of the pass, which eddy.toml:1, vec4(fragCoord, 0, 1), overwrites \
                after each draw";
    assert_eq!(refused(&project, [0.1, 0.3]), Err(edge.into()));
    assert_eq!(refused(&project, [0.3, 0.3]), Ok(()));
}

#[test]
fn trace_steps_have_a_byte_limit() {
    // Each iteration sets 4,000 numbers.
    let code = "void mainImage(out vec4 o, in vec2 c) { float a[4000], b[4000]; a[0] = c.x; \
                for (int i = 0; i < 6000; i++) { b = a; a[0] += 1.0; } o = vec4(b[0]); }";
    let project = Project::of_image("Untitled".into(), code.into());
    let (sources, inputs) = (Sources::new(&project), inputs());
    let tracer = Tracer::new(&sources, 0, &inputs, Extent::default()).unwrap();
    let trace = tracer.trace((1, 1)).unwrap();
    let bytes = |step: &Step| match &step.event {
        Event::Set { name, value } => name.len() + size_of_val(value.as_slice()),
        Event::Enter(name) => name.len(),
        Event::Leave | Event::Iteration(_) => 0,
    };
    let kept: usize = trace.steps.iter().map(|step| size_of::<Step>() + bytes(step)).sum();
    assert!(trace.left_out > 0 && kept <= limits::TRACE_BYTES, "{kept} bytes, {} left out", trace.left_out);
    assert!(kept > limits::TRACE_BYTES / 2, "{kept} bytes");
}
