//! Hover, as Markdown, and the signature of the call at a position.

use super::{positions::Encoding, program::Program};
use eddy_diag::{SourceId, Span};
use gen_lsp_types::{
    ActiveParameter, Documentation, MarkupContent, MarkupKind, ParameterInformation, ParameterInformationLabel,
    SignatureHelp, SignatureInformation,
};

pub(crate) fn markdown(value: String) -> MarkupContent {
    MarkupContent { kind: MarkupKind::Markdown, value }
}

/// Returns the hover text at a position, and its range.
pub(crate) fn hover(program: &Program, id: SourceId, at: usize) -> Option<(MarkupContent, Span)> {
    let of_language = program.analysis(id).and_then(|analysis| analysis.hover(id, at));
    let uniform = program.programs(|programs| programs.uniform_lines(id, at));
    let here = uniform.iter().find(|span| span.source == id && span.range().contains(&at)).copied();
    let (mut text, span) = match (of_language, here) {
        (Some(hover), _) => {
            let mut text = String::new();
            if !hover.signature.is_empty() {
                text.push_str(&format!("```glsl\n{}\n```\n", hover.signature.join("\n")));
            }
            text.push_str(&format!("*{}*", hover.kind));
            if let Some(declared) = hover.declared.filter(|declared| declared.source != id) {
                let file = program.texts.get(declared.source).map_or("", |text| &text.name);
                text.push_str(&format!(" of {file}"));
            }
            if !hover.doc.is_empty() {
                // Keep line breaks of a comment.
                text.push_str(&format!("\n\n{}", hover.doc.replace('\n', "  \n")));
            }
            (text, hover.span)
        }
        (None, Some(span)) => ("*uniform*".to_owned(), span),
        (None, None) => return None,
    };
    if !uniform.is_empty()
        && let Some(said) = range_of(program, uniform[0])
    {
        text.push_str(&format!("\n\n{said}"));
    }
    Some((markdown(text), span))
}

/// Returns the type, range and value of a uniform that an `#iUniform` line declares.
fn range_of(program: &Program, line: Span) -> Option<String> {
    let project = program.project.as_ref()?;
    let name = &program.uniforms.iter().find(|(_, span)| *span == line)?.0;
    let declared = project.custom_uniforms();
    let uniform = declared.get(name)?;
    let value = uniform.value(&project.custom_uniform_values).glsl(uniform.ty);
    let is_set = project.custom_uniform_values.contains_key(name);
    let from = if is_set { "set in eddy.toml" } else { "the default" };
    Some(format!("`{} {name}` = `{value}`, {from}", uniform.ty.name()))
}

/// Returns the signatures of the call at a position. `by_offset`: the editor supports offsets into the label for
/// parameters.
pub(crate) fn signature(
    program: &Program,
    id: SourceId,
    at: usize,
    encoding: Encoding,
    by_offset: bool,
) -> Option<SignatureHelp> {
    let help = program.analysis(id)?.signature_help(id, at)?;
    let doc = (!help.doc.is_empty()).then(|| Documentation::MarkupContent(markdown(help.doc.clone())));
    let signatures = help.signatures.iter().map(|one| {
        let parameter = |range: &std::ops::Range<usize>| ParameterInformation {
            label: match by_offset {
                true => ParameterInformationLabel::Tuple((
                    encoding.len(&one.label[..range.start]),
                    encoding.len(&one.label[..range.end]),
                )),
                false => ParameterInformationLabel::String(one.label[range.clone()].to_owned()),
            },
            documentation: None,
        };
        SignatureInformation {
            label: one.label.clone(),
            documentation: doc.clone(),
            parameters: Some(one.params.iter().map(parameter).collect()),
            active_parameter: None,
        }
    });
    Some(SignatureHelp {
        signatures: signatures.collect(),
        active_signature: Some(help.active as u32),
        active_parameter: Some(ActiveParameter::Int(help.parameter as u32)),
    })
}
