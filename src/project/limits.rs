//! Limits on what a project may ask for, in one place.
//!
//! A project may be a stranger's. Each limit lies far beyond what a project needs and well below what the machine has,
//! and is checked before the memory is taken. `SECURITY.md` lists them all; a test keeps the two alike.

use std::fmt;

/// The most bytes that Eddy reads of a kind of file.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Limit {
    pub bytes: u64,
    /// The kind of file with its article: "a GLSL file".
    pub of: &'static str,
}

impl fmt::Display for Limit {
    /// `16 MiB, the limit for a GLSL file`.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}, the limit for {}", in_bytes(self.bytes), self.of)
    }
}

/// A number of bytes as people write it: `16 MiB`, `300 bytes`.
pub fn in_bytes(bytes: u64) -> String {
    match bytes {
        b if b >= 1 << 30 && b.is_multiple_of(1 << 30) => format!("{} GiB", b >> 30),
        b if b >= 1 << 20 && b.is_multiple_of(1 << 20) => format!("{} MiB", b >> 20),
        b if b >= 1 << 10 && b.is_multiple_of(1 << 10) => format!("{} KiB", b >> 10),
        b => format!("{b} bytes"),
    }
}

/// Returns an upper bound for the values and tables of a TOML text: the signs before them (`a.b = 1` has a table and a value),
/// those in texts, numbers and comments too. One takes a few hundred bytes once it is parsed, and its text may have two.
pub fn toml_values(text: &str) -> usize {
    text.bytes().filter(|byte| matches!(byte, b'=' | b',' | b'[' | b'{' | b'.')).count()
}

/// `eddy.toml`.
pub const MANIFEST: Limit = Limit { bytes: 2 << 20, of: "an eddy.toml" };
/// One GLSL text: a pass, a stage, Common or an included file.
pub const GLSL_TEXT: Limit = Limit { bytes: 8 << 20, of: "a GLSL file" };
/// All GLSL texts of a project together, those that they include among them.
pub const ALL_TEXTS: Limit = Limit { bytes: 64 << 20, of: "all GLSL files of a project together" };
/// A Shadertoy JSON file.
pub const JSON: Limit = Limit { bytes: 32 << 20, of: "a Shadertoy JSON file" };
/// The part of a Shadertoy JSON file that says more of a shader than its passes.
pub const JSON_INFO: Limit = Limit { bytes: 1 << 20, of: "the \"info\" of a Shadertoy JSON file" };
/// The JSON header of an ISF file.
pub const ISF_HEADER: Limit = Limit { bytes: 1 << 20, of: "the header of an ISF file" };
/// Parentheses and functions inside one another in the size of a pass of ISF.
pub const ISF_DEPTH: usize = 64;
/// A picture, a model, or a file that a model names.
pub const MEDIA_FILE: Limit = Limit { bytes: 512 << 20, of: "an image, a sound or a model" };
/// A model file together with the buffers that it names.
pub const MODEL_FILES: Limit = Limit { bytes: 512 << 20, of: "a model and its files" };

/// Values of `eddy.toml`, counted by the signs before them: `=`, `,`, `.`, `[` and `{`, in texts too.
pub const MANIFEST_VALUES: usize = 1 << 17;
/// Values in the JSON text of a project that an image file holds: its texts and what is said of each.
pub const PICTURE_VALUES: u64 = 1 << 18;
/// The scripts of mouse and keys that an image file holds.
pub const SCRIPT: Limit = Limit { bytes: 2 << 20, of: "the script in an image" };

/// A checkpoint of a run.
pub const CHECKPOINT: Limit = Limit { bytes: 16 << 30, of: "a checkpoint" };
/// The texels in a checkpoint.
pub const CHECKPOINT_BYTES: u64 = 16 << 30;
/// The texels in a checkpoint of targets that the run going on from it does not have. They are unpacked and dropped.
pub const CHECKPOINT_SKIPPED_BYTES: u64 = 1 << 30;

