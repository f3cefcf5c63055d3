//! The outlines of the preset `toon-outline`.

use crate::support::{preset::*, *};
use eddy::{
    engine::Pixels,
    gpu::Gpu,
    project::{Camera, MeshDraw, MeshSource, Project},
};

/// The picture's size; the scene is drawn at twice this size.
const SIZE: (u32, u32) = (320, 180);
const FOV: f64 = 30.0;

/// Lines of pure green, which no surface has, with all other line features off.
const PLAIN: [&str; 8] = [
    "spin=0",
    "widthMask=0",
    "blendBase=0",
    "outlineTexture=0",
    "outlineColour=0,1,0",
    "bakedNormals=false",
    "depthOffset=0",
    "outlineWidth=0.1",
];

/// The preset's mesh whose programs are used: each has a page of the textures, and three draws.
#[derive(Clone, Copy)]
enum Page {
    Figure,
    Cube,
    Knot,
}

fn camera(distance: f64) -> Camera {
    Camera { yaw: 0.0, pitch: 0.0, distance, fov: FOV, near: 0.5, far: 60.0, ..Camera::default() }
}

/// Returns a scene of one rotated mesh at the origin, drawn by a page's three draws.
fn scene(page: Page, mesh: &str, rotation: [f64; 3], distance: f64, custom_uniforms: &[&str]) -> Project {
    let mut project = preset("toon-outline", &PLAIN);
    custom_uniforms.iter().for_each(|custom_uniform| project.set_custom_uniform(custom_uniform).unwrap());
    let geometry = project.pass_mut(&buffer("scene")).unwrap().body.geometry_mut().unwrap();
    geometry.camera = camera(distance);
    let first = 3 * page as usize;
    let place = |draw: &MeshDraw| MeshDraw {
        mesh: MeshSource::parse(mesh),
        scale: 1.0,
        position: [0.0; 3],
        rotation,
        ..draw.clone()
    };
    geometry.draws = geometry.draws[first..first + 3].iter().map(place).collect();
    project
}

fn picture_of(gpu: &Gpu, project: &Project) -> Pixels {
    let mut engine = whole(gpu, project, SIZE);
    draw(&mut engine, 0..1);
    read(&mut engine, "scene")
}

fn drawn(gpu: &Gpu, page: Page, mesh: &str, rotation: [f64; 3], distance: f64, custom_uniforms: &[&str]) -> Pixels {
    picture_of(gpu, &scene(page, mesh, rotation, distance, custom_uniforms))
}

fn is_line(t: &[f32; 4]) -> bool {
    t[0] == 0.0 && t[1] == 1.0 && t[2] == 0.0
}

fn is_covered(t: &[f32; 4]) -> bool {
    t[3] > 0.0
}

fn count(pixels: &Pixels, is: impl Fn(&[f32; 4]) -> bool) -> usize {
    pixels.texels.iter().filter(|t| is(t)).count()
}

/// The formula of the preset's Common, in pixels, for a sphere of radius 1 whose line has `width` when near.
fn formula(width: f64, distance: f64, nearest: f64, farthest: f64, height: f64) -> f64 {
    let t = ((distance - nearest) / (farthest - nearest)).clamp(0.0, 1.0);
    let w = width * (1.0 - t * t * (3.0 - 2.0 * t));
    let seen = |r: f64| r / (distance * distance - r * r).sqrt();
    height / (2.0 * (FOV.to_radians() / 2.0).tan()) * (seen(1.0 + w) - seen(1.0))
}

#[test]
fn line_width_in_pixels_matches_the_formula() {
    let Some(gpu) = gpu() else { return };
    let (width, nearest, farthest) = (0.2, 4.0, 16.0);
    for mode in ["outlineMode=0", "outlineMode=1"] {
        for distance in [5.0, 8.0, 12.0] {
            let custom_uniforms = [mode, "outlineWidth=0.2", "nearest=4", "farthest=16"];
            let pixels = drawn(&gpu, Page::Figure, "builtin:sphere", [0.0; 3], distance, &custom_uniforms);
            let expected = formula(width, distance, nearest, farthest, f64::from(pixels.height));
            // The ring's width from the areas of two discs, which is accurate to a fraction of a pixel.
            let radius = |n: usize| (n as f64 / std::f64::consts::PI).sqrt();
            let (all, lines) = (count(&pixels, is_covered), count(&pixels, is_line));
            let measured = radius(all) - radius(all - lines);
            // The width along the middle row, on both sides.
            let row = pixels.height / 2;
            let along = (0..pixels.width).filter(|x| is_line(&texel(&pixels, *x, row))).count() as f64 / 2.0;
            println!("{mode}, {distance}: {measured:.3} px, {along} along a row; formula {expected:.3}");
            assert!((measured - expected).abs() < 0.25, "{mode}, {distance}: {measured} px, not {expected}");
            assert!((along - expected).abs() <= 1.0, "{mode}, {distance}: {along} px, not {expected}");
        }
        let custom_uniforms = [mode, "outlineWidth=0.2", "nearest=4", "farthest=16"];
        let far = drawn(&gpu, Page::Figure, "builtin:sphere", [0.0; 3], 16.5, &custom_uniforms);
        assert_eq!(count(&far, is_line), 0, "beyond the farthest distance");
        assert!(count(&far, is_covered) > 500);
    }
}

