//! A project, or one plain stage, with the editor's texts: its files, analyses and diagnostics.

use super::documents::Documents;
use eddy_diag::{self as diag, Diagnostic, Fix, SourceId, SourceMap, Span};
use eddy_engine::{AnalysisCache, Sources, StageAnalysis};
use eddy_glsl::{
    PassKind, PassSource, Text,
    cancel::Cancel,
    services::{Analysis, Programs},
};
use eddy_media as media;
use eddy_project::{
    self as project, Bindings, Body, EditedTexts, PassSettings, Project, ProjectError, ShaderForm, Stage,
};
use std::{
    collections::BTreeSet,
    path::{Path, PathBuf},
    sync::{Arc, atomic::AtomicBool},
};

/// The folder or the file that a program is loaded from.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) enum Root {
    /// A folder with a project.
    Folder(PathBuf),
    /// One GLSL file and the files that it names.
    File(PathBuf),
}

impl Root {
    pub(crate) fn path(&self) -> &Path {
        match self {
            Root::Folder(path) | Root::File(path) => path,
        }
    }

    /// Returns the folder that file names are relative to.
    fn base(&self) -> &Path {
        match self {
            Root::Folder(path) => path,
            Root::File(path) => path.parent().unwrap_or(Path::new("")),
        }
    }
}

pub(crate) struct Program {
    pub root: Root,
    /// A text of it has changed since it was read.
    pub is_stale: bool,
    /// Its diagnostics have changed since they were published.
    pub is_unpublished: bool,
    /// `None` for one plain stage, or for files that do not form a project.
    pub project: Option<Project>,
    /// The texts of the project, followed by further files that diagnostics refer to.
    pub texts: SourceMap,
    /// The file of each text.
    pub paths: Vec<PathBuf>,
    pub stages: Vec<StageAnalysis>,
    /// The kind of each stage if there is no project: stage `n` is text `n`.
    plain: Vec<PassKind>,
    /// The names in `#iUniform` lines.
    pub uniforms: Vec<(String, Span)>,
    /// The diagnostics of the texts.
    reported: Vec<Diagnostic>,
    media: Media,
    /// Documents for which diagnostics have been published.
    pub published: BTreeSet<String>,
    kept: AnalysisCache,
}

/// The diagnostics of pictures and models, which are read again when a project names different ones.
#[derive(Default)]
struct Media {
    of: Option<Vec<(Bindings, PassSettings, Body)>>,
    reported: Vec<Diagnostic>,
}

impl Program {
    pub(crate) fn new(root: Root) -> Self {
        Self {
            root,
            is_stale: true,
            is_unpublished: true,
            project: None,
            texts: SourceMap::default(),
            paths: Vec::new(),
            stages: Vec::new(),
            plain: Vec::new(),
            uniforms: Vec::new(),
            reported: Vec::new(),
            media: Media::default(),
            published: BTreeSet::new(),
            kept: AnalysisCache::default(),
        }
    }

    /// Returns the same program, unread, with the data kept for the next reading moved to it.
    pub(crate) fn take_unread(&mut self) -> Self {
        Self { kept: std::mem::take(&mut self.kept), ..Self::new(self.root.clone()) }
    }

    /// Replaces an earlier reading of the same program.
    pub(crate) fn replace(&mut self, earlier: &mut Self) {
        self.published = std::mem::take(&mut earlier.published);
        self.media = std::mem::take(&mut earlier.media);
        if self.project.is_none() {
            self.media = Media::default();
        }
    }

    /// Takes over the data that another reading of the program kept.
    pub(crate) fn take_cache_of(&mut self, other: Self) {
        self.kept = other.kept;
    }

    /// Reads the program again, unless it is cancelled.
    pub(crate) fn read(&mut self, documents: &Documents, cancel: &Arc<AtomicBool>) {
        (self.is_stale, self.is_unpublished) = (false, true);
        let text = documents.get(self.root.path()).map(|document| document.text.clone());
        if let (Root::File(path), Some(text)) = (&self.root, text)
            && let Some(kind) = plain_kind(path, &text)
        {
            let texts = vec![(path.clone(), text, kind)];
            self.take_alone(texts, cancel);
            self.reported = self.stages[0].analysis.diagnostics().to_vec();
            return;
        }
        match project::load_edited(self.root.path(), documents.texts()) {
            Ok(loaded) => self.take_project(loaded, cancel),
            Err(error) => {
                let around = self.root.base();
                let here = documents.iter().filter(|document| document.path.starts_with(around));
                let is_text = |path: &Path| !project::is_manifest(path);
                let alone = here.filter(|document| is_text(&document.path)).map(|document| {
                    let kind = plain_kind(&document.path, &document.text).unwrap_or(PassKind::Image);
                    (document.path.clone(), document.text.clone(), kind)
                });
                let alone: Vec<_> = match &self.root {
                    Root::Folder(_) => alone.collect(),
                    Root::File(path) => alone.filter(|(other, ..)| other == path).collect(),
                };
                self.take_alone(alone, cancel);
                self.take_error(&error);
            }
        }
    }

