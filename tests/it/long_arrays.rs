//! Long arrays: for a driver that takes minutes for individual stores, they are initialised by loops, with the same
//! results.

use crate::support::{
    first_frame::first_frame,
    image, project,
    walked::{nothing_read, walk},
};
use eddy::{
    glsl::{self, Driver, PassSource},
    project::PassName,
};
use std::time::Duration;

/// Returns the texels of a picture in NumPy's format, with rows from the bottom.
fn texels(npy: &[u8]) -> Vec<[f32; 4]> {
    let header = u16::from_le_bytes([npy[8], npy[9]]) as usize;
    let numbers: Vec<f32> =
        npy[10 + header..].chunks_exact(4).map(|b| f32::from_le_bytes(b.try_into().unwrap())).collect();
    numbers.chunks_exact(4).map(|texel| texel.try_into().unwrap()).collect()
}

/// Returns the texel of a program at a column and a row.
type Texel = fn(usize, usize) -> [f32; 4];

/// Programs whose long arrays are indexed at run time, and read at unwritten elements.
const LONG_ARRAYS: &[(&str, &str, Texel)] = &[
    (
        "a local array",
        "void mainImage(out vec4 o, in vec2 p) {
            float a[500];
            a[int(p.x) * 7 % 500] = 1.;
            a[int(p.y) + 300] += 2.;
            float sum = 0.;
            for (int i = 0; i < 500; i++) sum += a[i];
            o = vec4(sum, a[int(p.y) * 7 % 500], a[int(p.x) + 300], 1);
        }",
        |x, y| [3.0, f32::from(x == y), if x == y { 2.0 } else { 0.0 }, 1.0],
    ),
    (
        "an array of vectors",
        "void mainImage(out vec4 o, in vec2 p) {
            vec4 a[200];
            a[int(p.x)].yz = vec2(3, 4);
            vec4 sum = vec4(0);
            for (int i = 0; i < 200; i++) sum += a[i];
            o = vec4(sum.xyz + a[int(p.y)].xyz, 1);
        }",
        |x, y| if x == y { [0.0, 6.0, 8.0, 1.0] } else { [0.0, 3.0, 4.0, 1.0] },
    ),
    (
        "an array of structures with arrays, in a structure",
        "struct R { float x; float a[150]; }; struct S { int n; R r[2]; vec3 b; };
        void mainImage(out vec4 o, in vec2 p) {
            S s;
            s.r[1].a[int(p.x)] = 5.;
            s.n++;
            float sum = 0.;
            for (int i = 0; i < 300; i++) sum += s.r[i / 150].a[i % 150] + s.r[i / 150].x;
            o = vec4(sum, s.r[1].a[int(p.y)], float(s.n) + s.b.z, 1);
        }",
        |x, y| [5.0, if x == y { 5.0 } else { 0.0 }, 1.0, 1.0],
    ),
    (
        "an array in each call and in each iteration",
        "float count(int at, int rounds) {
            int a[160];
            if (at > 1000) return 1.;
            for (int i = 0; i < rounds; i++) a[(at + i * i) % 160]++;
            int sum = 0;
            for (int i = 0; i < 160; i++) sum += a[i];
            return float(sum);
        }
        void mainImage(out vec4 o, in vec2 p) {
            o = vec4(0);
            for (int k = 0; k < 3; k++) {
                o.x += count(int(p.x) + k, int(p.y));
                float b[120];
                b[int(p.x)]++;
                b[int(p.y)]++;
                for (int i = 0; i < 120; i++) o.y += b[i];
                o.z = max(o.z, b[int(p.x)]);
            }
            o.z += 10. * count(int(p.y), 5);
        }",
        |x, y| [3.0 * y as f32, 6.0, if x == y { 52.0 } else { 51.0 }, 1.0],
    ),
    (
        "a parameter that is copied out",
        "void fill(out float a[250], int at) { a[at] = 7.; }
        void mainImage(out vec4 o, in vec2 p) {
            float a[250];
            a[int(p.x) + 100] = 1.;
            fill(a, int(p.x));
            float sum = 0.;
            for (int i = 0; i < 250; i++) sum += a[i];
            o = vec4(sum, a[int(p.y)], a[int(p.y) + 100], 1);
        }",
        |x, y| [7.0, if x == y { 7.0 } else { 0.0 }, 0.0, 1.0],
    ),
    (
        "global arrays",
        "float a[400]; struct S { vec2 b[150]; int n; } s;
        void put(int at) { a[at]++; s.b[at].y--; s.n++; }
        void mainImage(out vec4 o, in vec2 p) {
            put(int(p.x));
            put(int(p.y));
            vec2 sum = vec2(0);
            for (int i = 0; i < 400; i++) sum.x += a[i];
            for (int i = 0; i < 150; i++) sum += s.b[i];
            o = vec4(sum, a[int(p.x)] + float(10 * s.n), 1);
        }",
        |x, y| [2.0, -2.0, if x == y { 22.0 } else { 21.0 }, 1.0],
    ),
    (
        "arrays that are long together",
        "void mainImage(out vec4 o, in vec2 p) {
            float a[90], b[90], c[90], d[90];
            a[int(p.x)]++; b[int(p.y)]++; c[int(p.x + p.y)]++; d[int(p.y)]++;
            float sum = 0.;
            for (int i = 0; i < 90; i++) sum += a[i] * b[i] + c[i] + d[i];
            o = vec4(sum, a[int(p.y)], b[int(p.x)], 1);
        }",
        |x, y| if x == y { [3.0, 1.0, 1.0, 1.0] } else { [2.0, 0.0, 0.0, 1.0] },
    ),
    (
        "a copy of an array, and of one within a structure",
        "struct S { float a[400]; int n; };
        void mainImage(out vec4 o, in vec2 p) {
            S s, t;
            float b[400];
            s.a[int(p.x)] = 3.;
            t = s;
            b = t.a;
            t.a[int(p.x)]++;
            s.a = b = t.a;
            b[int(p.y)] += 5.;
            o = vec4(t.a[int(p.y)], s.a[int(p.x)], b[int(p.x)] + b[int(p.y) + 300], 1);
        }",
        |x, y| if x == y { [4.0, 4.0, 9.0, 1.0] } else { [0.0, 4.0, 4.0, 1.0] },
    ),
    (
        "a parameter that is written, and a result",
        "float count(float a[110], int at) { a[at]++; float s = 0.; for (int i = 0; i < 110; i++) s += a[i]; return s; }
        float[110] moved(float a[110], int at) { if (at > 1000) return a; a[at] = 9.; return a; }
        void mainImage(out vec4 o, in vec2 p) {
            float a[110];
            a[int(p.x)] = 2.;
            o.x = count(a, int(p.y));
            o.y = count(a, int(p.y)) + count(moved(a, int(p.y)), 0);
            o.z = moved(a, int(p.y))[int(p.x)] + 10. * a[int(p.x)];
        }",
        |x, y| if x == y { [3.0, 13.0, 29.0, 1.0] } else { [3.0, 15.0, 22.0, 1.0] },
    ),
];

