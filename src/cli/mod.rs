//! The front end without a window: arguments, messages and JSON lines, exit codes.
//!
//! Owns the syntax and the output of the command line. Opens no window: [`main`] returns that request to the binary,
//! because the front ends do not depend on each other. Code that another front end needs too is in `session`.

mod args;
mod audit;
mod bench;
mod check;
mod checkpoints;
mod command;
mod compare;
mod convert;
mod divergence;
mod doctor;
mod failure;
mod lab;
mod leave;
mod library;
mod lines;
mod machine;
mod manuals;
mod measured;
mod memory;
mod nonfinite;
mod opening;
mod panic_hook;
mod plan;
mod precision;
mod printed;
mod probe;
mod progress;
mod quiet;
mod recorded_sound;
mod render;
mod report;
mod sound;
mod source_excerpt;
mod stability;
mod startup;
mod sweep;
mod targets;
mod terminal;
mod text_place;
mod tiles;
mod trace;
mod translate;
mod tune;
mod unused;
mod written;

use crate::diag::escape_line;
use args::Cli;
pub use args::Window;
use clap::Parser;
use command::CommandError;
use failure::TROUBLE;
pub use failure::{error_chain, trouble};
pub use panic_hook::install as install_log_and_reports;
pub use startup::window_trouble;
use std::{
    env,
    io::{self, Write},
    process::ExitCode,
};

/// The stack size of the worker thread. Compilers recurse as deeply as an expression is nested, and generated shaders
/// nest deeply; unused pages cost nothing.
const STACK_BYTES: usize = 256 << 20;

/// The action of the binary after [`main`].
pub enum Next {
    /// Exit with a code.
    Exit(ExitCode),
    Window(Window),
}

/// Parses and executes the command line. Usage errors, `--help` and `--version` end the process.
pub fn main() -> Next {
    let Cli { window, command } = parse().with_guests();
    let Some(mut command) = command else {
        startup::confine_libraries();
        startup::close_own_console();
        return Next::Window(window.with_project_of_file());
    };
    if command.opens_device() {
        startup::confine_libraries();
        quiet::ask_for_no_wayland();
    }
    let worker = std::thread::Builder::new().name("main".into()).stack_size(STACK_BYTES);
    let code = match worker.spawn(move || exit_code(command.run())).map(std::thread::JoinHandle::join) {
        Ok(Ok(code)) => code,
        // The panic hook has reported it.
        Ok(Err(_)) => TROUBLE,
        Err(error) => trouble(format_args!("no thread could be started: {error}")),
    };
    leave::end_process(code);
    Next::Exit(ExitCode::from(code))
}

/// Parses the command line. clap repeats arguments in its errors, and a shell expands file names to arguments: control
/// characters in the arguments of an error are escaped.
fn parse() -> Cli {
    Cli::try_parse().unwrap_or_else(|error| {
        let escaped = env::args_os().map(|argument| escape_line(&argument.to_string_lossy()).into_owned());
        if let Err(error) = Cli::try_parse_from(escaped) {
            error.exit();
        }
        // The arguments are valid once the control characters are escaped.
        let _ = write!(terminal::stderr(), "{}", error.render());
        std::process::exit(error.exit_code())
    })
}

/// Returns the exit code of a command, after reporting its error.
fn exit_code(result: Result<u8, CommandError>) -> u8 {
    match result {
        Ok(code) => code,
        // The reader has closed the pipe, like `head`.
        Err(CommandError::Output(error)) if error.kind() == io::ErrorKind::BrokenPipe => 0,
        Err(error) => trouble(error),
    }
}
