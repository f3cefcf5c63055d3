//! Evaluates expressions of the language at a moment of a history.
//!
//! An expression is compiled by the compiler's own front end, after the text of the pass, with the variables that it
//! names as parameters, and run by the walker. So it has the same meaning as in the text: it can call the author's
//! functions and read uniforms and channels.

use super::{
    history::{History, Value},
    number::Number,
};
use eddy_engine::{DrawInputs, Sources};
use eddy_glsl::{
    ir::GlobalId,
    types::{Scalar, Type},
    walk::{EntryInputs, Machine, Observer, View},
    walkable::Walkable,
};
use eddy_project::Project;
use std::collections::HashMap;

/// Types that a result can have, besides those of variables that are shown directly.
const TYPES: [&str; 25] = [
    "float", "vec2", "vec3", "vec4", "int", "ivec2", "ivec3", "ivec4", "uint", "uvec2", "uvec3", "uvec4", "bool",
    "bvec2", "bvec3", "bvec4", "mat2", "mat3", "mat4", "mat2x3", "mat2x4", "mat3x2", "mat3x4", "mat4x2", "mat4x3",
];

/// The number of statements after which an expression is stopped.
const MAX_STATEMENTS: u64 = 10_000_000;

/// The value of an expression at a moment, or an error message.
pub type Watched = Result<Value, String>;

/// Compiled expressions of one history, each by the variables that it names.
#[derive(Default)]
pub(super) struct Watches {
    known: HashMap<String, Result<Compiled, String>>,
}

/// An expression compiled after the text of its pass.
struct Compiled {
    walkable: Walkable,
    /// The parameter of each variable that it names.
    inputs: Vec<Option<GlobalId>>,
    kind: Option<GlobalId>,
    results: Vec<(usize, GlobalId)>,
}

impl Watches {
    /// Returns the value of an expression at a moment of a history, in its pass, which may be one of the draws of
    /// meshes.
    pub(super) fn value(
        &mut self,
        (history, at): (&History, usize),
        (project, index, draw): (&Project, usize, Option<usize>),
        (inputs, entry, pixel): (&DrawInputs<'_>, &EntryInputs, (u32, u32)),
        expression: &str,
    ) -> Watched {
        let expression = expression.trim();
        if expression.is_empty() {
            return Err("the expression is empty".into());
        }
        // A variable by itself is shown whatever its type.
        if let Some(value) = history.value(at, expression) {
            return Ok(value);
        }
        let words: Vec<&str> = words(expression).collect();
        let visible = history.names(at);
        let named: Vec<&(String, String)> = visible.iter().filter(|(name, _)| words.contains(&name.as_str())).collect();
        let globals: Vec<(&str, &str)> = history.global_names().collect();
        // The rest of what is compiled is the same for a history.
        let key = named.iter().flat_map(|(name, ty)| [ty, " ", name, ", "]).chain([expression]).collect();
        let compiled = self.known.entry(key).or_insert_with(|| {
            let text = generated_text(&named, &globals, expression);
            compile(&Sources::new(project), (index, draw), &text, [named.len(), globals.len()])
        });
        let compiled = compiled.as_ref().map_err(Clone::clone)?;
        let mut machine = Machine::<f32>::new(&compiled.walkable.program, inputs, entry.clone(), MAX_STATEMENTS);
        let held = named.iter().map(|(name, _)| history.value(at, name).map(|value| value.words));
        let held = held.chain(globals.iter().map(|(name, _)| history.global_words(at, name)));
        for (global, words) in compiled.inputs.iter().zip(held) {
            if let (Some(global), Some(words)) = (global, words) {
                machine.set_global(*global, &words);
            }
        }
        let mut result = ResultCapture { compiled, value: None };
        machine.run(Machine::<f32>::lane_of(pixel), &mut result).map_err(|stop| stop.to_string())?;
        result.value.ok_or_else(|| "no value: the pixel was discarded".into())
    }
}

/// Captures the result when the function that runs ends.
struct ResultCapture<'c> {
    compiled: &'c Compiled,
    value: Option<Value>,
}

