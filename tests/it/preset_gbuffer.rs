//! Deferred presets, on analytic geometry that a test writes into the G-buffer.

use crate::support::{preset::*, *};
use eddy::{engine::Pixels, project::Project};

const FOCAL: f64 = 1.8;

type V = [f64; 3];

fn dot(a: V, b: V) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

fn along(a: V, b: V, by: f64) -> V {
    [0, 1, 2].map(|i| a[i] + by * b[i])
}

// --------------------------------------------------------------------------------------------------------------- edges

/// Returns the lines that Buffer B finds in a G-buffer of planes: x by depth, y by normal.
fn lines(gpu: &eddy::gpu::Gpu, thickness: u32, geometry: &str) -> Pixels {
    let mut project = preset("gbuffer-edges", &[&format!("thickness={thickness}")]);
    let text = format!(
        "// Depth of the plane n . p = -k (p from the camera) in this pixel.
        float plane(vec3 n, float k, vec2 p) {{ return -k / dot(n, viewFromPixel(p, 1.0, iResolution.xy)); }}
        void mainImage(out vec4 o, in vec2 p) {{ vec3 n = vec3(0.0, 0.0, 1.0); float depth = 5.0; {geometry}
            o = vec4(packNormal(n), depth, 1.5); }}"
    );
    replace(&mut project, "A", &text);
    let mut engine = drawn(gpu, &project, (64, 36), 0..1);
    read(&mut engine, "B")
}

/// Returns the number of columns with a line in each row, without the rows at the border, where the picture ends.
fn widths(pixels: &Pixels, channel: usize) -> Vec<usize> {
    let row = |y| (6..58).filter(|&x| texel(pixels, x, y)[channel] > 0.5).count();
    (6..30).map(row).collect()
}

#[test]
fn lines_of_steps_and_creases_have_the_set_thickness() {
    let Some(gpu) = gpu() else { return };
    for thickness in 1..=5 {
        let step = lines(&gpu, thickness, "depth = p.x < 32.0 ? 5.0 : 6.0;");
        assert_eq!(widths(&step, 0), vec![thickness as usize; 24], "a step in depth");
        assert_eq!(widths(&step, 1), vec![0; 24], "both sides of it face the same way");
        // A roof: two planes that meet in column 32, with a turn of 74 degrees.
        let roof = lines(&gpu, thickness, "n = vec3(p.x < 32.0 ? -0.6 : 0.6, 0.0, 0.8); depth = plane(n, 4.0, p);");
        assert_eq!(widths(&roof, 1), vec![thickness as usize; 24], "a crease");
        assert_eq!(widths(&roof, 0), vec![0; 24], "its depth has no step");
    }
}

#[test]
fn a_plane_has_no_lines_at_any_angle() {
    let Some(gpu) = gpu() else { return };
    // The last plane is seen at 4 degrees: its depth doubles within a few texels.
    for normal in ["vec3(0.0, 0.0, 1.0)", "vec3(0.5, 0.3, 0.6)", "vec3(0.0, 0.95, 0.35)"] {
        for thickness in [1, 4] {
            let flat = lines(&gpu, thickness, &format!("n = normalize({normal}); depth = plane(n, 1.0, p);"));
            let largest = flat.texels.iter().flat_map(|t| [t[0], t[1]]).fold(0.0, f32::max);
            assert!(largest < 1e-3, "{normal}: a line of {largest}");
        }
    }
}

// -------------------------------------------------------------------------------------------- a floor and a wall on it

const EYE: V = [0.0, 2.0, 2.0];
const PITCH: f64 = 0.36; // radians the camera looks down
const WALL_Z: f64 = -3.0;

/// The camera's axes: right, up, back.
fn axes() -> [V; 3] {
    let (s, c) = PITCH.sin_cos();
    [[1.0, 0.0, 0.0], [0.0, c, -s], [0.0, s, c]]
}

/// Writes a G-buffer of a wall of `height` at WALL_Z, facing the camera, on an endless floor; beyond it there is no
/// surface.
fn corner(project: &mut Project, height: f64) {
    let [_, up, back] = axes();
    let (up, back) = (format!("{up:?}").replace(['[', ']'], ""), format!("{back:?}").replace(['[', ']'], ""));
    let text = format!(
        "void mainImage(out vec4 o, in vec2 p) {{
            mat3 axes = mat3(vec3(1.0, 0.0, 0.0), vec3({up}), vec3({back}));
            vec3 eye = vec3({:?}, {:?}, {:?}), d = axes * viewFromPixel(p, 1.0, iResolution.xy), n = vec3(0.0, 1.0, \
            0.0);
            float t = d.y < 0.0 ? -eye.y / d.y : FAR, wall = ({WALL_Z:?} - eye.z) / d.z;
            float y = eye.y + wall * d.y;
            o = vec4(packNormal(vec3(0.0, 0.0, 1.0)), FAR, 0.999);
            if (d.z < 0.0 && wall < t) {{
                if (y >= {height:?} && {height:?} > 0.0) return;
                if (y >= 0.0 && {height:?} > 0.0) {{ t = wall; n = vec3(0.0, 0.0, 1.0); }}
            }} else if (d.z < 0.0 && {height:?} > 0.0 && eye.z + t * d.z < {WALL_Z:?}) return;
            if (t < FAR) o = vec4(packNormal(n * axes), t, n.y > 0.5 ? 1.5 : 2.5);
        }}",
        EYE[0], EYE[1], EYE[2]
    );
    replace(project, "A", &text);
}

