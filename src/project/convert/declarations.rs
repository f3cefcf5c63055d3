//! Finds the declarations at file scope, without preprocessing the text: those of all conditional groups count.

use super::tokens::{Kind, Line, Token};
use std::ops::Range;

/// The declarations of a text.
#[derive(Debug, Default)]
pub(super) struct Declarations<'t> {
    pub interface: Vec<Interface<'t>>,
    pub globals: Vec<Global<'t>>,
    pub functions: Vec<Function<'t>>,
    /// The tokens between the braces of structures.
    pub structs: Vec<Range<usize>>,
    /// The tokens of default precisions of numbers.
    pub precisions: Vec<Range<usize>>,
    /// The tokens of declarations of nothing: a `;` alone.
    pub empty: Vec<usize>,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Storage {
    Uniform,
    /// `in`, `varying` or `attribute`.
    Input,
    Output,
}

/// A variable that is an input or an output of the shader.
#[derive(Clone, Debug)]
pub(super) struct Interface<'t> {
    pub storage: Storage,
    pub ty: &'t str,
    pub name: &'t str,
    pub is_array: bool,
    pub location: Option<u32>,
    /// The tokens of the declaration, with its `;`. Several variables may share one.
    pub declaration: Range<usize>,
    /// The tokens before the type.
    pub qualifiers: Range<usize>,
}

/// A variable at file scope that is neither an input nor an output.
#[derive(Clone, Debug)]
pub(super) struct Global<'t> {
    pub name: &'t str,
    /// The token `const`.
    pub constant: Option<usize>,
    /// The tokens of the initial value, after `=`.
    pub value: Option<Range<usize>>,
    /// The conditional lines that select it, by their indices: the first line of each group and those that follow it.
    pub conditions: Vec<Vec<usize>>,
}

#[derive(Clone, Debug)]
pub(super) struct Function<'t> {
    pub name: &'t str,
    /// The type of its value.
    pub result: String,
    /// The tokens of its body; empty for a prototype.
    pub body: Range<usize>,
}

const QUALIFIERS: [&str; 17] = [
    "highp",
    "mediump",
    "lowp",
    "flat",
    "smooth",
    "centroid",
    "noperspective",
    "invariant",
    "precise",
    "coherent",
    "restrict",
    "readonly",
    "writeonly",
    "const",
    "uniform",
    "in",
    "out",
];

/// The position of the reader, which each group of a conditional starts from.
#[derive(Clone, Default)]
struct State {
    /// The tokens of the current declaration.
    current: Vec<usize>,
    /// For each open brace, whether it is of the body of a function.
    braces: Vec<bool>,
    /// Open parentheses and brackets.
    open: usize,
    body: usize,
}

/// A conditional group.
struct Group {
    before: State,
    lines: Vec<usize>,
}

