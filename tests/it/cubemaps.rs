//! Cubemaps and volumes: files and built-in ones, the cubemap pass, and the uniforms of their channels.

use crate::support::{gpu, program::Bench, *};
use eddy::{
    engine::{BuildOptions, Engine},
    media::{self, MediaKey},
    project::{Channel, Filter, Input, InputKind, Media, Pass, PassName, Project, Sampler, Wrap},
    texture::Dimension,
};

const CUBE: &str = "void mainCubemap(out vec4 o, in vec2 p, in vec3 rayOri, in vec3 rayDir)";

fn channel(input: Input, filter: Filter) -> Option<Channel> {
    Some(Channel { input, sampler: Sampler { filter, wrap: Wrap::Clamp, vflip: false } })
}

fn cube_pass(body: &str, channels: [Option<Channel>; 4]) -> Pass {
    pass(PassName::cube(), &format!("{CUBE} {{ {body} }}"), channels)
}

/// Image that looks up a direction of a panorama.
fn panorama(body: &str, input: Input, filter: Filter) -> Pass {
    let code = format!(
        "void mainImage(out vec4 o, in vec2 p) {{ vec2 a = (p / iResolution.xy - .5) * vec2(6.2831853, 3.1415927); \
         vec3 d = vec3(cos(a.y) * cos(a.x), sin(a.y), cos(a.y) * sin(a.x)); {body} }}"
    );
    image(&code, [channel(input, filter), None, None, None])
}

fn draw(gpu: &eddy::gpu::Gpu, project: &Project, size: (u32, u32), frames: i32) -> Engine {
    let (media, warnings) = media::gather(project, None);
    assert!(warnings.is_empty(), "{warnings:?}");
    let mut engine = engine_with(gpu, project, &media, &BuildOptions::default(), size);
    run(&mut engine, 0, frames);
    engine
}

/// Each texel is read back at the direction that it was drawn for, including at edges and corners of faces.
#[test]
fn a_cubemap_pass_is_read_at_the_direction_that_it_was_drawn_for() {
    let Some(gpu) = gpu() else { return };
    let cube = cube_pass("o = vec4(rayDir, length(rayOri));", Default::default());
    let reader = panorama(
        "o = vec4(texture(iChannel0, d).xyz - d, texture(iChannel0, d).w);",
        Input::pass(PassName::cube()),
        Filter::Linear,
    );
    let mut engine = draw(&gpu, &project(vec![cube, reader]), (128, 64), 1);
    let pixels = engine.read_image().unwrap();
    // Half floats next to 1 are 2^-11 apart; a texel of 1,024 turns by at most 2^-9, half of which the filter averages
    // away.
    let worst = pixels.texels.iter().flat_map(|t| t[..3].iter()).fold(0f32, |a, b| a.max(b.abs()));
    assert!(worst < 1.5e-3, "{worst}");
    // Image's alpha is always 1.
    assert!(pixels.texels.iter().all(|t| t[3] == 1.0));
}

#[test]
fn a_cubemap_pass_and_earlier_buffers_read_its_previous_frame_on_every_face() {
    let Some(gpu) = gpu() else { return };
    let cube_input = Input::pass(PassName::cube());
    let cube = cube_pass(
        "o = texture(iChannel0, rayDir) + vec4(1., 0., 0., 0.);",
        [channel(cube_input.clone(), Filter::Nearest), None, None, None],
    );
    let reads = "void mainImage(out vec4 o, in vec2 p) { o = textureLod(iChannel0, vec3(0., 0., 1.), 0.); }";
    let earlier_buffer = pass(buffer("A"), reads, [channel(cube_input.clone(), Filter::Nearest), None, None, None]);
    let code = "void mainImage(out vec4 o, in vec2 p) { vec3 d[6] = vec3[](vec3(1, 0, 0), vec3(-1, 0, 0), vec3(0, 1, 0), \
                vec3(0, -1, 0), vec3(0, 0, 1), vec3(0, 0, -1)); o = vec4(texture(iChannel0, d[int(p.x)]).x, \
                texelFetch(iChannel1, ivec2(0), 0).x, iChannelResolution[0].xz); }";
    let reader = image(code, [channel(cube_input, Filter::Nearest), nearest("A"), None, None]);
    let mut engine = draw(&gpu, &project(vec![earlier_buffer, cube, reader]), (6, 2), 3);
    let pixels = engine.read_image().unwrap();
    for x in 0..6 {
        assert_eq!(texel(&pixels, x, 0)[..3], [3.0, 2.0, 1024.0], "face {x}");
    }
    // Restoring and continuing: the state contains all faces.
    let snapshot = engine.checkpoint().unwrap();
    run(&mut engine, 3, 5);
    assert!(engine.restore(&snapshot));
    run(&mut engine, 3, 4);
    assert_eq!(texel(&engine.read_image().unwrap(), 5, 0)[0], 4.0);
    engine.reset();
    run(&mut engine, 0, 1);
    assert_eq!(texel(&engine.read_image().unwrap(), 5, 0)[0], 1.0);
}

