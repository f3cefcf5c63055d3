//! Prices as a file.

use eddy_engine::counts::{OpClass, Prices, TextureFilter};
use serde::{Deserialize, Serialize};
use std::{
    collections::{BTreeMap, hash_map::DefaultHasher},
    fs,
    hash::{Hash, Hasher},
    io,
    path::{Path, PathBuf},
};

/// Counts the changes of the programs that are measured, and of how counts become times.
const VERSION: u32 = 1;

#[derive(Serialize, Deserialize)]
struct Kept {
    version: u32,
    device: String,
    ops: BTreeMap<String, f64>,
    samples: [f64; TextureFilter::COUNT],
    pixel: f64,
    draw_millis: f64,
    group: (u32, u32),
    masked: f64,
}

/// Returns the path of the prices of a device.
pub(super) fn path(cache_dir: &Path, device: &str) -> PathBuf {
    let mut hasher = DefaultHasher::new();
    device.hash(&mut hasher);
    cache_dir.join("prices").join(format!("{:016x}.json", hasher.finish()))
}

/// Reads the prices of a device; `None` if there are none of this version.
pub(super) fn read(path: &Path, device: &str) -> Option<Prices> {
    let kept: Kept = serde_json::from_str(&fs::read_to_string(path).ok()?).ok()?;
    if kept.version != VERSION || kept.device != device {
        return None;
    }
    let mut ops = [0.0; OpClass::COUNT];
    for class in OpClass::ALL {
        ops[class as usize] = *kept.ops.get(class.name())?;
    }
    let numbers = ops.iter().chain(&kept.samples).chain([&kept.pixel, &kept.draw_millis, &kept.masked]);
    let is_group = |(across, up): (u32, u32)| (1..=8).contains(&across) && (1..=8).contains(&up);
    if !numbers.copied().all(|number| number.is_finite() && number >= 0.0) || !is_group(kept.group) {
        return None;
    }
    let Kept { device, samples, pixel, draw_millis, group, masked, .. } = kept;
    Some(Prices { device, ops, samples, pixel, draw_millis, group, masked })
}

/// Writes prices, and creates the folder.
pub(super) fn write(path: &Path, prices: &Prices) -> io::Result<()> {
    let Prices { device, ops, samples, pixel, draw_millis, group, masked } = prices.clone();
    let ops = OpClass::ALL.iter().map(|class| (class.name().to_owned(), ops[*class as usize])).collect();
    let kept = Kept { version: VERSION, device, ops, samples, pixel, draw_millis, group, masked };
    if let Some(folder) = path.parent() {
        fs::create_dir_all(folder)?;
    }
    // Another process may read it meanwhile.
    let new = path.with_extension(format!("{}.new", std::process::id()));
    fs::write(&new, serde_json::to_string_pretty(&kept)?)?;
    fs::rename(&new, path)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn prices_are_kept_for_their_device() {
        let folder = tempfile::tempdir().unwrap();
        let path = path(folder.path(), "a device");
        assert_eq!(read(&path, "a device"), None);
        let prices = Prices { device: "a device".into(), masked: 0.25, ..Prices::default() };
        write(&path, &prices).unwrap();
        assert_eq!(read(&path, "a device"), Some(prices));
        assert_eq!(read(&path, "a device with another driver"), None);
        fs::write(&path, "{}").unwrap();
        assert_eq!(read(&path, "a device"), None, "a damaged file is measured again");
    }
}