/// Returns the declarations at file scope.
pub(super) fn declarations<'t>(tokens: &[Token<'t>], lines: &[Line<'t>]) -> Declarations<'t> {
    let mut found = Declarations::default();
    structs(tokens, &mut found);
    let mut state = State::default();
    let mut groups: Vec<Group> = Vec::new();
    for (at, token) in tokens.iter().enumerate() {
        if let Some(line) = token.line {
            if lines[line].at == token.at || token.is("#") && tokens[at.saturating_sub(1)].line != Some(line) {
                conditional(line, lines[line].name, &mut state, &mut groups);
            }
            continue;
        }
        let is_outside = state.braces.is_empty() && state.open == 0;
        let is_in_body = state.braces.first() == Some(&true);
        match token.text {
            "(" | "[" => state.open += 1,
            ")" | "]" => state.open = state.open.saturating_sub(1),
            "{" => {
                let is_body = state.braces.is_empty()
                    && state.current.last().is_some_and(|&last| tokens[last].is(")"))
                    && !state.current.iter().any(|&i| tokens[i].is("="));
                if is_body {
                    state.body = at + 1;
                }
                state.braces.push(is_body);
            }
            "}" => {
                let is_end_of_body = state.braces.pop() == Some(true) && state.braces.is_empty();
                if is_end_of_body {
                    function(tokens, &state.current, state.body..at, &mut found);
                    state = State::default();
                    continue;
                }
            }
            ";" if is_outside => {
                match state.current.is_empty() {
                    true => found.empty.push(at),
                    false => declaration(tokens, &state.current, at, &groups, &mut found),
                }
                state.current.clear();
                continue;
            }
            _ => {}
        }
        if !is_in_body {
            state.current.push(at);
        }
    }
    found
}

fn conditional(line: usize, name: &str, state: &mut State, groups: &mut Vec<Group>) {
    match name {
        "if" | "ifdef" | "ifndef" => groups.push(Group { before: state.clone(), lines: vec![line] }),
        "else" | "elif" => {
            if let Some(group) = groups.last_mut() {
                *state = group.before.clone();
                group.lines.push(line);
            }
        }
        "endif" => drop(groups.pop()),
        _ => {}
    }
}

fn structs(tokens: &[Token<'_>], found: &mut Declarations<'_>) {
    let mut at = 0;
    while at < tokens.len() {
        if tokens[at].is("struct") {
            let start = tokens[at..].iter().take(3).position(|token| token.is("{"));
            let end = tokens[at..].iter().position(|token| token.is("}"));
            if let (Some(start), Some(end)) = (start, end) {
                found.structs.push(at + start..at + end);
                at += end;
            }
        }
        at += 1;
    }
}

fn function<'t>(tokens: &[Token<'t>], head: &[usize], body: Range<usize>, found: &mut Declarations<'t>) {
    let Some(open) = head.iter().position(|&i| tokens[i].is("(")) else { return };
    let Some((&name, before)) = head[..open].split_last() else { return };
    let words = before.iter().map(|&i| tokens[i]).filter(|token| !QUALIFIERS.contains(&token.text));
    let result: String = words.map(|token| token.text).collect();
    if tokens[name].is_word() && !result.is_empty() {
        found.functions.push(Function { name: tokens[name].text, result, body });
    }
}

