use super::*;
use eddy_engine::Pixels;
use eddy_project::{CustomUniforms, Origin, Pass, PassName, Project, Source, limits};

fn pixels(texels: &[[f32; 4]]) -> Pixels {
    Pixels { width: texels.len() as u32, height: 1, texels: texels.to_vec() }
}

/// A picture by the value of its first component; the others are 0, 1 and 2.
fn picture(width: u32, height: u32, of: impl Fn(u32, u32) -> f32) -> Pixels {
    let texels = (0..height).flat_map(|y| (0..width).map(move |x| (x, y))).map(|(x, y)| [of(x, y), 0.0, 1.0, 2.0]);
    Pixels { width, height, texels: texels.collect() }
}

fn value(quantity: &str, texels: &[[f32; 4]]) -> f64 {
    Quantity::parse(quantity).unwrap().of(&pixels(texels), 4)
}

fn assertion(text: &str) -> Assertion {
    Assertion::parse(text).unwrap_or_else(|e| panic!("{text}: {e}"))
}

/// The uniforms `rate` and `wind`, and their conditions on a canvas of 640x360.
fn project() -> (CustomUniforms, Conditions) {
    let text = "#iUniform float rate = 0.5 in { 0.0, 1.0 }\n#iUniform vec2 wind = vec2(1.0, 4.0) in { -9.0, 9.0 }\n";
    let source = Source { name: "Image".into(), path: None, text: text.into() };
    let project = Project::new("p", vec![Pass::new(PassName::image(), source)], Origin::Unsaved);
    let uniforms = project.custom_uniforms();
    assert_eq!(uniforms.list.len(), 2, "{:?}", uniforms.diagnostics);
    let conditions = Conditions::new(&uniforms, &project.custom_uniform_values, (640, 360), 0.25, true);
    (uniforms, conditions)
}

fn check(text: &str, picture: &Pixels, first: f64) -> Result<(), Failure> {
    assertion(text).check(7, (picture, 4), first, &project().1)
}

#[test]
fn a_quantity_names_a_reduction_a_pass_and_components() {
    let quantity = Quantity::parse(" rms( Buffer A .y ) ").unwrap();
    assert_eq!((quantity.reduction, quantity.pass.clone()), (Some(Reduction::Rms), PassName::buffer("A")));
    assert_eq!((quantity.target, quantity.letters().as_str()), (0, "y"));
    assert_eq!(quantity.to_string(), "rms(buffer_a.y)");
    for text in [
        "sum(buffer_a.x)",
        "nonfinite(image)",
        "max(buffer_scene:1.w)",
        "mean(image.rgb)",
        "energy(image.xy) from row 3",
        "max(length(image.xz)) except the first texel",
        "min(image) except the last texel",
        "sum(image.x) at 3,5",
        "sum(image.x) at 3,5 size 16x6",
        "roughness(buffer_a:2.w) from row 1",
    ] {
        assert_eq!(Quantity::parse(text).unwrap().to_string(), text);
    }
    for (text, same) in
        [("sum(image.r)", "sum(image.x)"), ("max(image.rgba)", "max(image.xyzw)"), ("MAX(a.yx)", "max(buffer_a.xy)")]
    {
        assert_eq!(Quantity::parse(text).unwrap().to_string(), same);
    }
}

