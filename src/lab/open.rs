//! A point of a study as an independent project: for viewing, editing, and saving.

use super::{LabError, Point, Study};
use eddy_media as media;
use eddy_project::{FillKind, FillValue, PassName, Project};

/// The project of a point.
pub struct Opened {
    /// The project with the point's settings. Texels that the study sets in memory are part of the project, and are
    /// saved with it.
    pub project: Project,
    /// The size of its canvas.
    pub size: (u32, u32),
    /// The pass that is measured.
    pub pass: PassName,
}

/// Returns the project of a point of a study.
pub fn project(study: &Study, point: &Point) -> Result<Opened, LabError> {
    let setup = (study.setup)(point);
    let (mut project, media) = setup.project()?;
    for pass in &mut project.passes {
        for kind in FillKind::ALL {
            let Some(fill) = pass.fill_mut(kind) else { continue };
            let FillValue::File(name) = &fill.value else { continue };
            let Some(texels) = media.fill(name) else { continue };
            fill.value = FillValue::InMemory { name: name.clone(), npy: media::npy_bytes(texels).into() };
        }
    }
    // Rounded as if set by hand, which is how they are parsed again.
    for custom_uniform in project.custom_uniforms().list {
        if project.custom_uniform_values.contains_key(&custom_uniform.name) {
            let value = custom_uniform.value(&project.custom_uniform_values);
            project.turn_custom_uniform(&custom_uniform, value);
        }
    }
    let method = study.methods.iter().find(|m| m.name == point.method);
    let title = method.map_or(point.method.as_str(), |m| m.title);
    project.name = format!("{} {} {}", study.name, point.method, point.setting);
    project.info.description = format!(
        "{}: {title}, {} = {}, on {} x {} texels.",
        study.title, study.parameter, point.setting, point.grid, point.grid
    );
    let pass = setup.wanted().first().cloned().unwrap_or_default();
    Ok(Opened { project, size: setup.size(), pass })
}
