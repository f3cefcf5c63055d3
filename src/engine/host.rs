//! Values that the program the texts are written for sets, if it is not Shadertoy: uniforms after the author's own, and
//! other values of Shadertoy's uniforms.

use super::{FrameInputs, custom_uniforms::kind};
use eddy_glsl::{
    self as glsl, Alpha, CustomUniform, PassKind, UniformSource, UniformValue, UntypedValue, Version,
    interface::UniformBlock,
};
use eddy_project::{
    AlphaRule, CustomUniformType, Dialect, EntryPoint, HostValue, MouseUnit, Pass, Project, ghostty, names_word,
};

/// Returns the compiler's dialect for a project: the version is that of the first text that declares one.
pub(super) fn dialect(project: &Project) -> glsl::Dialect {
    match project.dialect {
        Dialect::Shadertoy => glsl::Dialect::Shadertoy,
        Dialect::Ghostty => glsl::Dialect::Ghostty,
        dialect => {
            let includes = project.includes.iter().map(|included| &included.source);
            let texts = project.tab_sources().chain(includes);
            let declared = texts.filter_map(|source| Version::of(&source.text)).next();
            let usual = Version::of(&format!("#version {}", dialect.row().version));
            glsl::Dialect::Any(declared.or(usual).unwrap_or(Version { number: 120, is_es: false }))
        }
    }
}

/// Returns the compiler's kind of a pass that draws no meshes.
pub fn pass_kind(project: &Project, pass: &Pass) -> PassKind {
    let row = project.dialect.row();
    let kind = super::sources::shadertoy_kind(&pass.id);
    // Eddy and users may add passes of Shadertoy's form.
    let is_main = row.entry == EntryPoint::Main
        && matches!(kind, PassKind::Image | PassKind::Buffer)
        && !names_word(&pass.source.text, "mainImage");
    if !is_main {
        return kind;
    }
    PassKind::Main(match project.dialect.alpha(pass) {
        AlphaRule::Stored => Alpha::Stored,
        AlphaRule::Opaque => Alpha::Opaque,
        AlphaRule::OverBlack => Alpha::OverBlack,
        AlphaRule::OverTransparent => Alpha::OverTransparent,
    })
}

/// Returns the number of slots of the program's uniforms.
pub(super) fn slots(dialect: Dialect) -> usize {
    dialect.row().uniforms.len()
}

/// Returns the program's uniforms, whose slots start after this number of the author's own.
pub(super) fn in_scope<'a>(dialect: Dialect, own: usize) -> Vec<CustomUniform<'a>> {
    let row = dialect.row();
    let uniform = |(n, uniform): (usize, &eddy_project::HostUniform)| {
        let source = match uniform.value {
            HostValue::Resolution => UniformSource::Resolution,
            HostValue::UnitPosition => UniformSource::UnitPosition,
            HostValue::CentredPosition => UniformSource::CentredPosition,
            HostValue::ClipPosition => UniformSource::ClipPosition,
            _ => UniformSource::Slot(u16::try_from(own + n).ok()?),
        };
        Some(CustomUniform { name: uniform.name, kind: kind(uniform.ty), source, is_declared: row.has_declarations })
    };
    row.uniforms.iter().enumerate().filter_map(uniform).collect()
}

/// Returns the values of matrices that the program leaves at the identity.
pub(super) fn identities(dialect: Dialect) -> impl Iterator<Item = UniformValue> {
    dialect.row().identities.iter().map(|&(name, size)| {
        let column = |column| (0..size).map(|row| UntypedValue::Number(f64::from(u8::from(row == column)))).collect();
        let value = UntypedValue::List((0..size).map(|index| UntypedValue::List(column(index))).collect());
        UniformValue { name: name.to_owned(), value }
    })
}

