//! A map of what the pixels of the shown pass cost, over the picture, with its scale and the value under the pointer.

use super::{
    icons::{self, Icon},
    theme,
    ui_output::{ShellCommand, UiOutput},
};
use crate::session::{Command, CountedPass, CountsView, Session, ToolCommand};
use egui::{
    Area, Color32, ColorImage, Frame, Id, Margin, Order, Rect, RichText, TextureHandle, TextureOptions, Ui, pos2, vec2,
};
use serde_json::{Value, json};
use std::sync::Arc;

/// The opacity of the map.
const OPACITY: u8 = 215;

/// Viridis at even steps (S. van der Walt and N. Smith, Matplotlib 1.5, 2015): equal steps look equally large.
const VIRIDIS: [[u8; 3]; 9] = [
    [68, 1, 84],
    [71, 44, 122],
    [59, 81, 139],
    [44, 113, 142],
    [33, 144, 141],
    [39, 173, 129],
    [92, 200, 99],
    [170, 220, 50],
    [253, 231, 37],
];

/// The texture of the newest counts.
#[derive(Clone)]
struct Painted {
    of: Arc<CountedPass>,
    texture: TextureHandle,
}

/// Returns the smallest and the largest cost of a pixel, in nanoseconds.
fn range(counted: &CountedPass) -> (f32, f32) {
    let costs = counted.counts.costs.iter().copied().filter(|cost| *cost > 0.0);
    let (least, most) = costs.fold((f32::INFINITY, 0.0f32), |(least, most), cost| (least.min(cost), most.max(cost)));
    (least.min(most), most)
}

/// Returns the place of a cost between two others, from 0 to 1, by its logarithm if they are far apart.
fn part(cost: f32, (least, most): (f32, f32)) -> f32 {
    if most <= least || cost <= 0.0 {
        return 0.0;
    }
    let part =
        if most > 8.0 * least { (cost / least).ln() / (most / least).ln() } else { (cost - least) / (most - least) };
    part.clamp(0.0, 1.0)
}

/// Returns a colour of the scale.
pub(super) fn color(part: f32) -> Color32 {
    let at = part.clamp(0.0, 1.0) * (VIRIDIS.len() - 1) as f32;
    let from = (at as usize).min(VIRIDIS.len() - 2);
    let weight = at - from as f32;
    let mixed = |i: usize| {
        let (a, b) = (f32::from(VIRIDIS[from][i]), f32::from(VIRIDIS[from + 1][i]));
        (a + weight * (b - a)).round() as u8
    };
    Color32::from_rgb(mixed(0), mixed(1), mixed(2))
}

fn image(counted: &CountedPass) -> ColorImage {
    let counts = &counted.counts;
    let (width, height) = (counts.size.0 as usize, counts.size.1 as usize);
    let range = range(counted);
    let rows = counts.costs[..width * height].chunks_exact(width).rev();
    let pixels = rows.flatten().map(|&cost| {
        let [r, g, b, _] = color(part(cost, range)).to_array();
        Color32::from_rgba_unmultiplied(r, g, b, if cost > 0.0 { OPACITY } else { 0 })
    });
    ColorImage::new([width, height], pixels.collect())
}

/// Paints the map over the picture of its pass.
pub(super) fn paint(ui: &Ui, session: &Session, picture: Rect) {
    let CountsView { counted: Some(counted), is_current: true, .. } = session.counts() else { return };
    let id = Id::unique("cost map");
    let kept = ui.data(|data| data.get_temp::<Painted>(id)).filter(|kept| Arc::ptr_eq(&kept.of, counted));
    let painted = kept.unwrap_or_else(|| {
        let texture = ui.ctx().load_texture("cost map", image(counted), TextureOptions::NEAREST);
        let painted = Painted { of: Arc::clone(counted), texture };
        ui.data_mut(|data| data.insert_temp(id, painted.clone()));
        painted
    });
    let uv = Rect::from_min_max(pos2(0.0, 0.0), pos2(1.0, 1.0));
    ui.painter().with_clip_rect(picture).image(painted.texture.id(), picture, uv, Color32::WHITE);
}

/// Shows the scale over the picture's lower edge. `under` is the place of the picture below the pointer.
pub(super) fn show(ui: &Ui, session: &Session, area: Rect, under: Option<[f32; 2]>, out: &mut UiOutput) {
    let view = session.counts();
    if !view.is_on {
        return;
    }
    let legend = Area::new(Id::unique("cost"))
        .order(Order::Middle)
        .pivot(egui::Align2::RIGHT_BOTTOM)
        .fixed_pos(area.right_bottom() + vec2(-6.0, -6.0))
        .constrain_to(area);
    out.show_area("cost", legend, ui, |ui, out| {
        theme::put_over_picture(ui);
        let frame = Frame::NONE.fill(theme::of(ui).panel).corner_radius(6).inner_margin(Margin::symmetric(8, 5));
        frame.show(ui, |ui| {
            out.stop("cost", ui);
            ui.set_max_width((area.width() - 28.0).max(160.0));
            ui.spacing_mut().item_spacing = vec2(6.0, 3.0);
            card(ui, session, &view, under, out);
        });
    });
}

