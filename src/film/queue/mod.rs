//! Encoding on a separate thread, fed by a queue with a bounded number of frames.

use super::{
    FilmError, FilmSound, apng::Apng, coded::CodedFilm, gif::Gif, pipe::Plain, rate::Rate, still::Still,
    style::FilmEncoding,
};
use eddy_audio::wav;
use eddy_engine::Pixels;
use eddy_playback::scene::Scene;
use eddy_project::{Staged, limits, write_into, write_with};
use eddy_texture::TexelFormat;
use eddy_video::{Stop, Tools};
use std::{
    io::{BufWriter, Cursor, Write},
    panic::resume_unwind,
    path::{Path, PathBuf},
    sync::{
        Arc,
        atomic::{AtomicBool, Ordering},
        mpsc::{Receiver, SyncSender, TrySendError, sync_channel},
    },
    thread::{Builder, JoinHandle},
};

/// The maximum number of queued frames, however small they are.
const MOST: u64 = 16;

/// The properties of a film that are known before its first frame.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Shape {
    pub width: u32,
    pub height: u32,
    pub rate: Rate,
    /// `None` if it is not known yet.
    pub frames: Option<u32>,
}

/// The destination of a film.
pub enum Output {
    /// A file that the user named. If it is a link, its target is written.
    File(PathBuf),
    /// A file in a folder that the user named, under a name that Eddy chooses: links out of the folder are not
    /// followed.
    Within(PathBuf),
    /// A new file. A file that appears there meanwhile is not replaced.
    NewFile(PathBuf),
    /// Standard output, or any other writer.
    Pipe(Box<dyn Write + Send>),
}

/// A writer of one film, on the encoding thread.
pub(super) trait Sink: Send {
    fn frame(&mut self, pixels: &Pixels) -> Result<(), FilmError>;

    /// Takes the sound of a film if it arrives after the frames.
    fn sound(&mut self, _: Vec<[i16; 2]>) {}

    /// Completes the staged file.
    fn finish(&mut self) -> Result<(), FilmError>;
}

pub(super) enum Job<T> {
    Next(T),
    Finish,
}

/// A thread that runs jobs in order.
pub(super) struct Queue<T> {
    jobs: Option<SyncSender<Job<T>>>,
    thread: Option<JoinHandle<Result<(), FilmError>>>,
}

impl<T: Send + 'static> Queue<T> {
    /// `work` receives jobs until there are no more. It ends with [`FilmError::Stopped`] if no [`Job::Finish`] was
    /// received.
    pub(crate) fn start(
        capacity: usize,
        work: impl FnOnce(Receiver<Job<T>>) -> Result<(), FilmError> + Send + 'static,
    ) -> Result<Queue<T>, FilmError> {
        let (jobs, receiver) = sync_channel(capacity);
        let thread = Builder::new().name("encoding".into()).spawn(move || work(receiver)).map_err(FilmError::Thread)?;
        Ok(Queue { jobs: Some(jobs), thread: Some(thread) })
    }

    /// Blocks while the queue is full.
    pub(crate) fn push(&mut self, job: Job<T>) -> Result<(), FilmError> {
        match &self.jobs {
            Some(jobs) if jobs.send(job).is_ok() => Ok(()),
            // The thread has ended; `end` returns its error.
            _ => self.end().and(Err(FilmError::Stopped)),
        }
    }

    /// Returns the job if the queue is full.
    fn try_push(&mut self, job: Job<T>) -> Result<Option<Job<T>>, FilmError> {
        match self.jobs.as_ref().map(|jobs| jobs.try_send(job)) {
            Some(Ok(())) => Ok(None),
            Some(Err(TrySendError::Full(job))) => Ok(Some(job)),
            // The thread has ended; `end` returns its error.
            Some(Err(TrySendError::Disconnected(_))) | None => self.end().and(Err(FilmError::Stopped)),
        }
    }

    fn end(&mut self) -> Result<(), FilmError> {
        self.jobs = None;
        match self.thread.take().map(JoinHandle::join) {
            Some(Ok(result)) => result,
            Some(Err(panic)) => resume_unwind(panic),
            None => Err(FilmError::Stopped),
        }
    }

    pub(crate) fn finish(&mut self) -> Result<(), FilmError> {
        self.push(Job::Finish)?;
        self.end()
    }
}

