//! Sound on a real server: a PulseAudio of the test's own with a sink that nobody hears, whose monitor is recorded and
//! compared with the file.
//!
//! The session that plays runs in another process, this program once more: what it opens is chosen by its environment.

use crate::support::{gpu, skipped, stage::Stage};
use eddy::{
    audio::device::Machine,
    session::{CanvasCommand, Command as Ask, FileCommand, SessionOptions},
};
use std::{
    fs,
    io::{BufRead, BufReader, Read},
    path::{Path, PathBuf},
    process::{Child, Command, Stdio},
    sync::Arc,
    time::{Duration, Instant, SystemTime, UNIX_EPOCH},
};

const RATE: f64 = 44_100.0;
/// Samples of a tooth of the left channel, which says where in the file it is; the right channel says which tooth.
const TOOTH: usize = 2000;
/// The folder of the project, for the process that plays it.
const PLAYS: &str = "EDDY_TEST_PLAYS";
const SECONDS: &str = "EDDY_TEST_SECONDS";

fn unix() -> f64 {
    SystemTime::now().duration_since(UNIX_EPOCH).unwrap().as_secs_f64()
}

/// Ends a process that the test has started.
struct Server(Child);

impl Drop for Server {
    fn drop(&mut self) {
        let _ = self.0.kill();
        let _ = self.0.wait();
    }
}

fn is_installed(program: &str) -> bool {
    Command::new(program).arg("--version").stdout(Stdio::null()).stderr(Stdio::null()).status().is_ok()
}

/// The environment in which ALSA's default device is the server's.
fn environment(home: &Path) -> Vec<(&'static str, PathBuf)> {
    let config = home.join("asound.conf");
    let text = "</usr/share/alsa/alsa.conf>\npcm.!default { type pulse }\nctl.!default { type pulse }\n";
    fs::write(&config, text).unwrap();
    let run = home.join("run");
    vec![
        ("XDG_RUNTIME_DIR", run.clone()),
        ("HOME", home.to_owned()),
        ("PULSE_SERVER", PathBuf::from(format!("unix:{}", run.join("pulse/native").display()))),
        ("ALSA_CONFIG_PATH", config),
    ]
}

fn has_alsa_plugin() -> bool {
    let folders = fs::read_dir("/usr/lib").into_iter().flatten().flatten().map(|entry| entry.path());
    folders.chain([PathBuf::from("/usr/lib")]).any(|f| f.join("alsa-lib/libasound_module_pcm_pulse.so").exists())
}

/// A file whose every sample says where it is.
fn numbered_wav(seconds: usize) -> Vec<u8> {
    let count = (seconds * 44_100) as u32;
    let mut file = b"RIFF".to_vec();
    file.extend((36 + 4 * count).to_le_bytes());
    file.extend(b"WAVEfmt \x10\0\0\0\x01\0\x02\0");
    file.extend(44_100u32.to_le_bytes());
    file.extend(176_400u32.to_le_bytes());
    file.extend(b"\x04\0\x10\0data");
    file.extend((4 * count).to_le_bytes());
    for n in 0..count as usize {
        file.extend((((n % TOOTH) as i16 - 1000) * 10).to_le_bytes());
        file.extend((((n / TOOTH) % 300) as i16 * 100 - 15_000).to_le_bytes());
    }
    file
}

/// The position in the file that two neighbouring frames tell, in samples; none near an edge, or where it is silent.
fn place(frame: [i16; 2], before: [i16; 2]) -> Option<f64> {
    let within = f64::from(frame[0]) / 10.0 + 1000.0;
    let is_whole = (f64::from(frame[0]) - f64::from(before[0]) - 10.0).abs() < 5.0;
    let tooth = (f64::from(frame[1]) + 15_000.0) / 100.0;
    let is_near = (tooth - tooth.round()).abs() < 0.2 && (300.0..1700.0).contains(&within);
    (is_whole && is_near).then_some(tooth.round() * TOOTH as f64 + within)
}

