use super::*;
use crate::lab::preset_pictures::{Bounds, PresetPicture, reference};
use image::{Rgb, RgbImage};

fn entry(change: impl Fn(&mut RgbImage)) -> PresetEntry {
    let reference = reference("fluid").unwrap();
    let mut means = reference.clone();
    change(&mut means);
    let mut entry = PresetEntry::default();
    let bounds = Bounds { mean: 0.25, max: 6 };
    entry.compare(&PresetPicture { means, not_finite: 0 }, Some(&reference), bounds);
    entry
}

#[test]
fn a_changed_picture_is_reported_as_different() {
    assert_eq!(entry(|_| ()).verdict, Verdict::AsExpected);
    let changed = entry(|picture| picture.put_pixel(4, 4, Rgb([255, 0, 255])));
    assert_eq!(changed.verdict, Verdict::Differs);
    let mut without = PresetEntry::default();
    let picture = PresetPicture { means: RgbImage::new(32, 18), not_finite: 0 };
    without.compare(&picture, None, Bounds { mean: 1.0, max: 9 });
    assert_eq!(without.verdict, Verdict::Differs, "without a reference nothing is as expected");
}

#[test]
fn the_version_of_the_system_is_short() {
    if let Some(version) = version() {
        assert!(version.len() < 60 && !version.contains('\n'), "{version}");
    }
}
