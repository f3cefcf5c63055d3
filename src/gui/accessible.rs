//! Names of widgets that are drawn by hand, for those who do not see them: screen readers, and tests.

use egui::{Response, Role, WidgetInfo};

/// Says what a widget is called.
pub(super) fn name(response: &Response, role: Role, name: impl AsRef<str>) {
    let is_enabled = response.enabled();
    response.widget_info(|| WidgetInfo::labeled(role, is_enabled, name.as_ref()));
}

/// The same for one of several, one of which is chosen.
pub(super) fn choice(response: &Response, role: Role, is_chosen: bool, name: impl AsRef<str>) {
    let is_enabled = response.enabled();
    response.widget_info(|| WidgetInfo::selected(role, is_enabled, is_chosen, name.as_ref()));
}
