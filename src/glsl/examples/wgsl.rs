//! Prints a shader as WGSL: `cargo run -p eddy-glsl --example wgsl -- FILE`.
//!
//! A text with a `mainImage` is Shadertoy's, a file `.vert` a vertex shader, any other a fragment shader.

use eddy_glsl::{PassSource, SourceMap, compile, naga, render_all};

fn main() {
    let path = std::env::args().nth(1).expect("usage: wgsl FILE");
    let text = std::fs::read_to_string(&path).unwrap_or_else(|error| panic!("{path}: {error}"));
    let source = if text.contains("mainImage") {
        PassSource::image(&text)
    } else if path.ends_with(".vert") {
        PassSource::vertex(&text)
    } else {
        PassSource::fragment(&text)
    };
    let mut sources = SourceMap::default();
    sources.add(&path, text.as_str());
    let compiled = compile(&source).unwrap_or_else(|found| {
        eprint!("{}", render_all(&found, &sources));
        std::process::exit(1);
    });
    eprint!("{}", render_all(&compiled.diagnostics, &sources));
    let capabilities = naga::valid::Capabilities::all();
    let info = naga::valid::Validator::new(Default::default(), capabilities).validate(&compiled.module);
    let info = info.expect("the compiler makes valid modules");
    let flags = naga::back::wgsl::WriterFlags::empty();
    print!("{}", naga::back::wgsl::write_string(&compiled.module, &info, flags).expect("WGSL has all of it"));
}
