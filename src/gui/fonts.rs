//! The window's fonts: Eddy's own for code, egui's for other text and emoji, and the system's for scripts that these
//! lack.

use crate::project::{confine, limits};
use egui::{Context, FontData, FontDefinitions, FontFamily};
use std::{io, path::Path, sync::Arc};

/// Noto Sans Mono: its zero has a thin stroke, which stays legible at small sizes. A missing glyph is drawn as the box
/// of its glyph `.notdef`.
const CODE: &[u8] = include_bytes!("../../assets/fonts/NotoSansMono-Regular.ttf");
const CODE_NAME: &str = "Noto Sans Mono";
const OWN_NAME: &str = "code-font";

/// Looks up letters that the window's fonts lack among the system's fonts, when the first of them is shown.
pub(super) fn install_system(ctx: &Context) {
    ctx.add_font_provider(Arc::new(egui_system_font_provider::SystemFontProvider::new()));
}

/// Sets the font of code; `own` is the font file that the user has chosen. Returns an error if it cannot be used.
pub(super) fn set(ctx: &Context, own: Option<&str>) -> Result<(), String> {
    let chosen = own.map(read);
    let mut definitions = FontDefinitions::default();
    definitions.font_data.insert(CODE_NAME.into(), Arc::new(FontData::from_static(CODE)));
    let mut names = vec![CODE_NAME.to_owned()];
    if let Some(Ok(data)) = &chosen {
        definitions.font_data.insert(OWN_NAME.into(), Arc::new(FontData::from_owned(data.clone())));
        names.insert(0, OWN_NAME.to_owned());
    }
    definitions.families.entry(FontFamily::Monospace).or_default().splice(0..0, names);
    ctx.set_fonts(definitions);
    chosen.transpose().map(drop)
}

/// Returns an error if a file cannot be the font of code.
pub(super) fn check(path: &str) -> Result<(), String> {
    read(path).map(drop)
}

/// Reads and validates a font: an invalid one would panic in egui.
fn read(path: &str) -> Result<Vec<u8>, String> {
    let data = confine::read_state_bytes(Path::new(path), limits::FONT)
        .and_then(|data| data.ok_or_else(|| io::ErrorKind::NotFound.into()))
        .map_err(|error| format!("code-font: {path}: {error}"))?;
    let face = ttf_parser::Face::parse(&data, 0)
        .map_err(|error| format!("code-font: {path} is not a TrueType or OpenType font: {error}"))?;
    match face.glyph_index('m') {
        Some(_) => Ok(data),
        None => Err(format!("code-font: {path} has no glyphs for code")),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use egui::FontId;
    use std::fs;

    fn frame(ctx: &Context) {
        let mut output = ctx.run_ui(egui::RawInput::default(), |_| {});
        output.textures_delta.clear();
    }

    #[test]
    fn the_font_of_code_is_monospaced() {
        let ctx = Context::default();
        set(&ctx, None).unwrap();
        frame(&ctx);
        let mono = FontId::monospace(13.0);
        ctx.fonts_mut(|fonts| {
            assert_eq!(fonts.definitions().families[&FontFamily::Monospace][0], CODE_NAME);
            let wide = fonts.glyph_width(&mono, 'm');
            for c in "il.0O{}αЖ→≤".chars() {
                assert!(fonts.has_glyph(&mono, c), "{c}");
                assert!((fonts.glyph_width(&mono, c) - wide).abs() < 0.01, "{c}");
            }
        });
    }

    #[test]
    fn a_chosen_font_has_priority_and_an_invalid_one_is_reported() {
        let folder = tempfile::tempdir().unwrap();
        let (good, bad) = (folder.path().join("a.ttf"), folder.path().join("b.ttf"));
        fs::write(&good, epaint_default_fonts::UBUNTU_LIGHT).unwrap();
        fs::write(&bad, "no font").unwrap();
        let ctx = Context::default();
        set(&ctx, good.to_str()).unwrap();
        frame(&ctx);
        let first = |ctx: &Context| ctx.fonts(|fonts| fonts.definitions().families[&FontFamily::Monospace][0].clone());
        assert_eq!(first(&ctx), OWN_NAME);
        for path in [&bad, &folder.path().join("none.ttf")] {
            let why = set(&ctx, path.to_str()).unwrap_err();
            assert!(why.starts_with(&format!("code-font: {}", path.display())), "{why}");
            frame(&ctx);
            assert_eq!(first(&ctx), CODE_NAME);
        }
    }

    #[test]
    fn emoji_are_built_in_and_missing_glyphs_are_boxes() {
        let ctx = Context::default();
        set(&ctx, None).unwrap();
        frame(&ctx);
        for (font, text) in [FontId::monospace(13.0), FontId::proportional(13.0)]
            .into_iter()
            .flat_map(|font| ["🌊", "🔥", "\u{10FFFD}"].map(|text| (font.clone(), text)))
        {
            let galley = ctx.fonts_mut(|fonts| fonts.layout_no_wrap(text.into(), font.clone(), egui::Color32::WHITE));
            let drawn = galley.rows[0].row.glyphs[0].uv_rect;
            assert!(drawn.size.x > 4.0 && drawn.size.y > 4.0, "{text} in {font:?}: {drawn:?}");
        }
        let has = |c| ctx.fonts_mut(|fonts| fonts.has_glyph(&FontId::monospace(13.0), c));
        assert!(has('🌊') && !has('\u{10FFFD}'));
    }

    /// Returns whether a font of the system has a letter; `None` if that is unknown.
    fn is_installed(letter: char) -> Option<bool> {
        let query = format!(":charset={:x}", u32::from(letter));
        let listed = std::process::Command::new("fc-list").args([&query, "file"]).output().ok()?;
        listed.status.success().then(|| !listed.stdout.trim_ascii().is_empty())
    }

    #[test]
    fn other_scripts_use_the_fonts_of_the_system() {
        let plain = Context::default();
        let ctx = Context::default();
        install_system(&ctx);
        for ctx in [&plain, &ctx] {
            set(ctx, None).unwrap();
            frame(ctx);
        }
        let has = |ctx: &Context, font: &FontId, c: char| ctx.fonts_mut(|fonts| fonts.has_glyph(font, c));
        for (script, letters) in
            [("Chinese and Japanese", "波光日の"), ("Korean", "한글"), ("Arabic", "موجة"), ("emoji", "🌊🎨")]
        {
            let own = letters.chars().all(|c| has(&plain, &FontId::monospace(13.0), c));
            if !own && letters.chars().any(|c| is_installed(c) != Some(true)) {
                crate::gpu::testing::skipped(&format!("no font for {script} is known here"));
                continue;
            }
            for c in letters.chars() {
                for font in [FontId::monospace(13.0), FontId::proportional(13.0)] {
                    assert!(has(&ctx, &font, c), "{script}: {c} has no glyph in {font:?}");
                }
            }
        }
    }
}
