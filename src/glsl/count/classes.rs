//! Classes of operations.

/// Operations that take about the same time on a device.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
#[repr(u8)]
pub enum OpClass {
    /// Sums, differences and signs of floats.
    Add,
    Multiply,
    Divide,
    /// Square roots and their reciprocals.
    SquareRoot,
    /// `exp`, `exp2`, `log`, `log2`.
    Exponential,
    Power,
    /// `sin` and `cos`.
    Sine,
    Tangent,
    /// `asin`, `acos`, `atan`.
    Arc,
    /// `min`, `max`, `abs`, `sign`.
    MinMax,
    /// `floor`, `ceil`, `trunc`, `round`.
    Round,
    /// Comparisons, logic, and choices between two values.
    Select,
    /// Operations on integers and bits, except the next two.
    Integer,
    IntegerMultiply,
    IntegerDivide,
    Convert,
    /// A filtered read of a 2D texture.
    Sample,
    SampleVolume,
    SampleCube,
    /// Four texels that a filtered read would mix.
    Gather,
    /// A read of one texel.
    Fetch,
    TextureSize,
    Derivative,
    /// A read of an array or vector at an index that is known only at run time.
    ArrayLoad,
    ArrayStore,
    Branch,
    /// The start of an iteration of a loop.
    Iteration,
    Call,
}

impl OpClass {
    /// The number of classes.
    pub const COUNT: usize = Self::ALL.len();

    pub const ALL: [OpClass; 28] = {
        use OpClass::*;
        [
            Add,
            Multiply,
            Divide,
            SquareRoot,
            Exponential,
            Power,
            Sine,
            Tangent,
            Arc,
            MinMax,
            Round,
            Select,
            Integer,
            IntegerMultiply,
            IntegerDivide,
            Convert,
            Sample,
            SampleVolume,
            SampleCube,
            Gather,
            Fetch,
            TextureSize,
            Derivative,
            ArrayLoad,
            ArrayStore,
            Branch,
            Iteration,
            Call,
        ]
    };

    /// Returns its name in files and reports.
    pub fn name(self) -> &'static str {
        use OpClass::*;
        match self {
            Add => "add",
            Multiply => "multiply",
            Divide => "divide",
            SquareRoot => "sqrt",
            Exponential => "exp-log",
            Power => "pow",
            Sine => "sin-cos",
            Tangent => "tan",
            Arc => "asin-acos-atan",
            MinMax => "min-max",
            Round => "round",
            Select => "select",
            Integer => "integer",
            IntegerMultiply => "integer-multiply",
            IntegerDivide => "integer-divide",
            Convert => "convert",
            Sample => "sample",
            SampleVolume => "sample-3d",
            SampleCube => "sample-cube",
            Gather => "gather",
            Fetch => "fetch",
            TextureSize => "texture-size",
            Derivative => "derivative",
            ArrayLoad => "array-load",
            ArrayStore => "array-store",
            Branch => "branch",
            Iteration => "iteration",
            Call => "call",
        }
    }

    /// Returns whether it reads texels.
    pub fn is_texture_read(self) -> bool {
        use OpClass::*;
        matches!(self, Sample | SampleVolume | SampleCube | Gather | Fetch)
    }
}