impl Observer<f32> for ResultCapture<'_> {
    fn leave(&mut self, view: &View<'_, '_, f32>) {
        let Compiled { walkable, kind, results, .. } = self.compiled;
        // An author's `main` has another name here.
        if !matches!(walkable.function_name(view.function_id()), Some("mainCubemap" | "main")) {
            return;
        }
        let Some(kind) = kind.map(|kind| view.global(kind)[0].bits() as usize) else { return };
        let Some((index, global)) = results.iter().find(|(index, _)| *index + 1 == kind) else { return };
        let cells = view.global(*global);
        let types = &walkable.program.types;
        let ty = walkable.program[*global].ty;
        let scalar = types.scalar(ty).unwrap_or(Scalar::Float);
        self.value = Some(Value {
            type_text: TYPES[*index].to_owned(),
            numbers: cells.iter().map(|cell| Number::of(scalar, cell.bits())).collect(),
            is_vector: matches!(types.get(ty), Type::Vector { scalar: Scalar::Float, size: 3 | 4 }),
            words: cells.iter().map(|cell| cell.bits()).collect(),
        });
    }
}

/// Returns the names in an expression, and other words.
fn words(expression: &str) -> impl Iterator<Item = &str> {
    expression.split(|c: char| !(c.is_ascii_alphanumeric() || c == '_')).filter(|word| !word.is_empty())
}

/// Returns the text that is appended to the pass: variables as parameters, and a function for each type that stores the
/// result; and the body of the entry point there.
fn generated_text(named: &[&(String, String)], globals: &[(&str, &str)], expression: &str) -> (String, String) {
    let mut out = String::from("int eddy_kind;\n");
    for (index, ty) in TYPES.iter().enumerate() {
        out += &format!("{ty} eddy_{ty}; void eddy_put({ty} x) {{ eddy_kind = {}; eddy_{ty} = x; }}\n", index + 1);
    }
    for (index, (_, ty)) in named.iter().enumerate() {
        out += &format!("{ty} eddy_local_{index};\n");
    }
    for (index, (_, ty)) in globals.iter().enumerate() {
        out += &format!("{ty} eddy_global_{index};\n");
    }
    let list = |part: &dyn Fn(usize, &(String, String)) -> String| {
        named.iter().enumerate().map(|(index, named)| part(index, named)).collect::<Vec<_>>().join(", ")
    };
    let parameters = list(&|_, (name, ty)| format!("{ty} {name}"));
    let arguments = list(&|index, _| format!("eddy_local_{index}"));
    // Written, so that they are memory, which can be initialised.
    let touched: String = (0..named.len()).map(|i| format!("eddy_local_{i} = eddy_local_{i}; ")).collect();
    let restored: String = globals
        .iter()
        .enumerate()
        .map(|(i, (name, _))| format!("eddy_global_{i} = eddy_global_{i}; {name} = eddy_global_{i}; "))
        .collect();
    out += &format!("void eddy_watch({parameters}) {{ eddy_put((\n{expression}\n)); }}\n");
    (out, format!("{touched}{restored}eddy_watch({arguments}); "))
}

fn compile(
    sources: &Sources<'_>,
    place: (usize, Option<usize>),
    (declarations, body): &(String, String),
    counts: [usize; 2],
) -> Result<Compiled, String> {
    let walkable = sources.walkable_with(place, (declarations, body)).map_err(|diagnostics| {
        let error = diagnostics.into_iter().find(|diagnostic| diagnostic.is_error());
        error.map_or("it does not compile".into(), |error| match error.message.contains("eddy_put") {
            true => "its value cannot be shown".to_owned(),
            false => error.message,
        })
    })?;
    let find = |name: &str| walkable.globals().find(|(there, _)| *there == name).map(|(_, id)| id);
    let numbered = |prefix: &str, count: usize| -> Vec<Option<GlobalId>> {
        (0..count).map(|index| find(&format!("{prefix}{index}"))).collect()
    };
    let inputs = [numbered("eddy_local_", counts[0]), numbered("eddy_global_", counts[1])].concat();
    let results = TYPES.iter().enumerate().filter_map(|(index, ty)| Some((index, find(&format!("eddy_{ty}"))?)));
    let (kind, results) = (find("eddy_kind"), results.collect());
    Ok(Compiled { inputs, kind, results, walkable })
}
