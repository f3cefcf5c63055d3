//! `eddy completions` and `eddy man`: what clap makes of the definitions of the command line.

use super::{
    args::{Cli, CompletionsArgs, ManArgs},
    command::{CommandError, Run},
    library::mend,
    machine::{Machine, RunError},
    report::{Printer, Report},
    terminal::{self, shown_path},
    written::write_all,
};
use clap::CommandFactory;
use std::io::{self, Write};

impl Run for CompletionsArgs {
    fn run(&mut self) -> Result<u8, CommandError> {
        Ok(completions(self)?)
    }
}

/// Prints the completions of a shell.
fn completions(args: &CompletionsArgs) -> io::Result<u8> {
    let mut script = Vec::new();
    clap_complete::generate(args.shell, &mut Cli::command(), "eddy", &mut script);
    let mut out = terminal::stdout();
    out.write_all(&script)?;
    out.flush()?;
    Ok(0)
}

impl Run for ManArgs {
    fn run(&mut self) -> Result<u8, CommandError> {
        Ok(man(self)?)
    }
}

/// Writes a page per command.
fn man(args: &ManArgs) -> io::Result<u8> {
    let mut report = Report::new("man");
    let written = Machine::default().attempt(&mut report, |_, _| {
        let pages = pages().map_err(anyhow::Error::from)?;
        let files = pages.iter().map(|(name, bytes)| (name.as_str(), &bytes[..]));
        write_all(&args.out, files, args.force).map_err(RunError::from).map_err(mend)?;
        Ok(pages.len())
    });
    let words = written.map(|n| format!("{n} pages written to {}", shown_path(&args.out)));
    let mut printer = Printer::new(false);
    printer.print(&report, &words.unwrap_or_default())?;
    Ok(printer.exit_code())
}

/// Returns the pages of the program and of all commands that its help lists, by the names of their files.
fn pages() -> io::Result<Vec<(String, Vec<u8>)>> {
    let mut command = Cli::command().disable_help_subcommand(true);
    command.build();
    let mut pages = Vec::new();
    add(&command, &mut pages)?;
    Ok(pages)
}

fn add(command: &clap::Command, pages: &mut Vec<(String, Vec<u8>)>) -> io::Result<()> {
    let page = clap_mangen::Man::new(command.clone());
    let mut bytes = Vec::new();
    page.render(&mut bytes)?;
    pages.push((page.get_filename(), bytes));
    command.get_subcommands().filter(|sub| !sub.is_hide_set()).try_for_each(|sub| add(sub, pages))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn each_command_has_a_page_and_hidden_ones_have_none() {
        let pages = pages().unwrap();
        let names: Vec<&str> = pages.iter().map(|(name, _)| name.as_str()).collect();
        for name in ["eddy.1", "eddy-render.1", "eddy-translate.1", "eddy-lab-stability.1"] {
            assert!(names.contains(&name), "{name} in {names:?}");
        }
        assert!(!names.iter().any(|name| name.contains("try-compile")), "{names:?}");
        let text = String::from_utf8(pages[0].1.clone()).unwrap();
        assert!(text.contains(".TH eddy 1") && text.contains("translate"));
    }

    #[test]
    fn completions_name_commands_and_options() {
        use clap_complete::Shell;
        for shell in [Shell::Bash, Shell::Zsh, Shell::Fish, Shell::PowerShell] {
            let mut script = Vec::new();
            clap_complete::generate(shell, &mut Cli::command(), "eddy", &mut script);
            let script = String::from_utf8(script).unwrap();
            for word in ["translate", "doctor", "glsl-version", "supersample"] {
                assert!(script.contains(word), "{shell}: {word}");
            }
        }
    }
}
