//! Shaders of our own, compiled, validated, written as WGSL, and parsed again.

use crate::{ClipSpace, Compiled, Link, PassKind, PassSource, Reflection, compile, compile_linked};

/// Compiles a shader, and checks that naga accepts the module and the WGSL written from it.
fn compile_checked(source: &PassSource<'_>) -> (Compiled, String) {
    linked(source, &Link::default())
}

fn linked(source: &PassSource<'_>, link: &Link<'_>) -> (Compiled, String) {
    let compiled = compile_linked(source, link, None).unwrap_or_else(|e| panic!("{e:#?}\n{}", source.code.text));
    let text = wgsl(&compiled);
    let again = naga::front::wgsl::parse_str(&text).unwrap_or_else(|e| panic!("{}\n{text}", e.emit_to_string(&text)));
    validated(&again);
    assert_eq!(buffers(&compiled.module), buffers(&again), "{text}");
    (compiled, text)
}

fn validated(module: &naga::Module) -> naga::valid::ModuleInfo {
    use naga::valid::{Capabilities, ValidationFlags, Validator};
    Validator::new(ValidationFlags::all(), Capabilities::default()).validate(module).unwrap_or_else(|e| panic!("{e:?}"))
}

fn wgsl(compiled: &Compiled) -> String {
    let flags = naga::back::wgsl::WriterFlags::empty();
    naga::back::wgsl::write_string(&compiled.module, &validated(&compiled.module), flags).unwrap()
}

/// Returns the offsets of everything in uniform buffers, which must be the same after a round trip through a text
/// without offsets.
fn buffers(module: &naga::Module) -> Vec<String> {
    fn add(module: &naga::Module, ty: naga::Handle<naga::Type>, at: u32, out: &mut Vec<String>) {
        match &module.types[ty].inner {
            naga::TypeInner::Struct { members, span } => {
                out.push(format!("{at}+{span}"));
                members.iter().for_each(|member| add(module, member.ty, at + member.offset, out));
            }
            naga::TypeInner::Array { base, size: naga::ArraySize::Constant(len), stride } => {
                (0..len.get()).for_each(|i| add(module, *base, at + i * stride, out));
            }
            inner => out.push(format!("{at}: {inner:?}")),
        }
    }
    let mut out = Vec::new();
    for (_, variable) in module.global_variables.iter().filter(|(_, v)| v.space == naga::AddressSpace::Uniform) {
        out.push(format!("{:?}", variable.binding));
        add(module, variable.ty, 0, &mut out);
    }
    out
}

fn fragment(text: &str) -> (Compiled, String) {
    compile_checked(&PassSource::fragment(text))
}

/// Returns the members of all buffers, as `name: type @ offset + size`.
fn uniforms(reflection: &Reflection) -> Vec<String> {
    let all = reflection.shader.buffers.iter().flat_map(|buffer| &buffer.members);
    all.map(|u| format!("{}: {} @ {} + {}", u.name, u.ty, u.offset, u.size)).collect()
}

/// Returns the messages of the errors of an invalid text, with the underlined parts.
fn errors(kind: PassKind, text: &str) -> Vec<(String, String)> {
    let source = match kind {
        PassKind::PlainVertex => PassSource::vertex(text),
        _ => PassSource::fragment(text),
    };
    let all = compile(&source).expect_err(text);
    let errors = all.iter().filter(|d| d.is_error());
    errors.map(|d| (d.message.clone(), d.span.map_or("", |s| &text[s.range()]).to_owned())).collect()
}

#[track_caller]
fn assert_refused(text: &str, message: &str, at: &str) {
    let all = errors(PassKind::PlainFragment, text);
    assert!(all.iter().any(|(found, place)| found.contains(message) && place == at), "{text}\n{all:#?}");
}

