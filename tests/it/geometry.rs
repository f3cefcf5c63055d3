//! Passes that draw meshes, tested by pictures: positions of vertices, depth, and the contents of each target.

use crate::support::{meshes::*, *};
use eddy::{
    engine::{BuildError, BuildOptions, Engine, FrameInputs, Program},
    media::MediaSet,
    project::{Camera, Cull, DepthTest, MeshDraw, Project, Stage, TexelFormat},
};
use glam::{Mat4, Vec3, Vec4};

const VERTEX: &str = "#version 300 es
in vec3 aPosition;
in vec3 aNormal;
in vec2 aUv;
out vec3 vWorld;
out vec3 vNormal;
out vec2 vUv;
void main() {
    vec4 world = iModel * vec4(aPosition, 1.0);
    vWorld = world.xyz;
    vNormal = iNormalMatrix * aNormal;
    vUv = aUv;
    gl_Position = iProjection * iView * world;
}";

/// World position, normal, texture coordinates, and GL's coordinates of the fragment, in one target each.
const FRAGMENT: &str = "#version 300 es
precision highp float;
in vec3 vWorld;
in vec3 vNormal;
in vec2 vUv;
layout(location = 0) out vec4 world;
layout(location = 1) out vec4 normal;
layout(location = 2) out vec2 uv;
layout(location = 3) out vec4 fragment;
void main() {
    world = vec4(vWorld, 1.0);
    normal = vec4(normalize(vNormal), gl_FrontFacing ? 1.0 : -1.0);
    uv = vUv;
    fragment = vec4(gl_FragCoord.xyz, dFdy(gl_FragCoord.y));
}";

/// Returns the camera's view and projection matrix, computed with glam independently of the engine.
fn to_clip(camera: &Camera, aspect: f32) -> Mat4 {
    let (yaw, pitch) = (camera.yaw.to_radians(), camera.pitch.to_radians());
    let direction = Vec3::new((pitch.cos() * yaw.sin()) as f32, pitch.sin() as f32, (pitch.cos() * yaw.cos()) as f32);
    let target = Vec3::from(camera.target.map(|x| x as f32));
    let eye = target + direction * camera.distance as f32;
    let view = glam::camera::rh::view::look_at_mat4(eye, target, Vec3::Y);
    let fov = (camera.fov as f32).to_radians();
    glam::camera::rh::proj::opengl::perspective(fov, aspect, camera.near as f32, camera.far as f32) * view
}

#[test]
fn every_fragment_of_a_cube_is_at_its_projected_position() {
    let Some(gpu) = gpu() else { return };
    let size = (96, 64);
    let mut cube = draw("builtin:cube");
    (cube.scale, cube.rotation, cube.position) = (0.8, [10.0, 20.0, 30.0], [0.4, 0.2, -0.3]);
    let project = whole(scene(FRAGMENT, &[VERTEX], 4, camera(), vec![cube]));
    let mut engine = ran(&gpu, &project, size, 1);
    let [world, normal, uv, fragment] = [0, 1, 2, 3].map(|i| engine.read_target(&buffer("scene"), i).unwrap());
    let clip = to_clip(&camera(), size.0 as f32 / size.1 as f32);
    let mut covered = 0;
    for y in 0..size.1 {
        for x in 0..size.0 {
            let at = texel(&world, x, y);
            if at[3] == 0.0 {
                assert_eq!(texel(&fragment, x, y), [0.0; 4], "uncovered texels are clear");
                continue;
            }
            covered += 1;
            let p = clip * Vec4::new(at[0], at[1], at[2], 1.0);
            let window = (p.truncate() / p.w) * 0.5 + 0.5;
            let projected = [window.x * size.0 as f32, window.y * size.1 as f32];
            assert!((projected[0] - (x as f32 + 0.5)).abs() < 0.02, "{projected:?} is drawn at {x},{y}");
            assert!((projected[1] - (y as f32 + 0.5)).abs() < 0.02, "{projected:?} is drawn at {x},{y}");
            let coordinates = texel(&fragment, x, y);
            assert_eq!(coordinates[..2], [x as f32 + 0.5, y as f32 + 0.5]);
            assert!(
                (coordinates[2] - window.z).abs() < 1e-4,
                "depth {} at {x},{y}, expected {}",
                coordinates[2],
                window.z
            );
            assert_eq!(coordinates[3], 1.0, "y grows upward");
            let n = texel(&normal, x, y);
            assert_eq!(n[3], 1.0, "only front faces are visible");
            let [u, v, b, a] = texel(&uv, x, y);
            assert!((-0.01..=1.01).contains(&u) && (-0.01..=1.01).contains(&v) && (b, a) == (0.0, 1.0));
        }
    }
    // The number of covered pixels is about the area of the convex hull of the projected corners.
    assert!((600..3000).contains(&covered), "{covered}");
    // On the outside, each normal points to the camera.
    let eye = to_clip(&camera(), 1.5).inverse() * Vec4::new(0.0, 0.0, -1.0, 1.0);
    let eye = eye.truncate() / eye.w;
    for (w, n) in world.texels.iter().zip(&normal.texels).filter(|(w, _)| w[3] > 0.0) {
        let to_eye = eye - Vec3::from_slice(w);
        assert!(to_eye.dot(Vec3::from_slice(n)) > -1e-3, "{w:?} {n:?}");
    }
}

