//! Tests of `#iUniform` lines, alone and together, and of the values that fit them.

use super::*;
use crate::Project;
use crate::{Origin, Pass, PassName, Source, json};
use eddy_diag::{SourceMap, render_all};

fn read(texts: &[&str]) -> CustomUniforms {
    CustomUniforms::read(texts.iter().enumerate().map(|(i, t)| (SourceId(i as u16), *t)))
}

#[track_caller]
fn one(line: &str) -> CustomUniform {
    let custom_uniforms = read(&[line]);
    assert_eq!(custom_uniforms.diagnostics, [], "{line}");
    assert_eq!(custom_uniforms.list.len(), 1, "{line}");
    custom_uniforms.list.into_iter().next().unwrap()
}

fn range(min: [f64; 4], max: [f64; 4]) -> Option<CustomUniformRange> {
    Some(CustomUniformRange { min, max })
}

fn project(common: Option<&str>, image: &str) -> Project {
    let source = |name: &str, text: &str| Source { name: name.into(), path: None, text: text.into() };
    let image = Pass::new(PassName::image(), source("image.glsl", image));
    Project { common: common.map(|t| source("common.glsl", t)), ..Project::new("p", vec![image], Origin::Unsaved) }
}

#[test]
fn a_backslash_continues_a_line() {
    let k = one("#iUniform float speed = 1.5 \\\r\n  in { 0.0, \\\n 5.0 }\n");
    assert_eq!((k.default, k.range), (CustomUniformValue::Float(1.5), range([0.0; 4], [5.0, 0.0, 0.0, 0.0])));
    let text = "#iUniform float speed = 1.5 \\\n in { 0.0, 5.0 }\nfloat f;";
    let blank = crate::directives::blank(text).into_owned();
    assert_eq!((blank.trim(), blank.find("float f")), ("float f;", text.find("float f")));
    assert_eq!(blank.matches('\n').count(), 2);
}

#[test]
fn lines_of_the_vs_code_extension_are_parsed() {
    let k = one("  #iUniform float speed = 1.5 in { 0.0, 5.0 } step 0.25 // note");
    assert_eq!((k.name.as_str(), k.ty, k.default), ("speed", CustomUniformType::Float, CustomUniformValue::Float(1.5)));
    assert_eq!((k.range, k.step), (range([0.0; 4], [5.0, 0.0, 0.0, 0.0]), Some([0.25, 0.0, 0.0, 0.0])));
    assert_eq!((k.span.start, k.span.end), (18, 23));
    let k = one("#iUniform float a=0.in{0.,6.5}");
    assert_eq!((k.default, k.range), (CustomUniformValue::Float(0.0), range([0.0; 4], [6.5, 0.0, 0.0, 0.0])));
    let k = one("# iUniform vec4 c = vec4(1.0) in { 0.0, 1.0 }");
    assert_eq!((k.default, k.range), (CustomUniformValue::Vector(vec![1.0; 4]), range([0.0; 4], [1.0; 4])));
    let k = one("#iUniform color3 tint = color3(1, .5, 0)");
    assert_eq!((k.default, k.range), (CustomUniformValue::Vector(vec![1.0, 0.5, 0.0]), range([0.0; 4], [1.0; 4])));
    let k = one("#iUniform vec2 at in { vec2(-1, -2), vec2(1, 2) }");
    assert_eq!(
        k.default,
        CustomUniformValue::Vector(vec![-1.0, -2.0]),
        "the least of the range where there is no default"
    );
    assert_eq!(one("#iUniform int n").default, CustomUniformValue::Int(0));
    assert_eq!(one("#iUniform bool on = true").default, CustomUniformValue::Bool(true));
    assert_eq!(
        one("#iUniform vec3 v = vec3(vec2(1, 2), -3e1);").default,
        CustomUniformValue::Vector(vec![1.0, 2.0, -30.0])
    );
    assert_eq!(read(&["/*\n#iUniform float a\n*/ // #iUniform float b\n#iUniforms float c"]).list, []);
}

