//! The table below the picture with the cost of each pass of the open project. Nothing is gathered while it is closed.

use super::{
    panels::{Content, DefaultPlace, MARGIN, PanelRow},
    theme,
    ui_output::UiOutput,
};
use crate::{
    engine::{CostClock, PassRole},
    session::{PassCosts, Session, TimedPass},
};
use egui::{Align2, Color32, FontId, Margin, Rect, RichText, ScrollArea, Sense, Ui, pos2, vec2};

pub(super) const PANEL: PanelRow = PanelRow::new(
    "costs",
    "Costs",
    DefaultPlace::BelowPicture,
    Content::Within(Margin { top: 0, ..MARGIN }, |ui, context| show(ui, context.session, context.out)),
)
.tools(|ui, context| tools(ui, context.session, context.out))
.heading(|_| "Costs of a frame".to_owned())
.report(|_, _, session| report(session))
.action("Panel: Costs", &["Ctrl+Shift+M"], "profiler profile performance timing gpu memory");

const ROW: f32 = 19.0;
const SIZE: f32 = 12.0;

/// Right edges of the columns, as distances from the table's right edge; the name takes the remaining width.
struct Columns {
    size: Option<f32>,
    format: Option<f32>,
    millis: f32,
    held: f32,
    moved: f32,
}

impl Columns {
    /// Narrow tables omit the least important columns.
    fn of(width: f32) -> Columns {
        let (moved, held, millis) = (8.0, 84.0, 160.0);
        let has_size = width > 400.0;
        Columns {
            moved,
            held,
            millis,
            size: has_size.then_some(236.0),
            // Its left edge: the column is text.
            format: (width > 520.0).then_some(384.0),
        }
    }

    fn name_end(&self) -> f32 {
        self.format.or(self.size.map(|s| s + 84.0)).unwrap_or(self.millis + 66.0)
    }
}

fn show(ui: &mut Ui, session: &Session, out: &mut UiOutput) {
    out.stop("costs", ui);
    let costs = session.pass_costs();
    ui.spacing_mut().item_spacing.y = 0.0;
    let columns = Columns::of(ui.available_width());
    line(ui, &columns, ["Pass", "Format", "Size", "Time", "Memory", "Traffic"], theme::of(ui).weak, theme::of(ui).weak);
    let list_height = (ui.available_height() - ROW - 6.0).max(ROW);
    let most = costs.passes.iter().filter_map(|p| p.millis).fold(0.0, f64::max);
    ScrollArea::vertical().id_salt("costs").max_height(list_height).auto_shrink([false, true]).show_rows(
        ui,
        ROW,
        costs.passes.len(),
        |ui, rows| {
            for pass in &costs.passes[rows] {
                row(ui, &columns, pass, most, out);
            }
        },
    );
    sum(ui, &columns, &costs, out);
}

/// Shows at the right end of the panel's row how the times were measured.
fn tools(ui: &mut Ui, session: &Session, out: &mut UiOutput) {
    let (short, long) = match session.pass_costs().clock {
        CostClock::Timestamps => (
            "GPU timestamps",
            "Milliseconds between GPU timestamps before and after each pass: median of the last 30 frames",
        ),
        CostClock::Waited => (
            "passes timed one by one",
            "This GPU has no timestamps. While this panel is open, each pass is submitted and timed separately by \
             wall clock, minus the time of an empty submission: median of the last 30 frames. This slows frames \
             down",
        ),
    };
    let text = RichText::new(short).size(11.5).color(theme::of(ui).weak);
    ui.add(egui::Label::new(text).truncate()).on_hover_text(long);
    if !session.transport().playing {
        let text = RichText::new("from before the pause").size(11.5).color(theme::of(ui).warning);
        let label = ui.add(egui::Label::new(text).truncate());
        out.place("costs:paused", label.rect);
        label.on_hover_text("Times of the last frames drawn; no new ones are measured while paused");
    }
}

/// Shows one row of texts, in the order of the columns.
fn line(ui: &mut Ui, columns: &Columns, texts: [&str; 6], name: Color32, color: Color32) -> egui::Response {
    let (rect, response) = ui.allocate_exact_size(vec2(ui.available_width(), ROW), Sense::hover());
    if response.hovered() {
        ui.painter().rect_filled(rect, 0.0, theme::of(ui).raised);
    }
    texts_in(ui, columns, rect, texts, name, color);
    response
}

