use super::{
    extremes::ignoring_nan,
    layouts::without_layouts,
    words::{BOUND, class, decoration, op},
    zeros::without_zeros,
    *,
};
use std::collections::HashMap;

const TEXT: &str = "
    struct S { a: f32, b: array<vec3<f32>, 8> }
    var<private> long: array<f32, 24>;
    var<private> short: array<f32, 23>;
    var<private> table: array<f32, 24> = array<f32, 24>(
        1,2,3,4,5,6,7,8,9,10,11,12,13,14,15,16,17,18,19,20,21,22,23,24);
    @group(1) @binding(7) var<uniform> block: array<vec4<f32>, 32>;
    @fragment fn main(@builtin(position) p: vec4<f32>) -> @location(0) vec4<f32> {
        var s: S;
        var nested: array<array<f32, 6>, 4>;
        let i = u32(p.x);
        return vec4(long[i] + short[i] + table[i], s.b[i & 7u].x, nested[i & 3u][i & 1u], block[i & 31u].x);
    }";

fn instructions(words: &[u32], op: u32) -> Vec<Vec<u32>> {
    words::instructions(words).filter(|(found, _)| *found == op).map(|(_, words)| words.to_vec()).collect()
}

fn words_of(text: &str) -> Vec<u32> {
    let module = naga::front::wgsl::parse_str(text).expect("valid");
    let uniform = Binding::Uniform { bytes: 512 };
    words(&module, &[vec![], vec![(9, uniform), (7, uniform), (2, uniform)]], 0).expect("valid")
}

fn written() -> Vec<u32> {
    words_of(TEXT)
}

#[test]
fn only_zero_initialisers_of_long_arrays_are_removed() {
    let words = written();
    let initialised = |words: &[u32]| instructions(words, op::VARIABLE).iter().filter(|v| v.len() == 5).count();
    assert_eq!(initialised(&words), 5);
    // The table has values, the short array is one scalar short.
    let out = without_zeros(&words, 24);
    assert_eq!(initialised(&out), 2);
    assert_eq!(out.len(), words.len() - 3);
    assert_eq!(initialised(&without_zeros(&words, 23)), 1);
    assert_eq!(without_zeros(&words, 25), words);
}

#[test]
fn bindings_are_numbered_as_in_wgpu() {
    const BINDING: u32 = 33;
    let decorations = instructions(&written(), op::DECORATE);
    let bindings: Vec<u32> = decorations.iter().filter(|d| d[2] == BINDING).map(|d| d[3]).collect();
    // 7 is the second of 2, 7 and 9.
    assert_eq!(bindings, [1]);
}

/// Returns how many variables inside and outside of buffers have a type with a layout.
fn laid_out(words: &[u32]) -> (usize, usize) {
    let mut parts: HashMap<u32, Vec<u32>> = HashMap::new();
    for ty in [op::TYPE_ARRAY, op::TYPE_RUNTIME_ARRAY, op::TYPE_POINTER].iter().flat_map(|&op| instructions(words, op))
    {
        parts.insert(ty[1], vec![if ty[0] & 0xffff == op::TYPE_POINTER { ty[3] } else { ty[2] }]);
    }
    for ty in instructions(words, op::TYPE_STRUCT) {
        parts.insert(ty[1], ty[2..].to_vec());
    }
    let strides = instructions(words, op::DECORATE).into_iter().filter(|d| d[2] == decoration::ARRAY_STRIDE);
    let members = instructions(words, op::MEMBER_DECORATE).into_iter();
    let decorated: Vec<u32> = strides.chain(members).map(|d| d[1]).collect();
    let has_layout = |pointer: u32| {
        let mut inside = vec![pointer];
        while let Some(ty) = inside.pop() {
            if decorated.contains(&ty) {
                return true;
            }
            inside.extend(parts.get(&ty).into_iter().flatten());
        }
        false
    };
    let variables = instructions(words, op::VARIABLE);
    let (buffers, own): (Vec<_>, Vec<_>) =
        variables.iter().partition(|v| matches!(v[3], class::UNIFORM | class::STORAGE_BUFFER));
    let count = |variables: Vec<&Vec<u32>>| variables.iter().filter(|v| has_layout(v[1])).count();
    (count(buffers), count(own))
}

