//! Sound passes: samples as computed by Shadertoy, inputs, files, and independence of the picture.

use crate::support::{gpu, program::Bench, *};
use eddy::{
    audio::{BINS, Limits, SAMPLE_RATE, Track, TrackSpectrum, decode},
    engine::{BLOCK_FRAMES, BuildError, BuildOptions, Builder, Engine, SOUND_BLOCKS, SOUND_FRAMES},
    gpu::Gpu,
    media::{self, MediaKey, MediaSet},
    project::{
        self, Channel, CustomUniformValue, Filter, Input, InputKind, Media, Pass, PassName, Project, Sampler, Wrap,
    },
};
use std::{f64::consts::TAU, sync::Arc};

/// 440 Hz on the left, 330 Hz at half the level on the right, with a phase that is exact at any time.
const TONES: &str = "float turn(int samp, int hertz) { return 6.28318530718 * float((samp % 44100) * hertz % 44100) / \
                     44100.0; }\nvec2 mainSound(int samp, float time) { return vec2(sin(turn(samp, 440)), \
                     0.5 * sin(turn(samp, 330))); }";
const SHOW: &str = "void mainImage(out vec4 o, in vec2 p) { o = vec4(p / iResolution.xy, fract(iTime), 1.0); }";

fn sound(code: &str, channels: [Option<Channel>; 4]) -> Project {
    project(vec![pass(PassName::sound(), code, channels), image(SHOW, Default::default())])
}

/// Returns a sound pass with this body.
fn samples_of(body: &str) -> String {
    format!("vec2 mainSound(int samp, float time) {{ {body} }}")
}

fn engine_of(gpu: &Gpu, project: &Project, media: &MediaSet) -> Engine {
    engine_with(gpu, project, media, &BuildOptions::sound(), (16, 16))
}

fn block(engine: &mut Engine, number: u32) -> Vec<[i16; 2]> {
    engine.draw_sound(number, [2026.0, 0.0, 9.0, 77.25], &mut || Some(64)).unwrap().expect("all rows are drawn")
}

/// Returns the 16-bit sample of a value. [`value`] is its inverse.
fn quantised(value: f64) -> i16 {
    (((0.5 + 0.5 * value) * 65536.0).floor() - 32767.0).clamp(-32767.0, 32767.0) as i16
}

fn value(sample: i16) -> f64 {
    (f64::from(sample) + 32767.0) / 65536.0 * 2.0 - 1.0
}

#[test]
fn samples_match_the_formula_across_blocks_and_to_the_end() {
    let Some(gpu) = gpu() else { return };
    let mut engine = engine_of(&gpu, &sound(TONES, Default::default()), &MediaSet::new());
    for number in [0, 1, SOUND_BLOCKS - 1] {
        let samples = block(&mut engine, number);
        assert_eq!(samples.len(), BLOCK_FRAMES as usize);
        for (n, got) in samples.iter().enumerate() {
            let n = number * BLOCK_FRAMES + n as u32;
            let tone = |hertz: f64| (TAU * (hertz * f64::from(n % 44_100) / 44_100.0)).sin();
            let wanted = [quantised(tone(440.0)), quantised(0.5 * tone(330.0))];
            for side in 0..2 {
                // A sine of 32-bit floats may round to the neighbouring step. For values of 1, see below.
                let is_near = (i32::from(got[side]) - i32::from(wanted[side])).abs() <= 1 || wanted[side] > 32_760;
                assert!(is_near, "sample {n}: {got:?}, not {wanted:?}");
            }
        }
    }
}

/// 1 is 65,536 in 17 bits: its high byte saturates, so it plays as 0.992, like everything above; values below -1 keep
/// their low byte (`shadertoy.md`, section 8).
#[test]
fn full_scale_and_beyond_are_as_on_shadertoy() {
    let Some(gpu) = gpu() else { return };
    let code = samples_of("float v[6] = float[](1.0, -1.0, 0.0, 0.999999, 1.5, -1.25); return vec2(v[samp % 6], 0.0);");
    let samples = block(&mut engine_of(&gpu, &sound(&code, Default::default()), &MediaSet::new()), 0);
    let left: Vec<i16> = samples[..6].iter().map(|sample| sample[0]).collect();
    assert_eq!(left, [32_513, -32_767, 1, 32_767, 32_513, -32_767]);
    assert!(samples.iter().all(|sample| sample[1] == 1), "0 is the 32,768th of 65,536 steps");
}

