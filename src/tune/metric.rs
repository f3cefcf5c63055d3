//! The error of a setting: how far its pictures are from those of the converged program.

use eddy_engine::Pixels;
use eddy_metrics::{Norms, difference::screen, flip, picture};
use eddy_playback::assertion::{Assertion, Conditions};
use eddy_project::PassName;

/// The measure of errors. Each error is 0 for equal pictures, and larger for worse ones.
#[derive(Clone, Debug)]
pub enum Metric {
    /// The mean of the FLIP map.
    Flip,
    /// 1 minus the structural similarity of luma.
    Ssim,
    /// The root mean square of the components as displayed: a PSNR of x dB is 10^(-x/20).
    Psnr,
    /// The norm of the difference of a pass's texels, relative to that of the reference.
    L2(PassName),
    /// The distance by which a claim of the assertion language is violated; 0 where it holds. `first` in it is the value
    /// of the quantity in the reference.
    Claim(Box<Assertion>),
}

/// An error that is allowed.
#[derive(Clone, Debug)]
pub struct Bound {
    pub metric: Metric,
    /// In the unit of the metric's errors.
    pub limit: f64,
    /// As the user wrote it.
    pub text: String,
}

impl Bound {
    /// The bound that is used unless another is given.
    pub const DEFAULT: &'static str = "flip < .02";

    /// Parses `flip < .02`, `ssim > .98`, `psnr > 40`, `l2 buffer_a < 1e-3` or a claim such as
    /// `mean(image.r) within 1% of first`.
    pub fn parse(text: &str) -> Result<Bound, String> {
        let bound = |metric, limit| Ok(Bound { metric, limit, text: text.to_owned() });
        let words: Vec<&str> = text.split_whitespace().collect();
        let (first, rest) = (words.first().copied().unwrap_or(""), words.get(1..).unwrap_or_default().join(" "));
        let name = &first[..first.find(|c: char| !c.is_alphanumeric()).unwrap_or(first.len())];
        let number = |sign: char, rest: &str| -> Result<f64, String> {
            let shape = || format!("{text}: write {name} {sign} and a number, as in \"flip < .02\" or \"psnr > 40\"");
            let rest = rest.trim().strip_prefix(sign).ok_or_else(shape)?;
            let rest = rest.strip_prefix('=').unwrap_or(rest);
            rest.trim().parse::<f64>().ok().filter(|n| n.is_finite() && *n > 0.0).ok_or_else(shape)
        };
        let after = || text.trim_start().get(name.len()..).unwrap_or("");
        match name {
            "flip" => bound(Metric::Flip, number('<', after())?),
            "ssim" => {
                let least = number('>', after())?;
                if least >= 1.0 {
                    return Err(format!("{text}: structural similarity is below 1 for any two pictures that differ"));
                }
                bound(Metric::Ssim, 1.0 - least)
            }
            "psnr" => bound(Metric::Psnr, 10f64.powf(-number('>', after())? / 20.0)),
            "l2" => {
                let (pass, rest) = rest
                    .split_once('<')
                    .ok_or_else(|| format!("{text}: write l2 PASS < NUMBER, as in l2 buffer_a < 1e-3"))?;
                let pass = PassName::parse(pass.trim()).ok_or_else(|| {
                    format!(
                        "{text}: \"{}\" is not a pass with a picture; write buffer_a, image or the like",
                        pass.trim()
                    )
                })?;
                bound(Metric::L2(pass), number('<', &format!("<{rest}"))?)
            }
            _ => {
                let claim = Assertion::parse(text).map_err(|why| {
                    format!("{text}: an error is flip, ssim, psnr, l2 PASS or a claim about a picture, and as a claim: {why}")
                })?;
                bound(Metric::Claim(Box::new(claim)), CLAIM_HOLDS)
            }
        }
    }
}

/// Errors of claims up to this are roundings.
const CLAIM_HOLDS: f64 = 1e-12;

impl Metric {
    /// Returns the pass whose picture is compared, and the index of its target.
    pub fn reads(&self) -> (PassName, usize) {
        match self {
            Metric::L2(pass) => (pass.clone(), 0),
            Metric::Claim(claim) => (claim.quantity.pass.clone(), claim.quantity.target),
            _ => (PassName::image(), 0),
        }
    }

    pub fn name(&self) -> String {
        match self {
            Metric::Flip => "FLIP".into(),
            Metric::Ssim => "1 - SSIM".into(),
            Metric::Psnr => "RMSE".into(),
            Metric::L2(pass) => format!("relative L2 of {}", pass.title()),
            Metric::Claim(claim) => format!("excess of {claim}"),
        }
    }

    /// Prepares a picture for comparisons.
    pub fn prepared(&self, pixels: &Pixels) -> Prepared {
        match self {
            Metric::Flip => Prepared::Flip(Box::new(flip::Prepared::new(&screen(pixels)))),
            Metric::Ssim | Metric::Psnr => Prepared::Screen(screen(pixels)),
            Metric::L2(_) => Prepared::Values(pixels.texels.iter().flatten().map(|v| f64::from(*v)).collect()),
            Metric::Claim(_) => Prepared::Texels(Box::new(pixels.clone())),
        }
    }

