//! The modules as a picture: a graph in the language of Graphviz, a node for each module and a frame round each folder.
//!
//! Arrows go between neighbours in a folder, and stand for all that lies in them; one that other arrows imply is left
//! out. Arrows of a circle are red.

use super::circles::{Arrows, Modules};
use std::{
    collections::{BTreeMap, BTreeSet},
    fmt::Write,
};

/// Layers whose folders are opened.
const OPENED: &[&str] = &["glsl", "engine", "session", "project"];

/// Returns the graph in the DOT language.
pub fn dot(modules: &Modules) -> String {
    let all = modules.all();
    let mut out = String::from(
        "digraph modules {\n  \
         graph [compound=true, fontname=\"Helvetica\", fontsize=16, nodesep=0.04, ranksep=0.22]\n  \
         node [shape=box, style=\"rounded,filled\", fillcolor=white, color=\"#8090a0\", fontname=\"Helvetica\", \
         fontsize=12, margin=\"0.02,0.01\", width=0.3, height=0.2]\n  edge [color=\"#8090a0\", arrowsize=0.5]\n",
    );
    let root: Vec<String> = Vec::new();
    folder(&mut out, &all, &neighbours(&all), &root);
    out.push_str("}\n");
    out
}

/// Returns by folder the arrows between the modules that lie in it.
fn neighbours(all: &Arrows) -> BTreeMap<Vec<String>, Arrows> {
    let mut folders: BTreeMap<Vec<String>, Arrows> = BTreeMap::new();
    for (module, targets) in all {
        for target in targets {
            let shared = module.iter().zip(target).take_while(|(a, b)| a == b).count();
            // A folder's own file stands beside what lies in it.
            let end = |m: &[String]| {
                if m.len() > shared { m[..=shared].to_vec() } else { own(m) }
            };
            let arrows = folders.entry(module[..shared].to_vec()).or_default();
            arrows.entry(end(module)).or_default().insert(end(target));
        }
    }
    folders
}

/// Returns the node of a folder's own file.
fn own(module: &[String]) -> Vec<String> {
    module.iter().cloned().chain(["mod".to_owned()]).collect()
}

fn folder(out: &mut String, all: &Arrows, neighbours: &BTreeMap<Vec<String>, Arrows>, at: &[String]) {
    let inside: BTreeSet<Vec<String>> = all
        .keys()
        .filter(|m| m.len() > at.len() && m.starts_with(at))
        .map(|m| m[..=at.len()].to_vec())
        .filter(|m| *m != ["lib"])
        .collect();
    let empty = Arrows::new();
    let arrows = neighbours.get(at).unwrap_or(&empty);
    if arrows.keys().chain(arrows.values().flatten()).any(|m| *m == own(at)) {
        writeln!(out, "  \"{}\" [label=\"mod.rs\", shape=plain]", own(at).join("::")).unwrap();
    }
    for module in &inside {
        let name = &module[module.len() - 1];
        let is_folder = all.keys().any(|m| m.len() > module.len() && m.starts_with(module));
        if is_folder && is_open(module) {
            let shade = ["#eef2f7", "#dfe7f0", "#cfdbe8"][at.len().min(2)];
            let id = module.join("::");
            writeln!(out, "  subgraph \"cluster_{id}\" {{\n  label=\"{name}\"; style=filled; color=\"{shade}\"")
                .unwrap();
            // Frames are ranked by two points that are not seen, above and below all that they hold.
            for end in ["top", "end"] {
                writeln!(out, "  \"{id}.{end}\" [style=invis, shape=point, width=0, height=0]").unwrap();
            }
            folder(out, all, neighbours, module);
            out.push_str("  }\n");
        } else {
            let label = if is_folder { format!("{name}/") } else { name.clone() };
            writeln!(out, "  \"{}\" [label=\"{label}\"]", module.join("::")).unwrap();
        }
    }
    let is_frame = |m: &Vec<String>| is_open(m) && all.keys().any(|n| n.len() > m.len() && n.starts_with(m));
    let point = |m: &Vec<String>, end: &str| if is_frame(m) { format!("{}.{end}", m.join("::")) } else { m.join("::") };
    let reach: BTreeMap<&Vec<String>, BTreeSet<&Vec<String>>> =
        arrows.keys().map(|from| (from, reached(arrows, from))).collect();
    let leads = |from: &Vec<String>, to: &Vec<String>| reach.get(from).is_some_and(|all| all.contains(to));
    if !at.is_empty() {
        let id = at.join("::");
        let own = Some(own(at)).filter(|own| arrows.contains_key(own) || arrows.values().any(|to| to.contains(own)));
        for module in inside.iter().chain(&own) {
            let is_named = arrows.iter().any(|(from, to)| to.contains(module) && !leads(module, from));
            if !is_named {
                writeln!(out, "  \"{id}.top\" -> \"{}\" [style=invis, weight=0]", point(module, "top")).unwrap();
            }
            if !arrows.get(module).is_some_and(|to| to.iter().any(|to| !leads(to, module))) {
                writeln!(out, "  \"{}\" -> \"{id}.end\" [style=invis, weight=0]", point(module, "end")).unwrap();
            }
        }
    }
    for (from, targets) in arrows {
        for to in targets {
            let is_red = leads(to, from);
            let is_implied = targets.iter().any(|by| by != to && leads(by, to) && !leads(to, by) && !leads(by, from));
            if is_red || !is_implied {
                let frame = |m: &Vec<String>, end: &str| {
                    if is_frame(m) { format!("{end}=\"cluster_{}\" ", m.join("::")) } else { String::new() }
                };
                let color = if is_red { "color=\"#e02020\" penwidth=1.6" } else { "" };
                let (tail, head) = (frame(from, "ltail"), frame(to, "lhead"));
                writeln!(out, "  \"{}\" -> \"{}\" [{tail}{head}{color}]", point(from, "end"), point(to, "top"))
                    .unwrap();
            }
        }
    }
}

/// Whether the picture shows what lies in a folder.
fn is_open(module: &[String]) -> bool {
    module.len() == 1 || module.len() == 2 && OPENED.contains(&module[0].as_str())
}

/// Returns every module that arrows lead to from one.
fn reached<'a>(arrows: &'a Arrows, from: &Vec<String>) -> BTreeSet<&'a Vec<String>> {
    let mut found = BTreeSet::new();
    let mut open: Vec<&Vec<String>> = arrows.get(from).into_iter().flatten().collect();
    while let Some(next) = open.pop() {
        if found.insert(next) {
            open.extend(arrows.get(next).into_iter().flatten());
        }
    }
    found
}
