mod later;

use super::{number::Float, *};
use crate::{
    Dialect, Link, PassKind, PassSource, Text,
    interface::{GeometryBlock, UniformBlock},
    ir::Output,
    walkable::{Detail, Walkable},
};
use bytemuck::Zeroable;
use eddy_diag::SourceId;

const LIMIT: u64 = 1_000_000;

/// A world without textures; iTime is 2, the resolution 8x4.
pub(crate) struct Bare(UniformBlock);

impl Default for Bare {
    fn default() -> Self {
        Self(UniformBlock { time: 2.0, resolution: [8.0, 4.0, 1.0], ..UniformBlock::zeroed() })
    }
}

impl World for Bare {
    fn uniforms(&self) -> &UniformBlock {
        &self.0
    }

    fn geometry(&self) -> GeometryBlock {
        GeometryBlock::default()
    }

    fn custom_uniform(&self, _: u16) -> [u32; 4] {
        [0; 4]
    }

    fn cube_face(&self) -> u32 {
        0
    }

    fn size(&self, _: u8, _: i32) -> [i32; 3] {
        [0; 3]
    }

    fn levels(&self, _: u8) -> u32 {
        1
    }

    fn fetch(&self, _: u8, at: [i32; 3], level: i32) -> [f32; 4] {
        [at[0] as f32, at[1] as f32, level as f32, 1.0]
    }

    /// Returns the coordinate and the level as a colour.
    fn sample(&self, _: u8, at: [f64; 3], lod: Lod, _: [i32; 3]) -> [f64; 4] {
        let level = match lod {
            Lod::Exact(level) => level,
            Lod::Derivatives { x, y, bias } => x[0] * 100.0 + y[1] * 10.0 + bias,
        };
        [at[0], at[1], level, 1.0]
    }
}

fn walkable(code: &str) -> Walkable {
    walkable_of(Dialect::Shadertoy, code)
}

pub(super) fn walkable_of(dialect: Dialect, code: &str) -> Walkable {
    let source = PassSource { dialect, ..PassSource::new(PassKind::Buffer, Text { id: SourceId(0), text: code }) };
    Walkable::new(&source, &Link::default(), None, Detail::Values).unwrap_or_else(|errors| panic!("{errors:?}"))
}

fn draw<R: Float>(code: &str, pixel: (u32, u32)) -> Result<[f64; 4], Stop> {
    run::<R>(&walkable(code), &Bare::default(), pixel)
}

/// Runs a program at a pixel.
pub(super) fn run<R: Float>(walkable: &Walkable, world: &dyn World, pixel: (u32, u32)) -> Result<[f64; 4], Stop> {
    let lane = Machine::<R>::lane_of(pixel);
    let drawn =
        Machine::<R>::new(&walkable.program, world, EntryInputs::of_pixel(pixel), LIMIT).run(lane, &mut NoObserver)?;
    let (_, cells) = drawn.outputs.iter().find(|(output, _)| *output == Output::Target(0)).unwrap();
    Ok(std::array::from_fn(|i| cells[lane][i].float().to_f64()))
}

/// Runs the body of a function `f`, whose result is `r`, at pixel (3, 2), in both precisions.
fn assert_result_with(declarations: &str, body: &str, wanted: [f64; 4]) {
    let code = format!("{declarations}\nvoid mainImage(out vec4 r, in vec2 p) {{ {body} }}");
    let single = draw::<f32>(&code, (3, 2)).unwrap();
    let double = draw::<f64>(&code, (3, 2)).unwrap();
    for (at, ((single, double), wanted)) in single.into_iter().zip(double).zip(wanted).enumerate() {
        let is = |value: f64, error: f64| value == wanted || (value - wanted).abs() <= error * wanted.abs().max(1.0);
        assert!(is(single, 1e-6) && is(double, 1e-14), "{body}: component {at}: {single} {double}, not {wanted}");
    }
}

fn assert_result(body: &str, wanted: [f64; 4]) {
    assert_result_with("", body, wanted);
}

