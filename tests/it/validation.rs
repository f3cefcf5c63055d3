//! Small projects under Vulkan's validation layers: no message that `tests/validation/accepted.txt` does not accept.
//! `scripts/validation` draws everything that Eddy can.

use crate::support::{program::Bench, *};
use std::{collections::BTreeSet, fs, path::Path};

/// The libraries of the layer: Debian's package `vulkan-validationlayers`, and Chromium's, which is newer.
const DEBIAN: &str = "/usr/share/vulkan/explicit_layer.d/VkLayer_khronos_validation.json";
const CHROMIUM: &str = "/usr/lib/chromium/libVkLayer_khronos_validation.so";

const LAYER: &str = "VK_LAYER_KHRONOS_validation";

/// Arrays and structures in variables of each kind, and a uniform array that is copied as a whole. The long array is
/// one that some drivers get without an initialiser.
const LOCALS: &str = "
    struct Light { vec3 color; float size[3]; };
    Light global; float far[400];
    float largest(Light lights[2]) { lights[1].color.x += 1.; return max(lights[0].size[1], lights[1].color.x); }
    void mainImage(out vec4 o, in vec2 p) {
        Light lights[2]; vec2 line[5]; vec3 sizes[4] = iChannelResolution;
        for (int i = 0; i < 5; i++) line[i] = p * float(i);
        lights[int(p.x) & 1].size[int(p.y) % 3] = line[int(p.x) % 5].y;
        far[int(p.x)] = largest(lights);
        global = lights[0];
        o = vec4(global.size[int(p.x) % 3], far[int(p.y)], sizes[int(p.y) & 3].x, 1);
    }";

const INPUTS: &[(&str, &str)] = &[
    (
        "inputs/eddy.toml",
        "[passes.buffer_a]\nformat = 'r8'\nsize = 0.5\nchannels.0 = { keyboard = true }\n\
         [passes.cube_a]\nchannels.0 = { cube_a = true, filter = 'mipmap' }\n\
         [passes.image]\nchannels.0 = { buffer = 'A', filter = 'mipmap' }\n\
         channels.1 = { cube_a = true, filter = 'mipmap' }\n",
    ),
    (
        "inputs/buffer_a.glsl",
        "void mainImage(out vec4 o, in vec2 p) { o = texelFetch(iChannel0, ivec2(p), 0) + p.x / 99.; }",
    ),
    (
        "inputs/cube_a.glsl",
        "void mainCubemap(out vec4 o, in vec2 p, in vec3 at, in vec3 d) { o = .5 * texture(iChannel0, d) + abs(d.xyzx); }",
    ),
    (
        "inputs/image.glsl",
        "void mainImage(out vec4 o, in vec2 p) { vec2 uv = p / iResolution.xy; \
         o = textureLod(iChannel0, uv, 2.) + texture(iChannel1, vec3(uv, 1)); }",
    ),
];

const MESHES: &[(&str, &str)] = &[
    (
        "meshes/eddy.toml",
        "[passes.buffer_scene]\ntargets = ['rgba8', 'rgba16f']\ncamera = { distance = 4, fov = 30 }\n\
         draw = [{ mesh = 'builtin:knot', vertex = 'm.vert.glsl', fragment = 'm.frag.glsl' }]\n\
         [passes.image]\nchannels.0 = { buffer = 'scene' }\n",
    ),
    (
        "meshes/m.vert.glsl",
        "in vec3 aPosition, aNormal; in vec2 aUv; out vec3 normal; out vec2 uv; void main() { vec4 rows[2]; rows[gl_VertexID & 1] = iModel * vec4(aPosition, 1); \
         normal = aNormal; uv = aUv; gl_Position = iProjection * iView * (rows[0] + rows[1]); }",
    ),
    (
        "meshes/m.frag.glsl",
        "in vec3 normal; layout(location = 0) out vec4 o; layout(location = 1) out vec4 n; \
         void main() { o = vec4(1); n = vec4(normal, 1); }",
    ),
    ("meshes/image.glsl", "void mainImage(out vec4 o, in vec2 p) { o = texelFetch(iChannel0, ivec2(p), 0); }"),
];