#[test]
fn scalars_vectors_and_matrices_have_std140_offsets() {
    let (compiled, text) = fragment(
        "#version 300 es
        precision highp float;
        uniform float time;
        uniform vec3 tint;
        uniform bool inverted;
        uniform ivec2 cell;
        uniform mat3 turn;
        uniform mat2 skew;
        uniform mat4x2 wide;
        uniform bvec3 mask;
        uniform uint seed;
        uniform float unread;
        out vec4 color;
        void main() {
            vec2 uv = skew * gl_FragCoord.xy + wide * vec4(1.0) + wide[2] + vec2(wide[seed].y);
            vec3 c = turn * vec3(uv, time) + tint;
            if (inverted && any(mask) && mask.z) c = 1.0 - c;
            color = vec4(c, float(cell.x + cell.y) + turn[1][2] + turn[seed].x);
        }",
    );
    assert_eq!(
        uniforms(&compiled.reflection),
        [
            "time: float @ 0 + 4",
            "tint: vec3 @ 16 + 12",
            "inverted: bool @ 28 + 4",
            "cell: ivec2 @ 32 + 8",
            "turn: mat3 @ 48 + 48",
            "skew: mat2 @ 96 + 32",
            "wide: mat4x2 @ 128 + 64",
            "mask: bvec3 @ 192 + 12",
            "seed: uint @ 204 + 4",
        ]
    );
    let buffer = &compiled.reflection.shader.buffers[0];
    assert_eq!((buffer.group, buffer.binding, buffer.size), (0, 0, 224));
    assert!(text.contains("@group(0) @binding(0)") && text.contains("time: f32"), "{text}");
}

#[test]
fn arrays_and_structures_have_std140_offsets() {
    let (compiled, text) = fragment(
        "struct Light { vec3 at; float power; bool on; vec2 spread[2]; };
        struct Tiny { float x; };
        uniform float first;
        uniform Tiny tiny;
        uniform Light lights[3];
        uniform float weights[5];
        uniform vec2 points[2];
        uniform vec3 colors[2];
        uniform mat2 turns[2];
        uniform bool flags[3];
        uniform int which;
        out vec4 color;
        float sum(float all[5]) { float s = 0.0; for (int i = 0; i < 5; i++) s += all[i]; return s; }
        vec3 lit(Light l) { return l.on ? l.at * l.power + vec3(l.spread[1], 0.0) : vec3(l.spread[which], 1.0); }
        void main() {
            vec3 c = lit(lights[which]) + lights[1].at + colors[which] + vec3(points[which], points[1].y);
            Light copy = lights[2];
            float w[5] = weights;
            c += lit(copy) + sum(weights) + w[which] + weights[3] + tiny.x + first;
            c.xy += turns[which] * c.yz + turns[1][which];
            if (flags[which] || flags[2]) c += vec3(lights[which].spread[which].y);
            color = vec4(c, 1.0);
        }",
    );
    let found = uniforms(&compiled.reflection);
    let expected = [
        "first: float @ 0 + 4",
        "tiny.x: float @ 16 + 4",
        "lights[0].at: vec3 @ 32 + 12",
        "lights[0].power: float @ 44 + 4",
        "lights[0].on: bool @ 48 + 4",
        "lights[0].spread: vec2[2] @ 64 + 32",
        "lights[1].at: vec3 @ 96 + 12",
    ];
    assert_eq!(found[..expected.len()], expected);
    let expected = [
        "weights: float[5] @ 224 + 80",
        "points: vec2[2] @ 304 + 32",
        "colors: vec3[2] @ 336 + 32",
        "turns: mat2[2] @ 368 + 64",
        "flags: bool[3] @ 432 + 48",
        "which: int @ 480 + 4",
    ];
    assert_eq!(found[found.len() - expected.len()..], expected);
    assert!(text.contains("struct Light"), "{text}");
}

#[test]
fn a_block_has_a_buffer_of_its_own() {
    let (compiled, _) = fragment(
        "uniform float alone;
        layout(std140) uniform Camera { mat4 view; vec3 eye; float near; };
        uniform sampler2D picture;
        layout(std140) uniform Material { vec4 base; float rough[2]; } material;
        layout(std140) uniform Unread { vec4 nothing; };
        out vec4 color;
        void main() {
            color = view * vec4(eye, near) + material.base * material.rough[1] + alone + texture(picture, eye.xy);
        }",
    );
    let buffers = &compiled.reflection.shader.buffers;
    let shown: Vec<_> = buffers.iter().map(|b| (b.name.as_str(), b.binding, b.size)).collect();
    assert_eq!(shown, [("", 0, 16), ("Camera", 1, 80), ("Material", 4, 48)]);
    assert_eq!(
        uniforms(&compiled.reflection),
        [
            "alone: float @ 0 + 4",
            "view: mat4 @ 0 + 64",
            "eye: vec3 @ 64 + 12",
            "near: float @ 76 + 4",
            "material.base: vec4 @ 0 + 16",
            "material.rough: float[2] @ 16 + 32",
        ]
    );
    let picture = &compiled.reflection.shader.textures[0];
    assert_eq!((picture.texture_binding, picture.sampler_binding), (2, 3));
}

