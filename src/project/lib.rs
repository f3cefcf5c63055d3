//! A project is what the author wrote, as pure data, with its forms on disk.
//!
//! Owns [`Project`], `eddy.toml`, folders of GLSL files, import and export of Shadertoy JSON, and the presets inside
//! the binary. Does not depend on wgpu or naga; reads files only where a caller names them.

mod advice;
mod atomic;
mod bindings;
mod body;
mod condition;
pub mod confine;
mod controls;
pub mod convert;
mod custom_uniform_values;
mod custom_uniforms;
mod dialect;
pub mod directives;
mod embedded;
mod error;
mod expression;
mod file_names;
mod files;
mod fill_texts;
mod fills;
mod fingerprint;
mod folder;
mod geometry;
pub mod ghostty;
mod imports;
mod include_folders;
mod includes;
mod input;
mod inspect_comments;
mod isf;
pub mod json;
mod json_values;
pub mod limits;
mod lines;
mod load;
mod locate;
mod manifest;
mod media_files;
mod model;
mod names;
mod pads;
mod pass_edits;
mod pass_name;
mod picked;
pub mod presets;
mod role;
mod save;
mod settings;
mod snapshot;
mod source;
mod source_ids;
mod words;
mod writes;
pub mod xscreensaver;

pub use advice::{advice, missing_pass};
pub use atomic::{Staged, rename_temporary, write_with};
pub use bindings::{Bindings, MAX_CHANNELS, SLOTS};
pub use body::Body;
pub use condition::Condition;
pub use confine::FileError;
pub use controls::{ControlAddress, ControlBindings, ControlTarget, is_osc_path};
pub use custom_uniforms::{
    CustomUniform, CustomUniformRange, CustomUniformType, CustomUniformValue, CustomUniformValues, CustomUniforms,
};
pub use dialect::{
    AlphaRule, Dialect, DialectRow, EntryPoint, HostTexture, HostUniform, HostValue, MouseUnit, ShaderForm,
    SoundTexture, regenerated,
};
pub use directives::ignored_channel_lines;
pub use eddy_texture::{Dimension, TexelFormat};
pub use error::ProjectError;
pub use expression::{Expression, ExpressionError, Function, Operator, Syntax, Term};
pub use files::EditedTexts;
pub use fill_texts::FillText;
pub use fills::{Boundary, Fill, FillKind, FillValue, Written};
pub use fingerprint::Fingerprint;
pub use folder::declare_channels;
pub use geometry::{
    Camera, Cull, DepthTest, Geometry, MAX_TARGETS, MeshDraw, MeshSource, Normals, Stage, files_beside, unescaped,
};

pub use imports::{
    FileKind, Fit, ImportError, MODELS, PICTURES, RECORDING, SOUNDS, TextImport, VIDEOS, folder_of_parts,
    import_of_text, kind_of_file, new_for,
};
pub use include_folders::{INCLUDE_SETTING, INCLUDE_VARIABLE, expand_home};
pub use includes::{IncludeLines, include_names};
pub use input::{Input, InputKind, InputRow, InputSource};
pub use inspect_comments::{InspectComment, inspect_comments};
pub use isf::isf_of_vertex_shader;
pub use json::losses as json_losses;
pub use json_values::check_json_values;
pub use load::Loaded;
pub use locate::{folder_around, is_manifest, load, load_edited, project_of, stem};
pub use manifest::write as write_manifest;
pub use media_files::{face_file, next_numbered};
pub use model::{Channel, Filter, Info, Media, Origin, Pass, Project, Sampler, SamplerRules, Tab, Wrap, spec_of};
pub use names::{listed, nearest};
pub use pads::{PAD_AXES, PAD_BUTTONS, PADS, PadPart};
pub use pass_edits::{PassEdit, PassEditError, PassEdited};
pub use pass_name::PassName;
pub use picked::{at_home, bring_home, leave_home};
pub use role::{Role, RoleRow};
pub use save::{name_at, remove_renamed, save};
pub use settings::{Group, PassSettings, PassSize, Region, Side};
pub use snapshot::{SnapshotError, read_snapshot, write_snapshot};
pub use source::{Included, Source};
pub use source_ids::TextLocation;
pub use words::names_word;
pub use writes::{Overwrite, check_within, make_private, write_into, write_named};