const SOUND: &str = "vec2 mainSound(int samp, float time) { \
    float notes[4] = float[](220., 330., 440., 550.); return vec2(sin(notes[samp & 3] * time)); }";

/// Returns the messages that are accepted outside of a window.
fn accepted() -> BTreeSet<String> {
    let text = fs::read_to_string(concat!(env!("CARGO_MANIFEST_DIR"), "/tests/validation/accepted.txt")).unwrap();
    let lines = text.lines().filter(|line| !line.is_empty() && !line.starts_with('#'));
    let parts = lines.map(|line| line.split_once(' ').unwrap_or_else(|| panic!("no place: {line}")));
    parts.filter(|(_, rest)| rest.starts_with("everywhere ")).map(|(name, _)| name.to_owned()).collect()
}

/// Returns the names of the messages in a log: the words that start like one.
fn messages(log: &str) -> BTreeSet<String> {
    let words = log.split(|c: char| !(c.is_ascii_alphanumeric() || "-_.:".contains(c)));
    let kinds = ["VUID-", "UNASSIGNED-", "BestPractices-", "SYNC-HAZARD-"];
    words.filter(|word| kinds.iter().any(|kind| word.starts_with(kind))).map(str::to_owned).collect()
}

#[test]
fn validation_layers_accept_what_is_drawn() {
    let Some(bench) = Bench::with_gpu() else { return };
    bench.write("locals/image.glsl", LOCALS);
    INPUTS.iter().chain(MESHES).for_each(|(name, text)| bench.write(name, text));
    bench.image("sound/image.glsl", "fragColor = vec4(1);");
    bench.write("sound/sound.glsl", SOUND);
    // Chromium's library has no manifest where the loader looks for one.
    let manifest = format!(
        r#"{{"file_format_version": "1.2.0", "layer": {{"name": "{LAYER}", "type": "GLOBAL", "library_path": "{CHROMIUM}",
            "api_version": "1.4.0", "implementation_version": "1", "description": "validation"}}}}"#
    );
    bench.write("newest/layer.json", manifest);
    let settings = "khronos_validation.debug_action = VK_DBG_LAYER_ACTION_LOG_MSG\n\
        khronos_validation.report_flags = error,warn,perf\nkhronos_validation.log_filename = log.txt\n\
        khronos_validation.enables = VK_VALIDATION_FEATURE_ENABLE_SYNCHRONIZATION_VALIDATION_EXT,\
        VK_VALIDATION_FEATURE_ENABLE_BEST_PRACTICES_EXT\n\
        khronos_validation.validate_sync = true\nkhronos_validation.validate_best_practices = true\n";
    bench.write("vk_layer_settings.txt", settings);
    let accepted = accepted();
    for (library, folder) in [(DEBIAN, None), (CHROMIUM, Some(bench.path("newest")))] {
        if !Path::new(library).exists() {
            // Only Debian's is a package that `scripts/test` installs.
            let report = if folder.is_none() { missing } else { skipped };
            report(library);
            continue;
        }
        let runs: [&[&str]; 2] = [
            &["render", "locals", "inputs", "meshes", "--size", "64x36", "--frames", "2", "--out", "pictures"],
            &["render", "sound", "--pass", "sound", "--secs", "0.1", "--out", "sound.wav"],
        ];
        for arguments in runs {
            let mut command = bench.command();
            command.args(arguments).env("VK_INSTANCE_LAYERS", LAYER);
            command.env("VK_LAYER_SETTINGS_PATH", bench.path("vk_layer_settings.txt"));
            command.envs(folder.iter().map(|folder| ("VK_LAYER_PATH", folder)));
            program::run(&mut command).expect(0);
            let log = fs::read_to_string(bench.path("log.txt")).expect("the layer was loaded");
            fs::remove_file(bench.path("log.txt")).unwrap();
            let found = messages(&log);
            assert!(found.is_subset(&accepted), "{library}: {arguments:?}: {log}");
            // The layer is at work: each of these runs has an accepted message.
            assert!(!found.is_empty(), "{library}: {arguments:?}: {log}");
        }
    }
}
