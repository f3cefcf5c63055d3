//! The part of a pass that a quantity is computed from.

use super::reader::Reader;
use std::fmt;

/// The texels that belong to a quantity. The others contain other data, such as a mouse's memory.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Region {
    All,
    /// Rows starting with this one.
    FromRow(u32),
    /// All texels except (0, 0).
    ExceptFirst,
    /// All texels except the last one of the last row.
    ExceptLast,
    /// A block at a texel. Its parts outside of the pass have no texels.
    Block {
        x: u32,
        y: u32,
        width: u32,
        height: u32,
    },
}

impl Region {
    /// Reads a region, [`Region::All`] if none is written.
    pub(super) fn read(reader: &mut Reader<'_>) -> Result<Region, String> {
        if reader.has("from") {
            reader.want("row", "after `from`, as in from row 1")?;
            Ok(Region::FromRow(reader.whole("the number of a row from 0 on")?))
        } else if reader.has("except the first texel") {
            Ok(Region::ExceptFirst)
        } else if reader.has("except") {
            reader.want("the last texel", "or `the first texel` after `except`")?;
            Ok(Region::ExceptLast)
        } else if reader.has("at") {
            let (x, y) = pair(reader, ",", "at 3,5")?;
            let (width, height) = if reader.has("size") { pair(reader, "x", "size 16x6")? } else { (1, 1) };
            Ok(Region::Block { x, y, width, height })
        } else {
            Ok(Region::All)
        }
    }

    pub(super) fn holds(self, (x, y): (u32, u32), size: (u32, u32)) -> bool {
        let is_in = |at: u32, from: u32, length: u32| at.checked_sub(from).is_some_and(|along| along < length);
        match self {
            Region::All => true,
            Region::FromRow(first) => y >= first,
            Region::ExceptFirst => (x, y) != (0, 0),
            Region::ExceptLast => (x + 1, y + 1) != size,
            Region::Block { x: left, y: bottom, width, height } => is_in(x, left, width) && is_in(y, bottom, height),
        }
    }

    /// Returns a texel in its middle, for a pass of this size.
    pub fn middle(self, (width, height): (u32, u32)) -> (u32, u32) {
        match self {
            Region::Block { x, y, width, height } => (x.saturating_add(width / 2), y.saturating_add(height / 2)),
            _ => (width / 2, height / 2),
        }
    }
}

/// Reads two numbers with a mark between them.
fn pair(reader: &mut Reader<'_>, mark: &str, form: &str) -> Result<(u32, u32), String> {
    let first = reader.whole(&format!("two numbers from 0 on, as in {form}"))?;
    reader.want(mark, &format!("between two numbers, as in {form}"))?;
    Ok((first, reader.whole(&format!("a second number, as in {form}"))?))
}

/// As it is written, with a blank before it; nothing for all texels.
impl fmt::Display for Region {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Region::All => Ok(()),
            Region::FromRow(row) => write!(f, " from row {row}"),
            Region::ExceptFirst => f.write_str(" except the first texel"),
            Region::ExceptLast => f.write_str(" except the last texel"),
            Region::Block { x, y, width: 1, height: 1 } => write!(f, " at {x},{y}"),
            Region::Block { x, y, width, height } => write!(f, " at {x},{y} size {width}x{height}"),
        }
    }
}
