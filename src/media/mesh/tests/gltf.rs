//! Tests of the shapes in glTF files: skins, morph targets, quantised attributes, instances, extensions and containers.

use super::*;
use eddy_project::Normals;
use serde_json::{Value, json};
use std::fs;

const FLOAT: u32 = 5126;
const BYTE: u32 = 5120;
const SHORT: u32 = 5122;
const UNSIGNED_BYTE: u32 = 5121;
const UNSIGNED_SHORT: u32 = 5123;

/// The unit triangle in z = 0, its corners at the origin and on both axes.
const CORNERS: [[f32; 3]; 3] = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]];

/// A generated file: node 0 shows mesh 0, with one primitive.
struct Model {
    root: Value,
    bytes: Vec<u8>,
}

impl Model {
    fn new() -> Model {
        let root = json!({
            "asset": { "version": "2.0" },
            "scene": 0,
            "scenes": [{ "nodes": [0] }],
            "nodes": [{ "mesh": 0 }],
            "meshes": [{ "primitives": [{ "attributes": {} }] }],
            "accessors": [],
            "bufferViews": [],
            "buffers": [{ "byteLength": 0 }],
        });
        Model { root, bytes: Vec::new() }
    }

    fn triangle() -> Model {
        let mut model = Model::new();
        model.attribute("POSITION", FLOAT, "VEC3", &floats(CORNERS.as_flattened()));
        model
    }

    /// Adds a bufferView of these bytes.
    fn view(&mut self, bytes: &[u8]) -> usize {
        self.bytes.resize(self.bytes.len().next_multiple_of(4), 0);
        let views = self.root["bufferViews"].as_array_mut().unwrap();
        views.push(json!({ "buffer": 0, "byteOffset": self.bytes.len(), "byteLength": bytes.len() }));
        let index = views.len() - 1;
        self.bytes.extend(bytes);
        self.root["buffers"][0]["byteLength"] = self.bytes.len().into();
        index
    }

    fn accessor(&mut self, component: u32, dimensions: &str, count: usize, bytes: &[u8]) -> usize {
        let view = self.view(bytes);
        let accessors = self.root["accessors"].as_array_mut().unwrap();
        accessors.push(json!({ "bufferView": view, "componentType": component, "type": dimensions, "count": count }));
        accessors.len() - 1
    }

    /// Adds an attribute of the primitive, for three vertices.
    fn attribute(&mut self, name: &str, component: u32, dimensions: &str, bytes: &[u8]) -> usize {
        let index = self.accessor(component, dimensions, 3, bytes);
        self.root["meshes"][0]["primitives"][0]["attributes"][name] = index.into();
        index
    }

    fn set(mut self, pointer: &str, value: Value) -> Model {
        let (parent, key) = pointer.rsplit_once('/').unwrap();
        let parent = self.root.pointer_mut(parent).unwrap();
        match parent {
            Value::Array(list) => list[key.parse::<usize>().unwrap()] = value,
            _ => parent[key] = value,
        }
        self
    }

    /// Binds all vertices to joint 0 of a skin of node 1, which is moved by (5, 0, 0).
    fn skinned(mut self, joints: [u8; 12], weights: [f32; 12]) -> Model {
        self.attribute("JOINTS_0", UNSIGNED_BYTE, "VEC4", &joints);
        self.attribute("WEIGHTS_0", FLOAT, "VEC4", &floats(&weights));
        self.root["skins"] = json!([{ "joints": [1] }]);
        self.root["scenes"] = json!([{ "nodes": [0, 1] }]);
        self.root["nodes"] = json!([
            { "mesh": 0, "skin": 0, "translation": [0, 30, 0], "scale": [-1, 1, 1] },
            { "translation": [5, 0, 0] },
        ]);
        self
    }

    fn glb(&self) -> Vec<u8> {
        let mut text = serde_json::to_vec(&self.root).unwrap();
        text.resize(text.len().next_multiple_of(4), b' ');
        let mut binary = self.bytes.clone();
        binary.resize(binary.len().next_multiple_of(4), 0);
        let number = |n: usize| (n as u32).to_le_bytes();
        let parts: [&[u8]; 8] = [
            &number(28 + text.len() + binary.len()),
            &number(text.len()),
            b"JSON",
            &text,
            &number(binary.len()),
            b"BIN\0",
            &binary,
            b"",
        ];
        [b"glTF".to_vec(), number(2).to_vec(), parts.concat()].concat()
    }