#[test]
fn comments_describe_and_group_lines_group() {
    assert_eq!(
        one("#iUniform float a = 1.0 in { 0.0, 5.0 } step 0.25 // how dense, per metre").about,
        "how dense, per metre"
    );
    assert_eq!(one("#iUniform float a; //! of the lamp // and more").about, "of the lamp // and more");
    for without in
        ["#iUniform float a", "#iUniform float a //", "#iUniform float a //@print a", "#iUniform float a /* b */"]
    {
        assert_eq!(one(without).about, "", "{without}");
    }
    let text = "#iUniform float a\n//@group Light and shade\n#iUniform float b // first\n/*\n//@group no\n*/\n\
                #iUniform float c\n  // @group\n#iUniform float d\n//@groups e\n#iUniform float e\n//@group Fog\n";
    let all = read(&[text, "#iUniform float f\n#iUniform float b // second"]);
    assert_eq!(all.diagnostics, []);
    let groups: Vec<_> = all.list.iter().map(|one| (one.name.as_str(), one.group.as_str())).collect();
    let wanted = [("a", ""), ("b", "Light and shade"), ("c", "Light and shade"), ("d", ""), ("e", ""), ("f", "")];
    assert_eq!(groups, wanted, "a group is of one text");
    assert_eq!(all.get("b").unwrap().about, "first");
    assert_eq!(read(&["#iUniform float a", "#iUniform float a // later"]).list[0].about, "later");
}

#[test]
fn syntax_errors_have_a_span_and_a_fix() {
    for (line, marked, message) in [
        ("#iUniform flaot a", "flaot", "unknown slider type flaot"),
        ("#iUniform float", "t", "the uniform's name"),
        ("#iUniform float 3", "3", "the uniform's name"),
        ("#iUniform float a 1.0", "1.0", "expected `=`, `in` or the end"),
        ("#iUniform float a = ", "=", "expected a number"),
        ("#iUniform float a = b", "b", "expected a number"),
        ("#iUniform float a = 1 at", "at", "expected `in`, `step` or the end"),
        ("#iUniform float a = 1 in [0, 1]", "[", "expected `{`"),
        ("#iUniform float a = 1 in { 0, 1", "1", "expected `}`"),
        ("#iUniform float a in { 1, 0 }", "{ 1, 0 }", "ends below its start"),
        ("#iUniform float a = vec2(1, 2)", "vec2(1, 2)", "a float takes one number, not 2"),
        ("#iUniform vec3 a = vec3(1, 2)", "vec3(1, 2)", "a vec3 takes 3 numbers, or one for all, not 2"),
        ("#iUniform int a = 1.5", "1.5", "whole numbers"),
        ("#iUniform bool a = 2", "2", "true or false"),
        ("#iUniform bool a in { 0, 1 }", "in", "no range"),
        ("#iUniform float a step 0", "0", "above 0"),
        ("#iUniform float a = 1e99", "1e99", "too large"),
    ] {
        let found = read(&[line]).diagnostics;
        assert_eq!(found.len(), 1, "{line}");
        assert!(found[0].message.contains(message) && found[0].is_error(), "{line}: {:?}", found[0].message);
        assert_eq!(&line[found[0].span.unwrap().range()], marked, "{line}");
        assert!(!found[0].hints.is_empty(), "{line}");
    }
    let odd = read(&["#iUniform float a = 9 in { 0, 1 }"]);
    assert_eq!(odd.list[0].default, CustomUniformValue::Float(1.0));
    assert!(!odd.diagnostics[0].is_error() && odd.diagnostics[0].message.contains("outside"));
    for end in 0.."#iUniform vec3 é = vec3(1, 2.5e-3, é) in { 0, 1 } step 0.1 /* é".len() {
        let text = "#iUniform vec3 é = vec3(1, 2.5e-3, é) in { 0, 1 } step 0.1 /* é";
        if let Some(text) = text.get(..end) {
            let mut sources = SourceMap::default();
            sources.add("a", text);
            render_all(&read(&[text]).diagnostics, &sources);
        }
    }
}

