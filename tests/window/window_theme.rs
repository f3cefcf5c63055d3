//! End to end: the window is dark or light as the desktop prefers, with the test's own portal on its own D-Bus.
#![cfg(target_os = "linux")]

use crate::support::window::{Display, Window};
use ashpd::zbus::{
    self, connection, fdo,
    object_server::SignalEmitter,
    zvariant::{OwnedValue, Value},
};
use std::{
    fs,
    io::{BufRead, BufReader},
    process::{Child, Command, Stdio},
    sync::{
        Arc,
        atomic::{AtomicU32, Ordering},
    },
};

const PATH: &str = "/org/freedesktop/portal/desktop";
const NAMESPACE: &str = "org.freedesktop.appearance";
const KEY: &str = "color-scheme";
const DARK: u32 = 1;
const LIGHT: u32 = 2;

/// A private bus of this test. Dropping it stops the server.
struct Bus {
    server: Child,
    address: String,
}

impl Bus {
    fn start() -> Bus {
        let mut server = Command::new("dbus-daemon")
            .args(["--session", "--nofork", "--nopidfile", "--print-address"])
            .stdout(Stdio::piped())
            .stderr(Stdio::null())
            .spawn()
            .expect("dbus-daemon is needed here");
        let mut address = String::new();
        BufReader::new(server.stdout.take().unwrap()).read_line(&mut address).unwrap();
        Bus { server, address: address.trim().to_owned() }
    }
}

impl Drop for Bus {
    fn drop(&mut self) {
        let _ = self.server.kill();
        let _ = self.server.wait();
    }
}

/// The desktop's settings.
struct Settings(Arc<AtomicU32>);

#[zbus::interface(name = "org.freedesktop.portal.Settings", crate = "ashpd::zbus")]
impl Settings {
    fn read(&self, namespace: &str, key: &str) -> fdo::Result<OwnedValue> {
        if (namespace, key) != (NAMESPACE, KEY) {
            return Err(fdo::Error::Failed(format!("no {key} of {namespace}")));
        }
        // A variant inside a variant, as in the portal's first version.
        let inner = Value::new(Value::U32(self.0.load(Ordering::Relaxed)));
        inner.try_to_owned().map_err(|e| fdo::Error::Failed(e.to_string()))
    }

    #[zbus(property, name = "version")]
    fn version(&self) -> u32 {
        1
    }

    #[zbus(signal)]
    async fn setting_changed(
        emitter: &SignalEmitter<'_>,
        namespace: &str,
        key: &str,
        value: Value<'_>,
    ) -> zbus::Result<()>;
}

fn wait_for_theme(window: &mut Window, theme: &str) {
    window.wait_until(&format!("the {theme} window"), "theme", |e| e["shown"] == theme);
}

#[test]
fn the_window_follows_the_desktop_theme_unless_one_is_set() {
    let Some((display, home)) = Display::with_home() else { return };
    let bus = Bus::start();
    let scheme = Arc::new(AtomicU32::new(LIGHT));
    let connection = pollster::block_on(async {
        let builder = connection::Builder::address(bus.address.as_str())?;
        let builder = builder.name("org.freedesktop.portal.Desktop")?;
        builder.serve_at(PATH, Settings(scheme.clone()))?.build().await
    })
    .unwrap();
    let file = home.path().join("image.glsl");
    fs::write(&file, "void mainImage(out vec4 o, in vec2 p) { o = vec4(p / iResolution.xy, 0.5, 1.0); }\n").unwrap();
    let environment = [("DBUS_SESSION_BUS_ADDRESS", bus.address.as_str())];
    let arguments = [file.to_str().unwrap()];
    let mut window = Window::open_as(&display, home.path(), Some("760x440"), &environment, &arguments);
    wait_for_theme(&mut window, "light");
    display.shot("system-light.png");
    // A change of the preference is followed at once.
    scheme.store(DARK, Ordering::Relaxed);
    let signal = async {
        let emitter = SignalEmitter::new(&connection, PATH)?;
        Settings::setting_changed(&emitter, NAMESPACE, KEY, Value::U32(DARK)).await
    };
    pollster::block_on(signal).unwrap();
    wait_for_theme(&mut window, "dark");
    // A theme in the settings overrides the preference.
    let settings = home.path().join(".config/eddy");
    fs::create_dir_all(&settings).unwrap();
    drop(window);
    fs::write(settings.join("settings.toml"), "theme = \"light\"\n").unwrap();
    let mut window = Window::open_as(&display, home.path(), Some("760x440"), &environment, &arguments);
    wait_for_theme(&mut window, "light");
}
