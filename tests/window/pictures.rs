//! The pictures of README.md and docs: the real window, controlled by real mouse and key events.
//!
//! `scripts/draw-pictures` runs these and encodes the files that they write into the folder `EDDY_PICTURES`.

use crate::support::window::{Display, Window, folder_of};
use image::{Rgb, RgbImage, imageops};
use std::{
    fmt::Write as _,
    fs,
    path::{Path, PathBuf},
    time::Duration,
};

const SCREEN: (u32, u32) = (1280, 800);

fn folder() -> PathBuf {
    PathBuf::from(std::env::var_os("EDDY_PICTURES").expect("EDDY_PICTURES names the folder to write to"))
}

/// Returns a picture of the screen with a pointer, which X11 omits.
fn photographed(display: &Display, pointer: Option<(i64, i64)>) -> RgbImage {
    let file = tempfile::Builder::new().suffix(".png").tempfile().unwrap();
    display.photograph(file.path());
    let mut picture = image::open(file.path()).unwrap().to_rgb8();
    if let Some(at) = pointer {
        draw_pointer(&mut picture, at);
    }
    picture
}

/// Draws an arrow of 18 rows with a dark edge, row by row.
fn draw_pointer(picture: &mut RgbImage, (x, y): (i64, i64)) {
    for row in 0..18_i64 {
        let width = if row < 13 { row + 1 } else { 18 - row };
        for column in 0..width {
            let is_edge = column == 0 || column + 1 >= width || row == 12 && column > 4;
            let colour = if is_edge { Rgb([20, 20, 24]) } else { Rgb([255, 255, 255]) };
            if let (Ok(x), Ok(y)) = (u32::try_from(x + column), u32::try_from(y + row))
                && x < picture.width()
                && y < picture.height()
            {
                picture.put_pixel(x, y, colour);
            }
        }
    }
}

/// An animation: its frames as files, and the arguments for `img2webp`.
struct Film<'a> {
    display: &'a Display,
    folder: PathBuf,
    pointer: (i64, i64),
    frames: u32,
    list: String,
}

impl<'a> Film<'a> {
    fn new(display: &'a Display, folder: PathBuf) -> Self {
        fs::create_dir_all(&folder).unwrap();
        Self { display, folder, pointer: (640, 500), frames: 0, list: String::new() }
    }

    /// Adds a frame with a duration in milliseconds.
    fn frame(&mut self, millis: u32) {
        let picture = photographed(self.display, Some(self.pointer));
        let small = imageops::resize(&picture, 1024, 640, imageops::FilterType::CatmullRom);
        let name = format!("{:04}.png", self.frames);
        small.save(self.folder.join(&name)).unwrap();
        let _ = writeln!(self.list, "-d {millis} {name}");
        self.frames += 1;
    }

    /// Waits until the picture has advanced, however slow the machine is.
    fn wait(&self, window: &mut Window) {
        std::thread::sleep(Duration::from_millis(60));
        window.drain();
        let has_picture = window.newest("layout").is_some_and(|layout| layout["viewport"].is_array());
        if let Some(frame) = window.newest("frame").filter(|frame| has_picture && frame["playing"] == true) {
            let next = frame["frame"].as_i64().map(|n| n + 2);
            window.wait_for("two frames", |e| e["event"] == "frame" && e["frame"].as_i64() >= next);
        }
    }

    /// Moves the pointer there in steps, with a frame for each.
    fn move_to(&mut self, window: &mut Window, to: (i64, i64), steps: i64) {
        let from = self.pointer;
        for step in 1..=steps {
            self.pointer = (from.0 + (to.0 - from.0) * step / steps, from.1 + (to.1 - from.1) * step / steps);
            window.move_to(self.pointer);
            self.wait(window);
            self.frame(50);
        }
    }

    fn click(&mut self, window: &mut Window, at: (i64, i64)) {
        self.move_to(window, at, 5);
        window.click(at);
        std::thread::sleep(Duration::from_millis(250));
        self.frame(160);
    }

    /// Types a text letter by letter.
    fn type_text(&mut self, window: &Window, text: &str) {
        for letter in text.chars() {
            window.type_text(&letter.to_string());
            std::thread::sleep(Duration::from_millis(150));
            self.frame(110);
        }
    }

    fn keys(&mut self, window: &Window, keys: &[&str], millis: u32) {
        for key in keys {
            window.keys(&[key]);
            std::thread::sleep(Duration::from_millis(200));
            self.frame(millis);
        }
    }

