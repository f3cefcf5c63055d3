//! Pictures that `eddy render` draws in tiles have the same bytes as those drawn in one piece, and may be larger than
//! the device's textures.

use crate::support::program::{Bench, Npy};
use eddy::playback::scene::Scene;

/// Everything that tiles could affect: positions, derivatives along both axes, mip levels, neighbours in another
/// branch.
const PLACES: &str = "#define H(p) sin(p.x * p.y * .05 + cos(p.x * .7))
void mainImage(out vec4 o, in vec2 p) {
    float h = H(p), d = 0.;
    if (mod(floor(p.x / 5.) + floor(p.y / 3.), 2.) < 1.) d = dFdx(h) + 3. * dFdy(h * p.x);
    vec4 t = texture(iChannel0, p / 37., .5) + textureLod(iChannel0, p / iResolution.xy, 1.5);
    o = vec4(gl_FragCoord.xy + h, fwidth(h * h), d + t.x + t.y) + vec4(p / iResolution.xy, iTime, 0.);
    o.xyz += dFdx(t.yzw) + vec3(length(dFdy(p)), fwidth(gl_FragCoord.x), 0.);
}";

fn places(b: &Bench) {
    b.write("places/image.glsl", PLACES);
    let noise = |x: u32, y: u32, n: u32| ((x * 7 + y * 13 + n * 31).wrapping_mul(2_654_435_761) >> 16) as u8;
    let texture = image::RgbaImage::from_fn(64, 64, |x, y| image::Rgba([0, 1, 2, 3].map(|n| noise(x % 64, y % 64, n))));
    texture.save(b.path("places/noise.png")).unwrap();
    b.write(
        "places/eddy.toml",
        "eddy = 1\n[passes.image]\nchannels.0 = { file = \"noise.png\", filter = \"mipmap\", wrap = \"repeat\" }\n",
    );
}

#[test]
fn tiles_keep_positions_derivatives_and_mip_levels() {
    let Some(b) = Bench::with_gpu() else { return };
    places(&b);
    // Odd sizes: the quads of the last column and row extend beyond the picture.
    for size in ["67x45", "64x64", "1x3"] {
        b.line(&format!("render places --size {size} --at 5 --out whole.npy")).expect(0);
        for tile in [4, 12, 16, 36, 1000] {
            b.line(&format!("render places --size {size} --at 5 --tile {tile} --out tiled.npy")).expect(0);
            assert!(b.bytes("tiled.npy") == b.bytes("whole.npy"), "{size} in tiles of {tile}");
        }
    }
    // The comparison detects a difference.
    b.line("render places --size 1x3 --at 6 --out tiled.npy").expect(0);
    assert!(b.bytes("tiled.npy") != b.bytes("whole.npy"));
}

#[test]
fn presets_in_tiles_equal_those_in_one_piece() {
    let Some(b) = Bench::with_gpu() else { return };
    // Derivatives and mip levels in Image, buffers with their own size, states, cubemaps, meshes in buffers.
    for name in
        ["sky-spheres", "mip-fluid", "feedback", "bloom-sized", "gaussian-blur", "toon-outline", "ssao", "nocturne"]
    {
        b.line(&format!("render {name} --size 101x67 --frames 3 --out whole.npy")).expect(0);
        for tile in [20, 64] {
            b.line(&format!("render {name} --size 101x67 --frames 3 --tile {tile} --out tiled.npy")).expect(0);
            assert!(b.bytes("tiled.npy") == b.bytes("whole.npy"), "{name} in tiles of {tile}");
        }
    }
}

