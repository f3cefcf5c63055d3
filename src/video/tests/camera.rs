//! Cameras, replaced by filters of ffmpeg.

use super::*;

#[test]
fn a_camera_returns_its_newest_picture_and_keeps_the_last_one() {
    if !has_ffmpeg() {
        return;
    }
    let (sender, came) = std::sync::mpsc::channel();
    let source = CameraSource::of_text("lavfi:testsrc=s=64x48:r=30:d=1.5");
    let camera = Camera::open(source, &Tools::default(), move || {
        let _ = sender.send(());
    });
    let first = camera.wait(Duration::from_secs(20)).unwrap();
    assert_eq!((first.width, first.height, first.frame.texels.len()), (64, 48, 64 * 48 * 4));
    came.recv_timeout(Duration::from_secs(5)).expect("the first picture is told of");
    let give_up = std::time::Instant::now() + Duration::from_secs(20);
    let mut others = 0;
    let mut last = first.frame.clone();
    while camera.error().is_none() && std::time::Instant::now() < give_up {
        std::thread::sleep(Duration::from_millis(20));
        let newest = camera.newest().unwrap();
        others += usize::from(!newest.frame.is(&last));
        last = newest.frame;
    }
    assert!(others >= 5, "{others} pictures in 1.5 s");
    assert!(matches!(camera.error(), Some(VideoError::Camera(_))), "{:?}", camera.error());
    assert!(camera.newest().unwrap().frame.is(&last), "the last one stays");
}

#[test]
fn a_missing_camera_is_an_error() {
    if !has_ffmpeg() {
        return;
    }
    for name in ["/dev/video-of-nobody", "http://127.0.0.1:9/x", "-i", "lavfi:nosuchfilter"] {
        let camera = Camera::open(CameraSource::of_text(name), &Tools::default(), || ());
        let error = camera.wait(Duration::from_secs(20)).unwrap_err();
        assert!(matches!(&error, VideoError::Camera(why) if !why.is_empty()), "{name}: {error:?}");
    }
    let missing = Tools { ffmpeg: "/nowhere/ffmpeg".into(), ..Tools::default() };
    let camera = Camera::open(CameraSource::of_text("lavfi:testsrc"), &missing, || ());
    assert!(matches!(camera.wait(Duration::from_secs(20)), Err(VideoError::NoProgram { .. })));
}
