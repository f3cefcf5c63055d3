//! The place and the size that the window opens with, and the error if it cannot.

use super::{GuiError, Options, settings::WindowPlace, window_identity};
use winit::{
    dpi::{LogicalSize, PhysicalPosition, PhysicalSize},
    event_loop::ActiveEventLoop,
    window::{Window, WindowAttributes},
};

/// Returns the place and size of the new window: from the command line, else as saved, else as suits the screen.
pub(super) fn attributes(event_loop: &ActiveEventLoop, options: &Options, place: &WindowPlace) -> WindowAttributes {
    let attributes = window_identity::identified(Window::default_attributes())
        .with_title("Eddy")
        .with_visible(false)
        .with_min_inner_size(LogicalSize::new(360.0, 240.0));
    if let Some((width, height)) = options.size {
        return attributes.with_inner_size(PhysicalSize::new(width, height));
    }
    let (width, height) = place.size.unwrap_or((1280.0, 760.0));
    let attributes = attributes.with_inner_size(LogicalSize::new(width, height)).with_maximized(place.is_maximized);
    // The screen may have been disconnected.
    let is_on_screen = |at: &(i32, i32)| {
        event_loop.available_monitors().any(|monitor| {
            let (from, size) = (monitor.position(), monitor.size().cast::<i32>());
            (from.x - 50..from.x + size.width - 100).contains(&at.0)
                && (from.y - 50..from.y + size.height - 100).contains(&at.1)
        })
    };
    match place.corner.filter(is_on_screen) {
        Some((x, y)) => attributes.with_position(PhysicalPosition::new(x, y)),
        None => attributes,
    }
}

/// Returns the window system's error without the source location that it starts with.
pub(super) fn no_display(error: impl std::fmt::Display) -> GuiError {
    let text = error.to_string();
    let reason = match text.rsplit_once(".rs:") {
        Some((_, rest)) => rest.trim_start_matches(|c: char| c.is_ascii_digit() || c == ':').trim(),
        None => &text,
    };
    GuiError::NoDisplay(reason.trim_end_matches('.').to_owned())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_missing_display_is_reported_plainly() {
        let error = no_display("os error at /somewhere/linux/mod.rs:788: Failed to open connection to X server.");
        let text = error.to_string();
        assert!(text.starts_with("no display found: Failed to open connection to X server. "), "{text}");
        assert!(text.contains("eddy render"));
    }
}
