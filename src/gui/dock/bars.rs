//! The rows over panels: titles to drag them by and to choose between those that share a place, and close buttons.

use super::{BAR, Heights, Panel, tree};
use crate::gui::{
    icons::{self, Icon},
    theme,
};
use egui::{Align2, Color32, FontId, Id, Rect, Response, Role, Sense, Stroke, Ui, Visuals, WidgetInfo, vec2};
use egui_tiles::{
    Behavior, Container, EditAction, ResizeState, SimplificationOptions, TabState, Tabs, Tile, TileId, Tiles, Tree,
    UiResponse,
};
use std::collections::BTreeSet;

/// The contents of the panels.
pub(crate) trait Contents {
    /// Shows a panel. Returns true if a drag of its own row starts.
    fn show(&mut self, ui: &mut Ui, panel: Panel) -> bool;
    /// Shows a panel's controls at the right end of its row.
    fn tools(&mut self, ui: &mut Ui, panel: Panel);
    /// Returns the title, which may say more than the panel's name.
    fn title(&self, panel: Panel) -> String;
    fn heights(&self) -> Heights;
    /// Records the place of a widget, for scripts that click on it.
    fn place(&mut self, name: String, rect: Rect);
}

pub(super) struct Bars<'a> {
    contents: &'a mut dyn Contents,
    /// Groups without such a row.
    bare: BTreeSet<u64>,
    /// Groups of several panels.
    shared: BTreeSet<u64>,
    /// Something was moved.
    pub is_edited: bool,
    pub closed: Option<Panel>,
}

impl<'a> Bars<'a> {
    pub(super) fn new(contents: &'a mut dyn Contents, tree: &Tree<Panel>) -> Self {
        let (mut bare, mut shared) = (BTreeSet::new(), BTreeSet::new());
        for (id, tile) in tree.tiles.iter() {
            let Tile::Container(Container::Tabs(tabs)) = tile else { continue };
            let seen: Vec<&TileId> = tabs.children.iter().filter(|id| tree.tiles.is_visible_in_layout(**id)).collect();
            match seen[..] {
                [only] if tree.tiles.get_pane(only).is_some_and(|panel| panel.has_own_row()) => drop(bare.insert(id.0)),
                [_] => {}
                _ => drop(shared.insert(id.0)),
            }
        }
        Self { contents, bare, shared, is_edited: false, closed: None }
    }
}

