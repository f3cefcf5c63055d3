//! Small intact projects, made in code, to be damaged.

use image::{DynamicImage, ImageFormat, Rgb, Rgb32FImage, Rgba, RgbaImage};
use std::io::Cursor;

#[derive(Clone)]
pub(crate) struct File {
    pub name: &'static str,
    pub bytes: Vec<u8>,
    /// The file may be damaged.
    pub is_target: bool,
}

pub(crate) struct Seed {
    pub name: &'static str,
    pub files: Vec<File>,
    /// The file to open, relative to the folder of the files.
    pub entry: &'static str,
}

pub(crate) fn target(name: &'static str, bytes: impl Into<Vec<u8>>) -> File {
    File { name, bytes: bytes.into(), is_target: true }
}

pub(crate) fn fixed(name: &'static str, text: &str) -> File {
    File { name, bytes: text.into(), is_target: false }
}

pub(crate) const IMAGE: &str =
    "void mainImage(out vec4 o, in vec2 p) { o = texture(iChannel0, p / iResolution.xy); }\n";
const VERTEX: &str = "in vec3 aPosition;\nin vec3 aNormal;\nin vec4 aTangent;\nin vec2 aUv;\nin vec4 aColor;\nout vec4 \
                      vColor;\n\
    void main() { vColor = aColor + aTangent + vec4(aNormal, aUv.x); gl_Position = iProjection * iView * iModel * \
    vec4(aPosition, 1.0); }\n";
const FRAGMENT: &str = "in vec4 vColor;\nlayout(location = 0) out vec4 color;\nvoid main() { color = vColor; }\n";

pub(crate) fn all() -> Vec<Seed> {
    let mut seeds = vec![manifest(), json()];
    let formats = [
        ("png", "pic.png", ImageFormat::Png),
        ("webp", "pic.webp", ImageFormat::WebP),
        ("hdr", "pic.hdr", ImageFormat::Hdr),
        ("jpeg", "pic.jpg", ImageFormat::Jpeg),
        ("gif", "pic.gif", ImageFormat::Gif),
        ("bmp", "pic.bmp", ImageFormat::Bmp),
        ("tga", "pic.tga", ImageFormat::Tga),
    ];
    seeds.extend(formats.map(|(name, file, format)| picture(name, file, format)));
    seeds.push(model("gltf", "m.gltf", vec![target("m.gltf", gltf(Some("m.bin"))), target("m.bin", binary())]));
    let inside = format!("data:application/octet-stream;base64,{}", base64(&binary()));
    seeds.push(model("gltf with data", "m.gltf", vec![target("m.gltf", gltf(Some(&inside)))]));
    seeds.push(model("glb", "m.glb", vec![target("m.glb", glb())]));
    seeds.push(model("obj", "m.obj", vec![target("m.obj", OBJ)]));
    seeds.extend(super::media_seeds::all());
    seeds
}

fn manifest() -> Seed {
    let toml = "eddy = 1\nname = \"seed\"\nauthor = \"nobody\"\ntags = [\"a\", \"b\"]\n\n[groups.g]\npasses = \
                [\"buffer_a\"]\n\
        steps = 2\n\n[passes.buffer_a]\nsize = [16, 8]\nformat = \"rgba16f\"\n\
        channels.0 = { buffer = \"A\", filter = \"nearest\", wrap = \"clamp\" }\n\
        channels.1 = { keyboard = true }\n\n[passes.image]\nchannels.0 = { buffer = \"A\" }\n\
        channels.1 = { texture = \"noise-rgba-64\", vflip = false }\n";
    let buffer = "void mainImage(out vec4 o, in vec2 p) { o = texelFetch(iChannel0, ivec2(p), 0) + 0.1; }\n";
    let files = vec![target("eddy.toml", toml), target("image.glsl", IMAGE), target("buffer_a.glsl", buffer)];
    Seed { name: "eddy.toml", files, entry: "" }
}

