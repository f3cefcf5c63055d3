//! The JSON object at the start of an ISF file.

use super::{Image, Images, SlotImages};
use eddy_engine::Sources;
use eddy_project::{CustomUniform, CustomUniformType, PassSize, Project, Side, TexelFormat};
use serde_json::{Map, Value, json};

/// The limit of values for an `int` slider to become a menu.
const MAX_MENU_VALUES: i64 = 256;

/// Returns the object as text.
pub(super) fn header(project: &Project, sources: &Sources<'_>, images: &Images, reads_mouse: bool) -> String {
    let mut inputs: Vec<Value> = sources.custom_uniforms().list.iter().flat_map(|one| inputs(one, project)).collect();
    if reads_mouse {
        inputs.push(json!({ "NAME": "mouse", "TYPE": "point2D", "DEFAULT": [0.0, 0.0], "LABEL": "Mouse, in pixels" }));
    }
    let mut imported = Map::new();
    let mut given: Vec<&str> = Vec::new();
    for image in images.iter().flat_map(SlotImages::values) {
        match image {
            Image::File(name, path) => drop(imported.insert(name.clone(), json!({ "PATH": path }))),
            Image::Input(name) if !given.contains(&name.as_str()) => given.push(name),
            Image::Input(_) | Image::Target(_) => {}
        }
    }
    inputs.extend(given.into_iter().map(|name| json!({ "NAME": name, "TYPE": "image" })));
    let mut header = Map::new();
    header.insert("ISFVSN".into(), json!("2"));
    let description = if project.info.description.is_empty() { &project.name } else { &project.info.description };
    // The object is inside a comment.
    header.insert("DESCRIPTION".into(), json!(description.replace("*/", "* /")));
    header.insert("CREDIT".into(), json!(project.info.author.replace("*/", "* /")));
    header.insert("CATEGORIES".into(), json!(project.info.tags));
    header.insert("INPUTS".into(), inputs.into());
    if !imported.is_empty() {
        header.insert("IMPORTED".into(), imported.into());
    }
    let passes: Vec<Value> =
        project.passes.iter().filter(|pass| !pass.id.is_sound()).map(|p| pass(p, project)).collect();
    if passes.len() > 1 {
        header.insert("PASSES".into(), passes.into());
    }
    let text = serde_json::to_string_pretty(&header).expect("an object has texts for keys");
    text.replace("*/", "*\\/")
}

fn pass(pass: &eddy_project::Pass, project: &Project) -> Value {
    if pass.id.is_image() {
        return json!({});
    }
    let mut of = Map::new();
    of.insert("TARGET".into(), json!(pass.id.key()));
    if project.stateful_passes().contains(&pass.id) {
        of.insert("PERSISTENT".into(), json!(true));
    }
    let is_narrow = matches!(pass.settings.format, TexelFormat::R8 | TexelFormat::Rg8 | TexelFormat::Rgba8);
    if !is_narrow {
        of.insert("FLOAT".into(), json!(true));
    }
    let size = match pass.settings.size {
        PassSize::Canvas => None,
        PassSize::Scale(by) => Some(sides([Side::Scale(by); 2])),
        PassSize::Fixed(width, height) => Some([width.to_string(), height.to_string()]),
        PassSize::Sides(width, height) => Some(sides([width, height])),
    };
    if let Some([width, height]) = size {
        of.insert("WIDTH".into(), json!(width));
        of.insert("HEIGHT".into(), json!(height));
    }
    of.into()
}

/// Returns whether a slider becomes a single input; otherwise each component becomes one.
pub(super) fn is_one_input(uniform: &CustomUniform) -> bool {
    match uniform.ty {
        CustomUniformType::Vec3 | CustomUniformType::Vec4 => false,
        CustomUniformType::Bool
        | CustomUniformType::Int
        | CustomUniformType::Float
        | CustomUniformType::Vec2
        | CustomUniformType::Color3 => true,
    }
}

/// Returns the inputs of a slider.
fn inputs(uniform: &CustomUniform, project: &Project) -> Vec<Value> {
    let value = uniform.value(&project.custom_uniform_values).components();
    let range = |i: usize| uniform.range.map(|range| (range.min[i], range.max[i]));
    let input = |name: String, ty: &str, default: Value| {
        let mut of = Map::new();
        of.insert("NAME".into(), json!(name));
        of.insert("TYPE".into(), json!(ty));
        of.insert("DEFAULT".into(), default);
        if !uniform.about.is_empty() {
            of.insert("LABEL".into(), json!(uniform.about.replace("*/", "* /")));
        }
        of
    };
    let float = |name: String, i: usize| {
        let mut of = input(name, "float", json!(value[i]));
        if let Some((min, max)) = range(i) {
            of.insert("MIN".into(), json!(min));
            of.insert("MAX".into(), json!(max));
        }
        Value::from(of)
    };
    if !is_one_input(uniform) {
        let parts = "xyzw".chars().take(uniform.ty.components()).enumerate();
        return parts.map(|(i, part)| float(format!("{}_{part}", uniform.name), i)).collect();
    }
    let name = uniform.name.clone();
    vec![match uniform.ty {
        CustomUniformType::Bool => input(name, "bool", json!(value[0] > 0.5)).into(),
        CustomUniformType::Int => {
            let mut of = input(name, "long", json!(value[0] as i64));
            if let Some((min, max)) = range(0).map(|(min, max)| (min as i64, max as i64)) {
                of.insert("MIN".into(), json!(min));
                of.insert("MAX".into(), json!(max));
                if (1..MAX_MENU_VALUES).contains(&max.saturating_sub(min)) {
                    of.insert("VALUES".into(), (min..=max).collect());
                    of.insert("LABELS".into(), (min..=max).map(|n| n.to_string()).collect());
                }
            }
            of.into()
        }
        CustomUniformType::Vec2 => {
            let mut of = input(name, "point2D", json!(value));
            if let (Some(x), Some(y)) = (range(0), range(1)) {
                of.insert("MIN".into(), json!([x.0, y.0]));
                of.insert("MAX".into(), json!([x.1, y.1]));
            }
            of.into()
        }
        // A colour in ISF has an alpha; `shader` uses the other three components.
        CustomUniformType::Color3 => {
            input(format!("{name}_rgba"), "color", json!([value[0], value[1], value[2], 1.0])).into()
        }
        _ => float(name, 0),
    }]
}

/// Returns the expressions of ISF for two sides.
fn sides(sides: [Side; 2]) -> [String; 2] {
    let [width, height] = sides;
    [("$WIDTH", width), ("$HEIGHT", height)].map(|(canvas, side)| match side {
        Side::Scale(by) => format!("max(floor({canvas}*{by:?}+0.5),1.0)"),
        Side::Floor(by) => format!("max(floor({canvas}*{by:?}),1.0)"),
        Side::Fixed(texels) => texels.to_string(),
    })
}
