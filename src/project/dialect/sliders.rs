//! Uniforms that a complete fragment shader declares and its program does not set: the user sets them with sliders.

use super::samplers::declared_uniforms;
use crate::{CustomUniform, CustomUniformRange, CustomUniformType, CustomUniformValue, Project};
use eddy_diag::{SourceId, Span};
use std::collections::{HashMap, HashSet};

/// Returns the uniforms of a project's texts that the user sets: 0 at first, and from 0 to 1 for numbers.
pub(crate) fn declared_sliders(project: &Project) -> Vec<CustomUniform> {
    let row = project.dialect.row();
    if !project.dialect.has_main() || !row.has_declarations {
        return Vec::new();
    }
    let (prefix, suffix) = row.texture_size;
    let textures = project.passes.iter().flat_map(|pass| pass.bindings.names());
    let sizes = textures.map(|(_, texture)| format!("{prefix}{texture}{suffix}"));
    let of_host: HashSet<String> = row.uniforms.iter().map(|uniform| uniform.name.to_owned()).chain(sizes).collect();
    let mut found: Vec<CustomUniform> = Vec::new();
    let mut places: HashMap<String, usize> = HashMap::new();
    for (id, source) in project.texts().iter() {
        for declared in declared_uniforms(&source.text) {
            let is_free = !declared.is_array && !of_host.contains(&declared.name);
            let Some(ty) = slider_type(&declared.ty).filter(|_| is_free) else { continue };
            match places.get(&declared.name).map(|at| &mut found[*at]) {
                Some(known) if known.declared_in.last() != Some(&id) => known.declared_in.push(id),
                Some(_) => {}
                None => {
                    places.insert(declared.name.clone(), found.len());
                    found.push(slider((declared.name, declared.at), ty, declared.comment, id));
                }
            }
        }
    }
    found
}

fn slider((name, at): (String, usize), ty: CustomUniformType, about: String, id: SourceId) -> CustomUniform {
    let is_limited = !matches!(ty, CustomUniformType::Bool | CustomUniformType::Int);
    CustomUniform {
        span: Span::new(id, at..at + name.len()),
        name,
        ty,
        default: CustomUniformValue::new(ty, &[0.0; 4]),
        range: is_limited.then_some(CustomUniformRange { min: [0.0; 4], max: [1.0; 4] }),
        step: None,
        about,
        group: String::new(),
        declared_in: vec![id],
        is_declared: true,
    }
}

fn slider_type(ty: &str) -> Option<CustomUniformType> {
    CustomUniformType::ALL.into_iter().find(|known| known.name() == ty && *known != CustomUniformType::Color3)
}
