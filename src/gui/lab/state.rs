//! The state of the panel: the results, the current run, and the folder for results.

use super::model::{ExtentResults, PlotData};
use crate::{
    background::{Background, Control},
    gpu::Gpu,
    gui::ui_output::UiOutput,
    lab::{
        self, Extent, LabError, Point, Results, Shard, Study,
        background_run::{BackgroundRun, Event, Progress},
        cost,
        open::Opened,
        report,
        run::Options,
        studies,
    },
    project::Tab,
    session::{FileCommand, Session},
};
use serde_json::{Value, json};
use std::{
    path::{Path, PathBuf},
    sync::Arc,
};

/// The panel's state.
pub(crate) struct Lab {
    pub(super) wake: Arc<dyn Fn() + Send + Sync>,
    pub(super) gpu: Gpu,
    pub(super) studies: Vec<&'static Study>,
    pub(super) study: usize,
    pub(super) extent: Extent,
    /// Quick, then full.
    pub(super) known: [ExtentResults; 2],
    pub(super) shown: Option<PlotData>,
    pub(super) run: Option<Run>,
    pub(super) folder: Folder,
    /// A report that is being written.
    pub(super) saving: Option<(Extent, Background<(), (), PathBuf>)>,
    /// The result of the last operation, and whether it failed.
    pub(super) message: Option<(String, bool)>,
    /// The point whose project was opened last.
    pub(super) opened: Option<Point>,
    /// The name of the project that a click opens, and the tab to show once it is open: the pass that is measured.
    pub(super) code: Option<(String, Tab)>,
    /// The method of the legend that is below the pointer.
    pub(super) hovered_method: Option<usize>,
}

/// A current run.
pub(super) struct Run {
    pub(super) background: BackgroundRun,
    pub(super) study: usize,
    pub(super) extent: Extent,
    pub(super) progress: Progress,
}

/// The folder where results are kept.
pub(super) enum Folder {
    /// Created when it is first needed; deleted with the window.
    Temporary(Option<tempfile::TempDir>),
    Chosen(PathBuf),
}

impl Lab {
    pub(crate) fn new(gpu: Gpu, wake: Arc<dyn Fn() + Send + Sync>) -> Self {
        Self {
            wake,
            gpu,
            studies: studies::all(),
            study: 0,
            extent: Extent::Quick,
            known: Default::default(),
            shown: None,
            run: None,
            folder: Folder::Temporary(None),
            saving: None,
            message: None,
            opened: None,
            code: None,
            hovered_method: None,
        }
    }

    pub(super) fn known(&self, extent: Extent) -> &ExtentResults {
        &self.known[usize::from(extent == Extent::Full)]
    }

    fn known_mut(&mut self, extent: Extent) -> &mut ExtentResults {
        &mut self.known[usize::from(extent == Extent::Full)]
    }

