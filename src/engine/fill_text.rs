//! The text of a fill: a program of one expression, or of one picture.

use eddy_diag::{Diagnostic, SourceId, Span};
use eddy_glsl::{Include, Text};
use eddy_project::{FillText, FillValue};

/// An id that no text of a project has: errors in the wrapper of an expression are reported at the expression.
const AROUND: SourceId = SourceId::NONE;

const HEAD: &str = "void mainImage(out vec4 eddy_value, in vec2 fragCoord) { eddy_value = (\n";
const FOOT: &str = "\n); }\n";

/// A picture of the pass's own size is copied texel for texel.
const PICTURE: &str = "void mainImage(out vec4 value, in vec2 fragCoord) {
    bool same = textureSize(iChannel0, 0) == ivec2(iResolution.xy);
    value = same ? texelFetch(iChannel0, ivec2(fragCoord), 0) : texture(iChannel0, fragCoord / iResolution.xy);
}
";

/// The program of a fill. An expression is included into a wrapper, so that its spans are those of the manifest.
pub(super) struct FillSource {
    code: String,
    /// The manifest, blank except for the expression.
    expression: Option<String>,
    place: Span,
}

impl FillSource {
    pub(crate) fn new(value: &FillValue, written: &FillText) -> Self {
        let FillText { id, text, range } = written;
        let place = Span::new(*id, range.clone());
        let FillValue::Expression(_) = value else {
            return Self { code: PICTURE.into(), expression: None, place };
        };
        // Offsets stay those of the manifest, whose other contents are not GLSL.
        let blank: String = text[..range.start].bytes().map(|b| if b == b'\n' { '\n' } else { ' ' }).collect();
        let expression = format!("{blank}{}", &text[range.clone()]);
        Self { code: format!("{HEAD} {FOOT}"), expression: Some(expression), place }
    }

    pub(crate) fn code(&self) -> Text<'_> {
        Text { id: AROUND, text: &self.code }
    }

    /// The expression and the line that it replaces; `None` for a picture, which sees no text of the project.
    pub(crate) fn value(&self) -> Option<Include<'_>> {
        let text = Text { id: self.place.source, text: self.expression.as_ref()? };
        Some(Include { line: Span::new(AROUND, HEAD.len()..HEAD.len() + 1), text: Ok(text) })
    }

    /// Returns the compiler's diagnostics with spans for the author.
    pub(crate) fn relocated(&self, mut all: Vec<Diagnostic>) -> Vec<Diagnostic> {
        if self.expression.is_none() {
            return all;
        }
        // Errors in the wrapper that follow from an error in the expression are not reported.
        let own = all.iter().any(|d| d.is_error() && d.span.is_some_and(|s| s.source != AROUND));
        all.retain(|d| !own || d.span.is_none_or(|s| s.source != AROUND));
        let here = |span: &mut Span| {
            if span.source == AROUND {
                *span = self.place;
            }
        };
        for diagnostic in &mut all {
            diagnostic.span.iter_mut().chain(diagnostic.labels.iter_mut().map(|l| &mut l.span)).for_each(here);
        }
        all
    }
}
