use super::*;
use egui::{Event, Modifiers, PointerButton, Pos2, RawInput, Rect, pos2, vec2};

struct Blank {
    places: std::collections::BTreeMap<String, Rect>,
}

impl Contents for Blank {
    fn show(&mut self, ui: &mut Ui, panel: Panel) -> bool {
        self.places.insert(panel.name().to_owned(), ui.max_rect());
        let row = ui.interact(ui.max_rect(), ui.scope_id().with("row"), egui::Sense::CLICK | egui::Sense::DRAG);
        row.drag_started() && panel.has_own_row()
    }

    fn tools(&mut self, _: &mut Ui, _: Panel) {}

    fn title(&self, panel: Panel) -> String {
        panel.title().to_owned()
    }

    fn heights(&self) -> Heights {
        Heights { transport: 44.0, uniforms: 60.0, channels: 90.0 }
    }

    fn place(&mut self, name: String, rect: Rect) {
        self.places.insert(name, rect);
    }
}

/// A dock without a real window.
struct Stage {
    ctx: egui::Context,
    dock: Dock,
    size: egui::Vec2,
    blank: Blank,
    time: f64,
}

impl Stage {
    fn new(width: f32, height: f32) -> Self {
        let blank = Blank { places: Default::default() };
        let mut stage =
            Self { ctx: egui::Context::default(), dock: Dock::new(), size: vec2(width, height), blank, time: 0.0 };
        stage.frame(vec![]);
        stage
    }

    fn frame(&mut self, events: Vec<Event>) {
        self.time += 0.1;
        let screen_rect = Some(Rect::from_min_size(Pos2::ZERO, self.size));
        let input = RawInput { screen_rect, events, time: Some(self.time), ..RawInput::default() };
        self.blank.places.clear();
        let (dock, blank) = (&mut self.dock, &mut self.blank);
        let mut output = self.ctx.run_ui(input, |ui| dock.show(ui, blank));
        output.textures_delta.clear();
    }

    fn place(&self, name: &str) -> Rect {
        *self.blank.places.get(name).unwrap_or_else(|| panic!("no {name} in {:?}", self.blank.places))
    }

    fn button(&mut self, pos: Pos2, pressed: bool) {
        let event = Event::PointerButton { pos, button: PointerButton::Primary, pressed, modifiers: Modifiers::NONE };
        self.frame(vec![event]);
    }

    fn drag(&mut self, from: Pos2, to: Pos2) {
        self.frame(vec![Event::PointerMoved(from)]);
        self.button(from, true);
        for step in 1..=4 {
            self.frame(vec![Event::PointerMoved(from.lerp(to, step as f32 / 4.0))]);
        }
        self.button(to, false);
        self.frame(vec![]);
    }

    fn click(&mut self, name: &str) {
        let at = self.place(name).center();
        self.frame(vec![Event::PointerMoved(at)]);
        self.button(at, true);
        self.button(at, false);
        self.frame(vec![]);
    }
}

#[test]
fn the_picture_fills_its_panel() {
    for (width, height) in [(1280.0, 722.0), (1920.0, 1042.0), (900.0, 562.0), (760.0, 402.0), (1280.0, 762.0)] {
        let stage = Stage::new(width, height);
        let picture = stage.place("picture");
        // The unused part of the panel beside or below a 16:9 picture.
        let room = picture.height() - 44.0;
        let drawn = picture.width().min(room * 16.0 / 9.0);
        let covered = drawn * (drawn * 9.0 / 16.0) / (picture.width() * room);
        assert!(covered > 0.65, "{width}x{height}: {covered}");
        let code = stage.place("code");
        assert!(code.height() > 0.99 * height && code.width() > 0.36 * width, "{width}x{height}: {code:?}");
        let below: f32 = ["uniforms", "channels"].iter().map(|name| stage.place(name).height()).sum();
        assert!(picture.height() + below + 2.0 * BAR > height - 6.0, "{width}x{height}");
        assert!(stage.place("channels").height() > 40.0, "{width}x{height}");
    }
    let tall = Stage::new(700.0, 1200.0);
    assert!(tall.place("code").top() > tall.place("picture").bottom() && tall.place("code").height() > 400.0);
}

