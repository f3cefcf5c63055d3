//! A number for what is measured: what was measured of other texts says nothing about these.

use super::{Channel, Input, InputKind, PassId, Project};

/// FNV-1a of 64 bits (G. Fowler, L. Noll, K.-P. Vo).
pub struct Fingerprint(u64);

impl Fingerprint {
    /// Returns that of a project's texts, groups, slider values, channels and settings.
    pub fn of(project: &Project) -> Fingerprint {
        let mut print = Fingerprint(0xcbf2_9ce4_8422_2325);
        // Of conditions the settings below say what counts, and not the rest of the file that they stand in.
        let counted = project.sources().iter().count() - project.conditions().count();
        for (_, source) in project.sources().iter().take(counted) {
            print.eat(source.text.as_bytes());
        }
        print.eat(format!("{:?} {:?}", project.groups, project.custom_uniform_values).as_bytes());
        for pass in &project.passes {
            let channels = pass.channels.each_ref().map(|channel| channel.as_ref().map_or("None".into(), channel_text));
            print.eat(format!("[{}] {:?}", channels.join(", "), pass.settings).as_bytes());
        }
        print
    }

    /// Takes in what else counts, and where it ends.
    pub fn eat(&mut self, bytes: &[u8]) {
        for byte in bytes.iter().chain(&[0xff]) {
            self.0 = (self.0 ^ u64::from(*byte)).wrapping_mul(0x0100_0000_01b3);
        }
    }

    pub fn text(&self) -> String {
        format!("{:016x}", self.0)
    }
}

/// Spells a channel. Results on disk are known by numbers of these texts, so the words never change, whatever the types
/// are called.
fn channel_text(channel: &Channel) -> String {
    let input = match &channel.input {
        Input::Pass { id: PassId::Buffer(name), target: 0 } => format!("Buffer({name:?})"),
        Input::Pass { id: PassId::Buffer(name), target } => format!("Target {{ buffer: {name:?}, index: {target} }}"),
        Input::Pass { .. } => "CubemapPass".into(),
        Input::Media { kind: InputKind::Texture, media } => format!("Texture({media:?})"),
        Input::Media { kind, media } => format!("{kind:?}({media:?})"),
        Input::Device(kind) => format!("{kind:?}"),
    };
    format!("Some(Channel {{ input: {input}, sampler: {:?} }})", channel.sampler)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Condition, Origin, Pass, PassSettings, Source};

    #[test]
    fn a_setting_that_came_later_changes_no_number_of_projects_without_it() {
        let text =
            "PassSettings { size: Canvas, format: Rgba32f, region: None, initial: None, boundary: None, body: Screen }";
        assert_eq!(format!("{:?}", PassSettings::default()), text);
        let source = Source { name: "Image".into(), path: None, text: "".into() };
        let mut project = Project::new("p", vec![Pass::new(PassId::Image, source)], Origin::Unsaved);
        let print = |project: &Project| Fingerprint::of(project).text();
        let before = print(&project);
        project.passes[0].settings.when = Some(Condition::parse("width > 3").unwrap());
        assert_ne!(print(&project), before);
    }
}