    fn take_project(&mut self, loaded: project::Loaded, cancel: &Arc<AtomicBool>) {
        let project::Loaded { project, warnings, sources } = loaded;
        let texts = Sources::new(&project).cancelled_by(cancel.clone());
        self.stages = self.kept.analyse(&project, &texts);
        let mut reported = warnings;
        reported.extend(self.kept.diagnose(&project, &texts, &self.stages));
        let advice = project::advice(&project);
        let is_new = |d: &Diagnostic| !reported.iter().any(|known| d.repeats(known));
        let advice: Vec<Diagnostic> = advice.into_iter().filter(is_new).collect();
        reported.extend(advice);
        self.reported = reported;
        let includes = project.includes.iter().map(|included| &included.source);
        let own = project.common.iter().map(Some).chain(project.common.is_none().then_some(None));
        let own = own.chain(project.passes.iter().map(|pass| Some(&pass.source)));
        let own = own.chain(project.stages().map(|(_, stage)| Some(stage))).chain(includes.map(Some));
        let base = self.root.base().to_owned();
        // The texts around a file with `void main()` are generated by Eddy and not in any file.
        let is_generated = |s: &project::Source| project.dialect.has_main() && s.path.is_none();
        let file = |source: Option<&project::Source>| {
            source
                .filter(|s| !is_generated(s))
                .map_or_else(PathBuf::new, |s| s.path.clone().unwrap_or_else(|| base.join(&s.name)))
        };
        let mut paths: Vec<PathBuf> = own.map(file).collect();
        let beside = sources.iter().skip(paths.len()).map(|(_, text)| base.join(&text.name));
        paths.extend(beside.collect::<Vec<_>>());
        self.uniforms = project.custom_uniform_names();
        (self.paths, self.texts) = (paths, sources);
        self.plain.clear();
        drop(texts);
        self.project = Some(project);
    }

    /// Uses texts that belong to no project, each by itself.
    fn take_alone(&mut self, texts: Vec<(PathBuf, Arc<str>, PassKind)>, cancel: &AtomicBool) {
        self.project = None;
        (self.texts, self.stages, self.paths, self.plain) = Default::default();
        self.uniforms.clear();
        self.media = Media::default();
        for (index, (path, text, kind)) in texts.into_iter().enumerate() {
            let id = self.texts.add(path.file_name().unwrap_or_default().to_string_lossy(), text.clone());
            let analysis = Arc::new(analyse_alone(kind, id, &text, Cancel::by(cancel)));
            self.stages.push(StageAnalysis { index, stage: Stage::Own, analysis });
            self.paths.push(path);
            self.plain.push(kind);
        }
    }

    /// Reports why the files do not form a project. Files that the error refers to are added after the texts.
    fn take_error(&mut self, error: &ProjectError) {
        let Some((diagnostics, sources)) = error.diagnostics() else {
            self.reported = vec![Diagnostic::error(None, error.to_string())];
            return;
        };
        let ids: Vec<SourceId> = sources
            .iter()
            .map(|(_, text)| {
                self.paths.push(self.root.base().join(&text.name));
                self.texts.add(text.name.clone(), text.text.clone())
            })
            .collect();
        let moved = |span: &mut Span| {
            if let Some(id) = ids.get(usize::from(span.source.0)) {
                span.source = *id;
            }
        };
        self.reported = diagnostics.to_vec();
        for diagnostic in &mut self.reported {
            diagnostic.span.iter_mut().for_each(moved);
            diagnostic.labels.iter_mut().for_each(|label| moved(&mut label.span));
            let edits = diagnostic.fixes.iter_mut().flat_map(|fix| &mut fix.edits);
            edits.for_each(|edit| moved(&mut edit.span));
        }
    }

    /// Returns all diagnostics, without duplicates.
    pub(crate) fn diagnostics(&self) -> Vec<Diagnostic> {
        let mut all = self.reported.clone();
        diag::append(&mut all, self.media.reported.iter().cloned());
        all
    }

    /// Returns whether the pictures and models differ from those that were checked last.
    pub(crate) fn has_unseen_media(&self) -> bool {
        let Some(project) = &self.project else { return false };
        let now = project.passes.iter().map(|pass| (&pass.bindings, &pass.settings, &pass.body));
        self.media.of.as_ref().is_none_or(|of| !of.iter().map(|(c, s, b)| (c, s, b)).eq(now))
    }

