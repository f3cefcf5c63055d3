use super::*;
use crate::script::{parse_keys, parse_mouse};
use eddy_engine::{FrameInputs, Pixels};
use eddy_project::{Channel, Input, Pass, Source};

fn project() -> Project {
    let source = |text: &str| Source {
        name: "image.glsl".into(),
        path: Some("/home/somebody/waves/image.glsl".into()),
        text: text.into(),
    };
    let mut image =
        Pass::new(PassName::image(), source("void mainImage(out vec4 o, in vec2 p) { o = vec4(p, iTime, 1.0); }"));
    image.bindings.set(0, Some(Channel::new(Input::texture(Media::Picked("/home/somebody/cat.png".into())))));
    image.bindings.set(1, Some(Channel::new(Input::texture(Media::File("own.png".into())))));
    let place = Origin::Folder { path: "/home/somebody/waves".into(), has_manifest: true };
    Project::new("waves", vec![image], place)
}

fn scripted() -> ScriptedInputs {
    ScriptedInputs::new(59.94)
        .with_mouse(parse_mouse("0:down 40,40; 4:move 80.5,45; 10:up").unwrap())
        .with_keys(parse_keys("2:down 32; 3:up 32").unwrap())
        .with_date(Some(crate::date::parse("2026-03-04T05:06:07").unwrap()))
}

fn scene() -> Scene {
    Scene {
        eddy: "1.2.3".into(),
        device: "a device".into(),
        pass: PassName::image(),
        frame: 12,
        size: (4, 3),
        project: project(),
        inputs: SceneInputs::Script(scripted().script().unwrap()),
    }
}

fn png() -> Vec<u8> {
    let pixels = Pixels { width: 4, height: 3, texels: vec![[0.5; 4]; 12] };
    let mut out = Vec::new();
    crate::capture::encode(&mut out, &pixels, crate::capture::Format::Png).unwrap();
    out
}

fn read(png: &[u8]) -> Result<Scene, SceneError> {
    Scene::of_file(png, Path::new("a.png"))
}

#[test]
fn scene_round_trips_without_paths_of_the_machine() {
    let file = scene().embed(png()).unwrap();
    let back = read(&file).unwrap();
    assert_eq!((back.frame, back.size, &back.device), (12, (4, 3), &"a device".to_owned()));
    assert_eq!(back.inputs, scene().inputs);
    let text = scene().text().unwrap();
    assert!(!text.contains("somebody"), "{text}");
    let [picked, own] = [0, 1].map(|n| back.project.passes[0].bindings.get(n).map(|c| c.input.media().cloned()));
    assert_eq!((picked, own), (None, Some(Some(Media::File("own.png".into())))));
    assert_eq!(back.project.passes[0].source.text, project().passes[0].source.text);
    // The picture is the same, and other programs can read it.
    let decoded = |bytes: &[u8]| image::load_from_memory(bytes).unwrap();
    assert_eq!(decoded(&file), decoded(&png()));
    assert!(Scene::is_in(&file) && !Scene::is_in(&png()));
    assert!(matches!(read(&png()), Err(SceneError::None { .. })));
}

#[test]
fn frames_are_those_of_the_run() {
    let back = read(&scene().embed(png()).unwrap()).unwrap();
    let mut inputs = scripted();
    let expected: Vec<FrameInputs> = (0..13).map(|_| inputs.next_frame()).collect();
    let frames = back.frames(true).unwrap();
    assert!(frames.iter().map(|frame| &frame.inputs).eq(&expected));
    let last = back.frames(false).unwrap();
    assert!(last.len() == 1 && last[0].inputs == expected[12]);
    let frame = |inputs: FrameInputs| RecordedFrame { inputs, size: (4, 3), values: Default::default(), reset: false };
    let recording = Recording { project: "waves".into(), frames: expected.into_iter().map(frame).collect() };
    let recorded = Scene { inputs: SceneInputs::Recording(recording.clone()), ..scene() };
    let back = read(&recorded.embed(png()).unwrap()).unwrap();
    assert_eq!(back.inputs, SceneInputs::Recording(recording));
    assert_eq!((back.frames(true).unwrap().len(), back.frames(false).unwrap().len()), (13, 1));
}

