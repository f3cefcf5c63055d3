//! Counts the values of a JSON text before they are allocated: two bytes of text can take hundreds in memory.

/// The limit for nested values, which is serde_json's own.
const DEPTH: u32 = 128;

/// Returns an error for a JSON text that has more than `most` values, or nests them too deeply. Texts that are not JSON
/// pass: their parser reports them.
pub fn check_json_values(text: &str, most: u64) -> Result<(), String> {
    let (mut values, mut depth) = (1u64, 0u32);
    let (mut is_string, mut is_escaped) = (false, false);
    for byte in text.bytes() {
        match byte {
            _ if is_escaped => is_escaped = false,
            b'\\' if is_string => is_escaped = true,
            b'"' => is_string = !is_string,
            _ if is_string => {}
            b'{' | b'[' => (values, depth) = (values + 1, depth + 1),
            b'}' | b']' => depth = depth.saturating_sub(1),
            b',' => values += 1,
            _ => {}
        }
        if values > most {
            return Err(format!("it has more than {most} values, the limit"));
        } else if depth > DEPTH {
            return Err(format!("it has more than {DEPTH} lists and objects inside one another, the limit"));
        }
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn values_and_depth_are_counted_outside_strings() {
        assert_eq!(check_json_values(r#"{"a":[1,2,"],[,\"{"],"b":3}"#, 6), Ok(()));
        assert!(check_json_values(r#"{"a":[1,2,3],"b":3}"#, 5).unwrap_err().contains("more than 5 values"));
        assert!(check_json_values(&"[".repeat(1 << 20), 1 << 21).unwrap_err().contains("128 lists and objects"));
    }
}
