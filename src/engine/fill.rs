//! Texels that a pass's own program does not draw: what it holds before frame 0, and its outermost texels. Each is a hidden
//! program of one expression, or of one picture.

use super::{
    Engine, FrameInputs, Program, Sources,
    bind::{DrawBindings, uniform_group},
    program::CompiledDraw,
    stages::CompiledPass,
    targets::Target,
    uniforms,
};
use crate::{
    diag::{Diagnostic, SourceId, Span},
    glsl::{self, Driver, Include, PassSource, Text, interface},
    graph::{Draw, Read, Source},
    project::{FillText, FillValue, Filter, Sampler, Wrap},
};

/// Nothing in a project has this id: what is wrong in the text around an expression is said of the expression.
const AROUND: SourceId = SourceId(u16::MAX);

const HEAD: &str = "void mainImage(out vec4 eddy_value, in vec2 fragCoord) { eddy_value = (\n";
const FOOT: &str = "\n); }\n";

/// A picture of the pass's own size is taken texel for texel.
const PICTURE: &str = "void mainImage(out vec4 value, in vec2 fragCoord) {
    bool same = textureSize(iChannel0, 0) == ivec2(iResolution.xy);
    value = same ? texelFetch(iChannel0, ivec2(fragCoord), 0) : texture(iChannel0, fragCoord / iResolution.xy);
}
";

/// How a fill's picture is read.
const SAMPLER: Sampler = Sampler { filter: Filter::Linear, wrap: Wrap::Clamp, vflip: true };

/// A fill's program, and what it is drawn as.
pub(super) struct FillProgram {
    pub compiled: CompiledDraw,
    pub draw: Draw,
}

/// A fill's program, bound.
pub(super) struct FillBindings(DrawBindings);

/// Compiles a fill; see [`Sources::compile_fill`].
pub(super) fn compile(
    sources: &Sources<'_>,
    value: &FillValue,
    written: &FillText,
    by_hand: bool,
    driver: Driver,
) -> Result<CompiledPass, Vec<Diagnostic>> {
    let compile = |source: &PassSource<'_>| {
        let bilinear_by_hand = [by_hand, false, false, false];
        glsl::compile(&PassSource { bilinear_by_hand, driver, ..*source }).map(CompiledPass::screen)
    };
    let FillValue::Expression(_) = value else {
        return sources.with_fill(Text { id: AROUND, text: PICTURE }, None, compile);
    };
    let FillText { id, text, range } = written;
    // Offsets stay those of the manifest, of which nothing else is GLSL.
    let blank: String = text[..range.start].bytes().map(|b| if b == b'\n' { '\n' } else { ' ' }).collect();
    let value = format!("{blank}{}", &text[range.clone()]);
    let around = format!("{HEAD} {FOOT}");
    let include = Include { line: Span::new(AROUND, HEAD.len()..HEAD.len() + 1), text: Text { id: *id, text: &value } };
    let compiled = sources.with_fill(Text { id: AROUND, text: &around }, Some(include), compile);
    let place = Span::new(*id, range.clone());
    let here = |span: &mut Span| {
        if span.source == AROUND {
            *span = place;
        }
    };
    let told = |mut all: Vec<Diagnostic>| {
        // What a mistake in the expression makes of the text around it is no second mistake.
        let own = all.iter().any(|d| d.is_error() && d.span.is_some_and(|s| s.source != AROUND));
        all.retain(|d| !own || d.span.is_none_or(|s| s.source != AROUND));
        for diagnostic in &mut all {
            diagnostic.span.iter_mut().chain(diagnostic.labels.iter_mut().map(|l| &mut l.span)).for_each(here);
        }
        all
    };
    match compiled {
        Ok(pass) => Ok(CompiledPass { diagnostics: told(pass.diagnostics), ..pass }),
        Err(errors) => Err(told(errors)),
    }
}

/// What a fill of a pass is drawn as.
pub(super) fn draw_of(pass: &Draw, is_picture: bool) -> Draw {
    let read = is_picture.then_some(Read { source: Source::Media, sampler: SAMPLER, mips: false });
    Draw { reads: [read, None, None, None], keeps_content: true, can_rest: false, ..pass.clone() }
}

impl FillBindings {
    pub fn new(engine: &Engine, fill: &FillProgram, index: usize) -> Self {
        let uniforms = uniform_group(&engine.gpu, &fill.compiled, 0, index, &engine.uniforms);
        Self(DrawBindings::of(vec![uniforms]))
    }

    /// Draws the fill within the scissor that is set. A fill reads no target.
    pub fn draw(&mut self, engine: &FillParts<'_>, fill: &FillProgram, pass: &mut wgpu::RenderPass<'_>) {
        let (uniforms, channels) = self.0.groups(engine.gpu, engine.stock, &fill.compiled, &fill.draw, &[]);
        pass.set_pipeline(&fill.compiled.programs[0].pipeline.raw);
        pass.set_bind_group(interface::UNIFORM_GROUP, &uniforms[0], &[]);
        pass.set_bind_group(interface::CHANNEL_GROUP, channels, &[]);
        pass.draw(0..3, 0..1);
    }
}

/// What of an engine a fill is drawn with.
pub(super) struct FillParts<'a> {
    pub gpu: &'a crate::gpu::Gpu,
    pub stock: &'a super::bind::Stock,
}

impl Engine {
    /// Every target as it is before frame 0.
    pub(super) fn fill_initial(&mut self, program: &Program) {
        let is_some = |d: &CompiledDraw| d.initial.is_some();
        if !program.draws.iter().any(is_some) {
            return;
        }
        let inputs = FrameInputs::at_fixed_step(0, 60.0);
        for (index, (compiled, draw)) in program.draws.iter().zip(&program.plan.draws).enumerate() {
            let own = self.targets[draw.targets.start].size();
            self.uniforms.set(index, &uniforms::block(&inputs, own, self.size, &compiled.channels));
        }
        self.uniforms.write(&self.gpu);
        let mut encoder =
            self.gpu.device.create_command_encoder(&wgpu::CommandEncoderDescriptor { label: Some("initial") });
        for (index, (compiled, draw)) in program.draws.iter().zip(&program.plan.draws).enumerate() {
            let Some(fill) = &compiled.initial else { continue };
            let Some(bound) = self.fills.get_mut(index).and_then(|f| f.initial.as_mut()) else { continue };
            let parts = FillParts { gpu: &self.gpu, stock: &self.stock };
            let target: &Target = &self.targets[draw.targets.start];
            for texture in &target.textures {
                let descriptor = wgpu::RenderPassDescriptor {
                    label: Some("initial"),
                    color_attachments: &[Some(wgpu::RenderPassColorAttachment {
                        view: &texture.level_0,
                        depth_slice: None,
                        resolve_target: None,
                        ops: wgpu::Operations {
                            load: self.gpu.load_what_is_overwritten(),
                            store: wgpu::StoreOp::Store,
                        },
                    })],
                    ..Default::default()
                };
                self.gpu.pass(&mut encoder, descriptor, |pass| bound.draw(&parts, fill, pass));
            }
            for chain in &target.chains {
                self.mips.build(&self.gpu, &mut encoder, chain);
            }
        }
        self.gpu.queue.submit([encoder.finish()]);
    }
}

/// The fills of one draw, bound.
#[derive(Default)]
pub(super) struct DrawFills {
    pub initial: Option<FillBindings>,
    pub boundary: Option<FillBindings>,
}
