//! Panics write a report to a file, with the latest warnings of the log.
//!
//! The logger and the panic hook are global to the process: `main` calls [`install`] once.

use crate::{
    diag::{escape_line, escape_message},
    gpu::loss::is_loss,
    session::{self, PanicReport, home_as_tilde},
};
use std::{
    backtrace::Backtrace,
    borrow::Cow,
    collections::VecDeque,
    env,
    ffi::OsStr,
    io::Write,
    panic::PanicHookInfo,
    path::Path,
    sync::{
        Arc, Mutex, PoisonError,
        atomic::{AtomicUsize, Ordering},
    },
    thread,
};

/// The number of log lines in a report.
const KEPT_LINES: usize = 20;

/// The maximum number of reports per process: what follows a panic is rarely new.
const MOST_REPORTS: usize = 3;

/// The target of the log line that names a device.
const DEVICE: &str = "eddy::device";

/// The latest lines of the log.
#[derive(Default)]
struct Recent {
    lines: VecDeque<String>,
    device: String,
}

/// Logs to standard error, and records the lines for a report.
struct Logger {
    terminal: env_logger::Logger,
    recent: Arc<Mutex<Recent>>,
}

impl Logger {
    /// Returns whether a report includes a line: warnings and errors of Eddy's own.
    fn keeps(metadata: &log::Metadata<'_>) -> bool {
        metadata.target() == DEVICE || metadata.level() <= log::Level::Warn && metadata.target().starts_with("eddy")
    }
}

impl log::Log for Logger {
    fn enabled(&self, metadata: &log::Metadata<'_>) -> bool {
        Self::keeps(metadata) || self.terminal.enabled(metadata)
    }

    fn log(&self, record: &log::Record<'_>) {
        if Self::keeps(record.metadata()) {
            let mut recent = self.recent.lock().unwrap_or_else(PoisonError::into_inner);
            if record.target() == DEVICE {
                recent.device = record.args().to_string();
            } else {
                recent.lines.push_back(format!("{}: {}", record.level().as_str().to_lowercase(), record.args()));
                if recent.lines.len() > KEPT_LINES {
                    recent.lines.pop_front();
                }
            }
        }
        if self.terminal.matches(record) {
            let text = record.args().to_string();
            let mut shown = log::Record::builder();
            shown.metadata(record.metadata().clone()).module_path(record.module_path());
            shown.file(record.file()).line(record.line());
            self.terminal.log(&shown.args(format_args!("{}", escape_message(&text))).build());
        }
    }

    fn flush(&self) {
        self.terminal.flush();
    }
}

/// Starts the log, and makes each panic write a report.
pub fn install() {
    // Internal errors are worth a line; the messages of other libraries are not.
    let environment = env_logger::Env::default().default_filter_or("error,naga=off,symphonia=off,eddy=warn");
    let terminal = env_logger::Builder::from_env(environment).build();
    let recent = Arc::new(Mutex::new(Recent::default()));
    let most = terminal.filter().max(log::LevelFilter::Info);
    if log::set_boxed_logger(Box::new(Logger { terminal, recent: recent.clone() })).is_ok() {
        log::set_max_level(most);
    }
    let before = std::panic::take_hook();
    let written = AtomicUsize::new(0);
    std::panic::set_hook(Box::new(move |panic| {
        // It is caught, and reported as a lost device.
        if panic.payload_as_str().is_some_and(is_loss) {
            return;
        }
        match panic.payload_as_str() {
            // An untrusted text, which the hook of the standard library would print unescaped.
            Some(said) if matches!(escape_line(said), Cow::Owned(_)) => {
                let name = thread::current().name().unwrap_or("<unnamed>").to_owned();
                let place = panic.location().map(ToString::to_string).unwrap_or_default();
                let said = escape_message(said);
                let _ = writeln!(super::terminal::stderr(), "thread '{name}' panicked at {place}:\n{said}");
            }
            _ => before(panic),
        }
        if written.fetch_add(1, Ordering::Relaxed) >= MOST_REPORTS {
            return;
        }
        let folder = session::report_folder().unwrap_or_else(|| env::temp_dir().join("eddy-reports"));
        tell(&report(panic, &recent), &folder);
    }));
}

/// Writes a report, and prints its path.
fn tell(report: &PanicReport, folder: &Path) {
    let said = match report.write(folder) {
        Ok(path) => {
            let path = home_as_tilde(&path.display().to_string());
            format!("A report of this bug was written to {path}. Please read it and attach it to an issue")
        }
        Err(error) => format!("A report of this bug could not be written to {}: {error}", folder.display()),
    };
    // If standard error is closed, there is nowhere to report.
    let _ = writeln!(super::terminal::stderr(), "{said}");
}

fn report(panic: &PanicHookInfo<'_>, recent: &Mutex<Recent>) -> PanicReport {
    // A panic in the logger holds the lock; then the lines are omitted.
    let (notices, device) = recent
        .try_lock()
        .map(|recent| (recent.lines.iter().cloned().collect(), recent.device.clone()))
        .unwrap_or_default();
    PanicReport {
        build: super::doctor::build(),
        command: command(env::args_os().nth(1).as_deref().and_then(OsStr::to_str)),
        thread: thread::current().name().unwrap_or("without a name").to_owned(),
        message: panic.payload_as_str().unwrap_or("no reason given").to_owned(),
        place: panic.location().map(ToString::to_string).unwrap_or_default(),
        device,
        notices,
        backtrace: Backtrace::force_capture().to_string(),
    }
}

/// Returns the name of a command. Any other first argument is a project, whose name is private.
fn command(first: Option<&str>) -> String {
    let is_command = |name: &str| super::args::command_names().iter().any(|known| known == name);
    first.filter(|name| is_command(name)).map_or_else(|| "the window".to_owned(), |name| format!("eddy {name}"))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn only_names_of_commands_are_reported() {
        assert_eq!(command(Some("render")), "eddy render");
        assert_eq!(command(Some("secret-project")), "the window");
        assert_eq!(command(None), "the window");
    }
}