/// Texels of a file are read back at their own directions, byte for byte, flipped as Shadertoy does.
#[test]
fn cubemap_texels_are_read_at_the_directions_of_their_faces() {
    let Some(gpu) = gpu() else { return };
    for vflip in [false, true] {
        let media = Media::Builtin("hall".into());
        let key = MediaKey { media: media.clone(), dimension: Dimension::Cube, vflip };
        let texels = media::load(&key, None, None).unwrap();
        // A column of texels of every face: x is the face, y the row, always texel 37 of the row.
        let code = "void mainImage(out vec4 o, in vec2 p) { float s = 2. * 37.5 / 256. - 1., t = 2. * p.y / 256. - 1.; \
                    vec3 d[6] = vec3[](vec3(1, -t, -s), vec3(-1, -t, s), vec3(s, 1, t), vec3(s, -1, -t), \
                    vec3(s, -t, 1), vec3(-s, -t, -1)); o = texture(iChannel0, d[int(p.x)]) * 255.; \
                    if (iChannelResolution[0] != vec3(0.)) o = vec4(-1.); }";
        let input = Input::Media { kind: InputKind::Cubemap, media };
        let sampler = Sampler { filter: Filter::Nearest, wrap: Wrap::Clamp, vflip };
        let reader = image(code, [Some(Channel { input, sampler }), None, None, None]);
        let mut engine = draw(&gpu, &project(vec![reader]), (6, 256), 1);
        let pixels = engine.read_image().unwrap();
        for face in 0..6 {
            for row in 0..256 {
                let at = ((face as usize * 256 + row as usize) * 256 + 37) * 4;
                let expected = [0, 1, 2].map(|c| f32::from(texels.bytes[at + c]));
                let read = texel(&pixels, face, row);
                let is_equal = (0..3).all(|c| (read[c] - expected[c]).abs() < 0.01);
                assert!(is_equal, "face {face}, row {row}, {vflip}: {read:?}, not {expected:?}");
            }
        }
    }
}

#[test]
fn a_volume_is_read_trilinearly_and_its_mips_are_averages() {
    let Some(gpu) = gpu() else { return };
    let media = Media::Builtin("noise-rgba-3d".into());
    let key = MediaKey { media: media.clone(), dimension: Dimension::D3, vflip: false };
    let texels = media::load(&key, None, None).unwrap();
    let at = |x: usize, y: usize, z: usize| f32::from(texels.bytes[((z * 32 + y) * 32 + x) * 4]);
    let code = "void mainImage(out vec4 o, in vec2 p) { ivec2 i = ivec2(p); vec3 at = vec3(i.x, i.y, 5.); \
                o = vec4(textureLod(iChannel0, (at + .5) / 32., 0.).x, textureLod(iChannel0, (at + vec3(1., .5, .5)) / 32., \
                0.).x, textureLod(iChannel0, (floor(at / 2.) + .5) / 16., 1.).x, 0.) * 255.; \
                if (iChannelResolution[0] != vec3(32.) || textureSize(iChannel0, 0) != ivec3(32)) o = vec4(-1.); }";
    let input = Input::Media { kind: InputKind::Volume, media };
    let sampler = Sampler { filter: Filter::Mipmap, wrap: Wrap::Repeat, vflip: false };
    let reader = image(code, [Some(Channel { input, sampler }), None, None, None]);
    let mut engine = draw(&gpu, &project(vec![reader]), (32, 32), 1);
    let pixels = engine.read_image().unwrap();
    for y in 0..32usize {
        for x in 0..32usize {
            let [exact, between, coarse, _] = texel(&pixels, x as u32, y as u32);
            let (a, b, c) = (x / 2 * 2, y / 2 * 2, 4);
            let mean = (0..8).map(|i| at(a + i % 2, b + i / 2 % 2, c + i / 4)).sum::<f32>() / 8.0;
            assert!((exact - at(x, y, 5)).abs() < 0.01, "{x},{y}: {exact}");
            assert!((between - 0.5 * (at(x, y, 5) + at((x + 1) % 32, y, 5))).abs() < 0.6, "{x},{y}: {between}");
            assert!((coarse - mean).abs() < 0.51, "{x},{y}: {coarse}, not {mean}");
        }
    }
}