#[test]
fn time_and_uniforms_of_a_block_are_as_on_shadertoy() {
    let Some(gpu) = gpu() else { return };
    let code = samples_of(
        "return vec2(time / 256.0, samp % 2 == 0 ? float(iSampleOffset) / 8388608.0 : iTimeOffset / 256.0);",
    );
    let mut engine = engine_of(&gpu, &sound(&code, Default::default()), &MediaSet::new());
    for number in [0, 7, 30] {
        let samples = block(&mut engine, number);
        let (offset, start) = (number * BLOCK_FRAMES, (f64::from(number * BLOCK_FRAMES) / 44_100.0) as f32);
        for n in [0u32, 1, 777, BLOCK_FRAMES - 1] {
            let time = start + n as f32 / 44_100.0;
            let [left, right] = samples[n as usize].map(value);
            assert!((left - f64::from(time) / 256.0).abs() < 4e-5, "{number}, {n}: {left}");
            let wanted = if n % 2 == 0 { f64::from(offset) / 8_388_608.0 } else { f64::from(start) / 256.0 };
            assert!((right - wanted).abs() < 4e-5, "{number}, {n}: {right}, not {wanted}");
        }
    }
    let code = samples_of(
        "vec4 d = iDate / vec4(4096.0, 16.0, 32.0, 128.0); float v[6] = float[](d.x, d.y, d.z, d.w, iSampleRate / \
         65536.0, iChannelTime[0]); return vec2(v[samp % 6]);",
    );
    let samples = block(&mut engine_of(&gpu, &sound(&code, Default::default()), &MediaSet::new()), 0);
    // The seconds of the date are whole: the input is 77.25.
    let wanted = [2026.0 / 4096.0, 0.0, 9.0 / 32.0, 77.0 / 128.0, 44_100.0 / 65_536.0, 0.0];
    for (n, wanted) in wanted.into_iter().enumerate() {
        assert!((value(samples[n][0]) - wanted).abs() < 4e-5, "{n}: {}, not {wanted}", value(samples[n][0]));
    }
}

fn read(input: Input) -> Option<Channel> {
    Some(Channel { input, sampler: Sampler { filter: Filter::Nearest, wrap: Wrap::Repeat, vflip: false } })
}

fn builtin(kind: InputKind, name: &str) -> Input {
    Input::Media { kind, media: Media::Builtin(name.into()) }
}

#[test]
fn a_sound_pass_reads_textures_and_the_size_of_volumes() {
    let Some(gpu) = gpu() else { return };
    let (noise, volume) = (builtin(InputKind::Texture, "noise-rgba-64"), builtin(InputKind::Volume, "noise-grey-3d"));
    let channels = [read(noise), read(volume), read(Input::buffer("A")), read(Input::KEYBOARD)];
    let code = samples_of(
        "float t = texelFetch(iChannel0, ivec2(samp % 64, samp / 64 % 64), 0).x; float v[7] = float[](\
         iChannelResolution[0].y / 128.0, iChannelResolution[1].z / 128.0, texture(iChannel1, vec2(0.5)).w * 0.5, \
         texture(iChannel1, vec2(0.5)).x, texture(iChannel2, vec2(0.5)).w * 0.5, iChannelResolution[2].x, \
         texture(iChannel3, vec2(0.5)).w * 0.5); return vec2(t, v[samp % 7]);",
    );
    let project = sound(&code, channels);
    let (media, warnings) = media::gather(&project, None);
    assert!(warnings.is_empty(), "{warnings:?}");
    let advice: Vec<String> = project::advice(&project).into_iter().map(|warning| warning.message).collect();
    let about = |channel: &str| advice.iter().any(|message| message.starts_with(&format!("{channel} of Sound is")));
    assert!(!about("iChannel0") && about("iChannel1") && about("iChannel2") && about("iChannel3"), "{advice:?}");
    let samples = block(&mut engine_of(&gpu, &project, &media), 0);
    let key = MediaKey::of_channel(project.passes[0].bindings.get(0).unwrap()).unwrap();
    let texels = &media.get(&key).unwrap().bytes;
    for n in 0..4096usize {
        let wanted = quantised(f64::from(texels[4 * n]) / 255.0);
        let got = samples[n][0];
        assert!(wanted > 32_760 || (i32::from(got) - i32::from(wanted)).abs() <= 1, "{n}: {got}, not {wanted}");
    }
    // Other channels read as an empty one: opaque black, of size 0.
    for (n, wanted) in [0.5, 0.25, 0.5, 0.0, 0.5, 0.0, 0.5].into_iter().enumerate() {
        assert!((value(samples[n][1]) - wanted).abs() < 4e-5, "{n}: {}, not {wanted}", value(samples[n][1]));
    }
}

