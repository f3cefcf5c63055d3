//! Adds pictures and models to a project: selects the channel that reads a picture, and the pass that draws a model.

use crate::{
    Body, Camera, Channel, Cull, DepthTest, Geometry, Input, InputKind, Media, MeshDraw, MeshSource, Pass, PassName,
    Project, SLOTS, Source, Stage, limits,
};
use std::path::Path;

const PICTURE: &str = "\
// Fit iChannel0 into the picture.
void mainImage(out vec4 fragColor, in vec2 fragCoord)
{
    vec2 size = max(iChannelResolution[0].xy, vec2(1.0));
    float zoom = min(iResolution.x / size.x, iResolution.y / size.y);
    vec2 uv = (fragCoord - 0.5 * iResolution.xy) / (zoom * size) + 0.5;
    vec2 inside = step(0.0, uv) * step(uv, vec2(1.0));
    fragColor = texture(iChannel0, uv) * inside.x * inside.y;
}
";

const COPY: &str = "\
// Show the pass in iChannel0.
void mainImage(out vec4 fragColor, in vec2 fragCoord)
{
    fragColor = texture(iChannel0, fragCoord / iResolution.xy);
}
";

const VERTEX: &str = "\
// Inputs of the model: aPosition, aNormal, aTangent, aUv and aColor. Drag to turn the camera.
in vec3 aPosition;
in vec3 aNormal;
in vec2 aUv;
in vec4 aColor;
out vec3 vNormal;
out vec2 vUv;
out vec4 vColor;

void main()
{
    vNormal = iNormalMatrix * aNormal;
    vUv = aUv;
    vColor = aColor;
    gl_Position = iProjection * iView * iModel * vec4(aPosition, 1.0);
}
";

const FRAGMENT: &str = "\
// One light and some ambient light. To use a texture of the model, read a channel at vUv.
in vec3 vNormal;
in vec2 vUv;
in vec4 vColor;
out vec4 fragColor;

void main()
{
    float light = 0.35 + 0.65 * max(dot(normalize(vNormal), normalize(vec3(0.4, 0.8, 0.6))), 0.0);
    fragColor = vec4(vColor.rgb * light, 1.0);
}
";

/// The transform that places a model in the world.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Fit {
    pub scale: f64,
    pub position: [f64; 3],
}

impl Fit {
    /// Centres a bounding box and scales it to the view of the default camera.
    pub fn of_corners(least: [f32; 3], most: [f32; 3]) -> Fit {
        let middle = [0, 1, 2].map(|i| f64::from(least[i] + most[i]) / 2.0);
        let half = [0, 1, 2].map(|i| f64::from(most[i] - least[i]) / 2.0);
        let radius = half.iter().map(|h| h * h).sum::<f64>().sqrt();
        let scale = if radius.is_finite() && radius > 0.0 { 1.4 / radius } else { 1.0 };
        // Round to a readable number of digits in eddy.toml.
        let scale = format!("{scale:.3e}").parse().unwrap_or(1.0);
        Fit { scale, position: middle.map(|m| if m.is_finite() { (-m * scale * 1e4).round() / 1e4 } else { 0.0 }) }
    }
}

/// A new project for a file that is brought while no project is open: its Image pass shows iChannel0.
pub fn new_for(path: &Path, is_model: bool) -> Project {
    let text = if is_model { COPY } else { PICTURE };
    let name = path.file_stem().map(|s| s.to_string_lossy().trim().to_owned()).filter(|s| !s.is_empty());
    Project::of_image(name.unwrap_or_else(|| "Untitled".into()), text.to_owned())
}

impl Project {
    /// The channel of a pass for a new input: an empty one that its text already reads, else the first empty one.
    pub fn free_channel(&self, id: &PassName) -> Option<usize> {
        let pass = self.pass(id)?;
        let is_empty = |n: &usize| pass.bindings.get(*n).is_none();
        let reads = |n: &usize| pass.source.text.contains(&format!("iChannel{n}"));
        (0..SLOTS).filter(is_empty).find(reads).or_else(|| (0..SLOTS).find(is_empty))
    }

    /// Binds a picture to a channel.
    pub fn read_picture(&mut self, id: &PassName, channel: usize, picture: &Path) {
        if let Some(pass) = self.pass_mut(id).filter(|_| channel < SLOTS) {
            pass.bindings.set(channel, Some(Channel::new(Input::texture(Media::Picked(picture.to_owned())))));
        }
    }

    /// Binds a video to a channel.
    pub fn read_video(&mut self, id: &PassName, channel: usize, video: &Path) {
        self.read_picked(InputKind::Video, id, channel, video);
    }

    /// Binds a sound to a channel as music.
    pub fn read_sound(&mut self, id: &PassName, channel: usize, sound: &Path) {
        self.read_picked(InputKind::Music, id, channel, sound);
    }

    fn read_picked(&mut self, kind: InputKind, id: &PassName, channel: usize, path: &Path) {
        if let Some(pass) = self.pass_mut(id).filter(|_| channel < SLOTS) {
            let media = Media::Picked(path.to_owned());
            pass.bindings.set(channel, Some(Channel::new(Input::Media { kind, media })));
        }
    }

    /// Adds a buffer that draws a model, with initial texts. `None` if the project has too many passes.
    pub fn add_model(&mut self, model: &Path, fit: Fit) -> Option<PassName> {
        if self.passes.len() >= limits::PASSES {
            return None;
        }
        let numbered = (2..).map(|n| format!("model{n}"));
        let is_free = |name: &String| self.pass(&PassName::buffer(name)).is_none();
        let name = std::iter::once("model".to_owned()).chain(numbered).find(is_free)?;
        let id = PassName::buffer(&name);
        let draw = MeshDraw {
            mesh: MeshSource::Picked(model.to_owned()),
            normals: None,
            vertex: Stage::File(0),
            fragment: Stage::Own,
            // Unknown models are often viewed from inside, too.
            cull: Cull::None,
            depth: DepthTest::Less,
            depth_write: true,
            color_write: true,
            scale: fit.scale,
            rotation: [0.0; 3],
            position: fit.position,
        };
        let vertex = Source { name: format!("{name}.vert.glsl"), path: None, text: VERTEX.into() };
        let geometry =
            Geometry { draws: vec![draw], more_targets: Vec::new(), camera: Camera::default(), stages: vec![vertex] };
        let pass = Pass {
            id: id.clone(),
            source: Source { name: id.title(), path: None, text: FRAGMENT.into() },
            bindings: Default::default(),
            settings: Default::default(),
            body: Body::Meshes(geometry),
        };
        append_buffer(self, pass);
        Some(id)
    }

    /// Binds a buffer to a channel.
    pub fn read_buffer(&mut self, id: &PassName, channel: usize, buffer: &PassName) {
        if let Some(pass) = self.pass_mut(id).filter(|_| channel < SLOTS) {
            pass.bindings.set(channel, Some(Channel::new(Input::pass(buffer.clone()))));
        }
    }
}

/// Adds a buffer after the other buffers.
fn append_buffer(project: &mut Project, pass: Pass) {
    let at = project.passes.iter().position(|p| !p.id.is_buffer()).unwrap_or(project.passes.len());
    project.passes.insert(at, pass);
}
