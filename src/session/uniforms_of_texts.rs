//! Owns which of the author's own uniforms got which name, and what the texts declare before a program does.

use eddy_project::CustomUniform;

/// Old and new names, in the order in which they were given.
pub(super) type RenamedUniforms = Vec<(String, String)>;

/// The uniforms of the texts, where the program that draws declares none or there is none yet.
#[derive(Default)]
pub(super) struct DeclaredUniforms {
    pub list: Vec<CustomUniform>,
    /// The documents' revision that they are of.
    pub revision: Option<u64>,
}

/// Returns what became of a name.
pub(super) fn newest_name<'n>(renamed: &'n RenamedUniforms, name: &'n str) -> &'n str {
    renamed.iter().fold(name, |name, (from, to)| if from == name { to } else { name })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_name_is_followed_through_all_its_changes() {
        let renamed = |all: &[(&str, &str)]| -> RenamedUniforms {
            all.iter().map(|(from, to)| ((*from).to_owned(), (*to).to_owned())).collect()
        };
        let typed = renamed(&[("speed", "spee"), ("tint", "hue"), ("spee", "pace")]);
        assert_eq!(
            ["speed", "tint", "pace", "other"].map(|name| newest_name(&typed, name)),
            ["pace", "hue", "pace", "other"]
        );
        let taken_back = renamed(&[("speed", "pace"), ("pace", "speed")]);
        assert_eq!(newest_name(&taken_back, "speed"), "speed");
    }
}