#[test]
fn malformed_quantities_are_rejected_with_the_reason() {
    for (text, says) in [
        ("", "sum, min, max, mean, rms, nonfinite, energy and roughness"),
        ("total(image)", "not `total`"),
        ("sum image", "expected `(`"),
        ("sum()", "is not the name of a pass"),
        ("sum(image.xyx)", "not `xyx`"),
        ("sum(image.xg)", "not `xg`"),
        ("sum(image.)", "not ``"),
        ("sum(image:one)", "a number from 0"),
        ("sum(image", "but the text ends"),
        ("sum(image) + 1", "unexpected `+ 1`"),
        ("image", "image has numbers for each texel: write for example max(image)"),
        ("length(image.xy)", "write for example max(length(image.xy))"),
        ("max(length(image.xy)", "expected `)` after the pass, but the text ends"),
        ("roughness(image)", "roughness is of one component: write for example roughness(image.x)"),
        ("roughness(image.xy)", "of one component"),
        ("roughness(length(image.x))", "of one component"),
        ("roughness(image.x) at 0,0", "write `from row N`"),
        ("sum(image) from 1", "expected `row` after `from`"),
        ("sum(image) from row one", "expected the number of a row"),
        ("sum(image) from row 99999999999", "expected the number of a row"),
        ("sum(image) except first texel", "expected `the last texel` or `the first texel` after `except`"),
        ("sum(image) at one", "expected two numbers from 0 on, as in at 3,5, found `one`"),
        ("sum(image) at 1", "expected `,`"),
        ("sum(image) at 1,2 size 3", "expected `x`"),
    ] {
        let message = Quantity::parse(text).expect_err(text);
        assert!(message.contains(says), "{text}: {message}");
    }
}

#[test]
fn numbers_are_reduced_in_double_precision() {
    let texels = [[1.0, -2.0, 0.0, 1.0], [3.0, 4.0, 0.0, 1.0]];
    assert_eq!(
        ["sum(image.x)", "mean(image.x)", "max(image.y)", "min(image.y)"].map(|q| value(q, &texels)),
        [4.0, 2.0, 4.0, -2.0]
    );
    assert_eq!(value("rms(image.y)", &texels), 10f64.sqrt());
    assert_eq!(value("sum(image)", &texels), 8.0, "all components");
    assert_eq!(Quantity::parse("sum(image)").unwrap().of(&pixels(&texels), 1), 4.0, "all that are stored");
    assert_eq!(["sum(image.xw)", "energy(image.xy)"].map(|q| value(q, &texels)), [6.0, 7.5]);
    assert_eq!(value("max(length(image.xy))", &texels), 5.0);
    // Single precision would lose every one of these.
    let many = vec![[1.0, 0.0, 0.0, 0.0]; (1 << 24) + 9];
    assert_eq!(value("sum(image.x)", &many), f64::from((1 << 24) + 9));
}

#[test]
fn nonfinite_values_are_counted_and_propagate() {
    let texels = [[f32::NAN, 1.0, 0.0, 0.0], [1.0, f32::INFINITY, 0.0, 0.0], [2.0, 0.0, 0.0, 0.0]];
    assert_eq!(value("nonfinite(image)", &texels), 2.0);
    for reduction in ["sum", "min", "max", "mean", "rms", "energy", "roughness"] {
        assert!(value(&format!("{reduction}(image.x)"), &texels).is_nan(), "{reduction}");
    }
    assert_eq!(value("max(image.y)", &texels), f64::INFINITY);
}

#[test]
fn roughness_distinguishes_noise_from_waves() {
    let of = |picture: &Pixels| Quantity::parse("roughness(image.x)").unwrap().of(picture, 4);
    let wave = |length: f32| picture(96, 96, move |x, y| ((x + y) as f32 * std::f32::consts::TAU / length).sin());
    let checkerboard = picture(32, 32, |x, y| if (x + y) % 2 == 0 { 1.0 } else { -1.0 });
    assert!((of(&checkerboard) - 1.0).abs() < 0.01, "{}", of(&checkerboard));
    let noise = picture(64, 64, |x, y| ((x * 7919 + y * 104_729) as f32 * 12.9898).sin().fract());
    assert!(of(&noise) > 0.2, "{}", of(&noise));
    assert!(of(&wave(8.0)) < 0.03 && of(&wave(32.0)) < 1e-3, "{} {}", of(&wave(8.0)), of(&wave(32.0)));
    // An alternation below the threshold is flat.
    let faint = picture(32, 32, |x, y| if (x + y) % 2 == 0 { 1.0 } else { 1.001 });
    assert_eq!(of(&faint), 0.0);
    assert_eq!(of(&picture(32, 7, |x, _| x as f32)), 0.0, "too few rows");
    let late = Quantity::parse("roughness(image.x) from row 4294967295").unwrap();
    assert_eq!(late.of(&checkerboard, 4), 0.0, "no rows");
}

