//! Each service on valid and on invalid texts. A caret or a place is marked by `@`, which GLSL does not have.

mod complete;
mod names;
mod robust;
mod signature;

use super::Analysis;
use crate::{ChannelKind, PassKind, PassSource, Text};
use eddy_diag::{SourceId, Span};

const COMMON: SourceId = SourceId(0);
const CODE: SourceId = SourceId(1);

/// A text that follows a Common, one of them with a mark.
struct Marked {
    common: String,
    code: String,
    at: (SourceId, usize),
}

impl Marked {
    fn new(common: &str, code: &str) -> Self {
        let at = match common.find('@') {
            Some(at) => (COMMON, at),
            None => (CODE, code.find('@').expect("a mark")),
        };
        Self { common: common.replacen('@', "", 1), code: code.replacen('@', "", 1), at }
    }

    fn code(code: &str) -> Self {
        Self::new("", code)
    }

    fn analysis(&self) -> Analysis {
        Analysis::new(&PassSource {
            common: Some(Text { id: COMMON, text: &self.common }),
            channels: PassSource::channel_kinds([
                ChannelKind::Sampler2D,
                ChannelKind::SamplerCube,
                ChannelKind::Sampler3D,
                ChannelKind::Sampler2D,
            ]),
            ..PassSource::new(PassKind::Image, Text { id: CODE, text: &self.code })
        })
    }

    /// Returns the text of a span's line with the span in brackets.
    fn shown(&self, span: Span) -> String {
        let text = if span.source == COMMON { &self.common } else { &self.code };
        let start = text[..span.start as usize].rfind('\n').map_or(0, |i| i + 1);
        let end = text[span.end as usize..].find('\n').map_or(text.len(), |i| span.end as usize + i);
        let name = &text[span.range()];
        let around = (text[start..span.start as usize].trim_start(), text[span.end as usize..end].trim_end());
        format!("{}[{name}]{}", around.0, around.1)
    }
}