/// Returns the direction of a pixel's ray, of depth 1. `pixel_of` is the inverse: it projects a point to pixels.
fn ray(pixel: [f64; 2], size: [f64; 2]) -> V {
    let [right, up, back] = axes();
    let q = [0, 1].map(|i| (pixel[i] - 0.5 * size[i]) / (size[1] * FOCAL));
    [0, 1, 2].map(|i| q[0] * right[i] + q[1] * up[i] - back[i])
}

fn pixel_of(p: V, size: [f64; 2]) -> [f64; 2] {
    let q = along(p, EYE, -1.0);
    let [x, y, z] = axes().map(|axis| dot(axis, q));
    [0.5 * size[0] + size[1] * FOCAL * x / -z, 0.5 * size[1] + size[1] * FOCAL * y / -z]
}

// ---------------------------------------------------------------------------------------------------------- occlusion

fn occlusion(gpu: &eddy::gpu::Gpu, height: f64, custom_uniforms: &[&str], size: (u32, u32)) -> Pixels {
    let mut project = preset("gbuffer-ssao-ssr", custom_uniforms);
    corner(&mut project, height);
    let mut engine = drawn(gpu, &project, size, 0..1);
    read(&mut engine, "C")
}

#[test]
fn an_open_plane_is_not_occluded() {
    let Some(gpu) = gpu() else { return };
    for custom_uniforms in [&[][..], &["radius=4", "slices=1"], &["radius=4", "slices=8", "steps=16"]] {
        let open = occlusion(&gpu, 0.0, custom_uniforms, (160, 90));
        // The averaged square of 4 x 4 texels must be inside the picture.
        let inside = (3..86).flat_map(|y| (3..156).map(move |x| (x, y)));
        let largest = inside.map(|(x, y)| texel(&open, x, y)[0]).fold(0.0, f32::max);
        println!("open plane, {custom_uniforms:?}: at most {largest}");
        assert!(largest < 0.01, "{custom_uniforms:?}: a plane hides {largest} of its own sky");
    }
}

#[test]
fn occlusion_next_to_a_wall_matches_the_analytic_value() {
    let Some(gpu) = gpu() else { return };
    let size = [320.0, 180.0];
    let height = 0.8f64;
    let pixels = occlusion(&gpu, height, &["radius=4", "slices=8", "steps=16"], (320, 180));
    // An endless wall hides (1 - cos t) / 2 of the cosine-weighted sky, t = atan(height / distance). The accepted bias
    // is up to 0.04 too little: the picture ends and the wall does not, distant surfaces have less weight, and the
    // march finds the wall's upper edge only approximately.
    for distance in [0.3, 0.4, 0.8, 1.2] {
        let expected = 0.5 * (1.0 - (height / distance).atan().cos());
        let (mut sum, mut n) = (0.0, 0);
        for i in -8..=8 {
            let [x, y] = pixel_of([0.04 * f64::from(i), 0.0, WALL_Z + distance], size);
            sum += f64::from(texel(&pixels, x as u32, y as u32)[0]);
            n += 1;
        }
        let measured = sum / f64::from(n);
        println!("wall {height} high, {distance} away: {measured:.4}, analytic {expected:.4}");
        assert!(measured < expected + 0.01 && measured > expected - 0.04, "{distance}: {measured}, not {expected}");
    }
}

/// Columns in the middle, far from the wall's ends.
const COLUMNS: std::ops::Range<u32> = 96..224;

/// Returns the rows of the floor that are partly but not mostly occluded.
fn hidden_rows(surfaces: &Pixels, hidden: &Pixels) -> Vec<u32> {
    let mean = |y: u32| COLUMNS.map(|x| texel(hidden, x, y)[0]).sum::<f32>() / COLUMNS.len() as f32;
    let is_floor = |y: &u32| (texel(surfaces, 160, *y)[3] - 1.5).abs() < 0.1 && (0.03..0.4).contains(&mean(*y));
    (0..surfaces.height).filter(is_floor).collect()
}

