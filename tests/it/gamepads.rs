//! Gamepads with the built program: zeros without a recording, and the state that a recording contains.

use crate::support::{gpu, program::Bench};

const SHOW: &str = "#iChannel0 \"gamepad\"\nvoid mainImage(out vec4 o, in vec2 p) {\n\
    o = vec4(texelFetch(iChannel0, ivec2(1, 0), 0).r, texelFetch(iChannel0, ivec2(0, 2), 0).r, 0.5, 1.0); }\n";

/// Texel 1 is the left y axis of the first gamepad, texel 34 whether its first button is pressed.
#[test]
fn a_recording_contains_the_state_of_gamepads() {
    let Some(_) = gpu() else { return };
    let b = Bench::new();
    b.write("p/image.glsl", SHOW);
    b.line("render p --size 4x4 --out still.npy").expect(0);
    assert_eq!(b.npy("still.npy").at(1, 1), [0.0, 0.0, 0.5, 1.0]);
    let first = "\"delta\":0.1,\"rate\":10,\"size\":[4,4],\"mouse\":[0,0,0,0],\"date\":[0,0,0,0]";
    b.write(
        "pad.replay",
        format!(
            "{{\"eddy_recording\":1}}\n{{\"time\":0,{first}}}\n{{\"time\":0.1,\"pads\":[[1,-0.75],[34,1]]}}\n{{\"time\":0.2}}\n\
             {{\"time\":0.3,\"pads\":[]}}\n"
        ),
    );
    for (frame, expected) in [(0, [0.0, 0.0]), (1, [-0.75, 1.0]), (2, [-0.75, 1.0]), (3, [0.0, 0.0])] {
        b.line(&format!("render p --replay pad.replay --at {frame} --out {frame}.npy")).expect(0);
        let [x, y, ..] = b.npy(&format!("{frame}.npy")).at(1, 1);
        assert_eq!([x, y], expected, "frame {frame}");
    }
}
