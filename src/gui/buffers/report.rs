//! The report for scripts.

use super::{
    numbers::fitted,
    state::{Buffers, Page, title},
};
use crate::{
    debugger::nonfinite::SearchEnd,
    engine::{PassCost, ReadTiming},
    session::{
        Session, Status,
        buffers::{Target, reason},
    },
};
use serde_json::{Value, json};

pub(super) fn report(state: &Buffers, session: &Session) -> Value {
    let project = session.project();
    let under: serde_json::Map<String, Value> = session
        .texels_under()
        .iter()
        .map(|at| {
            let name = title(project, &(at.pass.clone(), at.index));
            let stored = usize::from(at.components).min(4);
            let values: Vec<String> = at.value[..stored].iter().map(|x| fitted(*x, 12)).collect();
            (name, json!({ "texel": [at.texel.0, at.texel.1], "values": values }))
        })
        .collect();
    let seen = state.seen.as_ref().map(|seen| &seen.read);
    let figures = seen.map(|read| {
        let statistics = &read.statistics;
        json!({
            "size": [read.pixels.width, read.pixels.height],
            "components": read.components,
            "range": statistics.extremes.map(|extreme| extreme.map(|(low, high)| [low, high])),
            "mean": statistics.means,
            "nonfinite": read.nonfinite.map_or(0, |bad| bad.count),
        })
    });
    let search = session.search().map(|search| match search {
        Status::UnderWay(_) => json!({ "state": "under way" }),
        Status::Ended(Ok(SearchEnd::Nowhere { first, last })) => json!({ "state": "nowhere", "frames": [first, last] }),
        Status::Ended(Err(why)) => json!({ "state": "failed", "why": why }),
        Status::Ended(Ok(SearchEnd::Found(found))) => json!({
            "state": "found",
            "pass": found.pass.title(),
            "frame": found.frame,
            "texel": [found.texel.0, found.texel.1],
            "texels": found.texels,
            "older": found.is_older,
            "line": found.origin.as_ref().and_then(|origin| Some(origin.place.as_ref()?.line)),
            "tab": found.origin.as_ref().and_then(|origin| Some(origin.place.as_ref()?.title())),
            "text": found.origin.as_ref().map(|origin| &origin.text),
        }),
    });
    let is_nonfinite = |target: &Target| {
        session.miniature(&target.0, target.1).is_some_and(|(miniature, _)| !miniature.nonfinite.is_empty())
    };
    let nonfinite = Buffers::targets(project).into_iter().filter(is_nonfinite);
    let nonfinite: Vec<String> = nonfinite.map(|target| title(project, &target)).collect();
    json!({
        "nonfinite": nonfinite,
        "page": if state.page == Page::Graph { "graph" } else { "texels" },
        "pass": state.target(project).map(|target| title(project, &target)),
        "texel": state.texel.map(|(x, y)| [x, y]),
        "written": state.written,
        "figures": figures,
        "under": under,
        "scale": state.scale,
        "search": search,
        "graph": (state.page == Page::Graph).then(|| graph(session)),
    })
}

fn graph(session: &Session) -> Vec<Value> {
    let all: Vec<_> = session.pass_costs().passes.into_iter().map(|pass| pass.cost).collect();
    let node = |cost: &PassCost| {
        let when = |when: ReadTiming| if when == ReadTiming::ThisFrame { "this frame" } else { "last frame" };
        let reads: Vec<_> = cost.reads.iter().map(|read| (read.pass.title(), when(read.when))).collect();
        json!({ "pass": cost.pass.title(), "reads": reads, "why": reason(&cost.pass, &all) })
    };
    all.iter().map(node).collect()
}