/// In a sound pass, a channel with a volume is a `sampler2D`, not a `sampler3D`.
#[test]
fn a_volume_is_a_sampler2d_in_a_sound_pass() {
    let Some(gpu) = gpu() else { return };
    let volume = read(builtin(InputKind::Volume, "noise-grey-3d"));
    let code = samples_of("return texture(iChannel0, vec3(time)).xy;");
    let project = sound(&code, [volume, None, None, None]);
    assert!(errors(&gpu, &project).iter().any(|error| error.contains("sampler2D")), "{:?}", errors(&gpu, &project));
}

fn errors(gpu: &Gpu, project: &Project) -> Vec<String> {
    match Builder::new(gpu.clone()).build(project, &MediaSet::new(), &BuildOptions::sound()) {
        Ok(_) => Vec::new(),
        Err(BuildError::Diagnostics { diagnostics, .. }) => diagnostics
            .into_iter()
            .filter(|d| d.is_error())
            .map(|d| format!("{}; {}", d.message, d.hints.join("; ")))
            .collect(),
        Err(other) => panic!("{other}"),
    }
}

#[test]
fn the_old_form_gets_a_hint_and_other_passes_do_not_matter() {
    let Some(gpu) = gpu() else { return };
    let old = sound("vec2 mainSound(float time) { return vec2(sin(time)); }", Default::default());
    let found = errors(&gpu, &old);
    assert!(found.len() == 1 && found[0].contains("vec2 mainSound(int samp, float time)"), "{found:?}");
    let mut broken = sound(TONES, Default::default());
    broken.passes[1].source.text = "void mainImage(out vec4 o, in vec2 p) { o = nothing; }".into();
    assert_eq!(errors(&gpu, &broken), Vec::<String>::new());
}

#[test]
fn sound_passes_do_not_change_the_picture() {
    let Some(gpu) = gpu() else { return };
    let picture = |project: &Project, skip: bool| {
        let options = BuildOptions { skip, ..BuildOptions::default() };
        let mut engine = engine_with(&gpu, project, &MediaSet::new(), &options, (64, 32));
        run(&mut engine, 0, 5);
        engine.read_image().unwrap().texels
    };
    let alone = picture(&project(vec![image(SHOW, Default::default())]), true);
    for code in [TONES, "vec2 mainSound(int samp, float time) { return nothing; }"] {
        for skip in [true, false] {
            assert!(picture(&sound(code, Default::default()), skip) == alone, "{code}, skip: {skip}");
        }
    }
}

#[test]
fn a_cancelled_block_does_not_affect_the_next() {
    let Some(gpu) = gpu() else { return };
    let mut engine = engine_of(&gpu, &sound(TONES, Default::default()), &MediaSet::new());
    let whole = block(&mut engine, 3);
    let mut bands = 0;
    let cancelled = engine.draw_sound(4, [0.0; 4], &mut || {
        bands += 1;
        (bands < 4).then_some(10)
    });
    assert!(cancelled.unwrap().is_none());
    assert!(block(&mut engine, 3) == whole);
    // For any division into bands.
    let mut rows = 0;
    let cut = engine.draw_sound(3, [0.0; 4], &mut || {
        rows += 7;
        Some(rows)
    });
    assert!(cut.unwrap().unwrap() == whole);
}

