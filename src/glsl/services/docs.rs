//! Documentation of predefined names: the result, where it is undefined, and the unit.
//!
//! Owns the texts and nothing else; signatures come from the checker's tables, so they cannot disagree with it.

/// Returns the text of a uniform, channel, `gl_` variable or constant, entry point, or macro of the header.
pub(super) fn variable(name: &str) -> Option<&'static str> {
    find(VARIABLES, name)
}

pub(super) fn keyword(name: &str) -> Option<&'static str> {
    find(KEYWORDS, name)
}

pub(super) fn directive(name: &str) -> Option<&'static str> {
    find(DIRECTIVES, name)
}

/// Returns the name, type and text of each member of `iCh0` to `iCh3`.
pub(super) fn channel_members() -> &'static [(&'static str, &'static str, &'static str)] {
    CHANNEL_MEMBERS
}

pub(super) fn directives() -> impl Iterator<Item = &'static str> {
    DIRECTIVES.iter().map(|d| d.0)
}

fn find(table: &[(&str, &'static str)], name: &str) -> Option<&'static str> {
    table.iter().find(|(known, _)| *known == name).map(|(_, text)| *text)
}

/// Name and text.
#[rustfmt::skip]
const VARIABLES: &[(&str, &str)] = &[
    // Shadertoy's uniforms.
    ("iResolution", "Resolution of this pass in pixels; z is the pixel aspect ratio, always 1. A cubemap pass has \
                     1024 x 1024."),
    ("iTime", "Seconds since the start or the last reset. Does not advance while paused."),
    ("iTimeDelta", "Seconds from the last frame to this one. 1/60 in the first frame after a reset or a pause, and in \
                    frames that are drawn while paused."),
    ("iFrame", "Frame number, 0 after a reset: initialise buffers where `iFrame == 0`."),
    ("iFrameRate", "Frames per second, measured over the last half second and constant in between: not 1 / \
                    iTimeDelta."),
    ("iMouse", "The mouse, in whole pixels from the bottom left. xy: where it is while the button is held, or was \
                last. abs(zw): where the button went down. z > 0 while it is held; w > 0 only in the first frame of a \
                press. All 0 before the first one."),
    ("iDate", "Year, month from 0 to 11, day from 1 to 31, and seconds since midnight in local time."),
    ("iChannelTime", "For each channel, the playback time of its video or music in seconds; 0 for other inputs."),
    ("iChannelResolution", "For each channel, its size in texels: width, height, depth (1 for 2D textures). (0, 0, \
                            0) while nothing is loaded."),
    ("iSampleRate", "Sound samples per second: always 44100."),
    ("iTimeOffset", "Start of the current block of sound in seconds. Sound passes only; `mainSound` gets the time \
                     itself."),
    ("iSampleOffset", "Number of the first sample of the block being computed. Sound passes only."),
    ("iGlobalTime", "The old name of `iTime`."),
    ("iChannel0", "The input of channel 0: an image file, a buffer, the keyboard. Read it with `texture` or \
                   `texelFetch`. Opaque black, with size 0, if nothing is set."),
    ("iChannel1", "The input of channel 1: an image file, a buffer, the keyboard. Read it with `texture` or \
                   `texelFetch`. Opaque black, with size 0, if nothing is set."),
    ("iChannel2", "The input of channel 2: an image file, a buffer, the keyboard. Read it with `texture` or \
                   `texelFetch`. Opaque black, with size 0, if nothing is set."),
    ("iChannel3", "The input of channel 3: an image file, a buffer, the keyboard. Read it with `texture` or \
                   `texelFetch`. Opaque black, with size 0, if nothing is set."),
    ("iCh0", "Channel 0 as a struct, in Image only: `sampler`, `size`, `time` and `loaded`."),
    ("iCh1", "Channel 1 as a struct, in Image only: `sampler`, `size`, `time` and `loaded`."),
    ("iCh2", "Channel 2 as a struct, in Image only: `sampler`, `size`, `time` and `loaded`."),
    ("iCh3", "Channel 3 as a struct, in Image only: `sampler`, `size`, `time` and `loaded`."),
    ("iModel", "`mat4`: from the mesh to the world, as the draw's scale, rotation and position say. In passes that \
                draw meshes only."),
    ("iView", "`mat4`: from the world to the camera, which looks along its -z. In passes that draw meshes only."),
    ("iProjection", "`mat4`: from the camera to clip space, as GL has it. In passes that draw meshes only."),
    ("iNormalMatrix", "`mat3`: from mesh normals to world normals; normalise the result. In passes that draw meshes \
                       only."),
    ("iCameraPosition", "`vec3`: position of the camera in the world. In passes that draw meshes only."),
    // Section 7.1.
    ("gl_Position", "Position of the vertex in clip space; must be written. Vertex stages only."),
    ("gl_PointSize", "Size of a point. Has no effect, as meshes are triangles. Vertex stages only."),
    ("gl_VertexID", "Number of the vertex in its mesh. Vertex stages only."),
    ("gl_InstanceID", "Number of the instance: 0. Vertex stages only."),
    // Section 7.2.
    ("gl_FragCoord", "The pixel: xy is its centre from the bottom left (the first is at 0.5, 0.5), z the depth, w is 1 \
                      (of a mesh: one through the clip space's). `fragCoord` is its xy."),
    ("gl_FrontFacing", "True if the triangle faces the camera: always true except for meshes."),
    ("gl_PointCoord", "Place within a point. A pass draws no points, so it is (0, 0)."),
    ("gl_FragDepth", "The depth to write, 0 to 1. Only passes that draw meshes have a depth buffer; elsewhere it \
                      has no effect."),
    // Section 7.3 and 7.4.
    ("gl_DepthRange", "Depths of the window: near 0, far 1, diff 1."),
    ("gl_MaxVertexAttribs", "Maximum number of attributes of a vertex shader. Eddy reports the minimum that GLSL \
                             guarantees."),
    ("gl_MaxVertexUniformVectors", "Maximum number of vec4 uniforms of a vertex shader. Eddy reports the minimum \
                                    that GLSL guarantees."),
    ("gl_MaxVertexOutputVectors", "Maximum number of vec4 outputs of a vertex shader. Eddy reports the minimum that \
                                   GLSL guarantees."),
    ("gl_MaxFragmentInputVectors", "Maximum number of vec4 inputs of a fragment shader. Eddy reports the minimum \
                                    that GLSL guarantees."),
    ("gl_MaxVertexTextureImageUnits", "Maximum number of textures of a vertex shader. Eddy reports the minimum that GLSL guarantees."),
    ("gl_MaxCombinedTextureImageUnits", "Maximum number of textures of both shaders together. Eddy reports the \
                                         minimum that GLSL guarantees."),
    ("gl_MaxTextureImageUnits", "Maximum number of textures of a fragment shader. Eddy reports the minimum that \
                                 GLSL guarantees; a pass has four channels."),
    ("gl_MaxFragmentUniformVectors", "Maximum number of vec4 uniforms of a fragment shader. Eddy reports the \
                                      minimum that GLSL guarantees."),
    ("gl_MaxDrawBuffers", "Maximum number of targets of a fragment shader. Eddy reports the minimum that GLSL \
                           guarantees; a pass writes one."),
    ("gl_MinProgramTexelOffset", "Smallest offset, in texels, of `textureOffset` and similar functions."),
    ("gl_MaxProgramTexelOffset", "Largest offset, in texels, of `textureOffset` and similar functions."),
    // Entry points.
    ("mainImage", "Called for each pixel: fragCoord is its centre in pixels from the bottom left, fragColor is its \
                   colour. Alpha is used in buffers only."),
    ("mainCubemap", "Called for each texel of the six faces: a ray from the middle of the cube, rayOri, towards the \
                     texel, rayDir, of length 1."),
    ("mainSound", "Called for each sample: left and right, -1 to 1, at `time` seconds; samp is the number of the \
                   sample, 44100 per second."),
    // Macros of the header and of the language.
    ("HW_PERFORMANCE", "1 on a computer, 0 on a phone: for a cheaper version of what is costly. Here always 1."),
    ("GL_ES", "1: the language is GLSL ES."),
    ("__VERSION__", "300: the version of the language."),
    ("__LINE__", "Line number in the code that Shadertoy's compiler gets, which has the header and Common before \
                  this pass."),
    ("__FILE__", "0, unless a `#line` has changed it."),
];

/// Members of `iCh0` to `iCh3`.
const CHANNEL_MEMBERS: &[(&str, &str, &str)] = &[
    ("sampler", "sampler", "The texture, as `iChannelN`."),
    ("size", "vec3", "Its size in texels, as `iChannelResolution[N]`."),
    ("time", "float", "Playback time of its video or music in seconds, as `iChannelTime[N]`."),
    ("loaded", "int", "1 if the input of the channel is loaded, else 0."),
];

/// Keywords that newcomers may look up.
#[rustfmt::skip]
const KEYWORDS: &[(&str, &str)] = &[
    ("const", "A constant; it needs an initial value. As a parameter: the function cannot change it."),
    ("in", "A parameter copied in; changes stay inside the function. The default without in, out or inout."),
    ("out", "A parameter the function writes: copied to the argument when it returns. On entry it is zero here, \
             elsewhere undefined."),
    ("inout", "A parameter copied in, and back out when the function returns."),
    ("discard", "Ends without writing the pixel. In a buffer, the pixel keeps its value from two frames ago."),
    ("precision", "Default precision of a type. Here everything is 32 bits."),
    ("lowp", "Low precision will do. Here everything is 32 bits."),
    ("mediump", "Medium precision will do. Here everything is 32 bits."),
    ("highp", "Full precision. Here everything is 32 bits."),
    ("struct", "A type with named members. Its name is also its constructor."),
    ("switch", "Goes to the `case` that equals an int or uint. Cases fall through into the next without `break`."),
    ("case", "A label of a `switch`: a constant int or uint."),
    ("default", "The label of a `switch` for every other value."),
    ("continue", "Continues with the next iteration of the loop."),
    ("break", "Leaves the loop or switch."),
    ("return", "Leaves the function, with its value."),
    ("uniform", "A value set from outside. Give one a slider with `#iUniform`, or a value in eddy.toml; otherwise \
                 it is 0."),
    ("flat", "Not interpolated. Has no effect in a pass."),
    ("smooth", "Interpolated. Has no effect in a pass."),
    ("centroid", "Interpolated within the triangle. Has no effect in a pass."),
    ("invariant", "Computed alike in every program. Has no effect in a pass."),
    ("layout", "Where a value is stored. Has no effect in a pass."),
];

/// Directives of the preprocessor.
const DIRECTIVES: &[(&str, &str)] = &[
    ("define", "Defines a macro: `#define NAME text`, or `#define NAME(a, b) text`."),
    ("undef", "Removes the definition of a macro."),
    ("if", "Compiles the lines up to `#endif` only if a constant condition holds."),
    ("ifdef", "Compiles the lines up to `#endif` only if a macro is defined."),
    ("ifndef", "Compiles the lines up to `#endif` only if a macro is not defined."),
    ("elif", "Compiles the lines below if no earlier condition held and this one does."),
    ("else", "Compiles the lines up to `#endif` if no condition held."),
    ("endif", "Ends an `#if`."),
    ("error", "Stops compiling with this message."),
    ("pragma", "A hint to the compiler; none has an effect here."),
    ("line", "Changes what `__LINE__` says. Messages do not follow it."),
];

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{check, hir::Uniform};
    use std::collections::BTreeSet;

    #[test]
    fn documented_variables_are_the_predefined_ones() {
        let given: BTreeSet<&str> = check::env::names()
            .chain(Uniform::ALL.iter().filter(|u| **u != Uniform::ChannelLoaded).map(|u| u.name()))
            .chain(["HW_PERFORMANCE", "GL_ES", "__VERSION__", "__LINE__", "__FILE__"])
            .collect();
        let documented: BTreeSet<&str> = VARIABLES.iter().map(|v| v.0).collect();
        assert_eq!(documented.len(), VARIABLES.len(), "a name occurs twice");
        assert_eq!(documented, given);
        for (name, text) in VARIABLES.iter().chain(KEYWORDS).chain(DIRECTIVES) {
            assert!(text.ends_with('.') && text.len() > 12, "{name}: {text}");
        }
    }

    #[test]
    fn documented_directives_are_those_of_the_preprocessor() {
        for name in directives() {
            assert!(crate::preprocess::DIRECTIVES.contains(&name), "{name}");
        }
    }
}