    fn load(&self) -> Result<Mesh, MeshError> {
        open("m.glb", &self.glb(), None)
    }

    /// Returns the positions of the first triangle.
    #[track_caller]
    fn positions(&self) -> [[f32; 3]; 3] {
        let mesh = self.load().unwrap();
        corners(&mesh).next().unwrap().map(|v| v.position)
    }

    #[track_caller]
    fn refused(&self, words: &str) -> String {
        let error = self.load().expect_err(words);
        assert!(error.to_string().contains(words), "{error}");
        error.hint()
    }
}

fn floats(numbers: &[f32]) -> Vec<u8> {
    numbers.iter().flat_map(|x| x.to_le_bytes()).collect()
}

fn shorts(numbers: &[i16]) -> Vec<u8> {
    numbers.iter().flat_map(|x| x.to_le_bytes()).collect()
}

fn open(name: &str, bytes: &[u8], normals: Option<Normals>) -> Result<Mesh, MeshError> {
    let dir = tempfile::tempdir().unwrap();
    fs::write(dir.path().join(name), bytes).unwrap();
    load(&MeshSource::File(name.into()), normals, Some(dir.path()))
}

/// Weights of one for the first joint of each vertex.
const FIRST: [f32; 12] = [1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0];

fn moved(by: [f32; 3]) -> [[f32; 3]; 3] {
    CORNERS.map(|c| [0, 1, 2].map(|n| c[n] + by[n]))
}

#[test]
fn a_skinned_mesh_follows_its_joints() {
    let model = Model::triangle().skinned([0; 12], FIRST);
    assert_eq!(model.positions(), moved([5.0, 0.0, 0.0]), "without the transform of its own node");
    // The same mesh at a node without a skin is placed at that node, and mirrored.
    let plain =
        Model::triangle().skinned([0; 12], FIRST).set("/nodes/0", json!({ "mesh": 0, "translation": [0, 3, 0] }));
    assert_eq!(plain.positions(), moved([0.0, 3.0, 0.0]));
    // A primitive without joints is not bound to any.
    let unbound = Model::triangle().set("/skins", json!([{ "joints": [0] }]));
    let unbound = unbound.set("/nodes/0", json!({ "mesh": 0, "skin": 0, "translation": [0, 3, 0] }));
    assert_eq!(unbound.positions(), moved([0.0, 3.0, 0.0]));
    // Joints outside the scene, and a joint that is the child of another.
    let outside = Model::triangle().skinned([0; 12], FIRST).set("/scenes", json!([{ "nodes": [0] }]));
    assert_eq!(outside.positions(), moved([5.0, 0.0, 0.0]));
}

#[test]
fn inverse_bind_matrices_are_applied_before_the_joint() {
    let mut model = Model::triangle().skinned([0; 12], FIRST);
    // In column-major order: moved by (-1, 2, 0).
    let bind = [1.0, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0, -1.0, 2.0, 0.0, 1.0];
    let bind = model.accessor(FLOAT, "MAT4", 1, &floats(&bind));
    let model = model.set("/skins/0/inverseBindMatrices", bind.into());
    let model = model.set("/nodes/1", json!({ "scale": [2, 2, 2] }));
    assert_eq!(model.positions()[0], [-2.0, 4.0, 0.0]);
    model.set("/skins/0/joints", json!([1, 0])).refused("skin 0 has 2 joints and 1 inverseBindMatrices");
}

#[test]
fn weights_are_shares_of_their_sum_over_all_sets() {
    let half = FIRST.map(|w| w * 0.5);
    assert_eq!(Model::triangle().skinned([0; 12], half).positions(), moved([5.0, 0.0, 0.0]));
    assert_eq!(Model::triangle().skinned([0; 12], [0.0; 12]).positions(), moved([5.0, 0.0, 0.0]), "bound to nothing");
    // A second set, of bytes: the same weights for the origin as for joint 0.
    let mut model = Model::triangle().skinned([0; 12], FIRST);
    model.attribute("JOINTS_1", UNSIGNED_SHORT, "VEC4", &shorts(&[1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0]));
    model.attribute("WEIGHTS_1", UNSIGNED_BYTE, "VEC4", &[255, 0, 0, 0].repeat(3));
    model.root["nodes"].as_array_mut().unwrap().push(json!({}));
    let model = model.set("/skins/0/joints", json!([1, 2]));
    assert_eq!(model.positions(), moved([2.5, 0.0, 0.0]));
    let hint = Model::triangle().skinned([7; 12], FIRST).refused("vertex 0 is bound to joint 7 of skin 0, which has 1");
    assert!(!hint.is_empty());
    // A joint without weight may have any index.
    let joints = [0, 9, 9, 9].repeat(3).try_into().unwrap();
    assert_eq!(Model::triangle().skinned(joints, FIRST).positions(), moved([5.0, 0.0, 0.0]));
}

