//! Edits of passes are refused for these reasons.

use crate::project::{PassId, limits};

/// The reason why passes cannot be edited so.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum PassEditError {
    #[error("there is no {0}")]
    NoSuchPass(String),
    #[error("\"{0}\" cannot be a buffer's name: {rule}", rule = PassId::NAMES)]
    BadName(String),
    #[error("there is a {0} already; choose another name")]
    Taken(String),
    #[error("{0} keeps its name and its place; only buffers have others")]
    NotABuffer(String),
    #[error("Image is what a project shows; it cannot be removed")]
    Image,
    #[error("{0} is drawn with; take it out of eddy.toml instead")]
    Stage(String),
    #[error("{0} is included by the text of passes; take its #include line out instead")]
    Included(String),
    #[error("{pass} has no {what}; give a buffer this and show that")]
    NotHere { pass: String, what: &'static str },
    #[error("a size has a factor above 0, or at least one texel each way")]
    BadSize,
    #[error("a region has at least one texel each way")]
    BadRegion,
    #[error("a boundary is at least one texel wide")]
    BadBoundary,
    #[error("an expression is missing, as vec4(0.0)")]
    EmptyFill,
    #[error("\"{0}\" is not the name of a file in the project's folder")]
    BadFillFile(String),
    #[error("a buffer is drawn at least once a frame")]
    NoSteps,
    #[error("a frame would draw {0} passes and meshes with all their steps; the most is {most}", most = limits::DRAWS)]
    TooManyDraws(u64),
    #[error("{0} is the first buffer; there is none before it")]
    First(String),
}
