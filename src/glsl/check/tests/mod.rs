//! Tests of the checker with tables of small programs, by section of the specification, and with folders of real ones.

mod corpus;
mod dialects;
mod given;
mod later;
mod later_syntax;
mod names;
mod nesting;
mod promises;
mod robust;
mod spec;

use super::{Checked, check};
use crate::{ChannelKind, PassKind, PassSource, Text, parse};
use eddy_diag::{SourceId, SourceMap, render_all};

/// Parses and checks a single pass; returns the rendered messages of the parser and the checker, and whether one is an
/// error.
fn checked(kind: PassKind, channels: [ChannelKind; 4], common: Option<&str>, code: &str) -> (Checked, bool, String) {
    let mut sources = SourceMap::default();
    let common = common.map(|text| Text { id: sources.add("common.glsl", text), text });
    let id: SourceId = sources.add("image.glsl", code);
    let channels = PassSource::channel_kinds(channels);
    let source = PassSource { common, channels, ..PassSource::new(kind, Text { id, text: code }) };
    let parsed = parse::parse(&source, None);
    let checked = check(&parsed.ast, &parsed.origins, &parsed.names, &source, None);
    let all: Vec<_> = parsed.report.diagnostics.iter().chain(&checked.diagnostics).cloned().collect();
    let failed = all.iter().any(|d| d.is_error());
    if !failed {
        promises::assert_kept(&checked.module);
    }
    let text = render_all(&all, &sources);
    (checked, failed, text)
}
