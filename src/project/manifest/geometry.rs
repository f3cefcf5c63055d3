//! The keys of `eddy.toml` that make a pass draw meshes: `draw`, `targets` and `camera`.

use super::{
    edit::{child, set},
    reader::{Reader, number},
};
use crate::{
    Camera, Cull, DepthTest, Geometry, MAX_TARGETS, MeshDraw, MeshSource, Normals, Pass, PassName, PassSettings,
    Source, Stage, TexelFormat,
};
use std::ops::Range;
use toml_edit::{Array, InlineTable, Item, TableLike, Value};

/// The keys of a pass's table that this module reads.
pub(super) const KEYS: [&str; 3] = ["draw", "targets", "camera"];

const DRAW: [&str; 11] = [
    "mesh",
    "normals",
    "vertex",
    "fragment",
    "cull",
    "depth",
    "depth_write",
    "color_write",
    "scale",
    "rotation",
    "position",
];
const CAMERA: [&str; 8] = ["yaw", "pitch", "distance", "target", "fov", "near", "far", "orbit"];

/// An entry of `draw` as written: stages by the names of their files.
#[derive(Clone, Debug, PartialEq)]
struct Entry {
    mesh: String,
    vertex: String,
    /// `None`: the pass's own text.
    fragment: Option<String>,
    /// The draw, whose stages are not resolved yet.
    draw: MeshDraw,
}

/// The file of a pass with meshes that names none: its first draw's fragment stage.
pub(super) fn own_file(pass: &dyn TableLike) -> Option<String> {
    let draws = tables(pass.get("draw")?)?;
    draws.first()?.get("fragment")?.as_str().map(str::to_owned)
}

/// Returns the tables of `[{..}, {..}]`, or of `[[passes.x.draw]]`.
fn tables(item: &Item) -> Option<Vec<&dyn TableLike>> {
    if let Some(tables) = item.as_array_of_tables() {
        return Some(tables.iter().map(|t| t as &dyn TableLike).collect());
    }
    let tables = item.as_array()?.iter().map(|v| v.as_inline_table().map(|t| t as &dyn TableLike));
    tables.collect()
}

fn span_of(table: &dyn TableLike) -> Option<Range<usize>> {
    let spans = table.iter().filter_map(|(_, item)| item.span());
    spans.reduce(|a, b| a.start.min(b.start)..a.end.max(b.end))
}

