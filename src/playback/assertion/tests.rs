use super::*;
use eddy_engine::Pixels;
use eddy_project::PassName;

fn pixels(texels: &[[f32; 4]]) -> Pixels {
    Pixels { width: texels.len() as u32, height: 1, texels: texels.to_vec() }
}

fn value(quantity: &str, texels: &[[f32; 4]]) -> f64 {
    Quantity::parse(quantity).unwrap().of(&pixels(texels), 4)
}

#[test]
fn a_quantity_names_a_reduction_a_pass_and_a_component() {
    let quantity = Quantity::parse(" rms( Buffer A .y ) ").unwrap();
    let pass = PassName::buffer("A");
    assert_eq!(quantity, Quantity { reduction: Reduction::Rms, pass, target: 0, component: Some(1) });
    for text in ["sum(buffer_a.x)", "nonfinite(image)", "max(buffer_scene:1.w)"] {
        assert_eq!(Quantity::parse(text).unwrap().to_string(), text);
    }
    for (text, says) in [
        ("", "sum, min, max, mean, rms and nonfinite"),
        ("total(image)", "not `total`"),
        ("sum image", "expected `(`"),
        ("sum()", "is not the name of a pass"),
        ("sum(image.xy)", "not `xy`"),
        ("sum(image:one)", "a number from 0"),
        ("sum(image", "but the text ends"),
        ("sum(image) + 1", "unexpected `+ 1`"),
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
    // Single precision would lose every one of these.
    let many = vec![[1.0, 0.0, 0.0, 0.0]; (1 << 24) + 9];
    assert_eq!(value("sum(image.x)", &many), f64::from((1 << 24) + 9));
}

#[test]
fn nonfinite_values_are_counted_and_propagate() {
    let texels = [[f32::NAN, 1.0, 0.0, 0.0], [1.0, f32::INFINITY, 0.0, 0.0], [2.0, 0.0, 0.0, 0.0]];
    assert_eq!(value("nonfinite(image)", &texels), 2.0);
    for reduction in ["sum", "min", "max", "mean", "rms"] {
        assert!(value(&format!("{reduction}(image.x)"), &texels).is_nan(), "{reduction}");
    }
    assert_eq!(value("max(image.y)", &texels), f64::INFINITY);
}

#[test]
fn assertions_are_checked_against_values() {
    for (claim, value, holds) in [
        ("sum(image.x) within 1e-4 of 1", 1.00005, true),
        ("sum(image.x) within 1e-4 of 1", 1.0002, false),
        ("sum(image.x) within 1e-4 of 1", f64::NAN, false),
        ("mean(image.x) within 1% of first", 101.0, true),
        ("mean(image.x) within 1% of first", 98.0, false),
        ("max(image) <= 1", 1.0, true),
        ("max(image) < 1", 1.0, false),
        ("min(image)>=-.5", -0.5, true),
        ("min(image) > -.5", -0.5, false),
        ("nonfinite(image) == 0", 0.0, true),
        ("nonfinite(image) = 0", 3.0, false),
        ("max(image) < inf", f64::NAN, false),
    ] {
        assert_eq!(Assertion::parse(claim).unwrap().check(7, value, 100.0).is_ok(), holds, "{claim}: {value}");
    }
    let failure = Assertion::parse("mean(image.x) within 1% of first").unwrap().check(7, 98.0, 100.0).unwrap_err();
    assert_eq!(
        failure.to_string(),
        "frame 7: mean(image.x) within 1% of first does not hold: it is 98, and was 100 in the first frame"
    );
}

#[test]
fn malformed_assertions_are_rejected_with_the_reason() {
    for (claim, says) in [
        ("sum(image.x)", "`within TOLERANCE of VALUE`"),
        ("sum(image.x) within of 1", "expected a tolerance, found `of 1`"),
        ("sum(image.x) within -1 of 1", "at least 0"),
        ("sum(image.x) within 1 1", "expected `of`"),
        ("sum(image.x) < one", "expected a value, found `one`"),
        ("sum(image.x) < nan", "expected a value"),
        ("sum(image.x) < 1 2", "after the end"),
        ("image < 1", "a quantity starts with"),
    ] {
        let message = Assertion::parse(claim).expect_err(claim);
        assert!(message.contains(says), "{claim}: {message}");
    }
}
