//! Small pictures: of presets, which lie in the program and come alive under the pointer, of textures, of the first frames of
//! videos and of the waves of sounds. They are made in the background; of all but presets the newest are kept.

mod folder;
mod live;
mod made;

pub(super) use folder::FolderFile;

use crate::{gpu::Gpu, media::MediaKey, project::Media};
use egui::{ColorImage, TextureHandle, TextureOptions};
use live::Live;
use std::{
    collections::HashMap,
    panic::{AssertUnwindSafe, catch_unwind},
    path::{Path, PathBuf},
    sync::{
        Arc,
        mpsc::{Receiver, Sender, channel},
    },
    time::{Duration, Instant},
};

/// Pictures that are kept besides those of presets: at most 320x180 of 4 bytes a texel, most of them 96x96.
const KEPT: usize = 240;
/// A folder that is shown is listed again after this.
const LIST_AGAIN: Duration = Duration::from_secs(2);

/// The subject of a small picture.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub(super) enum ThumbnailSource {
    Preset(String),
    /// The file of a recent project's picture, and which of those that were written there it is.
    Recent(PathBuf, u64),
    /// A picture a channel can read; files lie relative to the folder.
    Texture(MediaKey, Option<PathBuf>),
    /// The first frame of a video.
    Video(Media, Option<PathBuf>),
    /// The wave of the first minute of a sound, in white.
    Sound(Media, Option<PathBuf>),
}

/// The state of a small picture.
#[derive(Clone)]
pub(super) enum Thumbnail {
    Waiting,
    Ready(TextureHandle),
    /// The reason why there is none.
    Failed(String),
}

pub(super) struct Thumbnails {
    known: HashMap<ThumbnailSource, CachedThumbnail>,
    wanted: Sender<ThumbnailRequest>,
    made: Receiver<ThumbnailResult>,
    live: Live,
    listed: Listed,
    /// Counts frames of the window.
    frame: u64,
}

struct CachedThumbnail {
    thumbnail: Thumbnail,
    /// The frame of the window that showed it last.
    shown_in: u64,
}

/// The folder that was listed last.
#[derive(Default)]
struct Listed {
    folder: PathBuf,
    files: Arc<[FolderFile]>,
    asked_at: Option<Instant>,
}

/// An order of the thread.
enum ThumbnailRequest {
    Picture(ThumbnailSource),
    Files(PathBuf),
}

enum ThumbnailResult {
    Picture(ThumbnailSource, Result<ColorImage, String>),
    Files(PathBuf, Vec<FolderFile>),
}

/// Returns the newest order, as what was scrolled away is not looked at. `None`: nobody asks any more.
fn newest(orders: &Receiver<ThumbnailRequest>, waiting: &mut Vec<ThumbnailRequest>) -> Option<ThumbnailRequest> {
    if waiting.is_empty() {
        waiting.push(orders.recv().ok()?);
    }
    waiting.extend(orders.try_iter());
    waiting.pop()
}

impl Thumbnails {
    /// Starts the thread that makes them. `wake` is called when there is a new one.
    pub(super) fn new(gpu: Gpu, wake: Arc<dyn Fn() + Send + Sync>) -> Self {
        let (wanted, wanted_here) = channel::<ThumbnailRequest>();
        let (made_here, made) = channel();
        let live = Live::new(gpu, wake.clone());
        let work = move || {
            let mut waiting = Vec::new();
            while let Some(wanted) = newest(&wanted_here, &mut waiting) {
                let made = match wanted {
                    ThumbnailRequest::Picture(subject) => {
                        // A panic is this picture's alone; the others are still wanted.
                        let image = catch_unwind(AssertUnwindSafe(|| made::make(&subject)));
                        ThumbnailResult::Picture(subject, image.unwrap_or_else(|_| Err("this is a bug in Eddy".into())))
                    }
                    ThumbnailRequest::Files(folder) => {
                        let files = folder::files(&folder);
                        ThumbnailResult::Files(folder, files)
                    }
                };
                if made_here.send(made).is_err() {
                    return;
                }
                wake();
            }
        };
        if let Err(e) = std::thread::Builder::new().name("thumbnails".into()).spawn(work) {
            // The cards then stay without pictures, which is all they lose.
            log::warn!("cannot start a thread for thumbnails: {e}");
        }
        Self { known: HashMap::new(), wanted, made, live, listed: Listed::default(), frame: 0 }
    }

