//! The keys of `eddy.toml` that fill texels from outside a pass's own program: `initial` and `boundary`.

use super::{edit::set, reader::Reader};
use crate::{Body, Boundary, Fill, FillValue, PassName, PassSettings, Written};
use std::path::PathBuf;
use toml_edit::{InlineTable, Item, TableLike, Value};

/// The keys of a pass's table that this module reads.
pub(super) const KEYS: [&str; 2] = ["initial", "boundary"];

const FORM: &str = "a GLSL expression in quotes (\"vec4(0.5)\") or { file = \"state.npy\" }";

impl Reader<'_> {
    /// Reads both keys into `settings`.
    pub(super) fn fills(&mut self, id: &PassName, table: &dyn TableLike, body: &Body, settings: &mut PassSettings) {
        for key in KEYS {
            let Some(item) = table.get(key) else { continue };
            let cleared = || body.is_cleared().then_some("a pass that draws meshes is cleared in every frame");
            let Some(why) = id.row().refusal(key).or_else(cleared) else { continue };
            self.error(item.span(), format!("{} has no {key}", id.title()), why);
            return;
        }
        if let Some(item) = table.get("initial") {
            settings.initial = self.fill("initial", item);
        }
        let Some(item) = table.get("boundary") else { return };
        let Some(boundary) = self.table("boundary", item) else { return };
        self.check_keys("boundary", boundary, &[&["width", "value"]]);
        let width = match boundary.get("width") {
            None => Some(1),
            Some(width) => {
                let number = width.as_integer().and_then(|n| u32::try_from(n).ok()).filter(|n| *n > 0);
                if number.is_none() {
                    self.wrong_type("width", width, "a whole number of texels above 0");
                }
                number
            }
        };
        let value = match boundary.get("value") {
            Some(value) => self.fill("value", value),
            None => {
                let hint = "write value = \"vec4(0.0)\"";
                self.error(item.span(), "boundary has no value for its texels", hint);
                None
            }
        };
        settings.boundary = width.zip(value).map(|(width, value)| Boundary { width, value });
    }

    fn fill(&mut self, key: &str, item: &Item) -> Option<Fill> {
        let value = match item.as_str() {
            Some(text) if text.trim().is_empty() => {
                self.error(item.span(), format!("{key} is empty"), format!("write {FORM}"));
                return None;
            }
            Some(text) => FillValue::Expression(text.into()),
            None => {
                let Some(table) = item.as_table_like() else {
                    self.wrong_type(key, item, FORM);
                    return None;
                };
                self.check_keys(key, table, &[&["file"]]);
                if !table.contains_key("file") {
                    self.error(item.span(), format!("{key} has no file"), format!("write {FORM}"));
                }
                FillValue::File(PathBuf::from(self.string(table, "file")?))
            }
        };
        let written = self.span_text(item).map(|(manifest, range)| Written { manifest, range });
        Some(Fill { value, written })
    }
}

pub(super) fn write_fills(table: &mut dyn TableLike, settings: &PassSettings) {
    let read = |table: &dyn TableLike| {
        super::reader::silent(|reader| {
            let mut read = PassSettings::default();
            reader.fills(&PassName::buffer(""), table, &Body::Screen, &mut read);
            read
        })
    };
    let old = read(table).unwrap_or_default();
    if old.initial != settings.initial {
        set(table, "initial", settings.initial.as_ref().map(value));
    }
    if old.boundary != settings.boundary {
        let boundary = settings.boundary.as_ref().map(|boundary| {
            let mut inline = InlineTable::new();
            inline.insert("width", i64::from(boundary.width).into());
            inline.insert("value", value(&boundary.value));
            Value::InlineTable(inline)
        });
        // A table with its own heading cannot be replaced in place.
        table.remove("boundary");
        set(table, "boundary", boundary);
    }
    if table.get("initial").is_some() && settings.initial.is_none() {
        table.remove("initial");
    }
    if table.get("boundary").is_some() && settings.boundary.is_none() {
        table.remove("boundary");
    }
}

fn value(fill: &Fill) -> Value {
    match &fill.value {
        FillValue::Expression(text) => Value::from(&**text),
        FillValue::File(path) | FillValue::InMemory { name: path, .. } => {
            // Every system understands forward slashes.
            let path = path.to_string_lossy();
            let path = if cfg!(windows) { path.replace('\\', "/") } else { path.into_owned() };
            let mut table = InlineTable::new();
            table.insert("file", path.into());
            Value::InlineTable(table)
        }
    }
}