/// Texels across or along a picture: what the largest devices take.
pub const PICTURE_SIDE: u32 = 32_768;
/// A decoded picture: 4 bytes a texel, 16 where it holds floats. 8192x16384 texels, or 8192x4096 of floats.
pub const PICTURE_BYTES: u64 = 512 << 20;
/// Texels along each side of a volume, and slices of one: what the devices of today take.
pub const VOLUME_SIDE: u32 = 2048;
/// Seconds of a sound file that are decoded; 8 bytes a sample are kept of them.
pub const SOUND_SECONDS: u32 = 1_200;
/// Seconds after which a decoder of a sound file is given up.
pub const SOUND_DECODE_SECONDS: u64 = 60;
/// A video file. It is read piece by piece.
pub const VIDEO_FILE: Limit = Limit { bytes: 8 << 30, of: "a video" };
/// A decoded frame of a video, at 4 bytes a texel: 7680x4320 texels.
pub const VIDEO_FRAME_BYTES: u64 = 128 << 20;
/// Decoded frames of all videos of a project together that are kept or read ahead, besides two of each video.
pub const VIDEO_BYTES: u64 = 256 << 20;
/// Different videos of a project.
pub const VIDEOS: usize = 16;
/// Seconds that a video plays for.
pub const VIDEO_SECONDS: u32 = 21_600;
/// Frames of an animated image file, and image files of a sequence.
pub const VIDEO_IMAGES: usize = 20_000;
/// Seconds for which a decoder may give no frame before it is stopped.
pub const VIDEO_DECODE_SECONDS: u64 = 10;
/// Frames of a film that are drawn and wait to be encoded, besides two of them.
pub const FILM_QUEUE_BYTES: u64 = 256 << 20;
/// Pixels across or up of a picture that is drawn in tiles.
pub const TILED_SIDE: u32 = 262_144;
/// Pixels of a picture that is drawn in one piece where it can be drawn in tiles: 7680x4320 are less.
pub const WHOLE_PIXELS: u64 = 33_554_432;
/// Rows of a picture that is drawn in tiles that are drawn before they are encoded.
pub const STRIP_BYTES: u64 = 64 << 20;
/// A frame of a film whose picture is drawn in tiles, as it waits to be encoded.
pub const FILM_FRAME_BYTES: u64 = 2 << 30;
/// All pictures, sounds and models of a project together, as Eddy holds them.
pub const MEDIA_BYTES: u64 = 2 << 30;

/// Vertices of a model; a mesh that several nodes place counts for each. 64 bytes each.
pub const MODEL_VERTICES: u64 = 8 << 20;
/// Triangles of a model, counted likewise.
pub const MODEL_TRIANGLES: u64 = 16 << 20;
/// Primitives of a glTF file, counted likewise; objects and groups of an OBJ file.
pub const MODEL_PARTS: u64 = 1 << 20;
/// Joints of a model's skins.
pub const MODEL_JOINTS: u64 = 1 << 20;
/// Vertices of a model that morph targets and joints move, counted for each target that has a weight and for each set
/// of four joints.
pub const MODEL_MOVED: u64 = 256 << 20;
/// Pairs of triangle corners that meet at a place, all places together, in a part of a model whose tangents Eddy makes.
pub const TANGENT_PAIRS: u64 = 4 << 30;
/// Corners that are looked at to cut faces of an OBJ file that are not convex, all faces together: a matter of time.
pub const CONCAVE_STEPS: u64 = 1 << 30;
/// Objects in the JSON text of a glTF file: nodes, accessors and the like.
pub const GLTF_OBJECTS: u64 = 1 << 20;
/// Values in the JSON text of a glTF file.
pub const GLTF_VALUES: u64 = 8 << 20;

/// Elements of glTF accessors that no bytes of the file are there for (section 3.6.2.3: they are zeros), besides as many as the
/// file's bytes would hold. Positions, indices and instances; those of a mesh that several nodes place count for each.
pub const MODEL_ZEROS: u64 = 65_536;

/// Memory of the process in which a driver that compiles on the processor tries a large shader.
pub const DRIVER_BYTES: u64 = 3 << 29;

/// The steps of a trace, with the values in them. Those after it are counted.
pub const TRACE_BYTES: usize = 256 << 20;