    /// Checks pictures and models; the time depends on their size.
    pub(crate) fn look_at_media(&mut self) {
        let Some(project) = &self.project else { return };
        let of = project
            .passes
            .iter()
            .map(|pass| (pass.bindings.clone(), pass.settings.clone(), pass.body.clone()))
            .collect();
        let reported = media::diagnose(project);
        self.is_unpublished |= reported != self.media.reported;
        self.media = Media { of: Some(of), reported };
    }

    /// Marks pictures and models as unchecked, after files on disk have changed.
    pub(crate) fn forget_media(&mut self) {
        self.media.of = None;
    }

    /// Returns the text of a file.
    pub(crate) fn id_of(&self, path: &Path) -> Option<SourceId> {
        let at = self.paths.iter().position(|other| other == path)?;
        Some(SourceId(at as u16))
    }

    pub(crate) fn contains(&self, path: &Path) -> bool {
        self.id_of(path).is_some()
    }

    /// Returns the file of a text.
    pub(crate) fn path_of(&self, id: SourceId) -> Option<&Path> {
        self.paths.get(usize::from(id.0)).map(PathBuf::as_path).filter(|path| !path.as_os_str().is_empty())
    }

    pub(crate) fn text(&self, id: SourceId) -> &str {
        self.texts.get(id).map_or("", |text| &text.text)
    }

    /// Returns the analysis of the stage that a text is read with: its own; for a text that several include, that of
    /// Image or the first.
    pub(crate) fn analysis(&self, id: SourceId) -> Option<&Analysis> {
        let Some(project) = &self.project else {
            return self.stages.get(usize::from(id.0)).map(|stage| &*stage.analysis);
        };
        let own = self.stages.iter().find(|stage| project.stage_id(stage.index, stage.stage) == id);
        let has_it = |stage: &&StageAnalysis| stage.analysis.text(id).is_some();
        let image = |stage: &&StageAnalysis| project.passes[stage.index].id.is_image();
        let with = || self.stages.iter().filter(has_it);
        let found = own.or_else(|| with().find(image)).or_else(|| with().next())?;
        Some(&found.analysis)
    }

    /// Returns the file for diagnostics without a place.
    pub(crate) fn main_path(&self) -> Option<&Path> {
        let image = self.project.as_ref().and_then(|project| {
            let index = project.image_index()?;
            self.path_of(Project::pass_id(index))
        });
        let root = match &self.root {
            Root::File(path) => Some(path.as_path()),
            Root::Folder(_) => None,
        };
        image.or(root).or_else(|| self.paths.iter().map(PathBuf::as_path).find(|path| !path.as_os_str().is_empty()))
    }

    /// Calls `work` with all stages together.
    pub(crate) fn programs<T>(&self, work: impl FnOnce(&Programs<'_>) -> T) -> T {
        let analyses: Vec<&Analysis> = self.stages.iter().map(|stage| &*stage.analysis).collect();
        work(&Programs { analyses: &analyses, uniforms: &self.uniforms, texts: &self.texts })
    }

    /// Returns the edits that rename the item at a byte of a text, or why it cannot be renamed.
    pub(crate) fn rename(&self, at: (SourceId, usize), to: &str) -> Result<Fix, String> {
        self.programs(|programs| {
            let (name, _) = programs.renamable(at.0, at.1)?;
            if let Some(place) = self.project.as_ref().and_then(|project| project.fill_that_names(&name)) {
                return Err(format!("`{name}` is used in {place} too: write `{to}` there first, then rename it"));
            }
            programs.rename(at, to, |fix, check| match &self.project {
                Some(project) => {
                    let renamed = project.with_edits(fix);
                    let texts = Sources::new(&renamed);
                    let stages = AnalysisCache::default().analyse(&renamed, &texts);
                    let analyses: Vec<&Analysis> = stages.iter().map(|stage| &*stage.analysis).collect();
                    let uniforms = renamed.custom_uniform_names();
                    check(&Programs { analyses: &analyses, uniforms: &uniforms, texts: &renamed.texts() });
                }
                None => {
                    let mut texts = SourceMap::default();
                    for (id, text) in self.texts.iter() {
                        texts.add(text.name.clone(), fix.applied(id, &text.text));
                    }
                    let read = self.plain.iter().zip(texts.iter());
                    let read: Vec<Analysis> = read
                        .map(|(kind, (id, text))| analyse_alone(*kind, id, &text.text, Cancel::default()))
                        .collect();
                    let analyses: Vec<&Analysis> = read.iter().collect();
                    check(&Programs { analyses: &analyses, uniforms: &[], texts: &texts });
                }
            })
        })
    }

    /// Returns whether it is a file that belongs to no other program: a pass of its own, not one that others include.
    pub(crate) fn is_whole(&self) -> bool {
        match &self.root {
            Root::Folder(_) => true,
            Root::File(path) => self.id_of(path).is_some_and(|id| has_entry(self.text(id))),
        }
    }
}

/// Returns the kind of a plain shader.
fn plain_kind(path: &Path, text: &str) -> Option<PassKind> {
    match ShaderForm::of(path, text) {
        ShaderForm::PlainVertex => Some(PassKind::PlainVertex),
        ShaderForm::Program(_) => None,
    }
}

/// Returns whether a text is a pass of its own rather than one that others include.
fn has_entry(text: &str) -> bool {
    let mut words = text.split(|c: char| !(c.is_alphanumeric() || c == '_'));
    words.any(|word| matches!(word, "mainImage" | "mainSound" | "mainCubemap" | "main"))
}

/// Analyses a text that belongs to no project.
fn analyse_alone(kind: PassKind, id: SourceId, text: &str, cancel: Cancel<'_>) -> Analysis {
    Analysis::new(&PassSource { cancel, ..PassSource::new(kind, Text { id, text }) })
}

/// Returns the root of a file's program: the folder around it, if the project there contains the file, otherwise the
/// file by itself. The vertex shader of an ISF file belongs to that file.
pub(crate) fn root_of(path: &Path, edited: &EditedTexts) -> Root {
    let file = || Root::File(project::isf_of_vertex_shader(path, edited).unwrap_or_else(|| path.to_owned()));
    project::project_of(path, edited).map_or_else(file, Root::Folder)
}

#[cfg(test)]
mod tests {
    use super::*;
    use serde_json::json;