    fn end(self) {
        let arguments = format!("-loop 0 -min_size -lossy -q 70 -m 6\n{}-o window.webp\n", self.list);
        fs::write(self.folder.join("arguments.txt"), arguments).unwrap();
    }
}

/// Returns the point of a line and a column in the code, both from 1, while the text is not scrolled.
fn code_point(window: &mut Window, line: i64, column: i64) -> (i64, i64) {
    let [x, y, ..] = window.rect("editor");
    (x as i64 + 4 + (column - 1) * 73 / 10 * 107 / 100, y as i64 + (line - 1) * 18 + 9)
}

#[test]
#[ignore = "writes pictures; scripts/draw-pictures runs it"]
fn film() {
    let Some((display, home)) = Display::of_size_with_home(SCREEN.0, SCREEN.1) else { return };
    let mut window = Window::open_as(&display, home.path(), Some("1280x800"), &[], &[]);
    std::thread::sleep(Duration::from_secs(3));
    let mut film = Film::new(&display, folder().join("film"));
    film.frame(700);
    let card = window.centre("preset:fluid");
    film.move_to(&mut window, card, 6);
    window.click(card);
    window.wait_compiled();
    window.wait_until("the picture", "frame", |e| e["frame"].as_i64() >= Some(2));
    film.frame(300);

    // Paint.
    for [u, v, to_u, to_v] in [[0.15, 0.25, 0.6, 0.75], [0.85, 0.7, 0.35, 0.35]] {
        let (from, to) = (window.picture_point(u, v), window.picture_point(to_u, to_v));
        film.move_to(&mut window, from, 3);
        window.press();
        film.move_to(&mut window, to, 20);
        window.release();
    }

    // Edit: the colour of the paper.
    let at = code_point(&mut window, 4, 27);
    film.click(&mut window, at);
    window.keys(&["End"]);
    window.keys(&["Left", "Left"]);
    for _ in 0..16 {
        window.keys(&["shift+Left"]);
    }
    film.frame(400);
    film.type_text(&window, "0.10, 0.13, 0.20");
    for _ in 0..6 {
        std::thread::sleep(Duration::from_millis(250));
        film.frame(100);
    }

    // A mistake, and its fix.
    let at = code_point(&mut window, 31, 16);
    film.click(&mut window, at);
    window.keys(&["End", "Left", "Left", "Left", "Left"]);
    film.keys(&window, &["BackSpace"], 150);
    window.keys(&["Escape"]);
    window.wait_until("the mistake", "compiled", |e| e["ok"] == false && e["compiling"] == false);
    std::thread::sleep(Duration::from_millis(700));
    film.frame(1500);
    film.keys(&window, &["ctrl+period"], 900);
    window.keys(&["Return"]);
    window.wait_compiled();
    std::thread::sleep(Duration::from_millis(500));
    film.frame(500);

    // A slider.
    let slider = window.rect("uniform:view");
    let at = |part: f64| ((slider[0] + part * slider[2]) as i64, (slider[1] + slider[3] / 2.0) as i64);
    film.move_to(&mut window, at(0.05), 5);
    window.press();
    film.move_to(&mut window, at(0.95), 8);
    window.release();
    film.frame(500);
    let reset = at(0.02);
    film.move_to(&mut window, reset, 3);
    window.click(reset);
    std::thread::sleep(Duration::from_millis(300));
    film.frame(200);

    // A pixel, step by step.
    let pixel = window.picture_point(0.35, 0.6);
    film.move_to(&mut window, pixel, 6);
    window.click_holding(&["ctrl", "shift"], pixel);
    window.wait_until("the traced pixel", "trace", |e| e["pixel"].is_array());
    std::thread::sleep(Duration::from_secs(1));
    film.frame(900);
    film.keys(&window, &["F10", "F10", "F10", "F10", "F10", "F10"], 350);
    film.frame(2000);
    film.end();
}

/// Saves the last rows of the window's column with the code.
fn save_column(name: &str, display: &Display, window: &mut Window, rows: u32) {
    let left = (window.rect("editor")[0] - 57.0).max(0.0) as u32;
    let picture = photographed(display, None);
    let (width, height) = picture.dimensions();
    let part = imageops::crop_imm(&picture, left, height - rows, width - left, rows);
    part.to_image().save(folder().join(name)).unwrap();
}

fn project(home: &Path, files: &[(&str, &str)]) -> PathBuf {
    folder_of(home.join("project"), files)
}