const FLAT_VERTEX: &str = "in vec3 aPosition; in vec4 aColor; out vec4 vColor;
void main() { vColor = aColor; gl_Position = iProjection * iView * iModel * vec4(aPosition, 1.0); }";

fn one_colour(rgb: &str) -> String {
    format!("in vec4 vColor; out vec4 colour; void main() {{ colour = vec4({rgb}, 1.0) * vColor; }}")
}

/// Returns the middle texel of a picture of `draws`, whose fragment stages are a red one and a green one.
fn middle(gpu: &eddy::gpu::Gpu, draws: Vec<MeshDraw>) -> [f32; 3] {
    let (red, green) = (one_colour("1.0, 0.0, 0.0"), one_colour("0.0, 1.0, 0.0"));
    let project = whole(scene(&red, &[FLAT_VERTEX, &green], 1, straight(), draws));
    let mut engine = ran(gpu, &project, (9, 9), 1);
    let [r, g, b, _] = texel(&engine.read_image().unwrap(), 4, 4);
    [r, g, b]
}

const RED: [f32; 3] = [1.0, 0.0, 0.0];
const GREEN: [f32; 3] = [0.0, 1.0, 0.0];
const NOTHING: [f32; 3] = [0.0; 3];

#[test]
fn nearer_meshes_hide_farther_ones_in_either_order() {
    let Some(gpu) = gpu() else { return };
    let near = MeshDraw { position: [0.0, 0.0, 1.0], scale: 0.5, ..draw("builtin:sphere") };
    let far = MeshDraw { fragment: Stage::File(1), ..draw("builtin:sphere") };
    let with = |d: &MeshDraw, depth, depth_write| MeshDraw { depth, depth_write, ..d.clone() };
    assert_eq!(middle(&gpu, vec![near.clone(), far.clone()]), RED);
    assert_eq!(middle(&gpu, vec![far.clone(), near.clone()]), RED);
    assert_eq!(middle(&gpu, vec![near.clone(), with(&far, DepthTest::Always, true)]), GREEN);
    assert_eq!(middle(&gpu, vec![with(&near, DepthTest::Less, false), far.clone()]), GREEN, "it wrote no depth");
    assert_eq!(middle(&gpu, vec![far.clone(), with(&near, DepthTest::Greater, true)]), GREEN);
    // Depth only, then colour where the depth is equal, as in a depth prepass.
    let only_depth = MeshDraw { color_write: false, ..near.clone() };
    assert_eq!(middle(&gpu, vec![only_depth.clone(), far.clone()]), NOTHING);
    assert_eq!(middle(&gpu, vec![only_depth, far, with(&near, DepthTest::Equal, false)]), RED);
}