    /// Returns the error of a picture; infinite for one of another size.
    pub fn error(&self, picture: &Prepared, reference: &Prepared, stored: usize, conditions: &Conditions) -> f64 {
        match (self, picture, reference) {
            (_, Prepared::Flip(a), Prepared::Flip(b)) if a.is_of_size(b) => a.mean(b),
            (Metric::Ssim, Prepared::Screen(a), Prepared::Screen(b)) if is_of_size(a, b) => {
                // The window of structural similarity does not fit into less.
                if a.width.min(a.height()) < 11 { f64::INFINITY } else { (1.0 - picture::ssim(a, b)).max(0.0) }
            }
            (_, Prepared::Screen(a), Prepared::Screen(b)) if is_of_size(a, b) => {
                10f64.powf(-picture::psnr(a, b) / 20.0)
            }
            (_, Prepared::Values(a), Prepared::Values(b)) if a.len() == b.len() => {
                if a == b {
                    0.0
                } else {
                    Norms::of(a, b).l2
                }
            }
            (Metric::Claim(claim), Prepared::Texels(a), Prepared::Texels(b)) => {
                let first = claim.quantity.of(b, stored);
                let (found, range) = claim.find(a, stored, conditions, first);
                let worst = found.worst.filter(|worst| !range.excuses(worst.value));
                worst.map_or(0.0, |worst| match worst.value.is_finite() {
                    true => (range.low - worst.value).max(worst.value - range.high).max(2.0 * CLAIM_HOLDS),
                    false => f64::INFINITY,
                })
            }
            _ => f64::INFINITY,
        }
    }
}

fn is_of_size(a: &picture::Picture, b: &picture::Picture) -> bool {
    (a.width, a.rgb.len()) == (b.width, b.rgb.len())
}

/// A picture that is prepared for comparisons by one metric.
pub enum Prepared {
    Flip(Box<flip::Prepared>),
    Screen(picture::Picture),
    Values(Vec<f64>),
    Texels(Box<Pixels>),
}

/// Returns the mean of pictures of one size.
pub(crate) fn mean_picture(pictures: &[Pixels]) -> Option<Pixels> {
    let mut sum: Vec<[f64; 4]> = vec![[0.0; 4]; pictures.first()?.texels.len()];
    for picture in pictures {
        for (sum, texel) in sum.iter_mut().zip(&picture.texels) {
            (0..4).for_each(|i| sum[i] += f64::from(texel[i]));
        }
    }
    let count = pictures.len() as f64;
    let texels = sum.into_iter().map(|sum| sum.map(|v| (v / count) as f32)).collect();
    Some(Pixels { texels, ..pictures[0] })
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A ramp, with stripes of this brightness.
    fn ramp(stripes: f32) -> Pixels {
        let texels = (0..24 * 16)
            .map(|i| [(i % 24) as f32 / 48.0 + stripes * (i % 2) as f32, (i / 24) as f32 / 16.0, 0.5, 1.0])
            .collect();
        Pixels { width: 24, height: 16, texels }
    }

    fn error(bound: &str, picture: &Pixels, reference: &Pixels) -> f64 {
        let metric = Bound::parse(bound).unwrap().metric;
        metric.error(&metric.prepared(picture), &metric.prepared(reference), 4, &Conditions::default())
    }

    #[test]
    fn every_metric_rejects_a_bad_pair_and_accepts_equal_pictures() {
        let (good, bad) = (ramp(0.0), ramp(0.2));
        for text in ["flip < .02", "ssim > .99", "psnr > 40", "l2 image < 1e-2", "mean(image.r) within 1% of first"] {
            let limit = Bound::parse(text).unwrap().limit;
            assert!(error(text, &bad, &good) > limit, "{text}: {}", error(text, &bad, &good));
            assert!(error(text, &good, &good) <= limit, "{text}");
            let small = Pixels { width: 8, height: 1, texels: vec![[0.0; 4]; 8] };
            assert!(text.contains("mean") || error(text, &small, &good) == f64::INFINITY, "{text}");
        }
        assert!((error("psnr > 40", &bad, &good) - 0.2 / 6f64.sqrt()).abs() < 0.01);
        let mean = mean_picture(&[ramp(0.0), ramp(0.5)]).unwrap();
        assert!((mean.texels[1][0] - 1.0 / 48.0 - 0.25).abs() < 1e-6);
    }

    #[test]
    fn bounds_are_parsed_or_say_how_to_write_them() {
        for (text, limit) in [("flip<.02", 0.02), ("flip < 0.1", 0.1), ("psnr > 40", 0.01), ("l2 buffer_a<=1e-3", 1e-3)]
        {
            assert!((Bound::parse(text).unwrap().limit - limit).abs() < 1e-9, "{text}");
        }
        assert!(
            matches!(Bound::parse("l2 buffer_a < 1").unwrap().metric, Metric::L2(pass) if pass == PassName::buffer("a"))
        );
        for (text, says) in [
            ("flip > 2", "flip <"),
            ("ssim > 1", "below 1"),
            ("psnr", "psnr >"),
            ("l2 < 1", "not a pass"),
            ("fine", "claim"),
        ] {
            let message = Bound::parse(text).expect_err(text);
            assert!(message.contains(says), "{text}: {message}");
        }
    }
}