#[test]
fn each_sampler_becomes_a_texture_and_a_sampler() {
    let (compiled, text) = fragment(
        "precision highp sampler3D;
        precision highp isampler2D;
        precision highp usampler3D;
        precision highp sampler2DArray;
        precision highp sampler2DShadow;
        precision highp samplerCubeShadow;
        precision highp sampler2DArrayShadow;
        uniform sampler2D a;
        uniform sampler2D unread;
        uniform sampler3D volume;
        uniform samplerCube sky;
        uniform isampler2D ids;
        uniform usampler3D cells;
        uniform sampler2DArray layers;
        uniform sampler2DShadow shadow;
        uniform samplerCubeShadow around;
        uniform sampler2DArrayShadow cascades;
        in vec2 uv;
        out vec4 color;
        vec4 twice(sampler2D s, vec2 at) { return texture(s, at) + textureLod(s, at, 1.0); }
        void main() {
            color = twice(a, uv) + texture(volume, vec3(uv, 0.0)) + textureGrad(sky, vec3(uv, 1.0), vec3(0.1), vec3(0.1));
            color += vec4(texelFetch(ids, ivec2(uv), 0)) + vec4(texelFetch(cells, ivec3(1), 0));
            color += texture(layers, vec3(uv, 2.4)) + texelFetchOffset(layers, ivec3(1, 2, 3), 0, ivec2(1));
            color += vec4(textureSize(layers, 0), textureSize(a, 0).x);
            color.a *= texture(shadow, vec3(uv, 0.5)) + textureProj(shadow, vec4(uv, 0.5, 1.0));
            color.a *= texture(around, vec4(uv, 1.0, 0.5)) + texture(cascades, vec4(uv, 1.0, 0.5));
        }",
    );
    let textures = &compiled.reflection.shader.textures;
    let shown: Vec<_> = textures.iter().map(|t| (t.name.as_str(), t.ty.as_str(), t.texture_binding)).collect();
    assert_eq!(
        shown,
        [
            ("a", "sampler2D", 1),
            ("volume", "sampler3D", 5),
            ("sky", "samplerCube", 7),
            ("ids", "isampler2D", 9),
            ("cells", "usampler3D", 11),
            ("layers", "sampler2DArray", 13),
            ("shadow", "sampler2DShadow", 15),
            ("around", "samplerCubeShadow", 17),
            ("cascades", "sampler2DArrayShadow", 19),
        ]
    );
    assert!(textures[0].used.mips && textures[0].used.sampler && !textures[3].used.sampler);
    assert!(text.contains("@binding(2) \nvar a_sampler: sampler"), "{text}");
    assert!(text.contains("texture_depth_2d_array") && text.contains("texture_3d<u32>"), "{text}");
}

#[test]
fn inputs_and_outputs_have_locations() {
    let vertex = "#version 300 es
        layout(location = 3) in vec3 position;
        in vec2 uv;
        in mat3 frame;
        in uint kind;
        in ivec4 unread;
        uniform mat4 camera;
        out vec2 v_uv;
        flat out uint v_kind;
        out vec3 v_normal;
        void main() {
            v_uv = uv;
            v_kind = kind + uint(gl_VertexID) + uint(gl_InstanceID);
            v_normal = frame[2];
            gl_Position = camera * vec4(position, 1.0);
        }";
    let (first, text) = compile_checked(&PassSource::vertex(vertex));
    let shown = |all: &[crate::ShaderVariable]| {
        all.iter().map(|v| format!("{} {} {}{}", v.location, v.ty, v.name, if v.flat { " flat" } else { "" })).collect()
    };
    let shown: &dyn Fn(&[crate::ShaderVariable]) -> Vec<String> = &shown;
    let shader = &first.reflection.shader;
    assert_eq!(shown(&shader.inputs), ["0 vec2 uv", "1 uint kind", "3 vec3 position", "4 mat3 frame"]);
    assert_eq!(shown(&shader.outputs), ["0 vec2 v_uv", "1 uint v_kind flat", "2 vec3 v_normal"]);
    assert_eq!(shader.buffers[0].group, 1);
    assert!(text.contains("@vertex") && text.contains("@builtin(instance_index)"), "{text}");

    // Inputs in a different order are matched by name.
    let text = "in vec3 v_normal;
        flat in uint v_kind;
        layout(location = 1) out uvec2 ids;
        layout(location = 0) out vec3 color;
        void main() {
            color = gl_FrontFacing ? v_normal : -v_normal;
            ids = uvec2(v_kind, 0u);
            gl_FragDepth = gl_FragCoord.z * 0.5;
        }";
    let link = Link { varyings: Some(&first.reflection.varyings), targets: None };
    let (second, text) = linked(&PassSource::fragment(text), &link);
    let shader = &second.reflection.shader;
    assert_eq!(shown(&shader.inputs), ["1 uint v_kind flat", "2 vec3 v_normal"]);
    assert_eq!(shown(&shader.outputs), ["0 vec3 color", "1 uvec2 ids"]);
    assert!(text.contains("@location(1) @interpolate(flat"), "{text}");
    assert!(text.contains("@location(1) member") && text.contains("vec4<u32>"), "{text}");

    let wrong = "in vec3 v_norm; out vec4 color; void main() { color = vec4(v_norm, 1.0); }";
    let all = compile_linked(&PassSource::fragment(wrong), &link, None).unwrap_err();
    assert_eq!(all[0].message, "the vertex stage has no output `v_norm`");
}