/// Plays in this process if it was started for that: see [`played_in_step`].
#[test]
fn plays() {
    let Some(folder) = std::env::var_os(PLAYS) else { return };
    let seconds: f64 = std::env::var(SECONDS).unwrap().parse().unwrap();
    let gpu = gpu().expect("the parent has looked for one");
    let mut stage = Stage::with_options(gpu, |_| SessionOptions {
        audio: Some(Arc::new(Machine)),
        draws_on_thread: true,
        frame_limit: Duration::from_secs(60),
        ..SessionOptions::default()
    });
    stage.session.apply(CanvasCommand::SetFixedSize(Some((256, 144))));
    stage.session.apply(FileCommand::Open(folder.to_str().unwrap().into()));
    stage.until_compiled();
    let end = Instant::now() + Duration::from_secs_f64(seconds);
    let (mut frames, mut newest) = (0, None);
    while Instant::now() < end {
        if stage.tick().frame_drawn {
            frames += 1;
        }
        for notice in stage.session.notices().iter().filter(|notice| newest < Some(notice.id)) {
            println!("NOTICE {} {}", unix(), notice.text);
        }
        newest = stage.session.notices().last().map(|notice| notice.id).max(newest);
        let transport = stage.session.transport();
        let (behind, jumps, underruns) = stage.session.sound_health().unwrap_or_default();
        println!("PLAYED {} {} {frames} {behind} {jumps} {underruns}", unix(), transport.time_secs);
        std::thread::sleep(Duration::from_millis(20));
    }
}

/// Holds what the process that plays has said of a moment.
#[derive(Clone, Copy, Debug)]
struct Said {
    at: f64,
    time: f64,
    frames: u32,
    jumps: u32,
    underruns: u32,
}

