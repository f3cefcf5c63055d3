//! The JSON header of an ISF file.

use crate::limits;
use eddy_diag::{Diagnostic, SourceId, Span};
use serde_json::{Map, Value};

/// The metadata of an ISF file.
#[derive(Debug, Default)]
pub(super) struct Header {
    pub description: String,
    pub credit: String,
    pub categories: Vec<String>,
    pub inputs: Vec<IsfInput>,
    pub passes: Vec<IsfPass>,
    pub imported: Vec<Imported>,
    /// Warnings about syntax that some hosts reject.
    pub warnings: Vec<Diagnostic>,
}

#[derive(Debug)]
pub(super) struct IsfInput {
    pub name: String,
    pub label: String,
    pub kind: Kind,
    /// One number per component; empty if the file has no default.
    pub default: Vec<f64>,
    pub min: Vec<f64>,
    pub max: Vec<f64>,
    /// The allowed values of a `long`, in file order.
    pub values: Vec<f64>,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Kind {
    Event,
    Bool,
    Long,
    Float,
    Point2D,
    Color,
    Image,
    Cube,
    Audio,
    AudioFft,
}

impl Kind {
    /// The names of types. `cube` is of hosts by Vidvox, `int` of MadMapper.
    pub(super) const ALL: [(&str, Kind); 11] = [
        ("event", Kind::Event),
        ("bool", Kind::Bool),
        ("long", Kind::Long),
        ("float", Kind::Float),
        ("point2D", Kind::Point2D),
        ("color", Kind::Color),
        ("int", Kind::Long),
        ("image", Kind::Image),
        ("cube", Kind::Cube),
        ("audio", Kind::Audio),
        ("audioFFT", Kind::AudioFft),
    ];

    /// Returns whether it is a picture rather than a uniform.
    pub(super) fn is_image(self) -> bool {
        matches!(self, Kind::Image | Kind::Cube | Kind::Audio | Kind::AudioFft)
    }
}

#[derive(Debug, Default)]
pub(super) struct IsfPass {
    /// The buffer that it draws; empty if it draws the picture.
    pub target: String,
    pub is_float: bool,
    pub width: Option<String>,
    pub height: Option<String>,
}

#[derive(Debug)]
pub(super) struct Imported {
    pub name: String,
    /// The file; `None` if a built-in texture replaces it.
    pub path: Option<String>,
    /// It is a cubemap of six files.
    pub is_cube: bool,
}

/// Parses the header, whose byte 0 is at `start` of a text. Returns the errors, each with its span.
pub(super) fn parse(json: &str, (id, start): (SourceId, usize)) -> Result<Header, Vec<Diagnostic>> {
    let whole = Span::new(id, start..start + json.len());
    if json.len() as u64 > limits::ISF_HEADER.bytes {
        let message = format!("the header is larger than {}, the limit", limits::in_bytes(limits::ISF_HEADER.bytes));
        return Err(vec![Diagnostic::error(whole, message)]);
    }
    let commas = trailing_commas(json);
    let mut plain = json.as_bytes().to_vec();
    commas.iter().for_each(|&at| plain[at] = b' ');
    let object: Map<String, Value> = serde_json::from_slice(&plain).map_err(|error| {
        let before: usize = json.split_inclusive('\n').take(error.line().saturating_sub(1)).map(str::len).sum();
        let at = (before + error.column().saturating_sub(1)).min(json.len());
        let at = (0..=at).rev().find(|&at| json.is_char_boundary(at)).unwrap_or(0);
        let why = error.to_string();
        let why = why.split(" at line").next().unwrap_or_default();
        let message = format!("the JSON object of the ISF file cannot be read: {why}");
        vec![Diagnostic::error(Span::new(id, start + at..start + at), message).hint("fix the JSON at this place")]
    })?;
    let mut reader = Reader { json, id, start, found: Vec::new() };
    let mut header = reader.header(&object);
    if let Some(&at) = commas.first() {
        let message = "a comma before a closing bracket is not JSON: some ISF hosts refuse the file";
        let place = Span::new(id, start + at..start + at + 1);
        header.warnings.push(Diagnostic::warning(place, message).hint("remove the comma"));
    }
    let written = |key: &str| match object.get(key) {
        Some(Value::Array(all)) => all.len(),
        Some(Value::Object(all)) => all.len(),
        _ => 0,
    };
    for (count, most, of) in [
        (written("PASSES"), limits::PASSES, "passes"),
        (written("INPUTS"), limits::UNIFORMS, "inputs"),
        (written("IMPORTED"), limits::PASSES, "imported images"),
    ] {
        if count > most {
            let message = format!("the ISF file has {count} {of}: at most {most} are read");
            reader.found.push(Diagnostic::error(whole, message).hint("remove some of them"));
        }
    }
    if reader.found.iter().any(Diagnostic::is_error) {
        return Err(reader.found);
    }
    header.warnings.append(&mut reader.found);
    Ok(header)
}

/// Returns the offsets of trailing commas outside strings, before the end of an object or a list.
fn trailing_commas(json: &str) -> Vec<usize> {
    let bytes = json.as_bytes();
    let (mut found, mut last) = (Vec::new(), None);
    let (mut at, mut is_text) = (0, false);
    while let Some(&byte) = bytes.get(at) {
        match byte {
            b'\\' if is_text => at += 1,
            b'"' => is_text = !is_text,
            _ => {}
        }
        if !is_text && !byte.is_ascii_whitespace() {
            if matches!(byte, b'}' | b']') {
                found.extend(last);
            }
            last = (byte == b',' && ends_with_value(&bytes[..at])).then_some(at);
        }
        at += 1;
    }
    found
}

/// Returns whether a text ends with a complete value.
fn ends_with_value(before: &[u8]) -> bool {
    before.iter().rev().find(|byte| !byte.is_ascii_whitespace()).is_some_and(|byte| !b"[{,:".contains(byte))
}

/// The limit for categories that are read.
const CATEGORIES: usize = 1_000;
/// The limit for reported errors of a header.
const ERRORS: usize = 100;

struct Reader<'t> {
    json: &'t str,
    id: SourceId,
    start: usize,
    found: Vec<Diagnostic>,
}