    /// Returns the errors and warnings of an ISF file that an editor has open.
    fn messages(text: &str) -> Vec<String> {
        let item = json!({"uri": "file:///nowhere/a.fs", "languageId": "glsl", "version": 1, "text": text});
        let mut documents = Documents::default();
        let path = documents.open(serde_json::from_value(item).expect("a document"));
        let mut program = Program::new(Root::File(path));
        program.read(&documents, &Arc::default());
        program.diagnostics().into_iter().map(|d| d.message).collect()
    }

    #[test]
    fn valid_isf_has_no_message() {
        let header = r#"/*{"INPUTS": [{"NAME": "a", "TYPE": "float", "DEFAULT": true}]}*/"#;
        for text in [
            "void main() { gl_FragColor = vec4(a, isf_FragNormCoord, fract(TIME)); }",
            "#extension GL_OES_standard_derivatives : enable\nvoid main() { gl_FragColor = vec4(fwidth(gl_FragCoord.x)); }",
            "#version 120\nvoid main() { gl_FragColor = vec4(RENDERSIZE, DATE.xy); }",
        ] {
            assert_eq!(messages(&format!("{header}\n{text}")), [""; 0], "{text}");
        }
        assert_eq!(messages("/*{}*/\nvoid main() { gl_FragColor = vec4(1.0); }"), [""; 0]);
    }

    #[test]
    fn malformed_header_is_one_message() {
        let text = r#"/*{"INPUTS": [{"NAME": "a", "TYPE": "float"}]*/ void main() { gl_FragColor = vec4(a); }"#;
        assert_eq!(messages(text).len(), 1);
    }

    #[test]
    fn macros_and_declarations_may_use_isf_names() {
        for text in [
            "#define TIME 0.2 * TIME\nvoid main() { gl_FragColor = vec4(fract(TIME)); }",
            "#define RENDERSIZE vec2(640.0, 360.0)\nvoid main() { gl_FragColor = vec4(RENDERSIZE, 0.0, 1.0); }",
            "#define iTime TIME\nvoid main() { gl_FragColor = vec4(fract(TIME), fract(iTime), 0.0, 1.0); }",
            "#define iResolution vec3(RENDERSIZE, 1.0)\nvoid main() { gl_FragColor = vec4(iResolution, RENDERSIZE.x); }",
            "float f(float TIME) { return TIME; }\n\
             void main() { vec4 DATE = vec4(0.25); int PASSINDEX = 1; gl_FragColor = vec4(f(0.5), DATE.xy, PASSINDEX); }",
            "struct S { float TIME; vec2 RENDERSIZE; };\n\
             void main() { S s; s.TIME = 0.5; s.RENDERSIZE = vec2(0.25); gl_FragColor = vec4(s.TIME, s.RENDERSIZE, 1.0); }",
        ] {
            assert_eq!(messages(&format!("/*{{\"CREDIT\": \"\"}}*/\n{text}")), [""; 0], "{text}");
        }
    }
}
