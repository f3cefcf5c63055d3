//! The values that programs set, in terms of Shadertoy's uniforms.

use crate::{CustomUniformType as Type, HostUniform, HostValue, MouseUnit};

/// Returns Shadertoy's uniform with the same type and meaning, if there is one.
pub(super) fn same_as(uniform: &HostUniform) -> Option<&'static str> {
    Some(match (uniform.value, uniform.ty) {
        (HostValue::Time, Type::Float) => "iTime",
        (HostValue::TimeDelta, Type::Float) => "iTimeDelta",
        (HostValue::Frame(0), Type::Int) => "iFrame",
        (HostValue::Resolution, Type::Vec3) => "iResolution",
        (HostValue::Date(0), Type::Vec4) => "iDate",
        (HostValue::Mouse(MouseUnit::Pixels, [0.0, 0.0]), Type::Vec4) => "iMouse",
        _ => return None,
    })
}

/// Returns the value of a uniform as an expression.
pub(super) fn expression(uniform: &HostUniform) -> String {
    if let Some(name) = same_as(uniform) {
        return name.to_owned();
    }
    let whole = |value: String| match uniform.ty {
        Type::Float => format!("float({value})"),
        _ => value,
    };
    match uniform.value {
        HostValue::Time => "iTime".to_owned(),
        HostValue::TimeDelta => "iTimeDelta".to_owned(),
        HostValue::TimeDeltaFromZero => "iFrame == 0 ? 0.0 : iTimeDelta".to_owned(),
        HostValue::Frame(0) => whole("iFrame".to_owned()),
        HostValue::Frame(first) => whole(format!("iFrame + {first}")),
        HostValue::Date(0) => "iDate".to_owned(),
        HostValue::Date(january) => format!("iDate + vec4(0.0, {january}.0, 0.0, 0.0)"),
        HostValue::TimeOfDay => {
            "vec3(floor(iDate.w / 3600.0), mod(floor(iDate.w / 60.0), 60.0), mod(iDate.w, 60.0))".to_owned()
        }
        HostValue::Mouse(unit, start) => pointer(unit, start),
        HostValue::Resolution if uniform.ty == Type::Vec3 => "vec3(iResolution.xy, 1.0)".to_owned(),
        HostValue::Resolution => "iResolution.xy".to_owned(),
        HostValue::UnitPosition => "gl_FragCoord.xy / iResolution.xy".to_owned(),
        HostValue::CentredPosition => "(gl_FragCoord.xy - 0.5 * iResolution.xy) / iResolution.y".to_owned(),
        HostValue::ClipPosition => "vec4(2.0 * gl_FragCoord.xy / iResolution.xy - 1.0, 0.0, 1.0)".to_owned(),
        HostValue::SurfaceSize => "vec2(iResolution.x / iResolution.y, 1.0)".to_owned(),
        HostValue::Constant(value) => constant(uniform.ty, value),
        HostValue::Terminal(_) => zero(uniform.ty.glsl_name()),
    }
}

fn pointer(unit: MouseUnit, start: [f32; 2]) -> String {
    let moved = match unit {
        MouseUnit::Pixels => "iMouse.xy",
        MouseUnit::Unit => "iMouse.xy / iResolution.xy",
    };
    match (unit, start) {
        (_, [0.0, 0.0]) => moved.to_owned(),
        (MouseUnit::Unit, [x, y]) => format!("iMouse.xy == vec2(0.0) ? vec2({x:?}, {y:?}) : {moved}"),
        (MouseUnit::Pixels, [x, y]) => {
            format!("iMouse.xy == vec2(0.0) ? vec2({x:?}, {y:?}) * iResolution.xy : {moved}")
        }
    }
}

fn constant(ty: Type, value: [f32; 4]) -> String {
    match ty {
        Type::Bool => (value[0] != 0.0).to_string(),
        Type::Int => format!("{}", value[0]),
        Type::Float => format!("{:?}", value[0]),
        _ => {
            let all: Vec<String> = value[..ty.components()].iter().map(|x| format!("{x:?}")).collect();
            format!("{}({})", ty.glsl_name(), all.join(", "))
        }
    }
}

/// Returns the value of a type that nothing sets.
pub(super) fn zero(ty: &str) -> String {
    match ty {
        "bool" => "false".to_owned(),
        "int" => "0".to_owned(),
        "uint" => "0u".to_owned(),
        "float" => "0.0".to_owned(),
        _ if ty.starts_with('b') => format!("{ty}(false)"),
        _ if ty.starts_with('i') => format!("{ty}(0)"),
        _ if ty.starts_with('u') => format!("{ty}(0u)"),
        _ => format!("{ty}(0.0)"),
    }
}

/// Returns whether a type is one of the language that a variable can have: no sampler.
pub(super) fn is_basic(ty: &str) -> bool {
    let rest = ty.strip_prefix(['b', 'i', 'u']).unwrap_or(ty);
    matches!(ty, "bool" | "int" | "uint" | "float" | "mat2" | "mat3" | "mat4")
        || matches!(rest, "vec2" | "vec3" | "vec4")
        || ty.strip_prefix("mat").is_some_and(|size| size.len() == 3 && size.contains('x'))
}