#[test]
fn all_formats_have_the_same_picture() {
    let Some(b) = Bench::with_gpu() else { return };
    places(&b);
    let draw = |more: &str, out: &str| b.line(&format!("render places --size 33x29 {more} --out {out}")).expect(0);
    for (format, more) in [("png", ""), ("png", "--depth 16"), ("exr", "--no-project"), ("npy", "")] {
        draw(&format!("{more} --at 3"), &format!("whole.{format}"));
        draw(&format!("{more} --at 3 --tile 8"), &format!("tiled.{format}"));
        let (whole, tiled) = (b.bytes(&format!("whole.{format}")), b.bytes(&format!("tiled.{format}")));
        match format {
            "png" => assert_eq!(image::load_from_memory(&tiled).unwrap(), image::load_from_memory(&whole).unwrap()),
            _ => assert!(tiled == whole, "{format}"),
        }
    }
    // Several texels, or several pictures, are averaged per pixel.
    for more in ["--supersample 3", "--shutter 0.5 --samples 3", "--supersample 2 --shutter 1 --samples 2"] {
        draw(&format!("{more} --at 2"), "whole.npy");
        draw(&format!("{more} --at 2 --tile 8"), "tiled.npy");
        assert!(b.bytes("tiled.npy") == b.bytes("whole.npy"), "{more}");
    }
    // Frames are encoded in one piece.
    draw("--frames 0-3 --chroma 444", "whole.y4m");
    draw("--frames 0-3 --chroma 444 --tile 12", "tiled.y4m");
    assert!(b.bytes("tiled.y4m") == b.bytes("whole.y4m"));
    let more = ["--size", "33x29", "--at", "3", "--tile", "8", "--format", "npy", "--out", "-"];
    let pipe = b.command().args(["render", "places"]).args(more).output().unwrap();
    draw("--at 3", "whole.npy");
    assert!(pipe.stdout == b.bytes("whole.npy"));
}

#[test]
fn a_tiled_picture_opens_at_its_frame() {
    let Some(b) = Bench::with_gpu() else { return };
    b.image("a.glsl", "fragColor = vec4(fract(fragCoord / 7.0), iTime, 1.0);");
    for name in ["a.png", "a.exr"] {
        b.line(&format!("render a.glsl --size 21x10 --at 4 --tile 8 --out {name}")).expect(0);
        let scene = Scene::read(&b.path(name)).unwrap();
        assert_eq!((scene.frame, scene.size), (4, (21, 10)));
    }
    b.line("render a.glsl --size 21x10 --tile 8 --no-project --out b.png").expect(0);
    assert!(Scene::read(&b.path("b.png")).is_err());
}

/// Returns a width greater than that of the device's largest texture.
fn too_wide() -> Option<u32> {
    let gpu = crate::support::gpu()?;
    Some(gpu.device.limits().max_texture_dimension_2d + 38)
}

#[test]
fn a_picture_can_be_larger_than_a_texture() {
    let (Some(b), Some(width)) = (Bench::with_gpu(), too_wide()) else { return };
    b.image("a.glsl", "fragColor = vec4(fragCoord, iResolution.x, dFdx(fragCoord.x * fragCoord.x));");
    b.line(&format!("render a.glsl --size {width}x3 --out a.npy")).expect(0);
    let wide: Npy = b.npy("a.npy");
    assert_eq!((wide.width, wide.height), (width as usize, 3));
    for x in [0, 2047, 2048, width as usize - 1] {
        let place = x as f32 + 0.5;
        assert_eq!(wide.at(x, 2)[..3], [place, 2.5, width as f32]);
        assert!((wide.at(x, 1)[3] / place - 2.0).abs() < 2.0, "{:?}", wide.at(x, 1));
    }
    b.line(&format!("render a.glsl --size 4x{width} --out b.npy")).expect(0);
    assert_eq!(b.npy("b.npy").at(3, width as usize - 1)[..2], [3.5, width as f32 - 0.5]);
    // Four times the pixels, averaged.
    let half = width / 2;
    b.line(&format!("render a.glsl --size {half}x2 --supersample 2 --out c.npy")).expect(0);
    assert_eq!(b.npy("c.npy").at(half as usize - 1, 0)[..3], [width as f32 - 1.0, 1.0, width as f32]);
}

