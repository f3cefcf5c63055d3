//! A hash that identifies a measured project: measurements of other texts do not apply to it.

use super::{Body, Channel, Group, Input, InputKind, PassName, PassSettings, Project, SLOTS};
use std::fmt;

/// 64-bit FNV-1a (G. Fowler, L. Noll, K.-P. Vo).
pub struct Fingerprint(u64);

impl Fingerprint {
    /// Hashes a project's texts, groups, slider values, channels and settings.
    pub fn of(project: &Project) -> Fingerprint {
        let mut print = Fingerprint(0xcbf2_9ce4_8422_2325);
        // Conditions are hashed with the settings below; the rest of the file that contains them is not.
        let counted = project.sources().iter().count() - project.conditions().count();
        // Eddy generates the texts around a file with `void main()`, and the next version may generate different ones.
        let generated = if project.dialect.has_main() { 1 + project.passes.len() } else { 0 };
        for (_, source) in project.sources().iter().take(counted).skip(generated) {
            print.eat(source.text.as_bytes());
        }
        let groups: Vec<String> = project.groups.iter().map(group_text).collect();
        print.eat(format!("[{}] {:?}", groups.join(", "), project.custom_uniform_values).as_bytes());
        for pass in &project.passes {
            let slots = pass.bindings.iter().map(|(slot, _)| slot + 1).max().unwrap_or_default().max(SLOTS);
            let text = |slot| pass.bindings.get(slot).map_or("None".into(), channel_text);
            let channels: Vec<String> = (0..slots).map(text).collect();
            // The paths of the files are not hashed: they differ on other machines.
            let mut body = pass.body.clone();
            body.stages_mut().iter_mut().for_each(|stage| stage.path = None);
            let settings = SettingsText(&pass.settings, &body);
            print.eat(format!("[{}] {settings:?}", channels.join(", ")).as_bytes());
        }
        print
    }

    /// Hashes further bytes, and their end.
    pub fn eat(&mut self, bytes: &[u8]) {
        for byte in bytes.iter().chain(&[0xff]) {
            self.0 = (self.0 ^ u64::from(*byte)).wrapping_mul(0x0100_0000_01b3);
        }
    }

    pub fn text(&self) -> String {
        format!("{:016x}", self.0)
    }
}

/// Formats a pass's settings, as [`channel_text`] does a channel. Settings that were added later are omitted at their
/// defaults.
struct SettingsText<'p>(&'p PassSettings, &'p Body);

impl fmt::Debug for SettingsText<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let PassSettings { size, format, region, initial, boundary, when } = self.0;
        let mut text = f.debug_struct("PassSettings");
        text.field("size", size).field("format", format).field("region", region);
        text.field("initial", initial).field("boundary", boundary).field("body", self.1);
        if let Some(when) = when {
            text.field("when", &when.text());
        }
        text.finish()
    }
}

/// Formats a group, as [`channel_text`] does a channel.
fn group_text(group: &Group) -> String {
    let pass = |pass: &PassName| pass.buffer_name().map_or_else(|| pass.title(), |name| format!("Buffer({name:?})"));
    let passes: Vec<String> = group.passes.iter().map(pass).collect();
    format!("Group {{ name: {:?}, passes: [{}], steps: {} }}", group.name, passes.join(", "), group.steps)
}

/// Formats a channel. Stored results are keyed by hashes of these texts, so the wording never changes, whatever the
/// types are called.
fn channel_text(channel: &Channel) -> String {
    let input = match &channel.input {
        Input::Pass { id, target } => match (id.buffer_name(), target) {
            (Some(name), 0) => format!("Buffer({name:?})"),
            (Some(name), target) => format!("Target {{ buffer: {name:?}, index: {target} }}"),
            (None, _) => "CubemapPass".into(),
        },
        Input::Media { kind: InputKind::Texture, media } => format!("Texture({media:?})"),
        Input::Media { kind, media } => format!("{kind:?}({media:?})"),
        Input::Device(kind) => format!("{kind:?}"),
    };
    format!("Some(Channel {{ input: {input}, sampler: {:?} }})", channel.sampler)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Condition, Cull, DepthTest, MeshDraw, MeshSource, Normals, Origin, Pass, Source, Stage};

    #[test]
    fn newer_settings_at_their_default_do_not_change_fingerprints() {
        let text =
            "PassSettings { size: Canvas, format: Rgba32f, region: None, initial: None, boundary: None, body: Screen }";
        assert_eq!(format!("{:?}", SettingsText(&PassSettings::default(), &Body::Screen)), text);
        let source = Source { name: "Image".into(), path: None, text: "".into() };
        let mut project = Project::new("p", vec![Pass::new(PassName::image(), source)], Origin::Unsaved);
        let print = |project: &Project| Fingerprint::of(project).text();
        let before = print(&project);
        project.passes[0].settings.when = Some(Condition::parse("width > 3").unwrap());
        assert_ne!(print(&project), before);
    }

    #[test]
    fn spelling_of_groups_and_channels_never_changes() {
        let passes = vec![PassName::buffer("A"), PassName::buffer("glow"), PassName::image()];
        let text = r#"Group { name: "g", passes: [Buffer("A"), Buffer("glow"), Image], steps: 2 }"#;
        assert_eq!(group_text(&Group { name: "g".into(), passes, steps: 2 }), text);
        let input = |input: Input| channel_text(&Channel::new(input)).replace("Some(Channel { input: ", "");
        let spelled = |text: &str, found: String| assert!(found.starts_with(text), "{found}");
        spelled("Buffer(\"A\"), ", input(Input::buffer("a")));
        spelled("CubemapPass, ", input(Input::pass(PassName::cube())));
        let second = Input::Pass { id: PassName::buffer("scene"), target: 1 };
        spelled("Target { buffer: \"scene\", index: 1 }, ", input(second));
    }

    /// Results of projects with meshes were measured before a draw had a normals setting.
    #[test]
    fn normals_count_where_a_model_may_have_none() {
        let draw = |mesh, normals| MeshDraw {
            mesh,
            normals,
            vertex: Stage::Own,
            fragment: Stage::File(0),
            cull: Cull::Back,
            depth: DepthTest::Less,
            depth_write: true,
            color_write: true,
            scale: 0.5,
            rotation: [0.0, 14.0, 0.0],
            position: [0.0; 3],
        };
        let cube = MeshSource::Builtin("cube".into());
        let text = "MeshDraw { mesh: Builtin(\"cube\"), vertex: Own, fragment: File(0), cull: Back, depth: Less, \
                    depth_write: true, color_write: true, scale: 0.5, rotation: [0.0, 14.0, 0.0], position: [0.0, 0.0, 0.0] }";
        assert_eq!(format!("{:?}", draw(cube.clone(), None)), text);
        assert_ne!(format!("{:?}", draw(cube, Some(Normals::Flat))), text);
        // Since then, the same text has drawn a file's model without normals differently.
        let model = format!("{:?}", draw(MeshSource::File("a.obj".into()), None));
        assert!(model.contains("normals: None"), "{model}");
    }
}