impl Reader<'_> {
    fn header(&mut self, object: &Map<String, Value>) -> Header {
        // One more than the limit is enough to report that there are too many.
        let list = |key: &str, most: usize| {
            let all = object.get(key).and_then(Value::as_array).map_or(&[][..], Vec::as_slice);
            &all[..all.len().min(most + 1)]
        };
        Header {
            description: text(object.get("DESCRIPTION")),
            credit: text(object.get("CREDIT")),
            categories: list("CATEGORIES", CATEGORIES).iter().filter_map(Value::as_str).map(str::to_owned).collect(),
            inputs: list("INPUTS", limits::UNIFORMS)
                .iter()
                .filter_map(|input| self.input(input.as_object()?))
                .collect(),
            passes: list("PASSES", limits::PASSES).iter().filter_map(Value::as_object).map(pass).collect(),
            imported: self.imported(object.get("IMPORTED")),
            warnings: Vec::new(),
        }
    }

    fn error(&mut self, at: &str, message: String, hint: impl Into<String>) {
        self.report(at, |span| Diagnostic::error(span, message).hint(hint));
    }

    fn warning(&mut self, at: &str, message: String, hint: impl Into<String>) {
        self.report(at, |span| Diagnostic::warning(span, message).hint(hint));
    }

    fn report(&mut self, at: &str, diagnostic: impl FnOnce(Span) -> Diagnostic) {
        // Each report searches the header.
        if self.found.len() >= ERRORS {
            return;
        }
        let place = self.json.find(&format!("\"{at}\"")).map_or(0..0, |i| i..i + at.len() + 2);
        let span = Span::new(self.id, self.start + place.start..self.start + place.end);
        self.found.push(diagnostic(span));
    }

    fn input(&mut self, input: &Map<String, Value>) -> Option<IsfInput> {
        let (name, kind) = (text(input.get("NAME")), text(input.get("TYPE")));
        if !is_name(&name) {
            self.error(&name, format!("\"{name}\" is not a name of an input"), "use letters, digits and _");
            return None;
        }
        let Some((_, kind)) = Kind::ALL.into_iter().find(|(known, _)| known.eq_ignore_ascii_case(&kind)) else {
            let known = Kind::ALL.map(|(known, _)| known).join(", ");
            self.error(
                &kind,
                format!("the input \"{name}\" has the unknown type \"{kind}\""),
                format!("use one of {known}"),
            );
            return None;
        };
        let numbers = |key: &str| input.get(key).map(numbers).unwrap_or_default();
        let label = text(input.get("LABEL"));
        Some(IsfInput {
            label: if label.is_empty() { String::new() } else { label.replace(['\n', '\r'], " ") },
            kind,
            default: numbers("DEFAULT"),
            min: numbers("MIN"),
            max: numbers("MAX"),
            values: numbers("VALUES"),
            name,
        })
    }

    /// Version 2 has an object of names and files; some converters write a list of objects with names.
    fn imported(&mut self, value: Option<&Value>) -> Vec<Imported> {
        let mut all = Vec::new();
        let mut add = |reader: &mut Self, name: String, file: &Value| {
            let path = file.get("PATH").unwrap_or(&Value::Null);
            if !is_name(&name) {
                reader.error(&name, format!("\"{name}\" is not a name of an image"), "use letters, digits and _");
            } else if let Some(path) = path.as_str() {
                all.push(Imported { name, path: Some(path.to_owned()), is_cube: false });
            } else {
                let is_cube = path.is_array();
                let (message, hint) = match is_cube {
                    true => ("is a cubemap of several files", "choose a cubemap for it in the channels of the window"),
                    false => ("has no PATH", "give the PATH of an image file; a TARGET needs no import"),
                };
                let message = format!("the imported image \"{name}\" {message}: a built-in one replaces it");
                reader.warning(&name, message, hint);
                all.push(Imported { name, path: None, is_cube });
            }
        };
        match value {
            Some(Value::Object(files)) => {
                files.iter().take(limits::PASSES + 1).for_each(|(name, file)| add(self, name.clone(), file))
            }
            Some(Value::Array(files)) => {
                files.iter().take(limits::PASSES + 1).for_each(|file| add(self, text(file.get("NAME")), file))
            }
            _ => {}
        }
        all
    }
}

