//! The source of NaN and infinities: the pass, the frame, the texel and the line that produces the first.

mod search;
mod texels;

pub use search::{FirstNonfinite, NonfiniteOperation, SearchEnd, SearchJob, search};
pub use texels::{NonfiniteTexels, drawn_passes, find_origin, stored_components};
