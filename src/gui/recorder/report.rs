//! Reports the state of a film to scripts that drive the window.

use crate::session::{FilmView, Session};
use serde_json::{Value, json};

pub(crate) fn report(session: &Session) -> Value {
    let Some(film) = session.film() else { return json!({ "state": null }) };
    let (state, frames) = match &film {
        FilmView::Live(live) => ("live", Some(live.frames)),
        FilmView::UnderWay(progress) => ("drawing", Some(progress.done)),
        FilmView::Done(done) => ("done", Some(done.frames)),
        FilmView::Failed(_) => ("failed", None),
        FilmView::Cancelled => ("cancelled", None),
    };
    let path = match &film {
        FilmView::Done(done) => Some(done.path.clone()),
        _ => None,
    };
    json!({ "state": state, "frames": frames, "path": path, "words": film.words() })
}