fn card(ui: &mut Ui, session: &Session, view: &CountsView<'_>, under: Option<[f32; 2]>, out: &mut UiOutput) {
    let p = theme::of(ui);
    ui.horizontal(|ui| {
        let title = format!("Cost of the pixels of {}", session.shown_pass().title());
        ui.label(RichText::new(title).color(p.strong).size(12.5));
        let close = icons::flat(ui, Icon::Close, "Hide the cost").on_hover_text("Hide the cost");
        out.on_click("cost:close", &close, Command::Tool(ToolCommand::Count(false)));
    });
    let Some(counted) = view.counted else {
        match view.trouble {
            Some(why) => ui.colored_label(p.warning, why),
            None => ui.colored_label(p.weak, "Counting …"),
        };
        return;
    };
    let counts = &counted.counts;
    ui.colored_label(p.text, format!("{} per frame, predicted from the counts", millis(counts.predicted_millis())));
    let (least, most) = range(counted);
    let row = ui.horizontal(|ui| {
        ui.colored_label(p.weak, nanos(least));
        let (rect, _) = ui.allocate_exact_size(vec2(130.0, 10.0), egui::Sense::hover());
        const STEPS: u32 = 32;
        for step in 0..STEPS {
            let width = rect.width() / STEPS as f32;
            let place =
                Rect::from_min_size(pos2(rect.left() + width * step as f32, rect.top()), vec2(width + 0.5, 10.0));
            ui.painter().rect_filled(place, 0.0, color((step as f32 + 0.5) / STEPS as f32));
        }
        ui.colored_label(p.weak, nanos(most));
    });
    out.place("cost:scale", row.response.rect);
    let at = under.map(|[x, y]| {
        let texel = |part: f32, size: u32| ((part * size as f32) as u32).min(size.saturating_sub(1));
        (texel(x, counts.size.0), texel(y, counts.size.1))
    });
    let words = match at.and_then(|at| Some((at, counts.cost_at(at, 0)?))) {
        Some(((x, y), cost)) => format!("{x},{y}: {}", nanos(cost)),
        None => {
            format!("Divergence {:.2}, {:.1} texture reads per pixel", counts.mean_divergence(), counts.texture_reads())
        }
    };
    ui.colored_label(p.text, words);
    if let Some((x, y, 0)) = counts.costliest() {
        let trace = ui.button(format!("Trace the costliest pixel ({x},{y})"));
        if out.clicked("cost:trace", &trace) {
            out.shell_commands.push(ShellCommand::Trace(place(counted, (x, y))));
        }
    }
}

/// Returns the place of a pixel in the picture, from 0 to 1 across and up.
fn place(counted: &CountedPass, (x, y): (u32, u32)) -> [f32; 2] {
    let (width, height) = counted.counts.size;
    let part = |at: u32, of: u32| (at as f32 + 0.5) / of.max(1) as f32;
    [part(x, width), part(y, height)]
}

/// Returns the place of the most expensive pixel of the shown pass; `None` without counts.
pub(super) fn costliest(session: &Session) -> Option<[f32; 2]> {
    let counted = session.counts().counted?;
    let (x, y, _) = counted.counts.costliest()?;
    Some(place(counted, (x, y)))
}

fn nanos(nanos: f32) -> String {
    if nanos < 1e3 { format!("{nanos:.0} ns") } else { format!("{:.1} µs", nanos / 1e3) }
}

fn millis(millis: f64) -> String {
    if millis < 10.0 { format!("{millis:.2} ms") } else { format!("{millis:.0} ms") }
}

/// Returns the report for scripts.
pub(super) fn report(session: &Session) -> Value {
    let CountsView { is_on: true, counted, is_current, trouble } = session.counts() else { return Value::Null };
    let Some(counted) = counted else { return json!({ "trouble": trouble }) };
    let counts = &counted.counts;
    json!({
        "pass": counts.pass.title(),
        "pixels": counts.pixels,
        "lines": counted.lines.len(),
        "loops": counted.loops.len(),
        "unreached": counted.lines.iter().filter(|line| line.runs == 0).count(),
        "costliest": counts.costliest().map(|(x, y, _)| [x, y]),
        "current": is_current,
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_scale_gets_lighter_and_is_logarithmic_over_a_wide_range() {
        let light = |part: f32| color(part).to_array()[..3].iter().map(|c| u32::from(*c)).sum::<u32>();
        assert!((0..=10).map(|n| light(n as f32 / 10.0)).is_sorted());
        assert_eq!((part(1.0, (1.0, 100.0)), part(10.0, (1.0, 100.0)), part(100.0, (1.0, 100.0))), (0.0, 0.5, 1.0));
        assert_eq!(part(1.5, (1.0, 2.0)), 0.5);
        assert_eq!(part(1.0, (1.0, 1.0)), 0.0);
    }
}
