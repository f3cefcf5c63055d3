//! The lab's panel: a study that runs in the background, drawn as it goes.
//!
//! Owns which study is shown, where results are kept, and the run. What is measured and how is `lab`'s; a run is heard of over
//! its channel, and a click on a point opens that point's project as any other.

mod axis;
mod header;
mod legend;
mod model;
mod plot;

use super::{
    outbox::{Outbox, Pick, Wish},
    theme,
};
use crate::{
    gpu::{Gpu, GpuOptions},
    lab::{
        self, Extent, LabError, Point, Results, Shard, Study,
        background::{Background, Event, Progress},
        cost,
        open::Opened,
        report,
        run::Options,
        studies,
    },
    project::Tab,
    session::{Command, Session},
};
use egui::{Align, Layout, RichText, Ui, vec2};
use model::{Known, Shown};
use serde_json::{Value, json};
use std::{
    path::{Path, PathBuf},
    sync::{
        Arc,
        mpsc::{Receiver, channel},
    },
};

/// Width of the list of methods, and how wide the panel has to be to have one.
const LEGEND: f32 = 290.0;
const ROOM_FOR_LEGEND: f32 = 640.0;

pub struct Lab {
    wake: Arc<dyn Fn() + Send + Sync>,
    adapter: wgpu::AdapterInfo,
    studies: Vec<&'static dyn Study>,
    study: usize,
    extent: Extent,
    /// Quick, then full.
    known: [Known; 2],
    shown: Option<Shown>,
    run: Option<Run>,
    folder: Folder,
    /// A report that is being written.
    saving: Option<(Extent, Receiver<Result<PathBuf, String>>)>,
    /// What the last thing came to, and whether it went wrong.
    told: Option<(String, bool)>,
    /// The point whose project was opened last.
    opened: Option<Point>,
    /// The project that a click opens, by its name, and the tab that is shown when it is there: the pass that is measured.
    code: Option<(String, Tab)>,
    /// Of the list, under the pointer.
    hovered_method: Option<usize>,
}

/// A run under way.
struct Run {
    background: Background,
    study: usize,
    extent: Extent,
    progress: Progress,
}

/// Where results are kept.
enum Folder {
    /// Made when it is first needed; gone with the window.
    Temporary(Option<tempfile::TempDir>),
    Chosen(PathBuf),
}

impl Lab {
    pub fn new(gpu: &Gpu, wake: Arc<dyn Fn() + Send + Sync>) -> Self {
        Self {
            wake,
            adapter: gpu.info.clone(),
            studies: studies::all(),
            study: 0,
            extent: Extent::Quick,
            known: Default::default(),
            shown: None,
            run: None,
            folder: Folder::Temporary(None),
            saving: None,
            told: None,
            opened: None,
            code: None,
            hovered_method: None,
        }
    }

    fn known(&self, extent: Extent) -> &Known {
        &self.known[usize::from(extent == Extent::Full)]
    }

    fn known_mut(&mut self, extent: Extent) -> &mut Known {
        &mut self.known[usize::from(extent == Extent::Full)]
    }

