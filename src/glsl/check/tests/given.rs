//! Redeclarations of names that the header declares.

use super::checked;
use crate::{ChannelKind, PassKind};

const CHANNELS: [ChannelKind; 4] =
    [ChannelKind::Sampler2D, ChannelKind::SamplerCube, ChannelKind::Sampler2D, ChannelKind::Sampler3D];

/// Returns whether a pass with these declarations fails, the number of its messages, and their text.
fn declared(declarations: &str) -> (bool, usize, String) {
    let code = format!(
        "{declarations}\nvoid mainImage(out vec4 o, in vec2 p) {{ o = vec4(p / iResolution.xy, sin(iTime), 1.0); }}"
    );
    let (_, failed, messages) = checked(PassKind::Image, CHANNELS, None, &code);
    let count = messages.matches("warning: ").count() + messages.matches("error: ").count();
    (failed, count, messages)
}

#[test]
fn redeclared_uniforms_are_accepted_with_a_warning() {
    for declarations in [
        "uniform vec3 iResolution;",
        "uniform float iTime;",
        "uniform float iTimeDelta;",
        "uniform float iFrameRate;",
        "uniform int iFrame;",
        "uniform vec4 iMouse;",
        "uniform vec4 iDate;",
        "uniform float iSampleRate;",
        "uniform float iChannelTime[4];",
        "uniform float[4] iChannelTime;",
        "uniform vec3 iChannelResolution[4];",
        "uniform sampler2D iChannel0;",
        "uniform samplerCube iChannel1;",
        "uniform mediump sampler3D iChannel3;",
        "uniform highp vec3 iResolution;",
        "uniform lowp float iTime;",
        "uniform float iGlobalTime;",
        "layout(location = 0) uniform vec3 iResolution;",
        "layout(std140) uniform Globals { vec3 iResolution; };",
    ] {
        let (failed, count, messages) = declared(declarations);
        assert!(!failed && count == 1, "{declarations}: {messages}");
        assert!(messages.contains("is already declared: Shadertoy rejects"), "{declarations}: {messages}");
    }
    let (failed, count, messages) = declared("uniform float iTime, iTimeDelta;");
    assert!(!failed && count == 2, "{messages}");
    let (failed, count, messages) = declared("uniform Globals { vec3 iResolution; float other; };");
    assert!(!failed && count == 2 && messages.contains("has no values"), "{messages}");
}

#[test]
fn redeclaration_with_another_type_is_one_error() {
    for (declarations, own) in [
        ("uniform vec2 iResolution;", "`iResolution` is a `vec3`, but this declares a `vec2`"),
        ("uniform vec2 iMouse;", "`iMouse` is a `vec4`"),
        ("uniform int iTime;", "`iTime` is a `float`"),
        ("uniform float iFrame;", "`iFrame` is an `int`"),
        ("uniform float iChannelTime;", "`iChannelTime` is a `float[4]`"),
        ("uniform vec3 iChannelResolution[2];", "`iChannelResolution` is a `vec3[4]`"),
        ("uniform samplerCube iChannel0;", "`iChannel0` is a `sampler2D`, because of the input of the channel"),
        ("uniform sampler2D iChannel1;", "`iChannel1` is a `samplerCube`"),
        ("uniform Globals { vec2 iResolution; };", "`iResolution` is a `vec3`"),
        ("uniform float iTime = 1.0;", "cannot have an initialiser"),
        ("vec3 iResolution;", "already declared by Shadertoy's header"),
        ("in vec3 iResolution;", "already declared by Shadertoy's header"),
        ("const float iTime = 1.0;", "already declared by Shadertoy's header"),
    ] {
        let (failed, count, messages) = declared(declarations);
        assert!(failed && count == 1, "{declarations}: {messages}");
        assert!(messages.contains(own), "{declarations}: {messages}");
    }
    let (failed, count, messages) = declared("uniform float mine;\nuniform float mine;");
    assert!(failed && count == 2 && messages.contains("already declared in this scope"), "{messages}");
}

#[test]
fn unused_inputs_and_outputs_are_accepted() {
    let (failed, count, messages) = declared("in vec2 p;\nout vec4 o;\nlayout(location = 0) out vec4 fragColor;");
    assert!(!failed && count == 3, "{messages}");
    assert!(messages.contains("`fragColor` cannot be an output"), "{messages}");
    let (failed, _, messages) = declared("out vec4 fragColor;\nvoid f() { fragColor = vec4(1.0); }");
    assert!(failed && messages.contains("`fragColor` cannot be an output"), "{messages}");
    let common = "uniform vec3 iResolution;\n";
    let code = "void mainImage(out vec4 o, in vec2 p) { o = vec4(p / iResolution.xy, 0.0, 1.0); }";
    let (_, failed, messages) = checked(PassKind::Image, CHANNELS, Some(common), code);
    assert!(!failed && messages.contains("common.glsl:1:14"), "{messages}");
}
