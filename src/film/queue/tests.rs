use super::*;
use crate::{Encoding, Format, Style};
use std::{
    fs, io,
    sync::{Arc, Mutex},
};

fn picture(value: f32) -> Pixels {
    Pixels { width: 2, height: 2, texels: vec![[value, 0.5, 0.0, 1.0]; 4] }
}

fn start(format: Format, frames: u32, output: Output) -> Film {
    let Ok(Encoding::Film(encoding)) = Style::new(format).resolve() else { panic!("{format:?}") };
    let shape = Shape { width: 2, height: 2, rate: Rate::of(30.0).unwrap(), frames: Some(frames) };
    Film::start(&encoding, shape, None, output, &Tools::default()).unwrap()
}

#[derive(Clone, Default)]
struct Shared(Arc<Mutex<Vec<u8>>>);

impl Write for Shared {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        self.0.lock().unwrap().write(bytes)
    }

    fn flush(&mut self) -> io::Result<()> {
        Ok(())
    }
}

#[test]
fn frames_are_piped_in_order() {
    let out = Shared::default();
    let mut film = start(Format::Raw, 40, Output::Pipe(Box::new(out.clone())));
    (0..40).for_each(|n| film.push(picture(n as f32 / 255.0)).unwrap());
    film.finish().unwrap();
    let bytes = out.0.lock().unwrap();
    let reds: Vec<u8> = bytes.chunks_exact(16).map(|frame| frame[0]).collect();
    assert_eq!(reds, (0..40).collect::<Vec<u8>>());
}

#[test]
fn an_abandoned_or_short_film_leaves_the_existing_file() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("a.apng");
    fs::write(&path, "mine").unwrap();
    let mut film = start(Format::Apng, 3, Output::File(path.clone()));
    film.push(picture(0.0)).unwrap();
    assert!(matches!(film.finish(), Err(FilmError::Frames { got: 1, wanted: 3 })));
    let mut film = start(Format::Apng, 1, Output::File(path.clone()));
    film.push(picture(0.0)).unwrap();
    drop(film);
    assert_eq!(fs::read_to_string(&path).unwrap(), "mine");
    assert_eq!(fs::read_dir(folder.path()).unwrap().count(), 1);
    let other = Pixels { width: 1, height: 1, texels: vec![[0.0; 4]] };
    let mut film = start(Format::Apng, 1, Output::File(path.clone()));
    assert!(matches!(film.push(other), Err(FilmError::Size { of: (1, 1), film: (2, 2) })));
    film.push(picture(1.0)).unwrap();
    film.finish().unwrap();
    assert_eq!(image::open(&path).err().map(|e| e.to_string()), None);
}

#[test]
fn a_closed_pipe_ends_the_film() {
    struct Full;
    impl Write for Full {
        fn write(&mut self, _: &[u8]) -> io::Result<usize> {
            Err(io::ErrorKind::BrokenPipe.into())
        }

        fn flush(&mut self) -> io::Result<()> {
            Ok(())
        }
    }
    let mut film = start(Format::Raw, 100, Output::Pipe(Box::new(Full)));
    let failed = (0..100).find_map(|_| film.push(picture(0.0)).err()).expect("an error");
    assert!(matches!(failed, FilmError::Closed), "{failed}");
}
