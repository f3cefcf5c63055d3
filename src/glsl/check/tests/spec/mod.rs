//! Tests the rules of the specification, section by section: `spec/*.glsl` contain small programs, each after a line
//! `//ok title` or `//error title | part of the message`. A program without an entry point gets an empty one.

use super::checked;
use crate::{ChannelKind, PassKind};

const SECTIONS: [(&str, &str); 5] = [
    ("4", include_str!("section_4.glsl")),
    ("5", include_str!("section_5.glsl")),
    ("6", include_str!("section_6.glsl")),
    ("7", include_str!("section_7.glsl")),
    ("8", include_str!("section_8.glsl")),
];

#[test]
fn spec_examples_are_accepted_or_rejected() {
    let mut wrong = String::new();
    let mut count = 0;
    for (section, text) in SECTIONS {
        for case in text.split("\n//").map(|case| case.trim_start_matches("//")) {
            let (title, code) = case.split_once('\n').expect("a title line");
            let mut code = code.to_owned();
            if !code.contains("mainImage") {
                code.push_str("\nvoid mainImage(out vec4 c, in vec2 f) { c = vec4(1); }\n");
            }
            let (_, failed, messages) = checked(PassKind::Image, [ChannelKind::Sampler2D; 4], None, &code);
            let errors = messages.matches("error: ").count();
            let right = match title.split_once(' ').expect("ok or error") {
                ("ok", _) => !failed,
                ("error", title) => {
                    let (_, part) = title.split_once(" | ").expect("part of the message");
                    failed && messages.contains(part) && errors == 1
                }
                other => panic!("{other:?}"),
            };
            count += 1;
            if !right {
                wrong.push_str(&format!("---- section {section}: {title}\n{messages}\n"));
            }
        }
    }
    assert!(wrong.is_empty(), "{wrong}");
    assert!(count > 300, "{count} cases were read");
}
