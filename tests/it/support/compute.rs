//! Small programs that each compute one texel of a buffer, compared with the expected value.

use crate::support::*;
use eddy::{
    debugger::trace::{self, Extent},
    engine::FrameInputs,
};

/// A program and its expected result.
pub(crate) struct Case {
    /// Declarations at file scope.
    pub before: &'static str,
    /// Statements that set `vec4 r`.
    pub body: &'static str,
    pub expected: [f32; 4],
}

pub(crate) const fn case(body: &'static str, expected: [f32; 4]) -> Case {
    Case { before: "", body, expected }
}

pub(crate) const fn with(before: &'static str, body: &'static str, expected: [f32; 4]) -> Case {
    Case { before, body, expected }
}

/// Draws each case and runs it with the walker; reports all that differ.
#[track_caller]
pub(crate) fn check(cases: &[Case]) {
    if let Some(gpu) = gpu() {
        check_on(&gpu, cases, true);
    }
}

/// Draws each case without the walker: for effects of the optimiser alone.
#[track_caller]
pub(crate) fn check_optimised(cases: &[Case]) {
    if let Some(gpu) = gpu() {
        check_on(&gpu, cases, false);
    }
}

/// Like [`check`] or [`check_optimised`], on this device.
#[track_caller]
pub(crate) fn check_on(gpu: &eddy::gpu::Gpu, cases: &[Case], is_walked: bool) {
    let mut wrong = Vec::new();
    for case in cases {
        let code = format!(
            "#define Z (iTime)\n#define I (iFrame)\n#define U uint(iFrame)\n{}\n\
             vec4 compute() {{ vec4 r = vec4(-77.0); {} return r; }}\n\
             void mainImage(out vec4 o, in vec2 p) {{ o = compute(); }}",
            case.before, case.body
        );
        let show = image(
            "void mainImage(out vec4 o, in vec2 p) { o = texelFetch(iChannel0, ivec2(p), 0); }",
            [nearest("A"), None, None, None],
        );
        let project = project(vec![pass(buffer("A"), &code, Default::default()), show]);
        let built = eddy::engine::Program::build(gpu, &project, &Default::default(), &Default::default());
        let built = match built {
            Ok(built) => built,
            Err(eddy::engine::BuildError::Diagnostics { diagnostics, sources }) => {
                let text = eddy::diag::render_all(&diagnostics, &sources);
                wrong.push(format!("does not compile: {}\n{text}", case.body));
                continue;
            }
            Err(error) => panic!("{}: {error}", case.body),
        };
        let mut engine = eddy::engine::Engine::new(gpu.clone(), 1, 1).unwrap();
        engine.set_program(built.program).unwrap();
        let read = inspect(&mut engine, &FrameInputs::at_fixed_step(0, 60.0), &buffer("A"));
        let got = texel(&engine.read(&buffer("A")).unwrap(), 0, 0);
        let close = |(&got, &want): (&f32, &f32)| {
            got == want || (got.is_nan() && want.is_nan()) || (got - want).abs() <= 2e-5 * want.abs().max(1.0)
        };
        if !got.iter().zip(&case.expected).all(close) {
            wrong.push(format!("{:?}, not {:?}: {} {}", got, case.expected, case.before, case.body));
        }
        if !is_walked {
            continue;
        }
        // The walker does not depend on a driver.
        let texts = eddy::engine::Sources::new(&project);
        let walked = trace::trace(&texts, 0, &read, (0, 0), Extent { steps: 0, ..Extent::default() });
        let walked = walked.unwrap_or_else(|error| panic!("{}: {error}", case.body)).value;
        if !walked.is_some_and(|walked| walked.iter().zip(&case.expected).all(close)) {
            wrong.push(format!("walked: {walked:?}, not {:?}: {} {}", case.expected, case.before, case.body));
        }
    }
    assert!(wrong.is_empty(), "{} of {} cases:\n{}", wrong.len(), cases.len(), wrong.join("\n"));
}