#[test]
fn assertions_are_checked_against_values() {
    for (claim, value, holds) in [
        ("sum(image.x) within 1e-4 of 1", 1.00005, true),
        ("sum(image.x) within 1e-4 of 1", 1.0002, false),
        ("sum(image.x) within 1e-4 of 1", f32::NAN, false),
        ("mean(image.x) within 1% of first", 101.0, true),
        ("mean(image.x) within 1%of first", 98.0, false),
        ("mean(image.x) <= first + 1", 101.0, true),
        ("max(image.x) <= 1", 1.0, true),
        ("max(image.x) < 1", 1.0, false),
        ("min(image.x)>=-.5", -0.5, true),
        ("min(image.x) > -.5", -0.5, false),
        ("nonfinite(image.x) == 0", 0.0, true),
        ("nonfinite(image.x) = 0", f32::INFINITY, false),
        ("max(image.x) < inf", f32::NAN, false),
        ("max(image.x) <= INF", f32::INFINITY, true),
        ("max(image.x) < 1e999", 1e30, true),
        ("max(image.x) > -infinity", -1e30, true),
        ("max(image.x) <= +2.", 2.0, true),
        ("max(image.x) in 0..2", 2.0, true),
        ("max(image.x) in 0..2", 2.5, false),
        ("max(image.x) in -inf..inf", f32::INFINITY, false),
        ("image.x in 0.5..1.5", 0.5, true),
        ("image.x <= 1", 1.5, false),
    ] {
        let texel = pixels(&[[value, 0.0, 0.0, 0.0]]);
        assert_eq!(check(claim, &texel, 100.0).is_ok(), holds, "{claim}: {value}");
    }
    let failure = check("mean(image.x) within 1% of first", &pixels(&[[98.0; 4]]), 100.0).unwrap_err();
    assert_eq!(
        failure.to_string(),
        "frame 7: mean(image.x) within 1% of first does not hold: it is 98, and was 100 in the first frame"
    );
}

#[test]
fn claims_about_each_texel_report_the_worst_one() {
    let picture = picture(7, 5, |x, y| match (x, y) {
        (2, 1) => 1.5,
        (6, 3) => -3.0,
        (0, 4) => 2.0,
        _ => 0.5,
    });
    let failure = check("image.x in 0..1 because \"paint is white at 1\"", &picture, 0.0).unwrap_err();
    assert_eq!(
        failure.to_string(),
        "frame 7: image.x in 0..1 does not hold: it is -3 at texel 6,3, the worst of 3 values (paint is white at 1)"
    );
    let found = assertion("image.x in 0..1").find(&picture, 4, &Conditions::default(), 0.0).0;
    assert_eq!(found.worst, Some(Worst { texel: Some((6, 3)), value: -3.0, count: 3 }));
    assert_eq!((found.low, found.high), (-3.0, 2.0));
    assert!(check("image.x in -3..2", &picture, 0.0).is_ok());
    assert!(check("image in -3..1", &picture, 0.0).is_err(), "the last component is 2");
    assert!(assertion("image in -3..2").check(0, (&picture, 1), 0.0, &Conditions::default()).is_ok());
}

#[test]
fn values_that_are_not_finite_are_outside_of_every_range() {
    for bad in [f32::NAN, f32::INFINITY, f32::NEG_INFINITY] {
        let picture = picture(4, 4, |x, y| if (x, y) == (1, 2) { bad } else { 9e9 });
        let find = |text: &str| assertion(text).find(&picture, 4, &Conditions::default(), 0.0).0;
        let found = find("image.x in -1..1");
        let worst = found.worst.unwrap();
        assert_eq!((worst.texel, worst.count), (Some((1, 2)), 16));
        assert!(found.low.is_nan() && found.high.is_nan());
        for text in ["energy(image.xy) in 0..inf", "mean(image.x) in -inf..inf", "length(image.xy) in -inf..inf"] {
            assert!(find(text).worst.is_some(), "{text}: {bad}");
        }
    }
}

