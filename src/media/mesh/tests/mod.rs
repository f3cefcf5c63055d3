//! Tests of meshes: built-in ones, model files, and the errors of broken ones.

mod bombs;
mod gltf;

use super::{Mesh, MeshError, NAMES, Vertex, load};
use base64::prelude::{BASE64_STANDARD, Engine as _};
use eddy_project::MeshSource;
use glam::Vec3;
use std::path::Path;

fn corners(mesh: &Mesh) -> impl Iterator<Item = [&Vertex; 3]> {
    mesh.indices.chunks_exact(3).map(|t| [0, 1, 2].map(|n| &mesh.vertices[t[n] as usize]))
}

/// Returns six times the enclosed volume, with the sign of the winding.
fn volume(mesh: &Mesh) -> f32 {
    corners(mesh).map(|t| t.map(|v| Vec3::from(v.position))).map(|[a, b, c]| a.dot(b.cross(c))).sum::<f32>() / 6.0
}

fn builtin(name: &str) -> Mesh {
    load(&MeshSource::Builtin(name.into()), None, None).unwrap()
}

#[test]
fn built_in_meshes_face_outward_and_have_all_attributes() {
    for name in NAMES {
        let mesh = builtin(name);
        for t in corners(&mesh) {
            let [a, b, c] = t.map(|v| Vec3::from(v.position));
            let face = (b - a).cross(c - a);
            for v in t {
                let normal = Vec3::from(v.normal);
                assert!((normal.length() - 1.0).abs() < 1e-4, "{name}: {v:?}");
                assert!(normal.dot(face) > 0.0, "{name}: {v:?} faces away from {face}");
                assert!(Vec3::from(v.position).length() <= 2.0, "{name}: {v:?}");
            }
        }
        if name != "plane" {
            assert!(volume(&mesh) > 0.0, "{name}");
        }
        if name != "icosphere" {
            let across = |v: &Vertex| Vec3::from_slice(&v.tangent).dot(Vec3::from(v.normal)).abs() < 0.1;
            assert!(mesh.vertices.iter().all(|v| across(v) && v.tangent[3].abs() == 1.0), "{name}");
        }
    }
    assert!((volume(&builtin("cube")) - 8.0).abs() < 1e-4);
    assert!((volume(&builtin("icosphere")) - 4.0 / 3.0 * std::f32::consts::PI).abs() < 0.03);
    assert_eq!(builtin("cube").vertices.len(), 24);
    // u increases along the tangent, v along the bitangent.
    for t in corners(&builtin("plane")) {
        for v in t {
            assert_eq!((v.normal, v.tangent), ([0.0, 1.0, 0.0], [1.0, 0.0, 0.0, 1.0]));
            assert_eq!(v.uv, [v.position[0] * 0.5 + 0.5, 0.5 - v.position[2] * 0.5]);
        }
    }
}

#[test]
fn attributes_of_an_obj_are_read_and_missing_ones_are_made() {
    let dir = tempfile::tempdir().unwrap();
    let path = dir.path().join("quad.obj");
    fs_write(&path, "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nvt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\nf 1/1 2/2 3/3 4/4\n");
    let mesh = load(&MeshSource::File("quad.obj".into()), None, Some(dir.path())).unwrap();
    assert_eq!((mesh.vertices.len(), mesh.indices.len()), (4, 6));
    for v in &mesh.vertices {
        assert_eq!((v.normal, v.tangent, v.color), ([0.0, 0.0, 1.0], [1.0, 0.0, 0.0, 1.0], [1.0; 4]));
        assert_eq!(v.uv, [v.position[0], v.position[1]]);
    }
}

fn fs_write(path: &Path, text: impl AsRef<[u8]>) {
    std::fs::write(path, text).unwrap();
}

