//! Functions of GLSL 4.00 and later (sections 8.3, 8.4, 8.8 and 8.9 of GLSL 4.60), with values from the specification;
//! arrays of arrays (section 4.1.9).

use super::*;
use crate::{
    Dialect, Version,
    interface::{GeometryBlock, UniformBlock},
};

const LATER: Dialect = Dialect::Any(Version { number: 460, is_es: false });

/// Checks conditions, both as constant expressions and on numbers that are known only at run time: `Z` is 0, as an int.
#[track_caller]
fn assert_all(declarations: &str, conditions: &[&str]) {
    for (zero, storage) in [("0", "const "), ("(int(p.x) - 3)", "")] {
        for condition in conditions {
            // A call of a function of the text is not a constant expression.
            let storage = if declarations.is_empty() { storage } else { "" };
            let code = format!(
                "#define Z {zero}\n#define UZ uint(Z)\n#define FZ float(Z)\n{declarations}\n\
                 void mainImage(out vec4 r, in vec2 p) {{ {storage}bool is = {condition}; r = vec4(is); }}"
            );
            let walkable = walkable_of(LATER, &code);
            for drawn in [
                run::<f32>(&walkable, &Bare::default(), (3, 2)),
                run::<f64>(&walkable, &Bare::default(), (3, 2)),
                run::<Shadowed>(&walkable, &Bare::default(), (3, 2)),
            ] {
                assert_eq!(drawn, Ok([1.0; 4]), "{condition} with Z as {zero}");
            }
        }
    }
}

#[test]
fn bits_of_integers() {
    assert_all(
        "",
        &[
            "bitCount(0xF0F0 + Z) == 8 && bitCount(-1 + Z) == 32 && bitCount(UZ) == 0",
            "bitCount(uvec3(1u, 3u, 0xFFFFFFFFu) + UZ) == ivec3(1, 2, 32)",
            "bitfieldExtract(0xF0 + Z, 4, 4) == -1 && bitfieldExtract(0xF0u + UZ, 4, 4) == 15u",
            "bitfieldExtract(0x70 + Z, 4, 4) == 7 && bitfieldExtract(-2 + Z, 0, 32) == -2",
            "bitfieldExtract(-1 + Z, 5, 0) == 0 && bitfieldExtract(ivec2(0x80, 0x7F) + Z, 7, 1) == ivec2(-1, 0)",
            "bitfieldInsert(0xFFFFFFFFu + UZ, 0u, 8, 16) == 0xFF0000FFu && bitfieldInsert(5 + Z, 9, 3, 0) == 5",
            "bitfieldInsert(Z, -1, 4, 4) == 0xF0 && bitfieldInsert(7 + Z, 9, 0, 32) == 9",
            "bitfieldReverse(1u + UZ) == 0x80000000u && bitfieldReverse(0x0F + Z) == -268435456",
            "findLSB(Z) == -1 && findLSB(UZ) == -1 && findLSB(40 + Z) == 3 && findLSB(0x80000000u + UZ) == 31",
            "findMSB(Z) == -1 && findMSB(-1 + Z) == -1 && findMSB(-2 + Z) == 0 && findMSB(-256 + Z) == 7",
            "findMSB(0xFFFFFFFFu + UZ) == 31 && findMSB(UZ) == -1 && findMSB(ivec2(255, 256) + Z) == ivec2(7, 8)",
        ],
    );
}

#[test]
fn carries_and_long_products() {
    let functions = "
        uvec2 add(uint x, uint y) { uint c; uint s = uaddCarry(x, y, c); return uvec2(s, c); }
        uvec2 subtract(uint x, uint y) { uint b; uint d = usubBorrow(x, y, b); return uvec2(d, b); }
        uvec2 product(uint x, uint y) { uvec2 r; umulExtended(x, y, r.x, r.y); return r; }
        ivec2 product(int x, int y) { ivec2 r; imulExtended(x, y, r.x, r.y); return r; }
        ivec4 products(ivec2 x, ivec2 y) { ivec2 m, l; imulExtended(x, y, m, l); return ivec4(m, l); }
        ";
    assert_all(
        functions,
        &[
            "add(0xFFFFFFFFu, 1u + UZ) == uvec2(0u, 1u) && add(0xFFFFFFFFu + UZ, 0xFFFFFFFFu) == uvec2(0xFFFFFFFEu, 1u)",
            "add(7u, 8u + UZ) == uvec2(15u, 0u) && subtract(7u + UZ, 8u) == uvec2(0xFFFFFFFFu, 1u)",
            "subtract(8u, 8u + UZ) == uvec2(0u)",
            "product(0xFFFFFFFFu + UZ, 0xFFFFFFFFu) == uvec2(0xFFFFFFFEu, 1u)",
            "product(0x12345678u + UZ, 0x9ABCDEF0u) == uvec2(0x0B00EA4Eu, 0x242D2080u)",
            "product(-1 + Z, 1) == ivec2(-1, -1) && product(-1 + Z, -1) == ivec2(0, 1)",
            "product(-2147483647 - 1 + Z, -2147483647 - 1) == ivec2(0x40000000, 0)",
            "products(ivec2(-3, 70000) + Z, ivec2(5, 70000)) == ivec4(-1, 1, -15, 605032704)",
        ],
    );
}

