//! Writes a setting: into the project's files, or beside them.

use super::super::{targets, terminal::one_line, written};
use crate::{
    diag::Fix,
    engine::{BuildOptions, Pixels},
    gpu::Gpu,
    playback::{capture, offline::Offline},
    project::{self, Origin, Overwrite, PassName, Project},
    tune::{Request, Target, applied},
};
use anyhow::{Context, anyhow};
use std::{
    fmt::Write,
    fs,
    path::{Path, PathBuf},
};

/// The changes of a project by a setting.
pub(super) struct Changes {
    before: Project,
    after: Project,
    fix: Fix,
    /// Settings that are no edits of texts: name, old and new value.
    settings: Vec<(String, String, String)>,
}

impl Changes {
    pub(super) fn new(request: &Request, values: &[f64]) -> Self {
        let before = request.scene.project.clone();
        let (after, fix) = applied(&before, &request.knobs, values);
        let changed = request.knobs.iter().zip(values).filter(|(knob, value)| knob.value != **value);
        let settings = changed
            .filter(|(knob, _)| !matches!(knob.target, Target::Number { .. }))
            .map(|(knob, value)| (knob.name.clone(), knob.shown(knob.value), knob.shown(*value)))
            .collect();
        Self { before, after, fix, settings }
    }

    pub(super) fn is_any(&self) -> bool {
        !self.fix.edits.is_empty() || !self.settings.is_empty()
    }

    /// Returns the changed lines with signs, as in a patch.
    pub(super) fn diff(&self) -> String {
        let (texts, mut out) = (self.before.texts(), String::new());
        let mut last = None;
        for edit in &self.fix.edits {
            let (Some(source), Some(at)) = (texts.get(edit.span.source), texts.line_column(edit.span)) else {
                continue;
            };
            // Several edits of a line are shown once.
            if last.replace((edit.span.source, at.line)) == Some((edit.span.source, at.line)) {
                continue;
            }
            let old = source.text.lines().nth(at.line - 1).unwrap_or("");
            let text = self.fix.applied(edit.span.source, &source.text);
            let new = text.lines().nth(at.line - 1).unwrap_or("");
            let _ = writeln!(out, "{}:{}\n- {}\n+ {}", source.name, at.line, one_line(old), one_line(new));
        }
        for (name, old, new) in &self.settings {
            let _ = writeln!(out, "{}: {old} -> {new}", one_line(name));
        }
        out
    }

    pub(super) fn json(&self) -> serde_json::Value {
        let texts = self.before.texts();
        let edits = self.fix.edits.iter().filter_map(|edit| {
            let (source, at) = (texts.get(edit.span.source)?, texts.line_column(edit.span)?);
            Some(serde_json::json!({ "source": source.name, "line": at.line, "column": at.column,
                "old": source.text.get(edit.span.range())?, "new": edit.text }))
        });
        let settings =
            self.settings.iter().map(|(name, old, new)| serde_json::json!({ "setting": name, "old": old, "new": new }));
        edits.chain(settings).collect()
    }

    /// Writes the edit into the project's own files. Returns what was done and how it is undone.
    pub(super) fn apply(&self, spec: &str) -> anyhow::Result<String> {
        if !self.is_any() {
            return Ok("the project has this setting already\n".into());
        }
        let target = match &self.before.origin {
            Origin::Folder { path, .. } | Origin::File(path) | Origin::Json(path) => path.clone(),
            Origin::Preset(name) => {
                return Err(anyhow!(
                    "--apply: {name} is a preset of Eddy, which is not changed; save a copy, or use --out DIR"
                ));
            }
            Origin::Unsaved => return Err(anyhow!("--apply: {} is not on disk; use --out DIR", one_line(spec))),
        };
        let parent = if target.is_dir() { &target } else { target.parent().unwrap_or(Path::new("")) };
        let mut files: Vec<PathBuf> = self.before.tab_sources().filter_map(|source| source.path.clone()).collect();
        files.extend([target.clone(), target.join("eddy.toml")]);
        let old: Vec<(PathBuf, Vec<u8>)> =
            files.into_iter().filter_map(|path| Some((path.clone(), fs::read(&path).ok()?))).collect();
        let kept =
            (1..).map(|n| parent.join(format!("before-tune-{n}"))).find(|path| !path.exists()).unwrap_or_default();
        project::save(&self.after, &target, Overwrite::KeepIn(&kept))?;
        // Files of the project itself are replaced without a copy, so these are made here.
        let is_changed = |(path, bytes): &(PathBuf, Vec<u8>)| fs::read(path).ok().as_ref() != Some(bytes);
        let changed: Vec<(PathBuf, Vec<u8>)> = old.into_iter().filter(is_changed).collect();
        let name = |path: &Path| path.file_name().and_then(|name| name.to_str()).unwrap_or("text").to_owned();
        let copies: Vec<(String, &[u8])> = changed.iter().map(|(path, bytes)| (name(path), bytes.as_slice())).collect();
        written::write_all(&kept, copies.iter().map(|(name, bytes)| (name.as_str(), *bytes)), true)?;
        Ok(format!(
            "written to {}; the old files are in {}, copy them back to undo this\n",
            target.display(),
            kept.display()
        ))
    }

    /// Writes the tuned project, and a picture of both settings for each compared frame. Returns the names.
    pub(super) fn write_out(&self, folder: &Path, gpu: &Gpu, request: &Request) -> anyhow::Result<String> {
        written::make_folder("--out", folder)?;
        let copy = folder.join("project");
        project::save(&self.after, &copy, Overwrite::Allow).with_context(|| format!("--out {}", copy.display()))?;
        let (before, after) = (pictures(&self.before, gpu, request)?, pictures(&self.after, gpu, request)?);
        let mut out = format!("the tuned project: {}\n", copy.display());
        for ((frame, a), (_, b)) in before.iter().zip(&after) {
            let name = format!("frame_{frame:04}.png");
            targets::write(&folder.join(&name), &side_by_side(a, b), capture::Format::Png)?;
            let _ = writeln!(out, "present and proposed: {}", folder.join(&name).display());
        }
        Ok(out)
    }
}

fn pictures(project: &Project, gpu: &Gpu, request: &Request) -> anyhow::Result<Vec<(u32, Pixels)>> {
    let scene = &request.scene;
    let mut offline = Offline::new(gpu, scene.size, scene.inputs.clone())?;
    offline.build(project, &scene.media, &BuildOptions::default())?;
    let has_state = !project.stateful_passes().is_empty();
    let (mut all, mut frame) = (Vec::new(), 0);
    for &at in &scene.at {
        while frame < at {
            if has_state {
                offline.advance()?;
            } else {
                offline.skip()?
            }
            frame += 1;
        }
        offline.draw()?;
        frame += 1;
        all.push((at, offline.read(&PassName::image(), 0)?));
    }
    Ok(all)
}

fn side_by_side(a: &Pixels, b: &Pixels) -> Pixels {
    let (left, right) = (a.texels.chunks_exact(a.width as usize), b.texels.chunks_exact(b.width as usize));
    let texels = left.zip(right).flat_map(|(left, right)| [left, right].concat()).collect();
    Pixels { width: a.width + b.width, height: a.height, texels }
}