#[test]
fn texels_outside_of_the_region_are_ignored() {
    let picture = picture(20, 9, |x, y| if x == 0 && y == 0 || x == 19 && y == 8 { 99.0 } else { 0.0 });
    let find = |region: &str, claim: &str| {
        assertion(&format!("image.x {region} {claim}")).find(&picture, 4, &Conditions::default(), 0.0).0
    };
    for (region, count) in [
        ("", 2),
        ("from row 1", 1),
        ("except the first texel", 1),
        ("except the last texel", 1),
        ("at 0,0", 1),
        ("at 1,1 size 18x7", 0),
        ("at 19,8 size 4294967295x4294967295", 1),
        ("at 4294967295,4294967295 size 4294967295x4294967295", 0),
    ] {
        assert_eq!(find(region, "in 0..1").worst.map_or(0, |worst| worst.count), count, "{region}");
    }
    // A claim about no texels holds.
    let none = find("from row 9", "in 0.5..1");
    assert_eq!((none.worst, none.rms, none.low, none.high), (None, 0.0, 0.0, 0.0));
    for text in ["mean(image.x) from row 9 in 0.5..1", "max(image.x) from row 9 > 3", "energy(image) from row 9 == 1"] {
        let found = assertion(text).find(&picture, 4, &Conditions::default(), 0.0).0;
        assert_eq!(found.worst, None, "{text}");
    }
    assert_eq!(Region::Block { x: 2, y: u32::MAX, width: 4, height: 4 }.middle((9, 9)), (4, u32::MAX));
    assert_eq!((Region::All.middle((9, 5)), Region::FromRow(1).middle((8, 4))), ((4, 2), (4, 2)));
}

#[test]
fn claims_may_depend_on_uniforms_and_the_run() {
    let (uniforms, conditions) = project();
    for (text, low, high) in [
        ("image in 0..rate * 4", 0.0, 2.0),
        ("image in -wind..wind", -4.0, 4.0),
        ("image in width..width + height", 640.0, 1000.0),
        ("image in 0..longest_step * (dragged ? 2 : 1)", 0.0, 0.5),
        ("image in 0..2 * pi", 0.0, 2.0 * std::f64::consts::PI),
        ("let top = rate + 1; let double = 2 * top; image in top..double;", 1.5, 3.0),
        ("image within rate of 2", 1.5, 2.5),
        ("image <= rate", f64::NEG_INFINITY, 0.5),
        ("image == rate", 0.5, 0.5),
    ] {
        let assertion = assertion(text);
        assertion.check_names(&uniforms).unwrap_or_else(|e| panic!("{text}: {e}"));
        let range = assertion.range(&conditions);
        assert_eq!((range.low, range.high, range.excuse.is_none()), (low, high, true), "{text}");
    }
    assert!(assertion("image in 0..rate").varies() && !assertion("image in 0..2 * pi").varies());
    assert!(assertion("image in 0..1 unless rate > 1 because \"x\"").varies());
    // A uniform takes precedence over a name that every project has.
    let own = Conditions { uniforms: [("width".to_owned(), 3.0)].into(), ..conditions };
    assert_eq!(assertion("image in 0..width").range(&own).high, 3.0);
}

#[test]
fn unknown_names_are_rejected_with_a_suggestion() {
    let uniforms = project().0;
    for (text, says) in [
        ("image < one", "no #iUniform line declares `one`: an assertion can name rate, wind, width"),
        ("image < rat", "did you mean rate?"),
        ("image < 1 unless widht > 3 because \"x\"", "did you mean width?"),
        ("let a = b; let b = 1; image < a", "declares `b`"),
        ("let a = a; image < 1", "declares `a`"),
        ("let rate = 2; image < rate", "`let rate`: the project has a uniform of this name"),
    ] {
        let message = assertion(text).check_names(&uniforms).expect_err(text);
        assert!(message.contains(says), "{text}: {message}");
    }
}