#[test]
fn contradictory_declarations_are_reported_at_their_line() {
    let a = "#iUniform float a = 1.0";
    let custom_uniforms = read(&[a, "#iUniform float b\n#iUniform float a in { 0, 2 }", a]);
    assert_eq!(custom_uniforms.diagnostics, []);
    let names: Vec<&str> = custom_uniforms.list.iter().map(|k| k.name.as_str()).collect();
    assert_eq!(names, ["a", "b"]);
    assert_eq!(custom_uniforms.list[0].declared_in, [SourceId(0), SourceId(1), SourceId(2)]);
    assert_eq!(
        (&custom_uniforms.list[0].default, custom_uniforms.list[0].range.is_some()),
        (&CustomUniformValue::Float(1.0), true)
    );
    for (other, message) in [
        ("#iUniform int a", "`a` is a int here and a float elsewhere"),
        ("#iUniform float a = 2", "`a` has another default elsewhere"),
    ] {
        let found = read(&[a, other]).diagnostics;
        assert_eq!(found.len(), 1);
        assert_eq!(found[0].message, message);
        assert_eq!((found[0].span.unwrap().source, found[0].labels[0].span.source), (SourceId(1), SourceId(0)));
    }
}

#[test]
fn values_are_parsed_from_user_input() {
    let lines = "#iUniform float speed = 1.0 in { 0.0, 5.0 }\n#iUniform color3 tint\n#iUniform bool on\n\
    #iUniform int n in { 1, 9 }\n#iUniform vec2 at";
    let mut p = project(Some(lines), "");
    for (set, name, value) in [
        ("speed=2", "speed", CustomUniformValue::Float(2.0)),
        (" speed = .5 ", "speed", CustomUniformValue::Float(0.5)),
        ("speed=0.8400000000000001", "speed", CustomUniformValue::Float(0.84)),
        ("speed=0.800000011920929", "speed", CustomUniformValue::Float(0.8)),
        ("at=0.699999988079071,16777217", "at", CustomUniformValue::Vector(vec![0.7, 16777216.0])),
        ("tint=1,0.5, 0", "tint", CustomUniformValue::Vector(vec![1.0, 0.5, 0.0])),
        ("tint=color3(1, .5, .25)", "tint", CustomUniformValue::Vector(vec![1.0, 0.5, 0.25])),
        ("at=vec2(3)", "at", CustomUniformValue::Vector(vec![3.0; 2])),
        ("on=true", "on", CustomUniformValue::Bool(true)),
        ("n=3", "n", CustomUniformValue::Int(3)),
    ] {
        p.set_custom_uniform(set).unwrap_or_else(|e| panic!("{set}: {e}"));
        assert_eq!(p.custom_uniform_values[name], value, "{set}");
    }
    let before = p.custom_uniform_values.clone();
    for (set, message) in [
        ("sped=1", "did you mean speed?"),
        ("colour=1", "the uniforms are speed, tint, on, n and at"),
        ("speed", "viscosity=0.3"),
        ("speed=fast", "viscosity=0.3"),
        ("speed=7", "speed is outside its range, 0.0 to 5.0"),
        ("speed=1,2", "is a float and takes a number"),
        ("speed=true", "takes a number"),
        ("speed=nan", "viscosity=0.3"),
        ("tint=1", "is a color3 and takes 3 numbers"),
        ("tint=1,2,3", "outside its range, 0.0 to 1.0"),
        ("n=1.5", "a whole number"),
        ("n=0", "outside its range"),
        ("on=1", "true or false"),
    ] {
        let said = p.set_custom_uniform(set).expect_err(set);
        assert!(said.contains(message), "{set}: {said}");
    }
    assert_eq!(p.custom_uniform_values, before);
    p.set_custom_uniform("speed=1").unwrap();
    assert!(!p.custom_uniform_values.contains_key("speed"), "the default follows the text");
}