#[test]
fn panels_close_and_open_again_and_the_last_one_stays() {
    let mut stage = Stage::new(1280.0, 722.0);
    let before = stage.place("uniforms");
    stage.click("panel:close:uniforms");
    assert!(!stage.dock.is_open(Panel::Uniforms) && !stage.dock.is_seen(Panel::Uniforms));
    stage.dock.set_open(Panel::Uniforms, true);
    stage.frame(vec![]);
    assert_eq!(stage.place("uniforms"), before);
    // A click on a title row or a separator moves nothing.
    for at in [before.center_top() - vec2(0.0, 12.0), before.left_top() - vec2(-200.0, 27.5)] {
        stage.frame(vec![Event::PointerMoved(at)]);
        stage.button(at, true);
        stage.button(at, false);
        stage.frame(vec![]);
        assert_eq!((stage.dock.arrangement(), stage.place("uniforms")), (None, before));
    }
    stage.dock.set_open(Panel::Costs, true);
    stage.frame(vec![]);
    assert!(stage.dock.is_seen(Panel::Costs) && !stage.dock.is_seen(Panel::Uniforms), "costs is in front");
    stage.click("panel:uniforms");
    assert!(stage.dock.is_seen(Panel::Uniforms) && !stage.dock.is_seen(Panel::Costs));
    assert_eq!(stage.dock.arrangement(), None, "that is no arrangement of one's own");
    for panel in Panel::all() {
        stage.dock.set_open(panel, false);
    }
    stage.frame(vec![]);
    assert_eq!(stage.dock.open_panels().len(), 1);
}

#[test]
fn dragged_layouts_are_saved_and_can_be_reset() {
    let mut stage = Stage::new(1280.0, 722.0);
    let code = stage.place("code");
    let line = pos2(code.left() - 0.5, code.center().y);
    stage.drag(line, line - vec2(200.0, 0.0));
    let wider = stage.place("code");
    assert!((wider.width() - code.width() - 200.0).abs() < 12.0, "{code:?} {wider:?}");
    // Into the place of the code's lower half.
    let from = stage.place("panel:channels").center();
    stage.drag(from, pos2(wider.center().x, wider.bottom() - 12.0));
    let channels = stage.place("channels");
    assert!(channels.left() >= wider.left() - 2.0 && channels.top() > wider.center().y - 40.0, "{channels:?}");

    let kept = stage.dock.arrangement().expect("it is a person's own now");
    let open = stage.dock.open_panels().clone();
    let value = kept.to_value();
    assert_eq!(Node::from_value(&value).unwrap().panels(), kept.panels(), "{value}");
    let mut next = Stage::new(1280.0, 722.0);
    next.dock.restore(Some(open), Some(&Node::from_value(&value).unwrap()));
    next.frame(vec![]);
    assert!((next.place("channels").top() - channels.top()).abs() < 4.0, "{:?} {channels:?}", next.place("channels"));
    // A panel that the saved arrangement lacks joins those of its default place.
    next.dock.set_open(Panel::Costs, true);
    next.frame(vec![]);
    assert!(next.dock.is_seen(Panel::Costs));
    next.dock.set_open(Panel::Lab, true);
    next.frame(vec![]);
    assert!(next.place("lab").height() > 100.0 && next.place("code").height() > 100.0);
    next.dock.reset();
    next.frame(vec![]);
    assert_eq!(next.place("code"), code);
}

#[test]
fn untitled_panels_are_dragged_by_their_own_row() {
    let mut stage = Stage::new(1280.0, 722.0);
    let code = stage.place("code");
    stage.drag(stage.place("picture").center(), pos2(code.right() - 30.0, code.center().y));
    let (picture, code) = (stage.place("picture"), stage.place("code"));
    assert!(picture.left() >= code.right() - 2.0, "{picture:?} {code:?}");
    assert!(stage.dock.arrangement().is_some());
}

#[test]
fn invalid_arrangements_are_rejected() {
    let read = |text: &str| Node::from_value(&text.parse().unwrap());
    assert_eq!(read("\"code\""), Ok(Node::Panel(Panel::Code)));
    for bad in ["\"cdoe\"", "3", "{ row = [] }", "{ row = \"code\" }", "{ colum = [\"code\"] }", "[\"code\"]"] {
        assert!(read(bad).is_err(), "{bad}");
    }
    let odd = read("{ row = [\"code\", \"picture\"], shares = [0, \"x\"] }").unwrap();
    assert_eq!(odd, Node::Row(vec![(Node::Panel(Panel::Code), 1.0), (Node::Panel(Panel::Picture), 1.0)]));
}

