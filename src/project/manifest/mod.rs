//! `eddy.toml`: the file that describes what the GLSL texts of a folder cannot.
//!
//! Owns the file's format, for reading and writing. Everything in it is optional except a pass named `image`.
//!
//! ```toml
//! eddy = 1                        # version of this form; a newer one is refused
//! name = "Fluid"
//! description = "Weakly compressible flow"
//! author = "…"
//! tags = ["fluid"]
//! period = 8                      # seconds after which the picture is the same again
//! sampler_rules = "site"          # default "channel"; "site" as projects from the site's JSON have it
//!
//! [uniforms]                      # values of `#iUniform` lines that differ from the default
//! viscosity = 0.4
//! tint = [1.0, 0.5, 0.0]
//!
//! [controls]                      # controls of MIDI and OSC devices that move uniforms
//! viscosity = "midi 1 cc 21"      # also cc14, note, bend; or an OSC address such as "/1/fader3"
//! tint.r = "/1/xy 2"              # the second argument of its messages
//!
//! [common]
//! file = "common.glsl"            # without this table, common.glsl is read where there is one; common = false: none
//!
//! # Buffers are drawn in the order in which they stand here.
//! [passes.buffer_a]
//! file = "buffer_a.glsl"          # default: the pass's name and .glsl
//! channels.0 = { buffer = "A", filter = "nearest", wrap = "repeat" }
//! size = 0.5                      # a factor of the canvas, or [256, 256]; iResolution there; default: the canvas
//! format = "rgba16f"              # or rgba8, rg32f, rg16f, rg8, r32f, r16f, r8; default "rgba32f"
//! initial = "vec4(0.5 + 0.1 * sin(0.1 * fragCoord.x), 0.0, 0.0, 1.0)"   # what it holds before frame 0; default zeros
//! boundary = { width = 1, value = "vec4(0.0)" }  # its outermost texels, overwritten after each draw
//! region = [0, 0, 64, 1]          # only these texels are drawn (x, y, width, height); the others keep what they held
//! when = "quality > 1"            # drawn only while this is true; else it holds what it holds before frame 0
//!
//! [groups.solver]                 # buffers that follow each other, drawn 20 times a frame, in order
//! passes = ["buffer_b", "buffer_c"]
//! steps = 20
//!
//! [passes.image]
//! channels.0 = { buffer = "A" }
//! channels.1 = { texture = "noise-rgba-256" }     # one of Eddy's own; also cubemap, volume, video, music
//! channels.2 = { file = "pic.png", vflip = false }
//! channels.3 = { keyboard = true }                # also cube_a, microphone, webcam, gamepad
//! ```
//!
//! `initial` and the `value` of `boundary` are GLSL expressions of type vec4, which see Common, `fragCoord` and
//! Shadertoy's uniforms, or `{ file = "state.npy" }`: a picture, or an array of shape (height, width) or (height,
//! width, 1 to 4), row 0 at the bottom. A file of another size than the pass is stretched over it.
//!
//! A pass of its own size has that as `iResolution`, and its readers as `iChannelResolution`; `iMouse` stays in canvas
//! pixels. Components that a format lacks read as 0, alpha as 1. The steps of a group see the same uniforms, and the
//! latest pictures of each other.
//!
//! A buffer that draws meshes instead of a full-screen triangle (a geometry pass):
//!
//! ```toml
//! [passes.buffer_scene]
//! targets = ["rgba8", "rgba16f"]  # formats of up to four targets; default: one of `format`
//! camera = { yaw = 30, pitch = 20, distance = 4, target = [0, 0, 0], fov = 45, near = 0.1, far = 100, orbit = true }
//! draw = [
//!   { mesh = "fox.glb", vertex = "scene.vert.glsl", fragment = "scene.frag.glsl" },
//!   { mesh = "fox.glb", vertex = "hull.vert.glsl", fragment = "ink.frag.glsl", cull = "front" },
//! ]
//! ```
//!
//! A mesh is `builtin:NAME` or a glTF (`.glb`, `.gltf`) or OBJ file. `fragment` may be omitted: then it is the pass's
//! `file`. Further keys of a draw: `normals` ("flat", "smooth": those that are generated if a model file has none, by
//! default flat for glTF and smooth for OBJ), `cull` ("back", "front", "none"), `depth` ("less", "less_equal", "equal",
//! "greater_equal", "greater", "not_equal", "always"), `depth_write`, `color_write`, `scale`, `rotation` (degrees about
//! x, y, z), `position`. A channel reads another target than the first by `{ buffer = "scene", target = 1 }`.
//!
//! A `file` is a picture unless `kind` says otherwise (`"cubemap"`, `"volume"`, `"video"`, `"music"`); a texture of
//! Shadertoy is `site = "/media/a/…"` with its `site_id`. `[shadertoy]` keeps the members of Shadertoy's JSON that Eddy
//! does not use.

mod controls;
mod edit;
mod fills;
mod geometry;
mod read;
mod reader;
mod renamed;
mod settings;
mod uniforms;
mod write;

pub(super) use read::project;
pub(super) use renamed::follow_renames;
pub use write::write;

/// The version of the format that this build writes, and the newest that it reads.
const VERSION: i64 = 1;