fn json() -> Seed {
    let pass = |kind: &str, name: &str, id: &str| {
        format!(
            r#"{{"inputs":[{{"id":"4dXGR8","src":"/media/previz/buffer00.png","ctype":"buffer","channel":0,
            "sampler":{{"filter":"linear","wrap":"clamp","vflip":"true","srgb":"false","internal":"byte"}},
            "published":1}}],
            "outputs":[{{"id":"{id}","channel":0}}],"code":"{}","name":"{name}","description":"","type":"{kind}"}}"#,
            IMAGE.trim_end()
        )
    };
    let text = format!(
        r#"{{"ver":"0.1","info":{{"id":"abcdef","date":"1500000000","viewed":12,"name":"seed","username":"nobody",
        "description":"of nothing","likes":3,"published":3,"flags":32,"usePreview":0,"tags":["a","b"],"hasliked":0}},
        "renderpass":[{},{}]}}"#,
        pass("image", "Image", "4dfGRr"),
        pass("buffer", "Buffer A", "4dXGR8")
    );
    Seed { name: "json", files: vec![target("seed.json", text)], entry: "seed.json" }
}

fn picture(name: &'static str, file: &'static str, format: ImageFormat) -> Seed {
    let color = |x: u32, y: u32| [(x * 29) as u8, (y * 31) as u8, (x * y) as u8];
    let image: DynamicImage = match format {
        ImageFormat::Hdr => Rgb32FImage::from_fn(12, 9, |x, y| Rgb(color(x, y).map(|c| f32::from(c) / 32.0))).into(),
        ImageFormat::Jpeg => image::RgbImage::from_fn(19, 17, |x, y| Rgb(color(x, y))).into(),
        _ => RgbaImage::from_fn(12, 9, |x, y| {
            let [r, g, b] = color(x, y);
            Rgba([r, g, b, 200])
        })
        .into(),
    };
    let mut bytes = Cursor::new(Vec::new());
    image.write_to(&mut bytes, format).unwrap();
    let toml = format!("eddy = 1\n\n[passes.image]\nchannels.0 = {{ file = \"{file}\" }}\n");
    let files = vec![fixed("eddy.toml", &toml), fixed("image.glsl", IMAGE), target(file, bytes.into_inner())];
    Seed { name, files, entry: "" }
}

fn model(name: &'static str, file: &str, mut files: Vec<File>) -> Seed {
    let toml = format!(
        "eddy = 1\n\n[passes.buffer_a]\ndraw = [{{ mesh = \"{file}\", vertex = \"a.vert.glsl\" }}]\n\n[passes.image]\n\
         channels.0 = {{ buffer = \"A\" }}\n"
    );
    files.extend([
        fixed("eddy.toml", &toml),
        fixed("a.vert.glsl", VERTEX),
        fixed("buffer_a.glsl", FRAGMENT),
        fixed("image.glsl", IMAGE),
    ]);
    Seed { name, files, entry: "" }
}

/// Four corners of two triangles: positions, normals, texture coordinates, colours, indices, and the two positions that
/// a sparse accessor replaces.
fn binary() -> Vec<u8> {
    let corners = [[0.0f32, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]];
    let mut bytes: Vec<u8> = Vec::new();
    let mut floats = |numbers: &[f32]| numbers.iter().for_each(|x| bytes.extend(x.to_le_bytes()));
    corners.iter().for_each(|[x, y]| floats(&[*x, *y, 0.25]));
    (0..4).for_each(|_| floats(&[0.0, 0.0, 1.0]));
    corners.iter().for_each(|uv| floats(uv));
    bytes.extend([255, 0, 0, 255].repeat(4));
    [0u16, 1, 2, 0, 2, 3].iter().for_each(|i| bytes.extend(i.to_le_bytes()));
    bytes.extend([1, 3, 0, 0]);
    [0.5f32, 0.5, 2.0, -0.5, 0.5, 2.0].iter().for_each(|x| bytes.extend(x.to_le_bytes()));
    bytes
}

