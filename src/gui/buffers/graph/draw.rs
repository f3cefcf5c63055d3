//! The page of the graph: its nodes and edges, and the legend.

use super::layout::{LEGIBLE, Layout};
use crate::{
    engine::{PassRead, PassRole, ReadTiming},
    gui::{
        accessible,
        buffers::{state::Buffers, zoom::PlacedPicture},
        costs::{bytes, millis_text},
        theme::{self, Palette},
        ui_output::UiOutput,
    },
    project::PassName,
    session::{Session, TimedPass, buffers::reason},
};
use egui::{
    Align2, Color32, CursorIcon, FontId, Painter, Pos2, Rect, Sense, Shape, Stroke, StrokeKind, Ui, Vec2, pos2, vec2,
};

/// The height of the foot with the legend.
const LEGEND: f32 = 20.0;
const INITIAL_ZOOM: f32 = 0.75;

/// A read, from the pass that is read to its reader.
struct Arrow<'a> {
    from: usize,
    to: usize,
    read: &'a PassRead,
}

pub(crate) fn show(state: &mut Buffers, ui: &mut Ui, session: &Session, out: &mut UiOutput) {
    let passes = session.pass_costs().passes;
    let place = |pass: &PassName| passes.iter().position(|p| p.cost.pass == *pass);
    let mut arrows: Vec<Arrow<'_>> = Vec::new();
    for (to, pass) in passes.iter().enumerate() {
        let reads = pass.cost.reads.iter();
        arrows.extend(reads.filter_map(|read| Some(Arrow { from: place(&read.pass)?, to, read })));
    }
    // Passes that the code does not read are shown if they explain something; otherwise only in the tooltip.
    let is_drawn = |node: usize| matches!(passes[node].cost.role, PassRole::Drawn { .. });
    arrows.retain(|arrow| arrow.read.is_used || !is_drawn(arrow.from) || !is_drawn(arrow.to));
    // Passes read in the same frame were drawn before: these edges are acyclic.
    let (forward_arrows, back_arrows): (Vec<&Arrow<'_>>, Vec<&Arrow<'_>>) =
        arrows.iter().partition(|arrow| arrow.read.when == ReadTiming::ThisFrame && arrow.from != arrow.to);
    let ends = |arrows: &[&Arrow<'_>]| arrows.iter().map(|arrow| (arrow.from, arrow.to)).collect::<Vec<_>>();
    let room = ui.available_rect_before_wrap();
    let area = room.with_max_y(room.bottom() - LEGEND);
    let layout = Layout::new(passes.len(), &ends(&forward_arrows), &ends(&back_arrows), area.size());
    let shown = state.target(session.project()).map(|(pass, _)| pass);
    let middle =
        passes.iter().position(|p| shown.as_ref() == Some(&p.cost.pass)).map(|node| layout.nodes[node].center());
    let sheet = placed(state, ui, area, (&layout, middle), out);
    let responses: Vec<_> = (0..passes.len())
        .map(|node| {
            // Nodes out of view can be reached by the keyboard.
            let rect = sheet.rect(layout.nodes[node]);
            ui.interact(rect, ui.scope_id().with(("pass", node)), Sense::click())
        })
        .collect();
    let painter = ui.painter().with_clip_rect(area.intersect(ui.clip_rect()));
    let p = theme::of(ui);
    let lit = responses.iter().position(|response| response.hovered() || response.has_focus());
    for (arrow, path) in
        forward_arrows.iter().zip(&layout.forward_paths).chain(back_arrows.iter().zip(&layout.back_paths))
    {
        let is_lit = lit.is_some_and(|node| arrow.from == node || arrow.to == node);
        edge(&painter, &sheet, arrow.read, path, (is_lit, lit.is_some()), p);
    }
    let costs: Vec<_> = passes.iter().map(|pass| pass.cost.clone()).collect();
    let mut chosen = None;
    for ((node, pass), response) in passes.iter().enumerate().zip(responses) {
        let why = reason(&pass.cost.pass, &costs);
        let words = NodeLabels::new(pass, why.as_deref());
        let (rect, name) = (sheet.rect(layout.nodes[node]), pass.cost.pass.title());
        let spoken = why.as_ref().map_or_else(String::new, |why| format!(", {why}"));
        accessible::name(&response, egui::Role::Button, format!("{name}, {}, {}{spoken}", words.shape, words.cost));
        if response.gained_focus() && !area.contains_rect(rect) {
            let at = layout.nodes[node].center();
            state.sheet.show((at.x as u32, (layout.size.y - at.y) as u32), sheet.scale());
            ui.ctx().request_repaint();
        }
        let look = (shown.as_ref() == Some(&pass.cost.pass), response.hovered(), response.has_focus());
        paint(&painter, rect, &words, (look, sheet.scale()), p);
        out.place(format!("buffers:node:{name}"), rect.intersect(area));
        let response = response.on_hover_cursor(CursorIcon::PointingHand).on_hover_ui(|ui| tip(ui, pass, &words));
        if response.clicked() {
            chosen = Some(pass.cost.pass.clone());
        }
    }
    legend(ui, room.with_min_y(area.bottom()), session.transport().playing, out);
    ui.advance_cursor_after_rect(room);
    if let Some(pass) = chosen {
        state.choose((pass, 0));
    }
}

/// Places the sheet, which is zoomed by the wheel and moved by dragging.
fn placed(
    state: &mut Buffers,
    ui: &Ui,
    area: Rect,
    (layout, middle): (&Layout, Option<Pos2>),
    out: &mut UiOutput,
) -> Sheet {
    let size = (layout.size.x.ceil().max(1.0) as u32, layout.size.y.ceil().max(1.0) as u32);
    let response = ui.interact(area, ui.scope_id().with("sheet"), Sense::drag());
    accessible::name(&response, egui::Role::Canvas, "Render graph");
    out.place("buffers:sheet", area);
    if std::mem::replace(&mut state.sheet_of, size) != size {
        state.sheet.fit();
        // Of a large graph first show a part that is legible.
        if let Some(at) = middle.filter(|_| state.sheet.place(area, size).scale < LEGIBLE) {
            // The graph starts at the left edge of the sheet, with nothing beyond it.
            let half = area.width() / 2.0 / INITIAL_ZOOM;
            let x = at.x.clamp(half.min(layout.size.x / 2.0), (layout.size.x - half).max(layout.size.x / 2.0));
            state.sheet.show((x as u32, (layout.size.y - at.y) as u32), INITIAL_ZOOM);
        }
    }
    let placed = state.sheet.place(area, size);
    if response.dragged() {
        state.sheet.drag(&placed, response.drag_delta());
    }
    // Also over a node, which is on top of it.
    let pointer =
        ui.input(|i| i.pointer.latest_pos()).filter(|at| ui.rect_contains_pointer(area) && area.contains(*at));
    if let Some(at) = pointer {
        let (wheel, pinch) = ui.input(|i| (i.smooth_scroll_delta().y, i.zoom_delta()));
        let factor = (wheel * 0.01).exp() * pinch;
        if factor != 1.0 {
            state.sheet.about(&placed, at, factor);
        }
    }
    Sheet { placed: state.sheet.place(area, size), height: size.1 as f32 }
}

/// The place of the layout's sheet on the screen.
struct Sheet {
    placed: PlacedPicture,
    height: f32,
}

impl Sheet {
    fn point(&self, at: Pos2) -> Pos2 {
        // A picture's rows count from the bottom.
        self.placed.point(pos2(at.x, self.height - at.y))
    }

    fn rect(&self, rect: Rect) -> Rect {
        Rect::from_min_max(self.point(rect.min), self.point(rect.max))
    }

    fn scale(&self) -> f32 {
        self.placed.scale
    }
}

/// The texts of a node.
struct NodeLabels {
    name: String,
    shape: String,
    cost: String,
    why: Option<String>,
    is_drawn: bool,
}

impl NodeLabels {
    fn new(pass: &TimedPass, why: Option<&str>) -> Self {
        let cost = &pass.cost;
        let steps = if cost.steps > 1 { format!("  ×{}", cost.steps) } else { String::new() };
        let format = cost.formats.first().map_or("", |format| format.name());
        let targets = if cost.formats.len() > 1 { format!(" ×{}", cost.formats.len()) } else { String::new() };
        let time = match cost.role {
            PassRole::Drawn { is_cached: false } => pass.millis.map_or_else(|| "– ms".to_owned(), millis_text),
            PassRole::Drawn { is_cached: true } => "unchanged".to_owned(),
            PassRole::Outside | PassRole::Off | PassRole::Unread => "not drawn".to_owned(),
        };
        Self {
            name: format!("{}{steps}", cost.pass.title()),
            shape: format!("{}×{}  {format}{targets}", cost.size.0, cost.size.1),
            cost: format!("{time}  {}", bytes(cost.held_bytes)),
            why: why.map(str::to_owned),
            is_drawn: matches!(cost.role, PassRole::Drawn { .. }),
        }
    }
}

/// The node is selected, below the pointer, or has the keyboard focus.
type Look = (bool, bool, bool);

fn paint(
    painter: &Painter,
    rect: Rect,
    words: &NodeLabels,
    ((is_shown, is_hot, has_focus), scale): (Look, f32),
    p: &Palette,
) {
    let painter = painter.with_clip_rect(rect.expand(2.0).intersect(painter.clip_rect()));
    let fill = if is_hot { p.button } else { p.raised };
    let edge = match (has_focus, is_shown) {
        (true, _) => p.focus(),
        (false, true) => Stroke::new(1.5, p.accent),
        (false, false) => Stroke::new(1.0, p.button_edge),
    };
    painter.rect(rect, 6.0, fill, edge, StrokeKind::Inside);
    let (strong, text) = if words.is_drawn { (p.strong, p.text) } else { (p.weak, p.weak) };
    let line = |y: f32, text: &str, font: FontId, color: Color32| {
        let mut job = egui::text::LayoutJob::simple_singleline(text.to_owned(), font, color);
        job.wrap = egui::text::TextWrapping::truncate_at_width(rect.width() - 14.0 * scale);
        painter.galley(rect.min + vec2(8.0, y) * scale, painter.layout_job(job), color);
    };
    if scale < LEGIBLE {
        // Only the name, as large as the node allows.
        let mut job = egui::text::LayoutJob::simple(words.name.clone(), FontId::proportional(9.5), strong, 0.0);
        job.wrap = egui::text::TextWrapping { max_width: rect.width() - 4.0, max_rows: 1, ..Default::default() };
        job.wrap.break_anywhere = true;
        let galley = painter.layout_job(job);
        return painter.galley(rect.center() - galley.size() / 2.0, galley, strong);
    }
    line(5.0, &words.name, FontId::proportional(13.0 * scale), strong);
    line(24.0, &words.shape, FontId::monospace(10.5 * scale), text);
    match words.why.as_ref().filter(|_| !words.is_drawn) {
        None => line(43.0, &words.cost, FontId::monospace(10.5 * scale), text),
        Some(why) => {
            let mut job =
                egui::text::LayoutJob::simple(why.clone(), FontId::proportional(10.5 * scale), p.warning, 0.0);
            let width = rect.width() - 14.0 * scale;
            job.wrap = egui::text::TextWrapping { max_width: width, max_rows: 2, ..Default::default() };
            painter.galley(rect.min + vec2(8.0, 38.0) * scale, painter.layout_job(job), p.warning);
        }
    }
}

fn tip(ui: &mut Ui, pass: &TimedPass, words: &NodeLabels) {
    let p = theme::of(ui);
    ui.label(words.name.as_str());
    if let Some(why) = &words.why {
        ui.colored_label(p.warning, why);
    }
    let formats: Vec<&str> = pass.cost.formats.iter().map(|format| format.name()).collect();
    ui.label(format!("{}×{} texels, {}", pass.cost.size.0, pass.cost.size.1, formats.join(" ")));
    ui.label(format!(
        "{} of memory, {} of traffic per frame",
        bytes(pass.cost.held_bytes),
        bytes(pass.cost.moved_bytes)
    ));
    for read in &pass.cost.reads {
        let when = if read.when == ReadTiming::ThisFrame { "this frame's" } else { "last frame's" };
        let unused = if read.is_used { "" } else { ", not read by the code" };
        ui.label(format!("iChannel{}: {when} {}{unused}", read.channel, read.pass.title()));
    }
    ui.colored_label(p.weak, "Click to see its texels");
}

/// `(lit, any)`: the edge leads to or from the highlighted node, and whether there is one.
fn edge(
    painter: &Painter,
    sheet: &Sheet,
    read: &PassRead,
    path: &[Pos2],
    (is_lit, is_any_lit): (bool, bool),
    p: &Palette,
) {
    let is_this = read.when == ReadTiming::ThisFrame;
    let mut color = if is_this { p.text } else { p.accent };
    if !read.is_used {
        color = p.weak.gamma_multiply(0.5);
    }
    if is_any_lit && !is_lit {
        color = color.gamma_multiply(0.35);
    }
    let stroke = Stroke::new(if is_lit { 2.0 } else { 1.3 }, color);
    let corners: Vec<Pos2> = path.iter().map(|at| sheet.point(*at)).collect();
    let points = rounded(&corners, 9.0 * sheet.scale());
    if is_this {
        painter.add(Shape::line(points, stroke));
    } else {
        painter.extend(Shape::dashed_line(&points, stroke, 5.0, 4.0));
    }
    // It ends in an arrow head, which points to the right like every edge into a node.
    if let Some(&tip) = corners.last() {
        let (long, half) = (7.0 * sheet.scale(), 3.5 * sheet.scale());
        let head = vec![tip, tip + vec2(-long, -half), tip + vec2(-long, half)];
        painter.add(Shape::convex_polygon(head, color, Stroke::NONE));
    }
}

/// Rounds the corners of a path.
fn rounded(corners: &[Pos2], radius: f32) -> Vec<Pos2> {
    let mut points = Vec::new();
    for (i, &corner) in corners.iter().enumerate() {
        let (Some(&before), Some(&after)) = (i.checked_sub(1).and_then(|i| corners.get(i)), corners.get(i + 1)) else {
            points.push(corner);
            continue;
        };
        let toward = |other: Pos2| {
            let step: Vec2 = other - corner;
            corner + step.normalized() * radius.min(step.length() / 2.0)
        };
        let (a, b) = (toward(before), toward(after));
        // A parabola from one end to the other.
        points.extend((0..=6).map(|n| {
            let t = n as f32 / 6.0;
            a.lerp(corner, t).lerp(corner.lerp(b, t), t)
        }));
    }
    points
}

/// Explains the arrows, and says that times are stale while paused.
fn legend(ui: &Ui, place: Rect, is_playing: bool, out: &mut UiOutput) {
    let p = theme::of(ui);
    let painter = ui.painter().with_clip_rect(place.intersect(ui.clip_rect()));
    let mut x = place.left() + 4.0;
    let y = place.center().y;
    let unread = p.weak.gamma_multiply(0.5);
    for (words, color, is_dashed) in [
        ("reads this frame", p.text, false),
        ("reads the previous frame", p.accent, true),
        ("set, but not read", unread, false),
    ] {
        let line = [pos2(x, y), pos2(x + 24.0, y)];
        let stroke = Stroke::new(1.3, color);
        match is_dashed {
            true => painter.extend(Shape::dashed_line(&line, stroke, 5.0, 4.0)),
            false => drop(painter.add(Shape::line_segment(line, stroke))),
        }
        let text = painter.text(pos2(x + 30.0, y), Align2::LEFT_CENTER, words, FontId::proportional(11.0), p.weak);
        x = text.right() + 18.0;
    }
    if !is_playing {
        let words = "times before the pause";
        let text = painter.text(pos2(x, y), Align2::LEFT_CENTER, words, FontId::proportional(11.0), p.warning);
        out.place("buffers:graph:paused", text);
    }
}
