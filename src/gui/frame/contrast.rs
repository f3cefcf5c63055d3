//! Measures the contrast of every visible text, in both themes, against what is painted below it: WCAG 2.2 requires
//! 4.5 to 1 for small text. Disabled widgets are exempt, and text over a picture is measured by the palette's own
//! tests.

use super::harness::{CTRL, CTRL_SHIFT, Stage, click, open, open_with, press, until};
use crate::{
    gui::{
        panels::Panel,
        settings::{Overrides, SettingsFile, WindowState},
    },
    session::{
        Answer, EditCommand, FileCommand, HaltCommand, Level, NoticeCommand, Question, SessionOptions, ToolCommand,
    },
};
use egui::{Color32, Key, Modifiers, Pos2, Rect, Shape, Theme, epaint::ClippedShape};
use std::collections::BTreeSet;

const MIN_CONTRAST: f32 = 4.5;

/// A shape painted below a text.
enum Backdrop {
    Fill(Rect, Color32),
    Picture(Rect),
}

fn luminance(color: Color32) -> f32 {
    let [r, g, b] = [color.r(), color.g(), color.b()].map(|v| {
        let v = f32::from(v) / 255.0;
        if v <= 0.04045 { v / 12.92 } else { ((v + 0.055) / 1.055).powf(2.4) }
    });
    0.2126 * r + 0.7152 * g + 0.0722 * b
}

fn contrast(a: Color32, b: Color32) -> f32 {
    let (a, b) = (luminance(a) + 0.05, luminance(b) + 0.05);
    a.max(b) / a.min(b)
}

/// Blends a colour over another; both are premultiplied.
fn over(top: Color32, below: Color32) -> Color32 {
    let seen =
        |top: u8, below: u8, alpha: u8| top.saturating_add((u16::from(below) * u16::from(255 - alpha) / 255) as u8);
    let a = top.a();
    Color32::from_rgb(seen(top.r(), below.r(), a), seen(top.g(), below.g(), a), seen(top.b(), below.b(), a))
}

/// Returns the background colour at a place; `None` over a picture.
fn backdrop_at(grounds: &[Backdrop], at: Pos2) -> Option<Color32> {
    let mut color = Some(Color32::BLACK);
    for ground in grounds {
        match ground {
            Backdrop::Fill(rect, fill) if rect.contains(at) => {
                color = match (color, fill.is_opaque()) {
                    (_, true) => Some(*fill),
                    (Some(below), false) => Some(over(*fill, below)),
                    (None, false) => None,
                };
            }
            Backdrop::Picture(rect) if rect.contains(at) => color = None,
            _ => {}
        }
    }
    color
}

/// Returns the texts with too little contrast, and the number of texts measured.
fn weak_texts(shapes: &[ClippedShape]) -> (BTreeSet<String>, usize) {
    let (mut grounds, mut weak, mut measured) = (Vec::new(), BTreeSet::new(), 0);
    let mut stack: Vec<(Rect, &Shape)> = shapes.iter().rev().map(|shape| (shape.clip_rect, &shape.shape)).collect();
    while let Some((clip, shape)) = stack.pop() {
        match shape {
            Shape::Vec(all) => stack.extend(all.iter().rev().map(|shape| (clip, shape))),
            Shape::Rect(rect) if rect.brush.is_some() => grounds.push(Backdrop::Picture(rect.rect.intersect(clip))),
            Shape::Rect(rect) if rect.fill.a() > 0 && rect.blur_width == 0.0 => {
                grounds.push(Backdrop::Fill(rect.rect.intersect(clip), rect.fill));
            }
            Shape::Mesh(mesh) => grounds.push(Backdrop::Picture(mesh.calc_bounds().intersect(clip))),
            Shape::Callback(callback) => grounds.push(Backdrop::Picture(callback.rect.intersect(clip))),
            Shape::Text(text) if text.angle == 0.0 => {
                for row in &text.galley.rows {
                    for glyph in row.glyphs.iter().filter(|glyph| !glyph.chr.is_whitespace()) {
                        let at = text.pos + row.pos.to_vec2() + glyph.logical_rect().center().to_vec2();
                        if !clip.contains(at) {
                            continue;
                        }
                        let Some(vertex) = row.visuals.mesh.vertices.get(glyph.first_vertex as usize) else { continue };
                        let own = if vertex.color == Color32::PLACEHOLDER { text.fallback_color } else { vertex.color };
                        let color = text.override_text_color.unwrap_or(own);
                        // Disabled widgets are painted faintly.
                        if text.opacity_factor < 1.0 || !color.is_opaque() {
                            continue;
                        }
                        let Some(ground) = backdrop_at(&grounds, at) else { continue };
                        measured += 1;
                        let ratio = contrast(color, ground);
                        if ratio < MIN_CONTRAST {
                            let words = row.text();
                            weak.insert(format!("{ratio:.2}: {color:?} on {ground:?}: {:.60}", words));
                        }
                    }
                }
            }
            _ => {}
        }
    }
    (weak, measured)
}

