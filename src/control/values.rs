//! The value of a uniform after a control has moved.

use crate::ControlEvent;
use eddy_project::{ControlAddress, ControlTarget, CustomUniform, CustomUniformType, CustomUniformValue};

/// OSC addresses below this one name a uniform and have values in the units of its slider.
pub const OWN_UNITS: &str = "/eddy/";

/// The maximum of an `int` without a range, as for a 7-bit control.
const INT_WITHOUT_RANGE: f64 = 127.0;

/// A uniform that an OSC address names, and the index of its component.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Moved<'a> {
    /// The name in the shader.
    pub uniform: &'a str,
    /// 0 for the first component, or for a number alone.
    pub index: usize,
}

/// Returns the uniform that an address below [`OWN_UNITS`] names: `/eddy/speed`, `/eddy/center/x`, and by its argument
/// a component of `/eddy/center`. `None` for other addresses.
pub fn direct(source: &ControlAddress) -> Option<Moved<'_>> {
    let ControlAddress::Osc { path, argument } = source else { return None };
    let rest = path.strip_prefix(OWN_UNITS)?;
    match rest.split_once('/') {
        None => Some(Moved { uniform: rest, index: *argument }),
        Some((uniform, component)) if *argument == 0 => {
            let target = ControlTarget::of_component(uniform, component)?;
            Some(Moved { uniform, index: target.index() })
        }
        Some(_) => None,
    }
}

/// Returns the value of a uniform after a control has moved that drives its component `index`. `is_own_units`: the
/// event's value is in the units of the slider, otherwise 0 to 1 is mapped to its range. `None` if the uniform has no
/// such component, or if the event does not change it.
pub fn moved(
    uniform: &CustomUniform,
    now: &CustomUniformValue,
    index: usize,
    event: &ControlEvent,
    is_own_units: bool,
) -> Option<CustomUniformValue> {
    let mut all = now.components();
    let is_note = matches!(event.source, ControlAddress::Note { .. });
    let number = all.get_mut(index)?;
    *number = match uniform.ty {
        // A key toggles it when pressed; any other control switches it on from half of its range.
        CustomUniformType::Bool if is_note && event.value > 0.0 => 1.0 - *number,
        CustomUniformType::Bool if is_note => return None,
        CustomUniformType::Bool => f64::from(u8::from(event.value >= 0.5)),
        _ => {
            let value = if is_own_units { event.value } else { in_range(uniform, index, event.value.clamp(0.0, 1.0)) };
            let range = uniform.range.map(|range| (range.min[index], range.max[index]));
            let value = range.map_or(value, |(min, max)| value.clamp(min, max));
            if uniform.ty == CustomUniformType::Int { value.clamp(-2_147_483_648.0, 2_147_483_647.0) } else { value }
        }
    };
    // A number that is not finite in single precision is not a value of a uniform.
    if !(all[index] as f32).is_finite() {
        return None;
    }
    let value = CustomUniformValue::new(uniform.ty, &all);
    (value != *now).then_some(value)
}

/// Returns the position of a uniform's component in its range, from 0 to 1 if it is within. `None` if the uniform is a
/// switch, which has no values in between, or has no such component.
pub fn place_of(uniform: &CustomUniform, index: usize, value: f64) -> Option<f64> {
    let (min, max) = match uniform.ty {
        CustomUniformType::Bool => return None,
        ty => range_of(uniform, ty, index),
    };
    (max > min).then(|| (value - min) / (max - min))
}

fn range_of(uniform: &CustomUniform, ty: CustomUniformType, index: usize) -> (f64, f64) {
    let usual = if ty == CustomUniformType::Int { INT_WITHOUT_RANGE } else { 1.0 };
    uniform.range.map_or((0.0, usual), |range| (range.min[index], range.max[index]))
}

