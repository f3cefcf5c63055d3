//! HLSL with separate sampler registers.
//!
//! naga writes HLSL for wgpu, which has all samplers in one heap and looks up their indices in a buffer. Other programs
//! bind a sampler to a register.

/// Declarations of the heap, by the start of their lines.
const HEAP: [&str; 3] = [
    "SamplerState nagaSamplerHeap[",
    "SamplerComparisonState nagaComparisonSamplerHeap[",
    "StructuredBuffer<uint> naga",
];

/// Returns the text with a register for each sampler. Returns an error for a line in an unexpected form.
pub(crate) fn with_sampler_registers(text: &str) -> Result<String, String> {
    let mut out = String::with_capacity(text.len());
    for line in text.split_inclusive('\n') {
        if HEAP.iter().any(|heap| line.starts_with(heap)) {
            continue;
        }
        match line.strip_prefix("static const SamplerState ") {
            None => out.push_str(line),
            Some(rest) => {
                let (name, register) = sampler(rest).ok_or_else(|| format!("an unknown sampler: {line}"))?;
                out.push_str(&format!("SamplerState {name} : register(s{register});\n"));
            }
        }
    }
    if out.contains("nagaSamplerHeap") || out.contains("SamplerIndexArray") {
        return Err("a sampler is used by its place in a heap".into());
    }
    Ok(out)
}

/// Parses `NAME = nagaSamplerHeap[nagaGroup1SamplerIndexArray[REGISTER]];`.
fn sampler(rest: &str) -> Option<(&str, u32)> {
    let (name, place) = rest.split_once(" = nagaSamplerHeap[")?;
    let (_, register) = place.split_once('[')?;
    Some((name, register.split_once("]];")?.0.parse().ok()?))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn samplers_have_registers() {
        let text = "SamplerState nagaSamplerHeap[2048]: register(s0, space0);\n\
            SamplerComparisonState nagaComparisonSamplerHeap[2048]: register(s0, space1);\n\
            StructuredBuffer<uint> nagaGroup1SamplerIndexArray : register(t1, space255);\n\
            static const SamplerState iChannel2_sampler = nagaSamplerHeap[nagaGroup1SamplerIndexArray[2]];\nfloat a;\n";
        let out = with_sampler_registers(text).unwrap();
        assert_eq!(out, "SamplerState iChannel2_sampler : register(s2);\nfloat a;\n");
        assert!(with_sampler_registers("static const SamplerState x = y;\n").is_err());
        assert!(with_sampler_registers("return nagaSamplerHeap[1];\n").is_err());
    }
}
