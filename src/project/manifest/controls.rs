//! `[controls]` of `eddy.toml`: which control of a MIDI or OSC device moves which uniform.

use super::{
    edit::{child, set},
    reader::Reader,
};
use crate::{
    ControlAddress, ControlBindings, ControlTarget, Project, controls::FORMS, custom_uniforms::words_of_uniforms,
    limits,
};
use eddy_diag::Diagnostic;
use std::{collections::BTreeSet, ops::Range};
use toml_edit::{Item, Table, TableLike, Value};

impl Reader<'_> {
    pub(super) fn controls(&mut self, root: &dyn TableLike) -> ControlBindings {
        let mut bindings = ControlBindings::new();
        let Some(table) = root.get("controls").and_then(|item| self.table("controls", item)) else { return bindings };
        for (name, item) in table.iter() {
            match item.as_table_like() {
                None => self.control(&mut bindings, Some(ControlTarget::whole(name)), name, item),
                Some(components) => {
                    for (component, item) in components.iter() {
                        let target = ControlTarget::of_component(name, component);
                        self.control(&mut bindings, target, &format!("{name}.{component}"), item);
                    }
                }
            }
            if bindings.len() > limits::CONTROLS {
                let message = format!("[controls] has more than {} entries, the limit", limits::CONTROLS);
                self.error(item.span(), message, "remove the entries of uniforms that no pass declares");
                break;
            }
        }
        bindings
    }

    fn control(&mut self, bindings: &mut ControlBindings, target: Option<ControlTarget>, name: &str, item: &Item) {
        let Some(text) = item.as_str() else { return self.wrong_type(name, item, "a string in quotes") };
        let Some(target) = target else {
            let message = format!("[controls] has no component {name}");
            return self.error(
                item.span(),
                message,
                "the components are x, y, z, w of a vector and r, g, b of a colour",
            );
        };
        match ControlAddress::parse(text) {
            Some(address) => drop(bindings.insert(target, address)),
            None => self.error(item.span(), format!("{name}: \"{text}\" is not a control"), format!("write {FORMS}")),
        }
    }

    /// Warns about controls of undeclared uniforms. These are only warnings, as for `[uniforms]`.
    pub(super) fn check_controls(&mut self, root: &dyn TableLike, project: &Project) {
        let Some(table) = root.get("controls").and_then(Item::as_table_like) else { return };
        let custom_uniforms = project.custom_uniforms();
        let declared: BTreeSet<String> =
            project.texts().iter().flat_map(|(_, source)| words_of_uniforms(&source.text)).collect();
        for target in project.controls.keys() {
            let name = &target.uniform;
            let at = table.key(name).and_then(toml_edit::Key::span).or_else(|| table.get(name).and_then(Item::span));
            let (message, hint) = match custom_uniforms.get(name) {
                None if declared.contains(name) => continue,
                None => custom_uniforms.unknown(name, &[], "the uniforms are"),
                Some(uniform) => {
                    let n = uniform.ty.components();
                    match (target.component, n) {
                        (None, 1) => continue,
                        (Some(_), 2..) if target.index() < n => continue,
                        (None, _) => {
                            let hint = format!("name a component, as in {name}.x = \"/1/fader3\"");
                            (format!("{name} is a {}, and a control moves one number", uniform.ty.name()), hint)
                        }
                        (Some(component), _) => {
                            let message = format!("{name} is a {} and has no component {component}", uniform.ty.name());
                            (message, "it stays in the file, but is not used".to_owned())
                        }
                    }
                }
            };
            self.warn(at, message, hint);
        }
    }

    fn warn(&mut self, at: Option<Range<usize>>, message: String, hint: String) {
        let span = self.span(at);
        self.diagnostics.push(Diagnostic::warning(span, message).hint(hint));
    }
}