/// Passes of a project.
pub const PASSES: usize = 1_000;
/// Files with a text of their own: passes, stages, Common and included files.
pub const TEXTS: usize = 10_000;
/// Files that a text has in it, each counted as often as it is included.
pub const INCLUDED: u64 = 10_000;
/// Folders above its own in which a single complete fragment shader may include a GLSL file.
pub const FOLDERS_ABOVE: usize = 4;
/// Files directly in a project's folder.
pub const FILES: usize = 50_000;
/// Folders above a file in which the language server looks for the project that it belongs to.
pub const FOLDERS_UP: usize = 16;
/// A message to the language server.
pub const LSP_MESSAGE: Limit = Limit { bytes: 64 << 20, of: "a message to the language server" };
/// Symbols, folds and hints of a document, and places of a name, that the language server returns for a request, each.
pub const LSP_ITEMS: usize = 10_000;
/// Passes and meshes that are drawn for one frame: those of a group count as often as the group has steps.
pub const DRAWS: u64 = 20_000;
/// Letters of the condition of a pass (`when`).
pub const CONDITION: usize = 1_000;
/// Parentheses and signs in one another in such a condition, and choices in an expression of an assertion.
pub const CONDITION_DEPTH: usize = 32;
/// Letters of an assertion, or of a quantity that a `//@probe` comment or `--probe` names. Its expressions nest as those
/// of conditions do.
pub const ASSERTION: usize = 4_000;
/// Values in `[uniforms]`.
pub const UNIFORMS: usize = 1_000;
/// Entries in `[controls]`.
pub const CONTROLS: usize = 1_000;
/// Letters of the OSC address of a control.
pub const OSC_PATH: usize = 255;
/// A datagram of OSC: the most that UDP carries over IPv4. Longer ones are cut by the system and dropped.
pub const OSC_PACKET: Limit = Limit { bytes: 65_507, of: "an OSC packet" };
/// Messages of an OSC packet, those of bundles in it among them.
pub const OSC_MESSAGES: usize = 1_024;
/// Bundles in one another.
pub const OSC_DEPTH: usize = 8;
/// Arguments of an OSC message.
pub const OSC_ARGUMENTS: usize = 64;
/// Different address patterns of OSC that are followed in a frame.
pub const OSC_PATTERNS: usize = 32;
/// Steps of comparing the address patterns of a frame with the addresses of a project: a part of a pattern with a letter.
pub const OSC_STEPS: u64 = 1 << 25;
/// Movements of controls that wait for the next frame.
pub const CONTROL_EVENTS: usize = 4_096;
/// MIDI devices that are open at once.
pub const MIDI_PORTS: usize = 32;
/// Letters of a buffer's or a group's name.
pub const NAME: usize = 64;

/// The file of a recording.
pub const RECORDING: Limit = Limit { bytes: 1 << 30, of: "a recording" };
/// A line of a recording, which is a frame.
pub const RECORDING_LINE: Limit = Limit { bytes: 16 << 20, of: "a line of a recording" };
/// The frames of a recording together, as Eddy holds them. A frame takes some hundred bytes, and its values.
pub const RECORDING_BYTES: u64 = 2 << 30;
/// The same of a project that was closed while paused, which is read when it is opened.
pub const RUN: Limit = Limit { bytes: 64 << 20, of: "the frames that lead to where a project was left" };
pub const RUN_BYTES: u64 = 256 << 20;
/// A file of settings, of keys, of recent projects or of what the window looked like.
pub const STATE_FILE: Limit = Limit { bytes: 4 << 20, of: "a file of settings" };
/// Values of such a file, counted as those of `eddy.toml` are.
pub const STATE_VALUES: usize = 1 << 17;
/// A file with unsaved work that a crash left behind.
pub const RECOVERY: Limit = Limit { bytes: 128 << 20, of: "a recovery file" };
/// A font that settings name.
pub const FONT: Limit = Limit { bytes: 64 << 20, of: "a font" };
/// The file with the results of the lab.
pub const LAB_RESULTS: Limit = Limit { bytes: 256 << 20, of: "the lab's results" };

/// Files and folders in a project's folder of a git revision, with those in folders below it.
pub const REVISION_ENTRIES: usize = 50_000;
/// Folders in one another, below a project's folder of a git revision.
pub const REVISION_DEPTH: usize = 64;
/// All files of a project's folder in a git revision together.
pub const REVISION_BYTES: Limit = Limit { bytes: 2 << 30, of: "a project's folder in a git revision" };
/// One commit, tag or tree of git.
pub const GIT_OBJECT: Limit = Limit { bytes: 16 << 20, of: "a commit, a tag or a tree of git" };
/// The file of a git repository that has its packed refs, or a ref's log.
pub const GIT_REFS: Limit = Limit { bytes: 64 << 20, of: "git's packed refs or a ref's log" };
/// Packs of a git repository.
pub const GIT_PACKS: usize = 10_000;
/// Deltas that an object of git is made of: git makes no longer chains (`pack.depth`).
pub const GIT_DELTAS: usize = 4_095;
/// Bytes that the deltas of one revision make, with those that others are made of.
pub const GIT_REBUILT_BYTES: u64 = 32 << 30;
