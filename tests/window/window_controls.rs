//! End to end: an OSC control is learned by a right click on a slider, saved with the project, and received only after
//! the user has turned OSC on.

use crate::support::window::{Display, Window, folder_of};
use std::{
    fs,
    net::{SocketAddr, UdpSocket},
    path::Path,
};

const CODE: &str = "#iUniform float level = 0.5 in { 0.0, 1.0 }\n\
                    void mainImage(out vec4 o, in vec2 p) { o = vec4(level, 0.0, 0.0, 1.0); }\n";

struct Controller(UdpSocket, SocketAddr);

impl Controller {
    /// Sends to an unused port.
    fn new() -> Controller {
        let free = UdpSocket::bind("127.0.0.1:0").unwrap().local_addr().unwrap();
        Controller(UdpSocket::bind("127.0.0.1:0").unwrap(), free)
    }

    /// Sends a message with one float: its address and its type, each padded with zeros to a multiple of four bytes.
    fn send(&self, address: &str, value: f32) {
        let mut packet = Vec::new();
        for text in [address, ",f"] {
            packet.extend(text.as_bytes());
            packet.extend(vec![0; 4 - text.len() % 4]);
        }
        packet.extend(value.to_be_bytes());
        self.0.send_to(&packet, self.1).unwrap();
    }
}

/// Returns the red of the picture, as saved by the screenshot key.
fn red(window: &mut Window) -> u8 {
    window.drain();
    window.keys(&["ctrl+p"]);
    let notice = window.wait_for("a screenshot", |e| {
        e["event"] == "notice" && e["path"].as_str().is_some_and(|path| path.ends_with(".png"))
    });
    image::open(notice["path"].as_str().unwrap()).unwrap().to_rgb8().get_pixel(2, 2).0[0]
}

/// Sends until the picture changes: the socket may be opened a moment later.
fn send_until_shown(window: &mut Window, controller: &Controller, address: &str, value: f32) {
    for _ in 0..20 {
        controller.send(address, value);
        if red(window) == (value * 255.0).round() as u8 {
            return;
        }
    }
    panic!("{address} {value} leaves the picture at {}", red(window));
}

fn open<'a>(display: &'a Display, home: &Path, project: &Path, more: &[&str]) -> Window<'a> {
    let arguments = [&[project.to_str().unwrap()], more].concat();
    let mut window = Window::open_as(display, home, Some("1300x800"), &[], &arguments);
    window.wait_compiled();
    window
}

#[test]
fn osc_is_learned_by_a_right_click_saved_and_off_by_default() {
    let Some(display) = Display::of_size(1300, 800) else { return };
    let home = tempfile::tempdir().unwrap();
    let project = folder_of(home.path().join("project"), &[("image.glsl", CODE)]);
    let controller = Controller::new();
    let at = controller.1.to_string();
    let mut window = open(&display, home.path(), &project, &["--osc", &at]);
    send_until_shown(&mut window, &controller, "/eddy/level", 1.0);
    // This address is not learned yet.
    controller.send("/1/fader1", 0.0);
    assert_eq!(red(&mut window), 255);

    let slider = window.centre("uniform:level");
    window.move_to(slider);
    window.button("3");
    display.shot("control-menu.png");
    window.click_on("uniform-menu:learn:level");
    window.wait_shown("uniform:control:level");
    send_until_shown(&mut window, &controller, "/1/fader1", 0.0);
    send_until_shown(&mut window, &controller, "/1/fader1", 0.2);
    display.shot("control-learned.png");
    window.save();
    let manifest = fs::read_to_string(project.join("eddy.toml")).unwrap();
    assert!(manifest.contains("[controls]\nlevel = \"/1/fader1\"\n"), "{manifest}");
    window.wait_hidden("light:osc");
    window.kill();

    // The next start: no port is open before the setting is turned on.
    let settings = home.path().join(".config/eddy/settings.toml");
    fs::create_dir_all(settings.parent().unwrap()).unwrap();
    fs::write(&settings, format!("osc-port = {}\n", controller.1.port())).unwrap();
    let mut window = open(&display, home.path(), &project, &[]);
    window.wait_shown("uniform:control:level");
    drop(UdpSocket::bind(controller.1).expect("the port is free"));
    window.keys(&["ctrl+comma"]);
    window.wait_shown("settings:page");
    for _ in 0..40 {
        window.wheel(false);
    }
    window.click_on("setting:osc");
    display.shot("control-settings.png");
    window.keys(&["Escape"]);
    window.wait_hidden("settings:page");
    send_until_shown(&mut window, &controller, "/1/fader1", 0.8);
    let written = fs::read_to_string(&settings).unwrap();
    assert!(written.contains("osc = true"), "{written}");
}

#[test]
fn osc_from_the_network_has_a_light_to_turn_it_off() {
    let Some(display) = Display::of_size(1300, 800) else { return };
    let home = tempfile::tempdir().unwrap();
    let project = folder_of(home.path().join("project"), &[("image.glsl", CODE)]);
    let controller = Controller::new();
    let everywhere = format!("0.0.0.0:{}", controller.1.port());
    let mut window = open(&display, home.path(), &project, &["--osc", &everywhere]);
    window.wait_shown("light:osc");
    send_until_shown(&mut window, &controller, "/eddy/level", 1.0);
    display.shot("control-light.png");
    window.click_on("light:osc");
    window.wait_hidden("light:osc");
    drop(UdpSocket::bind(controller.1).expect("the port is free"));
}
