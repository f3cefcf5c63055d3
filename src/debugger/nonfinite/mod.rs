//! NaN and infinities come from one place: the pass, the frame, the texel and the line that makes the first.

mod search;
mod texels;

pub use search::{FirstNonfinite, NonfiniteOperation, SearchEnd, SearchJob, search};
pub use texels::{NonfiniteTexels, born, drawn, stored};
