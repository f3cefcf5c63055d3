//! The window's use of the lab, without the window: opening a point of a study as a project, and running in the
//! background.

use crate::support::{Engines, gpu};
use eddy::{
    engine::{BuildOptions, FrameInputs},
    lab::{
        Extent, Results, Rig, Shard,
        background_run::{BackgroundRun, Event},
        open::{self, Opened},
        run::Options,
        studies,
    },
    media,
    project::{self, FillValue, Origin, Overwrite, PassName, Project},
};
use std::{
    path::Path,
    sync::Arc,
    time::{Duration, Instant},
};

const FRAMES: i32 = 2;

/// Returns the texels of a pass after [`FRAMES`] frames, with the media that the project names.
fn draw(engines: &mut Engines, project: &Project, size: (u32, u32), pass: &PassName) -> Vec<[f32; 4]> {
    let (media, warnings) = media::gather(project, None);
    assert!(warnings.is_empty(), "{warnings:?}");
    let options = BuildOptions { requested: vec![pass.clone()], skip: true, ..BuildOptions::default() };
    let mut engine = engines.with(project, &media, &options, size);
    for frame in 0..FRAMES {
        engine.draw(&FrameInputs::at_fixed_step(frame, 60.0)).unwrap();
    }
    engine.read(pass).unwrap().texels
}

#[test]
fn every_setting_on_every_grid_is_a_project() {
    for study in studies::all() {
        for point in [Extent::Quick, Extent::Full].into_iter().flat_map(|extent| study.points(extent)) {
            if let Err(error) = open::project(study, &point) {
                panic!("{point:?}: {error}");
            }
        }
    }
}

#[test]
fn every_method_saved_as_a_project_draws_the_measured_texels() {
    let Some(gpu) = gpu() else { return };
    let mut engines = Engines::new(&gpu);
    let rig = Rig::new(gpu);
    let mut in_memory = 0;
    for study in studies::all() {
        let grid = study.grids(Extent::Quick)[0];
        let points = study.points(Extent::Quick);
        for method in study.methods {
            let named = |p: &&eddy::lab::Point| p.method == method.name;
            let point =
                points.iter().filter(named).min_by_key(|p| (p.grid != grid, p.setting != method.usual)).unwrap();
            let setup = (study.setup)(point);
            let Opened { project: opened, size, pass } = open::project(study, point).unwrap();
            assert_eq!((size, &opened.origin), (setup.size(), &Origin::Unsaved), "{point:?}");
            let fills = opened.fills().filter(|(.., f)| matches!(f.value, FillValue::InMemory { .. })).count();
            in_memory += fills;
            let folder = tempfile::tempdir().unwrap();
            let saved = project::save(&opened, &folder.path().join("saved"), Overwrite::Refuse);
            let saved = saved.unwrap_or_else(|e| panic!("{point:?}: {e}"));
            assert!(saved.fills().all(|(.., f)| !matches!(f.value, FillValue::InMemory { .. })));
            let loaded = project::load(folder.path().join("saved").to_str().unwrap()).unwrap();
            assert_eq!(loaded.warnings, [], "{point:?}");
            let mut running = rig.open(&setup).unwrap();
            running.frames(FRAMES as u32).unwrap();
            let name = pass.key();
            let measured = running.read(name.strip_prefix("buffer_").unwrap_or(name)).unwrap().texels().to_vec();
            let bits = |texels: &[[f32; 4]]| -> Vec<u32> { texels.iter().flatten().map(|v| v.to_bits()).collect() };
            // Saving changes only texels that are in memory.
            if fills > 0 || method.name == study.methods[0].name {
                assert!(bits(&draw(&mut engines, &opened, size, &pass)) == bits(&measured), "as opened: {point:?}");
            }
            assert!(bits(&draw(&mut engines, &loaded.project, size, &pass)) == bits(&measured), "as saved: {point:?}");
            // Identical texels would prove nothing.
            assert!(measured.iter().any(|t| t != &measured[0]), "{point:?}");
        }
    }
    assert!(in_memory > 0, "some method starts with texels that are only in memory");
}

/// Starts a run of the study *blur* in a folder and returns its events until `is_enough` or its end.
fn run_events(gpu: &eddy::gpu::Gpu, out: &Path, is_enough: impl Fn(&[Event]) -> bool) -> Vec<Event> {
    let study = studies::named(&["blur".into()]).unwrap();
    let options = Options { out: out.to_owned(), extent: Extent::Quick, repeats: 7, shard: Shard::WHOLE };
    let gpu = gpu.clone();
    let mut run = BackgroundRun::start(move || Ok(gpu), study, options, Arc::new(|| ())).unwrap();
    let (mut events, end) = (Vec::new(), Instant::now() + Duration::from_secs(120));
    while !matches!(events.last(), Some(Event::Ended(_))) {
        assert!(Instant::now() < end, "{events:?}");
        for event in run.events() {
            events.push(event);
        }
        if is_enough(&events) {
            run.stop();
        }
        std::thread::sleep(Duration::from_millis(2));
    }
    events
}

#[test]
fn a_run_reports_each_point_and_can_be_stopped_and_resumed() {
    let Some(gpu) = gpu() else { return };
    let folder = tempfile::tempdir().unwrap();
    let errors = |events: &[Event]| -> Vec<eddy::lab::Point> {
        let point = |e: &Event| if let Event::Measured(record) = e { Some(record.point.clone()) } else { None };
        events.iter().filter_map(point).collect()
    };
    let is_estimate = |e: &Event| matches!(e, Event::Estimate { millis, .. } if *millis > 0.0);
    let first = run_events(&gpu, folder.path(), |events| events.iter().any(is_estimate));
    assert!(matches!(first.last(), Some(Event::Ended(Ok(())))), "{:?}", first.last());
    let known = errors(&first);
    assert!(!known.is_empty() && !first.iter().any(|e| matches!(e, Event::Costed(_))));
    let results = Results::read(folder.path()).unwrap();
    assert_eq!(results.errors.len(), known.len());
    // The run records that a window was drawing at the same time.
    assert!(results.runs.iter().all(|run| run.beside_window));
    let second = run_events(&gpu, folder.path(), |events| errors(events).len() >= 2);
    let resumed_count =
        second.iter().find_map(|e| if let Event::Resumed(results) = e { Some(results.errors.len()) } else { None });
    assert_eq!(resumed_count, Some(known.len()));
    assert!(errors(&second).iter().all(|point| !known.contains(point)), "known points are not measured again");
    // The command line does not add its own measurements to such results.
    let options = Options { out: folder.path().into(), extent: Extent::Quick, repeats: 7, shard: Shard::WHOLE };
    let error = eddy::lab::run::run(&gpu, &[], &options, |_| ()).unwrap_err().to_string();
    assert!(error.contains("measured beside a window"), "{error}");
}
