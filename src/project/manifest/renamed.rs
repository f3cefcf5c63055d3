//! Tables of renamed passes.

use super::geometry;
use crate::{
    Project,
    file_names::{FileRole, pass_of_stem, role_of_file},
};
use toml_edit::{DocumentMut, Item};

/// The text with the tables of renamed passes under their new names, so that the author's comments in them stay. Passes
/// are matched by their files.
pub(crate) fn follow_renames(text: &str, project: &Project) -> String {
    let Ok(mut document) = text.parse::<DocumentMut>() else { return text.to_owned() };
    let Some(table) = document.get_mut("passes").and_then(Item::as_table_like_mut) else { return text.to_owned() };
    let mut is_changed = false;
    for pass in &project.passes {
        let file = match (pass.source.path.is_some(), pass.source.renamed_from()) {
            (true, Some(old)) => old,
            (true, None) => pass.source.name.clone(),
            (false, _) => continue,
        };
        if table.iter().any(|(key, _)| pass_of_stem(key).as_ref() == Some(&pass.id)) {
            continue;
        }
        let is_of_file = |(key, item): &(&str, &Item)| {
            let id = pass_of_stem(key).filter(|id| project.pass(id).is_none());
            let named = item.as_table_like().and_then(|entry| {
                entry.get("file").and_then(Item::as_str).map(str::to_owned).or_else(|| geometry::own_file(entry))
            });
            id.is_some_and(|id| match named {
                Some(named) => named == file,
                None => role_of_file(&file) == Some(FileRole::Pass(id)),
            })
        };
        let Some(old) = table.iter().find(is_of_file).map(|(key, _)| key.to_owned()) else { continue };
        let decor = table.key(&old).map(|key| key.leaf_decor().clone());
        let Some(item) = table.remove(&old) else { continue };
        let new = pass.id.key();
        table.insert(new, item);
        if let (Some(decor), Some(mut key)) = (decor, table.key_mut(new)) {
            *key.leaf_decor_mut() = decor;
        }
        is_changed = true;
    }
    if is_changed { document.to_string() } else { text.to_owned() }
}
