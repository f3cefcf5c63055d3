//! The contents of a moment, computed once for it.

use crate::{
    debugger::trace::{Breakpoint, Examiner, Iteration, NamedValue, Number, Value, Watched},
    project::Tab,
};

/// The maximum number of numbers shown of a value.
const MAX_NUMBERS: usize = 16;
/// The maximum number of rows of a loop.
const MAX_ITERATIONS: usize = 2000;
/// The maximum number of variables in a loop's table.
const COLUMNS: usize = 6;

pub(super) struct MomentState {
    pub variables: Vec<Variable>,
    pub watches: Vec<Watched>,
    /// The call stack, with moments to go to.
    pub stack: Vec<(String, usize)>,
    pub rows: Rows,
    /// The return value of the function.
    pub result: Option<Value>,
    /// For each breakpoint, the error in its condition here.
    pub conditions: Vec<Option<String>>,
    /// The line, from 0.
    pub place: Option<(Tab, usize)>,
}

pub(super) struct Variable {
    pub shown: NamedValue,
    /// It differs from the moment that was shown before.
    pub is_changed: bool,
}

/// The iterations of the loop around a moment.
#[derive(Default)]
pub(super) struct Rows {
    pub names: Vec<String>,
    pub rows: Vec<Row>,
    /// The iteration that contains the moment.
    pub current: Option<usize>,
    pub is_cut: bool,
}

pub(super) struct Row {
    pub turn: Iteration,
    pub values: Vec<Option<Value>>,
}

impl Rows {
    fn first(&self) -> Option<usize> {
        self.rows.first().map(|row| row.turn.first)
    }
}

impl MomentState {
    /// Computes what is shown at a moment, and what has changed since the one that was shown before.
    pub(super) fn new(
        examiner: &mut Examiner,
        at: usize,
        before: Option<usize>,
        (watches, breakpoints): (&[String], &[Breakpoint]),
        known: Option<Rows>,
    ) -> Self {
        let traced = examiner.traced.clone();
        let history = &traced.history;
        let before = before.filter(|before| *before < history.moments.len());
        let was = |name: &str| before.and_then(|before| history.value(before, name));
        let variables = history.visible(at).into_iter().map(|shown| {
            let is_changed = was(&shown.name).is_some_and(|was| !is_same(&was, &shown.value));
            Variable { shown, is_changed }
        });
        let variables = variables.collect();
        let place = history.span(at).and_then(|span| traced.place(span)).map(|(tab, line, _)| (tab, line));
        let watches = watches.iter().map(|watch| examiner.watch(at, watch)).collect();
        let conditions = breakpoints.iter().map(|breakpoint| {
            let here = place.as_ref().is_some_and(|(tab, line)| *tab == breakpoint.tab && *line == breakpoint.line);
            let condition = breakpoint.condition.trim();
            (here && !condition.is_empty()).then(|| examiner.is_true_at(at, condition).err()).flatten()
        });
        let conditions = conditions.collect();
        let stack = history.stack(at).into_iter().map(|(call, at)| (call.name.clone(), at)).collect();
        let iterations = history.iterations(at);
        let is_cut = iterations.len() > MAX_ITERATIONS;
        let current = iterations.iter().position(|turn| (turn.first..=turn.end).contains(&at));
        let first = iterations.first().map(|turn| turn.first);
        // Within a loop they stay the same.
        let rows = match known {
            Some(rows) if rows.first() == first => rows,
            _ => table(
                iterations
                    .into_iter()
                    .take(MAX_ITERATIONS)
                    .map(|turn| (turn, history.iteration_values(&turn)))
                    .collect(),
            ),
        };
        MomentState {
            variables,
            watches,
            stack,
            result: history.result(at),
            conditions,
            place,
            rows: Rows { current, is_cut, ..rows },
        }
    }
}

fn is_same(a: &Value, b: &Value) -> bool {
    // NaN must equal itself.
    let bits = |value: &Value| value.numbers.iter().map(|n| n.as_f64().to_bits()).collect::<Vec<_>>();
    a.type_text == b.type_text && bits(a) == bits(b)
}

/// Returns the variables that change between iterations, as many as fit: numbers before vectors.
fn table(iterations: Vec<(Iteration, Vec<NamedValue>)>) -> Rows {
    let mut names: Vec<(usize, String)> = Vec::new();
    for (_, values) in &iterations {
        for shown in values {
            let count = shown.value.numbers.len();
            if count > 4 || names.iter().any(|(_, name)| *name == shown.name) {
                continue;
            }
            let find = |values: &[NamedValue]| values.iter().find(|other| other.name == shown.name).cloned();
            let changes =
                iterations.iter().any(|(_, other)| find(other).is_none_or(|o| !is_same(&o.value, &shown.value)));
            if changes || iterations.len() == 1 {
                names.push((count, shown.name.clone()));
            }
        }
        // Variables that only a later iteration has are seldom worth a column, and finding them is expensive.
        if names.len() >= COLUMNS {
            break;
        }
    }
    names.sort_by_key(|(count, _)| *count > 1);
    names.truncate(COLUMNS);
    let names: Vec<String> = names.into_iter().map(|(_, name)| name).collect();
    let rows = iterations.into_iter().map(|(turn, values)| {
        let find = |name: &String| values.iter().find(|shown| shown.name == *name).map(|shown| shown.value.clone());
        Row { turn, values: names.iter().map(find).collect() }
    });
    Rows { rows: rows.collect(), names, current: None, is_cut: false }
}

/// Formats a value: a number, or several in brackets.
pub(super) fn words(value: &Value) -> String {
    let list = |numbers: &[Number]| numbers.iter().map(Number::to_string).collect::<Vec<_>>().join(", ");
    match &value.numbers[..] {
        [number] => number.to_string(),
        numbers if numbers.len() <= MAX_NUMBERS => format!("({})", list(numbers)),
        numbers => format!("({}, … {} numbers)", list(&numbers[..MAX_NUMBERS]), numbers.len()),
    }
}
