//! End to end: the real window on a separate display, controlled by real mouse and key events.

#[path = "../it/support/mod.rs"]
mod support;

mod pictures;
mod random;
mod window;
mod window_audit;
mod window_buffers;
mod window_channels;
mod window_compare;
mod window_controls;
mod window_costs;
mod window_devices;
mod window_editor;
mod window_elsewhere;
mod window_endurance;
mod window_fields;
mod window_first;
mod window_gpu;
mod window_keyboard;
mod window_keys;
mod window_kills;
mod window_lab;
mod window_layout;
mod window_measures;
mod window_passes;
mod window_recorder;
mod window_replay;
mod window_resolution;
mod window_save;
mod window_settings;
mod window_slow;
#[cfg(all(feature = "audio", target_os = "linux"))]
mod window_sound;
mod window_state;
mod window_surface;
// Access to the portal needs a library that only the window uses.
#[cfg(all(feature = "gui", not(any(windows, target_os = "macos"))))]
mod window_theme;
mod window_time;
mod window_trace;
mod window_wild;