#[test]
fn joints_rotate_normals_and_mirroring_keeps_the_winding() {
    let mut model = Model::triangle().skinned([0; 12], FIRST);
    model.attribute("NORMAL", FLOAT, "VEC3", &floats(&[0.0, 0.0, 1.0].repeat(3)));
    let half = std::f64::consts::FRAC_1_SQRT_2;
    let turned = model.set("/nodes/1", json!({ "rotation": [0, half, 0, half] }));
    let mesh = turned.load().unwrap();
    assert!((Vec3::from(mesh.vertices[0].normal) - Vec3::X).length() < 1e-6, "{:?}", mesh.vertices[0]);
    let mirrored = turned.set("/nodes/1", json!({ "scale": [-1, 1, 1] }));
    let mesh = mirrored.load().unwrap();
    let [a, b, c] = corners(&mesh).next().unwrap().map(|v| Vec3::from(v.position));
    assert!((b - a).cross(c - a).z > 0.0, "the front stays in front");
    assert_eq!(mesh.vertices[0].normal, [0.0, 0.0, 1.0]);
}

/// A triangle whose morph targets move it by (0, 0, 2) and, sparsely, its last corner by (0, 4, 0).
fn morphed() -> Model {
    let mut model = Model::triangle();
    let all = model.accessor(FLOAT, "VEC3", 3, &floats(&[0.0, 0.0, 2.0].repeat(3)));
    let (places, values) = (model.view(&[2]), model.view(&floats(&[0.0, 4.0, 0.0])));
    let one = json!({
        "componentType": FLOAT, "type": "VEC3", "count": 3,
        "sparse": {
            "count": 1,
            "indices": { "bufferView": places, "componentType": UNSIGNED_BYTE },
            "values": { "bufferView": values },
        },
    });
    model.root["accessors"].as_array_mut().unwrap().push(one);
    model.set("/meshes/0/primitives/0/targets", json!([{ "POSITION": all }, { "POSITION": all + 1 }]))
}

#[test]
fn morph_targets_have_the_weights_of_the_mesh_or_of_its_node() {
    assert_eq!(morphed().positions(), CORNERS);
    let mesh = morphed().set("/meshes/0/weights", json!([0.5, 1]));
    assert_eq!(mesh.positions(), [[0.0, 0.0, 1.0], [1.0, 0.0, 1.0], [0.0, 5.0, 1.0]]);
    let node = mesh.set("/nodes/0/weights", json!([0, 0.5]));
    assert_eq!(node.positions(), [CORNERS[0], CORNERS[1], [0.0, 3.0, 0.0]]);
    // Applied before the joints move it.
    let both = node.skinned([0; 12], FIRST).set("/meshes/0/weights", json!([0, 1]));
    assert_eq!(both.positions()[2], [5.0, 5.0, 0.0]);
    // The vertices of each target are counted.
    let weights = vec![1; 300];
    let targets = vec![json!({ "POSITION": 3 }); 300];
    let mut many = morphed().set("/meshes/0/weights", json!(weights));
    many = many.set("/meshes/0/primitives/0/targets", json!(targets));
    let zeros = json!({ "componentType": FLOAT, "type": "VEC3", "count": 1 << 20 });
    many.root["accessors"] = json!([zeros, zeros, zeros, zeros]);
    many.refused("it has more than 268435456 vertices of morph targets and sets of joints");
}

