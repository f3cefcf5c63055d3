//! The files of `assets/bounds`: the checks of presets, as assertions.
//!
//! Besides the statements of [`eddy_playback::assertion`] there are two. `use FILE [with NAME = PASS]` inserts the
//! statements of another file, in which this pass has a name of its own. `courant SLIDER = EXPRESSION
//! gives EXPRESSION [because REASON]` says how the cells per step are set and measured: see [`Courant`].

use super::{Courant, Declared, cases};
use eddy_playback::assertion::{StatementError, Statements};
use eddy_project::PassName;
use include_dir::{Dir, include_dir};

static FILES: Dir<'static> = include_dir!("$CARGO_MANIFEST_DIR/../../assets/bounds");

/// An error in a file of bounds.
#[derive(Debug, thiserror::Error)]
#[error("assets/bounds/{file}.txt, {error}")]
pub struct BoundsError {
    file: String,
    error: StatementError,
}

/// Reads the bounds of a preset; `None` if there is no file for it.
pub(super) fn read(preset: &str) -> Result<Option<Declared>, BoundsError> {
    text_of(preset).map(|text| read_text(preset, text)).transpose()
}

fn text_of(file: &str) -> Option<&'static str> {
    FILES.get_file(format!("{file}.txt"))?.contents_utf8()
}

fn read_text(file: &str, text: &str) -> Result<Declared, BoundsError> {
    let (mut statements, mut courant) = (Statements::default(), None);
    add(file, text, &mut statements, &mut courant)?;
    Ok(Declared { checks: statements.into_assertions(), courant, extras: cases::of(file) })
}

/// Adds the statements of a file.
fn add(file: &str, text: &str, statements: &mut Statements, courant: &mut Option<Courant>) -> Result<(), BoundsError> {
    let result = statements.read(text, &mut |reader, statements| {
        if reader.has("courant") {
            *courant = Some(Courant::read(reader, statements)?);
            return Ok(true);
        }
        if !reader.has("use") {
            return Ok(false);
        }
        let used = reader.name("the name of a file")?;
        let text = text_of(used).ok_or_else(|| format!("there is no assets/bounds/{used}.txt: correct the name"))?;
        if reader.has("with") {
            let name = reader.name("a name for a pass")?;
            reader.want("=", "after the name")?;
            let key = reader.name("a pass")?;
            let pass = PassName::parse(key).ok_or_else(|| format!("`{key}` is not the name of a pass"))?;
            statements.name_pass(name, pass);
        }
        add(used, text, statements, courant).map_err(|error| error.to_string())?;
        Ok(true)
    });
    result.map_err(|error| BoundsError { file: file.to_owned(), error })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn errors_name_the_file_the_line_and_the_fix() {
        for (text, says) in [
            ("image.x in 0..1;\nimage.y in 2..1", "assets/bounds/p.txt, line 2: the low end 2 of the range is above"),
            ("\n\nuse nothing;", "assets/bounds/p.txt, line 3: there is no assets/bounds/nothing.txt"),
            ("use mouse with = c;", "line 1: expected a name for a pass, found `= c;`"),
            (
                "// comment\nimage.x\n in 0..one\n because SMOOTH",
                "line 4: no `let` before it defines the text `SMOOTH`",
            ),
            ("use mouse with a = b + 1", "line 1: unexpected `+ 1` after the end"),
            ("courant dt = 1", "line 1: expected `gives` and the cells per step"),
            ("courant dt gives 1", "line 1: expected `=` after the slider"),
        ] {
            let error = read_text("p", text).map(drop).expect_err(text).to_string();
            assert!(error.contains(says), "{text}: {error}");
        }
        assert!(read("no such preset").unwrap().is_none());
    }

    #[test]
    fn files_may_use_others_and_name_their_passes() {
        let text = "use compressible with flow = buffer_q; image.x in 0..1";
        let Declared { checks, courant, .. } = read_text("p", text).unwrap();
        assert_eq!(checks.len(), 7);
        assert!(checks[..6].iter().all(|check| check.quantity.pass == PassName::buffer("Q")));
        assert_eq!(courant.unwrap().slider, "dt");
    }

    #[test]
    fn every_file_belongs_to_a_preset_or_is_used() {
        let stem = |file: &include_dir::File<'_>| file.path().file_stem().unwrap().to_str().unwrap().to_owned();
        let shared: Vec<String> =
            FILES.files().map(stem).filter(|name| !super::super::NAMES.contains(&name.as_str())).collect();
        for name in &shared {
            let uses = |file: &&include_dir::File<'_>| {
                file.contents_utf8().unwrap().lines().any(|line| line.starts_with(&format!("use {name}")))
            };
            assert!(FILES.files().filter(uses).count() > 1, "{name} is used by fewer than two files");
        }
        assert_eq!(FILES.files().count(), super::super::NAMES.len() + shared.len());
    }
}