/// Asserts that everything shown has enough contrast.
fn check(stage: &mut Stage, what: &str, theme: Theme) {
    stage.run_steps(2);
    let (weak, measured) = weak_texts(&stage.output().shapes);
    let list: Vec<&str> = weak.iter().map(String::as_str).collect();
    assert!(weak.is_empty(), "{what}, {theme:?}: {} texts below {MIN_CONTRAST}:\n{}", list.len(), list.join("\n"));
    assert!(measured > 20, "{what}, {theme:?}: only {measured} letters were measured");
}

#[test]
fn every_text_has_enough_contrast_in_both_themes() {
    for theme in [Theme::Dark, Theme::Light] {
        let Some(mut stage) = open(false) else { return };
        stage.ctx.set_theme(theme);
        check(&mut stage, "the editor", theme);
        stage.state_mut().session.apply(NoticeCommand::Notify {
            level: Level::Error,
            text: "It failed.".into(),
            path: None,
        });
        stage.state_mut().session.apply(NoticeCommand::Notify {
            level: Level::Warning,
            text: "Mind it.".into(),
            path: None,
        });
        check(&mut stage, "notices", theme);
        for (what, modifiers, key) in [
            ("the palette", CTRL_SHIFT, Key::P),
            ("the help", Modifiers::NONE, Key::F1),
            ("finding and replacing", CTRL, Key::H),
            ("the passes", CTRL_SHIFT, Key::B),
        ] {
            press(&mut stage, modifiers, key);
            check(&mut stage, what, theme);
            press(&mut stage, Modifiers::NONE, Key::Escape);
        }
        for widget in ["button:view", "button:time", "button:options", "button:add-tab", "combo:size"] {
            click(&mut stage, widget);
            check(&mut stage, widget, theme);
            press(&mut stage, Modifiers::NONE, Key::Escape);
        }
        stage.state_mut().shell.set_open(Panel::Trace, true);
        stage.state_mut().session.apply(ToolCommand::Trace(Some([0.5, 0.5])));
        until(&mut stage, "a traced pixel", |stage| stage.state().session.trace().traced.is_some());
        for panel in Panel::all() {
            stage.state_mut().shell.set_open(panel, true);
            stage.run_steps(3);
            check(&mut stage, panel.title(), theme);
        }
        press(&mut stage, Modifiers::NONE, Key::F9);
        check(&mut stage, "code over picture", theme);
        let Some(mut stage) = open(true) else { return };
        stage.ctx.set_theme(theme);
        check(&mut stage, "the gallery", theme);
    }
}