impl Reader<'_> {
    /// Reads the geometry of a pass whose own text is in `file`. Stores the format of its first target in `settings`.
    pub(super) fn geometry(
        &mut self,
        id: &PassName,
        pass: &dyn TableLike,
        file: &str,
        settings: &mut PassSettings,
    ) -> Option<Geometry> {
        let Some(item) = pass.get("draw") else {
            for key in ["targets", "camera"] {
                if let Some(item) = pass.get(key) {
                    self.error(
                        item.span(),
                        format!("{key} is for passes that draw meshes"),
                        "add draw = [..], or remove it",
                    );
                }
            }
            return None;
        };
        if let Some(hint) = id.row().refusal("draw") {
            self.error(item.span(), format!("{} draws no meshes", id.title()), hint);
            return None;
        }
        if let Some(region) = pass.get("region") {
            self.error(
                region.span(),
                "a pass that draws meshes has no region",
                "remove it: such a pass is always cleared completely",
            );
        }
        let entries = self.entries(item);
        let mut geometry = Geometry {
            draws: Vec::new(),
            more_targets: self.targets(pass, settings),
            camera: self.camera(pass),
            stages: Vec::new(),
        };
        for (Entry { mesh: _, vertex, fragment, draw }, at) in entries {
            let vertex = self.stage(&mut geometry.stages, file, &vertex, at.clone());
            let fragment = fragment.map_or(Some(Stage::Own), |f| self.stage(&mut geometry.stages, file, &f, at));
            if let (Some(vertex), Some(fragment)) = (vertex, fragment) {
                geometry.draws.push(MeshDraw { vertex, fragment, ..draw });
            }
        }
        let uses_own = geometry.draws.iter().any(|d| d.vertex == Stage::Own || d.fragment == Stage::Own);
        if let (Some(item), false, false) = (pass.get("file"), uses_own, geometry.draws.is_empty()) {
            let hint = "remove file, or leave out fragment to use this file";
            self.error(item.span(), "no draw uses this pass's own file", hint);
        }
        Some(geometry)
    }

    fn stage(&mut self, stages: &mut Vec<Source>, own: &str, file: &str, at: Option<Range<usize>>) -> Option<Stage> {
        if file == own {
            return Some(Stage::Own);
        }
        if let Some(n) = stages.iter().position(|s| s.name == file) {
            return Some(Stage::File(n));
        }
        let source = self.source(file, "a stage", at)?;
        stages.push(source);
        Some(Stage::File(stages.len() - 1))
    }

    fn entries(&mut self, item: &Item) -> Vec<(Entry, Option<Range<usize>>)> {
        const SHAPE: &str = "a list of tables, [{ mesh = \"builtin:sphere\", vertex = \"x.vert.glsl\" }]";
        let Some(tables) = tables(item) else {
            self.wrong_type("draw", item, SHAPE);
            return Vec::new();
        };
        if tables.is_empty() {
            self.error(item.span(), "draw has no mesh", "add { mesh = \"builtin:sphere\", vertex = \"x.vert.glsl\" }");
        }
        let mut entries = Vec::new();
        for (n, table) in tables.into_iter().enumerate() {
            let at = span_of(table).or_else(|| item.span());
            let place = format!("draw {n}");
            self.check_keys(&place, table, &[&DRAW]);
            let mut needed = |key: &str, hint: &str| {
                if table.get(key).is_none() {
                    self.error(at.clone(), format!("{place} has no {key}"), hint);
                }
                self.string(table, key)
            };
            let mesh = needed("mesh", "write mesh = \"builtin:sphere\", or a glTF or OBJ file");
            let vertex = needed("vertex", "write vertex = \"x.vert.glsl\", a vertex shader file");
            let fragment = self.string(table, "fragment");
            let cull = self.one_of(table, "cull", &Cull::ALL.map(Cull::name));
            let depth = self.one_of(table, "depth", &DepthTest::ALL.map(DepthTest::name));
            let normals = self.one_of(table, "normals", &Normals::ALL.map(Normals::name));
            let source = MeshSource::parse(mesh.as_deref().unwrap_or_default());
            if let (Some(_), MeshSource::Builtin(_)) = (normals, &source) {
                let span = table.get("normals").and_then(Item::span);
                self.error(span, "a builtin mesh has its own normals", "remove normals");
            }
            let draw = MeshDraw {
                mesh: source,
                normals: Normals::ALL.into_iter().find(|n| Some(n.name()) == normals),
                vertex: Stage::Own,
                fragment: Stage::Own,
                cull: Cull::ALL.into_iter().find(|c| Some(c.name()) == cull).unwrap_or_default(),
                depth: DepthTest::ALL.into_iter().find(|d| Some(d.name()) == depth).unwrap_or_default(),
                depth_write: self.on_unless_said(table, "depth_write"),
                color_write: self.on_unless_said(table, "color_write"),
                scale: self.number(table, "scale", 1.0, |x| x > 0.0, "a number above 0"),
                rotation: self.vector(table, "rotation"),
                position: self.vector(table, "position"),
            };
            if let (Some(mesh), Some(vertex)) = (mesh, vertex) {
                entries.push((Entry { mesh, vertex, fragment, draw }, at));
            }
        }
        entries
    }

    fn on_unless_said(&mut self, table: &dyn TableLike, key: &str) -> bool {
        !table.contains_key(key) || self.boolean(table, key) == Some(true)
    }

    fn targets(&mut self, pass: &dyn TableLike, settings: &mut PassSettings) -> Vec<TexelFormat> {
        let Some(item) = pass.get("targets") else { return Vec::new() };
        if let Some(format) = pass.get("format") {
            self.error(format.span(), "the formats of this pass are in targets", "remove format");
        }
        match targets(item) {
            Some(formats) => {
                settings.format = formats[0];
                formats[1..].to_vec()
            }
            None => {
                let known = TexelFormat::ALL.map(TexelFormat::name);
                let shape = format!("a list of one to {MAX_TARGETS} of the formats {}", crate::listed(&known));
                self.wrong_type("targets", item, &shape);
                Vec::new()
            }
        }
    }

    fn camera(&mut self, pass: &dyn TableLike) -> Camera {
        let d = Camera::default();
        let Some(table) = pass.get("camera").and_then(|item| self.table("camera", item)) else { return d };
        self.check_keys("camera", table, &[&CAMERA]);
        let above_0 = |x: f64| x > 0.0;
        let camera = Camera {
            yaw: self.number(table, "yaw", d.yaw, |_| true, "a number of degrees"),
            pitch: self.number(table, "pitch", d.pitch, |x| x.abs() <= 89.0, "degrees from -89 to 89"),
            distance: self.number(table, "distance", d.distance, above_0, "a number above 0"),
            target: self.vector(table, "target"),
            fov: self.number(table, "fov", d.fov, |x| x > 0.0 && x < 180.0, "degrees above 0 and below 180"),
            near: self.number(table, "near", d.near, above_0, "a number above 0"),
            far: self.number(table, "far", d.far, above_0, "a number above 0"),
            orbit: self.on_unless_said(table, "orbit"),
        };
        if camera.near >= camera.far {
            let at = table.get("far").or_else(|| table.get("near")).and_then(Item::span);
            self.error(at, "the far plane is in front of the near plane", "make far greater than near");
        }
        camera
    }

    fn number(
        &mut self,
        table: &dyn TableLike,
        key: &str,
        default: f64,
        fits: impl Fn(f64) -> bool,
        what: &str,
    ) -> f64 {
        let Some(item) = table.get(key) else { return default };
        match item.as_value().and_then(number).filter(|x| fits(*x)) {
            Some(x) => x,
            None => {
                self.wrong_type(key, item, what);
                default
            }
        }
    }

    fn vector(&mut self, table: &dyn TableLike, key: &str) -> [f64; 3] {
        let Some(item) = table.get(key) else { return [0.0; 3] };
        let all: Option<Vec<f64>> = item.as_array().and_then(|a| a.iter().map(number).collect());
        all.and_then(|all| all.try_into().ok()).unwrap_or_else(|| {
            self.wrong_type(key, item, "three numbers, [x, y, z]");
            [0.0; 3]
        })
    }
}