/// Returns the values of the program's uniforms in a frame, in the form of their slots.
pub(super) fn values(dialect: Dialect, inputs: &FrameInputs, canvas: (u32, u32)) -> Vec<[u32; 4]> {
    let terminal = match dialect {
        Dialect::Ghostty => ghostty::values(inputs.time_secs, canvas.1),
        _ => Vec::new(),
    };
    let size = [canvas.0 as f32, canvas.1 as f32];
    let all = |value: f32| [value; 4];
    let words = |row: &eddy_project::HostUniform| {
        let value = match row.value {
            HostValue::Time => all(inputs.time_secs as f32),
            HostValue::TimeDeltaFromZero if inputs.frame == 0 => all(0.0),
            HostValue::TimeDelta | HostValue::TimeDeltaFromZero => all(inputs.time_delta_secs),
            HostValue::Frame(first) => all(inputs.frame.saturating_add(first) as f32),
            HostValue::Date(january) => {
                let [year, month, day, secs] = inputs.date;
                [year, month + f32::from(january), day, secs]
            }
            HostValue::TimeOfDay => {
                let secs = inputs.date[3];
                [(secs / 3600.0).floor(), (secs / 60.0).floor() % 60.0, secs % 60.0, 0.0]
            }
            HostValue::Mouse(unit, start) => {
                let start = || std::array::from_fn(|i| start[i] * size[i]);
                let [x, y]: [f32; 2] = inputs.pointer.unwrap_or_else(start);
                match unit {
                    MouseUnit::Pixels => [x, y, inputs.mouse[2], inputs.mouse[3]],
                    MouseUnit::Unit => [x / size[0], y / size[1], 0.0, 0.0],
                }
            }
            HostValue::SurfaceSize => [size[0] / size[1], 1.0, 0.0, 0.0],
            HostValue::Constant(value) => value,
            HostValue::Terminal(row) => terminal.get(usize::from(row)).copied().unwrap_or_default(),
            HostValue::Resolution | HostValue::UnitPosition | HostValue::CentredPosition | HostValue::ClipPosition => {
                all(0.0)
            }
        };
        match (row.ty, row.value) {
            // Whole numbers above 2^24 are not exact as floats.
            (CustomUniformType::Int, HostValue::Frame(first)) => [inputs.frame.saturating_add(first) as u32; 4],
            (CustomUniformType::Int | CustomUniformType::Bool, _) => value.map(|x| x as i32 as u32),
            _ => value.map(f32::to_bits),
        }
    };
    dialect.row().uniforms.iter().map(words).collect()
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
        assert_eq!((all[0].name, all[0].source), ("iCurrentCursor", UniformSource::Slot(3)));
        assert_eq!(all.len(), slots(Dialect::Ghostty));
        let inputs = FrameInputs::at_fixed_step(0, 60.0);
        let values = values(Dialect::Ghostty, &inputs, (640, 360));
        assert_eq!(values.len(), all.len());
        let focus = all.iter().position(|uniform| uniform.name == "iFocus").unwrap();
        assert_eq!(values[focus][0], 1);
        assert_eq!(values[0][0], 140.0f32.to_bits());
        assert_eq!((in_scope(Dialect::Shadertoy, 3).len(), slots(Dialect::Shadertoy)), (0, 0));
    }

    #[test]
    fn each_program_has_its_own_units() {
        let mut inputs = FrameInputs::at_fixed_step(90, 60.0);
        inputs.pointer = Some([160.0, 45.0]);
        inputs.date = [2026.0, 0.0, 31.0, 3723.0];
        let value = |dialect, name: &str| {
            let of = in_scope(dialect, 0).iter().position(|uniform| uniform.name == name).unwrap();
            values(dialect, &inputs, (640, 360))[of].map(f32::from_bits)
        };
        assert_eq!(value(Dialect::GlslViewer, "u_mouse")[..2], [160.0, 45.0]);
        assert_eq!(value(Dialect::GlslSandbox, "mouse")[..2], [0.25, 0.125]);
        assert_eq!(value(Dialect::GlslViewer, "u_date")[1], 0.0);
        assert_eq!(value(Dialect::Isf, "DATE")[1], 1.0);
        assert_eq!(value(Dialect::Bonzomatic, "fGlobalTime")[0], 1.5);
        assert_eq!(value(Dialect::Twigl, "frame")[0], 91.0);
        let frame = in_scope(Dialect::GlslViewer, 0).iter().position(|uniform| uniform.name == "u_frame").unwrap();
        assert_eq!(values(Dialect::GlslViewer, &inputs, (640, 360))[frame][0], 91);
    }
}