/// Returns whether a name is a GLSL identifier.
pub(super) fn is_name(name: &str) -> bool {
    let mut letters = name.chars();
    letters.next().is_some_and(|c| c.is_ascii_alphabetic() || c == '_')
        && letters.all(|c| c.is_ascii_alphanumeric() || c == '_')
}

fn pass(pass: &Map<String, Value>) -> IsfPass {
    let is_set = |key: &str| match pass.get(key) {
        Some(Value::Bool(on)) => *on,
        Some(Value::Number(n)) => n.as_f64().is_some_and(|n| n > 0.0),
        Some(Value::String(text)) => text.eq_ignore_ascii_case("true") || text.parse::<f64>().is_ok_and(|n| n > 0.0),
        _ => false,
    };
    let size = |key: &str| match pass.get(key) {
        Some(Value::String(text)) if !text.trim().is_empty() => Some(text.clone()),
        Some(Value::Number(n)) => Some(n.to_string()),
        _ => None,
    };
    IsfPass {
        target: text(pass.get("TARGET")),
        is_float: is_set("FLOAT"),
        width: size("WIDTH"),
        height: size("HEIGHT"),
    }
}

fn text(value: Option<&Value>) -> String {
    value.and_then(Value::as_str).unwrap_or_default().trim().to_owned()
}

/// Returns the components of a value: a number, or a list; `true` is 1.
fn numbers(value: &Value) -> Vec<f64> {
    match value {
        Value::Bool(on) => vec![f64::from(u8::from(*on))],
        Value::Number(n) => n.as_f64().into_iter().collect(),
        Value::String(text) => text.trim().parse().into_iter().collect(),
        Value::Array(all) => all.iter().flat_map(numbers).collect(),
        Value::Null | Value::Object(_) => Vec::new(),
    }
}