impl<T> Drop for Queue<T> {
    fn drop(&mut self) {
        self.jobs = None;
        if let Some(thread) = self.thread.take() {
            let _ = thread.join();
        }
    }
}

/// Returns the number of frames of this size that may be queued.
fn capacity(width: u32, height: u32) -> usize {
    let bytes = u64::from(width) * u64::from(height) * 16;
    (limits::FILM_QUEUE_BYTES / bytes.max(1)).clamp(1, MOST) as usize
}

/// A part of a film.
pub(super) enum Part {
    Frame(Pixels),
    Sound(Vec<[i16; 2]>),
}

/// A film that is being written. If it is dropped before [`Film::finish`], it is abandoned and no file is left.
pub struct Film {
    queue: Queue<Part>,
    shape: Shape,
    pushed: u32,
    cancel: Cancel,
}

impl Film {
    /// Starts a film. `sound` has the film's length, at [`eddy_audio::SAMPLE_RATE`]; it is ignored if the encoding has
    /// no sound.
    pub fn start(
        encoding: &FilmEncoding,
        shape: Shape,
        sound: Option<&[[i16; 2]]>,
        output: Output,
        tools: &Tools,
    ) -> Result<Film, FilmError> {
        let sound = sound.map_or(FilmSound::None, FilmSound::Known);
        Self::start_with(encoding, shape, sound, output, (tools, &Cancel::default()))
    }

    /// Does the same for a film that another thread may cancel.
    pub fn start_with(
        encoding: &FilmEncoding,
        shape: Shape,
        sound: FilmSound<'_>,
        output: Output,
        (tools, cancel): (&Tools, &Cancel),
    ) -> Result<Film, FilmError> {
        let (sink, staged) = sink(encoding, shape, sound, output, (tools, &cancel.stop))?;
        let heard = cancel.clone();
        let work = move |jobs: Receiver<Job<Part>>| encode(&jobs, sink, staged, shape, &heard);
        let queue = Queue::start(capacity(shape.width, shape.height), work)?;
        Ok(Film { queue, shape, pushed: 0, cancel: cancel.clone() })
    }

    /// Adds the next frame, and blocks while the queue is full.
    pub fn push(&mut self, frame: Pixels) -> Result<(), FilmError> {
        self.check_size(&frame)?;
        self.queue.push(Job::Next(Part::Frame(frame)))?;
        self.pushed += 1;
        Ok(())
    }

    /// Adds the next frame, or returns it if the queue is full.
    pub fn try_push(&mut self, frame: Pixels) -> Result<Option<Pixels>, FilmError> {
        self.check_size(&frame)?;
        match self.queue.try_push(Job::Next(Part::Frame(frame)))? {
            Some(Job::Next(Part::Frame(frame))) => Ok(Some(frame)),
            _ => {
                self.pushed += 1;
                Ok(None)
            }
        }
    }

    fn check_size(&self, frame: &Pixels) -> Result<(), FilmError> {
        let (of, film) = ((frame.width, frame.height), (self.shape.width, self.shape.height));
        if of == film { Ok(()) } else { Err(FilmError::Size { of, film }) }
    }

    /// Adds the sound of a film that was started with [`FilmSound::Later`]. It has the film's length and follows its
    /// last frame.
    pub fn sound(&mut self, sound: Vec<[i16; 2]>) -> Result<(), FilmError> {
        self.queue.push(Job::Next(Part::Sound(sound)))
    }

    /// Waits until the file is complete and in its place.
    pub fn finish(mut self) -> Result<(), FilmError> {
        if let Some(wanted) = self.shape.frames.filter(|wanted| *wanted != self.pushed) {
            return Err(FilmError::Frames { got: self.pushed, wanted });
        }
        self.queue.finish()
    }
}

impl Drop for Film {
    fn drop(&mut self) {
        // Otherwise its thread might wait for the encoder.
        self.cancel.stop.stop();
    }
}

/// Cancels films from another thread. All clones cancel the same films.
#[derive(Clone, Debug, Default)]
pub struct Cancel {
    is_cancelled: Arc<AtomicBool>,
    stop: Stop,
}

impl Cancel {
    /// Cancels the films. Incomplete films leave no file.
    pub fn cancel(&self) {
        self.is_cancelled.store(true, Ordering::Relaxed);
        self.stop.stop();
    }

