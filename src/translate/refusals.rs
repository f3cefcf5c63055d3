//! Errors for features that a language cannot express, with the pass and, if known, the place in its text.

use eddy_diag::{Diagnostic, SourceMap, Span};
use eddy_glsl::naga;
use naga::ir::{Expression, Function, MathFunction, TypeInner};

use crate::{GlslVersion, Language};

/// Returns an error for code that a writer would write although no compiler of the language accepts it.
pub(crate) fn of_module(module: &naga::Module, language: Language, pass: &PassTexts<'_>) -> Option<Diagnostic> {
    let Language::Glsl(version) = language else { return None };
    let newer = GlslVersion::Desktop450.key();
    let hint = format!("write GLSL {newer} (--glsl-version {newer})");
    if version == GlslVersion::Es300 && has_arrays_of_arrays(module) {
        let message = format!("{} cannot be written as {language}, which has no arrays of arrays", pass.title);
        return Some(Diagnostic::error(None, message).hint(hint));
    }
    let missing = |e: &Expression| match later_function(e) {
        Some(name) if version != GlslVersion::Desktop450 => Some(name),
        _ if version.has_packing() => None,
        _ => packing(e),
    };
    let used = functions(module).find_map(|function| function.expressions.iter().find_map(|(_, e)| missing(e)))?;
    let message = format!("{} cannot be written as {language}, which has no `{used}`", pass.title);
    Some(Diagnostic::error(pass.word(used), message).hint(hint))
}

/// Returns whether a module has arrays of arrays, which came with GLSL ES 3.10 and extensions of desktop GLSL.
fn has_arrays_of_arrays(module: &naga::Module) -> bool {
    module.types.iter().any(|(_, ty)| match ty.inner {
        TypeInner::Array { base, .. } => matches!(module.types[base].inner, TypeInner::Array { .. }),
        _ => false,
    })
}

fn functions(module: &naga::Module) -> impl Iterator<Item = &Function> {
    module.functions.iter().map(|(_, f)| f).chain(module.entry_points.iter().map(|e| &e.function))
}

/// Returns the name of a function that packs numbers.
fn packing(expression: &Expression) -> Option<&'static str> {
    let Expression::Math { fun, .. } = expression else { return None };
    Some(match fun {
        MathFunction::Pack2x16snorm => "packSnorm2x16",
        MathFunction::Pack2x16unorm => "packUnorm2x16",
        MathFunction::Pack2x16float => "packHalf2x16",
        MathFunction::Unpack2x16snorm => "unpackSnorm2x16",
        MathFunction::Unpack2x16unorm => "unpackUnorm2x16",
        MathFunction::Unpack2x16float => "unpackHalf2x16",
        _ => return None,
    })
}

/// Returns the name of a function of GLSL 4.00 and later.
fn later_function(expression: &Expression) -> Option<&'static str> {
    let fun = match expression {
        Expression::Math { fun, .. } => fun,
        Expression::ImageSample { gather: Some(_), .. } => return Some("textureGather"),
        _ => return None,
    };
    Some(match fun {
        MathFunction::Pack4x8snorm => "packSnorm4x8",
        MathFunction::Pack4x8unorm => "packUnorm4x8",
        MathFunction::Unpack4x8snorm => "unpackSnorm4x8",
        MathFunction::Unpack4x8unorm => "unpackUnorm4x8",
        MathFunction::CountOneBits => "bitCount",
        MathFunction::ReverseBits => "bitfieldReverse",
        MathFunction::FirstTrailingBit => "findLSB",
        MathFunction::FirstLeadingBit => "findMSB",
        MathFunction::ExtractBits => "bitfieldExtract",
        MathFunction::InsertBits => "bitfieldInsert",
        _ => return None,
    })
}

/// Returns the error for a module that a writer rejects.
pub(crate) fn of_writer(language: Language, pass: &PassTexts<'_>, reason: &str) -> Diagnostic {
    let message = format!("{} cannot be written as {language}: {reason}", pass.title);
    Diagnostic::error(None, message).hint("the program itself is correct; translate to another language")
}

/// The texts in which a place can be.
pub(crate) struct PassTexts<'a> {
    /// The title of the pass.
    pub title: String,
    pub sources: &'a SourceMap,
    /// Its own texts first.
    pub texts: Vec<eddy_diag::SourceId>,
}

impl PassTexts<'_> {
    /// Returns the first use of a name in the texts outside of comments, whether it is reachable or not.
    fn word(&self, word: &str) -> Option<Span> {
        self.texts.iter().find_map(|&id| {
            let at = find_word(&self.sources.get(id)?.text, word)?;
            Some(Span::new(id, at..at + word.len()))
        })
    }
}

/// Returns the first byte of a name that is a whole word, outside of comments.
fn find_word(text: &str, word: &str) -> Option<usize> {
    let is_part = |c: char| c.is_alphanumeric() || c == '_';
    let mut from = 0;
    while from < text.len() {
        let rest = &text[from..];
        let end_of = |end: &str| rest.find(end).map_or(text.len(), |at| from + at + end.len());
        if rest.starts_with("//") {
            from = end_of("\n");
        } else if rest.starts_with("/*") {
            from = end_of("*/");
        } else if rest.starts_with(is_part) {
            let name = &rest[..rest.find(|c| !is_part(c)).unwrap_or(rest.len())];
            if name == word {
                return Some(from);
            }
            from += name.len();
        } else {
            from += rest.chars().next().map_or(1, char::len_utf8);
        }
    }
    None
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn whole_words_outside_comments_are_found() {
        let text = "// pack\n/* pack */ unpack packed pack_ ä pack(";
        assert_eq!(find_word(text, "pack"), text.rfind("pack"));
        assert_eq!(find_word("// pack", "pack"), None);
        assert_eq!(find_word("/* pack", "pack"), None);
    }
}