/// Measures the visible pattern of the 4 x 4 texels, at half size, by which directions are rotated, next to a wall
/// along which nothing changes. Returns the largest difference between columns at different places in the pattern, and
/// the share of the change from row to row that occurs at one of 8 rows of the pattern: 1 for an even slope.
fn pattern(gpu: &eddy::gpu::Gpu, planted: Option<(&str, &str)>) -> (f32, f32) {
    let mut project = preset("gbuffer-ssao-ssr", &[]);
    corner(&mut project, 0.8);
    if let Some((pass, text)) = planted {
        replace(&mut project, pass, text);
    }
    let mut engine = drawn(gpu, &project, (320, 180), 0..1);
    let (surfaces, hidden) = (read(&mut engine, "A"), read(&mut engine, "C"));
    let rows = hidden_rows(&surfaces, &hidden);
    assert!(rows.len() > 8, "{rows:?}");
    let along = |y: u32| {
        let phase = |k: u32| COLUMNS.skip(k as usize).step_by(8).map(|x| texel(&hidden, x, y)[0]).sum::<f32>() / 16.0;
        let (low, high) = (0..8).map(phase).fold((f32::MAX, 0.0f32), |(a, b), v| (a.min(v), b.max(v)));
        high - low
    };
    let step = |y: u32| COLUMNS.map(|x| (texel(&hidden, x, y + 1)[0] - texel(&hidden, x, y)[0]).abs()).sum::<f32>();
    let steps: Vec<f32> = (0..8)
        .map(|k| {
            let of_phase: Vec<f32> = rows.iter().filter(|y| **y % 8 == k).map(|y| step(*y)).collect();
            of_phase.iter().sum::<f32>() / of_phase.len().max(1) as f32
        })
        .collect();
    let mean = steps.iter().sum::<f32>() / 8.0;
    (rows.iter().map(|y| along(*y)).fold(0.0, f32::max), steps.iter().fold(0.0f32, |a, b| a.max(b / mean)))
}

#[test]
fn occlusion_has_no_visible_pattern() {
    let Some(gpu) = gpu() else { return };
    let (across, steps) = pattern(&gpu, None);
    println!("columns differ by {across:.5}, a row's share of the steps {steps:.2}");
    assert!(across < 0.002 && steps < 4.0, "{across} {steps}");
    // Both measures detect planted errors: noise that is not averaged, and blocks of four texels.
    let raw = "void mainImage(out vec4 o, in vec2 p) { o = texelFetch(iChannel0, ivec2(p), 0); }";
    let noisy = pattern(&gpu, Some(("soft", raw))).0;
    let blocks = "void mainImage(out vec4 o, in vec2 p) {
        ivec2 last = ivec2(iChannelResolution[0].xy) - 1;
        o = texelFetch(iChannel0, min(ivec2(p) / 8 * 4 + 2, last), 0);
    }";
    let blocky = pattern(&gpu, Some(("C", blocks))).1;
    assert!(noisy > 0.01 && blocky > 6.0, "{noisy} {blocky}");
}

// --------------------------------------------------------------------------------------------------------- reflections

#[test]
fn a_reflected_point_is_at_its_analytic_position() {
    let Some(gpu) = gpu() else { return };
    let (size, height) = ([160.0, 90.0], 2.5);
    let mut project = preset("gbuffer-ssao-ssr", &[]);
    corner(&mut project, height);
    let mut engine = drawn(&gpu, &project, (160, 90), 0..1);
    let hits = read(&mut engine, "D");
    let (mut wanted, mut found, mut furthest) = (0, 0, 0.0f64);
    for y in 0..90u32 {
        for x in 0..160u32 {
            let d = ray([f64::from(x) + 0.5, f64::from(y) + 0.5], size);
            if d[1] >= 0.0 {
                continue;
            }
            let floor = along(EYE, d, -EYE[1] / d[1]);
            if floor[2] <= WALL_Z {
                continue;
            }
            // Reflected in the floor, onto the wall.
            let mirrored = [d[0], -d[1], d[2]];
            let at = along(floor, mirrored, (WALL_Z - floor[2]) / mirrored[2]);
            let seen = pixel_of(at, size);
            let length = dot(along(at, floor, -1.0), along(at, floor, -1.0)).sqrt();
            let inside = (0..2).all(|i| seen[i] > 8.0 && seen[i] < size[i] - 8.0);
            // Next to the wall's foot the path in the picture is shorter than the march's first step.
            let way = (seen[0] - f64::from(x)).hypot(seen[1] - f64::from(y));
            if at[1] >= height - 0.05 || !inside || length > 4.5 || way < 3.0 {
                continue;
            }
            wanted += 1;
            let hit = texel(&hits, x, y);
            if hit[3] < 0.5 || hit[2] <= 0.0 {
                continue;
            }
            found += 1;
            let distance = (f64::from(hit[0]) * size[0] - seen[0]).hypot(f64::from(hit[1]) * size[1] - seen[1]);
            furthest = furthest.max(distance);
        }
    }
    println!("reflections: {found} of {wanted} found, at most {furthest:.2} px off");
    assert!(wanted > 500 && found as f64 > 0.97 * wanted as f64, "{found} of {wanted}");
    assert!(furthest < 1.5, "a mirrored point is {furthest} px off");
}

