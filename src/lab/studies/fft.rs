//! A fast Fourier transform as passes of a project, after Stockham: each leaves its waves in order, so that no pass
//! reverses bits (Van Loan, Computational Frameworks for the Fast Fourier Transform, section 1.7).

use super::cycle;
use eddy_project::{PassSize, Project};

const STAGE: &str = include_str!("../../../assets/lab/poisson_fft/stage.glsl");

/// Puts the transform along both axes, the division by the symbol of lap p and the inverse transform between `source`
/// and `field` of `poisson_fft`. `n` texels a side, a power of two.
///
/// # Panics
/// If the project is not that of `poisson_fft`.
pub fn add(project: &mut Project, n: u32) {
    let mut texts = Vec::new();
    for sign in ["-1.0", "1.0"] {
        for along in ["x", "y"] {
            let mut span = 1;
            while span < n {
                // Radix 4, and 2 once where the size is no power of four.
                let radix = if (n / span).is_multiple_of(4) { 4 } else { 2 };
                let is_last = sign == "-1.0" && along == "y" && span * radix == n;
                let divide = if is_last { "#define DIVIDE\n" } else { "" };
                texts.push(format!(
                    "#define RADIX {radix}\n#define SPAN {span}\n#define ALONG {along}\n#define SIGN {sign}\n{divide}{STAGE}"
                ));
                span *= radix;
            }
        }
    }
    let end = texts.pop().unwrap_or_default();
    let (mut passes, mut last) = (Vec::new(), "source".to_owned());
    for (number, text) in texts.iter().enumerate() {
        let name = format!("stage{number}");
        passes.push(cycle::pass(&name, text, PassSize::Canvas, &[&last]));
        last = name;
    }
    let field = cycle::insert(project, passes, "field");
    (field.source.text, field.channels) = (end.into(), cycle::channels(&[&last]));
}
