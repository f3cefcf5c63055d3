//! Values that the program the texts are written for sets besides Shadertoy's uniforms, if it is not Shadertoy: further
//! uniforms after the author's own, and other values.

use super::{FrameInputs, custom_uniforms::kind};
use eddy_glsl::{self as glsl, CustomUniform, interface::UniformBlock};
use eddy_project::{CustomUniformType, Dialect, ghostty};

/// Returns the compiler's dialect.
pub(super) fn dialect(dialect: Dialect) -> glsl::Dialect {
    match dialect {
        Dialect::Shadertoy => glsl::Dialect::Shadertoy,
        Dialect::Ghostty => glsl::Dialect::Ghostty,
        Dialect::Isf => glsl::Dialect::Isf,
    }
}

fn rows(dialect: Dialect) -> &'static [ghostty::HostUniform] {
    match dialect {
        Dialect::Ghostty => ghostty::uniforms(),
        Dialect::Shadertoy | Dialect::Isf => &[],
    }
}

/// Returns the number of slots of the further uniforms.
pub(super) fn slots(dialect: Dialect) -> usize {
    rows(dialect).len()
}

/// Returns the further uniforms, whose slots start after this number of the author's own.
pub(super) fn in_scope<'a>(dialect: Dialect, own: usize) -> Vec<CustomUniform<'a>> {
    let place = move |(n, row): (usize, &'static ghostty::HostUniform)| {
        let slot = u16::try_from(own + n).ok()?;
        Some(CustomUniform { name: row.name, kind: kind(row.ty), slot })
    };
    rows(dialect).iter().enumerate().filter_map(place).collect()
}

/// Returns the values of the further uniforms in a frame, in the form of their slots.
pub(super) fn values(dialect: Dialect, inputs: &FrameInputs, canvas: (u32, u32)) -> Vec<[u32; 4]> {
    let values = match dialect {
        Dialect::Ghostty => ghostty::values(inputs.time_secs, canvas.1),
        Dialect::Shadertoy | Dialect::Isf => Vec::new(),
    };
    let words = |(row, value): (&ghostty::HostUniform, [f32; 4])| match row.ty {
        CustomUniformType::Int | CustomUniformType::Bool => value.map(|x| x as i32 as u32),
        _ => value.map(f32::to_bits),
    };
    rows(dialect).iter().zip(values).map(words).collect()
}

/// Sets Shadertoy's uniforms to their values in the other program: Ghostty counts frames from 1, and leaves the mouse,
/// the date and the rates at their initial values (`custom_shader_uniforms` in its `src/renderer/generic.zig`).
pub(super) fn adapt(dialect: Dialect, block: &mut UniformBlock) {
    if dialect == Dialect::Ghostty {
        block.frame = block.frame.saturating_add(1);
        block.frame_rate = 60.0;
        block.sample_rate = 0.0;
        block.mouse = [0.0; 4];
        block.date = [0.0; 4];
        block.channel_time = [[0.0; 4]; 4];
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ghostty_uniforms_follow_the_authors_own() {
        let all = in_scope(Dialect::Ghostty, 3);
        assert_eq!((all[0].name, all[0].slot), ("iCurrentCursor", 3));
        assert_eq!(all.len(), slots(Dialect::Ghostty));
        let inputs = FrameInputs::at_fixed_step(0, 60.0);
        let values = values(Dialect::Ghostty, &inputs, (640, 360));
        assert_eq!(values.len(), all.len());
        let focus = all.iter().position(|uniform| uniform.name == "iFocus").unwrap();
        assert_eq!(values[focus], [1, 0, 0, 0]);
        assert_eq!(values[0][0], 140.0f32.to_bits());
        assert_eq!((in_scope(Dialect::Shadertoy, 3).len(), slots(Dialect::Shadertoy)), (0, 0));
    }
}