#[test]
fn keys_resize_and_move_a_panel() {
    let mut stage = Stage::new(1280.0, 722.0);
    let (code, channels) = (stage.place("code"), stage.place("channels"));
    assert_eq!(stage.dock.panel_at(code.center()), Some(Panel::Code));
    assert_eq!(stage.dock.panel_at(stage.place("panel:channels").center()), Some(Panel::Channels));
    for (panel, side, by) in [
        (Panel::Code, Side::Left, vec2(-24.0, 0.0)),
        (Panel::Code, Side::Right, vec2(24.0, 0.0)),
        (Panel::Channels, Side::Down, vec2(0.0, 24.0)),
        (Panel::Channels, Side::Up, vec2(0.0, -24.0)),
        (Panel::Picture, Side::Right, vec2(24.0, 0.0)),
        // It has the whole height.
        (Panel::Code, Side::Down, vec2(0.0, 0.0)),
    ] {
        let before = stage.place(panel.name()).size();
        stage.dock.resize(panel, side);
        stage.frame(vec![]);
        let after = stage.place(panel.name()).size();
        assert!((after - before - by).length() < 2.0, "{panel:?} {side:?}: {before} {after}");
    }
    for _ in 0..100 {
        stage.dock.resize(Panel::Code, Side::Left);
        stage.frame(vec![]);
    }
    assert!((stage.place("code").width() - 140.0).abs() < 3.0, "it can still be used");

    stage.dock.move_to_edge(Panel::Channels, Side::Right);
    stage.frame(vec![]);
    let moved = stage.place("channels");
    assert!(moved.right() > 1278.0 && moved.height() > 650.0 && moved.width() > channels.width() * 0.3, "{moved:?}");
    stage.dock.share_place(Panel::Channels);
    stage.frame(vec![]);
    // The next one, wrapping round, is the picture.
    assert!(stage.dock.is_seen(Panel::Channels) && !stage.dock.is_seen(Panel::Picture));
    stage.click("panel:picture");
    assert!(stage.dock.is_seen(Panel::Picture) && !stage.dock.is_seen(Panel::Channels));
    let kept = stage.dock.arrangement().unwrap();
    assert_eq!(kept.panels().len(), 4, "none is lost: {}", kept.to_value());
}

#[test]
fn the_lab_is_below_the_code_if_that_is_wide_enough() {
    let opened = |width: f32, height: f32| {
        let mut stage = Stage::new(width, height);
        let before = stage.place("picture");
        stage.dock.set_open(Panel::Lab, true);
        stage.frame(vec![]);
        (before, stage)
    };
    for (width, height) in [(1280.0, 722.0), (1280.0, 800.0), (1920.0, 1080.0)] {
        let (before, stage) = opened(width, height);
        let (lab, code) = (stage.place("lab"), stage.place("code"));
        let picture = stage.place("picture");
        assert!(picture.width() > 0.95 * before.width() && picture.height() > 0.95 * before.height(), "{picture:?}");
        assert!(lab.width() >= 640.0 && lab.height() >= 300.0 && code.height() >= 250.0, "{lab:?} {code:?}");
        assert!(lab.top() > code.top() && lab.left() > before.left(), "{lab:?}");
    }
    // Narrower windows have it below everything, and so do tall ones.
    for (width, height) in [(1000.0, 700.0), (900.0, 600.0), (800.0, 1200.0)] {
        let (_, stage) = opened(width, height);
        let lab = stage.place("lab");
        assert!(lab.width() > 0.95 * width && lab.height() > 0.4 * height, "{width} x {height}: {lab:?}");
    }
    // Without the code, it cannot be below it.
    let (_, mut stage) = opened(1280.0, 722.0);
    stage.dock.set_open(Panel::Code, false);
    stage.frame(vec![]);
    assert!(stage.place("lab").width() > 0.4 * 1280.0);
    for panel in [Panel::Picture, Panel::Uniforms, Panel::Channels] {
        stage.dock.set_open(panel, false);
    }
    stage.frame(vec![]);
    assert!(stage.place("lab").height() > 650.0);
}
