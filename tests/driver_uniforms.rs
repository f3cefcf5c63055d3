//! Uniforms for a driver that recompiles a program every frame if a branch depends only on uniforms.
//!
//! A separate program, because one test measures the memory of its process; the others only compile a few lines.

#[path = "it/support/mod.rs"]
mod support;

use eddy::glsl::{self, CustomUniform, CustomUniformKind, Driver, PassKind, PassSource};
use naga::{AddressSpace, BinaryOperator, Expression, Function, Handle, Module};
use support::*;

/// Identifies a load.
type Load = Handle<Expression>;

/// Returns the number of loads from uniform blocks, and those loads that are used without being ORed with the zero.
fn loads(module: &Module, function: &Function) -> (usize, Vec<Load>) {
    let of = |handle: Load| &function.expressions[handle];
    let is_uniform = |mut pointer: Load| loop {
        match *of(pointer) {
            Expression::Access { base, .. } | Expression::AccessIndex { base, .. } => pointer = base,
            Expression::GlobalVariable(variable) => {
                break module.global_variables[variable].space == AddressSpace::Uniform;
            }
            _ => break false,
        }
    };
    let all = function.expressions.iter();
    let all: Vec<Load> = all
        .filter(|(_, e)| matches!(e, Expression::Load { pointer } if is_uniform(*pointer)))
        .map(|(load, _)| load)
        .collect();
    let is_joined = |value: Load| {
        let mut joins = function.expressions.iter();
        joins.any(
            |(_, e)| matches!(e, Expression::Binary { op: BinaryOperator::InclusiveOr, left, .. } if *left == value),
        )
    };
    let seen = |load: Load| {
        let mut bits = function.expressions.iter();
        let bits = bits.find(|(_, e)| matches!(e, Expression::As { expr, convert: None, .. } if *expr == load));
        // Integers are ORed without a bitcast.
        !is_joined(bits.map_or(load, |(bits, _)| bits))
    };
    (all.len(), all.iter().copied().filter(|load| seen(*load)).collect())
}

#[test]
fn opaque_uniforms_hide_every_uniform_load() {
    let custom_uniforms = [
        CustomUniform::new("level", CustomUniformKind::Float, 0),
        CustomUniform::new("many", CustomUniformKind::Int, 1),
        CustomUniform::new("on", CustomUniformKind::Bool, 2),
    ];
    let programs = [
        (
            PassKind::Image,
            7,
            "float f(float x[4]) { return x[0] + x[3]; }\n\
             void mainImage(out vec4 o, vec2 p) {\n\
                 o = vec4(on ? f(iChannelTime) : iChannelTime[int(p.x) & 3], iResolution.xy, iFrame);\n\
                 for (int i = 0; i < many; i++) { if (iMouse.z > level) o += iDate.wwww; }\n\
                 o.xyz += iChannelResolution[1];\n\
             }",
        ),
        (
            PassKind::Vertex,
            2,
            "in vec3 aPosition; out vec3 at;\n\
             void main() { at = iNormalMatrix * aPosition; gl_Position = iProjection * vec4(at, level); }",
        ),
        (PassKind::Fragment, 2, "in vec3 at; out vec4 o; void main() { o = vec4(iCameraPosition - at, iTime); }"),
    ];
    for (kind, at_least, code) in programs {
        let source = PassSource { kind, custom_uniforms: &custom_uniforms, ..PassSource::image(code) };
        let plain = glsl::compile(&source).unwrap_or_else(|e| panic!("{kind:?}: {e:?}"));
        let driver = Driver { opaque_uniforms: true, ..Driver::default() };
        let opaque = glsl::compile(&PassSource { driver, ..source }).unwrap_or_else(|e| panic!("{kind:?}: {e:?}"));
        let mut count = 0;
        let mut seen = [0, 0];
        for (i, module) in [&plain.module, &opaque.module].into_iter().enumerate() {
            let functions = module.functions.iter().map(|(_, f)| f);
            for function in functions.chain(module.entry_points.iter().map(|e| &e.function)) {
                let (all, bare) = loads(module, function);
                count += i * all;
                seen[i] += bare.len();
            }
        }
        assert!(count >= at_least, "{kind:?}: {count} loads");
        assert!(seen[0] >= at_least && seen[1] == 0, "{kind:?}: {seen:?} loads use uniforms directly");
        assert_eq!(plain.reflection, opaque.reflection, "{kind:?}");
    }
}

/// Counts the `Kill` statements of a block and its nested blocks.
fn kills(block: &naga::Block) -> usize {
    let of = |statement: &naga::Statement| match statement {
        naga::Statement::Kill => 1,
        naga::Statement::Block(inner) => kills(inner),
        naga::Statement::If { accept, reject, .. } => kills(accept) + kills(reject),
        _ => 0,
    };
    block.iter().map(of).sum()
}

/// `may_discard` works with and without `opaque_uniforms`, and the reflection does not report a discard.
#[test]
fn may_discard_adds_a_discard_that_reflection_omits() {
    let code = "out vec4 o; void main() { o = vec4(1); }";
    let source = PassSource { kind: PassKind::Fragment, ..PassSource::image(code) };
    for (may_discard, opaque_uniforms) in [(false, false), (false, true), (true, false), (true, true)] {
        let driver = Driver { may_discard, opaque_uniforms, ..Driver::default() };
        let compiled = glsl::compile(&PassSource { driver, ..source }).unwrap();
        assert_eq!(kills(&compiled.module.entry_points[0].function.body), usize::from(may_discard));
        assert!(!compiled.reflection.discards);
    }
}

/// Returns the resident memory of this process in bytes, or `None` if the system has no such file.
fn resident() -> Option<u64> {
    let status = std::fs::read_to_string("/proc/self/status").ok()?;
    let kilobytes = status.lines().find_map(|line| line.strip_prefix("VmRSS:")?.strip_suffix("kB"))?;
    Some(kilobytes.trim().parse::<u64>().ok()? * 1024)
}

/// A preset of many scales, whose loops and branches depend on the mouse and custom uniforms: lavapipe used to keep 2
/// MiB of compiled programs for each of its frames.
#[test]
fn drawing_frames_does_not_grow_memory() {
    let Some(gpu) = gpu() else { return };
    let project = eddy::project::presets::load("mip-fluid").expect("a preset").project;
    let mut engine = engine(&gpu, &project, (64, 36));
    run(&mut engine, 0, 40);
    let Some(before) = resident() else { return };
    run(&mut engine, 40, 240);
    let grown = resident().expect("as before").saturating_sub(before);
    assert!(grown < 64 << 20, "200 frames took {} MiB", grown >> 20);
}
