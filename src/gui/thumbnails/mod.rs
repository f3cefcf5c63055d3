//! Thumbnails of presets, which are built in and move below the pointer, of textures, of the first frames of videos
//! and of the waveforms of sounds. They are made in the background; except for those of presets, only the most recent
//! are kept.

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

/// The number of thumbnails kept in addition to those of presets: at most 320x180 of 4 bytes a texel, most of them
/// 96x96.
const KEPT: usize = 240;
/// A folder that is shown is listed again after this time.
const LIST_AGAIN: Duration = Duration::from_secs(2);

/// The subject of a thumbnail.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub(super) enum ThumbnailSource {
    Preset(String),
    /// The file of a recent project's picture, and its version.
    Recent(PathBuf, u64),
    /// A picture that a channel can read; paths are relative to the folder.
    Texture(MediaKey, Option<PathBuf>),
    /// The first frame of a video.
    Video(Media, Option<PathBuf>),
    /// The waveform of the first minute of a sound, in white.
    Sound(Media, Option<PathBuf>),
}

/// The state of a thumbnail.
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
    /// The last frame of the window that showed it.
    shown_in: u64,
}

/// The folder that was listed last.
#[derive(Default)]
struct Listed {
    folder: PathBuf,
    files: Arc<[FolderFile]>,
    asked_at: Option<Instant>,
}

/// A request to the thread.
enum ThumbnailRequest {
    Picture(ThumbnailSource),
    Files(PathBuf),
}

enum ThumbnailResult {
    Picture(ThumbnailSource, Result<ColorImage, String>),
    Files(PathBuf, Vec<FolderFile>),
}

/// Returns the newest request first, because older ones may be scrolled out of view. Returns `None` if the window is
/// gone.
fn newest(orders: &Receiver<ThumbnailRequest>, waiting: &mut Vec<ThumbnailRequest>) -> Option<ThumbnailRequest> {
    if waiting.is_empty() {
        waiting.push(orders.recv().ok()?);
    }
    waiting.extend(orders.try_iter());
    waiting.pop()
}

impl Thumbnails {
    /// Starts the thread that makes them. `wake` is called when a new one is ready.
    pub(super) fn new(gpu: Gpu, wake: Arc<dyn Fn() + Send + Sync>) -> Self {
        let (wanted, wanted_here) = channel::<ThumbnailRequest>();
        let (made_here, made) = channel();
        let live = Live::new(gpu, wake.clone());
        let work = move || {
            let mut waiting = Vec::new();
            while let Some(wanted) = newest(&wanted_here, &mut waiting) {
                let made = match wanted {
                    ThumbnailRequest::Picture(subject) => {
                        // A panic only affects this picture; the others are still needed.
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
            // The cards then have no pictures, which is the only loss.
            log::warn!("cannot start a thread for thumbnails: {e}");
        }
        Self { known: HashMap::new(), wanted, made, live, listed: Listed::default(), frame: 0 }
    }

    /// Takes over the thumbnails that were made since the last call.
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
        self.evict_oldest();
        self.live.update(ctx);
    }

    /// Sets which preset's picture moves; `None`: none does.
    pub(super) fn animate(&mut self, name: Option<&str>) {
        self.live.want(name);
    }

    /// Returns the newest frame of a preset's picture that moves.
    pub(super) fn live(&self, name: &str) -> Option<TextureHandle> {
        self.live.frame(name)
    }

    /// Returns the thumbnail in its current state; requests it the first time.
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
        // Drop the previous version of the picture.
        if let ThumbnailSource::Recent(file, _) = &subject {
            self.known.retain(|known, _| !matches!(known, ThumbnailSource::Recent(other, _) if other == file));
        }
        self.known.insert(subject, CachedThumbnail { thumbnail: Thumbnail::Waiting, shown_in });
        Thumbnail::Waiting
    }

    /// Returns the files of a project's folder that a channel can read, as far as they are known. The folder is listed
    /// again at intervals while this is called.
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

    /// Drops the least recently shown thumbnails if there are more than are kept.
    fn evict_oldest(&mut self) {
        let is_counted = |(subject, known): &(&ThumbnailSource, &CachedThumbnail)| {
            !matches!(subject, ThumbnailSource::Preset(_)) && !matches!(known.thumbnail, Thumbnail::Waiting)
        };
        let counted = self.known.iter().filter(is_counted);
        let mut shown: Vec<u64> = counted.map(|(_, known)| known.shown_in).collect();
        if shown.len() <= KEPT {
            return;
        }
        shown.sort_unstable();
        // Visible ones are kept, however many there are.
        let newest_to_forget = shown[shown.len() - KEPT - 1].min(self.frame.saturating_sub(2));
        self.known.retain(|subject, known| !is_counted(&(subject, known)) || known.shown_in > newest_to_forget);
    }
}
