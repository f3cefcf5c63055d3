//! The counts of random programs, on the device and by the walker.

use super::*;
use crate::support::counted::{count, walked};
use eddy::{
    diag::SourceId,
    glsl::{PassKind, PassSource, Text},
};

#[test]
fn counts_match_the_walker() {
    let Some(gpu) = gpu() else { return };
    for seed in 1..=number("EDDY_RANDOM_COUNTS", 20) {
        let program = make(seed);
        let code = print(&program, Form::Plain);
        let name = buffer(NAMES[0]);
        let show = image("void mainImage(out vec4 o, in vec2 p) { o = vec4(0); }", Default::default());
        let channels = [nearest(NAMES[0]), nearest(NAMES[0]), None, None];
        let project = project(vec![pass(name.clone(), &code, channels), show]);
        let options = BuildOptions { requested: vec![name.clone()], ..Default::default() };
        let mut engine = engine_with(&gpu, &project, &Default::default(), &options, (WIDTH as u32, HEIGHT as u32));
        for frame in 0..2 {
            engine.draw(&FrameInputs::at_fixed_step(frame, 60.0)).unwrap();
        }
        let counts = count(&engine, &project, &name);
        let source = PassSource::new(PassKind::Buffer, Text { id: SourceId(1), text: &code });
        let (table, runs) = walked(&mut engine, &name, &source);
        assert_eq!(counts.table.blocks.len(), table.blocks.len(), "seed {seed}\n{code}");
        assert_eq!(counts.runs, runs, "seed {seed}\n{code}");
    }
}
