//! The names of the pictures of a run.

/// Digits of a frame's number in a name, more where the last frame needs more.
const LEAST_DIGITS: usize = 4;

/// Returns the name of a picture of a run whose last picture is of the frame `last`. Names in their order are frames in
/// theirs: numbers have as many digits as the last one needs.
pub fn picture_name(stem: &str, frame: u32, last: u32, extension: &str) -> String {
    let digits = last.to_string().len().max(LEAST_DIGITS);
    format!("{stem}_{frame:0digits$}.{extension}")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_have_the_order_of_their_frames() {
        assert_eq!(picture_name("a", 7, 60, "png"), "a_0007.png");
        assert_eq!(picture_name("a", 7, 123_456, "exr"), "a_000007.exr");
    }
}