#[test]
fn a_value_out_of_range_is_kept_and_clamped_when_read() {
    let mut p = project(None, "#iUniform float a = 1 in { 0, 9 }");
    p.set_custom_uniform("a=7").unwrap();
    let narrower = read(&["#iUniform float a = 1 in { 0, 3 }"]);
    assert_eq!(narrower.list[0].value(&p.custom_uniform_values), CustomUniformValue::Float(3.0));
    let other = read(&["#iUniform vec2 a = vec2(1, 2)"]);
    assert_eq!(other.list[0].value(&p.custom_uniform_values), other.list[0].default);
}

#[test]
fn shadertoy_json_has_constants_with_the_values() {
    let mut p = project(
        Some("float f() { return speed; }\n#iUniform float speed = 1.0 in { 0.0, 5.0 } // how fast\n"),
        "\u{feff}#iUniform color3 tint\n#iUniform float speed\n#ifdef X\n#iUniform bool on = true\n#endif\nint i;",
    );
    p.set_custom_uniform("speed=0.25").unwrap();
    let (read, _) = json::import(&json::export(&p), "x.json").unwrap();
    assert_eq!(
        &*read.common.unwrap().text,
        "const float speed = 0.25;\nfloat f() { return speed; }\n// #iUniform float speed = 1.0 in { 0.0, 5.0 } // \
        how fast\n"
    );
    let image = &*read.passes[0].source.text;
    assert_eq!(
        image.trim_start_matches('\u{feff}'),
        "const vec3 tint = vec3(0.0, 0.0, 0.0);\nconst bool on = true;\n// #iUniform color3 tint\n// #iUniform float \
        speed\n\
         #ifdef X\n// #iUniform bool on = true\n#endif\nint i;"
    );
}

#[test]
fn a_value_follows_a_renamed_uniform() {
    let line = |name: &str| format!("#iUniform float {name} = 1.0 in {{ 0.0, 5.0 }} // {name}\n#iUniform bool on\n");
    let bare = |name: &str| format!("int i; #no\n  #iUniform float {name} = 1.0\n");
    let twice = format!("{}#iUniform float speed = 1.0", bare("pace"));
    let pairs = [("speed".to_owned(), "pace".to_owned())];
    for (before, after, wanted) in [
        (bare("speed"), bare("pace"), Some("pace")),
        (bare("speed"), format!("float x;\n{}", bare("pace")), Some("pace")),
        // The comment differs, too.
        (line("speed"), line("pace"), None),
        (bare("speed"), bare("pace").replace("1.0", "2.0"), None),
        (bare("speed"), "int i;".to_owned(), None),
        (bare("speed"), twice, None),
    ] {
        let mut p = project(None, &before);
        p.set_custom_uniform("speed=0.25").unwrap();
        p.passes[0].source.text = after.as_str().into();
        let renamed = p.follow_renamed_custom_uniforms(&before, &after);
        assert_eq!(renamed, if wanted.is_some() { &pairs[..] } else { &[] }, "{after}");
        let names: Vec<&str> = p.custom_uniform_values.keys().map(String::as_str).collect();
        assert_eq!(names, [wanted.unwrap_or("speed")], "{after}");
    }
    // Another text still declares it.
    let mut p = project(Some(&bare("speed")), &bare("pace"));
    p.set_custom_uniform("speed=0.25").unwrap();
    assert_eq!(p.follow_renamed_custom_uniforms(&bare("speed"), &bare("pace")), []);
    assert!(p.custom_uniform_values.contains_key("speed"));
}

#[test]
fn every_line_that_names_a_uniform_is_found() {
    let p = project(Some("#iUniform float speed\n"), "int i;\n#iUniform int speed // another type\n#iUniform\n");
    let found = p.custom_uniform_names();
    let places: Vec<(&str, u16, u32)> = found.iter().map(|(n, s)| (n.as_str(), s.source.0, s.start)).collect();
    assert_eq!(places, [("speed", 0, 16), ("speed", 1, 21)]);
}
