//! The studies. A new study is a file here with its [`Study`], and its projects in `assets/lab`.

mod advection;
pub mod ao;
pub mod ao_closed;
mod ao_setup;
pub mod bloom;
mod blur;
pub mod brick_breaker;
pub mod cavity;
mod conjugate_gradients;
pub mod cycle;
mod denoise;
mod diffusion;
pub mod edges;
mod fft;
pub mod flow;
pub mod fluid;
pub mod gray_scott;
mod lobe;
pub mod outline;
pub mod particles;
pub mod poisson;
mod precision;
mod saw;
pub mod shutter;
mod silhouettes;
pub mod ssr;
pub mod supersampling;
pub mod taa;
pub mod torus;
pub mod waves;

use super::{LabError, Study};
use eddy_project::{listed, nearest};

/// Returns every study, in the order of the report.
pub fn all() -> Vec<&'static Study> {
    vec![
        &diffusion::STUDY,
        &advection::STUDY,
        &gray_scott::STUDY,
        &poisson::STUDY,
        &fluid::STUDY,
        &torus::TAYLOR_GREEN,
        &torus::SHEAR_LAYER,
        &torus::LAMB_OSEEN,
        &cavity::STUDY,
        &blur::STUDY,
        &bloom::STUDY,
        &supersampling::STUDY,
        &shutter::STUDY,
        &taa::STUDY,
        &ao::STUDY,
        &ssr::STUDY,
        &particles::STUDY,
        &brick_breaker::STUDY,
        &edges::STUDY,
        &outline::STUDY,
        &lobe::STUDY,
        &denoise::STUDY,
        &saw::STUDY,
        &precision::STUDY,
    ]
}

/// Returns the studies with these names; all if there are no names.
pub fn named(names: &[String]) -> Result<Vec<&'static Study>, LabError> {
    if names.is_empty() {
        return Ok(all());
    }
    let known: Vec<&str> = all().iter().map(|s| s.name).collect();
    let find = |name: &String| {
        all().into_iter().find(|s| s.name == name).ok_or_else(|| LabError::NoStudy {
            name: name.clone(),
            near: nearest(name, known.iter().copied()).map(str::to_owned),
            known: listed(&known),
        })
    };
    names.iter().map(find).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Extent;

    #[test]
    fn every_study_is_well_formed() {
        for study in all() {
            assert!(study.name.chars().all(|c| c.is_ascii_lowercase() || c == '-'), "{}", study.name);
            for extent in [Extent::Quick, Extent::Full] {
                let grids = study.grids(extent);
                assert!(grids.len() >= 3 && grids.windows(2).all(|g| g[1] == 2 * g[0]), "{}: {grids:?}", study.name);
                assert!(grids.contains(&study.main_grid(extent)));
                let mut points = study.points(extent);
                let count = points.len();
                points.dedup();
                assert_eq!(points.len(), count, "{}", study.name);
                for point in points {
                    let method = study.methods.iter().find(|m| m.name == point.method).unwrap();
                    assert!(method.settings.contains(&method.usual), "{} {}", study.name, method.name);
                    (study.setup)(&point).project().unwrap_or_else(|e| panic!("{point:?}: {e}"));
                }
            }
        }
    }

    #[test]
    fn misspelt_study_suggests_name() {
        let said = named(&["difusion".into()]).err().unwrap().to_string();
        assert!(said.contains("did you mean diffusion?") && said.contains("poisson"), "{said}");
        assert_eq!(named(&[]).unwrap().len(), all().len());
    }
}