#[test]
fn excused_values_must_be_finite_and_moderate() {
    let text = "let WILD = \"a wild lamp flickers\"; image.x in 0..1 because \"a lamp\" \
                unless rate > 1 because \"never\" unless rate == 0.5 because WILD unless 1 because \"late\"";
    let range = assertion(text).range(&project().1);
    assert_eq!(range.excuse.as_deref(), Some("a wild lamp flickers"), "the first that applies");
    assert_eq!(assertion(text).reason(), "a lamp");
    for (value, holds) in [(0.5, true), (3.0, true), (-9_999.0, true), (10_001.0, false), (f32::NAN, false)] {
        assert_eq!(check(text, &pixels(&[[value; 4]]), 0.0).is_ok(), holds, "{value}");
    }
    let wide = "image.x in 0..1e6 unless 1 because \"x\"";
    assert!(check(wide, &pixels(&[[-1e6; 4]]), 0.0).is_ok() && check(wide, &pixels(&[[2e6; 4]]), 0.0).is_err());
}

#[test]
fn malformed_assertions_are_rejected_with_the_reason() {
    for (claim, says) in [
        ("", "a quantity starts with"),
        ("let a = 1;", "a quantity starts with"),
        ("sum(image.x)", "`within TOLERANCE of VALUE`"),
        ("sum(image.x) within of 1", "expected a tolerance, found `of 1`"),
        ("sum(image.x) within -1 of 1", "at least 0"),
        ("sum(image.x) within 1 1", "expected `of`"),
        ("sum(image.x) < nan", "expected a value"),
        ("sum(image.x) < of", "expected a value, found `of`"),
        ("sum(image.x) < %", "expected a value, found `%`"),
        ("sum(image.x) <", "expected a value, but the text ends"),
        ("sum(image.x) < 1 2", "after the end"),
        ("sum(image.x) < (1", "not closed"),
        ("picture() < 1", "a quantity starts with"),
        ("image in 1", "expected `..` between the ends"),
        ("image in 2..1", "the low end 2 of the range is above the high end 1: exchange them"),
        ("image in 0..", "expected the high end"),
        ("image < first", "`first` is one number, and image has numbers for each texel: write max(image)"),
        ("image < 1 unless rate", "expected `because` and the reason"),
        ("image < 1 unless rate because", "expected a reason in quotes, but the text ends"),
        ("image < 1 because \"x", "has no end"),
        ("image < 1 because x", "no `let` before it defines the text `x`"),
        ("image < 1; image > 0", "several assertions"),
        ("let = 1; image < 1", "expected the name of a number or a text"),
        ("let a 1; image < 1", "expected `=`"),
        ("let a = ; image < 1", "expected a number or a text"),
        ("let a = 1; let a = 2; image < a", "already defined"),
        ("let pi = 3; image < 1", "`pi` has a meaning of its own"),
        ("let a = first; sum(image) < a", "write it in a claim"),
    ] {
        let message = Assertion::parse(claim).expect_err(claim);
        assert!(message.contains(says), "{claim}: {message}");
    }
}

#[test]
fn texts_have_comments_and_shared_names_and_errors_their_line() {
    let text = "// One; and a quote: \"\nlet WHY = \"a reason; with // signs,\n   on two lines\";\n\nlet top = 2; // top\n\
                image.x in 0..top // the claim\n  because WHY;\nextra image; flow.x in 0..top;";
    let mut statements = Statements::default();
    statements.name_pass("flow", PassName::buffer("C"));
    let mut others = Vec::new();
    let mut other = |reader: &mut Reader<'_>, _: &mut Statements| {
        let is_other = reader.has("extra");
        if is_other {
            others.push(reader.name("a pass")?.to_owned());
        }
        Ok(is_other)
    };
    statements.read(text, &mut other).unwrap();
    let assertions = statements.into_assertions();
    assert_eq!((assertions.len(), others), (2, vec!["image".to_owned()]));
    assert_eq!(assertions[0].reason(), "a reason; with // signs, on two lines");
    assert_eq!(assertions[1].quantity.to_string(), "buffer_c.x");
    assert_eq!(assertions[1].range(&Conditions::default()).high, 2.0);
    for (text, says) in [
        ("\nimage.x\nin 0..\nwithin", "line 4: expected the high end of a range, as in 0..1, found `within`"),
        ("let a = 1;\n\nimage in 0..sqrt(\n1, 2)", "line 3: sqrt does not take 2 arguments: it takes 1"),
        ("image < 1; // one\n// two\nimage", "line 3: expected `within"),
        ("image < 1\nimage > 0", "line 2: unexpected `image > 0` after the end"),
    ] {
        let error = Statements::default().read(text, &mut |_, _| Ok(false)).unwrap_err().to_string();
        assert!(error.starts_with(says), "{text}: {error}");
    }
}