    pub(super) fn study(&self) -> &'static Study {
        self.studies[self.study]
    }

    /// Applies the events of the run since the last frame.
    pub(crate) fn update(&mut self) {
        if let Some((extent, Some(saved))) = self.saving.as_mut().map(|(extent, saving)| (*extent, saving.take())) {
            self.saving = None;
            self.message = Some(match saved {
                Ok(path) => {
                    // The report lacks what a run has added meanwhile.
                    self.known_mut(extent).is_saved = self.run.is_none();
                    (format!("wrote {}", path.join("index.html").display()), false)
                }
                Err(why) => (format!("the report could not be written: {why}"), true),
            });
        }
        let Some(run) = &mut self.run else { return };
        let (extent, events) = (run.extent, run.background.events());
        let mut is_new = false;
        for event in events {
            is_new |= self.known_mut(extent).take(&event);
            match event {
                Event::Progress(progress) => {
                    if let Some(run) = &mut self.run {
                        run.progress = progress;
                    }
                }
                Event::Ended(ended) => {
                    self.run = None;
                    if let Err(why) = ended {
                        self.message = Some((why, true));
                    }
                }
                _ => {}
            }
        }
        if is_new && extent == self.extent {
            self.update_plot();
        }
    }

    fn update_plot(&mut self) {
        self.shown = self.known(self.extent).shown(self.study());
    }

    pub(super) fn choose(&mut self, study: usize, extent: Extent) {
        if (study, extent) != (self.study, self.extent) {
            (self.study, self.extent, self.hovered_method) = (study, extent, None);
            self.update_plot();
        }
    }

    /// Returns the folder of a run, which must not mix extents.
    fn out(&mut self, extent: Extent) -> Result<PathBuf, String> {
        match &mut self.folder {
            Folder::Chosen(path) => Ok(path.clone()),
            Folder::Temporary(Some(folder)) => Ok(folder.path().join(name_of(extent))),
            Folder::Temporary(none) => {
                let made = tempfile::Builder::new().prefix("eddy-lab-").tempdir();
                let made = made
                    .map_err(|e| format!("cannot create a temporary folder: {e}; choose a folder for the results"))?;
                Ok(none.insert(made).path().join(name_of(extent)))
            }
        }
    }

    /// Measures on this device from now on.
    pub(crate) fn change_device(&mut self, gpu: Gpu) {
        self.gpu = gpu;
    }

    /// Measures the missing points of the selected study. If none is missing, measures all again in a temporary
    /// folder.
    pub(super) fn start(&mut self) {
        self.message = None;
        if let Err(why) = self.try_start() {
            self.message = Some((why, true));
        }
    }

    fn try_start(&mut self) -> Result<(), String> {
        let (study, extent) = (self.study(), self.extent);
        let out = self.out(extent)?;
        if self.known(extent).is_whole(study, extent) {
            let known = self.known_mut(extent);
            known.results.forget(study.name);
            known.results.write(&out).map_err(|e| e.to_string())?;
            self.update_plot();
        }
        let gpu = self.gpu.clone();
        let open = move || Ok(gpu.for_background());
        let options = Options { out, extent, repeats: cost::MIN_REPEATS, shard: Shard::WHOLE };
        let background = BackgroundRun::start(open, vec![study], options, self.wake.clone());
        let background = background.map_err(|e| format!("cannot start a thread for the lab: {e}"))?;
        self.run = Some(Run { background, study: self.study, extent, progress: Progress::Begins });
        Ok(())
    }

    /// Keeps results in this folder from now on: results in it are shown, and an empty one gets the known ones.
    pub(crate) fn set_results_folder(&mut self, folder: PathBuf) {
        match self.try_set_results_folder(&folder) {
            Ok(()) => {
                self.message = Some((format!("results are kept in {}", folder.display()), false));
                self.folder = Folder::Chosen(folder);
                self.update_plot();
            }
            Err(why) => self.message = Some((why, true)),
        }
    }

    fn try_set_results_folder(&mut self, folder: &Path) -> Result<(), String> {
        let message_of = |e: LabError| e.to_string();
        let there = Results::read(folder).map_err(message_of)?;
        let Some(extent) = there.runs.first().map(|r| r.extent) else {
            let known = &self.known(self.extent).results;
            return if known.runs.is_empty() { Ok(()) } else { known.write(folder).map_err(message_of) };
        };
        let is_temporary = matches!(self.folder, Folder::Temporary(_));
        let known = self.known_mut(extent);
        if is_temporary && !known.is_saved && !known.results.errors.is_empty() {
            let folder = folder.display();
            return Err(format!(
                "{folder} already holds results, and the results in this window are not saved: save a report first, \
                 or choose an empty folder"
            ));
        }
        *known = ExtentResults { results: there, estimates: Vec::new(), is_saved: true };
        self.extent = extent;
        Ok(())
    }

    /// Returns whether there are results to report.
    pub(crate) fn has_results(&self) -> bool {
        !self.known(self.extent).results.errors.is_empty() && self.saving.is_none()
    }

    /// Writes the results as `eddy lab --out` does.
    pub(crate) fn save_report(&mut self, folder: PathBuf) {
        let results = self.known(self.extent).results.clone();
        let is_own = matches!(&self.folder, Folder::Chosen(path) if *path == folder);
        let studies = self.studies.clone();
        let write = move |_: &Control<()>| write_report(&folder, &studies, &results, is_own).map(|()| folder);
        match Background::once("lab report", "the report", self.wake.clone(), write) {
            Ok(saving) => {
                let saving = saving.detached();
                (self.saving, self.message) =
                    (Some((self.extent, saving)), Some(("writing the report…".into(), false)));
            }
            Err(e) => self.message = Some((format!("cannot start a thread for the report: {e}"), true)),
        }
    }

    /// Returns the tab to show of a project that was opened from here, once it is open.
    pub(crate) fn take_tab(&mut self, session: &Session) -> Option<Tab> {
        let is_there = self.code.as_ref().is_some_and(|(name, _)| *name == session.project().name);
        if is_there { self.code.take().map(|(_, tab)| tab) } else { None }
    }

    /// Opens the project of a clicked point in place of the open one.
    pub(super) fn open(&mut self, point: Point, out: &mut UiOutput) {
        match lab::open::project(self.study(), &point) {
            Ok(Opened { project, size, pass }) => {
                self.code = Some((project.name.clone(), Tab::Pass(pass)));
                out.ask(FileCommand::OpenProject { project: Box::new(project), size: Some(size) });
                self.opened = Some(point);
            }
            Err(error) => self.message = Some((error.to_string(), true)),
        }
    }

    /// Returns the report for scripts that drive the window.
    pub(crate) fn report(&self) -> Value {
        let dots = self.shown.as_ref().map_or(&[][..], |s| &s.dots);
        json!({
            "study": self.study().name,
            "extent": name_of(self.extent),
            "running": self.run.as_ref().map(|r| self.studies[r.study].name),
            "points": dots.len(),
            "estimates": dots.iter().filter(|d| d.is_estimate).count(),
            "told": self.message.as_ref().map(|(words, _)| words),
        })
    }
}

pub(super) fn name_of(extent: Extent) -> &'static str {
    if extent == Extent::Quick { "quick" } else { "full" }
}

fn write_report(folder: &Path, studies: &[&'static Study], results: &Results, is_own: bool) -> Result<(), String> {
    let taken = [lab::RESULTS_FILE, "index.html"].into_iter().find(|name| folder.join(name).exists());
    if let (Some(name), false) = (taken, is_own) {
        return Err(format!("{} already holds {name}; choose another folder", folder.display()));
    }
    let message_of = |e: LabError| e.to_string();
    results.write(folder).map_err(message_of)?;
    report::write(folder, studies, results).map(drop).map_err(message_of)
}