    pub fn is_cancelled(&self) -> bool {
        self.is_cancelled.load(Ordering::Relaxed)
    }

    fn check(&self) -> Result<(), FilmError> {
        if self.is_cancelled() { Err(FilmError::Stopped) } else { Ok(()) }
    }
}

/// A staged file with its destination.
struct StagedFile {
    staged: Staged,
    path: PathBuf,
    /// An existing file may be replaced.
    replaces: bool,
}

impl StagedFile {
    fn commit(self) -> Result<(), FilmError> {
        let committed = if self.replaces { self.staged.commit() } else { self.staged.commit_new() };
        committed.map_err(FilmError::io(&self.path))
    }
}

fn sink(
    encoding: &FilmEncoding,
    shape: Shape,
    sound: FilmSound<'_>,
    output: Output,
    with: (&Tools, &Stop),
) -> Result<(Box<dyn Sink>, Option<StagedFile>), FilmError> {
    type Stage = fn(&Path) -> std::io::Result<Staged>;
    let (path, replaces, stage) = match output {
        Output::Pipe(pipe) => return Ok((plain(encoding, shape, pipe, FilmError::pipe)?, None)),
        Output::File(path) => (path, true, Staged::new as Stage),
        Output::Within(path) => (path, true, Staged::within as Stage),
        Output::NewFile(path) => (path, false, Staged::new as Stage),
    };
    let mut staged = stage(&path).map_err(FilmError::io(&path))?;
    let temporary = staged.path().to_owned();
    let named = |error: FilmError| error.of_film(&path);
    let sink: Box<dyn Sink> = match encoding {
        FilmEncoding::Coded(coded) => {
            let to = staged.path().to_owned();
            Box::new(CodedFilm::start(*coded, shape, sound, &to, with).map_err(named)?)
        }
        FilmEncoding::Gif => Box::new(Gif::start(shape, &temporary, with).map_err(named)?),
        _ => {
            let file = staged.file().try_clone().map_err(FilmError::io(&path))?;
            plain(encoding, shape, BufWriter::new(file), FilmError::Pipe)?
        }
    };
    Ok((sink, Some(StagedFile { staged, path, replaces })))
}

/// Returns a writer for a film that needs no external program.
fn plain<W: Write + Send + 'static>(
    encoding: &FilmEncoding,
    shape: Shape,
    out: W,
    failed: fn(std::io::Error) -> FilmError,
) -> Result<Box<dyn Sink>, FilmError> {
    Ok(match encoding {
        FilmEncoding::Apng(depth) => Box::new(Apng::new(out, shape, *depth, failed)?),
        FilmEncoding::Raw(depth) => Box::new(Plain::new(out, shape, Err(*depth), failed)?),
        FilmEncoding::Y4m(format) => Box::new(Plain::new(out, shape, Ok(*format), failed)?),
        FilmEncoding::Gif | FilmEncoding::Coded(_) => {
            return Err(FilmError::Pipe(std::io::Error::other(
                "this format needs a file, as parts of it are written twice",
            )));
        }
    })
}

/// Writes a sound to a temporary file next to the film.
pub(super) fn stage_sound(film: &Path, sound: &[[i16; 2]]) -> Result<Staged, FilmError> {
    // The limit of a WAV file.
    if sound.len() >= (u32::MAX / 4 - 16) as usize {
        return Err(FilmError::LongSound);
    }
    let mut staged = Staged::new(film).map_err(FilmError::io(film))?;
    staged.file().write_all(&wav(sound)).map_err(FilmError::io(film))?;
    Ok(staged)
}

