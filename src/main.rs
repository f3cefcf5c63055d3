//! The binary: hands the command line to `cli`, and the wish for a window to `gui`.

use eddy::cli::{self, Next, Window};
use std::process::ExitCode;

/// A shader is compiled in a few hundred microseconds, of which the system's allocator took up to a tenth: the arenas
/// of a long text are given back to the system and fetched again, page by page, for each pass. It is built without huge
/// pages (`no_thp`): a thread's first compile touches a little of many, and the system takes a quarter of a millisecond
/// to clear 2 MiB.
#[global_allocator]
static ALLOCATOR: mimalloc::MiMalloc = mimalloc::MiMalloc;

fn main() -> ExitCode {
    cli::install_log_and_reports();
    match cli::main() {
        Next::Exit(code) => code,
        Next::Window(window) => match open(window) {
            Ok(()) => ExitCode::SUCCESS,
            Err(why) => ExitCode::from(cli::window_trouble(&cli::error_chain(&why))),
        },
    }
}

#[cfg(feature = "gui")]
fn open(window: Window) -> anyhow::Result<()> {
    let Window {
        project, size, set, follow, paused, frame_timeout, compile_timeout, webcam, osc, adapter, json, ..
    } = window;
    Ok(eddy::gui::run(eddy::gui::Options {
        project,
        size,
        set,
        follow,
        paused,
        frame_limit: frame_timeout,
        compile_timeout,
        webcam,
        osc,
        adapter,
        json,
    })?)
}

#[cfg(not(feature = "gui"))]
fn open(_: Window) -> anyhow::Result<()> {
    anyhow::bail!("this build of Eddy has no window (feature `gui` is off); `eddy --help` lists the commands")
}
