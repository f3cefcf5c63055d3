//! Minimal edits of a manifest's text.

use crate::{PassName, file_names::pass_of_stem};
use toml_edit::{Item, Table, TableLike, Value};

/// Sets, replaces or removes a value. An equal value keeps its formatting; a comment next to it stays in any case.
pub(super) fn set(table: &mut dyn TableLike, key: &str, value: Option<Value>) {
    let Some(mut value) = value else {
        table.remove(key);
        return;
    };
    if let Some(old) = table.get(key).and_then(Item::as_value) {
        if plain(old) == plain(&value) {
            return;
        }
        *value.decor_mut() = old.decor().clone();
    }
    match table.get_mut(key) {
        Some(item) => *item = Item::Value(value),
        None => {
            table.insert(key, Item::Value(value));
        }
    }
}

/// A value without its decoration, for comparison.
fn plain(value: &Value) -> String {
    match value {
        Value::String(text) => format!("\"{}", text.value()),
        Value::Array(items) => items.iter().map(plain).collect::<Vec<_>>().join("\n"),
        other => other.clone().decorated("", "").to_string(),
    }
}

/// The table at `key`, created if it does not exist.
pub(super) fn child<'t>(table: &'t mut dyn TableLike, key: &str, is_implicit: bool) -> Option<&'t mut dyn TableLike> {
    if table.get(key).is_none_or(|item| !item.is_table_like()) {
        let mut new = Table::new();
        new.set_implicit(is_implicit);
        table.insert(key, Item::Table(new));
    }
    table.get_mut(key)?.as_table_like_mut()
}

/// The key under which a table already has a pass, or the one for a new entry.
pub(super) fn key_of(table: &dyn TableLike, id: &PassName) -> String {
    let old = table.iter().map(|(key, _)| key).find(|key| pass_of_stem(key).as_ref() == Some(id));
    old.map_or_else(|| id.key().to_owned(), str::to_owned)
}