/// Similar programs with constants in many places: 600 numbers of each kind that a constructor may contain.
fn constant_arrays() -> Vec<(&'static str, String, Texel)> {
    let numbers = |piece: fn(usize) -> String| (0..600).map(piece).collect::<Vec<_>>().join(", ");
    let floats = numbers(|i| format!("{}.5", i % 50));
    let booleans = numbers(|i| format!("{}", i % 3 == 0));
    let parts = (0..150).map(|i| format!("S(vec3({i}, 1.5, -2), {})", i % 7)).collect::<Vec<_>>().join(", ");
    let main = "void mainImage(out vec4 o, in vec2 p) { int x = int(p.x), y = int(p.y);";
    vec![
        (
            "a local of numbers",
            format!(
                "{main} float a[600] = float[]({floats}); a[x + 100] = 77.; o = vec4(a[y + 100], a[x], a[599], 1); }}"
            ),
            |x, y| [if x == y { 77.0 } else { y as f32 + 0.5 }, x as f32 + 0.5, 49.5, 1.0],
        ),
        (
            "a global of numbers, one of which is infinite",
            format!(
                "float a[601] = float[]({floats}, 1. / 0.); {main} a[x + 100] = 77.; \
                 o = vec4(a[y + 100], a[x], a[600] > 1e38 ? a[599] : 0., 1); }}"
            ),
            |x, y| [if x == y { 77.0 } else { y as f32 + 0.5 }, x as f32 + 0.5, 49.5, 1.0],
        ),
        (
            "structures, stored in each iteration",
            format!(
                "struct S {{ vec3 a; int b; }}; {main} float sum = 0.; for (int i = 0; i < 3; i++) {{ \
                 S s[150] = S[]({parts}); sum += s[x].a.x; s[x].a.x = 5.; s[y].b++; \
                 o = vec4(s[y].a.x, s[y].b, s[x + 100].a.x + 1000. * sum, 1); }} }}"
            ),
            |x, y| {
                let place = if x == y { 5.0 } else { y as f32 };
                [place, (y % 7 + 1) as f32, (3000 * x + x + 100) as f32, 1.0]
            },
        ),
        (
            "structures, some of whose numbers are not constant",
            format!(
                "struct T {{ float a[600]; float b; }}; {main} T t[2] = T[](T(float[]({floats}), p.x), \
                 T(float[]({floats}), p.y)); t[x & 1].a[y] = 8.; t[1].b++; \
                 o = vec4(t[0].a[y], t[1].a[y], t[x & 1].b + 100. * t[y & 1].a[40], 1); }}"
            ),
            |x, y| {
                let at = |part: usize| if x % 2 == part { 8.0 } else { y as f32 + 0.5 };
                [at(0), at(1), if x % 2 == 1 { y as f32 + 4051.5 } else { x as f32 + 4050.5 }, 1.0]
            },
        ),
        (
            "booleans",
            format!("{main} bool a[600] = bool[]({booleans}); a[x] = !a[x]; o = vec4(a[x], a[y], a[y + 300], 1); }}"),
            |x, y| {
                let is_third = |at: usize| at.is_multiple_of(3);
                [!is_third(x), is_third(y) != (x == y), is_third(y), true].map(|is| f32::from(u8::from(is)))
            },
        ),
    ]
}