#[test]
fn culling_skips_the_given_side() {
    let Some(gpu) = gpu() else { return };
    let with = |cull, z| MeshDraw { cull, position: [0.0, 0.0, z], ..draw("builtin:sphere") };
    // Seen from outside, then from inside.
    for (cull, expected) in [(Cull::Back, [RED, NOTHING]), (Cull::Front, [RED, RED]), (Cull::None, [RED, RED])] {
        assert_eq!(middle(&gpu, vec![with(cull, 0.0)]), expected[0], "{cull:?}");
        assert_eq!(middle(&gpu, vec![with(cull, 5.0)]), expected[1], "{cull:?} from inside");
    }
    // A plane faces up: turned by -90 degrees, its back faces the camera.
    let plane = |cull, degrees| MeshDraw { cull, rotation: [degrees, 0.0, 0.0], ..draw("builtin:plane") };
    assert_eq!(middle(&gpu, vec![plane(Cull::Back, 90.0)]), RED);
    assert_eq!(middle(&gpu, vec![plane(Cull::Front, 90.0)]), NOTHING);
    assert_eq!(middle(&gpu, vec![plane(Cull::Back, -90.0)]), NOTHING);
    assert_eq!(middle(&gpu, vec![plane(Cull::Front, -90.0)]), RED);
}

#[test]
fn a_hull_with_another_program_and_culling_outlines_the_mesh() {
    let Some(gpu) = gpu() else { return };
    let hull = "in vec3 aPosition; in vec3 aNormal; in vec4 aColor; out vec4 vColor;
        void main() { vColor = aColor; gl_Position = iProjection * iView * vec4(aPosition + 0.1 * aNormal, 1.0); }";
    let (red, green) = (one_colour("1.0, 0.0, 0.0"), one_colour("0.0, 1.0, 0.0"));
    let body = draw("builtin:sphere");
    let outline = MeshDraw { vertex: Stage::File(2), fragment: Stage::File(1), cull: Cull::Front, ..body.clone() };
    let project = whole(scene(&red, &[FLAT_VERTEX, &green, hull], 1, straight(), vec![body, outline]));
    let mut engine = ran(&gpu, &project, (65, 65), 1);
    let pixels = engine.read_image().unwrap();
    let row: Vec<[f32; 4]> = (0..65).map(|x| texel(&pixels, x, 32)).collect();
    let colours: Vec<char> = row
        .iter()
        .map(|c| {
            if c[0] > 0.0 {
                'r'
            } else if c[1] > 0.0 {
                'g'
            } else {
                '.'
            }
        })
        .collect();
    let text: String = colours.iter().collect();
    let bare = text.trim_matches('.');
    assert!(text.starts_with('.') && text.ends_with('.'), "{text}");
    let inner = bare.trim_matches('g');
    assert!(!inner.is_empty() && inner.chars().all(|c| c == 'r'), "{text}");
    let outline = bare.len() - inner.len();
    assert!((2..=8).contains(&outline), "{text}");
}

#[test]
fn a_stage_reads_channels_uniforms_custom_uniforms_and_tables() {
    let Some(gpu) = gpu() else { return };
    let vertex = "#iUniform float lift = 0.25
        in vec3 aPosition;
        const float TABLE[5] = float[5](1.0, 2.0, 3.0, 4.0, 5.0);
        flat out int number; out mat3 m; out float weights[2];
        void main() {
            vec4 seen = texture(iChannel0, vec2(0.5));
            number = gl_VertexID - gl_VertexID + int(seen.x) + gl_InstanceID;
            m = mat3(1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 7.0, 8.0, lift);
            weights[0] = TABLE[(iFrame + 1) % 5]; weights[1] = iResolution.x;
            gl_Position = vec4(aPosition.xy, 0.0, 1.0);
        }";
    let fragment = "#iUniform float lift
        flat in int number; in mat3 m; in float weights[2];
        out vec4 o;
        vec3 kernel[3] = vec3[3](vec3(1.0), vec3(10.0), vec3(100.0));
        void main() {
            vec3 sum = vec3(0.0);
            for (int i = 0; i < 3; i++) sum += kernel[i];
            o = vec4(float(number), m[2].z * 4.0 + m[1].y, weights[0] + weights[1] * 100.0, sum.x + lift);
        }";
    let a = pass(buffer("A"), "void mainImage(out vec4 o, in vec2 p) { o = vec4(7.0); }", Default::default());
    let mut scene = scene(fragment, &[vertex], 1, straight(), vec![draw("builtin:cube")]);
    scene.bindings.set(0, nearest("A"));
    let project = project(vec![a, scene, image(SUM, [target(0), None, None, None])]);
    let mut engine = ran(&gpu, &project, (4, 4), 1);
    assert_eq!(texel(&engine.read_target(&buffer("scene"), 0).unwrap(), 1, 2), [7.0, 6.0, 402.0, 111.25]);
}