/// Covers questions, and pages over the window.
#[test]
fn every_dialog_has_enough_contrast_in_both_themes() {
    for theme in [Theme::Dark, Theme::Light] {
        let kept = tempfile::tempdir().unwrap();
        let options = || SessionOptions { recovery: Some(kept.path().to_owned()), ..SessionOptions::default() };
        let Some(mut stage) = open_with(false, options()) else { return };
        let folder = stage.state().folder.path().to_owned();
        // A valid file, one with invalid lines, and one that cannot be read.
        let file = folder.join("settings.toml");
        for text in ["code-size = 20.0\nword-wrap = true\n", "zoom = 9\nthem = 3\n", "zoom = = 3\n"] {
            std::fs::write(&file, text).unwrap();
            let mut settings = SettingsFile::at(Some(file.clone()));
            settings.refresh();
            stage.state_mut().shell.restore(
                settings,
                &WindowState::default(),
                Overrides { frame_limit: true, osc: None },
            );
            stage.run_steps(2);
            press(&mut stage, CTRL, Key::Comma);
            // Up to here the theme is that of the settings.
            stage.ctx.set_theme(theme);
            assert!(stage.state().shell.place("settings:page").is_some());
            check(&mut stage, &format!("the settings of {text:?}"), theme);
            press(&mut stage, Modifiers::NONE, Key::Escape);
            assert!(stage.state().shell.place("settings:page").is_none());
        }
        stage.state_mut().session.apply(HaltCommand::Hold);
        stage.run_steps(3);
        assert!(stage.state().session.halt().is_some());
        check(&mut stage, "a slow frame", theme);
        stage.state_mut().session.apply(HaltCommand::GoOn);
        press(&mut stage, CTRL_SHIFT, Key::S);
        until(&mut stage, "the field for a path", |stage| stage.state().shell.place("field:path").is_some());
        check(&mut stage, "a path", theme);
        press(&mut stage, Modifiers::NONE, Key::Escape);

        let other = folder.join("other");
        std::fs::create_dir(&other).unwrap();
        std::fs::write(other.join("image.glsl"), "// of another project\n").unwrap();
        stage.state_mut().session.apply(FileCommand::SaveAs(other));
        until(&mut stage, "a question", |stage| {
            matches!(stage.state().session.question(), Some(Question::Overwrite { .. }))
        });
        check(&mut stage, "overwriting", theme);
        stage.state_mut().session.apply(FileCommand::Answer(Answer::Cancel));

        let tab = stage.state().session.tabs().into_iter().find(|tab| tab.title() == "Image").unwrap();
        let mine = format!("// mine\n{}", stage.state().session.text(&tab));
        stage.state_mut().session.apply(EditCommand::EditText { tab, text: mine });
        stage.state_mut().session.apply(FileCommand::New);
        stage.run_steps(3);
        assert!(matches!(stage.state().session.question(), Some(Question::Unsaved { .. })));
        check(&mut stage, "unsaved changes", theme);
        stage.state_mut().session.apply(FileCommand::Answer(Answer::Cancel));
        stage.run_steps(2);

        std::fs::write(folder.join("image.glsl"), "// of another program\n").unwrap();
        until(&mut stage, "a conflict", |stage| {
            matches!(stage.state().session.question(), Some(Question::Conflict { .. }))
        });
        check(&mut stage, "a conflict", theme);
        stage.state_mut().session.apply(FileCommand::Answer(Answer::KeepMine));
        let is_kept = |entry: std::fs::DirEntry| entry.path().extension().is_some_and(|e| e == "json");
        until(&mut stage, "unsaved work on disk", |_| std::fs::read_dir(kept.path()).unwrap().flatten().any(is_kept));
        // It ends without being closed.
        drop(stage);
        let Some(mut stage) = open_with(true, options()) else { return };
        stage.ctx.set_theme(theme);
        until(&mut stage, "what was left behind", |stage| stage.state().session.question().is_some());
        assert!(matches!(stage.state().session.question(), Some(Question::Recover(_))));
        check(&mut stage, "unsaved work", theme);
    }
}

/// Proves that the measure finds weak texts.
#[test]
fn planted_weak_texts_are_found() {
    let shown = |ground: Color32, text: Color32| {
        let mut output = egui::Context::default().run_ui(egui::RawInput::default(), |ui| {
            ui.painter().rect_filled(ui.max_rect(), 0.0, ground);
            ui.painter().text(ui.max_rect().center(), egui::Align2::CENTER_CENTER, "faint", Default::default(), text);
        });
        output.textures_delta.clear();
        weak_texts(&output.shapes)
    };
    assert_eq!(shown(Color32::BLACK, Color32::WHITE).0.len(), 0);
    assert_eq!(shown(Color32::WHITE, Color32::from_gray(90)).0.len(), 0);
    let (weak, measured) = shown(Color32::WHITE, Color32::from_gray(140));
    assert!(weak.len() == 1 && measured == 5, "{weak:?}, {measured}");
    let (seen_through, _) = shown(Color32::from_black_alpha(40), Color32::from_gray(70));
    assert_eq!(seen_through.len(), 1, "grey on almost black");
}