fn targets(item: &Item) -> Option<Vec<TexelFormat>> {
    let format = |v: &Value| {
        let name = v.as_str()?;
        TexelFormat::ALL.into_iter().find(|f| f.name().eq_ignore_ascii_case(name))
    };
    let formats: Vec<TexelFormat> = item.as_array()?.iter().map(format).collect::<Option<_>>()?;
    (1..=MAX_TARGETS).contains(&formats.len()).then_some(formats)
}

/// Updates a pass's table with minimal changes.
pub(super) fn write_geometry(table: &mut dyn TableLike, of: &Pass) {
    let Some(geometry) = of.body.geometry() else {
        KEYS.iter().for_each(|key| drop(table.remove(key)));
        return;
    };
    let (own, formats) = (&of.source, of.formats());
    if table.get("targets").is_some() || formats.len() > 1 {
        if table.get("targets").and_then(targets).as_ref() != Some(&formats) {
            set(table, "targets", Some(formats.iter().map(|f| f.name()).collect()));
        }
        table.remove("format");
    }
    let read = |item: &Item| super::reader::silent(|reader| reader.entries(item));
    let entries: Vec<Entry> = geometry.draws.iter().map(|d| entry(d, own, geometry)).collect();
    let full =
        |e: &Entry| Entry { fragment: Some(e.fragment.clone().unwrap_or_else(|| own.name.clone())), ..e.clone() };
    let written = table.get("draw").and_then(read);
    let same = |w: &Vec<(Entry, _)>| w.iter().map(|(e, _)| full(e)).eq(entries.iter().map(full));
    if !written.as_ref().is_some_and(same) {
        let mut draws: Array = entries.iter().map(|e| Value::InlineTable(inline(e))).collect();
        for value in draws.iter_mut() {
            value.decor_mut().set_prefix("\n  ");
        }
        draws.set_trailing("\n");
        draws.set_trailing_comma(true);
        table.remove("draw");
        table.insert("draw", Item::Value(Value::Array(draws)));
    }
    write_camera(table, &geometry.camera);
}

fn entry(draw: &MeshDraw, own: &Source, geometry: &Geometry) -> Entry {
    let name = |stage: Stage| match stage {
        Stage::Own => None,
        Stage::File(n) => geometry.stages.get(n).map(|s| s.name.clone()),
    };
    Entry {
        mesh: draw.mesh.name(),
        vertex: name(draw.vertex).unwrap_or_else(|| own.name.clone()),
        fragment: name(draw.fragment),
        draw: MeshDraw { vertex: Stage::Own, fragment: Stage::Own, ..draw.clone() },
    }
}

fn inline(entry: &Entry) -> InlineTable {
    let mut table = InlineTable::new();
    let d = &entry.draw;
    table.insert("mesh", entry.mesh.as_str().into());
    table.insert("vertex", entry.vertex.as_str().into());
    if let Some(fragment) = &entry.fragment {
        table.insert("fragment", fragment.as_str().into());
    }
    if let Some(normals) = d.normals.filter(|_| !matches!(d.mesh, MeshSource::Builtin(_))) {
        table.insert("normals", normals.name().into());
    }
    if d.cull != Cull::default() {
        table.insert("cull", d.cull.name().into());
    }
    if d.depth != DepthTest::default() {
        table.insert("depth", d.depth.name().into());
    }
    for (key, on) in [("depth_write", d.depth_write), ("color_write", d.color_write)] {
        if !on {
            table.insert(key, false.into());
        }
    }
    if d.scale != 1.0 {
        table.insert("scale", d.scale.into());
    }
    for (key, vector) in [("rotation", d.rotation), ("position", d.position)] {
        if vector != [0.0; 3] {
            table.insert(key, Value::Array(vector.into_iter().collect()));
        }
    }
    table
}

fn write_camera(pass: &mut dyn TableLike, camera: &Camera) {
    let said = super::reader::silent(|reader| reader.camera(pass));
    if said.as_ref() == Some(camera) {
        return;
    }
    let d = Camera::default();
    let Some(table) = child(pass, "camera", false) else { return };
    for (key, value, default) in [
        ("yaw", camera.yaw, d.yaw),
        ("pitch", camera.pitch, d.pitch),
        ("distance", camera.distance, d.distance),
        ("fov", camera.fov, d.fov),
        ("near", camera.near, d.near),
        ("far", camera.far, d.far),
    ] {
        set(table, key, (value != default).then(|| value.into()));
    }
    if said.is_none_or(|s| s.target != camera.target) {
        set(table, "target", (camera.target != d.target).then(|| Value::Array(camera.target.into_iter().collect())));
    }
    set(table, "orbit", (camera.orbit != d.orbit).then(|| camera.orbit.into()));
}