/// A sphere on a floor, by ray marching.
const SCENE: &str = "float map(vec3 p) {
    float ball = length(p - vec3(0.0, 1.0, 0.0)) - 1.0;
    return min(ball, p.y);
}

vec3 normal(vec3 p) {
    vec2 e = vec2(0.001, 0.0);
    return normalize(vec3(map(p + e.xyy) - map(p - e.xyy),
                          map(p + e.yxy) - map(p - e.yxy),
                          map(p + e.yyx) - map(p - e.yyx)));
}

void mainImage(out vec4 fragColor, in vec2 fragCoord) {
    vec2 uv = (2.0 * fragCoord - iResolution.xy) / iResolution.y;
    vec3 ro = vec3(0.0, 1.2, -4.0);
    vec3 rd = normalize(vec3(uv, 2.0));
    float t = 0.0;
    for (int i = 0; i < 90; i++) {
        float d = map(ro + rd * t); //@print d
        if (d < 0.001 || t > 20.0) break;
        t += d;
    }
    vec3 p = ro + rd * t;
    vec3 tint = p.y > 0.01 ? vec3(1.0, 0.5, 0.2) : vec3(0.2, 0.3, 0.35);
    float light = max(dot(normal(p), normalize(vec3(0.6, 0.8, -0.5))), 0.0);
    vec3 colour = t > 20.0 ? vec3(0.5, 0.65, 0.8) : tint * (0.15 + light);
    fragColor = vec4(sqrt(mix(vec3(0.5, 0.65, 0.8), colour, exp(-0.03 * t))), 1.0);
}
";

#[test]
#[ignore = "writes pictures; scripts/draw-pictures runs it"]
fn editor() {
    let Some((display, home)) = Display::of_size_with_home(1100, 480) else { return };
    let folder = project(home.path(), &[("image.glsl", SCENE)]);
    let mut window = Window::of_size(&display, home.path(), "1100x480", folder.to_str().unwrap());
    replace(&mut window, "length", "lenght");
    window.keys(&["Escape"]);
    window.wait_until("the mistake", "compiled", |e| e["ok"] == false && e["compiling"] == false);
    std::thread::sleep(Duration::from_secs(1));
    save_column("editor.png", &display, &mut window, 442);
}

/// Finds the first occurrence of a text in the code and replaces it.
fn replace(window: &mut Window, text: &str, by: &str) {
    window.click_on("editor");
    window.keys(&["ctrl+Home", "ctrl+f"]);
    window.wait_shown("field:find");
    window.type_text(text);
    window.keys(&["Return", "Escape"]);
    window.type_text(by);
}

#[test]
#[ignore = "writes pictures; scripts/draw-pictures runs it"]
fn trace() {
    let Some((display, home)) = Display::of_size_with_home(1100, 900) else { return };
    let folder = project(home.path(), &[("image.glsl", SCENE)]);
    let mut window = Window::of_size(&display, home.path(), "1100x900", folder.to_str().unwrap());
    window.keys(&["ctrl+shift+d"]);
    window.wait_shown("trace:pick");
    let pixel = window.picture_point(0.45, 0.6);
    window.click_holding(&["ctrl", "shift"], pixel);
    window.wait_until("the traced pixel", "trace", |e| e["pixel"].is_array());
    window.keys(&["ctrl+g"]);
    window.type_text("21");
    window.keys(&["Return", "F9", "F5", "F5", "F5", "F5"]);
    window.wait_until("the fourth iteration", "trace", |e| e["line"] == 21 && e["turn"] == 4);
    std::thread::sleep(Duration::from_secs(2));
    save_column("trace.png", &display, &mut window, 480);
}

#[test]
#[ignore = "writes pictures; scripts/draw-pictures runs it"]
fn buffers() {
    let Some((display, home)) = Display::of_size_with_home(1280, 800) else { return };
    let mut window = Window::of_size(&display, home.path(), "1280x800", "fluid");
    paint(&mut window);
    window.keys(&["ctrl+shift+t"]);
    window.wait_shown("buffers:canvas");
    let [x, y, width, height] = window.rect("buffers:canvas");
    window.move_to(((x + 0.4 * width) as i64, (y + 0.5 * height) as i64));
    std::thread::sleep(Duration::from_secs(3));
    save_column("buffers.png", &display, &mut window, 426);
}

