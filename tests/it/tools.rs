//! `eddy doctor`, panic reports, manual pages and completions of the built program.

use crate::support::{
    program::{Bench, run},
    programs::{failure, has},
};
use std::process::Command;

#[test]
fn manual_pages_are_well_formed_and_not_overwritten() {
    let b = Bench::new();
    b.line("man --out pages").expect(0);
    let names = b.names("pages");
    assert!(names.contains(&"eddy.1".into()) && names.contains(&"eddy-translate.1".into()), "{names:?}");
    b.write("pages/eddy.1", "mine");
    let refused = b.line("man --out pages").expect(2);
    assert!(refused.err.contains("--force"), "{}", refused.err);
    b.line("man --out pages --force").expect(0);
    if !has("man") {
        return;
    }
    for name in b.names("pages") {
        let mut man = Command::new("man");
        man.args(["--warnings", "-E", "UTF-8", "-l", "-Tutf8", "-Z"]).arg(b.path(format!("pages/{name}")));
        let man = run(man.env("MANROFFSEQ", "").env("MANWIDTH", "80").env("LC_ALL", "C.UTF-8"));
        assert_eq!((man.code, man.err.as_str()), (Some(0), ""), "{name}");
    }
}

#[test]
fn completions_are_valid_shell_scripts() {
    let b = Bench::new();
    for (shell, check) in [("bash", &["-n"][..]), ("zsh", &["-n"]), ("fish", &["--no-execute"])] {
        b.write(shell, b.line(&format!("completions {shell}")).expect(0).out);
        if !has(shell) {
            continue;
        }
        let errors = failure(Command::new(shell).args(check).arg(b.path(shell)));
        assert_eq!(errors, None, "{shell}");
    }
    let script = b.line("completions powershell").expect(0).out;
    assert!(script.contains("Register-ArgumentCompleter") && script.contains("'translate'"));
    assert!(b.line("completions tcsh").expect(2).err.contains("powershell"));
}

/// The script runs with stubs in place of `scripts/setup` and cargo.
#[cfg(unix)]
#[test]
fn every_command_works_through_the_run_script() {
    use std::os::unix::fs::PermissionsExt;
    let b = Bench::new();
    b.line("man --out pages").expect(0);
    let pages = b.names("pages").into_iter();
    let commands = pages.filter_map(|page| page.strip_prefix("eddy-")?.strip_suffix(".1").map(str::to_owned));
    // The page of a subcommand has one more part.
    let commands: Vec<String> = commands.filter(|name| !name.contains('-')).chain(["help".into()]).collect();
    assert!(commands.len() > 10 && commands.contains(&"doctor".to_owned()), "{commands:?}");
    b.write("scripts/run", std::fs::read(concat!(env!("CARGO_MANIFEST_DIR"), "/scripts/run")).unwrap());
    let nothing = ["want_compiler", "want_graphics", "want_window", "install_missing", "need_rust", "say"];
    b.write("scripts/setup", nothing.map(|name| format!("{name}() {{ :; }}\n")).concat());
    let eddy = env!("CARGO_BIN_EXE_eddy");
    let cargo = format!(
        "#!/bin/sh\n[ \"$1\" = run ] || exit 0\nwhile [ \"$1\" != -- ]; do shift; done\nshift\n\
         [ \"$*\" != help ] || exec '{eddy}' help\necho \"$@\"\n"
    );
    b.write("bin/cargo", cargo);
    std::fs::set_permissions(b.path("bin/cargo"), PermissionsExt::from_mode(0o755)).unwrap();
    let script = |arguments: &[&str]| {
        let mut script = Command::new("sh");
        let path = format!("{}:{}", b.path("bin").display(), std::env::var("PATH").unwrap());
        script.current_dir(b.path(".")).arg("scripts/run").args(arguments).env("PATH", path);
        run(script.env_remove("DISPLAY").env_remove("WAYLAND_DISPLAY")).expect(0).out
    };
    for command in &commands {
        assert_eq!(script(&[command, "x"]).trim(), format!("{command} x"));
    }
    assert_eq!(script(&["--version"]).trim(), "--version");
    // A project is not a command: without a display its pictures are drawn.
    assert!(script(&["my-project"]).starts_with("render my-project --size"));
}

#[test]
fn bash_completes_a_command() {
    if !has("bash") {
        return;
    }
    let b = Bench::new();
    b.write("eddy.bash", b.line("completions bash").expect(0).out);
    let words =
        "source ./eddy.bash; COMP_WORDS=(eddy transl); COMP_CWORD=1; _eddy eddy transl eddy; echo \"${COMPREPLY[@]}\"";
    let mut bash = Command::new("bash");
    bash.current_dir(b.path(".")).args(["--norc", "-c", words]);
    assert_eq!(run(&mut bash).out.trim(), "translate");
}

#[test]
fn doctor_describes_the_machine_without_personal_data() {
    let b = Bench::new();
    let home = b.path(".").canonicalize().unwrap();
    let doctor = |line: &str| {
        let mut command = b.command();
        command.args(line.split(' ')).env("HOME", &home).env_remove("XDG_CONFIG_HOME").env_remove("XDG_STATE_HOME");
        run(&mut command)
    };
    let text = doctor("doctor");
    for part in ["Eddy", "Device", "Adapters", "Fonts", "ffmpeg", "Folders", "settings", "~/.config/eddy", "libraries"]
    {
        assert!(text.out.contains(part), "{part}\n{}", text.out);
    }
    let json = doctor("doctor --json");
    assert_eq!(json.code, text.code);
    let object = &json.json()[0];
    assert_eq!(object["build"]["eddy"], env!("CARGO_PKG_VERSION"));
    let has_device = object["device"]["missing"].is_null();
    assert_eq!(json.code, Some(if has_device { 0 } else { 2 }));
    if has_device {
        let limit = object["device"]["limits"]["max_texture_dimension_2d"].as_u64();
        assert!(limit.is_some_and(|limit| limit >= 2048), "{object}");
        assert!(!object["adapters"].as_array().unwrap().is_empty());
    }
    let home = home.to_str().unwrap();
    assert!(!text.out.contains(home) && !json.out.contains(home), "{}", text.out);
    for folder in [".config/eddy", ".cache/eddy", ".local/state/eddy"] {
        assert!(!b.path(folder).exists(), "{folder} was created");
    }
}

#[test]
fn a_panic_writes_a_report_and_prints_its_path() {
    let b = Bench::new();
    let home = b.path(".").canonicalize().unwrap();
    let mut command = b.command();
    command.args(["doctor", "--panic"]).env("HOME", &home).env("XDG_STATE_HOME", home.join("state"));
    let done = run(&mut command);
    assert_eq!(done.code, Some(2), "{}", done.err);
    assert!(done.err.contains("~/state/eddy/reports/panic-"), "{}", done.err);
    let names = b.names("state/eddy/reports");
    let [name] = &names[..] else { panic!("{names:?}") };
    let text = String::from_utf8(b.bytes(&format!("state/eddy/reports/{name}"))).unwrap();
    for part in ["`eddy doctor --panic` was called", "Command: eddy doctor", "src/cli/doctor/mod.rs:", "Backtrace:"] {
        assert!(text.contains(part), "{part}\n{text}");
    }
    assert!(text.contains(&format!("eddy {}", env!("CARGO_PKG_VERSION"))));
    assert!(!text.contains(home.to_str().unwrap()), "{text}");
}