#[test]
fn missing_normals_are_flat_unless_smooth_ones_are_requested() {
    // Two triangles at a right angle at the edge from the origin along x.
    let mut model = Model::new();
    let places = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
    let positions = model.accessor(FLOAT, "VEC3", 4, &floats(places.as_flattened()));
    let indices = model.accessor(UNSIGNED_BYTE, "SCALAR", 6, &[0, 1, 2, 1, 0, 3]);
    // Tangents without normals are ignored.
    let tangents = model.accessor(FLOAT, "VEC4", 4, &floats(&[9.0; 16]));
    let attributes = json!({ "POSITION": positions, "TANGENT": tangents });
    let model = model.set("/meshes/0/primitives/0", json!({ "attributes": attributes, "indices": indices }));
    for normals in [None, Some(Normals::Flat)] {
        let mesh = open("m.glb", &model.glb(), normals).unwrap();
        assert_eq!(mesh.vertices.len(), 6);
        for (t, normal) in corners(&mesh).zip([[0.0, 0.0, 1.0], [0.0, 1.0, 0.0]]) {
            assert!(t.iter().all(|v| v.normal == normal && v.tangent == [0.0; 4]), "{t:?}");
        }
    }
    let mesh = open("m.glb", &model.glb(), Some(Normals::Smooth)).unwrap();
    assert_eq!(mesh.vertices.len(), 4);
    let both = Vec3::new(0.0, 1.0, 1.0).normalize();
    assert!((Vec3::from(mesh.vertices[0].normal) - both).length() < 1e-6);
    // An OBJ file is smooth unless flat normals are requested.
    let obj = b"v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 2 3\nf 2 1 4\n";
    assert_eq!(open("m.obj", obj, None).unwrap().vertices.len(), 4);
    assert_eq!(open("m.obj", obj, Some(Normals::Flat)).unwrap().vertices.len(), 6);
}

#[test]
fn quantised_attributes_are_read_with_their_texture_transform() {
    let mut model = Model::new();
    model.attribute("POSITION", SHORT, "VEC3", &shorts(&[0, 0, 0, 0, 32767, 0, 0, 0, -32767, -32768, 0, 0]));
    let view = model.root["bufferViews"].as_array().unwrap().len() - 1;
    model.root["bufferViews"][view]["byteStride"] = 8.into();
    model.root["accessors"][0]["normalized"] = true.into();
    let normals = model.attribute("NORMAL", BYTE, "VEC3", &[0, 0, 127, 0].repeat(3));
    model.root["bufferViews"][normals]["byteStride"] = 4.into();
    model.attribute("TEXCOORD_0", UNSIGNED_SHORT, "VEC2", &shorts(&[0, 0, 100, 0, 0, 50]));
    let texture = json!({ "index": 0, "extensions": { "KHR_texture_transform": { "scale": [0.01, 0.02] } } });
    let mut model = model.set("/materials", json!([{ "pbrMetallicRoughness": { "baseColorTexture": texture } }]));
    model = model.set("/meshes/0/primitives/0/material", json!(0));
    model.refused("accessor 0 has Vec3 of I16, which positions cannot have without KHR_mesh_quantization");
    let names = json!(["KHR_mesh_quantization"]);
    let model = model.set("/extensionsUsed", names.clone()).set("/extensionsRequired", names);
    assert_eq!(model.positions(), [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [-1.0, -1.0, 0.0]]);
    let mesh = model.load().unwrap();
    assert_eq!(corners(&mesh).next().unwrap().map(|v| v.uv), [[0.0, 1.0], [1.0, 1.0], [0.0, 0.0]]);
    assert!(mesh.vertices.iter().all(|v| v.normal == [0.0, 0.0, 1.0]));
    let plain = model.set("/accessors/0/normalized", json!(false)).set("/nodes/0/scale", json!([0.5, 0.5, 0.5]));
    assert_eq!(plain.positions()[1], [16383.5, 0.0, 0.0]);
}

#[test]
fn required_extensions_that_do_not_affect_the_shape_are_accepted() {
    for name in [
        "KHR_materials_unlit",
        "KHR_materials_pbrSpecularGlossiness",
        "KHR_texture_transform",
        "KHR_texture_basisu",
        "EXT_texture_webp",
        "KHR_lights_punctual",
        "KHR_animation_pointer",
        "KHR_xmp_json_ld",
        "MSFT_lod",
        "EXT_mesh_primitive_restart",
    ] {
        assert_eq!(Model::triangle().set("/extensionsRequired", json!([name])).positions(), CORNERS, "{name}");
    }
    let unknown = Model::triangle().set("/extensionsRequired", json!(["KHR_materials_ior", "ACME_bend", "ACME_blow"]));
    let hint = unknown.refused("m.glb needs ACME_bend and ACME_blow, which Eddy cannot read");
    assert_eq!(hint, "re-export the model without them");
}