#[test]
fn shards_and_checkpoints_work_with_tiles() {
    let (Some(b), Some(width)) = (Bench::with_gpu(), too_wide()) else { return };
    b.write("p/eddy.toml", "eddy = 1\n[passes.buffer_a]\nsize = [4, 4]\nchannels.0 = { buffer = \"A\" }\n[passes.image]\nchannels.0 = { buffer = \"A\" }\n");
    b.image(
        "p/buffer_a.glsl",
        "fragColor = texelFetch(iChannel0, ivec2(fragCoord), 0) + vec4(0.01, iTime, fragCoord);",
    );
    b.image("p/image.glsl", "fragColor = texelFetch(iChannel0, ivec2(mod(fragCoord, 4.0)), 0) + fragCoord.x * 1e-6;");
    let draw = |more: &str| b.line(&format!("render p --size {width}x2 --format npy {more}")).expect(0);
    draw("--frames 0-5 --out serial");
    draw("--frames 0-5 --checkpoint-every 2 --checkpoints states");
    for task in 0..3 {
        draw(&format!("--frames 0-5 --shard {task}/3 --resume states --out farm"));
    }
    assert_eq!(b.names("farm").len(), 6);
    for name in b.names("serial") {
        assert!(b.bytes(&format!("farm/{name}")) == b.bytes(&format!("serial/{name}")), "{name}");
    }
    // A state does not depend on the size of the tiles.
    draw("--at 5 --resume states --tile 64 --out other.npy");
    assert!(b.bytes("other.npy") == b.bytes("serial/p_0005.npy"));
}

#[test]
fn pictures_that_cannot_be_tiled_are_rejected_with_a_reason() {
    let (Some(b), Some(width)) = (Bench::with_gpu(), too_wide()) else { return };
    let limit = width - 38;
    b.image("holes.glsl", "if (fragCoord.x > 5.0) discard; fragColor = vec4(1.0);");
    b.image("plain.glsl", "fragColor = vec4(fragCoord, 0.0, 1.0);");
    b.image("p/buffer_a.glsl", "fragColor = texelFetch(iChannel0, ivec2(fragCoord), 0) + 0.1;");
    b.image("p/image.glsl", "fragColor = texelFetch(iChannel0, ivec2(fragCoord), 0);");
    b.write("p/eddy.toml", "eddy = 1\n[passes.buffer_a]\nchannels.0 = { buffer = \"A\" }\n[passes.image]\nchannels.0 = { buffer = \"A\" }\n");
    let large = format!("--size {width}x2");
    for (args, expected) in [
        (
            "holes.glsl --tile 8".to_owned(),
            vec!["Image cannot be drawn in tiles: it discards pixels", "give these pixels a colour"],
        ),
        (
            format!("holes.glsl {large}"),
            vec!["it discards pixels", &*format!("at most {limit}x{limit} pixels in one piece")],
        ),
        ("p --pass buffer_a --tile 8".into(), vec!["Buffer A cannot be drawn in tiles: it reads its own last picture"]),
        (
            format!("p {large}"),
            vec!["Buffer A of", "and Image alone is drawn in tiles: give the pass a fixed size in eddy.toml"],
        ),
        ("plain.glsl --tile 8 --probe max(image)".into(), vec!["--tile: a picture in tiles cannot be measured"]),
        (format!("plain.glsl {large} --no-skip"), vec!["--no-skip draws every pass in one piece"]),
        ("plain.glsl --size 300000x1".into(), vec!["a picture of 300000x1 pixels: it can have at most 262144 across"]),
        (
            "plain.glsl --size 262144x262144 --frames 2 --format y4m".into(),
            vec!["a frame of a film is encoded in one piece", "write png, exr or npy"],
        ),
    ] {
        let run =
            b.line(&format!("render {args} --out out.npy").replace("--format y4m --out out.npy", "--out out.y4m"));
        assert_ne!(run.code, Some(0), "{args}");
        for words in expected {
            assert!(run.err.contains(words), "{args}: {}", run.err);
        }
    }
    for args in ["--tile 6", "--tile 0", "--tile 8 --no-skip"] {
        assert_eq!(b.line(&format!("render plain.glsl --out a.png {args}")).code, Some(2), "{args}");
    }
    let run = b.line("render plain.glsl --size 8x8 --tile 4 --format exr --out -");
    assert!(run.err.contains("needs a file"), "{}", run.err);
    assert_eq!(b.names("."), ["holes.glsl", "p", "plain.glsl"], "incomplete files are left");
}
