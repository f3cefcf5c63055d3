//! Detects whether the system prefers dark or light windows, if the window system does not report it.
//!
//! On Linux the desktop portal reports it over D-Bus; on other systems `winit` does.

use std::sync::{
    Arc,
    mpsc::{Receiver, channel},
};

/// Queries it once, and listens for changes. `wake` is called when a value has arrived.
#[cfg(not(any(windows, target_os = "macos")))]
pub(super) fn watch(wake: Arc<dyn Fn() + Send + Sync>) -> Receiver<egui::Theme> {
    let (sender, receiver) = channel();
    let work = move || {
        let tell = |theme: Option<egui::Theme>| {
            let is_heard = theme.is_none_or(|theme| sender.send(theme).is_ok());
            wake();
            is_heard
        };
        if let Err(error) = pollster::block_on(listen(tell)) {
            log::info!("the desktop portal does not report a dark or light theme: {error}");
        }
    };
    if let Err(error) = std::thread::Builder::new().name("system theme".into()).spawn(work) {
        log::warn!("cannot start a thread for the system theme: {error}");
    }
    receiver
}

#[cfg(any(windows, target_os = "macos"))]
pub(super) fn watch(_: Arc<dyn Fn() + Send + Sync>) -> Receiver<egui::Theme> {
    channel().1
}

#[cfg(not(any(windows, target_os = "macos")))]
async fn listen(tell: impl Fn(Option<egui::Theme>) -> bool) -> Result<(), ashpd::Error> {
    use ashpd::desktop::settings::{ColorScheme, Settings};
    use futures_lite::StreamExt as _;
    let theme = |scheme| match scheme {
        ColorScheme::PreferDark => Some(egui::Theme::Dark),
        ColorScheme::PreferLight => Some(egui::Theme::Light),
        ColorScheme::NoPreference => None,
    };
    let settings = Settings::new().await?;
    let mut changes = settings.receive_color_scheme_changed().await?;
    let mut goes_on = tell(theme(settings.color_scheme().await?));
    while goes_on && let Some(scheme) = changes.next().await {
        goes_on = tell(theme(scheme));
    }
    Ok(())
}