#[test]
fn compressed_meshes_are_rejected_but_their_plain_fallbacks_are_read() {
    let draco = json!({ "KHR_draco_mesh_compression": { "bufferView": 0, "attributes": {} } });
    let beside = Model::triangle().set("/meshes/0/primitives/0/extensions", draco);
    assert_eq!(beside.positions(), CORNERS, "a fallback");
    let mut alone = beside;
    alone.root["accessors"][0].as_object_mut().unwrap().remove("bufferView");
    let hint = alone.refused("needs KHR_draco_mesh_compression, which Eddy cannot read: its mesh is Draco compressed");
    assert!(hint.contains("gltf-transform copy"), "{hint}");
    for name in ["EXT_meshopt_compression", "KHR_meshopt_compression"] {
        let compressed =
            json!({ name: { "buffer": 0, "byteLength": 36, "byteStride": 12, "mode": "ATTRIBUTES", "count": 3 } });
        let beside = Model::triangle().set("/bufferViews/0/extensions", compressed);
        assert_eq!(beside.positions(), CORNERS, "a fallback");
        let mut alone = beside.set("/bufferViews/0/buffer", json!(1));
        alone.root["buffers"].as_array_mut().unwrap().push(json!({ "byteLength": 36 }));
        alone.refused(&format!("needs {name}, which Eddy cannot read: its mesh is meshopt compressed"));
    }
}