fn texts_in(ui: &Ui, columns: &Columns, rect: Rect, texts: [&str; 6], name: Color32, color: Color32) {
    let painter = ui.painter().with_clip_rect(rect.intersect(ui.clip_rect()));
    let [title, format, size, millis, held, moved] = texts;
    let y = rect.center().y;
    let mut job = egui::text::LayoutJob::simple_singleline(title.to_owned(), FontId::proportional(12.5), name);
    let room = rect.width() - columns.name_end() - 12.0;
    job.wrap = egui::text::TextWrapping::truncate_at_width(room.max(20.0));
    let galley = painter.layout_job(job);
    painter.galley(pos2(rect.left() + 4.0, y - galley.size().y / 2.0), galley, name);
    let number = |end: f32, text: &str| {
        painter.text(pos2(rect.right() - end, y), Align2::RIGHT_CENTER, text, FontId::monospace(SIZE), color);
    };
    if let Some(left) = columns.format {
        let at = pos2(rect.right() - left, y);
        painter.text(at, Align2::LEFT_CENTER, format, FontId::monospace(SIZE), color);
    }
    if let Some(end) = columns.size {
        number(end, size);
    }
    number(columns.millis, millis);
    number(columns.held, held);
    number(columns.moved, moved);
}

fn row(ui: &mut Ui, columns: &Columns, pass: &TimedPass, most: f64, out: &mut UiOutput) {
    let cost = &pass.cost;
    let mut title = cost.pass.title();
    if cost.steps > 1 {
        title += &format!("  ×{}", cost.steps);
    }
    let (why, is_drawn) = match cost.role {
        PassRole::Drawn { is_cached: false } => (None, true),
        PassRole::Drawn { is_cached: true } => (Some("unchanged"), true),
        PassRole::Off => (Some("off"), false),
        PassRole::Unread | PassRole::Outside => (Some("not drawn"), false),
    };
    let millis = match (why, pass.millis) {
        (Some(why), _) => why.to_owned(),
        (None, Some(ms)) => millis_text(ms),
        (None, None) => "–".into(),
    };
    let formats: Vec<&str> = cost.formats.iter().map(|f| f.name()).collect();
    let (held, moved) = (bytes(cost.held_bytes), bytes(cost.moved_bytes));
    let size = format!("{}×{}", cost.size.0, cost.size.1);
    let color = if is_drawn { theme::of(ui).text } else { theme::of(ui).weak };
    let (rect, response) = ui.allocate_exact_size(vec2(ui.available_width(), ROW), Sense::hover());
    if response.hovered() {
        ui.painter().rect_filled(rect, 0.0, theme::of(ui).raised);
    }
    if let (None, Some(ms)) = (why, pass.millis) {
        // Its share of the most expensive pass, after its name.
        let width = (rect.width() - columns.name_end() - 12.0).max(0.0) * (ms / most.max(1e-9)) as f32;
        let bar = Rect::from_min_size(rect.min + vec2(0.0, 2.0), vec2(width, ROW - 4.0));
        ui.painter().rect_filled(bar, 2.0, theme::of(ui).accent_fill.gamma_multiply(0.6));
    }
    let joined = formats.join(" ");
    let format = if formats.len() > 1 { format!("{}×{}", formats[0], formats.len()) } else { joined.clone() };
    texts_in(ui, columns, rect, [&title, &format, &size, &millis, &held, &moved], color, color);
    out.place(format!("cost:{}", cost.pass.title()), rect);
    response.on_hover_ui(|ui| {
        ui.label(cost.pass.title());
        match cost.role {
            PassRole::Drawn { is_cached: false } => {}
            PassRole::Drawn { is_cached: true } => {
                drop(ui.label("Unchanged: none of its inputs has changed since it was drawn."));
            }
            PassRole::Outside => drop(ui.label("Not drawn: its region is outside its texture.")),
            PassRole::Off => {
                let when = cost.when.as_deref().unwrap_or_default();
                drop(ui.label(format!("Not drawn: its condition is false ({when}).")));
            }
            PassRole::Unread => drop(ui.label("Not drawn: the shown pass does not need it.")),
        }
        ui.label(format!("{} × {} texels, {joined}, {} per frame", cost.size.0, cost.size.1, count(cost.texels)));
        ui.label(format!("{held} of memory: textures, mip levels, ping-pong copies, the depth buffer"));
        ui.label(format!(
            "At least {moved} of traffic per frame: its texels written, and those of each input pass read once"
        ));
        if let (Some(ms), true) = (pass.millis, cost.moved_bytes > 0) {
            ui.label(format!("{:.2} GB/s of traffic", cost.moved_bytes as f64 / ms / 1e6));
        }
    });
}