#[test]
fn arithmetic_and_functions() {
    assert_result("r = vec4(p, iTime, iResolution.x);", [3.5, 2.5, 2.0, 8.0]);
    assert_result("r = vec4(7 / 2, -7 / 2, -7 % 3, 7 % -3);", [3.0, -3.0, -1.0, 1.0]);
    assert_result("int a = int(p.x) - 10; r = vec4(a / 2, a % 4, a >> 1, a & 6);", [-3.0, 1.0, -4.0, 0.0]);
    assert_result(
        "uint a = uint(p.x) - 4u; r = vec4(a >> 31, a == 4294967295u, ~a, a << 4 >> 28);",
        [1.0, 1.0, 0.0, 15.0],
    );
    assert_result("r = vec4(mod(-p.x, 2.0), fract(-p.x), sign(-p.x), round(p.x));", [0.5, 0.5, -1.0, 4.0]);
    assert_result(
        "r = vec4(length(p), dot(p, p), cross(vec3(p, 1), vec3(1, p)).xy);",
        [18.5f64.sqrt(), 18.5, 2.5 * 2.5 - 3.5, 1.0 - 3.5 * 2.5],
    );
    assert_result(
        "mat2 m = mat2(1, 2, 3, 4); r = vec4(m * p, p * m);",
        [3.5 + 7.5, 7.0 + 10.0, 3.5 + 5.0, 10.5 + 10.0],
    );
    assert_result(
        "mat3 m = mat3(2, 0, 1, p.x, 3, 0, 0, 1, 4); r = vec4(determinant(m), (inverse(m) * m)[1]);",
        [2.0 * 12.0 + 3.5, 0.0, 1.0, 0.0],
    );
    assert_result("r = vec4(smoothstep(3.0, 4.0, p.x), mix(1.0, 3.0, p.y), clamp(p, 0.0, 3.0));", [0.5, 6.0, 3.0, 2.5]);
    assert_result(
        "uint u = packHalf2x16(p); r = vec4(unpackHalf2x16(u), unpackUnorm2x16(0xffff0000u));",
        [3.5, 2.5, 0.0, 1.0],
    );
    assert_result("float n = sqrt(p.x - 9.0); r = vec4(isnan(n), n == n, n != n, n < 1.0);", [1.0, 0.0, 1.0, 0.0]);
}

/// Undefined conversions return the nearest number of both types, as naga's code does.
#[test]
fn floats_beyond_the_range_of_an_int() {
    assert_result(
        "r = vec4(int(p.x * 1e20) == 0x7fffff80, int(p.x * -1e20) == int(0x80000000u), \
         uint(p.x * 1e20) == 0xffffff00u, uint(p.x * -1e20) == 0u);",
        [1.0; 4],
    );
}

#[test]
fn control_flow() {
    assert_result(
        "for (int i = 0; i < 10; i++) { if (i == 3) continue; if (i == 6) break; r.x += float(i); }",
        [12.0, 0.0, 0.0, 0.0],
    );
    assert_result(
        "int i = 0; do { i++; } while (float(i) < p.x); while (true) { if (i++ > 8) break; } r = vec4(i);",
        [10.0; 4],
    );
    assert_result(
        "switch (int(p.x)) { case 2: r.x = 9.0; case 3: r.y = 1.0; case 4: r.z = 2.0; break; default: r.w = 3.0; }",
        [0.0, 1.0, 2.0, 0.0],
    );
    assert_result_with(
        "float g = 1.0; float f(inout float a, out float b) { a += g; g *= 2.0; b = a; if (a > 5.0) return a; return 0.0; }",
        "float a = p.x, b = 7.0; float c = f(a, b) + f(a, b); r = vec4(a, b, c, g);",
        [6.5, 6.5, 6.5, 4.0],
    );
    assert_result_with(
        "struct S { float a[3]; vec2 v; }; S make(float x) { S s; s.a[1] = x; s.v = vec2(x, 2.0 * x); return s; }",
        "S s = make(p.x); s.a[int(p.y)] += 1.0; s.v.y = 9.0; r = vec4(s.a[1], s.a[2], s.v);",
        [3.5, 1.0, 3.5, 9.0],
    );
    assert_result_with(
        "bool t(inout float n) { n += 1.0; return true; }",
        "float n = 0.0; bool b = p.x < 0.0 && t(n); bool c = p.x < 0.0 || t(n); r = vec4(n, b, c, p.x > 0.0 ? 5.0 : 6.0);",
        [1.0, 0.0, 1.0, 5.0],
    );
    assert_result_with(
        "const float T[4] = float[4](1.0, 2.0, 4.0, 8.0);",
        "r = vec4(T[int(p.x)], T[int(p.y) + 7], 0, 0);",
        [8.0, 8.0, 0.0, 0.0],
    );
}

#[test]
fn derivatives_are_those_of_neighbours() {
    assert_result(
        "r = vec4(dFdx(p.x * p.x), dFdy(p.y * p.x), fwidth(p.x - 2.0 * p.y), dFdx(p.y));",
        [3.5 * 3.5 - 2.5 * 2.5, 3.5, 3.0, 0.0],
    );
    assert_result(
        "r = texture(iChannel0, p * 0.5, 0.25) + texelFetch(iChannel1, ivec2(p), 2);",
        [1.75 + 3.0, 1.25 + 2.0, 50.0 + 5.0 + 0.25 + 2.0, 2.0],
    );
    // Neighbouring lanes took another branch.
    assert_result("float a = p.x; if (p.x > 3.0) a = 10.0; r = vec4(dFdx(a), 0, 0, 0);", [7.5, 0.0, 0.0, 0.0]);
}

