//! The knobs of whole projects, and the reasons for numbers that are none.

use crate::{Found, Kind, Knob, Range, applied};
use eddy_project::{Pass, PassName, Project, Source};

const LOOP: &str =
    "void mainImage(out vec4 o, in vec2 p) { float s = 0.; for (int i = 0; i < STEPS; i++) s += .01; o = vec4(s); }\n";

fn project(text: &str) -> Project {
    Project::of_image("test".into(), text.into())
}

fn found(text: &str) -> Found {
    Found::new(&project(text))
}

fn only(found: &Found) -> &Knob {
    assert_eq!(found.knobs.len(), 1, "{:?}", found.knobs);
    &found.knobs[0]
}

#[test]
fn a_knob_says_where_it_is_and_why_and_is_written_in_its_type() {
    let found = found(&format!("\n#define STEPS 64 // many\n{LOOP}"));
    let knob = only(&found);
    assert_eq!((knob.name.as_str(), knob.value, knob.kind, knob.grows), ("STEPS", 64.0, Kind::Count, true));
    assert_eq!(knob.place, "Image:2");
    assert_eq!(knob.why, "it bounds the loop at Image:3");
    assert_eq!(knob.ladder.values, [8.0, 16.0, 32.0, 64.0]);
    assert_eq!(knob.finest, Some(256.0));
    let before = project(&format!("\n#define STEPS 64 // many\n{LOOP}"));
    let (after, fix) = applied(&before, &found.knobs, &[16.0]);
    assert_eq!(fix.edits.len(), 1);
    assert!(after.passes[0].source.text.starts_with("\n#define STEPS 16 // many\n"), "{}", after.passes[0].source.text);
    assert_eq!(applied(&before, &found.knobs, &[64.0]).0, before, "the present setting changes nothing");
}

#[test]
fn refused_numbers_have_reasons() {
    let reason = |text: &str, name: &str| {
        let found = found(text);
        assert!(found.knobs.iter().all(|knob| knob.name != name), "{text}");
        let others = found.others.iter().map(|(_, rejected)| rejected);
        let all: Vec<_> = found.rejected.iter().chain(others).filter(|rejected| rejected.name == name).collect();
        all.first().unwrap_or_else(|| panic!("{name} in {text}: {:?}", found.rejected)).reason.clone()
    };
    assert!(reason(&format!("#define STEPS 9\nfloat a[STEPS];\n{LOOP}"), "STEPS").contains("sizes an array (Image:2)"));
    assert!(reason(&format!("#define STEPS 9\n#ifdef STEPS\n#endif\n{LOOP}"), "STEPS").contains("#ifdef asks"));
    let switch = format!("#define MODE 2\n#if MODE == 2\n#define STEPS 20\n#endif\n{LOOP}");
    assert!(reason(&switch, "MODE").contains("#if chooses code by it (Image:2)"));
    assert!(
        reason(&format!("#define STEPS 20\nconst float PI = 3.14;\n{LOOP}"), "PI").contains("no loop depends on it")
    );
    let turn = "#define TURN 6.2832\nvoid mainImage(out vec4 o, in vec2 p) { o = vec4(0); for (float t = 0.; t < TURN; t += .3) o += t; }";
    assert!(reason(turn, "TURN").contains("mathematical"));
    let small = LOOP.replace("STEPS", "3");
    assert!(found(&small).knobs.is_empty() && found(&small).others[0].1.reason.contains("small"));
    let slider = format!("#iUniform vec2 STEPS = vec2(8.0) //@tune\n{}", LOOP.replace("STEPS", "int(STEPS.x)"));
    assert!(reason(&slider, "STEPS").contains("no order"));
}

#[test]
fn names_choose_fix_and_range_knobs() {
    let text = format!("#define STEPS 64\n#define GAIN 3.0\nfloat gain() {{ return GAIN; }}\n{LOOP}");
    let mut found = found(&text);
    assert!(found.choose(&["STEP".into()]).unwrap_err().contains("the knobs are STEPS"));
    found.knob_mut("STEPS").unwrap().set_range(Range::parse("16..64:16").unwrap()).unwrap();
    assert_eq!(found.knobs[0].ladder.values, [16.0, 32.0, 48.0, 64.0]);
    assert!(!found.knobs[0].ladder.is_continuous);
    found.choose(&["GAIN".into(), "STEPS".into()]).unwrap();
    assert_eq!(found.knobs.iter().map(|knob| &*knob.name).collect::<Vec<_>>(), ["GAIN", "STEPS"]);
    assert!(Range::parse("9..3").unwrap_err().contains("above the high end"));
    assert!(Range::parse("a..3").unwrap_err().contains("16..256:16"));
    let array =
        self::found(&format!("#define STEPS 9\nfloat a[STEPS];\n{LOOP}")).choose(&["STEPS".into()]).unwrap_err();
    assert!(array.contains("cannot be a knob: it sizes an array"), "{array}");
}

#[test]
fn marked_sliders_and_settings_of_buffers_are_knobs() {
    let text = format!("#iUniform float detail = 4.0 in {{ 1.0, 8.0 }} //@tune\n{}", LOOP.replace("STEPS", "12"));
    let found = found(&text);
    let slider = found.knobs.iter().find(|knob| knob.name == "detail").unwrap();
    assert_eq!((slider.value, slider.finest), (4.0, Some(8.0)));
    assert_eq!(slider.ladder.values, [1.0, 2.0, 4.0]);
    let id = PassName::buffer("a");
    let buffer =
        Pass::new(id.clone(), Source { name: id.title(), path: None, text: LOOP.replace("STEPS", "2").into() });
    let mut project = project(&text);
    project.passes.insert(0, buffer);
    let found = Found::new(&project);
    let names: Vec<&str> =
        found.knobs.iter().filter(|knob| knob.kind == Kind::Setting).map(|knob| &*knob.name).collect();
    assert_eq!(names, ["buffer_a.size", "buffer_a.bits"]);
    let values: Vec<f64> = found.knobs.iter().map(|knob| knob.ladder.values[0]).collect();
    let (after, _) = applied(&project, &found.knobs, &values);
    assert_eq!(after.passes[0].size().of((100, 40)), (25, 10));
    assert_eq!(after.passes[0].settings.format.name(), "rgba16f");
    assert_eq!(after.custom_uniform_values["detail"].components(), [1.0]);
}