/// Strangers' texts: every prefix, and texts with a part left out, doubled or exchanged.
#[test]
fn malformed_texts_are_rejected_in_bounded_time() {
    let words = [
        "let",
        "a",
        "=",
        "1e-4",
        "..",
        "2",
        ";",
        "sum",
        "(",
        "length",
        "image",
        ":",
        ".",
        "xy",
        ")",
        "from",
        "row",
        "except",
        "the",
        "first",
        "texel",
        "at",
        ",",
        "size",
        "x",
        "in",
        "within",
        "%",
        "of",
        "<=",
        "unless",
        "rate",
        "because",
        "\"text\"",
        "\"",
        "//",
        "\n",
        "?",
        "min",
        "-",
        "!",
        "é",
        "\0",
        "roughness",
        "99999999999999999999",
    ];
    let mut seed = 7u64;
    let mut random = |most: usize| {
        seed = seed.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (seed >> 33) as usize % most
    };
    let picture = picture(9, 9, |x, y| (x * y) as f32);
    let conditions = project().1;
    let mut parsed = 0;
    let whole =
        "let a = min(1, rate); roughness(image.x) from row 1 in -a..a + 2 because \"x\" unless rate > 1 because \"y\"";
    for round in 0..20_000 {
        let mut parts: Vec<&str> = match round % 2 {
            0 => (0..random(12)).map(|_| words[random(words.len())]).collect(),
            _ => whole.split_inclusive(' ').collect(),
        };
        if let Some(at) = parts.len().checked_sub(1).map(|last| random(last + 1)) {
            match random(3) {
                0 => drop(parts.remove(at)),
                1 => parts.insert(at, words[random(words.len())]),
                _ => parts[at] = words[random(words.len())],
            }
        }
        let text = parts.join(if round % 4 == 0 { "" } else { " " });
        if let Ok(assertion) = Assertion::parse(&text) {
            parsed += 1;
            let _ = assertion.check(0, (&picture, 4), 1.0, &conditions);
        }
        if let Ok(quantity) = Quantity::parse(&text) {
            quantity.of(&picture, 4);
        }
    }
    assert!(parsed > 500, "{parsed} of the texts are assertions");
    for end in (0..whole.len()).filter(|end| whole.is_char_boundary(*end)) {
        let _ = Assertion::parse(&whole[..end]);
    }
}

#[test]
fn long_and_deep_texts_are_rejected() {
    let long = |n: usize| format!("image < 1{}", "+1".repeat(n));
    let fits = (limits::ASSERTION - "image < 1".len()) / 2;
    assert!(check(&long(fits), &pixels(&[[0.0; 4]]), 0.0).is_ok());
    for text in [long(fits + 1), "image < ".to_owned() + &"(".repeat(1 << 20), " ".repeat(limits::ASSERTION + 1)] {
        let message = Assertion::parse(&text).unwrap_err();
        assert!(message.contains("at most 4000 letters"), "{message}");
        assert!(Quantity::parse(&text).unwrap_err().contains("at most 4000 letters"));
    }
    for open in ["(", "-", "sqrt(", "1 ? 1 : "] {
        let message = Assertion::parse(&format!("image < {}", open.repeat(400))).unwrap_err();
        assert!(message.contains("in one another"), "{message}");
    }
}

#[test]
fn the_documented_grammar_is_that_of_the_module() {
    let block = |text: &str| {
        let start = text.find("text       = {statement").unwrap();
        text[start..start + text[start..].find("```").unwrap()].trim().to_owned()
    };
    let module: String =
        include_str!("mod.rs").lines().map(|line| format!("{}\n", line.trim_start_matches("//! "))).collect();
    assert_eq!(block(&module), block(include_str!("../../../docs/command-line.md")));
}
