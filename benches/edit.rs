//! Measures the time from an edit to its picture. `cargo bench --bench edit [PRESET]`.
//!
//! Changes a number in the text of Image, builds the program and draws a frame, repeatedly; prints the medians of
//! building, of the time until the picture, and of another frame, which is drawn in any case. Every edit has a
//! different text, so that no driver's cache on disk contains its pipeline.

use eddy::{
    engine::{BuildOptions, Builder, Engine, FrameInputs},
    gpu::{Gpu, GpuOptions},
    media,
    project::{self, Project},
};
use std::time::Instant;

const SIZE: (u32, u32) = (640, 360);
const EDITS: usize = 9;

fn main() {
    let preset = std::env::args().skip(1).find(|a| !a.starts_with('-')).unwrap_or_else(|| "fluid-accurate".into());
    let Ok(gpu) = Gpu::new(&GpuOptions::default()) else { return eprintln!("there is no graphics device") };
    let project = project::load(&preset).expect("a project").project;
    let (media, _) = media::gather(&project, None);
    let mut engine = Engine::new(gpu.clone(), SIZE.0, SIZE.1).expect("an engine");
    let mut builder = Builder::new(gpu.clone());
    println!("{preset}, {}x{}, {} passes, {}", SIZE.0, SIZE.1, project.passes.len(), gpu.describe());
    let (mut builds, mut pictures, mut frames) = (Vec::new(), Vec::new(), Vec::new());
    let salt = std::time::SystemTime::now().duration_since(std::time::UNIX_EPOCH).map_or(0, |t| t.subsec_nanos());
    for n in 0..=EDITS {
        let edited = edited(&project, n, salt);
        let start = Instant::now();
        let built = builder.build(&edited, &media, &BuildOptions::default()).expect("a program");
        let millis = start.elapsed().as_secs_f64() * 1e3;
        engine.set_program(built.program).expect("room for it");
        engine.draw(&FrameInputs::at_fixed_step(n as i32, 60.0)).expect("a frame");
        engine.gpu().wait().expect("a frame");
        let all = start.elapsed().as_secs_f64() * 1e3;
        let start = Instant::now();
        engine.draw(&FrameInputs::at_fixed_step(n as i32 + 1000, 60.0)).expect("a frame");
        engine.gpu().wait().expect("a frame");
        let frame = start.elapsed().as_secs_f64() * 1e3;
        if n == 0 {
            println!("opened: built {millis:.1} ms, with its first picture {all:.1} ms; {:?}", built.work);
        } else {
            builds.push(millis);
            pictures.push(all);
            frames.push(frame);
        }
    }
    let [build, picture, frame] = [builds, pictures, frames].map(median);
    println!(
        "edited: built {build:.1} ms, with its picture {picture:.1} ms, a further frame {frame:.1} ms; of {EDITS}"
    );
}

/// Returns the project with another number in the computation of Image.
fn edited(project: &Project, n: usize, salt: u32) -> Project {
    let mut project = project.clone();
    let source = &mut project.image_mut().expect("an Image").source;
    let name = "void mainImage";
    let at = source.text.find(name).expect("a mainImage");
    let (head, tail) = source.text.split_at(at);
    let wrapper = format!(
        "\nvoid mainImage(out vec4 o, in vec2 p) {{ eddy_main(o, p); o.rgb *= 1.0 - {}e-9 - 1e-4 * float({n}); }}\n",
        salt
    );
    source.text = format!("{head}void eddy_main{}{wrapper}", &tail[name.len()..]).into();
    project
}

fn median(mut all: Vec<f64>) -> f64 {
    all.sort_by(f64::total_cmp);
    all[all.len() / 2]
}