fn gltf(uri: Option<&str>) -> String {
    let length = binary().len();
    let uri = uri.map_or(String::new(), |uri| format!(r#","uri":"{uri}""#));
    let plain = r#"{"POSITION":0,"NORMAL":1,"TEXCOORD_0":2,"COLOR_0":3}"#;
    format!(
        r#"{{"asset":{{"version":"2.0"}},"scene":0,"scenes":[{{"nodes":[0,3]}}],
"nodes":[{{"children":[1,2],"rotation":[0,0,0,1]}},{{"mesh":0,"scale":[-2,1,1]}},
 {{"mesh":1,"translation":[0,1,0]}},{{"mesh":0}}],
"meshes":[{{"primitives":[{{"attributes":{plain},"indices":4}}]}},
 {{"primitives":[{{"attributes":{{"POSITION":5}},"mode":5}},
  {{"attributes":{{"POSITION":0,"TEXCOORD_0":2}},"mode":6}}]}}],
"accessors":[
 {{"bufferView":0,"componentType":5126,"count":4,"type":"VEC3","min":[0,0,0.25],"max":[1,1,0.25]}},
 {{"bufferView":1,"componentType":5126,"count":4,"type":"VEC3"}},
 {{"bufferView":2,"componentType":5126,"count":4,"type":"VEC2"}},
 {{"bufferView":3,"componentType":5121,"normalized":true,"count":4,"type":"VEC4"}},
 {{"bufferView":4,"componentType":5123,"count":6,"type":"SCALAR"}},
 {{"bufferView":0,"componentType":5126,"count":4,"type":"VEC3","min":[-1,0,0],"max":[1,1,2],
  "sparse":{{"count":2,"indices":{{"bufferView":5,"componentType":5121}},"values":{{"bufferView":6}}}}}}],
"bufferViews":[{{"buffer":0,"byteLength":48,"byteStride":12}},{{"buffer":0,"byteOffset":48,"byteLength":48}},
 {{"buffer":0,"byteOffset":96,"byteLength":32}},{{"buffer":0,"byteOffset":128,"byteLength":16}},
 {{"buffer":0,"byteOffset":144,"byteLength":12}},{{"buffer":0,"byteOffset":156,"byteLength":4}},
 {{"buffer":0,"byteOffset":160,"byteLength":24}}],
"buffers":[{{"byteLength":{length}{uri}}}]}}"#
    )
}

fn glb() -> Vec<u8> {
    let (mut text, binary) = (gltf(None).into_bytes(), binary());
    text.resize(text.len().next_multiple_of(4), b' ');
    let number = |n: usize| (n as u32).to_le_bytes();
    let length = number(28 + text.len() + binary.len());
    let (text_length, binary_length) = (number(text.len()), number(binary.len()));
    [b"glTF", &number(2)[..], &length, &text_length, b"JSON", &text, &binary_length, b"BIN\0", &binary].concat()
}

fn base64(bytes: &[u8]) -> String {
    const LETTERS: &[u8; 64] = b"ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    let four = |b: &[u8]| {
        let byte = |n: usize| u32::from(b.get(n).copied().unwrap_or(0));
        let n = byte(0) << 16 | byte(1) << 8 | byte(2);
        let letter = |i: usize| if i <= b.len() { LETTERS[(n >> (18 - 6 * i) & 63) as usize] as char } else { '=' };
        [0, 1, 2, 3].map(letter)
    };
    bytes.chunks(3).flat_map(four).collect()
}

const OBJ: &str = "# two triangles and a quad\nmtllib none.mtl\no first\nv 0 0 0 1 0 0\nv 1 0 0 1 0 0\nv 1 1 0 1 0 \
                   0\nv 0 1 0 1 0 0\nvt 0 0\nvt 1 0\n\
    vt 1 1\nvn 0 0 1\nf 1/1/1 2/2/1 3/3/1\nf 1/1/1 3/3/1 4/2/1\ng second\nusemtl none\nv 0 0 1 1 0 0\nv 1 0 1 1 0 0\nf \
    -1 -2 1 2\n";