#[test]
fn programs_with_the_same_sound_are_recognised() {
    let Some(gpu) = gpu() else { return };
    let mut builder = Builder::new(gpu.clone());
    let code = format!("#iUniform float level = 0.5 in {{0.0, 1.0}}\n{}", samples_of("return vec2(level);"));
    let show = format!("#iUniform float tint = 0.5 in {{0.0, 1.0}}\n{}", SHOW.replace("o = vec4(", "o = tint * vec4("));
    let first = project(vec![pass(PassName::sound(), &code, Default::default()), image(&show, Default::default())]);
    let mut build = |edit: &dyn Fn(&mut Project)| {
        let mut project = first.clone();
        edit(&mut project);
        let (media, _) = media::gather(&project, None);
        builder.build(&project, &media, &BuildOptions::sound()).unwrap_or_else(|e| panic!("{e:?}")).program
    };
    let before = build(&|_| {});
    let edit = |from: &'static str, to: &'static str| {
        move |project: &mut Project| {
            project.passes[0].source.text = project.passes[0].source.text.replace(from, to).into()
        }
    };
    let turn = |name: &'static str| {
        move |project: &mut Project| {
            project.custom_uniform_values.insert(name.into(), CustomUniformValue::Float(0.75));
        }
    };
    assert!(before.makes_same_sound(&build(&|_| {})));
    assert!(before.makes_same_sound(&build(&edit("return", "/* a comment */ return"))));
    assert!(before.makes_same_sound(&build(&turn("tint"))));
    assert!(before.makes_same_sound(&build(&|project| project.passes[1].source.text = "nothing".into())));
    assert!(!before.makes_same_sound(&build(&turn("level"))));
    assert!(!before.makes_same_sound(&build(&edit("vec2(level)", "vec2(-level)"))));
}

#[test]
fn a_tone_peaks_at_its_bin_and_all_is_silent_after_the_end() {
    let Some(gpu) = gpu() else { return };
    // Louder tones fill several bins.
    let quiet = TONES.replace("vec2(sin", "0.02 * vec2(sin");
    let mut engine = engine_of(&gpu, &sound(&quiet, Default::default()), &MediaSet::new());
    let track = Arc::new(Track::new(SOUND_FRAMES as usize, BLOCK_FRAMES as usize));
    let last = SOUND_BLOCKS - 1;
    for number in [0, last] {
        track.write(number as usize, block(&mut engine, number));
    }
    let mut spectrum = TrackSpectrum::default();
    let texture = spectrum.at(&track, 44_100 * 2);
    let peak = (0..BINS).max_by_key(|bin| texture[*bin]).unwrap();
    // 440 Hz is twice as loud as 330 Hz. A bin is 21.5 Hz.
    assert_eq!(peak, 20, "440 Hz is in bin 20.4");
    let end = i64::from(SOUND_FRAMES);
    assert_ne!(track.frame(end - 10), Some([0, 0]));
    assert_eq!([end, end + 1, end + 44_100].map(|n| track.frame(n)), [Some([0, 0]); 3]);
}

fn write_project(b: &Bench, code: &str) {
    b.write("p/image.glsl", SHOW);
    b.write("p/sound.glsl", code);
}

#[test]
fn a_sound_file_has_the_samples_and_is_reproducible() {
    let Some(_) = gpu() else { return };
    let b = Bench::new();
    write_project(&b, TONES);
    let run = b.line("render p --pass sound --secs 6.5 --out a.wav").expect(0);
    assert!(run.out.contains("6.5 s of sound") && run.out.contains("a.wav"), "{}", run.out);
    let file = b.bytes("a.wav");
    assert_eq!((file.len(), &file[..4]), (44 + 4 * 286_650, &b"RIFF"[..]));
    let sample = |n: usize| i16::from_le_bytes(file[44 + 2 * n..][..2].try_into().unwrap());
    // A quarter of a period of 440 Hz is 25.06 samples; of 330 Hz it is 33.4. 6 s is in the second block.
    assert_eq!([sample(0), sample(1)], [1, 1]);
    for (n, hertz, side, level) in
        [(25, 440.0, 0, 1.0), (33, 330.0, 1, 0.5), (265_000, 440.0, 0, 1.0), (286_649, 330.0, 1, 0.5)]
    {
        let wanted = quantised(level * (TAU * hertz * f64::from(n % 44_100) / 44_100.0).sin());
        let got = sample(2 * n as usize + side);
        assert!((i32::from(got) - i32::from(wanted)).abs() <= 1, "{n}: {got}, not {wanted}");
    }
    b.line("render p --pass sound --secs 6.5 --out b.wav").expect(0);
    assert!(b.bytes("b.wav") == file);
    b.line("render p --pass sound --secs 6.5 --out a.flac").expect(0);
    let flac = b.bytes("a.flac");
    assert!(flac.len() < file.len());
    let decoded = |bytes: Vec<u8>| decode(bytes.into(), None, &Limits::default()).unwrap().frames;
    assert!(decoded(flac) == decoded(file.clone()));
    // Into a folder, with a line of JSON.
    let run = b.line("render p --pass sound --secs 1 --out o --json").expect(0);
    let line = &run.json()[0];
    assert_eq!((&line["status"], &line["sound"]["samples"]), (&"ok".into(), &44_100.into()), "{line}");
    assert_eq!(b.names("o"), ["p.wav"]);
    assert!(b.bytes("o/p.wav")[44..] == file[44..44 + 4 * 44_100]);
}