/// Returns the value at a part of the range, rounded to the author's steps if there are any.
fn in_range(uniform: &CustomUniform, index: usize, part: f64) -> f64 {
    let (min, max) = range_of(uniform, uniform.ty, index);
    // Exact at both ends.
    let value = min * (1.0 - part) + max * part;
    match uniform.step.map(|step| step[index]).filter(|step| *step > 0.0) {
        Some(step) if part < 1.0 => (min + ((value - min) / step).round() * step).min(max),
        _ => value,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use eddy_project::Project;

    fn uniforms() -> Vec<CustomUniform> {
        let text = "#iUniform float speed = 1.0 in { -2.0, 2.0 }\n#iUniform int count = 3 in { 1, 9 }\n#iUniform bool on\n\
                    #iUniform vec2 at in { 0.0, 10.0 }\n#iUniform float free\n#iUniform int whole\n\
                    #iUniform float steps in { 0.0, 1.0 } step 0.25\nvoid mainImage(out vec4 o, in vec2 p) { o = vec4(1); }\n";
        let read = Project::of_image("p".into(), text.into()).custom_uniforms();
        assert_eq!(read.diagnostics, []);
        read.list
    }

    fn osc(path: &str, argument: usize, value: f64) -> ControlEvent {
        ControlEvent { source: ControlAddress::Osc { path: path.into(), argument }, value }
    }

    fn set(name: &str, index: usize, event: &ControlEvent, is_own_units: bool) -> Option<Vec<f64>> {
        let uniform = uniforms().into_iter().find(|uniform| uniform.name == name).unwrap();
        moved(&uniform, &uniform.default, index, event, is_own_units).map(|value| value.components())
    }

    #[test]
    fn control_positions_map_to_the_range() {
        let at = |name: &str, value: f64| set(name, 0, &osc("/a", 0, value), false);
        assert_eq!(at("speed", 0.0), Some(vec![-2.0]));
        assert_eq!(at("speed", 0.5), Some(vec![0.0]));
        assert_eq!(at("speed", 7.0), Some(vec![2.0]), "no further than the range");
        assert_eq!(at("speed", 0.75), None, "it is there already");
        assert_eq!(at("count", 0.55), Some(vec![5.0]));
        assert_eq!((at("free", 0.25), at("whole", 1.0)), (Some(vec![0.25]), Some(vec![127.0])));
        assert_eq!(at("steps", 0.3), Some(vec![0.25]));
        assert_eq!(set("at", 1, &osc("/a", 0, 0.5), false), Some(vec![0.0, 5.0]));
        assert_eq!(set("at", 2, &osc("/a", 0, 0.5), false), None);
        let place = |name: &str, value: f64| {
            place_of(uniforms().iter().find(|uniform| uniform.name == name).unwrap(), 0, value)
        };
        assert_eq!(
            [place("speed", 1.0), place("count", 9.0), place("free", 0.25)],
            [Some(0.75), Some(1.0), Some(0.25)]
        );
        assert_eq!((place("speed", 4.0), place("on", 1.0)), (Some(1.5), None));
    }

    #[test]
    fn a_switch_follows_a_knob_and_is_toggled_by_a_key() {
        let at = |event: &ControlEvent| set("on", 0, event, false);
        assert_eq!((at(&osc("/a", 0, 1.0)), at(&osc("/a", 0, 0.4))), (Some(vec![1.0]), None));
        let key = |value| ControlEvent { source: ControlAddress::Note { channel: 0, key: 60 }, value };
        assert_eq!((at(&key(0.6)), at(&key(0.0))), (Some(vec![1.0]), None));
        let on = uniforms().into_iter().find(|uniform| uniform.name == "on").unwrap();
        assert_eq!(
            moved(&on, &CustomUniformValue::Bool(true), 0, &key(0.6), false),
            Some(CustomUniformValue::Bool(false))
        );
    }

    #[test]
    fn direct_addresses_use_the_units_of_the_slider() {
        assert_eq!(set("speed", 0, &osc("/eddy/speed", 0, -1.5), true), Some(vec![-1.5]));
        assert_eq!(set("speed", 0, &osc("/eddy/speed", 0, 99.0), true), Some(vec![2.0]));
        assert_eq!(set("free", 0, &osc("/eddy/free", 0, 1e30), true), Some(vec![1e30]));
        assert_eq!(set("free", 0, &osc("/eddy/free", 0, 1e300), true), None, "no float is so large");
        assert_eq!(set("whole", 0, &osc("/eddy/whole", 0, 1e30), true), Some(vec![2_147_483_647.0]));
        let named = |path: &str, argument| {
            direct(&osc(path, argument, 0.0).source).map(|moved| (moved.uniform.to_owned(), moved.index))
        };
        assert_eq!(named("/eddy/center", 1), Some(("center".into(), 1)));
        assert_eq!(named("/eddy/tint/g", 0), Some(("tint".into(), 1)));
        assert_eq!([named("/eddy/tint/q", 0), named("/eddy/a/b/c", 0), named("/1/fader", 0)], [None, None, None]);
    }
}
