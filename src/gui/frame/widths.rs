//! Texts of panels that are narrow in some windows.

use super::harness::{CTRL_SHIFT, open, press};
use egui::{Key, vec2};
use egui_kittest::kittest::NodeT as _;

#[test]
fn what_the_lab_says_of_a_study_ends_within_the_window() {
    let Some(mut stage) = open(false) else { return };
    press(&mut stage, CTRL_SHIFT, Key::Y);
    for width in [620.0, 900.0, 1100.0, 1280.0, 1920.0] {
        stage.set_size(vec2(width, 800.0));
        stage.run_steps(3);
        let nodes = stage.root().children_recursive();
        let texts = nodes.map(|node| node.accesskit_node()).filter_map(|node| {
            let said = node.value().or_else(|| node.label())?;
            said.starts_with("A Gaussian of standard deviation").then(|| node.raw_bounds())
        });
        let rights: Vec<f64> = texts.flatten().map(|bounds| bounds.x1).collect();
        assert!(!rights.is_empty(), "{width} wide: the study is not told of");
        let right = rights.into_iter().fold(0.0, f64::max);
        assert!(right <= f64::from(width), "{width} wide: the text ends at {right}");
    }
}