#[test]
fn significands_and_exponents() {
    let functions = "
        vec2 split(float x) { int e; float s = frexp(x, e); return vec2(s, e); }
        vec4 split(vec2 x) { ivec2 e; vec2 s = frexp(x, e); return vec4(s, e); }
        ";
    assert_all(
        functions,
        &[
            "split(FZ) == vec2(0) && split(1.0 + FZ) == vec2(0.5, 1) && split(-10.0 + FZ) == vec2(-0.625, 4)",
            "split(vec2(0.375, 1024.0) + FZ) == vec4(0.75, 0.5, -1, 11)",
            "split(uintBitsToFloat(1u + UZ)) == vec2(0.5, -148)",
        ],
    );
    assert_all(
        "",
        &[
            "ldexp(0.75 + FZ, -1) == 0.375 && ldexp(1.0 + FZ, 127) == exp2(127.0) && ldexp(FZ, 200) == 0.0",
            "ldexp(vec2(3.0, -1.0) + FZ, ivec2(2, 0)) == vec2(12.0, -1.0)",
            "ldexp(uintBitsToFloat(1u + UZ), 149) == 1.0 && ldexp(exp2(-100.0 + FZ), 200) == exp2(100.0)",
            "fma(2.0 + FZ, 3.0, 4.0) == 10.0 && fma(vec2(1, 2), vec2(3) + FZ, vec2(1)) == vec2(4, 7)",
            "packUnorm4x8(vec4(0, 1, 0.5, 2) + FZ) == 0xFF80FF00u && packSnorm4x8(vec4(-1, 1, 0, -9) + FZ) == 0x81007F81u",
            "unpackUnorm4x8(0xFF0000FFu + UZ) == vec4(1, 0, 0, 1) && unpackSnorm4x8(0x81807F00u + UZ) == vec4(0, 1, -1, -1)",
        ],
    );
}

#[test]
fn function_of_the_text_replaces_a_built_in_one() {
    assert_all(
        "int bitCount(int x) { return x + 7; } float fma(float a, float b, float c) { return 5.0; }",
        &[
            "bitCount(3 + Z) == 10 && bitCount(3u + UZ) == 2 && fma(1.0 + FZ, 2.0, 3.0) == 5.0 && fma(p, p, p) != vec2(5)",
        ],
    );
}

/// A texture of 4x2 texels whose colour is their place, repeated, with three levels.
struct Places(Bare);

impl World for Places {
    fn uniforms(&self) -> &UniformBlock {
        self.0.uniforms()
    }

    fn geometry(&self) -> GeometryBlock {
        self.0.geometry()
    }

    fn custom_uniform(&self, slot: u16) -> [u32; 4] {
        self.0.custom_uniform(slot)
    }

    fn cube_face(&self) -> u32 {
        0
    }

    fn size(&self, _: u8, _: i32) -> [i32; 3] {
        [4, 2, 1]
    }

    fn levels(&self, _: u8) -> u32 {
        3
    }

    fn fetch(&self, _: u8, _: [i32; 3], _: i32) -> [f32; 4] {
        [0.0; 4]
    }

    fn sample(&self, _: u8, at: [f64; 3], _: Lod, offset: [i32; 3]) -> [f64; 4] {
        let place = |at: f64, size: f64, offset: i32| (at * size - 0.5 + f64::from(offset)).round().rem_euclid(size);
        [place(at[0], 4.0, offset[0]), place(at[1], 2.0, offset[1]), 7.0, 1.0]
    }
}

#[test]
fn texels_are_gathered_and_levels_queried() {
    for (call, wanted) in [
        ("textureGather(iChannel0, vec2(0.5))", [1.0, 2.0, 2.0, 1.0]),
        ("textureGather(iChannel0, vec2(0.5), 1)", [1.0, 1.0, 0.0, 0.0]),
        ("textureGather(iChannel0, vec2(0.0), 0)", [3.0, 0.0, 0.0, 3.0]),
        ("textureGatherOffset(iChannel0, vec2(0.5), ivec2(1, 0))", [2.0, 3.0, 3.0, 2.0]),
        ("textureGatherOffset(iChannel0, vec2(0.5), ivec2(0, 1), 1)", [0.0, 0.0, 1.0, 1.0]),
        ("vec4(textureQueryLevels(iChannel0))", [3.0; 4]),
        // Footprints of 2 by 0 and of 0 by 16 texels, of which the texture has 4 levels.
        ("textureQueryLod(iChannel0, p * vec2(0.5, 0)).xyxy", [1.0; 4]),
        ("textureQueryLod(iChannel0, p * vec2(0, 8)).xyxy", [2.0, 4.0, 2.0, 4.0]),
    ] {
        let code = format!("void mainImage(out vec4 r, in vec2 p) {{ r = {call}; }}");
        let walkable = walkable_of(LATER, &code);
        assert_eq!(run::<f32>(&walkable, &Places(Bare::default()), (3, 2)), Ok(wanted), "{call}");
    }
}