fn encode(
    jobs: &Receiver<Job<Part>>,
    mut sink: Box<dyn Sink>,
    staged: Option<StagedFile>,
    shape: Shape,
    cancel: &Cancel,
) -> Result<(), FilmError> {
    let path = staged.as_ref().map(|staged| staged.path.clone());
    // Errors of files name the file.
    let named = |error: FilmError| match (error, &path) {
        (FilmError::Pipe(source), Some(path)) => FilmError::Io { path: path.clone(), source },
        (error, Some(path)) => error.of_film(path),
        (error, None) => error,
    };
    let mut frames = 0;
    loop {
        cancel.check()?;
        match jobs.recv() {
            Ok(Job::Next(Part::Sound(sound))) => {
                sink.sound(sound);
                continue;
            }
            Ok(Job::Next(_)) if shape.frames == Some(frames) => return Err(FilmError::Stopped),
            Ok(Job::Next(Part::Frame(pixels))) => sink.frame(&pixels).map_err(named)?,
            Ok(Job::Finish) if shape.frames.is_none_or(|wanted| wanted == frames) => break,
            Ok(Job::Finish) | Err(_) => return Err(FilmError::Stopped),
        }
        frames += 1;
    }
    sink.finish().map_err(named)?;
    drop(sink);
    cancel.check()?;
    staged.map_or(Ok(()), StagedFile::commit)
}

fn write_still(
    file: impl Write + std::io::Seek,
    still: Still,
    pixels: &Pixels,
    texels: TexelFormat,
    scene: Option<&Scene>,
) -> std::io::Result<()> {
    let mut out = BufWriter::new(file);
    still.write_scene(&mut out, pixels, texels, scene)?;
    out.flush()
}

/// Pictures that are written one by one, each to its own destination.
pub struct Stills {
    queue: Queue<(FrameDestination, Pixels)>,
}

enum FrameDestination {
    /// A file, with the scene that is saved in it.
    File(PathBuf, Option<Box<Scene>>),
    Pipe,
}

impl Stills {
    /// Starts writing pictures of `texels`, the first of which has about the given size. `pipe` takes those that are
    /// not written to files. `is_within`: the files are in a folder, under names that the user did not choose.
    pub fn start(
        still: Still,
        texels: TexelFormat,
        (width, height): (u32, u32),
        pipe: Option<Box<dyn Write + Send>>,
        is_within: bool,
    ) -> Result<Stills, FilmError> {
        let mut pipe = pipe.unwrap_or_else(|| Box::new(std::io::sink()));
        let work = move |jobs: Receiver<Job<(FrameDestination, Pixels)>>| {
            loop {
                match jobs.recv() {
                    Ok(Job::Next((FrameDestination::File(path, scene), pixels))) => {
                        let scene = scene.as_deref();
                        let name = path.file_name().unwrap_or_default().to_string_lossy();
                        let written = match path.parent().filter(|_| is_within) {
                            Some(folder) => {
                                write_into(folder, &name, |file| write_still(file, still, &pixels, texels, scene))
                            }
                            None => write_with(&path, |file| write_still(file, still, &pixels, texels, scene)),
                        };
                        written.map_err(FilmError::io(&path))?;
                    }
                    Ok(Job::Next((FrameDestination::Pipe, pixels))) => {
                        let mut bytes = Cursor::new(Vec::new());
                        let written = still.write(&mut bytes, &pixels, texels);
                        written.and_then(|()| pipe.write_all(&bytes.into_inner())).map_err(FilmError::pipe)?;
                    }
                    Ok(Job::Finish) => return pipe.flush().map_err(FilmError::pipe),
                    Err(_) => return Err(FilmError::Stopped),
                }
            }
        };
        Ok(Stills { queue: Queue::start(capacity(width, height), work)? })
    }

    /// Writes a picture atomically: an existing file stays until then. The error may be that of an earlier picture.
    pub fn push(&mut self, path: PathBuf, pixels: Pixels, scene: Option<Scene>) -> Result<(), FilmError> {
        self.queue.push(Job::Next((FrameDestination::File(path, scene.map(Box::new)), pixels)))
    }

    /// Does the same, or returns the picture if the queue is full.
    pub fn try_push(&mut self, path: PathBuf, pixels: Pixels) -> Result<Option<Pixels>, FilmError> {
        match self.queue.try_push(Job::Next((FrameDestination::File(path, None), pixels)))? {
            Some(Job::Next((_, pixels))) => Ok(Some(pixels)),
            _ => Ok(None),
        }
    }

    /// Writes a picture to the pipe.
    pub fn pipe(&mut self, pixels: Pixels) -> Result<(), FilmError> {
        self.queue.push(Job::Next((FrameDestination::Pipe, pixels)))
    }

    /// Waits until all pictures are written.
    pub fn finish(mut self) -> Result<(), FilmError> {
        self.queue.finish()
    }
}

#[cfg(test)]
mod tests;