#[test]
fn the_width_mask_thins_lines_by_its_strength() {
    let Some(gpu) = gpu() else { return };
    let lines = |mask: &str| count(&drawn(&gpu, Page::Figure, "builtin:sphere", [0.0; 3], 6.0, &[mask]), is_line);
    let [none, half, all] = ["widthMask=0", "widthMask=0.5", "widthMask=1"].map(lines);
    // The mask's values are 0.45 to 1.
    assert!(all < half && half < none && all as f64 > 0.45 * none as f64, "{none}, {half}, {all}");
}

#[test]
fn zero_width_or_depth_only_draws_no_line() {
    let Some(gpu) = gpu() else { return };
    for (page, mesh) in [(Page::Figure, "builtin:figure"), (Page::Cube, "builtin:cube"), (Page::Knot, "builtin:knot")] {
        let with = |custom_uniforms: &[&str]| drawn(&gpu, page, mesh, [20.0, 30.0, 0.0], 7.0, custom_uniforms);
        let mut bare = scene(page, mesh, [20.0, 30.0, 0.0], 7.0, &[]);
        bare.pass_mut(&buffer("scene")).unwrap().body.geometry_mut().unwrap().draws.truncate(1);
        let bare = picture_of(&gpu, &bare);
        assert!(count(&with(&[]), is_line) > 500, "{mesh}");
        assert_eq!(with(&["outlineWidth=0"]).texels, bare.texels, "{mesh}");
        assert_eq!(count(&with(&["zOnly=true"]), is_line), 0, "{mesh}");
    }
}

#[test]
fn depth_only_lines_hide_later_draws_behind_them() {
    let Some(gpu) = gpu() else { return };
    // A large cube behind the sphere, drawn after it.
    let with = |z_only: &str| {
        let mut project = scene(Page::Figure, "builtin:sphere", [0.0; 3], 6.0, &[z_only]);
        let geometry = project.pass_mut(&buffer("scene")).unwrap().body.geometry_mut().unwrap();
        let cube = MeshDraw {
            mesh: MeshSource::parse("builtin:cube"),
            scale: 3.0,
            position: [0.0, 0.0, -5.0],
            ..geometry.draws[0].clone()
        };
        geometry.draws.push(cube);
        picture_of(&gpu, &project)
    };
    let (lines, gaps) = (with("zOnly=false"), with("zOnly=true"));
    assert!(count(&lines, is_line) > 500);
    for (line, gap) in lines.texels.iter().zip(&gaps.texels) {
        if is_line(line) {
            assert_eq!(*gap, [0.0; 4], "the line's texels are empty");
        } else {
            assert_eq!(line, gap, "other texels are unchanged");
        }
    }
}

#[test]
fn clipping_and_its_inverse_add_up_to_the_whole_mesh() {
    let Some(gpu) = gpu() else { return };
    for clipping in ["clipping=1", "clipping=2"] {
        for level in ["clipLevel=0.25", "clipLevel=0.5", "clipLevel=0.8"] {
            let with = |inverse: &str| {
                let custom_uniforms = ["outlineWidth=0", clipping, level, inverse];
                drawn(&gpu, Page::Figure, "builtin:sphere", [0.0; 3], 5.0, &custom_uniforms)
            };
            let uncut = drawn(&gpu, Page::Figure, "builtin:sphere", [0.0; 3], 5.0, &["outlineWidth=0"]);
            let (kept, inverse) = (with("clipInverse=false"), with("clipInverse=true"));
            let mut counts = [0; 2];
            for ((whole, a), b) in uncut.texels.iter().zip(&kept.texels).zip(&inverse.texels) {
                assert!(!(is_covered(a) && is_covered(b)), "no texel is in both");
                let either = if is_covered(a) { a } else { b };
                assert_eq!(either, whole, "together they are the whole mesh");
                counts[0] += usize::from(is_covered(a));
                counts[1] += usize::from(is_covered(b));
            }
            println!("{clipping}, {level}: {counts:?}");
            assert!(counts.iter().all(|n| *n > 500), "{clipping}, {level}: {counts:?}");
        }
        // At level 0 everything is kept, and lines are clipped with their mesh.
        let lines = |custom_uniforms: &[&str]| {
            let all = [&[clipping][..], custom_uniforms].concat();
            drawn(&gpu, Page::Figure, "builtin:sphere", [0.0; 3], 5.0, &all)
        };
        let uncut = drawn(&gpu, Page::Figure, "builtin:sphere", [0.0; 3], 5.0, &[]);
        assert_eq!(lines(&["clipLevel=0"]).texels, uncut.texels);
        assert_eq!(count(&lines(&["clipLevel=0", "clipInverse=true"]), is_covered), 0);
    }
}

