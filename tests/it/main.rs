//! Tests of Eddy's public interface, in one program because each test program links the whole library. `cargo test
//! --test it glsl_loops` runs the tests of one file, `cargo test --test it glsl_loops::pixels` those in it whose names
//! start with `pixels`.
//!
//! They run concurrently, on as many threads as there are processors. Tests that need isolation are separate programs:
//! - `damage` counts allocations with its own allocator, and has a panic hook;
//! - `driver_uniforms` measures the memory of its process;
//! - `costs` compares milliseconds of passes, which are drawn while nothing else is;
//! - `window` opens windows on its own displays, sends real keys and clicks, and waits for the result;
//! - `lost_device` opens such a window itself, on its first thread, and makes it lose its device.
//!
//! All share `support`. Compile times in these tests are CPU times of the test's thread ([`support::clock`]).

mod support;

mod bars;
mod checkpoints;
mod cli;
mod cli_measure;
mod cli_render;
mod compile_budget;
mod conditions;
mod cubemaps;
mod dialect_conversions;
mod dialect_pictures;
mod directives;
mod elsewhere;
mod engine;
mod exports;
mod farms;
mod fills;
mod films;
mod fixes;
mod float_hashes;
mod frame_bands;
mod gamepads;
mod geometry;
mod geometry_files;
mod glsl_bounds;
mod glsl_calls;
mod glsl_compute;
mod glsl_division;
mod glsl_drivers;
mod glsl_errors;
mod glsl_loops;
mod glsl_memory;
mod glsl_mutations;
mod glsl_order;
mod glsl_variables;
mod golden;
mod hostile_projects;
mod hostile_results;
mod includes;
mod killed_tasks;
mod lab;
mod lab_fluid;
mod lab_hard;
mod lab_open;
mod lab_peers;
mod lab_pictures;
mod lab_poisson;
mod lab_run;
mod lab_samples;
mod lab_shapes;
mod lab_stability;
mod layers;
mod long_arrays;
mod lsp;
mod lsp_dialects;
mod lsp_projects;
mod lsp_threads;
mod music;
mod next_project;
mod packages;
mod pass_edits;
mod passes;
mod paused;
mod preset_bloom;
mod preset_filters;
mod preset_flows;
mod preset_gbuffer;
mod preset_ir;
mod preset_looks;
mod preset_meanings;
mod preset_occlusion;
mod preset_particles;
mod preset_simulations;
mod preset_ssao;
mod preset_state;
mod preset_toon;
mod presets;
mod probes;
mod random_floats;
mod random_programs;
mod ranges;
mod recorder;
mod recovery;
mod reload;
mod reopened_pictures;
mod replaying;
mod saved_files;
mod session;
mod session_compare;
mod session_inside;
mod session_measures;
mod session_media;
mod session_sound;
mod session_videos;
mod sound;
mod sound_devices;
#[cfg(all(feature = "audio", target_os = "linux"))]
mod sound_server;
#[cfg(unix)]
mod terminal_output;
mod thumbnails;
mod tiles;
mod time_travel;
mod tools;
mod translate;
mod uniform_values;
mod uniforms;
mod unloaded_channels;
mod videos;
mod walker;
mod walker_corpus;
mod walker_meshes;
mod walker_presets;
mod walker_textures;
mod web_page;
