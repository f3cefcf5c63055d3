//! The counting variants of a pass on a device.

use crate::{
    BuildError, Engine, EngineError, Sources,
    build::driver,
    channels::channel_bindings,
    compile::PassOptions,
    compiled::CompiledProgram,
    draft::uniform_bindings,
    pipelines::{PipelineOrder, StagePipeline},
    program::FilterMode,
};
use eddy_glsl::count::CountTable;
use eddy_gpu::CounterTargets;
use eddy_project::{PassName, Project};
use std::{ops::Range, sync::Arc};

/// The most bytes of the targets that counters are drawn into.
const MOST_BYTES: u64 = 256 << 20;

/// The counting variants of a pass of the running program. It is for that program only, on a canvas of any size.
pub struct CountingProgram {
    pub(super) pass: PassName,
    pub(super) table: Arc<CountTable>,
    pub(super) draws: Vec<CountingDraw>,
}

/// One draw, and the counters that it outputs.
pub(super) struct CountingDraw {
    pub pipeline: StagePipeline,
    pub counters: Range<usize>,
}

impl CountingProgram {
    /// Returns the blocks, lines and loops of the pass.
    pub fn table(&self) -> &CountTable {
        &self.table
    }

    /// Returns the number of draws that counting takes.
    pub fn draws(&self) -> usize {
        self.draws.len()
    }
}

impl Engine {
    /// Compiles the counting variants of a pass of the running program, which was built of `project`. Takes as long as compiling the pass several times: a variant has at most four counters for each target that the device
    /// has. Fails for a pass that draws meshes.
    pub fn counting(&self, project: &Project, pass: &PassName) -> Result<CountingProgram, BuildError> {
        let none = || EngineError::NoSuchPass(pass.title());
        let running = self.running().ok_or_else(none)?;
        let at = running.program.draws.iter().position(|draw| draw.id == *pass).ok_or_else(none)?;
        let index = project.passes.iter().position(|own| own.id == *pass).ok_or_else(none)?;
        let own = &project.passes[index];
        if !own.body.is_screen() {
            return Err(EngineError::Uncounted { pass: pass.title(), why: "it draws meshes" }.into());
        }
        if running.program.plan.tiled.is_some_and(|tiled| tiled.draw == at) {
            return Err(EngineError::Uncounted { pass: pass.title(), why: "it is drawn in tiles" }.into());
        }
        let gpu = self.gpu();
        let options = PassOptions {
            bilinear_in_shader: running.program.draws[at]
                .channels
                .each_ref()
                .map(|channel| channel.filter_mode == FilterMode::Shader),
            driver: driver(gpu, own),
            ..PassOptions::default()
        };
        let (width, height) = self.pass_size(pass).ok_or_else(none)?;
        let texels = 16 * u64::from(width) * u64::from(height);
        let targets = CounterTargets::most(gpu).min((MOST_BYTES / texels.max(1)).max(1) as usize);
        let sources = Sources::new(project);
        let counting = sources.counting(index, options, 4 * targets);
        let counting =
            counting.map_err(|diagnostics| BuildError::Diagnostics { diagnostics, sources: project.sources() })?;
        let ranges: Vec<Range<usize>> = (0..counting.variants.len()).map(|n| counting.counters_of(n)).collect();
        let channels = channel_bindings(&running.program.draws[at].channels);
        let orders = counting.variants.into_iter().map(|variant| {
            let reflection = variant.reflection.clone();
            let program = CompiledProgram { vertex: None, fragment: Arc::new(variant) };
            PipelineOrder {
                label: pass.title(),
                groups: [uniform_bindings(&program, &reflection), channels.clone()],
                formats: Vec::new(),
                mesh: None,
                program,
            }
        });
        let orders: Vec<_> = orders.zip(&ranges).map(|(order, range)| (order, range.len().div_ceil(4))).collect();
        let pipelines = PipelineOrder::make_counting(gpu, &orders).map_err(EngineError::from)?;
        let draws = pipelines.into_iter().zip(ranges);
        let draws = draws.map(|(pipeline, counters)| CountingDraw { pipeline, counters }).collect();
        Ok(CountingProgram { pass: pass.clone(), table: Arc::new(counting.table), draws })
    }
}