#[test]
fn endless_loops_are_stopped_and_discard_draws_nothing() {
    let endless = "void mainImage(out vec4 r, in vec2 p) { for (;;) { r.x += 1.0; if (r.x < 0.0) break; } }";
    assert_eq!(draw::<f32>(endless, (0, 0)), Err(Stop::Steps(LIMIT)));
    let (walkable, world) =
        (walkable("void mainImage(out vec4 r, in vec2 p) { if (p.x > 1.0) discard; r = vec4(1.0); }"), Bare::default());
    let drawn = Machine::<f32>::new(&walkable.program, &world, EntryInputs::of_pixel((0, 0)), LIMIT)
        .run(0, &mut NoObserver)
        .unwrap();
    let drew: Vec<bool> = drawn.outputs[0].1.iter().map(|cells| !cells.is_empty()).collect();
    assert_eq!(drew, [true, false, true, false]);
}

#[test]
fn undefined_cases_follow_drivers() {
    // A product with a zero that the driver sees is dropped; one that it does not see is computed.
    assert_result(
        "float z = p.x * 0.0; r = vec4(mod(p.x, 0.0), mod(vec2(p.x), vec2(0.0, 1.0)), isnan(mod(p.x, z)));",
        [3.5, 3.5, 0.5, 1.0],
    );
    assert_result(
        "float z = p.x * 1e30; r = vec4(int(z) == 2147483520, int(-z) + 2147483647 == -1, uint(z) == 4294967040u, uint(-z));",
        [1.0, 1.0, 1.0, 0.0],
    );
}

#[test]
fn single_precision_follows_the_device_and_the_shadow_is_exact() {
    let code = "void mainImage(out vec4 r, in vec2 p) { float a = p.x * 0.1; r = vec4((a + 1e8) - 1e8 - a); }";
    assert_eq!(draw::<f32>(code, (3, 2)).unwrap()[0], f64::from((3.5f32 * 0.1 + 1e8) - 1e8 - 3.5 * 0.1));
    assert!(draw::<f64>(code, (3, 2)).unwrap()[0].abs() < 1e-7);
    let (walkable, world) = (walkable(code), Bare::default());
    let drawn = Machine::<Shadowed>::new(&walkable.program, &world, EntryInputs::of_pixel((3, 2)), LIMIT)
        .run(1, &mut NoObserver)
        .unwrap();
    let Shadowed { single, double } = drawn.outputs[0].1[1][0].float();
    assert!(f64::from(single) < -0.3 && double.abs() < 1e-7, "{single} {double}");
    // A texel is read for both precisions where their coordinates differ.
    let code =
        "void mainImage(out vec4 r, in vec2 p) { float a = p.x * 0.1; r = texture(iChannel0, vec2((a + 1e8) - 1e8)); }";
    let walkable = self::walkable(code);
    let drawn = Machine::<Shadowed>::new(&walkable.program, &world, EntryInputs::of_pixel((3, 2)), LIMIT)
        .run(1, &mut NoObserver)
        .unwrap();
    let Shadowed { single, double } = drawn.outputs[0].1[1][0].float();
    assert!(single == 0.0 && (double - 0.35).abs() < 1e-7, "{single} {double}");
}

#[test]
fn observer_sees_the_steps_of_one_pixel() {
    #[derive(Default)]
    struct Log(Vec<String>);
    impl Observer<f32> for Log {
        fn enter(&mut self, view: &View<'_, '_, f32>) {
            self.0.push(format!("enter {}", view.function_id().index()));
        }
        fn leave(&mut self, _: &View<'_, '_, f32>) {
            self.0.push("leave".into());
        }
        fn iteration(&mut self, _: &View<'_, '_, f32>) {
            self.0.push("turn".into());
        }
        fn store(&mut self, view: &View<'_, '_, f32>, place: crate::ir::Value, _: crate::ir::Value) {
            self.0.push(format!("store {:?}", view.memory(place)[0].float()));
        }
    }
    let walkable = walkable(
        "float twice(float x) { return 2.0 * x; }\nvoid mainImage(out vec4 r, in vec2 p) { float s = 0.0; for (int i = \
         0; i < 2; i++) if (p.x > 1.0) s += twice(p.x); r = vec4(s); }",
    );
    let (world, mut log) = (Bare::default(), Log::default());
    Machine::<f32>::new(&walkable.program, &world, EntryInputs::of_pixel((0, 0)), LIMIT).run(1, &mut log).unwrap();
    let calls = log.0.iter().filter(|line| *line == "enter 0").count();
    assert_eq!((calls, log.0.iter().filter(|line| *line == "turn").count()), (2, 3), "{:#?}", log.0);
    assert!(log.0.contains(&"store 6.0".to_owned()), "{:#?}", log.0);
    let mut other = Log::default();
    Machine::<f32>::new(&walkable.program, &world, EntryInputs::of_pixel((0, 0)), LIMIT).run(0, &mut other).unwrap();
    assert!(!other.0.contains(&"enter 0".to_owned()), "{:#?}", other.0);
    let names: Vec<&str> = walkable.locals(crate::ir::FuncId::new(1)).map(|(name, _)| name).collect();
    assert_eq!(names, ["r", "p", "s", "i"]);
    assert_eq!(walkable.function_name(crate::ir::FuncId::new(0)), Some("twice"));
}
