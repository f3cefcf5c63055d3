//! Circles among the modules of a layer: files that name each other can only be read together.

use super::paths::{self, Named};
use std::collections::{BTreeMap, BTreeSet};

/// Modules by their paths, as `engine::bind`, each with the paths that it names.
pub struct Modules(BTreeMap<Vec<String>, Vec<Named>>);

impl Modules {
    /// Reads texts by their paths within `src/`, as `engine/bind.rs`. Files of tests are left out: they name what they
    /// test.
    pub fn read<'t>(files: impl IntoIterator<Item = (&'t str, &'t str)>) -> Self {
        let mut modules: BTreeMap<Vec<String>, Vec<Named>> = BTreeMap::new();
        for (path, text) in files {
            let file = syn::parse_file(text).unwrap_or_else(|error| panic!("src/{path}: {error}"));
            let place: Vec<String> =
                path.trim_end_matches(".rs").split('/').filter(|p| *p != "mod").map(str::to_owned).collect();
            if place.iter().any(|name| name.ends_with("tests")) {
                continue;
            }
            modules.entry(place.clone()).or_default();
            for named in paths::of_file(&file).into_iter().filter(|named| !named.is_test) {
                let module = place.iter().chain(&named.within).cloned().collect();
                modules.entry(module).or_default().push(named);
            }
        }
        Self(modules)
    }

    /// Returns every circle among the modules of a layer, each as the shortest way round it.
    pub fn circles(&self, layer: &str) -> Vec<Vec<String>> {
        let edges: BTreeMap<&[String], BTreeSet<Vec<String>>> =
            self.0.keys().filter(|m| m[0] == layer).map(|m| (&m[..], self.edges(m))).collect();
        let mut found: Vec<Vec<String>> = Vec::new();
        let mut seen = BTreeSet::new();
        for module in edges.keys() {
            let Some(way) = shortest_way(&edges, module) else { continue };
            if seen.insert(way.iter().cloned().collect::<BTreeSet<_>>()) {
                found.push(way.iter().map(|m| m.join("::")).collect());
            }
        }
        found
    }

    /// Returns the modules of the same layer that a module names.
    fn edges(&self, module: &[String]) -> BTreeSet<Vec<String>> {
        // What a module offers as its own is named by who uses it there.
        let is_offer =
            |named: &&Named| named.bound.is_some() && self.0.contains_key(&joined(module, &named.segments[..1]));
        let named = self.0[module].iter().filter(|named| !is_offer(named));
        let targets = named.filter_map(|named| self.target(module, &named.segments, 0));
        targets.filter(|target| target[..] != *module && target[0] == module[0]).collect()
    }

    /// Returns the module that a path of `module` leads to: through what modules on the way offer, to where it is
    /// defined.
    fn target(&self, module: &[String], segments: &[String], depth: usize) -> Option<Vec<String>> {
        let first = segments.first()?.as_str();
        let (mut at, mut rest) = match first {
            "crate" | "eddy" => (Vec::new(), &segments[1..]),
            "self" => (module.to_vec(), &segments[1..]),
            "super" => (module[..module.len() - 1].to_vec(), &segments[1..]),
            _ if self.0.contains_key(&joined(module, &segments[..1])) => (module.to_vec(), segments),
            _ => return None,
        };
        while let Some(next) = rest.first() {
            let inner = joined(&at, std::slice::from_ref(next));
            if next == "super" {
                at.pop();
            } else if self.0.contains_key(&inner) {
                at = inner;
            } else {
                break;
            }
            rest = &rest[1..];
        }
        let offers = self.0.get(&at)?;
        let offer = rest.first().and_then(|name| offers.iter().find(|o| o.bound.as_ref() == Some(name)));
        match offer.filter(|_| depth < 8) {
            Some(offer) => self.target(&at, &offer.segments, depth + 1).or(Some(at)),
            None => Some(at),
        }
    }
}

fn joined(module: &[String], more: &[String]) -> Vec<String> {
    module.iter().chain(more).cloned().collect()
}

/// Returns the shortest way from a module back to itself, if there is one.
fn shortest_way(edges: &BTreeMap<&[String], BTreeSet<Vec<String>>>, from: &[String]) -> Option<Vec<Vec<String>>> {
    let mut ways = vec![vec![from.to_vec()]];
    let mut reached = BTreeSet::new();
    while !ways.is_empty() {
        let mut longer = Vec::new();
        for way in ways {
            for next in edges.get(&way[way.len() - 1][..]).into_iter().flatten() {
                if next[..] == *from {
                    return Some(way);
                }
                if reached.insert(next.clone()) {
                    longer.push(way.iter().cloned().chain([next.clone()]).collect());
                }
            }
        }
        ways = longer;
    }
    None
}