#[test]
fn clip_space_follows_the_option() {
    let text = "in vec4 at; void main() { gl_Position = at; }";
    let with = |clip_space| {
        let mut source = PassSource::vertex(text);
        source.plain.clip_space = clip_space;
        compile_checked(&source).1
    };
    let (unchanged, depth, both) =
        (with(ClipSpace::UNCHANGED), with(ClipSpace::default()), with(ClipSpace::GL_TEXTURE));
    assert!(!unchanged.contains("0.5") && !unchanged.contains("-1"), "{unchanged}");
    assert!(depth.contains("0.5") && !depth.contains("-1"), "{depth}");
    assert!(both.contains("0.5") && both.contains("-1"), "{both}");
}

#[test]
fn given_value_is_a_constant() {
    let values = [crate::UniformValue { name: "level".into(), value: crate::UntypedValue::Number(0.25) }];
    let source = PassSource {
        values: &values,
        ..PassSource::fragment(
            "uniform float time; uniform float level; out vec4 c; void main() { c = vec4(level * time); }",
        )
    };
    let (compiled, text) = compile_checked(&source);
    assert_eq!(uniforms(&compiled.reflection), ["time: float @ 0 + 4"]);
    assert!(text.contains("0.25"), "{text}");
}

#[test]
fn tables_and_work_arounds_need_no_buffer() {
    let table: Vec<String> = (0..300).map(|i| format!("{i}.5")).collect();
    let text = format!(
        "const float table[300] = float[300]({});
        uniform int n;
        out vec4 color;
        void main() {{
            float sum = 0.0;
            for (int i = n; i > 0; i /= 2) sum += table[i] / float(i % n);
            color = vec4(sum);
        }}",
        table.join(", ")
    );
    for opaque_uniforms in [false, true] {
        let mut source = PassSource::fragment(&text);
        source.driver = crate::Driver {
            opaque_uniforms,
            array_loops: opaque_uniforms,
            loop_closing_exits: true,
            ..Default::default()
        };
        let (compiled, text) = compile_checked(&source);
        assert!(compiled.tables.is_empty() && compiled.uniform_tables.is_empty());
        assert_eq!(text.matches("@binding").count(), 1, "{text}");
    }
}

#[test]
fn arrays_of_arrays_have_std140_strides() {
    let text = "
        struct S { float x; vec2 y[2]; };
        uniform float w[2][3];
        uniform vec4[2] v[3];
        uniform S s[2][2];
        uniform bool flags[1][2][2];
        uniform int n;
        out vec4 color;
        float sum(float[3] row) { return row[0] + row[1] + row[2]; }
        void main() {
            vec4[2] copies[3] = v;
            float[3] rows[2] = w;
            S all[2][2] = s;
            color = vec4(sum(w[n]) + rows[n][1], w[1][n], all[n][1].y[n].x + s[1][n].x, flags[0][n][1] == flags[0][1][0]);
            color += copies[n][1] + v[2][n];
        }";
    for opaque_uniforms in [false, true] {
        let dialect = crate::Dialect::Any(crate::Version { number: 310, is_es: true });
        let mut source = PassSource { dialect, ..PassSource::fragment(text) };
        source.driver.opaque_uniforms = opaque_uniforms;
        let (compiled, _) = compile_checked(&source);
        let members = uniforms(&compiled.reflection);
        for member in [
            "w[0]: float[3] @ 0 + 48",
            "w[1]: float[3] @ 48 + 48",
            "v[2]: vec4[2] @ 160 + 32",
            "s[0][1].x: float @ 240 + 4",
            "s[1][1].y: vec2[2] @ 352 + 32",
            "flags[0][1]: bool[2] @ 416 + 32",
            "n: int @ 448 + 4",
        ] {
            assert!(members.iter().any(|found| found == member), "{member}: {members:#?}");
        }
    }
}