impl Behavior<Panel> for Bars<'_> {
    fn pane_ui(&mut self, ui: &mut Ui, _: TileId, panel: &mut Panel) -> UiResponse {
        let p = theme::of(ui);
        ui.painter().rect_filled(ui.max_rect(), 0.0, p.panel);
        ui.set_clip_rect(ui.max_rect().intersect(ui.clip_rect()));
        if self.contents.show(ui, *panel) { UiResponse::DragStarted } else { UiResponse::None }
    }

    fn tab_title_for_pane(&mut self, panel: &Panel) -> egui::WidgetText {
        self.contents.title(*panel).into()
    }

    fn tab_ui(&mut self, tiles: &mut Tiles<Panel>, ui: &mut Ui, id: Id, tile_id: TileId, state: &TabState) -> Response {
        let panel = tiles.get_pane(&tile_id).copied();
        let title = panel.map_or_else(|| "Panels".to_owned(), |panel| self.contents.title(panel));
        let p = theme::of(ui);
        let shares = tiles.parent_of(tile_id).is_some_and(|group| self.shared.contains(&group.0));
        let color = if state.active { p.text } else { p.weak };
        let galley = ui.painter().layout_no_wrap(title.clone(), FontId::proportional(12.5), color);
        let (_, rect) = ui.allocate_space(vec2(galley.size().x + 22.0, ui.available_height()));
        let response = ui.interact(rect, id, Sense::click_and_drag());
        response.widget_info(|| WidgetInfo::selected(Role::Button, true, state.active, &title));
        if ui.is_rect_visible(rect) && !state.is_being_dragged {
            if response.hovered() && shares && !state.active {
                ui.painter().rect_filled(rect, 0.0, p.raised);
            }
            let at = Align2::LEFT_CENTER.align_size_within_rect(galley.size(), rect.shrink2(vec2(11.0, 0.0)));
            ui.painter().galley(at.min, galley, color);
            if shares && state.active {
                let line = rect.shrink2(vec2(11.0, 0.0)).x_range();
                ui.painter().hline(line, rect.bottom() - 1.5, Stroke::new(2.0, p.accent));
            }
        }
        if let Some(panel) = panel {
            self.contents.place(format!("panel:{}", panel.name()), rect);
        }
        response.on_hover_cursor(egui::CursorIcon::Grab).on_hover_text("Drag to move")
    }

    /// Fills the empty part of the row, by which the panel in front can be dragged too.
    fn tab_bar_left_ui(&mut self, _: &Tiles<Panel>, ui: &mut Ui, group: TileId, tabs: &Tabs) {
        let free = ui.available_rect_before_wrap();
        let handle = ui.interact(free, Id::unique(("dock row", group)), Sense::CLICK | Sense::DRAG);
        if let Some(front) = tabs.active.filter(|_| handle.drag_started()) {
            ui.set_dragged_id(front.egui_id(tree::id()));
        }
        handle.on_hover_cursor(egui::CursorIcon::Grab);
    }

    /// Groups are dragged by the panel in front.
    fn is_tile_draggable(&self, _: &Tiles<Panel>, id: TileId) -> bool {
        // The tile that is being shown is taken out of the others.
        Panel::all().any(|panel| panel.tile() == id)
    }

    /// The dock has separators of its own.
    fn is_container_resizable(&self, _: &Tiles<Panel>, _: TileId) -> bool {
        false
    }

    fn top_bar_right_ui(&mut self, tiles: &Tiles<Panel>, ui: &mut Ui, _: TileId, tabs: &Tabs, _: &mut f32) {
        let Some(panel) = tabs.active.and_then(|id| tiles.get_pane(&id).copied()) else { return };
        ui.add_space(4.0);
        ui.spacing_mut().item_spacing.x = 4.0;
        let close = icons::flat(ui, Icon::Close, &format!("Close {}", panel.title()));
        self.contents.place(format!("panel:close:{}", panel.name()), close.rect);
        if close.on_hover_text("Close (reopen it from the View menu)").clicked() {
            self.closed = Some(panel);
        }
        self.contents.tools(ui, panel);
    }

    fn on_edit(&mut self, action: EditAction) {
        self.is_edited |= action == EditAction::TileDropped;
    }

    fn simplification_options(&self) -> SimplificationOptions {
        SimplificationOptions { all_panes_must_have_tabs: true, ..SimplificationOptions::default() }
    }

    fn is_tab_bar_visible(&self, id: TileId, _: &Tabs) -> bool {
        !self.bare.contains(&id.0)
    }

    fn tab_bar_height(&self, _: &egui::Style) -> f32 {
        BAR
    }

    fn tab_bar_color(&self, visuals: &Visuals) -> Color32 {
        theme::of_visuals(visuals).panel
    }

    fn tab_bar_hline_stroke(&self, _: &Visuals) -> Stroke {
        Stroke::NONE
    }

    fn gap_width(&self, _: &egui::Style) -> f32 {
        1.0
    }

    fn resize_stroke(&self, style: &egui::Style, _: ResizeState) -> Stroke {
        Stroke::new(1.0, theme::of_visuals(&style.visuals).line)
    }

    fn drag_preview_stroke(&self, visuals: &Visuals) -> Stroke {
        Stroke::new(1.0, theme::of_visuals(visuals).accent)
    }

    fn drag_preview_color(&self, visuals: &Visuals) -> Color32 {
        theme::of_visuals(visuals).accent.gamma_multiply(0.3)
    }

    /// Ctrl+Tab belongs to the text.
    fn cycle_tabs_with_keyboard(&self) -> bool {
        false
    }
}