/// Returns the share of columns whose reflection is found, for each row from a wall's foot on, where its mirror image
/// is.
fn found_from_the_foot(gpu: &eddy::gpu::Gpu, planted: &[(&str, &str)]) -> Vec<f64> {
    let mut project = preset("gbuffer-ssao-ssr", &[]);
    corner(&mut project, 2.5);
    let text = &mut project.pass_mut(&buffer("D")).unwrap().source.text;
    for (old, new) in planted {
        assert!(text.contains(old), "the pass no longer says `{old}`");
        *text = text.replace(old, new).into();
    }
    let mut engine = drawn(gpu, &project, (160, 90), 0..1);
    let (surfaces, hits) = (read(&mut engine, "A"), read(&mut engine, "D"));
    let is_floor = |x: u32, y: u32| (texel(&surfaces, x, y)[3] - 1.5).abs() < 0.1;
    let foot = |x: u32| (0..90).rev().find(|y| is_floor(x, *y)).unwrap();
    let is_found = |x: u32, row: u32| {
        let hit = texel(&hits, x, foot(x) - row);
        hit[3] > 0.5 && hit[2] > 0.0
    };
    (0..8).map(|row| (20..140).filter(|x| is_found(*x, row)).count() as f64 / 120.0).collect()
}

#[test]
fn a_reflection_starts_at_the_foot_of_its_object_without_gaps() {
    let Some(gpu) = gpu() else { return };
    let found = found_from_the_foot(&gpu, &[]);
    println!("found from the foot on: {found:?}");
    assert!(found.iter().all(|share| *share == 1.0), "{found:?}");
    // Strides that are long from the start, and a thickness that does not grow with them, leave gaps.
    let dashed = found_from_the_foot(
        &gpu,
        &[
            ("max(most * part * sqrt(part), min(least * float(i + 1), most))", "most * part"),
            ("thickness + max(depth - 1.0 / mix(k0, k1, before), 0.0)", "0.1"),
        ],
    );
    assert!(dashed.iter().any(|share| *share < 0.95), "{dashed:?}");
}

// ----------------------------------------------------------------------------------------------------------- the edges

/// Returns the root mean square difference between the picture and the coverage of each pixel along a slanted edge.
fn coverage_error(gpu: &eddy::gpu::Gpu, image: Option<&str>) -> f64 {
    let mut project = preset("gbuffer-ssao-ssr", &[]);
    replace(
        &mut project,
        "picture",
        "void mainImage(out vec4 o, in vec2 p) { o = vec4(vec3(p.y - 0.37 * p.x > 20.0 ? 0.8 : 0.1), 1.0); }",
    );
    if let Some(text) = image {
        project.image_mut().unwrap().source.text = text.into();
    }
    let mut engine = engine(gpu, &project, (160, 90));
    draw(&mut engine, 0..1);
    let pixels = picture(&mut engine);
    let (mut sum, mut count) = (0.0, 0);
    for i in 0..160 * 90u32 {
        let (x, y) = (f64::from(i % 160), f64::from(i / 160));
        let part = |k: u32| (f64::from(k) + 0.5) / 8.0;
        let is_above = |k: u32| y + part(k / 8) - 0.37 * (x + part(k % 8)) > 20.0;
        let covered = (0..64).filter(|k| is_above(*k)).count() as f64 / 64.0;
        if covered > 0.0 && covered < 1.0 {
            sum += (f64::from(texel(&pixels, i % 160, i / 160)[0]) - 0.1 - 0.7 * covered).powi(2);
            count += 1;
        }
    }
    (sum / f64::from(count)).sqrt()
}

#[test]
fn edges_are_smooth() {
    let Some(gpu) = gpu() else { return };
    let smoothed = coverage_error(&gpu, None);
    let raw = "void mainImage(out vec4 o, in vec2 p) { o = texelFetch(iChannel0, ivec2(p), 0); }";
    let jagged = coverage_error(&gpu, Some(raw));
    println!("off the covered part: {smoothed:.3}, without anti-aliasing {jagged:.3}");
    assert!(smoothed < 0.1 && smoothed < 0.5 * jagged, "{smoothed} {jagged}");
}