#[test]
fn sound_errors_are_reported_and_write_no_file() {
    let Some(_) = gpu() else { return };
    let b = Bench::new();
    b.image("quiet.glsl", "fragColor = vec4(1.0);");
    let run = b.line("render quiet.glsl --pass sound --out a.wav").expect(2);
    assert!(run.err.contains("there is no pass sound"), "{}", run.err);
    write_project(&b, "vec2 mainSound(float time) { return vec2(sin(time)); }");
    let run = b.line("render p --pass sound --out a.wav").expect(1);
    assert!(
        run.err.contains("vec2 mainSound(int samp, float time)") && run.err.contains("sound.glsl:1"),
        "{}",
        run.err
    );
    b.line("check p").expect(1);
    b.line("render p --size 8x8 --out p.png").expect(0);
    assert!(b.line("render p --pass sound --out a.png").expect(2).err.contains(".wav or .flac"));
    assert!(b.line("render p --out a.wav").expect(2).err.contains("--pass sound"));
    let run = b.line("probe p --pass sound --pixel 1,1 --at 1:1").code;
    assert_ne!(run, Some(0));
    assert_eq!(b.names("."), ["p", "p.png", "quiet.glsl"]);
}

#[test]
fn a_slow_sound_ends_with_an_error_and_the_picture_is_drawn() {
    let Some(_) = gpu() else { return };
    let b = Bench::new();
    write_project(
        &b,
        &samples_of(
            "float a = time; for (int i = 0; i < 100000000; i++) a = fract(sin(a) * 43758.5 + float(i & 1)); return vec2(a);",
        ),
    );
    let run = b.line("render p --pass sound --out a.wav --frame-timeout 0.5").expect(2);
    assert!(run.err.contains("block 0 of the sound pass") && run.err.contains("--frame-timeout"), "{}", run.err);
    b.line("render p --size 8x8 --out p.png --frame-timeout 20").expect(0);
    assert_eq!(b.names("."), ["p", "p.png"]);
}

/// A project with a sound pass is exported to Shadertoy's JSON and imported again.
#[test]
fn a_sound_pass_survives_export_and_import() {
    let b = Bench::new();
    write_project(&b, TONES);
    b.line("export p --out p.json").expect(0);
    let json: serde_json::Value = serde_json::from_slice(&b.bytes("p.json")).unwrap();
    let passes = json["renderpass"].as_array().or_else(|| json["Shader"]["renderpass"].as_array()).unwrap();
    let kind = |pass: &serde_json::Value| pass["type"].as_str().unwrap().to_owned();
    let sound = passes.iter().find(|pass| kind(pass) == "sound").expect("a sound pass");
    assert_eq!(sound["outputs"][0]["id"], "XsfGRr");
    b.line("import p.json --out q").expect(0);
    assert_eq!(String::from_utf8(b.bytes("q/sound.glsl")).unwrap().trim(), TONES.trim());
}

#[test]
fn the_sample_rate_is_the_same_everywhere() {
    assert_eq!(SOUND_FRAMES, 180 * SAMPLE_RATE);
    let _: Pass = pass(PassName::sound(), TONES, Default::default());
}
