//! Pictures and films leave Eddy as files: what a format can hold, and the writers of all of them.
//!
//! A [`Style`] is what somebody asks for; [`Style::resolve`] makes an [`Encoding`] of it or says why that cannot be. [`Film`]
//! takes frames in their order, [`Stills`] takes pictures with their paths, and [`StripWriter`] takes one picture in strips of
//! rows. All encode on a thread of their own behind a
//! bounded queue, so that drawing goes on meanwhile and memory does not grow. Files are written beside their place and take it
//! when they are complete. H.264 and the like are encoded by ffmpeg (`eddy_video::Encoder`); PNG, APNG, EXR, npy, Y4M and raw
//! frames are written here. The sound of a film ([`soundtrack`]) and the joint of a loop ([`Seam`]) are made of further runs
//! of the project. Knows no front end and reads no clock.

mod apng;
mod coded;
mod error;
mod gif;
mod mean;
mod moments;
mod names;
mod pipe;
mod queue;
mod rate;
mod rgb;
mod seam;
mod sound_pass;
mod soundtrack;
mod still;
mod strips;
mod style;
mod values;
mod writer;
mod yuv;

pub use error::FilmError;
pub use mean::{Mean, shrunk};
pub use moments::{Moment, soundtrack_of, speed};
pub use names::picture_name;
pub use queue::{Cancel, Film, Output, Shape, Stills};
pub use rate::Rate;
pub use seam::{Fade, Seam, ShownPass};
pub use sound_pass::SoundPass;
pub use soundtrack::{FilmTime, has_sound, music, soundtrack};
pub use still::Still;
pub use strips::StripWriter;
pub use style::{Encoding, FilmEncoding, Style, check_encoders, check_size, check_tools};
pub use values::{Chroma, Codec, ColorRange, Format, Quality};
pub use writer::{Destination, FilmSound, Writer};
