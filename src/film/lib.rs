//! Writers for pictures and films: the features of each format, and the writers of all of them.
//!
//! A [`Style`] is the user's request; [`Style::resolve`] turns it into an [`Encoding`] or returns the reason why it is
//! not possible. [`Film`] takes frames in order, [`Stills`] takes pictures with their paths, and [`StripWriter`] takes
//! one picture in strips of rows. Each encodes on a thread of its own that is fed by a bounded queue, so that drawing
//! continues meanwhile and memory does not grow. Files are written next to their destination and moved there when they
//! are complete. H.264 and similar codecs are encoded by ffmpeg (`eddy_video::Encoder`); PNG, APNG, EXR, npy, Y4M and
//! raw frames are written here. The sound of a film ([`soundtrack`]) and the joint of a loop ([`Seam`]) are made from
//! further runs of the project. This package knows no front end and reads no clock.

mod apng;
mod coded;
mod error;
mod formats;
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