#[test]
fn fine_derivatives_are_of_the_pixel_and_coarse_ones_of_the_quad() {
    // Pixel (3, 3) is the last of its quad, from (2, 2).
    for (call, wanted) in [
        ("dFdxFine(p.x * p.y), dFdyFine(p.x * p.y), fwidthFine(p.x * p.y)", [3.5, 3.5, 7.0, 0.0]),
        ("dFdxCoarse(p.x * p.y), dFdyCoarse(p.x * p.y), fwidthCoarse(p.x * p.y)", [2.5, 2.5, 5.0, 0.0]),
    ] {
        let code = format!("void mainImage(out vec4 r, in vec2 p) {{ r = vec4({call}, 0); }}");
        let walkable = walkable_of(LATER, &code);
        assert_eq!(run::<f32>(&walkable, &Bare::default(), (3, 3)), Ok(wanted), "{call}");
    }
}

#[test]
fn arrays_of_arrays_are_indexed_level_by_level() {
    // An element has its indices as digits; `b` has two arrays of three, as `float[3] b[2]` means.
    let declarations = "
        struct S { int before; float[3] of[2]; int after; };
        const float[3] c[2] = {{0.0, 1.0, 2.0}, {10.0, 11.0, 12.0}};
        float g[2][3] = float[2][3](float[3](0.0, 1.0, 2.0), float[](10.0, 11.0, 12.0));
        int cube[2][3][4];
        float sum(float[3] row) { float s = 0.0; for (int i = 0; i < row.length(); ++i) s += row[i]; return s; }
        float[2][3] doubled(float[3] all[2]) { for (int i = 0; i < 6; ++i) all[i / 3][i % 3] *= 2.0; return all; }
        void swap(inout float all[2][3]) { float[3] first = all[0]; all[0] = all[1]; all[1] = first; }
        float swapped(int i, int j) { float copy[2][3] = g; swap(copy); return copy[i][j]; }
        int cubed(int i, int j, int k) {
            for (int n = 0; n < 24; ++n) cube[n / 12][n / 4 % 3][n % 4] = 100 * (n / 12) + 10 * (n / 4 % 3) + n % 4;
            int plane[3][4] = cube[i];
            return plane[j][k];
        }
        int lengths() { return 100 * cube.length() + 10 * cube[0].length() + cube[0][0].length(); }
        bool is_equal(float changed) { float other[2][3] = c; other[1][2] += changed; return other == g && c != doubled(g); }
        float member(int i, int j) { S s = S(7, c, 8); s.of[i][j] += 0.5; return s.of[i][j] + float(s.before * s.after); }
        vec2 of_vectors(int i) { vec2 v[2][2]; v[1][i].yx = vec2(3, 4); v[i][1] += 1.0; return v[1][i] + v[i][1]; }
        ";
    assert_all(
        declarations,
        &[
            "c[Z][2] == 2.0 && c[1][Z] == 10.0 && c[1 + Z][1 + Z] == 11.0 && c.length() == 2 && c[Z].length() == 3",
            "g[Z][2] == 2.0 && g[1][Z] == 10.0 && g[1 + Z][1 + Z] == 11.0 && sum(g[1 + Z]) == 33.0 && sum(c[Z]) == 3.0",
            "doubled(c)[1 + Z][2 + Z] == 24.0 && doubled(g)[Z][1] == 2.0 && g[1][2 + Z] == 12.0",
            "swapped(Z, 1) == 11.0 && swapped(1 + Z, Z) == 0.0",
            "cubed(1, 2, 3 + Z) == 123 && cubed(Z, 1, 2) == 12 && cubed(1 + Z, Z, 3) == 103 && lengths() == 234",
            "is_equal(FZ) && !is_equal(FZ + 1.0) && member(1, 2 + Z) == 68.5 && member(Z, Z) == 56.5",
            "of_vectors(1 + Z) == vec2(10, 8) && of_vectors(Z) == vec2(5, 4)",
        ],
    );
}

#[test]
fn long_arrays_of_arrays_are_tables() {
    let list = |of: &dyn Fn(usize) -> String, count: usize| (0..count).map(of).collect::<Vec<_>>().join(", ");
    let row = |i: usize| format!("{{{}}}", list(&|j| format!("{}.0", 100 * i + j), 20));
    let stores: String = (0..400).map(|i| format!("f[{}][{}] = vec2({i}, {});\n", i / 20, i % 20, 2 * i)).collect();
    let declarations = format!(
        "const float t[20][20] = {{{}}};\nvec2 f[20][20];\n\
         float at(int i, int j) {{ return t[i][j]; }}\n\
         vec2 late(int i, int j) {{ {stores} return f[i][j]; }}\n",
        list(&row, 20)
    );
    assert_all(
        &declarations,
        &[
            "at(19 + Z, Z) == 1900.0 && at(Z, 19) == 19.0 && at(7, 13 + Z) == 713.0 && at(99 + Z, 99 + Z) == 1919.0",
            "late(19, 19 + Z) == vec2(399, 798) && late(3 + Z, 5 + Z) == vec2(65, 130)",
        ],
    );
}
