//! The file names of a run's pictures.

/// The minimum number of digits of a frame number in a name.
const LEAST_DIGITS: usize = 4;

/// Returns the file name of a picture in a run whose last frame is `last`. Numbers are padded to the digits of the last
/// one, so that names sort in the order of frames.
pub fn picture_name(stem: &str, frame: u32, last: u32, extension: &str) -> String {
    let digits = last.to_string().len().max(LEAST_DIGITS);
    format!("{stem}_{frame:0digits$}.{extension}")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_sort_in_frame_order() {
        assert_eq!(picture_name("a", 7, 60, "png"), "a_0007.png");
        assert_eq!(picture_name("a", 7, 123_456, "exr"), "a_000007.exr");
    }
}