/// Adds what a declaration that ends before the token `end` declares.
fn declaration<'t>(tokens: &[Token<'t>], own: &[usize], end: usize, groups: &[Group], found: &mut Declarations<'t>) {
    let mut storage = None;
    let mut constant = None;
    let (mut at, mut location) = (0, None);
    while let Some(token) = own.get(at).map(|&i| tokens[i]) {
        match token.text {
            "layout" => {
                let close = own[at..].iter().position(|&i| tokens[i].is(")")).unwrap_or(0);
                let items = &own[at..at + close];
                let named = items.iter().position(|&i| tokens[i].is("location")).map(|place| place + 2);
                location = named.and_then(|place| tokens[*items.get(place)?].text.parse().ok());
                at += close;
            }
            "uniform" => storage = Some(Storage::Uniform),
            "varying" | "attribute" | "in" => storage = Some(Storage::Input),
            "out" => storage = Some(Storage::Output),
            "const" => constant = Some(own[at]),
            // A name in later versions, where another word is the type.
            word if QUALIFIERS.contains(&word) => {}
            _ => break,
        }
        at += 1;
    }
    let Some(first) = own.get(at).map(|&i| tokens[i]).filter(Token::is_word) else { return };
    if first.is("precision") {
        if own.last().is_some_and(|&ty| matches!(tokens[ty].text, "float" | "int")) {
            found.precisions.push(own[0]..end + 1);
        }
        return;
    }
    let start = at;
    let mut ty = first.text;
    if first.is("struct") {
        ty = own.get(at + 1).map_or("", |&i| tokens[i].text);
        at = own.iter().rposition(|&i| tokens[i].is("}")).unwrap_or(own.len());
    } else if own.get(at + 1).is_some_and(|&i| tokens[i].is("{")) {
        // A block of uniforms.
        return;
    }
    at += 1;
    if own.get(at + 1).is_some_and(|&i| tokens[i].is("(")) {
        return function(tokens, &own[start..], end..end, found);
    }
    let mut nested = 0;
    let mut is_array_type = false;
    let mut names: Vec<(usize, bool, Option<Range<usize>>)> = Vec::new();
    let mut is_named = false;
    for &i in &own[at..] {
        match tokens[i].text {
            "[" if nested == 0 && !is_named => (is_array_type, nested) = (true, 1),
            "[" if nested == 0 && names.last().is_some_and(|name| name.2.is_none()) => {
                names.iter_mut().last().into_iter().for_each(|name| name.1 = true);
                nested += 1;
            }
            "(" | "[" | "{" => nested += 1,
            ")" | "]" | "}" => nested -= 1,
            "," if nested == 0 => {
                names.iter_mut().last().into_iter().for_each(|name| close(name, i));
                is_named = false;
            }
            "=" if nested == 0 => names.iter_mut().last().into_iter().for_each(|name| name.2 = Some(i + 1..0)),
            _ if nested == 0 && !is_named && tokens[i].kind == Kind::Word => {
                is_named = true;
                names.push((i, is_array_type, None));
            }
            _ => {}
        }
    }
    names.iter_mut().last().into_iter().for_each(|name| close(name, end));
    for (token, is_array, value) in names {
        let name = tokens[token].text;
        match storage {
            Some(storage) => found.interface.push(Interface {
                storage,
                ty,
                name,
                is_array,
                location,
                declaration: own[0]..end + 1,
                qualifiers: own[0]..own[start],
            }),
            None => {
                let conditions = groups.iter().map(|group| group.lines.clone()).collect();
                found.globals.push(Global { name, constant, value, conditions });
            }
        }
    }
}

fn close((_, _, value): &mut (usize, bool, Option<Range<usize>>), end: usize) {
    if let Some(value) = value.as_mut().filter(|value| value.end == 0) {
        value.end = end;
    }
}

#[cfg(test)]
mod tests {
    use super::{super::tokens::tokens, *};

    #[test]
    fn declarations_of_all_groups_are_found() {
        let text = "layout(location = 1) out vec4 a, b;\nuniform highp float c[3];\nstruct S { float x; } s;\n\
                    #ifdef A\nvec2 f(vec2 p) {\n#else\nvec2 f() {\n#endif\n  float l = 1.0; return l * vec2(1); }\n;\n\
                    #if B\nconst float k = g(1, 2), m;\n#elif C\nfloat n[2] = { 1.0, 2.0 };\n#endif\nfloat h(float x);\n\
                    precision highp float;\nuniform Block { float y; };";
        let (words, lines) = tokens(text);
        let found = declarations(&words, &lines);
        let inputs: Vec<_> = found.interface.iter().map(|i| (i.name, i.ty, i.is_array, i.location)).collect();
        assert_eq!(inputs, [("a", "vec4", false, Some(1)), ("b", "vec4", false, Some(1)), ("c", "float", true, None)]);
        let functions: Vec<_> = found.functions.iter().map(|f| (f.name, &*f.result, f.body.is_empty())).collect();
        assert_eq!(functions, [("f", "vec2", false), ("h", "float", true)]);
        let text_of = |range: &Range<usize>| &text[words[range.start].at..words[range.end].at];
        let globals: Vec<_> = found.globals.iter().map(|g| (g.name, g.value.as_ref().map(text_of))).collect();
        let expected = [("s", None), ("k", Some("g(1, 2)")), ("m", None), ("n", Some("{ 1.0, 2.0 }"))];
        assert_eq!(globals, expected);
        assert_eq!(found.globals[3].conditions, [[3, 4]]);
        assert_eq!((found.empty.len(), found.structs.len()), (1, 1));
    }
}