#[test]
fn every_uniform_may_be_hidden_from_the_driver() {
    let mut source = PassSource::fragment(
        "struct S { bool on; mat2 turn; float w[2]; };
        uniform S s; uniform bool flag; uniform bvec2 flags; uniform S all[2]; uniform int n;
        out vec4 color;
        void main() { S copy = s; color = vec4(copy.w[1], all[n].turn[1], all[1].on && flag && flags.y ? 1.0 : copy.turn[0].x); }",
    );
    source.driver.opaque_uniforms = true;
    compile_checked(&source);
}

#[test]
fn unsupported_features_are_rejected() {
    assert_refused(
        "uniform sampler2D all[2]; out vec4 c; void main() { c = texture(all[1], vec2(0)); }",
        "an array of samplers",
        "sampler2D",
    );
    assert_refused(
        "precision highp isampler2D; uniform isampler2D s; out vec4 c; void main() { c = vec4(texture(s, vec2(0))); }",
        "WebGPU does not sample integers",
        "texture(s, vec2(0))",
    );
    assert_refused(
        "layout(std140, row_major) uniform B { mat4 m; }; out vec4 c; void main() { c = m[0]; }",
        "row_major",
        "row_major",
    );
    assert_refused(
        "uniform B { vec4 v; } b[2]; out vec4 c; void main() { c = b[1].v; }",
        "an array of uniform blocks",
        "[2]",
    );
    assert_refused("out vec4 c; void main() { c = vec4(gl_PointCoord, 0, 1); }", "gl_PointCoord", "gl_PointCoord");
    assert_refused("out vec4 c[2]; void main() { c[0] = vec4(1); }", "the output `c` cannot be a `vec4[2]`", "c");
    assert_refused("out vec4 c; void main() { c = vec4(time); }", "`time` is not declared", "time");
    assert_refused("void main() { gl_FragColor = vec4(1); }", "`gl_FragColor` is not declared", "gl_FragColor");
    assert_refused("in vec4 at; out vec4 c; void mainImage(out vec4 o, vec2 p) { o = at; }", "main", "");
}

#[test]
fn old_glsl_has_a_fix() {
    let hints = |kind, text: &str| {
        let source = if kind == PassKind::PlainVertex { PassSource::vertex(text) } else { PassSource::fragment(text) };
        let all = compile(&source).expect_err(text);
        all.iter()
            .flat_map(|d| std::iter::once(d.message.clone()).chain(d.hints.clone()))
            .collect::<Vec<_>>()
            .join("\n")
    };
    let vertex = hints(
        PassKind::PlainVertex,
        "attribute vec3 at; varying vec2 uv; void main() { gl_Position = vec4(at, 1.0); }",
    );
    assert!(vertex.contains("`in`") && vertex.contains("`out`"), "{vertex}");
    let old = hints(
        PassKind::PlainFragment,
        "varying vec2 uv; uniform sampler2D s; void main() { gl_FragColor = texture2D(s, uv); }",
    );
    assert!(old.contains("out vec4 color;") && old.contains("texture("), "{old}");
    let version = hints(PassKind::PlainFragment, "#version 100\nvoid main() {}");
    assert!(version.contains("this is GLSL ES 1.00") && version.contains("#version 300 es"), "{version}");
    let desktop = hints(PassKind::PlainFragment, "#version 330 core\nvoid main() {}");
    assert!(desktop.contains("`#version 330 core` is not supported"), "{desktop}");
    let late = hints(PassKind::PlainFragment, "precision highp float;\n#version 300 es\nvoid main() {}");
    assert!(late.contains("before everything but comments"), "{late}");
    let extension = hints(PassKind::PlainFragment, "#extension GL_X : require\nvoid main() {}");
    assert!(extension.contains("there is no extension `GL_X`"), "{extension}");
    fragment(
        "// ours\n#version 300 es\n#extension GL_X : enable\n#ifdef GL_ES\nprecision mediump float;\n#endif\nout vec4 c; void main() { c = vec4(1); }",
    );
}
