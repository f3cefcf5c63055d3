use super::*;

fn facts(folder: &std::path::Path) -> FilmFacts {
    let there = ["libx264", "libvpx-vp9", "prores_ks", "gif"].map(str::to_owned).to_vec();
    FilmFacts { shown: (640, 360), most_side: 8192, folder: folder.to_owned(), period: None, encoders: Some(Ok(there)) }
}

/// Validates a form with nothing on disk.
fn check(form: &FilmForm) -> CheckedForm {
    form.check(&facts(std::path::Path::new("/nowhere")), false)
}

fn form(change: impl FnOnce(&mut FilmForm)) -> FilmForm {
    let mut form = FilmForm::default();
    change(&mut form);
    form
}

#[test]
fn default_form_and_all_presets_are_valid() {
    let mut forms = vec![FilmForm::default()];
    forms.extend(FilmPreset::ALL.map(|preset| preset.apply(&FilmForm::default())));
    for form in forms {
        let checked = check(&form);
        assert_eq!(checked.errors, [], "{form:?}");
        assert!(checked.range.is_some() && checked.live.is_some(), "{form:?}");
    }
    let order = check(&FilmForm::default()).range.unwrap();
    assert_eq!((order.size, order.frames.as_ref().map(Vec::len)), ((640, 360), Some(600)), "as it is shown");
    let order = check(&FilmPreset::SquareLoop.apply(&FilmForm::default())).range.unwrap();
    assert_eq!((order.size, order.fade_secs, order.frames.unwrap().len()), ((1080, 1080), Some(1.0), 180));
}

