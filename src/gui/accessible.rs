//! Accessible names of custom-painted widgets, for screen readers and tests.

use egui::{Response, Role, WidgetInfo};

/// Sets a widget's accessible name.
pub(super) fn name(response: &Response, role: Role, name: impl AsRef<str>) {
    let is_enabled = response.enabled();
    response.widget_info(|| WidgetInfo::labeled(role, is_enabled, name.as_ref()));
}

/// The same for one of several choices.
pub(super) fn choice(response: &Response, role: Role, is_chosen: bool, name: impl AsRef<str>) {
    let is_enabled = response.enabled();
    response.widget_info(|| WidgetInfo::selected(role, is_enabled, is_chosen, name.as_ref()));
}