#[test]
fn only_variables_in_buffers_have_layouts() {
    let words = written();
    assert_eq!(laid_out(&words), (1, 5));
    let out = without_layouts(&words).expect("rewritten");
    assert_eq!(laid_out(&out), (1, 0));
    // No type is used by both.
    assert_eq!(out[BOUND], words[BOUND]);
    assert_eq!(without_layouts(&out), Some(out.clone()));
}

/// A structure and an array that are loaded as a whole, a part of one, and another that only the buffer has.
const SHARED: &str = "
    struct Inner { m: mat3x3<f32>, a: array<vec4<f32>, 2> }
    struct S { x: f32, inner: array<Inner, 2>, b: array<vec4<f32>, 2> }
    struct Only { y: vec4<f32>, s: S }
    @group(1) @binding(2) var<storage> one: Only;
    @group(1) @binding(7) var<uniform> two: array<vec4<f32>, 2>;
    @group(1) @binding(9) var<storage, read_write> three: S;
    @fragment fn main(@builtin(position) p: vec4<f32>) -> @location(0) vec4<f32> {
        var s = one.s;
        var a = two;
        let i = u32(p.x) & 1u;
        s.x += a[i].x + one.s.inner[i].m[0].y;
        three = s;
        return s.b[i] + s.inner[i].a[i];
    }";

#[test]
fn a_type_of_values_and_buffers_becomes_two() {
    let words = words_of(SHARED);
    let out = without_layouts(&words).expect("rewritten");
    assert_eq!(laid_out(&words), (3, 2));
    assert_eq!(laid_out(&out), (3, 0));
    // `S`, `Inner`, and the arrays of `Inner` and of vectors.
    let types = |words: &[u32]| instructions(words, op::TYPE_STRUCT).len() + instructions(words, op::TYPE_ARRAY).len();
    assert_eq!(types(&out), types(&words) + 4);
    // Loads: of `S` its 3 members, 2 of the array of `Inner`, their 2 members and 2 elements, and the 2 of its array;
    // of `two` its 2 elements. Stores: `S`.
    let extracts = |words: &[u32]| instructions(words, op::COMPOSITE_EXTRACT).len();
    let parts = 3 + 2 + 2 * (2 + 2) + 2;
    assert_eq!(extracts(&out), extracts(&words) + 2 * parts + 2);
    // Every id is declared once and below the bound.
    let mut ids: Vec<u32> = [op::LOAD, op::COMPOSITE_CONSTRUCT, op::COMPOSITE_EXTRACT]
        .iter()
        .flat_map(|&op| instructions(&out, op))
        .map(|found| found[2])
        .chain([op::TYPE_STRUCT, op::TYPE_ARRAY].iter().flat_map(|&op| instructions(&out, op)).map(|found| found[1]))
        .collect();
    ids.sort_unstable();
    assert!(ids.windows(2).all(|pair| pair[0] < pair[1]) && ids.iter().all(|&id| id < out[BOUND]), "{ids:?}");
    // Layouts are those of the original.
    let layouts = |words: &[u32]| {
        let mut all: Vec<Vec<u32>> = instructions(words, op::MEMBER_DECORATE).iter().map(|d| d[2..].to_vec()).collect();
        all.sort_unstable();
        all
    };
    assert_eq!(layouts(&out), layouts(&words));
}

#[test]
fn extremes_of_floats_ignore_nan() {
    let words = words_of(
        "@fragment fn main(@builtin(position) p: vec4<f32>) -> @location(0) vec4<f32> {
            let i = max(i32(p.x), 3);
            return vec4(min(p.x, p.y), max(p.xy, p.yx).x, clamp(p.x, 1.0, 2.0), saturate(p.y) + sqrt(p.x) + f32(i));
        }",
    );
    let numbers = |words: &[u32]| {
        let mut numbers: Vec<u32> = instructions(words, op::EXT_INST).iter().map(|found| found[4]).collect();
        numbers.sort_unstable();
        numbers
    };
    // Sqrt, FMin, FMax, SMax, and FClamp, which naga writes for the conversion too; then NMin, NMax, NClamp.
    assert_eq!(numbers(&words), [31, 37, 40, 42, 43, 43, 43]);
    assert_eq!(numbers(&ignoring_nan(&words)), [31, 42, 79, 80, 81, 81, 81]);
}