#[test]
fn fragments_can_set_depth_and_be_discarded() {
    let Some(gpu) = gpu() else { return };
    let deep = "in vec4 vColor; out vec4 o; void main() { if (gl_FragCoord.x > 5.0) discard; gl_FragDepth = 0.0; o = \
                vColor; }";
    let green = one_colour("0.0, 1.0, 0.0");
    let far = MeshDraw { position: [0.0, 0.0, -1.0], ..draw("builtin:cube") };
    let near = MeshDraw { fragment: Stage::File(1), ..draw("builtin:cube") };
    let project = whole(scene(deep, &[FLAT_VERTEX, &green], 1, straight(), vec![far, near]));
    let mut engine = ran(&gpu, &project, (9, 9), 2);
    let pixels = engine.read_image().unwrap();
    assert_eq!(texel(&pixels, 4, 4)[..3], [1.0; 3], "depth 0 is in front of everything");
    assert_eq!(texel(&pixels, 5, 4)[..3], GREEN);
}

#[test]
fn a_scene_is_drawn_again_only_when_its_inputs_change() {
    let Some(gpu) = gpu() else { return };
    let red = one_colour("1.0, 0.0, 0.0");
    let project = whole(scene(&red, &[FLAT_VERTEX], 1, straight(), vec![draw("builtin:cube")]));
    let build = |skip| {
        engine_with(
            &gpu,
            &project,
            &MediaSet::new(),
            &BuildOptions { requested: Vec::new(), skip, ..BuildOptions::default() },
            (32, 24),
        )
    };
    let (mut lean, mut full): (Engine, Engine) = (build(true), build(false));
    let drags = [[0.0; 2], [0.0; 2], [9.0, -3.0], [9.0, -3.0]];
    let mut drawn = Vec::new();
    let mut pictures = Vec::new();
    for (frame, drag) in drags.into_iter().enumerate() {
        let inputs = FrameInputs { drag, ..FrameInputs::at_fixed_step(frame as i32, 60.0) };
        drawn.push(lean.draw(&inputs).unwrap().passes_drawn);
        assert_eq!(full.draw(&inputs).unwrap().passes_drawn, 2);
        pictures.push(lean.read_image().unwrap());
        assert_eq!(pictures.last(), full.read_image().ok().as_ref(), "frame {frame}");
    }
    assert_eq!(drawn, [2, 0, 2, 0]);
    assert_ne!(pictures[1], pictures[2], "the camera has turned");
    lean.resize(40, 24).unwrap();
    assert_eq!(lean.draw(&FrameInputs::at_fixed_step(4, 60.0)).unwrap().passes_drawn, 2);
}

#[test]
fn an_earlier_pass_reads_the_previous_frame_of_a_scene() {
    let Some(gpu) = gpu() else { return };
    let fragment = "out vec4 o; layout(location = 1) out vec4 before;
        void main() { o = vec4(float(iFrame)); before = vec4(1.0); }";
    let fragment = &fragment.replacen("out vec4 o", "layout(location = 0) out vec4 o", 1);
    let vertex = "in vec3 aPosition; void main() { gl_Position = vec4(aPosition, 1.0); }";
    let reader = pass(
        buffer("A"),
        "void mainImage(out vec4 o, in vec2 p) { o = texelFetch(iChannel0, ivec2(p), 0); }",
        [target(0), None, None, None],
    );
    let mut cube = draw("builtin:cube");
    cube.cull = Cull::None;
    let scene = scene(fragment, &[vertex], 2, straight(), vec![cube]);
    let show = image(SUM, [nearest("A"), target(1), None, None]);
    let mut engine = ran(&gpu, &project(vec![reader, scene, show]), (4, 4), 5);
    assert_eq!(texel(&engine.read_image().unwrap(), 1, 1)[0], 3.0 + 1.0);
    let doubled: Vec<bool> = engine.program().unwrap().plan().targets.iter().map(|t| t.doubled).collect();
    // A; target 0, which is read before it is drawn; target 1, which is read after; Image.
    assert_eq!(doubled, [false, true, false, false]);
}