/// A glTF of one triangle with an embedded buffer: the node is scaled by -2 along x, and moved.
fn triangle(count: usize, indices: [u8; 3], extra: &str) -> String {
    let mut bytes: Vec<u8> =
        [[0f32, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]].iter().flatten().flat_map(|x| x.to_le_bytes()).collect();
    bytes.extend([[0f32, 1.0], [1.0, 1.0], [0.0, 0.0]].iter().flatten().flat_map(|x| x.to_le_bytes()));
    bytes.extend(indices);
    let data = base64(&bytes);
    format!(
        r#"{{"asset":{{"version":"2.0"}},"scene":0,"scenes":[{{"nodes":[0]}}],
        "nodes":[{{"children":[1],"translation":[0,0,5]}},{{"mesh":0,"scale":[-2,1,1]{extra}}}],
        "meshes":[{{"primitives":[{{"attributes":{{"POSITION":0,"TEXCOORD_0":1}},"indices":2}}]}}],
        "accessors":[
          {{"bufferView":0,"componentType":5126,"count":{count},"type":"VEC3","min":[0,0,0],"max":[1,1,0]}},
          {{"bufferView":1,"componentType":5126,"count":3,"type":"VEC2"}},
          {{"bufferView":2,"componentType":5121,"count":3,"type":"SCALAR"}}],
        "bufferViews":[
          {{"buffer":0,"byteLength":36}},
          {{"buffer":0,"byteOffset":36,"byteLength":24}},
          {{"buffer":0,"byteOffset":60,"byteLength":3}}],
        "buffers":[{{"byteLength":63,"uri":"data:application/octet-stream;base64,{data}"}}]}}"#
    )
}

fn base64(bytes: &[u8]) -> String {
    BASE64_STANDARD.encode(bytes)
}

#[test]
fn a_gltf_has_its_nodes_transforms_applied() {
    let dir = tempfile::tempdir().unwrap();
    fs_write(&dir.path().join("t.gltf"), triangle(3, [0, 1, 2], ""));
    let mesh = load(&MeshSource::File("t.gltf".into()), None, Some(dir.path())).unwrap();
    let [a, b, c] = corners(&mesh).next().unwrap();
    // Mirrored, so that the order of corners is reversed to keep the front.
    assert_eq!([a.position, b.position, c.position], [[0.0, 0.0, 5.0], [0.0, 1.0, 5.0], [-2.0, 0.0, 5.0]]);
    assert_eq!(a.normal, [0.0, 0.0, 1.0]);
    assert_eq!([a.uv, b.uv, c.uv], [[0.0, 0.0], [0.0, 1.0], [1.0, 0.0]], "v is turned");
    assert_eq!(a.tangent, [-1.0, 0.0, 0.0, -1.0]);
}

#[test]
fn a_broken_file_is_one_error() {
    let dir = tempfile::tempdir().unwrap();
    let whole = triangle(3, [0, 1, 2], "");
    let cases: [(&str, Vec<u8>, &str); 13] = [
        ("cut.gltf", whole.as_bytes()[..200].to_vec(), "broken"),
        ("none.glb", b"glTF".to_vec(), "broken"),
        ("noise.glb", (0..=255).collect(), "broken"),
        ("far.gltf", triangle(9, [0, 1, 2], "").into(), "accessor 0 reaches beyond its buffer"),
        ("index.gltf", triangle(3, [0, 1, 7], "").into(), "uses vertex 7, but there are 3"),
        ("loop.gltf", triangle(3, [0, 1, 2], r#","children":[0]"#).into(), "is a child of itself"),
        ("gone.gltf", whole.replace("data:application/octet-stream;base64,", "x/").into(), "refers to a file: "),
        ("empty.gltf", r#"{"asset":{"version":"2.0"}}"#.into(), "no triangles"),
        ("empty.obj", Vec::new(), "no triangles"),
        ("word.obj", b"v 0 zero 0\n".to_vec(), "line 1: zero is not a number"),
        ("face.obj", b"v 0 0 0\nf 1 2 3\n".to_vec(), "line 2: 2 uses vertex 2, but the file has 1"),
        ("nan.obj", b"v 0 0 0\nv nan 0 0\nv 0 1 0\nf 1 2 3\n".to_vec(), "line 2: the position of a vertex is"),
        ("a.fbx", Vec::new(), "not a supported model"),
    ];
    for (name, bytes, says) in cases {
        fs_write(&dir.path().join(name), bytes);
        let error = load(&MeshSource::File(name.into()), None, Some(dir.path())).expect_err(name);
        let text = error.to_string();
        assert!(text.contains(name) && text.contains(says), "{text}");
        assert!(!error.hint().is_empty());
    }
    let error = load(&MeshSource::File("nowhere.glb".into()), None, Some(dir.path())).unwrap_err();
    assert!(error.to_string().starts_with("cannot read ") && error.to_string().contains("nowhere.glb"), "{error}");
    let error = load(&MeshSource::Builtin("spere".into()), None, None).unwrap_err();
    assert_eq!(
        (error.to_string(), error.hint()),
        ("unknown mesh builtin:spere".into(), "did you mean builtin:sphere?".into())
    );
}