    fn study(&self) -> &'static dyn Study {
        self.studies[self.study]
    }

    /// Takes in what the run has said since the last frame.
    pub fn update(&mut self) {
        if let Some((extent, Ok(saved))) = self.saving.as_ref().map(|(extent, saved)| (*extent, saved.try_recv())) {
            self.saving = None;
            self.told = Some(match saved {
                Ok(path) => {
                    // What a run has added meanwhile is not in it.
                    self.known_mut(extent).is_saved = self.run.is_none();
                    (format!("wrote {}", path.join("index.html").display()), false)
                }
                Err(why) => (format!("the report was not written: {why}"), true),
            });
        }
        let Some(run) = &mut self.run else { return };
        let (extent, events) = (run.extent, run.background.events().collect::<Vec<Event>>());
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
                        self.told = Some((why, true));
                    }
                }
                _ => {}
            }
        }
        if is_new && extent == self.extent {
            self.draw_anew();
        }
    }

    fn draw_anew(&mut self) {
        self.shown = self.known(self.extent).shown(self.study());
    }

    fn choose(&mut self, study: usize, extent: Extent) {
        if (study, extent) != (self.study, self.extent) {
            (self.study, self.extent, self.hovered_method) = (study, extent, None);
            self.draw_anew();
        }
    }

    /// The folder of a run, which mixes no extents.
    fn out(&mut self, extent: Extent) -> Result<PathBuf, String> {
        match &mut self.folder {
            Folder::Chosen(path) => Ok(path.clone()),
            Folder::Temporary(Some(folder)) => Ok(folder.path().join(name_of(extent))),
            Folder::Temporary(none) => {
                let made = tempfile::Builder::new().prefix("eddy-lab-").tempdir();
                let made = made.map_err(|e| format!("no temporary folder: {e}; choose a folder for the results"))?;
                Ok(none.insert(made).path().join(name_of(extent)))
            }
        }
    }

    /// Measures what is not known of the shown study. All of it anew where all is known, in a temporary folder.
    fn start(&mut self) {
        self.told = None;
        if let Err(why) = self.try_start() {
            self.told = Some((why, true));
        }
    }

    fn try_start(&mut self) -> Result<(), String> {
        let (study, extent) = (self.study(), self.extent);
        let out = self.out(extent)?;
        if self.known(extent).is_whole(study, extent) {
            let known = self.known_mut(extent);
            known.results.forget(study.about().name);
            known.results.write(&out).map_err(|e| e.to_string())?;
            self.draw_anew();
        }
        let adapter = self.adapter.clone();
        let open = move || Gpu::another(&adapter, &GpuOptions::default());
        let options = Options { out, extent, repeats: cost::MIN_REPEATS, shard: Shard::WHOLE };
        let background = Background::start(open, vec![study], options, self.wake.clone());
        let background = background.map_err(|e| format!("no thread for the lab: {e}"))?;
        self.run = Some(Run { background, study: self.study, extent, progress: Progress::Begins });
        Ok(())
    }

    /// Results are kept in this folder from now on: those it holds are shown, and an empty one gets those that are known.
    pub fn keep_in(&mut self, folder: PathBuf) {
        match self.try_keep_in(&folder) {
            Ok(()) => {
                self.told = Some((format!("results are kept in {}", folder.display()), false));
                self.folder = Folder::Chosen(folder);
                self.draw_anew();
            }
            Err(why) => self.told = Some((why, true)),
        }
    }

    fn try_keep_in(&mut self, folder: &Path) -> Result<(), String> {
        let said = |e: LabError| e.to_string();
        let there = Results::read(folder).map_err(said)?;
        let Some(extent) = there.runs.first().map(|r| r.extent) else {
            let known = &self.known(self.extent).results;
            return if known.runs.is_empty() { Ok(()) } else { known.write(folder).map_err(said) };
        };
        let is_temporary = matches!(self.folder, Folder::Temporary(_));
        let known = self.known_mut(extent);
        if is_temporary && !known.is_saved && !known.results.errors.is_empty() {
            let folder = folder.display();
            return Err(format!(
                "{folder} holds results, and those of this window are saved nowhere: save a report first, or choose an empty folder"
            ));
        }
        *known = Known { results: there, estimates: Vec::new(), is_saved: true };
        self.extent = extent;
        Ok(())
    }

    /// Writes what is known as `eddy lab --out` does.
    pub fn save_report(&mut self, folder: PathBuf) {
        let results = self.known(self.extent).results.clone();
        let is_own = matches!(&self.folder, Folder::Chosen(path) if *path == folder);
        let (sender, saved) = channel();
        let (studies, wake) = (self.studies.clone(), self.wake.clone());
        let write = move || {
            // Nobody waits where the window is gone.
            let _ = sender.send(write_report(&folder, &studies, &results, is_own).map(|()| folder));
            wake();
        };
        match std::thread::Builder::new().name("lab report".into()).spawn(write) {
            Ok(_) => {
                (self.saving, self.told) = (Some((self.extent, saved)), Some(("writing the report…".into(), false)))
            }
            Err(e) => self.told = Some((format!("no thread for the report: {e}"), true)),
        }
    }

    /// The tab to show of a project that was opened from here, once it is open.
    pub fn take_tab(&mut self, session: &Session) -> Option<Tab> {
        let is_there = self.code.as_ref().is_some_and(|(name, _)| *name == session.project().name);
        if is_there { self.code.take().map(|(_, tab)| tab) } else { None }
    }

    /// A click on a point: its project takes the place of the open one.
    fn open(&mut self, point: Point, out: &mut Outbox) {
        match lab::open::project(self.study(), &point) {
            Ok(Opened { project, size, pass }) => {
                self.code = Some((project.name.clone(), Tab::Pass(pass)));
                out.ask(Command::OpenProject { project: Box::new(project), size: Some(size) });
                self.opened = Some(point);
            }
            Err(error) => self.told = Some((error.to_string(), true)),
        }
    }

    pub fn show(&mut self, ui: &mut Ui, out: &mut Outbox) {
        ui.spacing_mut().item_spacing = vec2(6.0, 4.0);
        header::show(ui, self, out);
        if let Some((words, is_bad)) = &self.told {
            let color = if *is_bad { theme::ERROR } else { theme::GOOD };
            ui.add(egui::Label::new(RichText::new(words).size(12.0).color(color)).truncate().selectable(true));
        }
        let Some(shown) = self.shown.take() else { return self.show_about(ui) };
        let has_legend = ui.available_width() > ROOM_FOR_LEGEND;
        let height = ui.available_height();
        let mut clicked = None;
        let mut hovered_method = None;
        ui.horizontal_top(|ui| {
            let width = ui.available_width() - if has_legend { LEGEND + 12.0 } else { 0.0 };
            ui.allocate_ui(vec2(width, height), |ui| {
                let view = plot::View { opened: self.opened.as_ref(), lit: self.hovered_method, extent: self.extent };
                clicked = plot::show(ui, &shown, &view, out);
            });
            if has_legend {
                let layout = Layout::top_down(Align::Min);
                ui.allocate_ui_with_layout(vec2(LEGEND, height), layout, |ui| {
                    hovered_method = legend::show(ui, &shown);
                });
            }
        });
        self.hovered_method = hovered_method;
        if let Some(row) = clicked {
            self.open(shown.table.rows[row].point.clone(), out);
        }
        self.shown = Some(shown);
    }

    /// Before there is anything to plot.
    fn show_about(&self, ui: &mut Ui) {
        let (study, about) = (self.study(), self.study().about());
        egui::ScrollArea::vertical().auto_shrink(false).show(ui, |ui| {
            ui.add_space(6.0);
            ui.set_max_width(760.0);
            ui.label(RichText::new(about.title).size(17.0).color(theme::STRONG));
            ui.label(about.text);
            ui.add_space(4.0);
            for method in study.methods() {
                let settings: Vec<String> = method.settings.iter().map(f64::to_string).collect();
                ui.horizontal_wrapped(|ui| {
                    ui.label(method.title);
                    ui.colored_label(theme::WEAK, format!("{}: {}", about.knob, settings.join(", ")));
                });
            }
            ui.add_space(4.0);
            let points = study.points(self.extent).len();
            let grids: Vec<String> = study.grids(self.extent).iter().map(u32::to_string).collect();
            let words = match self.run {
                Some(_) => "The first points come soon.".to_owned(),
                None => format!("Start measures {points} points on grids of {} texels a side.", grids.join(", ")),
            };
            ui.colored_label(theme::WEAK, words);
        });
    }

    /// For scripts that drive the window.
    pub fn report(&self) -> Value {
        let dots = self.shown.as_ref().map_or(&[][..], |s| &s.dots);
        json!({
            "study": self.study().about().name,
            "extent": name_of(self.extent),
            "running": self.run.as_ref().map(|r| self.studies[r.study].about().name),
            "points": dots.len(),
            "estimates": dots.iter().filter(|d| d.is_estimate).count(),
            "told": self.told.as_ref().map(|(words, _)| words),
        })
    }

    /// Asks for a folder: to keep results in, or for a report.
    fn pick(out: &mut Outbox, pick: Pick) {
        out.wishes.push(Wish::Pick(pick));
    }
}

fn name_of(extent: Extent) -> &'static str {
    if extent == Extent::Quick { "quick" } else { "full" }
}

fn write_report(folder: &Path, studies: &[&dyn Study], results: &Results, is_own: bool) -> Result<(), String> {
    let taken = [lab::RESULTS_FILE, "index.html"].into_iter().find(|name| folder.join(name).exists());
    if let (Some(name), false) = (taken, is_own) {
        return Err(format!("{} holds {name} already; choose another folder", folder.display()));
    }
    let said = |e: LabError| e.to_string();
    results.write(folder).map_err(said)?;
    report::write(folder, studies, results).map(drop).map_err(said)
}