#[test]
fn a_depth_offset_hides_the_lines_inside_a_mesh() {
    let Some(gpu) = gpu() else { return };
    let with = |offset: &str| drawn(&gpu, Page::Knot, "builtin:knot", [0.0; 3], 6.0, &[offset]);
    let bare = drawn(&gpu, Page::Knot, "builtin:knot", [0.0; 3], 6.0, &["outlineWidth=0"]);
    // Lines in front of the mesh, and outside its silhouette.
    let lines = |pixels: &Pixels| -> [Vec<bool>; 2] {
        let all = || pixels.texels.iter().zip(&bare.texels);
        [true, false].map(|inside| all().map(|(t, b)| is_line(t) && is_covered(b) == inside).collect())
    };
    let ([inside, outside], [inside_pushed, outside_pushed]) =
        (lines(&with("depthOffset=0")), lines(&with("depthOffset=4")));
    let number = |set: &[bool]| set.iter().filter(|x| **x).count();
    println!("inside {} and {}, outside {}", number(&inside), number(&inside_pushed), number(&outside));
    assert!(number(&inside) > 500 && number(&inside_pushed) == 0);
    assert!(number(&outside) > 1000 && outside == outside_pushed, "the silhouette's line is unchanged");
    let [inside_pulled, _] = lines(&with("depthOffset=-0.2"));
    assert!(number(&inside_pulled) > number(&inside), "pulled forward, lines cover more of the mesh");
}

/// Counts the texels that are not covered although they are within the convex hull of those that are.
fn notches(pixels: &Pixels) -> usize {
    let at = |i: usize| [(i as u32 % pixels.width) as i64, (i as u32 / pixels.width) as i64];
    let mut points: Vec<[i64; 2]> =
        pixels.texels.iter().enumerate().filter(|(_, t)| is_covered(t)).map(|(i, _)| at(i)).collect();
    points.sort();
    let cross = |o: [i64; 2], a: [i64; 2], b: [i64; 2]| (a[0] - o[0]) * (b[1] - o[1]) - (a[1] - o[1]) * (b[0] - o[0]);
    // A. Andrew's monotone chain, lower half and upper half.
    let half = |points: &mut dyn Iterator<Item = [i64; 2]>| {
        let mut chain: Vec<[i64; 2]> = Vec::new();
        for p in points {
            while chain.len() > 1 && cross(chain[chain.len() - 2], chain[chain.len() - 1], p) <= 0 {
                chain.pop();
            }
            chain.push(p);
        }
        chain.pop();
        chain
    };
    let hull = [half(&mut points.iter().copied()), half(&mut points.iter().rev().copied())].concat();
    let is_within = |p| (0..hull.len()).all(|i| cross(hull[i], hull[(i + 1) % hull.len()], p) >= 0);
    pixels.texels.iter().enumerate().filter(|(i, t)| !is_covered(t) && is_within(at(*i))).count()
}

#[test]
fn scaled_positions_and_baked_normals_keep_a_cubes_corners_closed() {
    let Some(gpu) = gpu() else { return };
    let with = |custom_uniforms: &[&str]| {
        let custom_uniforms = [&["outlineWidth=0.25"][..], custom_uniforms].concat();
        drawn(&gpu, Page::Cube, "builtin:cube", [25.0, 35.0, 0.0], 8.0, &custom_uniforms)
    };
    let split = with(&["outlineMode=0"]);
    let scaled = with(&["outlineMode=1"]);
    let baked = with(&["outlineMode=0", "bakedNormals=true"]);
    let [open, closed, smooth] = [&split, &scaled, &baked].map(notches);
    println!("notches: {open} along split normals, {closed} scaled, {smooth} baked");
    // A cube's silhouette is convex, and so is that of a larger one.
    assert!(open > 200, "along split normals the hull has gaps: {open}");
    assert_eq!([closed, smooth], [0, 0]);
    // A cube's baked normals point away from its centre: the same hull, except for rounding.
    let unlike = scaled.texels.iter().zip(&baked.texels).filter(|(a, b)| is_line(a) != is_line(b)).count();
    assert!(unlike <= 20 && count(&scaled, is_line) > 500, "{unlike} texels differ");
}