/// The command line draws a named face, and rejects unknown ones.
#[test]
fn a_face_is_rendered_by_name() {
    let Some(b) = Bench::with_gpu() else { return };
    b.write("p/cube_a.glsl", format!("{CUBE} {{ o = vec4(.5 + .5 * rayDir, 1.); }}\n"));
    b.write("p/eddy.toml", "[passes.cube_a]\n[passes.image]\nchannels.0 = { cube_a = true }\n");
    b.image("p/image.glsl", "fragColor = texture(iChannel0, vec3(1., 2., 3.));");
    for (face, expected) in [("+x", [255, 128, 128]), ("-y", [128, 0, 128]), ("-z", [128, 128, 0])] {
        b.line(&format!("render p --size 16x16 --pass cube_a --face {face} --out f.png")).expect(0);
        let picture = b.png("f.png");
        assert_eq!(picture.dimensions(), (1024, 1024));
        let middle = picture.get_pixel(512, 512).0;
        assert!((0..3).all(|c| middle[c].abs_diff(expected[c]) <= 1), "{face}: {middle:?}");
    }
    let rejected = b.line("render p --size 16x16 --face +x --out f.png").expect(2);
    assert!(rejected.err.contains("--pass cube_a"), "{}", rejected.err);
    let unknown = b.line("render p --size 16x16 --pass cube_a --face up --out f.png").expect(2);
    assert!(unknown.err.contains("+x"), "{}", unknown.err);
}

/// A cubemap pass can be traced and probed by face, and Image's probe reads the cubemap of its own frame.
#[test]
fn a_face_is_traced_and_probed() {
    let Some(_) = gpu() else { return };
    let b = Bench::new();
    b.write("p/cube_a.glsl", format!("{CUBE} {{ vec3 d = .5 + .5 * rayDir; o = vec4(d, 1.); }}\n"));
    b.write("p/eddy.toml", "[passes.cube_a]\n[passes.image]\nchannels.0 = { cube_a = true }\n");
    b.image("p/image.glsl", "vec4 t = texture(iChannel0, vec3(1., 2., 3.)); fragColor = t;");
    let numbers = |value: &serde_json::Value| -> Vec<f64> {
        value.as_array().unwrap().iter().map(|v| v.as_f64().unwrap()).collect()
    };
    // The centre of a face, half a texel off.
    for (face, expected) in [("+x", [1.0, 0.5, 0.5]), ("-y", [0.5, 0.0, 0.5]), ("-z", [0.5, 0.5, 0.0])] {
        let close = |values: &[f64]| values.iter().zip(&expected).all(|(a, b)| (a - b).abs() < 1e-3);
        let traced =
            b.line(&format!("trace p --size 16x16 --pass cube_a --face {face} --pixel 512,512 --json")).expect(0);
        let traced: serde_json::Value = serde_json::from_str(&traced.out).unwrap();
        assert_eq!((&traced["face"], &traced["format"]), (&face.into(), &"rgba16f".into()));
        assert!(close(&numbers(&traced["value"])[..3]) && close(&numbers(&traced["device"])[..3]), "{traced}");
        let probed =
            b.line(&format!("probe p cube_a:1:80 --size 16x16 --face {face} --pixel 512,512 --json")).expect(0);
        let probed: serde_json::Value = serde_json::from_str(&probed.out).unwrap();
        assert!(close(&numbers(&probed["value"])[..3]), "{probed}");
    }
    let image = b.line("probe p image:2:6 --size 16x16 --pixel 8,8 --json").expect(0);
    let image: serde_json::Value = serde_json::from_str(&image.out).unwrap();
    let length = 14f64.sqrt();
    let direction = [1.0, 2.0, 3.0].map(|c| 0.5 + 0.5 * c / length);
    let read = numbers(&image["value"]);
    assert!(read.iter().zip(&direction).all(|(a, b)| (a - b).abs() < 2e-3), "{image}");
    b.line("trace p --size 16x16 --face +x --pixel 1,1").expect(2);
    b.line("probe p image:2:6 --size 16x16 --face +x").expect(2);
}