#[test]
fn microphone_data_is_not_embedded() {
    let mut inputs = scripted();
    let heard = |n: usize, inputs: FrameInputs| FrameInputs {
        microphone: (n == 3).then(|| std::sync::Arc::new([7; 2 * eddy_audio::BINS])),
        ..inputs
    };
    let frames = (0..13).map(|n| RecordedFrame {
        inputs: heard(n, inputs.next_frame()),
        size: (4, 3),
        values: Default::default(),
        reset: n == 0,
    });
    let recording = Recording { project: "waves".into(), frames: frames.collect() };
    let scene = Scene { inputs: SceneInputs::Recording(recording), ..scene() };
    let back = read(&scene.embed(png()).unwrap()).unwrap();
    let frames = back.frames(true).unwrap();
    assert!(frames.len() == 1 && frames[0].inputs.frame == 12 && frames[0].inputs.microphone.is_none());
}

#[test]
fn damaged_files_are_rejected_or_read_completely() {
    let whole = scene().embed(png()).unwrap();
    for at in 0..whole.len() {
        let mut bytes = whole.clone();
        bytes[at] ^= 0x10;
        // The text may be changed; none may cause a panic.
        let _ = read(&bytes);
        assert!(read(&whole[..at]).is_err() || at > whole.len() - png().len());
    }
    let newer = |text: &str| {
        let mut data = b"eddy\0\x01\0\0\0".to_vec();
        let mut packed = ZlibEncoder::new(&mut data, Compression::fast());
        packed.write_all(text.as_bytes()).unwrap();
        packed.finish().unwrap();
        [&png()[..33], &(data.len() as u32).to_be_bytes(), b"iTXt", &data, &[0; 4], &png()[33..]].concat()
    };
    assert!(matches!(read(&newer("{\"eddy_picture\":2}")), Err(SceneError::Version { version: 2, .. })));
    // A compressed list of 65 KB would be a gigabyte of values.
    let values = format!("{{\"eddy_picture\":1,\"x\":[{}0]}}", "0,".repeat(1 << 20));
    let error = read(&newer(&values)).unwrap_err().to_string();
    assert!(error.contains("more than 262144 values"), "{error}");
    for text in ["", "{}", "[]", "{\"eddy_picture\":1}", "{\"eddy_picture\":-1}"] {
        assert!(matches!(read(&newer(text)), Err(SceneError::Damaged { .. })), "{text}");
    }
}

/// The frame number of a file may be arbitrary: reaching it takes as many steps as the script has actions.
#[test]
fn distant_frame_is_reached_at_once_or_rejected() {
    let script = Script { fps: 60.0, mouse: "2:down 3,4".into(), keys: String::new(), date: String::new() };
    let at = |frame| Scene { frame, inputs: SceneInputs::Script(script.clone()), ..scene() };
    let back = read(&at(i32::MAX as u32).embed(png()).unwrap()).unwrap();
    for is_whole in [false, true] {
        let frames = back.frames(is_whole).unwrap();
        assert_eq!((frames.len(), frames[0].inputs.frame), (1, i32::MAX));
        assert_eq!(frames[0].inputs.mouse[..2], [3.0, 4.0]);
    }
    let error = read(&at(u32::MAX).embed(png()).unwrap()).unwrap_err().to_string();
    assert!(error.contains("frame 4294967295 cannot be"), "{error}");
    let error = read(&Scene { size: (32_768, 32_768), ..at(0) }.embed(png()).unwrap()).unwrap_err().to_string();
    assert!(error.contains("512 MiB, the limit for a picture"), "{error}");
    let long = Script { mouse: "1:up;".repeat(1 << 19), ..script.clone() };
    let long = Scene { inputs: SceneInputs::Script(long), ..at(0) };
    let error = read(&long.embed(png()).unwrap()).unwrap_err().to_string();
    assert!(error.contains("its script is larger than 2 MiB"), "{error}");
}