/// Some texels of each program, computed by the walker.
#[test]
fn the_walker_computes_long_arrays() {
    let long = LONG_ARRAYS.iter().map(|&(name, text, texel)| (name, text.to_owned(), texel));
    for (name, text, texel) in long.chain(constant_arrays()) {
        let project = project(vec![image(&text, Default::default())]);
        let pixels = [(0, 0), (3, 3), (17, 5), (31, 17)];
        let found = walk(&project, &PassName::image(), &nothing_read((32, 18)), &pixels);
        let expected = pixels.map(|(x, y)| Some(texel(x as usize, y as usize)));
        assert_eq!(found, expected, "{name}");
    }
}

#[test]
fn long_arrays_of_constants_compile_quickly() {
    for (name, text, texel) in constant_arrays() {
        let Some(picture) = first_frame(name, &text, Duration::from_secs(30)) else { return };
        for (i, &found) in texels(&picture).iter().enumerate() {
            assert_eq!(found, texel(i % 32, i / 32), "{name} at {}, {}", i % 32, i / 32);
        }
    }
}

#[test]
fn long_arrays_compile_quickly_and_start_with_zeros() {
    for (name, text, texel) in LONG_ARRAYS {
        let Some(picture) = first_frame(name, text, Duration::from_secs(30)) else { return };
        let texels = texels(&picture);
        assert_eq!(texels.len(), 32 * 18);
        for (i, &found) in texels.iter().enumerate() {
            assert_eq!(found, texel(i % 32, i / 32), "{name} at {}, {}", i % 32, i / 32);
        }
    }
}

/// Returns how many arrays of zeros are stored as a whole.
fn stores_of_zeros(block: &naga::Block, f: &naga::Function, types: &naga::UniqueArena<naga::Type>) -> usize {
    use naga::{Expression, Statement, TypeInner};
    let count = |statement: &Statement| match statement {
        Statement::Store { value, .. } => usize::from(matches!(f.expressions[*value], Expression::ZeroValue(ty)
            if matches!(types[ty].inner, TypeInner::Array { .. }))),
        Statement::Block(block) => stores_of_zeros(block, f, types),
        Statement::If { accept, reject, .. } => stores_of_zeros(accept, f, types) + stores_of_zeros(reject, f, types),
        Statement::Loop { body, continuing, .. } => {
            stores_of_zeros(body, f, types) + stores_of_zeros(continuing, f, types)
        }
        _ => 0,
    };
    block.iter().map(count).sum()
}

#[test]
fn long_arrays_are_zeroed_by_loops_if_the_driver_needs_it() {
    for (name, text, _) in LONG_ARRAYS {
        let [plain, looped] = [false, true].map(|array_loops| {
            glsl::compile(&PassSource {
                driver: Driver { array_loops, ..Driver::default() },
                ..PassSource::image(text)
            })
            .unwrap()
        });
        assert_eq!(plain.initialized_arrays, None, "{name}");
        assert!(looped.initialized_arrays.is_some_and(|scalars| scalars <= 90), "{name}");
        for (_, f) in looped.module.functions.iter() {
            assert_eq!(stores_of_zeros(&f.body, f, &looped.module.types), 0, "{name}");
        }
    }
    // A program with few array elements is not changed.
    let text =
        "void mainImage(out vec4 o, in vec2 p) { float a[40], b[40]; a[int(p.x)] = b[int(p.y)]; o = vec4(a[3]); }";
    let driver = Driver { array_loops: true, ..Driver::default() };
    let compiled = glsl::compile(&PassSource { driver, ..PassSource::image(text) }).unwrap();
    assert_eq!(compiled.initialized_arrays, None);
}
