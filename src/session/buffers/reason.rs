//! The reasons why a pass is not drawn.

use eddy_engine::{PassCost, PassRole, ReadTiming};
use eddy_project::PassName;

/// Returns in words why a pass was not drawn in the newest frame; `None` for one that was drawn.
pub fn reason(pass: &PassName, all: &[PassCost]) -> Option<String> {
    let cost = all.iter().find(|cost| cost.pass == *pass)?;
    match cost.role {
        PassRole::Drawn { is_cached: false } => return None,
        PassRole::Drawn { is_cached: true } => {
            return Some("unchanged: none of its inputs has changed since it was drawn".into());
        }
        PassRole::Outside => return Some("not drawn: its region is outside its texture".into()),
        PassRole::Off => {
            let when = cost.when.as_deref().unwrap_or_default();
            return Some(format!("not drawn: its condition is false ({when}); it holds what it holds before frame 0"));
        }
        PassRole::Unread => {}
    }
    let is_drawn = |cost: &PassCost| cost.role != PassRole::Unread;
    let readers = || {
        let others = all.iter().filter(|other| other.pass != *pass);
        others.flat_map(|other| other.reads.iter().filter(|read| read.pass == *pass).map(move |read| (other, read)))
    };
    if let Some((reader, read)) = readers().find(|(reader, _)| is_drawn(reader)) {
        let (name, channel) = (reader.pass.title(), read.channel);
        return Some(format!(
            "not drawn: iChannel{channel} of {name} is set to it, but the code never reads that channel"
        ));
    }
    let mut names: Vec<String> = readers().map(|(reader, _)| reader.pass.title()).collect();
    names.dedup();
    let itself = cost.reads.iter().any(|read| read.pass == *pass && read.when == ReadTiming::LastFrame);
    Some(match (names.is_empty(), itself) {
        (false, _) => format!("not drawn: read only by {}, which is not drawn either", names.join(", ")),
        (true, true) => "not drawn: no other pass reads it".into(),
        (true, false) => "not drawn: no channel reads it".into(),
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use eddy_engine::PassRead;

    fn cost(name: &str, role: PassRole, reads: &[&str]) -> PassCost {
        let id = |name: &str| if name == "image" { PassName::image() } else { PassName::buffer(name) };
        let read = |(channel, other): (usize, &&str)| PassRead {
            channel,
            pass: id(other),
            index: 0,
            when: if *other == name { ReadTiming::LastFrame } else { ReadTiming::ThisFrame },
            is_used: false,
        };
        PassCost {
            pass: id(name),
            role,
            when: (role == PassRole::Off).then(|| "quality > 1".to_owned()),
            size: (4, 4),
            formats: vec![],
            steps: 1,
            held_bytes: 0,
            moved_bytes: 0,
            texels: 16,
            reads: reads.iter().enumerate().map(read).collect(),
        }
    }

    #[test]
    fn reason_names_possible_readers_of_an_undrawn_pass() {
        let drawn = PassRole::Drawn { is_cached: false };
        let all = [
            cost("A", PassRole::Drawn { is_cached: true }, &[]),
            cost("image", drawn, &["A", "B"]),
            cost("B", PassRole::Unread, &[]),
            cost("C", PassRole::Unread, &["D"]),
            cost("D", PassRole::Unread, &[]),
            cost("E", PassRole::Unread, &["E"]),
            cost("F", PassRole::Outside, &[]),
            cost("G", PassRole::Off, &[]),
        ];
        let why = |name: &str| reason(&PassName::buffer(name), &all).unwrap();
        assert_eq!(reason(&PassName::image(), &all), None);
        assert!(why("A").starts_with("unchanged"));
        assert_eq!(why("B"), "not drawn: iChannel1 of Image is set to it, but the code never reads that channel");
        assert_eq!(why("C"), "not drawn: no channel reads it");
        assert_eq!(why("D"), "not drawn: read only by Buffer C, which is not drawn either");
        assert_eq!(why("E"), "not drawn: no other pass reads it");
        assert!(why("F").contains("region"));
        assert!(why("G").contains("condition is false (quality > 1)"));
    }
}
