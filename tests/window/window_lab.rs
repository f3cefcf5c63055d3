//! End to end: the lab's panel and the table of costs in the real window, with real mouse and key events.

use crate::support::window::{Display, Window, folder_of};
use serde_json::Value;
use std::fs;

/// Returns the points in the plot, as `METHOD:SETTING`.
fn points(layout: &Value) -> Vec<String> {
    let names = layout["rects"].as_object().into_iter().flat_map(|rects| rects.keys());
    names.filter_map(|name| Some(name.strip_prefix("lab:point:")?.to_owned())).collect()
}

#[test]
fn a_study_runs_in_the_background_and_a_click_on_a_point_opens_its_project() {
    let Some((display, home)) = Display::with_home() else { return };
    let folder = folder_of(
        home.path().join("project"),
        &[("image.glsl", "void mainImage(out vec4 o, in vec2 p) { o = vec4(0.5); }\n")],
    );
    let mut window = Window::open_project(&display, home.path(), &folder);
    window.resize(1000, 700);
    // Both are drawn by the same processor.
    window.pause();

    window.keys(&["ctrl+shift+y"]);
    window.click_on("lab:study");
    window.click_on("lab:study:blur");
    window.wait_until("the study", "lab", |e| e["study"] == "blur" && e["points"] == 0);
    window.click_on("lab:start");
    window.wait_until("the run", "lab", |e| e["running"] == "blur");

    // The window responds while points arrive.
    window.click_on("editor");
    window.type_text("// ");
    window.wait_until("what was typed", "dirty", |e| e["dirty"] == true);
    for wanted in 1..=3 {
        window.wait_until("a point", "lab", |e| e["points"].as_u64() >= Some(wanted));
    }
    assert_eq!(window.newest("lab").unwrap()["running"], "blur", "points are plotted during the run");
    display.shot("lab-running.png");
    window.click_on("lab:stop");
    window.wait_until("the end of the run", "lab", |e| e["running"].is_null() && e["told"].is_null());

    let layout = window.wait_until("points in the plot", "layout", |e| points(e).len() >= 2);
    let point = points(&layout).pop().unwrap();
    window.click_on(&format!("lab:point:{point}"));
    // The open project has an unsaved change, which causes the usual question.
    window.wait_until("the question", "question", |e| e["kind"] == "unsaved");
    window.click_on("answer:discard");
    let name = format!("blur {}", point.replace(':', " "));
    let opened = window.wait_until("the point's project", "opened", |e| e["name"] == name.as_str());
    assert!(opened["origin"].is_null(), "{opened}");
    window.wait_compiled();
    // At the study's own size.
    window.wait_until("the canvas", "layout", |e| e["canvas"] == serde_json::json!([256, 256]));
    display.shot("lab-opened.png");

    // Another project has the size of the view again.
    window.keys(&["ctrl+n"]);
    window.wait_until("the view's size", "layout", |e| e["canvas"][0] != e["canvas"][1]);
    assert_eq!(window.stderr(), "");
}

#[test]
fn the_table_of_costs_lists_every_pass_and_can_be_closed() {
    let Some((display, home)) = Display::with_home() else { return };
    let folder = home.path().join("project");
    fs::create_dir_all(&folder).unwrap();
    let write = |name: &str, text: &str| fs::write(folder.join(name), text).unwrap();
    write(
        "buffer_a.glsl",
        "#iChannel0 \"self\"\nvoid mainImage(out vec4 o, in vec2 p) { o = vec4(iTime) + texelFetch(iChannel0, \
         ivec2(p), 0); }\n",
    );
    write("buffer_b.glsl", "void mainImage(out vec4 o, in vec2 p) { o = vec4(iTime); }\n");
    let image = "#iChannel0 \"file://buffer_a.glsl\"\nvoid mainImage(out vec4 o, in vec2 p) { o = \
                 texelFetch(iChannel0, ivec2(p), 0); }\n";
    write("image.glsl", image);
    let mut window = Window::open_project(&display, home.path(), &folder);
    assert!(window.newest("costs").is_none(), "costs were gathered while the table is closed");

    window.click_on("button:view");
    window.click_on("view:costs");
    let timed =
        |e: &Value| e["passes"].as_array().is_some_and(|p| p.iter().filter(|p| p["timed"] == true).count() == 2);
    let costs = window.wait_until("times of both passes", "costs", timed);
    let layout = window.newest("layout").unwrap();
    let texels = layout["canvas"][0].as_u64().unwrap() * layout["canvas"][1].as_u64().unwrap();
    let seen: Vec<_> =
        costs["passes"].as_array().unwrap().iter().map(|p| (p["pass"].clone(), p["drawn"].clone())).collect();
    let row = |name: &str, drawn: bool| (Value::from(name), Value::from(drawn));
    assert_eq!(seen, [row("Buffer A", true), row("Image", true), row("Buffer B", false)]);
    assert!(costs["passes"][1]["moved_bytes"].as_u64() <= Some(32 * texels), "{costs} for {texels} texels");
    window.wait_until("its sum", "layout", |e| e["rects"]["costs:sum"].is_array());
    display.shot("costs.png");

    window.keys(&["ctrl+shift+m"]);
    window.wait_until("the table to be closed", "layout", |e| e["rects"]["costs:sum"].is_null());
}
