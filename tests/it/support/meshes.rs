//! Passes that draw meshes, built in code.

use super::{buffer, image, pass, project};
use eddy::project::{
    Body, Camera, Channel, Cull, DepthTest, Filter, Geometry, Input, MeshDraw, MeshSource, Pass, PassName, Project,
    Sampler, Source, Stage, TexelFormat, Wrap,
};

/// Returns a mesh in front of the camera with the defaults of a manifest.
pub(crate) fn draw(mesh: &str) -> MeshDraw {
    MeshDraw {
        mesh: MeshSource::parse(mesh),
        normals: None,
        vertex: Stage::File(0),
        fragment: Stage::Own,
        cull: Cull::Back,
        depth: DepthTest::Less,
        depth_write: true,
        color_write: true,
        scale: 1.0,
        rotation: [0.0; 3],
        position: [0.0; 3],
    }
}

pub(crate) fn source(name: &str, text: &str) -> Source {
    Source { name: name.into(), path: None, text: text.into() }
}

/// Returns a pass `scene` with 32-bit targets; its own text is the fragment stage, `stages` are further texts.
pub(crate) fn scene(fragment: &str, stages: &[&str], targets: usize, camera: Camera, draws: Vec<MeshDraw>) -> Pass {
    let mut scene = pass(buffer("scene"), fragment, Default::default());
    scene.body = Body::Meshes(Geometry {
        draws,
        more_targets: vec![TexelFormat::Rgba32f; targets - 1],
        camera,
        stages: stages.iter().enumerate().map(|(i, t)| source(&format!("stage_{i}.glsl"), t)).collect(),
    });
    scene
}

/// Returns a channel that reads a target of the scene.
pub(crate) fn target(index: usize) -> Option<Channel> {
    let input = match index {
        0 => Input::buffer("scene"),
        index => Input::Pass { id: PassName::buffer("scene"), target: index },
    };
    Some(Channel { input, sampler: Sampler { filter: Filter::Nearest, wrap: Wrap::Clamp, vflip: true } })
}

/// An Image pass that adds its four channels.
pub(crate) const SUM: &str = "void mainImage(out vec4 o, in vec2 p) { ivec2 i = ivec2(p);
    o = texelFetch(iChannel0, i, 0) + texelFetch(iChannel1, i, 0) + texelFetch(iChannel2, i, 0) + \
    texelFetch(iChannel3, i, 0); }";

/// Returns a project of a scene, and an Image that shows it.
pub(crate) fn whole(scene: Pass) -> Project {
    let count = scene.formats().len();
    project(vec![scene, image(SUM, [0, 1, 2, 3].map(|i| if i < count { target(i) } else { None }))])
}

pub(crate) fn camera() -> Camera {
    Camera { yaw: 25.0, pitch: 35.0, distance: 5.0, target: [0.2, -0.1, 0.3], fov: 50.0, ..Camera::default() }
}

pub(crate) fn straight() -> Camera {
    Camera { yaw: 0.0, pitch: 0.0, distance: 5.0, ..Camera::default() }
}