#[test]
fn errors_are_at_their_field_and_block_only_dependent_films() {
    type Case = (fn(&mut FilmForm), FilmField, &'static str, bool);
    let cases: [Case; 19] = [
        (|f| f.range = "9-2".into(), FilmField::Range, "write 2-9", true),
        (|f| f.range = String::new(), FilmField::Range, "0-59", true),
        (|f| f.range = "1,2,5".into(), FilmField::Range, "one range", true),
        (|f| f.range = "5s-1s".into(), FilmField::Range, "no frame", true),
        (|f| f.size = "1920".into(), FilmField::Size, "1920x1080", false),
        (|f| f.size = "0x3".into(), FilmField::Size, "at least 1", false),
        (|f| f.size = "9000x10".into(), FilmField::Size, "at most 8192x8192", false),
        (|f| f.size = "641x360".into(), FilmField::Size, "even width", false),
        (|f| f.fps = "fast".into(), FilmField::Rate, "29.97", false),
        (|f| f.fps = "0".into(), FilmField::Rate, "29.97", false),
        (|f| f.format = Format::Gif, FilmField::Rate, "50, 33.3", false),
        (|f| f.codec = Some(Codec::Ffv1), FilmField::Codec, "use h264", false),
        (|f| f.codec = Some(Codec::Av1), FilmField::Codec, "install a full build of ffmpeg", false),
        (|f| f.format = Format::Mkv, FilmField::Format, "install a full build of ffmpeg", false),
        (|f| f.quality = "best".into(), FilmField::Quality, "lossless", false),
        (|f| f.quality = "99".into(), FilmField::Quality, "0 to 51", false),
        (|f| f.fade = "soon".into(), FilmField::Fade, "0.5", true),
        (|f| f.fade = "11".into(), FilmField::Fade, "10.00 s long", true),
        (|f| f.file = "a.gif".into(), FilmField::File, "the format is mp4", false),
    ];
    for (change, field, says, live) in cases {
        let form = form(change);
        let checked = check(&form);
        assert!(checked.error(field).is_some_and(|why| why.contains(says)), "{form:?}: {:?}", checked.errors);
        assert_eq!(checked.errors.len(), 1, "{:?}", checked.errors);
        assert_eq!((checked.range.is_some(), checked.live.is_some()), (false, live), "{form:?}");
    }
    // Several errors at once, each at its own field.
    let checked = check(&form(|f| (f.range, f.size, f.fps) = ("x".into(), "y".into(), "60".into())));
    assert_eq!(checked.errors.len(), 2);
}

#[test]
fn window_size_is_rounded_to_even_if_the_codec_requires_it() {
    let facts = FilmFacts { shown: (645, 363), ..facts(std::path::Path::new("/nowhere")) };
    let size = |format| form(|f| (f.format, f.fps) = (format, "20".into())).check(&facts, false).range.unwrap().size;
    assert_eq!((size(Format::Mp4), size(Format::Gif)), ((644, 362), (645, 363)));
    let typed = form(|f| f.size = "645x363".into()).check(&facts, false);
    assert!(typed.error(FilmField::Size).is_some(), "what is typed is what is meant");
}

#[test]
fn range_step_changes_rate_and_live_film_needs_streamable_format() {
    let checked = check(&form(|f| (f.format, f.range) = (Format::Gif, "0-59:3".into())));
    let order = checked.range.expect("20 frames per second");
    assert_eq!((order.rate.per_second(), order.frames.unwrap().len()), (20.0, 20));
    assert!(checked.live.is_none() && checked.not_live.is_some_and(|why| why.contains("GIF")), "60 are too many");
    let checked = check(&form(|f| f.format = Format::Apng));
    assert!(checked.range.is_some() && checked.live.is_none());
    assert!(checked.not_live.is_some_and(|why| why.contains("how many frames")));
    let checked = check(&form(|f| (f.format, f.range) = (Format::Png, "3,8,20-30".into())));
    assert_eq!(
        checked.range.and_then(|order| order.frames).map(|frames| frames.len()),
        Some(13),
        "pictures are a list"
    );
}

#[test]
fn without_ffmpeg_pictures_work_and_films_name_the_package() {
    let facts = FilmFacts {
        encoders: Some(Err("ffmpeg is not there; install it".into())),
        ..facts(std::path::Path::new("/nowhere"))
    };
    let film = FilmForm::default().check(&facts, false);
    assert_eq!(film.error(FilmField::Format), Some("ffmpeg is not there; install it"));
    for format in [Format::Png, Format::Exr, Format::Apng, Format::Y4m] {
        assert_eq!(form(|f| f.format = format).check(&facts, false).errors, [], "{format:?}");
    }
    let unknown = FilmFacts { encoders: None, ..facts };
    assert_eq!(FilmForm::default().check(&unknown, false).errors, [], "it is looked for when the film begins");
}

#[test]
fn no_file_is_replaced_without_asking() {
    let folder = tempfile::tempdir().unwrap();
    fs::write(folder.path().join("a.mp4"), "mine").unwrap();
    fs::create_dir(folder.path().join("pictures")).unwrap();
    let facts = facts(folder.path());
    for name in ["a", "a.mp4", "./a.mp4"] {
        let form = form(|f| f.file = name.into());
        let checked = form.check(&facts, false);
        assert!(checked.is_taken && checked.range.is_none() && checked.live.is_none(), "{name}");
        assert!(checked.error(FilmField::File).is_some_and(|why| why.contains("a.mp4 already exists")), "{name}");
        let place = form.check(&facts, true).range.unwrap().place;
        assert_eq!(place, FilmPlace::Named { path: folder.path().join(name).with_extension("mp4"), replaces: true });
    }
    let new = form(|f| f.file = "b v1.2".into()).check(&facts, false).range.unwrap().place;
    assert_eq!(new, FilmPlace::Named { path: folder.path().join("b v1.2.mp4"), replaces: false });
    let pictures = |name: &str| form(|f| (f.format, f.file) = (Format::Png, name.into())).check(&facts, false);
    assert_eq!(pictures("pictures").errors, [], "an empty folder has room");
    assert!(pictures("a.mp4").error(FilmField::File).is_some_and(|why| why.contains("into a folder")));
    fs::write(folder.path().join("pictures/x"), "").unwrap();
    assert!(pictures("pictures").is_taken);
    let film = form(|f| f.file = "pictures".into()).check(&facts, false);
    assert_eq!(film.errors, [], "pictures.mp4 is another name");
    fs::create_dir(folder.path().join("c.mp4")).unwrap();
    let film = form(|f| f.file = "c".into()).check(&facts, true);
    assert!(film.error(FilmField::File).is_some_and(|why| why.contains("is a folder")));
}

#[test]
fn choices_are_stored_as_command_line_options() {
    let mut forms = vec![FilmForm::default()];
    forms.extend(FilmPreset::ALL.map(|preset| preset.apply(&FilmForm::default())));
    forms.push(form(|f| (f.codec, f.with_sound, f.range) = (Some(Codec::Vp9), false, "0-9:3".into())));
    for form in forms {
        assert_eq!(FilmForm::of_options(&form.options()), Ok(form.clone()), "{}", form.options());
    }
    assert_eq!(FilmForm::default().options(), "--frames 10s --fps 60 --format mp4");
    assert_eq!(form(|f| f.range = "1s - 2s".into()).options(), "--frames 1s-2s --fps 60 --format mp4");
    for (text, says) in [
        ("--frames", "a value"),
        ("--format avi", "avi"),
        ("--codec x", "x"),
        ("--pass image", "--pass"),
        ("film", "film"),
    ] {
        let why = FilmForm::of_options(text).expect_err(text);
        assert!(why.contains(says), "{text}: {why}");
    }
}
