//! A fast Fourier transform as passes of a project, after Stockham: each leaves its waves in order, so that no pass
//! reverses bits (Van Loan, Computational Frameworks for the Fast Fourier Transform, section 1.7).

use super::cycle;
use eddy_project::{Pass, PassSize, Project, TexelFormat};

const STAGE: &str = include_str!("../../../assets/lab/poisson_fft/stage.glsl");

/// Inserts the transform along both axes, the division by the symbol of lap p and the inverse transform between
/// `source` and `field` of `poisson_fft`. `n` texels per side, a power of two.
///
/// # Panics
/// If the project is not that of `poisson_fft`.
pub(super) fn add(project: &mut Project, n: u32) {
    let mut there = stages((n, n), Direction::There);
    if let Some(last) = there.last_mut() {
        last.insert_str(0, "#define DIVIDE\n");
    }
    let all = there.into_iter().chain(stages((n, n), Direction::Back));
    let mut texts: Vec<String> = all.map(|stage| stage + STAGE).collect();
    let end = texts.pop().unwrap_or_default();
    let (passes, last) = chain("stage", &texts, "source", TexelFormat::Rg32f);
    let field = cycle::insert(project, passes, "field");
    (field.source.text, field.bindings) = (end.into(), cycle::channels(&[&last]));
}

/// The direction of a transform: from a picture to its waves, or back.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Direction {
    There,
    Back,
}

/// Returns for each pass of a transform along both axes the macros that precede the text of `stage.glsl`. Each side is
/// a power of two.
pub(super) fn stages(size: (u32, u32), direction: Direction) -> Vec<String> {
    let sign = if direction == Direction::There { "-1.0" } else { "1.0" };
    let mut stages = Vec::new();
    for (along, n) in [("x", size.0), ("y", size.1)] {
        let mut span = 1;
        while span < n {
            // Radix 4, and 2 once if the size is not a power of four.
            let radix = if (n / span).is_multiple_of(4) { 4 } else { 2 };
            stages.push(format!(
                "#define RADIX {radix}\n#define SPAN {span}\n#define ALONG {along}\n#define SIGN {sign}\n"
            ));
            span *= radix;
        }
    }
    stages
}

/// Returns buffers with these texts, each of which reads the previous one, and the first `from`; and the name of the
/// last.
pub(super) fn chain(name: &str, texts: &[String], from: &str, format: TexelFormat) -> (Vec<Pass>, String) {
    let (mut passes, mut last) = (Vec::new(), from.to_owned());
    for (number, text) in texts.iter().enumerate() {
        let name = format!("{name}{number}");
        let mut pass = cycle::pass(&name, text, PassSize::Canvas, &[&last]);
        pass.settings.format = format;
        passes.push(pass);
        last = name;
    }
    (passes, last)
}
