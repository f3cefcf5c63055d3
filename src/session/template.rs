//! The initial texts of new projects and new passes. They are Eddy's own.

use super::documents::insert_pass;
use eddy_project::{Origin, Pass, PassName, Project, Role, Source, Tab, limits};

const IMAGE: &str = "\
// fragCoord: pixels from the bottom left. Inputs: iResolution, iTime, iMouse, iChannel0 to iChannel3.
void mainImage(out vec4 fragColor, in vec2 fragCoord)
{
    vec2 p = (2.0 * fragCoord - iResolution.xy) / iResolution.y;
    float wave = sin(8.0 * length(p) - 2.0 * iTime);
    vec3 color = mix(vec3(0.05, 0.10, 0.25), vec3(0.95, 0.60, 0.25), 0.5 + 0.5 * wave);
    fragColor = vec4(color / (1.0 + dot(p, p)), 1.0);
}
";

const BUFFER: &str = "\
// The result is stored as four floats per pixel; any pass can read it.
void mainImage(out vec4 fragColor, in vec2 fragCoord)
{
    fragColor = vec4(0.0);
}
";

const CUBEMAP: &str = "\
// rayDir: from the centre of the cube to this pixel of the face being drawn.
void mainCubemap(out vec4 fragColor, in vec2 fragCoord, in vec3 rayOri, in vec3 rayDir)
{
    fragColor = vec4(0.5 + 0.5 * rayDir, 1.0);
}
";

const SOUND: &str = "\
// Left and right, each from -1 to 1. samp counts samples, 44,100 per second, and stays exact when time does not.
vec2 mainSound(int samp, float time)
{
    float phase = fract(440.0 * float(samp % 44100) / 44100.0);
    float fade = exp(-4.0 * fract(time));
    return vec2(0.25 * fade * sin(6.2831853 * phase));
}
";

const COMMON: &str = "\
// Shared code, inserted before every pass.
";

/// A project of one Image pass that is not stored on disk.
pub(super) fn project() -> Project {
    let mut project = Project::new("Untitled", Vec::new(), Origin::Unsaved);
    add(&mut project, &Tab::image());
    project
}

/// Returns the initial text of a tab.
pub(super) fn text(tab: &Tab) -> &'static str {
    match tab {
        Tab::Common => COMMON,
        Tab::Pass(pass) => match pass.role() {
            Role::Buffer => BUFFER,
            Role::Cube => CUBEMAP,
            Role::Sound => SOUND,
            Role::Image => IMAGE,
        },
        Tab::Stage(..) | Tab::Included(_) => "",
    }
}

/// Adds a tab with its initial text; returns false if it exists already.
pub(super) fn add(project: &mut Project, tab: &Tab) -> bool {
    let is_named_so = tab.pass().and_then(PassName::buffer_name).is_none_or(PassName::is_name);
    if project.source(tab).is_some() || !is_named_so || project.passes.len() >= limits::PASSES {
        return false;
    }
    let source = Source { name: tab.title(), path: None, text: text(tab).into() };
    match tab {
        Tab::Common => project.common = Some(source),
        // A stage exists because a draw of its pass names it.
        Tab::Stage(..) | Tab::Included(_) => return false,
        Tab::Pass(id) => insert_pass(project, Pass::new(id.clone(), source)),
    }
    true
}
