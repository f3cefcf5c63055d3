//! Circles among the modules of a layer: files that name each other can only be read together.

use super::paths::{self, Named};
use std::collections::{BTreeMap, BTreeSet};

/// Modules by their paths, each with those that it names.
pub type Arrows = BTreeMap<Vec<String>, BTreeSet<Vec<String>>>;

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
        let arrows = self.0.keys().filter(|m| m[0] == layer).map(|m| (m.clone(), self.arrows(m))).collect();
        circles_of(&arrows)
    }

    /// Returns every circle among folders: modules that lie in one, taken together, with their neighbours.
    pub fn folder_circles(&self, layer: &str) -> Vec<Vec<String>> {
        let mut folders: BTreeMap<Vec<String>, Arrows> = BTreeMap::new();
        for module in self.0.keys().filter(|m| m[0] == layer) {
            for target in self.arrows(module).into_iter().filter(|t| t[0] == layer) {
                let shared = module.iter().zip(&target).take_while(|(a, b)| a == b).count();
                // A folder may name what lies in it, and is named by it: that is for `circles` to judge.
                if shared < module.len().min(target.len()) {
                    let arrows = folders.entry(module[..shared].to_vec()).or_default();
                    arrows.entry(module[..=shared].to_vec()).or_default().insert(target[..=shared].to_vec());
                }
            }
        }
        folders.values().flat_map(circles_of).collect()
    }

    /// Returns every module with those that it names.
    pub fn all(&self) -> Arrows {
        self.0.keys().map(|m| (m.clone(), self.arrows(m))).collect()
    }

    /// Returns the modules that a module names.
    fn arrows(&self, module: &[String]) -> BTreeSet<Vec<String>> {
        let names = &self.0[module];
        // What a module offers as its own is named by who uses it, which may be itself.
        let is_offer = |n: &&Named| n.is_public && self.0.contains_key(&joined(module, &n.segments[..1]));
        let globs: Vec<Vec<String>> = names
            .iter()
            .filter(|n| n.bound.is_none() && n.segments.last().is_some_and(|s| s == "*"))
            .filter_map(|n| self.target(module, &n.segments, 0))
            .collect();
        let target = |named: &Named| {
            let bound = |n: &&Named| n.bound.is_some() && n.bound.as_ref() == named.segments.first();
            if named.bound.is_none()
                && let Some(offer) = names.iter().filter(is_offer).find(bound)
            {
                return self.target(module, &offer.segments, 0);
            }
            let direct = || self.target(module, &named.segments, 0).filter(|_| named.segments.len() > 1);
            let through = || globs.iter().find_map(|glob| self.offered(glob, &named.segments));
            direct().or_else(|| if named.bound.is_none() { through() } else { None })
        };
        let targets = names.iter().filter(|n| !is_offer(n)).filter_map(target);
        targets.filter(|target| target[..] != *module).collect()
    }

    /// Returns where a path leads whose first name a module offers or holds.
    fn offered(&self, module: &[String], segments: &[String]) -> Option<Vec<String>> {
        let first = segments.first()?;
        let is_inside = self.0.contains_key(&joined(module, &segments[..1]));
        let is_offered = self.0[module].iter().any(|n| n.bound.as_ref() == Some(first));
        if is_inside || is_offered { self.target(module, &joined(&["self".to_owned()], segments), 0) } else { None }
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

/// Returns every circle, each as the shortest way round it.
pub fn circles_of(arrows: &Arrows) -> Vec<Vec<String>> {
    let mut found: Vec<Vec<String>> = Vec::new();
    let mut seen = BTreeSet::new();
    for module in arrows.keys() {
        let Some(way) = shortest_way(arrows, module) else { continue };
        if seen.insert(way.iter().cloned().collect::<BTreeSet<_>>()) {
            found.push(way.iter().map(|m| m.join("::")).collect());
        }
    }
    found
}

/// Returns the shortest way from a module back to itself, if there is one.
fn shortest_way(arrows: &Arrows, from: &[String]) -> Option<Vec<Vec<String>>> {
    let mut ways = vec![vec![from.to_vec()]];
    let mut reached = BTreeSet::new();
    while !ways.is_empty() {
        let mut longer = Vec::new();
        for way in ways {
            for next in arrows.get(&way[way.len() - 1]).into_iter().flatten() {
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