fn played_in_step(seconds: u32) {
    if gpu().is_none() {
        return;
    }
    if !is_installed("pulseaudio") || !is_installed("parec") || !has_alsa_plugin() {
        return skipped("pulseaudio, pulseaudio-utils and libasound2-plugins are needed");
    }
    let home = tempfile::tempdir().unwrap();
    let environment = environment(home.path());
    let run = home.path().join("run");
    fs::create_dir(&run).unwrap();
    let sink = "--load=module-null-sink sink_name=nowhere rate=44100";
    let socket =
        format!("--load=module-native-protocol-unix auth-anonymous=1 socket={}", run.join("pulse/native").display());
    fs::create_dir(run.join("pulse")).unwrap();
    let start = ["-n", "--daemonize=no", "--exit-idle-time=-1", "--use-pid-file=no", sink, &socket];
    let server =
        Command::new("pulseaudio").args(start).envs(environment.clone()).stderr(Stdio::null()).spawn().unwrap();
    let _server = Server(server);
    let end = Instant::now() + Duration::from_secs(10);
    while !run.join("pulse/native").exists() {
        assert!(Instant::now() < end, "the server has started");
        std::thread::sleep(Duration::from_millis(20));
    }

    let project = home.path().join("project");
    fs::create_dir(&project).unwrap();
    fs::write(project.join("song.wav"), numbered_wav(20)).unwrap();
    fs::write(project.join("eddy.toml"), "[passes.image]\nchannels.0 = { file = \"song.wav\", kind = \"music\" }\n")
        .unwrap();
    // About two frames a second by software on two cores.
    let slow = "void mainImage(out vec4 o, in vec2 p) {\n    float x = texture(iChannel0, p).x;\n    \
                for (int i = 0; i < 1500; ++i) x = sin(x + float(i) + iTime);\n    o = vec4(x);\n}\n";
    fs::write(project.join("image.glsl"), slow).unwrap();

    let record =
        ["--device=nowhere.monitor", "--format=s16le", "--rate=44100", "--channels=2", "--latency-msec=10", "--raw"];
    let mut recorder =
        Command::new("parec").args(record).envs(environment.clone()).stdout(Stdio::piped()).spawn().unwrap();
    let mut recorded = recorder.stdout.take().unwrap();
    let _recorder = Server(recorder);
    // Each with the moment at which it came.
    let listener = std::thread::spawn(move || {
        let (mut heard, mut bytes) = (Vec::new(), [0; 1764]);
        while recorded.read_exact(&mut bytes).is_ok() {
            heard.push((unix(), bytes));
        }
        heard
    });

    let mut player = Command::new(std::env::current_exe().unwrap())
        .args(["--exact", "sound_server::plays", "--nocapture", "--test-threads=1"])
        .envs(environment)
        .env(PLAYS, &project)
        .env(SECONDS, seconds.to_string())
        .stdout(Stdio::piped())
        .spawn()
        .unwrap();
    let lines = BufReader::new(player.stdout.take().unwrap()).lines().map_while(Result::ok);
    let mut said: Vec<Said> = Vec::new();
    let mut notices = String::new();
    for line in lines {
        let parts: Vec<&str> = line.split(' ').collect();
        if let ["PLAYED", at, time, frames, _, jumps, underruns] = parts[..] {
            let (at, time) = (at.parse().unwrap(), time.parse().unwrap());
            let [frames, jumps, underruns] = [frames, jumps, underruns].map(|n| n.parse().unwrap());
            said.push(Said { at, time, frames, jumps, underruns });
        } else if line.contains("NOTICE") {
            notices += &format!("{line}\n");
        }
    }
    assert!(player.wait().unwrap().success());
    drop(_recorder);
    drop(_server);
    let heard = listener.join().unwrap();

    // `iTime` over the clock: the earliest moment that any of it was said at lies on its line.
    let start =
        said.iter().filter(|said| said.time > 0.0).map(|said| said.at - said.time).fold(f64::INFINITY, f64::min);
    assert!(start.is_finite(), "nothing was drawn; {notices}");
    let mut offsets: Vec<(f64, f64)> = Vec::new();
    for (at, bytes) in &heard {
        let frames: Vec<[i16; 2]> = bytes
            .chunks_exact(4)
            .map(|b| [i16::from_le_bytes([b[0], b[1]]), i16::from_le_bytes([b[2], b[3]])])
            .collect();
        let last = frames.len() - 1;
        if let Some(place) = place(frames[last], frames[last - 1]) {
            // The file has 20 seconds, 441 teeth, of which the right channel tells 300.
            let length = 300.0 * TOOTH as f64 / RATE;
            let time = (at - start).rem_euclid(20.0).rem_euclid(length);
            let offset = place / RATE - time;
            offsets.push((at - start, offset - length * (offset / length).round()));
        }
    }
    let settled: Vec<(f64, f64)> = offsets.into_iter().filter(|(at, _)| *at > 1.5).collect();
    assert!(settled.len() > 10 * seconds as usize, "{} places; {notices}", settled.len());
    let median = |part: &[(f64, f64)]| {
        let mut all: Vec<f64> = part.iter().map(|(_, offset)| *offset).collect();
        all.sort_by(f64::total_cmp);
        all[all.len() / 2]
    };
    let (first, last) = (median(&settled[..settled.len() / 4]), median(&settled[3 * settled.len() / 4..]));
    let after = |secs: f64| said.iter().find(|said| said.at - start > secs).copied().unwrap();
    let (early, end) = (after(1.5), *said.last().unwrap());
    let fps = f64::from(end.frames - early.frames) / (end.at - early.at);
    let report = format!(
        "offset {:.1} ms at first, {:.1} ms at last, {fps:.1} frames a second, jumps {} and {}, underruns {} and {}; {notices}",
        1e3 * first,
        1e3 * last,
        early.jumps,
        end.jumps,
        early.underruns,
        end.underruns
    );
    println!("{report}");
    // Where more wants to run than there are processors, a thread of no priority may wait for longer than a buffer.
    let load = fs::read_to_string("/proc/loadavg").unwrap_or_default();
    let load: f64 = load.split(' ').next().and_then(|load| load.parse().ok()).unwrap_or(0.0);
    let processors = std::thread::available_parallelism().map_or(1, usize::from);
    // The picture alone takes all of them.
    let most = if load > 1.5 * processors as f64 { 1 + seconds / 10 } else { 0 };
    assert!(end.underruns - early.underruns <= most, "load {load}: {report}");
    assert!((first - last).abs() < 0.02, "it drifts: {report}");
    assert!(first.abs() < 0.02 && last.abs() < 0.02, "{report}");
}

#[test]
fn eight_seconds_are_in_step_with_a_slow_picture() {
    played_in_step(8);
}

#[test]
#[ignore = "takes a minute of real time"]
fn a_minute_is_in_step_with_a_slow_picture() {
    played_in_step(60);
}
