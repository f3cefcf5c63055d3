//! Runs of frames: scripted or recorded input, drawn again, measured, compared and written to files.
//!
//! Owns input scripts ([`script`]) and recordings ([`recording`]), the offline run ([`offline`]) that `eddy render`,
//! `eddy bench` and the tests use, assertions about the texels of passes ([`assertion`]), comparison with another version
//! of a project ([`comparing`], [`revision`]), pictures on disk ([`capture`], [`npy`]) and those that embed their
//! project ([`scene`]), states of runs on disk ([`checkpoint`]), and which frames of a run a machine draws ([`frames`],
//! [`shard`]). Needs no session; time is an argument.

pub mod assertion;
pub mod capture;
pub mod checkpoint;
pub mod comparing;
pub mod counting;
pub mod date;
pub mod frames;
pub mod mouse;
pub mod npy;
pub mod offline;
pub mod prices;
pub mod recording;
pub mod revision;
pub mod run;
pub mod scene;
pub mod script;
pub mod shard;
pub mod tiles;
pub mod trial;
mod usage;

/// Returns the median of values, the upper of the middle two; `None` if there are none.
pub fn median(mut values: Vec<f64>) -> Option<f64> {
    values.sort_by(f64::total_cmp);
    values.get(values.len() / 2).copied()
}

#[cfg(test)]
mod tests {
    #[test]
    fn median_is_the_middle_value() {
        assert_eq!(super::median(vec![3.0, 1.0, 2.0]), Some(2.0));
        assert_eq!(super::median(vec![2.0, 1.0]), Some(2.0));
        assert_eq!(super::median(vec![]), None);
    }
}
