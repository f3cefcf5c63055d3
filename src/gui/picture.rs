//! The panel of the picture, with the transport bar below it.

use super::{
    panels::{Content, DefaultPlace, PanelContext, PanelRow},
    theme, transport,
    viewport::ViewportMode,
};
use egui::{CentralPanel, Frame, Margin, Panel, Ui};

pub(super) const PANEL: PanelRow = PanelRow {
    action: ("picture-panel", "Panel: Picture", &[], ""),
    is_open: true,
    ..PanelRow::new("picture", "Picture", DefaultPlace::Own, Content::WithRow(show))
};

/// Shows the picture and the bar. Returns true if a drag of the bar starts.
fn show(ui: &mut Ui, context: &mut PanelContext<'_>) -> bool {
    let PanelContext { viewport, session, out, .. } = context;
    let bar = Panel::bottom("transport")
        .exact_size(transport::HEIGHT)
        .frame(Frame::NONE.fill(theme::of(ui).panel).inner_margin(Margin::symmetric(8, 0)))
        .show_separator_line(false)
        .show(ui, |ui| transport::show(ui, session, viewport.shape(), out));
    CentralPanel::default().frame(Frame::NONE).show(ui, |ui| viewport.show(ui, session, ViewportMode::Panel, out));
    bar.inner
}
