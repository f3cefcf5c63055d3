//! Edits of passes are refused for these reasons.

use crate::{PassId, limits};

/// The reason why passes cannot be edited so.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum PassEditError {
    #[error("there is no {0}")]
    NoSuchPass(String),
    #[error("\"{0}\" is not a valid buffer name: {rule}", rule = PassId::NAMES)]
    BadName(String),
    #[error("there is a {0} already; choose another name")]
    Taken(String),
    #[error("{0} cannot be renamed or moved; only buffers can")]
    NotABuffer(String),
    #[error("Image cannot be removed")]
    Image,
    #[error("{0} is used by a draw; remove it in eddy.toml instead")]
    Stage(String),
    #[error("{0} is included by passes; remove its #include line instead")]
    Included(String),
    #[error("{pass} has no {what}; set it on a buffer and show that buffer")]
    NotHere { pass: String, what: &'static str },
    #[error("a size needs a factor above 0, or at least one texel in each direction")]
    BadSize,
    #[error("a region needs at least one texel in each direction")]
    BadRegion,
    #[error("a boundary is at least one texel wide")]
    BadBoundary,
    #[error("the expression is missing; for example vec4(0.0)")]
    EmptyFill,
    #[error("\"{0}\" is not the name of a file in the project's folder")]
    BadFillFile(String),
    #[error("a buffer is drawn at least once per frame")]
    NoSteps,
    #[error("a frame would draw {0} passes and meshes with all their steps; the limit is {most}", most = limits::DRAWS)]
    TooManyDraws(u64),
    #[error("{0} is the first buffer; there is none before it")]
    First(String),
}