/// Writes the bindings of a project; unchanged entries keep their formatting.
pub(super) fn write_controls(root: &mut Table, project: &Project) {
    let bindings = &project.controls;
    if bindings.is_empty() {
        root.remove("controls");
        return;
    }
    let Some(table) = child(root, "controls", false) else { return };
    let names: Vec<String> = table.iter().map(|(key, _)| key.to_owned()).collect();
    for name in names {
        let is_whole = bindings.contains_key(&ControlTarget::whole(name.as_str()));
        let has_components = bindings.keys().any(|target| target.uniform == name && target.component.is_some());
        let is_table = table.get(&name).is_some_and(Item::is_table_like);
        if (!is_whole && !has_components) || is_whole == is_table {
            table.remove(&name);
            continue;
        }
        let Some(entry) = table.get_mut(&name).and_then(Item::as_table_like_mut) else { continue };
        let gone = |key: &&str| {
            let target = ControlTarget::of_component(name.as_str(), key);
            target.is_none_or(|target| !bindings.contains_key(&target))
        };
        let gone: Vec<String> = entry.iter().map(|(key, _)| key).filter(gone).map(str::to_owned).collect();
        gone.iter().for_each(|key| drop(entry.remove(key)));
    }
    for (target, address) in bindings {
        let is_as_written =
            |item: Option<&Item>| item.and_then(Item::as_str).and_then(ControlAddress::parse).as_ref() == Some(address);
        let value = Value::from(address.to_string());
        match target.component {
            None if is_as_written(table.get(&target.uniform)) => {}
            None => set(table, &target.uniform, Some(value)),
            Some(component) => {
                if table.get(&target.uniform).is_none() {
                    let mut dotted = Table::new();
                    dotted.set_dotted(true);
                    table.insert(&target.uniform, Item::Table(dotted));
                }
                let component = component.to_string();
                if let Some(entry) = table.get_mut(&target.uniform).and_then(Item::as_table_like_mut)
                    && !is_as_written(entry.get(&component))
                {
                    set(entry, &component, Some(value));
                }
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use crate::{
        ControlAddress, ControlTarget, Loaded, Origin, Project, ProjectError, files::Files, manifest, write_manifest,
    };
    use std::collections::BTreeMap;

    const IMAGE: &str = "#iUniform float speed = 1.0 in { 0.0, 2.0 }\n#iUniform vec2 center\n\
                         void mainImage(out vec4 o, in vec2 p) { o = vec4(speed, center, 1.0); }\n";
    const PASSES: &str = "\n[passes.image]\n";

    fn read(text: &str) -> Result<Loaded, ProjectError> {
        let files = BTreeMap::from([("image.glsl".to_owned(), IMAGE.as_bytes().to_vec())]);
        manifest::project("p", "p".into(), text, &Files::in_memory(&files), Origin::Unsaved)
    }

    fn whole(text: &str) -> Project {
        let loaded = read(text).unwrap();
        assert_eq!(loaded.warnings, [], "{text}");
        loaded.project
    }

    #[test]
    fn written_controls_read_back_and_other_text_is_unchanged() {
        let text = format!(
            "[controls]\nspeed = \"MIDI 1 CC 21\" # knob\ncenter.x = \"/1/xy\"\ncenter.y = \"/1/xy 2\"\n{PASSES}"
        );
        let mut project = whole(&text);
        assert_eq!(project.controls.len(), 3);
        let y = ControlTarget::of_component("center", "y").unwrap();
        assert_eq!(project.controls[&y], ControlAddress::Osc { path: "/1/xy".into(), argument: 1 });
        assert_eq!(write_manifest(&project, Some(&text), "p", false), text, "nothing has changed");
        project.controls.remove(&y);
        project.controls.insert(ControlTarget::whole("speed"), ControlAddress::PitchBend { channel: 1 });
        let changed = write_manifest(&project, Some(&text), "p", false);
        assert!(changed.contains("speed = \"midi 2 bend\" # knob") && !changed.contains("center.y"), "{changed}");
        assert_eq!(whole(&changed).controls, project.controls);
        // A new file has the same content.
        let new = write_manifest(&project, None, "p", false);
        assert!(new.contains("center.x = \"/1/xy\""), "{new}");
        assert_eq!(whole(&new).controls, project.controls);
        project.controls.clear();
        assert!(!write_manifest(&project, Some(&text), "p", false).contains("controls"));
    }

    #[test]
    fn errors_are_reported_with_their_fix() {
        let said = |controls: &str| match read(&format!("[controls]\n{controls}\n{PASSES}")) {
            Ok(loaded) => loaded.warnings,
            Err(ProjectError::Invalid { diagnostics, .. }) => diagnostics,
            Err(error) => panic!("{error}"),
        };
        for (controls, message) in [
            ("speed = \"cc 21\"", "speed: \"cc 21\" is not a control"),
            ("speed = 21", "speed is an integer, not a string in quotes"),
            ("center.q = \"/a\"", "[controls] has no component center.q"),
            ("center = \"/a\"", "center is a vec2, and a control moves one number"),
            ("center.z = \"/a\"", "center is a vec2 and has no component z"),
            ("sped = \"/a\"", "no #iUniform line declares `sped`"),
        ] {
            let said = said(controls);
            assert_eq!(said.iter().map(|d| d.message.as_str()).collect::<Vec<_>>(), [message]);
            assert!(said[0].span.is_some() && !said[0].hints.is_empty(), "{said:?}");
        }
        let many: String = (0..=crate::limits::CONTROLS).map(|n| format!("u{n} = \"/a\"\n")).collect();
        assert!(said(&many).iter().any(|d| d.message.contains("the limit")));
    }
}
