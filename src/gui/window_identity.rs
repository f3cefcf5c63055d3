//! The name and the icon by which desktops identify the window. The files of packages have the same name.

use winit::window::{Icon, WindowAttributes};

/// The name of the desktop file without its extension. A desktop uses it to find the icon and the entry of a running
/// window: on Wayland it is the `app_id`, on X11 the class of the window.
#[cfg(all(unix, not(target_os = "macos")))]
const APP_ID: &str = "io.github.eddy_shaders.Eddy";

/// Used on X11 and Windows; other systems take the icon from the package. `scripts/draw-icon` draws it.
const ICON: &[u8] = include_bytes!("../../packaging/icon/64.png");

/// Returns the attributes with the name and the icon.
pub(super) fn identified(attributes: WindowAttributes) -> WindowAttributes {
    let icon = icon().inspect_err(|why| log::warn!("the icon of the window is not shown: {why}")).ok();
    named(attributes).with_window_icon(icon)
}

#[cfg(all(unix, not(target_os = "macos")))]
fn named(attributes: WindowAttributes) -> WindowAttributes {
    use winit::platform::{wayland, x11};
    let attributes = wayland::WindowAttributesExtWayland::with_name(attributes, APP_ID, "eddy");
    x11::WindowAttributesExtX11::with_name(attributes, APP_ID, "eddy")
}

#[cfg(not(all(unix, not(target_os = "macos"))))]
fn named(attributes: WindowAttributes) -> WindowAttributes {
    attributes
}

/// Decodes the icon, or returns a message that the file is damaged.
fn icon() -> Result<Icon, String> {
    let image = image::load_from_memory(ICON).map_err(|e| e.to_string())?.to_rgba8();
    let (width, height) = image.dimensions();
    Icon::from_rgba(image.into_raw(), width, height).map_err(|e| e.to_string())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn icon_can_be_decoded() {
        icon().unwrap();
    }

    #[cfg(all(unix, not(target_os = "macos")))]
    #[test]
    fn window_name_matches_the_desktop_file() {
        let path = format!("{}/packaging/linux/{APP_ID}.desktop", env!("CARGO_MANIFEST_DIR"));
        let text = std::fs::read_to_string(path).unwrap();
        assert!(text.contains(&format!("\nStartupWMClass={APP_ID}\n")), "{text}");
    }
}