    /// Takes in what has been made since.
    pub(super) fn update(&mut self, ctx: &egui::Context) {
        self.frame += 1;
        while let Ok(made) = self.made.try_recv() {
            match made {
                ThumbnailResult::Picture(subject, image) => {
                    let thumbnail = match image {
                        Ok(image) => {
                            Thumbnail::Ready(ctx.load_texture(format!("{subject:?}"), image, TextureOptions::LINEAR))
                        }
                        Err(e) => Thumbnail::Failed(e),
                    };
                    self.known.insert(subject, CachedThumbnail { thumbnail, shown_in: self.frame });
                }
                ThumbnailResult::Files(folder, files) if folder == self.listed.folder => {
                    self.listed.files = files.into()
                }
                ThumbnailResult::Files(..) => {}
            }
        }
        self.forget_the_oldest();
        self.live.update(ctx);
    }

    /// Says which preset's picture moves; none: all stand still.
    pub(super) fn animate(&mut self, name: Option<&str>) {
        self.live.want(name);
    }

    /// The newest frame of a preset's picture that moves.
    pub(super) fn live(&self, name: &str) -> Option<TextureHandle> {
        self.live.frame(name)
    }

    /// The picture, as far as it is known; asks for it the first time.
    pub(super) fn get(&mut self, subject: ThumbnailSource) -> Thumbnail {
        let shown_in = self.frame;
        if let Some(known) = self.known.get_mut(&subject) {
            known.shown_in = shown_in;
            return known.thumbnail.clone();
        }
        if self.wanted.send(ThumbnailRequest::Picture(subject.clone())).is_err() {
            let thumbnail = Thumbnail::Failed("the thumbnail thread has ended".into());
            self.known.insert(subject, CachedThumbnail { thumbnail, shown_in });
            return Thumbnail::Waiting;
        }
        // The picture that was there before has served.
        if let ThumbnailSource::Recent(file, _) = &subject {
            self.known.retain(|known, _| !matches!(known, ThumbnailSource::Recent(other, _) if other == file));
        }
        self.known.insert(subject, CachedThumbnail { thumbnail: Thumbnail::Waiting, shown_in });
        Thumbnail::Waiting
    }

    /// Returns the files of a project's folder that a channel can read, as far as they are known. The folder is listed again now
    /// and then while it is asked for.
    pub(super) fn files(&mut self, folder: &Path, now: Instant) -> Arc<[FolderFile]> {
        if self.listed.folder != folder {
            self.listed = Listed { folder: folder.to_owned(), ..Listed::default() };
        }
        let is_due = self.listed.asked_at.is_none_or(|at| now.saturating_duration_since(at) >= LIST_AGAIN);
        if is_due && self.wanted.send(ThumbnailRequest::Files(folder.to_owned())).is_ok() {
            self.listed.asked_at = Some(now);
        }
        self.listed.files.clone()
    }

    /// Forgets pictures that have not been shown for the longest time, where there are more than are kept.
    fn forget_the_oldest(&mut self) {
        let is_counted = |(subject, known): &(&ThumbnailSource, &CachedThumbnail)| {
            !matches!(subject, ThumbnailSource::Preset(_)) && !matches!(known.thumbnail, Thumbnail::Waiting)
        };
        let counted = self.known.iter().filter(is_counted);
        let mut shown: Vec<u64> = counted.map(|(_, known)| known.shown_in).collect();
        if shown.len() <= KEPT {
            return;
        }
        shown.sort_unstable();
        // What is shown now stays, however much it is.
        let newest_to_forget = shown[shown.len() - KEPT - 1].min(self.frame.saturating_sub(2));
        self.known.retain(|subject, known| !is_counted(&(subject, known)) || known.shown_in > newest_to_forget);
    }
}