/// Draws three strokes.
fn paint(window: &mut Window) {
    for stroke in [[0.15, 0.25, 0.6, 0.75], [0.85, 0.7, 0.35, 0.35], [0.2, 0.8, 0.8, 0.25]] {
        let [u, v, to_u, to_v] = stroke;
        let from = window.picture_point(u, v);
        window.move_to(from);
        window.press();
        for step in 1..=12 {
            let part = f64::from(step) / 12.0;
            let to = window.picture_point(u + (to_u - u) * part, v + (to_v - v) * part);
            window.move_to(to);
            std::thread::sleep(Duration::from_millis(80));
        }
        window.release();
    }
}

#[test]
#[ignore = "writes pictures; scripts/draw-pictures runs it"]
fn measurements() {
    let Some((display, home)) = Display::of_size_with_home(1100, 900) else { return };
    let manifest = "[passes.buffer_a]\nsize = [256, 144]\nchannels.0 = { buffer = \"A\", filter = \"nearest\" }\n\
                    [passes.image]\nchannels.0 = { buffer = \"A\" }\n";
    let files = [("eddy.toml", manifest), ("buffer_a.glsl", WAVES), ("image.glsl", SHOWN_WAVES)];
    let folder = project(home.path(), &files);
    let mut window = Window::of_size(&display, home.path(), "1100x900", folder.to_str().unwrap());
    window.keys(&["ctrl+shift+j"]);
    window.wait_shown("panel:measurements");
    std::thread::sleep(Duration::from_secs(30));
    save_column("measurements.png", &display, &mut window, 362);
}

/// The wave equation with damping; a drop falls now and then.
const WAVES: &str = "//@probe rms(buffer_a.x)
//@probe max(buffer_a.x)
float at(ivec2 p) { return texelFetch(iChannel0, clamp(p, ivec2(0), ivec2(255, 143)), 0).x; }

void mainImage(out vec4 state, in vec2 fragCoord) {
    ivec2 p = ivec2(fragCoord);
    vec2 old = texelFetch(iChannel0, p, 0).xy;
    float laplacian = at(p + ivec2(1, 0)) + at(p - ivec2(1, 0)) + at(p + ivec2(0, 1)) + at(p - ivec2(0, 1)) - 4.0 * old.x;
    float next = 0.998 * (2.0 * old.x - old.y) + 0.25 * laplacian - 0.002 * old.y;
    if (iFrame % 90 == 0) {
        vec2 drop = vec2(60 + 97 * iFrame % 140, 40 + 53 * iFrame % 70);
        next += exp(-0.05 * dot(fragCoord - drop, fragCoord - drop));
    }
    state = vec4(next, old.x, 0.0, 1.0);
}
";

const SHOWN_WAVES: &str = "void mainImage(out vec4 fragColor, in vec2 fragCoord) {
    float height = texture(iChannel0, fragCoord / iResolution.xy).x;
    vec3 water = mix(vec3(0.02, 0.10, 0.22), vec3(0.55, 0.85, 0.95), 0.4 + 0.8 * height);
    fragColor = vec4(water, 1.0);
}
";

#[test]
#[ignore = "writes pictures; scripts/draw-pictures runs it"]
fn compare() {
    let Some((display, home)) = Display::of_size_with_home(1280, 800) else { return };
    let folder = project(home.path(), &[("image.glsl", SCENE)]);
    let mut window = Window::of_size(&display, home.path(), "1280x800", folder.to_str().unwrap());
    // With fewer steps, rays that pass near the ball end before the floor.
    replace(&mut window, "90", "14");
    window.wait_compiled();
    window.keys(&["ctrl+shift+o"]);
    window.click_on("compare:begin");
    window.wait_until("the comparison", "compare", |e| e["state"] == "ended");
    window.click_on("compare:wipe");
    std::thread::sleep(Duration::from_secs(2));
    save_column("compare.png", &display, &mut window, 426);
}

#[test]
#[ignore = "writes pictures; scripts/draw-pictures runs it"]
fn lab() {
    let Some((display, home)) = Display::of_size_with_home(1280, 800) else { return };
    let mut window = Window::of_size(&display, home.path(), "1280x800", "fluid");
    window.keys(&["ctrl+shift+y"]);
    window.click_on("lab:study");
    window.click_on("lab:study:blur");
    window.wait_until("the study", "lab", |e| e["study"] == "blur");
    window.click_on("lab:start");
    window.wait_until("the run", "lab", |e| e["running"] == "blur");
    while window.newest("lab").is_some_and(|e| e["running"] == "blur") {
        window.wait_for("a point", |e| e["event"] == "lab");
    }
    std::thread::sleep(Duration::from_secs(1));
    save_column("lab.png", &display, &mut window, 426);
}