#[test]
fn errors_name_unsupported_versions() {
    let old = br#"{"asset":{"version":"1.0"},"nodes":{"n":{}},"meshes":{}}"#;
    for (text, version) in [
        (&old[..], "1.0"),
        (br#"{"nodes":{"n":{}},"meshes":{}}"#, "1.0"),
        (br#"{"asset":{"version":0.8},"nodes":{}}"#, "0.8"),
        (b"glTF\x01\0\0\0\x14\0\0\0\0\0\0\0\0\0\0\0", "1.0"),
        (br#"{"asset":{"version":"3.0"}}"#, "3.0"),
        (br#"{"asset":{"version":"2.1","minVersion":"2.1"}}"#, "2.1"),
    ] {
        let error = open("m.gltf", text, None).unwrap_err();
        assert!(error.to_string().ends_with(&format!("m.gltf: this is glTF {version}; Eddy reads 2.0")), "{error}");
        assert!(error.hint().contains("glTF 2.0"), "{}", error.hint());
    }
    let none = open("m.gltf", br#"{"nodes":[]}"#, None).unwrap_err();
    assert!(none.to_string().contains("it has no asset.version"), "{none}");
    assert_eq!(Model::triangle().set("/asset/version", json!("2.1")).positions(), CORNERS);
}

#[test]
fn the_container_is_recognised_by_content() {
    let mut model = Model::triangle();
    let glb = model.glb();
    assert_eq!(open("m.gltf", &glb, None).unwrap().vertices.len(), 3);
    // A data: URI with percent signs, and one of base64 without padding.
    let escaped: String = model.bytes.iter().map(|b| format!("%{b:02x}")).collect();
    for uri in [
        format!("data:application/octet-stream,{escaped}"),
        format!("DATA:application/gltf-buffer;base64,{}", base64(&model.bytes)),
        format!("data:;base64,{}", base64(&model.bytes)),
    ] {
        model.root["buffers"][0]["uri"] = uri.into();
        let text = serde_json::to_vec_pretty(&model.root).unwrap();
        for text in [text.clone(), [b"\xef\xbb\xbf", &text[..]].concat()] {
            assert_eq!(open("m.glb", &text, None).unwrap().vertices.len(), 3);
        }
    }
    model.root["buffers"][0]["uri"] = "a%20b%C3%A9.bin".into();
    let dir = tempfile::tempdir().unwrap();
    fs::write(dir.path().join("m.gltf"), model.root.to_string()).unwrap();
    let read = || load(&MeshSource::File("m.gltf".into()), None, Some(dir.path()));
    assert!(read().unwrap_err().to_string().contains("a bé.bin: there is no such file"));
    fs::write(dir.path().join("a bé.bin"), &model.bytes[..30]).unwrap();
    assert!(read().unwrap_err().to_string().contains("its file a bé.bin 30"));
    fs::write(dir.path().join("a bé.bin"), &model.bytes).unwrap();
    assert_eq!(read().unwrap().vertices.len(), 3);
    for (bytes, words) in [
        (&glb[..40], "the file has 40"),
        (b"", "it is empty"),
        (b"\xff\xfe{\0", "UTF-16"),
        (b"{\n  \"asset\": oops }", "line 2 column 12"),
    ] {
        let error = open("m.gltf", bytes, None).unwrap_err();
        assert!(error.to_string().contains(words), "{error}");
    }
}

#[test]
fn files_without_triangles_list_their_contents() {
    let mode = |mode: u32| Model::triangle().set("/meshes/0/primitives/0/mode", json!(mode));
    for (n, what) in [(0, "points"), (1, "lines"), (2, "lines"), (3, "lines")] {
        mode(n).refused(&format!("m.glb has no triangles, only {what}"));
    }
    mode(7).refused("its mode is 7");
    let bare = Model::triangle().set("/meshes/0/primitives/0/attributes", json!({ "_HEAT": 0 }));
    bare.refused("has no triangles: its meshes have no positions");
    Model::triangle().set("/scenes/0", json!({})).refused("its meshes are in no node of its scene that is visible");
    // Attributes of applications are ignored.
    assert_eq!(Model::triangle().set("/meshes/0/primitives/0/attributes/_HEAT", json!(0)).positions(), CORNERS);
    // Leftover corners form no triangle.
    let mut more = Model::triangle();
    let indices = more.accessor(UNSIGNED_BYTE, "SCALAR", 5, &[0, 1, 2, 0, 1]);
    assert_eq!(more.set("/meshes/0/primitives/0/indices", indices.into()).load().unwrap().indices.len(), 3);
    let mut restarts = Model::triangle();
    let indices = restarts.accessor(UNSIGNED_BYTE, "SCALAR", 4, &[0, 1, 2, 255]);
    restarts.set("/meshes/0/primitives/0/indices", indices.into()).refused("use primitive restart at 255");
}

#[test]
fn nodes_determine_visibility_count_and_place() {
    // A library of meshes is drawn without transforms.
    let mut library = Model::triangle();
    for key in ["nodes", "scenes", "scene"] {
        library.root.as_object_mut().unwrap().remove(key);
    }
    assert_eq!(library.positions(), CORNERS);
    // Hidden nodes hide their descendants.
    let hidden = json!({ "children": [1], "extensions": { "KHR_node_visibility": { "visible": false } } });
    let model = Model::triangle().set("/nodes", json!([hidden, { "mesh": 0 }]));
    model.refused("in no node of its scene that is visible");
    let shown = json!({ "children": [1], "extensions": { "KHR_node_visibility": {} } });
    assert_eq!(Model::triangle().set("/nodes", json!([shown, { "mesh": 0 }])).positions(), CORNERS);
    let mut many = Model::triangle();
    let places = many.accessor(FLOAT, "VEC3", 2, &floats(&[0.0, 0.0, 1.0, 2.0, 0.0, 0.0]));
    let instancing = json!({ "EXT_mesh_gpu_instancing": { "attributes": { "TRANSLATION": places } } });
    let mut many = many.set("/nodes/0", json!({ "mesh": 0, "scale": [2, 2, 2], "extensions": instancing }));
    let firsts: Vec<[f32; 3]> = corners(&many.load().unwrap()).map(|[a, ..]| a.position).collect();
    assert_eq!(firsts, [[0.0, 0.0, 2.0], [4.0, 0.0, 0.0]]);
    // Counted before memory is allocated.
    many.root["accessors"][places].as_object_mut().unwrap().remove("bufferView");
    many.set(&format!("/accessors/{places}/count"), json!(u64::MAX)).refused("it has more than");
    // A matrix, a scale that flattens, an integer that is written as a float.
    let matrix = [2, 0, 0, 0, 0, 1, 0, 0, 0, 0, 0, 0, 1, 2, 3, 1];
    let mut flat = Model::triangle().set("/nodes/0/matrix", json!(matrix)).set("/nodes/0/mesh", json!(0.0));
    flat.attribute("NORMAL", FLOAT, "VEC3", &floats(&[0.6, 0.0, 0.8].repeat(3)));
    assert_eq!(flat.positions(), [[1.0, 2.0, 3.0], [3.0, 2.0, 3.0], [1.0, 3.0, 3.0]]);
    assert_eq!(flat.load().unwrap().vertices[0].normal, [0.0, 0.0, 1.0]);
}
