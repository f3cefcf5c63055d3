//! The front end without a window: arguments, words and JSON lines, exit codes.
//!
//! Owns what the command line says and prints. Opens no window: [`main`] hands that wish back to the binary, because
//! the front ends do not know each other. Holds nothing another front end would need too; that lies in `session`.

mod args;
mod audit;
mod bench;
mod check;
mod checkpoints;
mod compare;
mod divergence;
mod doctor;
mod failure;
mod lab;
mod leave;
mod library;
mod machine;
mod manuals;
mod measured;
mod memory;
mod nonfinite;
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
mod sweep;
mod targets;
mod terminal;
mod text_place;
mod tiles;
mod trace;
mod translate;
mod written;

use crate::{diag::escape_line, lsp, playback::trial};
pub use args::Window;
use args::{Cli, Command};
use clap::Parser;
use failure::TROUBLE;
pub use failure::{error_chain, trouble};
pub use panic_hook::install as install_log_and_reports;
use std::{
    env,
    io::{self, Write},
    process::ExitCode,
};

/// Stack of the thread that does the work. Compilers recurse as deep as an expression is nested, and a shader made by a
/// program nests deeply; pages that are not used cost nothing.
const STACK_BYTES: usize = 256 << 20;

/// The work that is left to the binary after [`main`].
pub enum Next {
    /// Leave.
    Exit(ExitCode),
    Window(Window),
}

/// Reads the command line and does what it says. Usage errors, `--help` and `--version` end the process.
pub fn main() -> Next {
    let Cli { window, command } = parse().with_guests();
    let Some(mut command) = command else { return Next::Window(window.with_project_of_file()) };
    if matches!(
        command,
        Command::Render(_)
            | Command::Probe(_)
            | Command::Trace(_)
            | Command::Compare(_)
            | Command::Bench(_)
            | Command::Lab(_)
            | Command::Doctor(_)
            | Command::TryCompile
    ) {
        quiet::ask_for_no_wayland();
    }
    let worker = std::thread::Builder::new().name("main".into()).stack_size(STACK_BYTES);
    let code = match worker.spawn(move || run(&mut command)).map(std::thread::JoinHandle::join) {
        Ok(Ok(code)) => code,
        // The panic has said what it had to.
        Ok(Err(_)) => TROUBLE,
        Err(error) => trouble(format_args!("no thread could be started: {error}")),
    };
    leave::end_process(code);
    Next::Exit(ExitCode::from(code))
}

/// Reads the command line. clap repeats arguments in its errors, and a shell makes arguments of names of files: the error
/// is made of arguments whose control characters are escaped.
fn parse() -> Cli {
    Cli::try_parse().unwrap_or_else(|error| {
        let escaped = env::args_os().map(|argument| escape_line(&argument.to_string_lossy()).into_owned());
        if let Err(error) = Cli::try_parse_from(escaped) {
            error.exit();
        }
        // Only the control characters were wrong.
        let _ = write!(terminal::stderr(), "{}", error.render());
        std::process::exit(error.exit_code())
    })
}

fn run(command: &mut Command) -> u8 {
    if let Command::Render(args) = command {
        targets::choose_rate(args);
    }
    let result = match &*command {
        Command::Render(args) => {
            let inputs = match args.inputs() {
                Ok(inputs) => inputs,
                Err(usage) => return trouble(args.progress().failed(usage)),
            };
            match sound::Sounds::of(args) {
                Ok(None) => {}
                Ok(Some(sounds)) => match sounds.prepare() {
                    Ok(()) => return printed(sound::run(args, &sounds, &inputs)),
                    Err(error) => return trouble(args.progress().failed(error_chain(&error))),
                },
                Err(usage) => return trouble(args.progress().failed(usage)),
            }
            let targets = match targets::Targets::of(args) {
                Ok(targets) => targets,
                Err(usage) => return trouble(args.progress().failed(usage)),
            };
            if args.plan {
                return printed(plan::run(args, &targets, &inputs));
            }
            if let Err(error) = targets.prepare(args.run.canvas()) {
                return trouble(args.progress().failed(error_chain(&error)));
            }
            render::run(args, &targets, &inputs)
        }
        Command::Probe(args) => match args.face().and_then(|_| args.run.inputs_of(args.frame + 1)) {
            Ok(inputs) => probe::run(args, &inputs),
            Err(usage) => return trouble(usage),
        },
        Command::Trace(args) => match args.face().and_then(|_| args.run.inputs_of(args.frame + 1)) {
            Ok(inputs) => trace::run(args, &inputs),
            Err(usage) => return trouble(usage),
        },
        Command::Compare(args) => match args.run.inputs_of(args.frame + 1) {
            Ok(inputs) => compare::run(args, &inputs),
            Err(usage) => return trouble(usage),
        },
        Command::Check(args) => check::run(args),
        Command::Bench(args) => match args.inputs().and_then(|i| Ok((sweep::combinations(&args.sweep)?, i))) {
            Ok((sweep, inputs)) => bench::run(args, &sweep, &inputs),
            Err(usage) => return trouble(usage),
        },
        Command::Lab(args) => lab::run(args),
        Command::List => library::list(),
        Command::Import(args) => library::import(args),
        Command::Export(args) => library::export(args),
        Command::Translate(args) => match args.language() {
            Ok(language) => translate::run(args, language),
            Err(usage) => return trouble(usage),
        },
        Command::Lsp => lsp::serve(io::stdin(), io::stdout().lock()),
        Command::Doctor(args) => doctor::run(args),
        Command::Completions(args) => manuals::completions(args),
        Command::Man(args) => manuals::man(args),
        Command::TryCompile => return u8::from(trial::serve(io::stdin()).is_err()),
    };
    printed(result)
}

/// Returns the exit code of a command that has printed.
fn printed(result: io::Result<u8>) -> u8 {
    match result {
        Ok(code) => code,
        // Whoever read along has seen enough.
        Err(error) if error.kind() == io::ErrorKind::BrokenPipe => 0,
        Err(error) => trouble(format_args!("cannot write to standard output: {error}")),
    }
}