fn sum(ui: &mut Ui, columns: &Columns, costs: &PassCosts, out: &mut UiOutput) {
    let is_at_work = |p: &&TimedPass| p.cost.role == PassRole::Drawn { is_cached: false };
    let at_work: Vec<&TimedPass> = costs.passes.iter().filter(is_at_work).collect();
    let left: usize = costs.passes.len() - at_work.len();
    let millis: f64 = at_work.iter().filter_map(|p| p.millis).sum();
    let held: u64 = costs.passes.iter().map(|p| p.cost.held_bytes).sum();
    let moved: u64 = at_work.iter().map(|p| p.cost.moved_bytes).sum();
    let title = match left {
        0 => format!("{} passes", at_work.len()),
        n => format!("{} of {} passes drawn", at_work.len(), at_work.len() + n),
    };
    let texts = [title.as_str(), "", "", &millis_text(millis), &bytes(held), &bytes(moved)];
    ui.painter().hline(ui.max_rect().x_range(), ui.cursor().top(), egui::Stroke::new(1.0, theme::of(ui).line));
    let response = line(ui, columns, texts, theme::of(ui).strong, theme::of(ui).strong);
    out.place("costs:sum", response.rect);
}

/// Formats bytes for reading, in powers of 1024.
pub(super) fn bytes(n: u64) -> String {
    const KIB: f64 = 1024.0;
    let x = n as f64;
    match x {
        x if x < KIB => format!("{n} B"),
        x if x < KIB * KIB => format!("{:.1} KiB", x / KIB),
        x if x < KIB * KIB * KIB => format!("{:.1} MiB", x / KIB / KIB),
        x => format!("{:.2} GiB", x / KIB / KIB / KIB),
    }
}

fn count(texels: u64) -> String {
    match texels {
        n if n < 10_000 => format!("{n} texels"),
        n if n < 1_000_000 => format!("{:.1} thousand texels", n as f64 / 1e3),
        n => format!("{:.2} million texels", n as f64 / 1e6),
    }
}

/// Returns the table's contents, for scripts that drive the window.
fn report(session: &Session) -> serde_json::Value {
    let costs = session.pass_costs();
    let passes: Vec<serde_json::Value> = costs
        .passes
        .iter()
        .map(|p| {
            serde_json::json!({
                "pass": p.cost.pass.title(),
                "drawn": matches!(p.cost.role, PassRole::Drawn { is_cached: false }),
                "timed": p.millis.is_some(),
                "held_bytes": p.cost.held_bytes,
                "moved_bytes": p.cost.moved_bytes,
            })
        })
        .collect();
    serde_json::json!({ "passes": passes })
}

/// Formats milliseconds with few enough digits that columns do not touch.
pub(super) fn millis_text(millis: f64) -> String {
    let digits = if millis < 10.0 { 3 } else { usize::from(millis < 1000.0) };
    format!("{millis:.digits$} ms")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn bytes_are_formatted_with_units() {
        let formatted = [0, 1023, 1536, 3_686_400, 5 << 30].map(bytes);
        assert_eq!(formatted, ["0 B", "1023 B", "1.5 KiB", "3.5 MiB", "5.00 GiB"]);
        assert_eq!([96, 230_400, 8_294_400].map(count), ["96 texels", "230.4 thousand texels", "8.29 million texels"]);
    }

    #[test]
    fn a_narrow_table_keeps_time_and_bytes() {
        assert!(Columns::of(300.0).size.is_none() && Columns::of(300.0).format.is_none());
        let wide = Columns::of(640.0);
        assert!(wide.size.is_some() && wide.format.is_some());
        assert!(300.0 - Columns::of(300.0).name_end() > 60.0 && 640.0 - wide.name_end() > 200.0);
    }
}