#[test]
fn line_colour_depends_on_light_texture_and_mesh() {
    let Some(gpu) = gpu() else { return };
    let bare = drawn(&gpu, Page::Figure, "builtin:figure", [0.0; 3], 7.0, &["outlineWidth=0"]);
    let colours = |custom_uniforms: &[&str]| -> Vec<[u8; 3]> {
        let pixels = drawn(&gpu, Page::Figure, "builtin:figure", [0.0; 3], 7.0, custom_uniforms);
        let outside = pixels.texels.iter().zip(&bare.texels).filter(|(t, b)| is_covered(t) && !is_covered(b));
        let mut all: Vec<[u8; 3]> = outside.map(|(t, _)| [0, 1, 2].map(|i| (t[i] * 255.0).round() as u8)).collect();
        assert!(all.len() > 500);
        all.sort();
        all.dedup();
        all
    };
    assert_eq!(colours(&["outlineColour=1,0.2,0.4"]), [[255, 51, 102]]);
    let light = "lightColour=0.2,1,0.6";
    assert_eq!(colours(&["outlineColour=1,0.2,0.4", light, "lightColoured=true"]), [[51, 51, 61]]);
    assert_eq!(colours(&["outlineColour=1,0.2,0.4", light]), [[255, 51, 102]]);
    let floor = colours(&["outlineColour=1,0.2,0.4", light, "lightColoured=true", "lineAmbient=0.6"]);
    assert_eq!(floor, [[153, 51, 61]], "the ambient is the minimum of each component of the light");
    // The squared colours of the parts: coat, skin, hat and brass are all next to the silhouette somewhere.
    let squared = [[0.24, 0.42, 0.72], [0.93, 0.74, 0.58], [0.12, 0.13, 0.16], [0.85, 0.62, 0.22]]
        .map(|c: [f32; 3]| c.map(|x| (x * x * 255.0).round() as u8));
    let blended = colours(&["blendBase=1"]);
    let near = |a: &[u8; 3], b: &[u8; 3]| a.iter().zip(b).all(|(a, b)| a.abs_diff(*b) <= 1);
    assert!(blended.iter().all(|c| squared.iter().any(|s| near(c, s))), "{blended:?}");
    assert!(squared.iter().all(|s| blended.iter().any(|c| near(c, s))), "{blended:?}");
    let textured = colours(&["outlineColour=1,1,1", "outlineTexture=1"]);
    assert!(textured.len() > 20 && textured.iter().all(|c| c[0] >= 139 && c[1] <= c[0]), "{textured:?}");
    let replaced = colours(&["outlineColour=1,1,1", "outlineTexture=1", "blendBase=1", "textureReplaces=true"]);
    assert_eq!(replaced, textured, "the texture replaces the blend");
}

#[test]
fn a_depth_only_hull_of_zero_width_hides_what_the_mesh_hides() {
    let Some(gpu) = gpu() else { return };
    // The hull alone, then a large cube behind it.
    let seen = |custom_uniforms: &[&str]| {
        let mut project = scene(Page::Figure, "builtin:sphere", [0.0; 3], 6.0, custom_uniforms);
        let geometry = project.pass_mut(&buffer("scene")).unwrap().body.geometry_mut().unwrap();
        let position = [0.0, 0.0, -5.0];
        let cube = MeshSource::parse("builtin:cube");
        let cube = MeshDraw { mesh: cube, scale: 3.0, position, ..geometry.draws[0].clone() };
        geometry.draws = vec![geometry.draws[2].clone(), cube];
        count(&picture_of(&gpu, &project), is_covered) as f64
    };
    let whole = seen(&["zOnly=false"]);
    let hidden = |custom_uniforms: &[&str]| whole - seen(&[&["zOnly=true"][..], custom_uniforms].concat());
    // The projected area of a sphere; with its line of 0.1 the radius is 1.1.
    let disc = |r: f64| {
        std::f64::consts::PI * (360.0 / (2.0 * (FOV / 2.0).to_radians().tan()) * r / (36.0 - r * r).sqrt()).powi(2)
    };
    for (custom_uniforms, radius) in
        [(&["outlineWidth=0"][..], 1.0), (&["zOnlyWidth=0"], 1.0), (&["zOnlyWidth=0.5"], 1.05), (&[], 1.1)]
    {
        let part = hidden(custom_uniforms) / disc(radius);
        assert!((part - 1.0).abs() < 0.03, "{custom_uniforms:?}: {part} of a disc of radius {radius}");
    }
}
