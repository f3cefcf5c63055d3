//! Malicious models: small files that would need much memory or time, and files that make a reader fail.

use super::*;
use crate::mesh::trouble::ModelError;
use eddy_project::confine::Reason;
use std::fs;

fn error(file: &str, bytes: impl AsRef<[u8]>) -> MeshError {
    let dir = tempfile::tempdir().unwrap();
    fs::write(dir.path().join(file), bytes).unwrap();
    load(&MeshSource::File(file.into()), None, Some(dir.path())).expect_err("a broken model")
}

#[track_caller]
fn says(error: &MeshError, file: &str, what: &str) {
    let text = error.to_string();
    assert!(text.contains(file) && text.contains(what), "{text}");
    assert!(text.len() < 1000 && !error.hint().is_empty(), "{text}");
}

/// Returns the text of a model with these nodes, of which node 0 is the scene's, and this accessor for positions.
fn model(nodes: &str, accessor: &str) -> String {
    // Three corners, and an index into them.
    let data = "AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAAAAAAAA==";
    format!(
        r#"{{"asset":{{"version":"2.0"}},"scene":0,"scenes":[{{"nodes":[0]}}],"nodes":[{nodes}],
        "meshes":[{{"primitives":[{{"attributes":{{"POSITION":0}}}}]}}],
        "accessors":[{accessor}],
        "bufferViews":[{{"buffer":0,"byteLength":36}},{{"buffer":0,"byteOffset":36,"byteLength":4}}],
        "buffers":[{{"byteLength":40,"uri":"data:;base64,{data}"}}]}}"#
    )
}

const TRIANGLE: &str = r#"{"bufferView":0,"componentType":5126,"count":3,"type":"VEC3","min":[0,0,0],"max":[1,1,0]}"#;
const NODE: &str = r#"{"mesh":0}"#;

fn sparse(count: u64) -> String {
    let lists = r#""indices":{"bufferView":1,"componentType":5121},"values":{"bufferView":0}"#;
    format!(
        r#"{{"componentType":5126,"count":{count},"type":"VEC3","min":[0,0,0],"max":[1,1,0],
        "sparse":{{"count":1,{lists}}}}}"#
    )
}

