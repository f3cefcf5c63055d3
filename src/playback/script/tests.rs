//! Tests of mouse and key scripts.

use super::*;

#[test]
fn examples_of_the_help_are_parsed() {
    assert_eq!(
        parse_mouse("0:down 40,40; 4:move 80,45; 10:up").unwrap(),
        [
            ScriptedAction { frame: 0, action: MouseAction::Down(40.0, 40.0) },
            ScriptedAction { frame: 4, action: MouseAction::Move(80.0, 45.0) },
            ScriptedAction { frame: 10, action: MouseAction::Up },
        ]
    );
    assert_eq!(
        parse_keys("0:down 32; 3:up 32").unwrap(),
        [
            ScriptedAction { frame: 0, action: KeyAction::Down(32) },
            ScriptedAction { frame: 3, action: KeyAction::Up(32) }
        ]
    );
}

#[test]
fn spaces_empty_entries_and_order_do_not_matter() {
    let events = parse_mouse(" ;7 : up ;; 2:move -1.5 , 3 ;2:down 1,1;").unwrap();
    assert_eq!(
        events,
        [
            ScriptedAction { frame: 2, action: MouseAction::Move(-1.5, 3.0) },
            ScriptedAction { frame: 2, action: MouseAction::Down(1.0, 1.0) },
            ScriptedAction { frame: 7, action: MouseAction::Up },
        ]
    );
    assert!(parse_mouse("").unwrap().is_empty());
}

#[test]
fn errors_state_position_and_expectation() {
    let message = |text: &str| parse_mouse(text).unwrap_err().to_string();
    assert_eq!(
        message("0:down 40,40; 4:mvoe 80,45"),
        "at character 17: expected `down X,Y`, `move X,Y` or `up`, found `mvoe`"
    );
    assert_eq!(message("0:down 40"), "at character 10: expected `,`, found the end");
    assert_eq!(message("0:down x,4"), "at character 8: expected x in pixels of the picture, found `x,4`");
    assert_eq!(message("-1:up"), "at character 1: expected a frame number from 0 on, found `-1:up`");
    assert_eq!(message("ä:up"), "at character 1: expected a frame number from 0 on, found `ä:up`");
    assert_eq!(message("0:up 3"), "at character 6: expected `;` or the end, found `3`");
    assert_eq!(
        message("3000000000:up"),
        "at character 1: expected a frame number below 2147483648, found `3000000000:up`"
    );
    assert_eq!(
        parse_keys("0:down 32; 3:up 256").unwrap_err().to_string(),
        "at character 17: expected a key code from 0 to 255, found `256`"
    );
}

#[test]
fn events_happen_before_their_frame() {
    let mut s = ScriptedInputs::new(30.0)
        .with_mouse(parse_mouse("1:down 4,5; 2:move 8,9; 3:up").unwrap())
        .with_keys(parse_keys("1:down 32; 3:up 32").unwrap());
    let frames: Vec<FrameInputs> = (0..5).map(|_| s.next_frame()).collect();
    let mouse: Vec<[u32; 4]> = frames.iter().map(|f| f.mouse.map(f32::to_bits)).collect();
    let want = [
        [0.0, 0.0, -0.0, -0.0],
        [4.0, 5.0, 4.0, 5.0],
        [8.0, 9.0, 4.0, -5.0],
        [8.0, 9.0, -4.0, -5.0],
        [8.0, 9.0, -4.0, -5.0],
    ];
    assert_eq!(mouse, want.map(|m: [f32; 4]| m.map(f32::to_bits)));
    let rows = |f: &FrameInputs| [32, 256 + 32, 512 + 32].map(|i: usize| f.keyboard.bytes()[i]);
    let keys: Vec<[u8; 3]> = frames.iter().map(rows).collect();
    assert_eq!(keys, [[0, 0, 0], [255, 255, 255], [255, 0, 255], [0, 0, 255], [0, 0, 255]]);
    assert_eq!(frames[3].time_secs, 0.1);
    assert_eq!(frames[3].frame, 3);
}

#[test]
fn date_advances_with_the_frames() {
    let mut undated = ScriptedInputs::new(2.0);
    undated.next_frame();
    assert_eq!(undated.next_frame().date, [0.0, 0.0, 0.0, 0.5]);
    let mut s = ScriptedInputs::new(2.0).with_date(Some(date::parse("2024-12-31T23:59:59").unwrap()));
    let dates: Vec<[f32; 4]> = (0..3).map(|_| s.next_frame().date).collect();
    assert_eq!(dates, [[2024.0, 11.0, 31.0, 86399.0], [2024.0, 11.0, 31.0, 86399.5], [2025.0, 0.0, 1.0, 0.0]]);
}

#[test]
fn skipping_yields_the_inputs_of_a_complete_run() {
    let mouse = parse_mouse("0:down 4,5; 3:move 9,9; 3:up; 7:down 1,1; 8:up; 900:down 2,2").unwrap();
    let keys = parse_keys("2:down 32; 6:up 32; 11:down 65").unwrap();
    let new = || ScriptedInputs::new(60.0).with_mouse(mouse.clone()).with_keys(keys.clone());
    for frame in 0..20 {
        let (mut walked, mut skipped) = (new(), new());
        (0..frame).for_each(|_| drop(walked.next_frame()));
        skipped.skip_to(frame);
        assert_eq!((walked.frame(), walked.next_frame()), (skipped.frame(), skipped.next_frame()), "{frame}");
    }
    // Finishes in reasonable time only if frames without actions take no steps.
    let mut far = new();
    far.skip_to(i32::MAX);
    assert_eq!((far.frame(), far.next_frame().mouse[0]), (i32::MAX, 2.0));
}