#[test]
fn errors_in_a_scene_are_reported_without_a_panic() {
    let Some(gpu) = gpu() else { return };
    let error_messages =
        |project: &Project| match Program::build(&gpu, project, &MediaSet::new(), &BuildOptions::default()) {
            Ok(_) => panic!("built"),
            Err(BuildError::Diagnostics { diagnostics, .. }) => {
                diagnostics.iter().map(|d| format!("{} ({})", d.message, d.hints.join("; "))).collect::<Vec<_>>()
            }
            Err(BuildError::Engine(e)) => vec![e.to_string()],
        };
    let red = one_colour("1.0, 0.0, 0.0");
    let missing = whole(scene(&red, &[FLAT_VERTEX], 1, straight(), vec![draw("no/where.glb"), draw("no/where.glb")]));
    let messages = error_messages(&missing);
    assert_eq!(messages.len(), 1, "{messages:?}");
    assert!(messages[0].starts_with("draw 0 of Buffer scene: no/where.glb is a relative path"), "{messages:?}");
    let unknown = whole(scene(&red, &[FLAT_VERTEX], 1, straight(), vec![draw("builtin:knott")]));
    assert_eq!(
        error_messages(&unknown),
        ["draw 0 of Buffer scene: unknown mesh builtin:knott (did you mean builtin:knot?)"]
    );
}

/// Software drivers set for a whole thread whether denormal numbers are flushed to zero, and llvmpipe used to leave
/// that setting changed after fragments that fail the depth test with 16-bit float targets.
#[test]
fn meshes_in_16_bit_floats_do_not_change_denormal_arithmetic() {
    let Some(gpu) = gpu() else { return };
    // Half of the smallest normal number; and the number of the frame, because an unchanged picture is not drawn
    // again.
    let code = "void mainImage(out vec4 o, in vec2 p) {\n\
                float t = uintBitsToFloat(0x00800000u + uint(p.x)) * (0.25 + 0.25 * step(p.x, 9.5));\n\
                o = vec4(floatBitsToUint(t), iFrame, 0, 1); }";
    let probe = pass(buffer("A"), code, Default::default());
    let options = BuildOptions { requested: [buffer("A")].into(), ..Default::default() };
    let probe =
        project(vec![probe, image("void mainImage(out vec4 o, in vec2 p) { o = vec4(1); }", Default::default())]);
    let mut probe = engine_with(&gpu, &probe, &MediaSet::new(), &options, (256, 256));
    let mut frames = 0..;
    let mut denormals = || {
        let frame = frames.next().unwrap();
        run(&mut probe, frame, frame + 1);
        let pixels = probe.read(&buffer("A")).unwrap();
        assert!(pixels.texels.iter().all(|t| t[1] == frame as f32));
        pixels.texels.iter().map(|t| t[0]).collect::<Vec<_>>()
    };
    let before = denormals();
    // The first cube hides the second from most of its own fragments.
    let mut hidden_cube = draw("builtin:cube");
    (hidden_cube.scale, hidden_cube.position) = (1.5, [-1.0, -0.5, -2.0]);
    let fragment = "layout(location = 0) out vec4 a; void main() { a = vec4(1); }";
    let mut cubes = scene(fragment, &[VERTEX], 1, camera(), vec![draw("builtin:cube"), hidden_cube]);
    cubes.settings.format = TexelFormat::Rgba16f;
    let mut engine = ran(&gpu, &whole(cubes), (200, 150), 4);
    engine.read_image().unwrap();
    for _ in 0..4 {
        assert!(denormals() == before, "the treatment of denormal numbers has changed");
    }
}
