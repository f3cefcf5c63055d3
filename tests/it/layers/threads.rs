//! Threads are started by `eddy-background`; other code may start one only if its work is not a job whose end its
//! owner waits for.

use super::{source_texts, sources_of_eddy};
use std::collections::BTreeMap;

/// Files that start threads, and why their work is not a job of a `Background`.
const STARTED_BY_HAND: &[(&str, &str)] = &[
    ("audio/decode/mod.rs", "its caller waits for it, with a time limit"),
    ("audio/keeper.rs", "it owns a device"),
    ("background/lib.rs", "it is the thread of a `Background`"),
    ("cli/mod.rs", "it is the program, with a larger stack"),
    ("control/midi/inputs.rs", "it waits for devices"),
    ("control/osc/socket.rs", "it waits for a socket"),
    ("control/pads/inputs.rs", "it waits for devices"),
    ("film/queue/mod.rs", "every picture counts, and the queue is bounded"),
    ("gpu/loss.rs", "its caller waits for it, with a time limit"),
    ("gui/system_theme.rs", "it waits for the desktop"),
    ("gui/termination.rs", "it waits for signals"),
    ("gui/thumbnails/live.rs", "it draws until the gallery closes, with a larger stack"),
    ("gui/thumbnails/mod.rs", "every picture counts, the newest first"),
    ("lsp/reading.rs", "its caller waits for it, with a time limit and a larger stack"),
    ("lsp/transport.rs", "it waits for a pipe"),
    ("playback/offline.rs", "every frame counts, and the queue is bounded"),
    ("playback/trial.rs", "it watches over a process until that ends"),
    ("session/drawing/render_thread.rs", "it owns the device that draws"),
    ("session/recovery/keeper.rs", "every order counts, and it waits for the disk"),
    ("video/camera.rs", "it waits for a device"),
    ("video/ffmpeg.rs", "it waits for a pipe"),
    ("video/process.rs", "it waits for a pipe"),
    ("video/reader.rs", "every frame counts, and the queue is bounded"),
];

/// Returns how often code outside tests starts a thread. Threads of a scope end with the call and are not counted.
fn started(text: &str) -> usize {
    let code = text.split("#[cfg(test)]\nmod tests").next().unwrap_or_default();
    let code = code.lines().filter(|line| !line.trim_start().starts_with("//"));
    code.filter(|line| line.contains("thread::spawn(") || line.contains("Builder::new().name(")).count()
}

#[test]
fn threads_are_started_only_in_listed_files() {
    let texts = source_texts(&sources_of_eddy());
    let files = texts.iter().filter(|(path, _)| !path.ends_with("tests.rs") && !path.contains("/tests/"));
    let found: BTreeMap<&str, usize> =
        files.map(|(path, text)| (path.as_str(), started(text))).filter(|(_, count)| *count > 0).collect();
    let listed: Vec<&str> = STARTED_BY_HAND.iter().map(|(path, _)| *path).collect();
    assert_eq!(found.keys().copied().collect::<Vec<_>>(), listed, "use a `Background`, or add the reason to the list");
}

#[test]
fn started_threads_are_counted() {
    assert_eq!(started("fn f() { std::thread::spawn(g); }"), 1);
    assert_eq!(started("let t = Builder::new().name(\"x\".into()).spawn(g)?;\nthread::spawn(h);"), 2);
    assert_eq!(started("// thread::spawn(g)\n#[cfg(test)]\nmod tests { fn f() { thread::spawn(g); } }"), 0);
    assert_eq!(started("thread::scope(|scope| scope.spawn(g));"), 0);
}
