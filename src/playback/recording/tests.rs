use super::*;
use eddy_media::Keyboard;
use eddy_project::{CustomUniformValue, CustomUniformValues, limits::Limit};

fn frame(number: i32, change: impl FnOnce(&mut RecordedFrame)) -> RecordedFrame {
    let mut frame = RecordedFrame {
        inputs: FrameInputs::at_fixed_step(number, 60.0),
        size: (640, 360),
        values: CustomUniformValues::new(),
        reset: false,
    };
    change(&mut frame);
    frame
}

fn there_and_back(recording: &Recording) -> (String, Recording) {
    let mut bytes = Vec::new();
    recording.write(&mut bytes).unwrap();
    let read = Recording::read(bytes.as_slice()).unwrap();
    (String::from_utf8(bytes).unwrap(), read)
}

/// Numbers without an exact short decimal form, and signed zeros.
#[test]
fn recording_round_trips_bit_for_bit() {
    let mut keyboard = Keyboard::default();
    keyboard.press(32);
    let mut after = keyboard.clone();
    after.frame_painted();
    after.release(32);
    let recording = Recording {
        project: "my \"fluid\"".into(),
        frames: vec![
            frame(0, |f| {
                f.inputs.mouse = [0.0, 0.0, -0.0, -0.0];
                f.inputs.date = [2026.0, 0.0, 31.0, 86_399.01];
                f.values.insert("on".into(), CustomUniformValue::Bool(true));
            }),
            frame(1, |f| {
                f.inputs.time_secs = 0.1 + 0.2;
                f.inputs.time_delta_secs = f32::from_bits(0x3c88_8889);
                f.inputs.keyboard = keyboard;
                f.values.insert("tint".into(), CustomUniformValue::Vector(vec![0.1, 1.0, 1.0 / 3.0]));
                f.values.insert("count".into(), CustomUniformValue::Int(-3));
                f.values.insert("x".into(), CustomUniformValue::Float(1.0));
            }),
            frame(2, |f| {
                f.inputs.keyboard = after;
                f.inputs.mouse = [7.0, 9.0, -7.0, 9.0];
                f.inputs.microphone = Some(std::sync::Arc::new(std::array::from_fn(|n| n as u8)));
                f.size = (333, 187);
            }),
            frame(0, |f| f.reset = true),
            frame(1, |_| {}),
        ],
    };
    let (text, read) = there_and_back(&recording);
    assert_eq!(read, recording, "{text}");
    let bits = |r: &Recording| r.frames.iter().map(|f| f.inputs.mouse.map(f32::to_bits)).collect::<Vec<_>>();
    assert_eq!(bits(&read), bits(&recording));
    assert_eq!(text.lines().count(), 6);
    let last = text.lines().last().unwrap();
    assert_eq!(last, r#"{"time":0.016666666666666666}"#, "what stays is not written");
}

#[test]
fn frame_lines_contain_only_changes() {
    let recording = Recording {
        project: String::new(),
        frames: vec![frame(0, |f| f.reset = true), frame(1, |_| {}), frame(0, |f| (f.size, f.reset) = ((8, 4), true))],
    };
    let change = |i| recording.change(i).map(|(change, _)| change);
    let values = CustomUniformValues::new();
    assert_eq!(change(0), Some(Change { size: Some((640, 360)), values: Some(values), reset: false }));
    assert_eq!(change(1), Some(Change { size: None, values: None, reset: false }));
    assert_eq!(change(2), Some(Change { size: Some((8, 4)), values: None, reset: true }));
    assert_eq!(change(3), None);
}

#[test]
fn invalid_recordings_are_rejected_with_reason_and_line() {
    let head = "{\"eddy_recording\":1}\n";
    let frame = "{\"time\":0.0,\"size\":[4,4]}\n";
    for (text, says) in [
        (String::new(), "not an Eddy recording"),
        ("{\"version\":1}\n".into(), "not an Eddy recording"),
        ("{\"eddy_recording\":2}\n".into(), "newer version"),
        (head.into(), "no frame"),
        (format!("{head}{{\"size\":[4,4]}}"), "line 2: the first frame has no `time`"),
        (format!("{head}{{\"time\":0.0}}"), "line 2: the first frame has no `size`"),
        (format!("{head}{frame}{{\"size\":[0,4]}}"), "line 3: a `size` must"),
        (format!("{head}{frame}{{\"mouse\":[1]}}"), "line 3: "),
        (format!("{head}{frame}{{\"set\":{{\"a\":\"x\"}}}}"), "line 3: `a` has a value"),
    ] {
        let error = Recording::read(text.as_bytes()).expect_err(&text).to_string();
        assert!(error.contains(says), "{text}: {error}");
    }
    let later = Recording::read(format!("{head}{{\"time\":1.5,\"size\":[4,4],\"gamepad\":[1]}}").as_bytes());
    assert_eq!(later.unwrap().frames[0].inputs.time_secs, 1.5, "a member of a newer version is passed over");
}

/// A line without changes is a frame with the values of all lines before.
#[test]
fn small_file_of_very_many_frames_is_rejected() {
    let head = "{\"eddy_recording\":1}\n";
    let values: Vec<String> = (0..100).map(|n| format!("\"value_{n}\":{n}")).collect();
    let first = format!("{{\"time\":0,\"size\":[1,1],\"set\":{{{}}}}}\n", values.join(","));
    let limit = Limit { bytes: 20 << 20, of: "a test" };
    let refused = |text: &str, most| Recording::read_within(text.as_bytes(), limit, most).unwrap_err().to_string();
    let many = format!("{head}{first}{}", "{}\n".repeat(300));
    assert_eq!(Recording::read(many.as_bytes()).unwrap().frames.len(), 301);
    let said = refused(&many, 1 << 20);
    assert!(said.contains("it takes more than 1 MiB") && said.starts_with("line "), "{said}");
    let long = format!("{head}{first}{{\"x\":\"{}\"}}\n", "y".repeat(17 << 20));
    let said = refused(&long, 1 << 20);
    assert!(said.contains("line 3: it is larger than 16 MiB, the limit for a line"), "{said}");
    // An endless file.
    let endless = std::io::BufReader::new(std::io::repeat(b' '));
    let said = Recording::read_within(endless, limit, 1 << 20).unwrap_err().to_string();
    assert!(said.contains("it is larger than 20 MiB"), "{said}");
}

/// Zero texels are not written, and unknown texels are ignored.
#[test]
fn gamepads_round_trip() {
    let moved = |n: i32| {
        let mut pads = eddy_media::Gamepads::default();
        pads.connect(1, n > 0);
        pads.move_to(1, eddy_project::PadPart::Axis(2), -0.3 * n as f32);
        pads.move_to(1, eddy_project::PadPart::Button(4), if n == 2 { 1.0 } else { 0.0 });
        pads
    };
    let all = [0, 1, 1, 2, 3, 0].map(moved);
    let frames = all.iter().enumerate().map(|(n, pads)| frame(n as i32, |f| f.inputs.gamepads.clone_from(pads)));
    let recording = Recording { project: String::new(), frames: frames.collect() };
    let (text, read) = there_and_back(&recording);
    assert_eq!(read, recording);
    assert_eq!(text.matches("\"pads\"").count(), 4, "where they change: {text}");
    let odd = "{\"eddy_recording\":1}\n{\"time\":0,\"delta\":0.01,\"rate\":60,\"size\":[4,4],\"mouse\":[0,0,0,0],\
               \"date\":[0,0,0,0],\"pads\":[[0,0.5],[99999,1],[1,7.5],[2,1e300]]}";
    let read = Recording::read(odd.as_bytes()).unwrap();
    let texels = read.frames[0].inputs.gamepads.texels();
    assert_eq!((texels[0], texels.iter().filter(|value| **value != 0.0).count()), (0.5, 1));
}

/// Its texture is stored with each frame that changes it, and removed when it is switched off.
#[test]
fn microphone_round_trips() {
    let heard = |byte: u8| Some(std::sync::Arc::new([byte; 1024]));
    let all = [None, heard(7), heard(7), heard(255), None, None];
    let frames = all.iter().enumerate().map(|(n, heard)| frame(n as i32, |f| f.inputs.microphone.clone_from(heard)));
    let recording = Recording { project: String::new(), frames: frames.collect() };
    let (text, read) = there_and_back(&recording);
    assert_eq!(read, recording);
    assert_eq!(text.matches("\"mic\"").count(), 3, "where it changes");
    for wrong in ["AAAA", "?", "AAA"] {
        let text = format!(
            "{{\"eddy_recording\":1}}\n{{\"time\":0,\"delta\":0.01,\"rate\":60,\"size\":[4,4],\"mouse\":[0,0,0,0],\
             \"date\":[0,0,0,0],\"mic\":\"{wrong}\"}}"
        );
        let error = Recording::read(text.as_bytes()).unwrap_err().to_string();
        assert_eq!(error, "line 2: `mic` must be 1024 bytes in base64");
    }
}
