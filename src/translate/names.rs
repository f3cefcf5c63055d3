//! Readable names for the resources of a module, which the compiler leaves unnamed.

use eddy_glsl::{interface, naga};
use naga::ir::TypeInner;

/// Returns the name of a resource at a binding; `None` for a binding that passes do not use.
pub(crate) fn name(binding: naga::ResourceBinding) -> Option<String> {
    let naga::ResourceBinding { group, binding } = binding;
    if group == interface::CHANNEL_GROUP {
        let suffix = if binding % 2 == 0 { "" } else { "_sampler" };
        return Some(format!("iChannel{}{suffix}", binding / 2));
    }
    Some(
        match binding {
            0 => "uniforms",
            interface::TABLE_BINDING => "storage_table",
            interface::UNIFORM_TABLE_BINDING | interface::VERTEX_TABLE_BINDING => "uniform_table",
            interface::CUSTOM_UNIFORM_BINDING => "custom_uniforms",
            interface::GEOMETRY_BINDING => "geometry",
            _ => return None,
        }
        .to_owned(),
    )
}

/// Returns the name of the struct in a buffer.
fn type_name(variable: &str) -> &'static str {
    match variable {
        "uniforms" => "Uniforms",
        "geometry" => "Geometry",
        "storage_table" => "StorageTable",
        _ => "UniformTable",
    }
}

/// Names the resources of a module, and the structs in them.
pub(crate) fn add(module: &mut naga::Module) {
    let mut structs = Vec::new();
    for (_, variable) in module.global_variables.iter_mut() {
        let Some(name) = variable.binding.and_then(name) else { continue };
        structs.push((variable.ty, type_name(&name)));
        variable.name = Some(name);
    }
    for (ty, name) in structs {
        let mut named = module.types[ty].clone();
        if matches!(named.inner, TypeInner::Struct { .. }) && named.name.is_none() {
            named.name = Some(name.to_owned());
            module.types.replace(ty, named);
        }
    }
}