#[test]
fn the_size_of_a_model_is_checked_before_memory_is_allocated() {
    load_text(&model(NODE, TRIANGLE)).unwrap();
    load_text(&model(NODE, &sparse(9))).unwrap();
    let many = "it has more than 8388608 vertices";
    says(&error("m.gltf", model(NODE, &sparse(3_000_000_000))), "m.gltf is too large", many);
    says(&error("m.gltf", model(NODE, &sparse(u64::MAX))), "m.gltf is too large", many);
    // Below that limit, but for elements without bytes in the file.
    for count in [100_000, 1 << 20] {
        let without_data = "positions, indices and instances without data, the limit for a model";
        says(&error("m.gltf", model(NODE, &sparse(count))), "m.gltf is too large", without_data);
        let indices = format!(r#"{TRIANGLE},{{"componentType":5121,"count":{count},"type":"SCALAR"}}"#);
        let indexed = model(NODE, &indices).replace(r#""POSITION":0}"#, r#""POSITION":0},"indices":1"#);
        says(&error("m.gltf", indexed), "m.gltf is too large", without_data);
        let places = format!(r#"{TRIANGLE},{{"componentType":5126,"count":{count},"type":"VEC3"}}"#);
        let node = r#"{"mesh":0,"extensions":{"EXT_mesh_gpu_instancing":{"attributes":{"TRANSLATION":1}}}}"#;
        says(&error("m.gltf", model(node, &places)), "m.gltf is too large", without_data);
    }
    load_text(&model(NODE, &sparse(60_000))).unwrap();
    // A mesh is counted for each node that shows it.
    let placed = |count: usize| {
        let children: Vec<String> = (1..=count).map(|n| n.to_string()).collect();
        format!(r#"{{"children":[{}]}}{}"#, children.join(","), r#",{"mesh":0}"#.repeat(count))
    };
    let many = "positions, indices and instances without data";
    says(&error("m.gltf", model(&placed(9), &sparse(1 << 14))), "m.gltf is too large", many);
    let corners = "AAAA".repeat(1 << 20);
    let large = model(&placed(200), &TRIANGLE.replace(r#""count":3"#, r#""count":65536"#))
        .replace("AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAAAAAAAA==", &corners)
        .replace(r#""byteLength":36}"#, r#""byteLength":3000000}"#);
    says(&error("m.gltf", large), "m.gltf is too large", "it has more than 8388608 vertices");
    let objects = format!(r#"{{"asset":{{"version":"2.0"}},"nodes":[{{}}{}]}}"#, ",{}".repeat(2 << 20));
    says(&error("m.gltf", objects), "m.gltf is too large", "its JSON has 2097155 objects, but the limit is 1048576");
    // Bounds are skipped unread, however many there are.
    let bounds = TRIANGLE.replace("[0,0,0]", &format!("[0{}]", ",0".repeat(1 << 20)));
    load_text(&model(NODE, &bounds)).unwrap();
}

fn load_text(text: &str) -> Result<Mesh, MeshError> {
    let dir = tempfile::tempdir().unwrap();
    fs::write(dir.path().join("m.gltf"), text).unwrap();
    load(&MeshSource::File("m.gltf".into()), None, Some(dir.path()))
}

#[test]
fn nodes_that_do_not_form_a_tree_are_an_error() {
    // Each node is twice the child of the previous one: 2^40 places for the last.
    let twice = |n: usize| format!(r#"{{"children":[{},{}]}}"#, n + 1, n + 1);
    let nodes: Vec<String> = (0..40).map(twice).chain([NODE.into()]).collect();
    says(&error("m.gltf", model(&nodes.join(","), TRIANGLE)), "m.gltf is broken", "is twice a child of node 39");
    let diamond = r#"{"children":[1,2]},{"children":[3]},{"children":[3]},{"mesh":0}"#;
    let rule = "node 3 is a child of node 1 and of node 2; in glTF a node has at most one parent";
    says(&error("m.gltf", model(diamond, TRIANGLE)), "m.gltf is broken", rule);
    let circle = r#"{"children":[1]},{"children":[2]},{"children":[1]}"#;
    says(&error("m.gltf", model(circle, TRIANGLE)), "m.gltf is broken", "node 1 is a child of itself");
    // A tree that is deeper than the stack.
    let chain: Vec<String> = (1..200_000).map(|n| format!(r#"{{"children":[{n}]}}"#)).chain([NODE.into()]).collect();
    assert_eq!(load_text(&model(&chain.join(","), TRIANGLE)).unwrap().vertices.len(), 3);
}

#[test]
fn malformed_accessors_are_errors() {
    let gone = model(NODE, TRIANGLE).replace(r#""POSITION":0"#, r#""POSITION":77"#);
    says(&error("m.gltf", gone), "m.gltf is broken", "in accessor 77, but there are 1");
    let other = model(NODE, TRIANGLE).replace(r#""mesh":0"#, r#""mesh":5"#);
    says(&error("m.gltf", other), "m.gltf is broken", "node 0 uses mesh 5, but there are 1");
    for (from, to, what) in [
        ("VEC3", "VEC2", "accessor 0 has Vec2 of F32, which positions cannot have"),
        ("5126", "5123", "accessor 0 has Vec3 of U16, which positions cannot have"),
        (r#""count":3"#, r#""count":0"#, "accessor 0 has no elements"),
        (r#""count":3"#, r#""count":4"#, "accessor 0 reaches beyond its buffer"),
        (r#""bufferView":0"#, r#""bufferView":0,"byteOffset":18446744073709551615"#, "accessor 0 reaches beyond"),
    ] {
        let accessor = TRIANGLE.replace(from, to);
        assert_ne!(accessor, TRIANGLE);
        says(&error("m.gltf", model(NODE, &accessor)), "m.gltf is broken", what);
    }
    let narrow = model(NODE, TRIANGLE).replace(r#""byteLength":36"#, r#""byteLength":36,"byteStride":4"#);
    says(&error("m.gltf", narrow), "m.gltf is broken", "elements of 12 bytes with a stride of 4");
    let beyond = sparse(9).replace(r#""bufferView":1"#, r#""bufferView":0,"byteOffset":14"#);
    says(&error("m.gltf", model(NODE, &beyond)), "m.gltf is broken", "out of order or beyond its end");
    let more = sparse(9).replace(r#""sparse":{"count":1"#, r#""sparse":{"count":10"#);
    says(&error("m.gltf", model(NODE, &more)), "m.gltf is broken", "has 9 elements and replaces 10");
    let header = [b"glTF", &2u32.to_le_bytes()[..], &4u32.to_le_bytes(), b"xxxxxxxx"].concat();
    says(&error("m.glb", header), "m.glb is broken", "a length below that of the header");
}

#[test]
fn buffers_must_be_regular_files_of_the_project_with_the_declared_length() {
    let named = |uri: &str| {
        let text = model(NODE, TRIANGLE);
        let (from, to) = (text.find("data:").unwrap(), text.rfind('"').unwrap());
        error("m.gltf", format!("{}{uri}{}", &text[..from], &text[to..]))
    };
    for (uri, reason) in
        [("/dev/zero", Reason::Absolute), ("../a.bin", Reason::Above), ("a%2fb%00.bin", Reason::Characters)]
    {
        let error = named(uri);
        says(&error, "m.gltf refers to a file", "");
        assert!(
            matches!(&error, MeshError::Model { trouble: ModelError::Named(error), .. } if error.reason == reason),
            "{error}"
        );
    }
    says(&named("file:///etc/passwd"), "m.gltf is broken", "neither a file nor data");
    // Percent signs that decode to invalid Unicode: the crate's own reader panics.
    says(&named("%ff%fe"), "m.gltf refers to a file", "there is no such file");
    says(&named(&"x".repeat(5000)), "m.gltf is broken", "a file name of 5000 bytes");
    let short = "40 bytes by its byteLength, and its data: address 3";
    says(&named("data:;base64,AAAA"), "m.gltf is broken", short);
    says(&named("data:;base64,A"), "m.gltf is broken", "the data: address of buffer 0");
    let long = model(NODE, TRIANGLE).replace(r#""byteLength":40"#, r#""byteLength":18446744073709551615"#);
    says(&error("m.gltf", long), "m.gltf is broken", "bytes by its byteLength");
}

#[test]
fn long_quotes_of_a_parser_are_truncated() {
    let text = format!(r#"{{"asset":{{"version":"2.0"}},"nodes":"{}"}}"#, "x".repeat(1 << 20));
    says(&error("m.gltf", text), "m.gltf is broken", "…");
}

#[test]
fn the_size_and_the_numbers_of_an_obj_are_checked() {
    let points = "v 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nvn 0 0 1\n";
    for far in ["9223372036854775807", "-9223372036854775808", "6148914691236517206"] {
        for (corner, element) in
            [(far.to_owned(), "vertex"), (format!("1/{far}"), "texture coordinate"), (format!("1//{far}"), "normal")]
        {
            let what = format!("line 6: {corner} uses {element} {far}, but ");
            says(&error("m.obj", format!("{points}f {corner} 2 3\n")), "m.obj is broken", &what);
        }
    }
    let dots = "v 0 0 0\n".repeat((8 << 20) + 1);
    says(&error("m.obj", dots), "m.obj is too large", "it has more than 8388608 vertices");
    let infinite = format!("{points}v 1e39 0 0\nf 1 2 4\n");
    says(&error("m.obj", infinite), "m.obj is broken", "line 6: the position of a vertex is not a number (1e39)");
}

#[test]
fn tangents_of_many_corners_at_one_place_are_rejected() {
    // Each corner is compared with every other: 70,000 are five thousand million pairs.
    let points = "v 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nvt 1 0\nvt 0 1\n";
    let fan = format!("{points}{}", "f 1/1 2/2 3/3\n".repeat(70_000));
    says(&error("m.obj", fan), "m.obj is too large", "70000 corners of its triangles meet at one point");
}
