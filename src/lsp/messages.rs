//! Responses to requests: results and errors.

use lsp_server::{ErrorCode, ResponseError};

/// The answer to a request: JSON, or an error.
pub(crate) type Answer = Result<serde_json::Value, ResponseError>;

/// Returns the error for a valid request that cannot be fulfilled; the text is shown to the user.
pub(crate) fn failed(message: impl Into<String>) -> ResponseError {
    error(ErrorCode::RequestFailed, message)
}

pub(crate) fn error(code: ErrorCode, message: impl Into<String>) -> ResponseError {
    ResponseError { code: code as i32, message: message.into(), data: None }
}

/// Returns a result as JSON.
pub(crate) fn answer(result: impl serde::Serialize) -> Answer {
    serde_json::to_value(result).map_err(|why| error(ErrorCode::InternalError, why.to_string()))
}
