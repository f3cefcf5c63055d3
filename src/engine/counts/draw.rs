//! Draws counters, and sums them.

use super::{
    CountingProgram, PassCounts, Prices, TextureFilter,
    tally::{Band, Tally, tiles},
};
use crate::{
    Engine, EngineError,
    bind::{channel_group_of, uniform_group},
    inspect::texture_of,
    program::CompiledDraw,
    running::Running,
};
use eddy_glsl::{
    MAX_CHANNELS,
    interface::{CHANNEL_GROUP, UNIFORM_GROUP},
};
use eddy_gpu::{CounterTargets, Texture};
use eddy_project::{Filter, Region};
use std::sync::Arc;

/// The most bytes of counters in memory at once.
const BAND_BYTES: u64 = 32 << 20;

/// Rows of a band are a multiple of this: the height of the largest group, and of two tiles.
const BAND_ALIGN: u32 = 8;

impl Engine {
    /// Counts what the pixels of a pass executed in its newest draw, without changing anything that a later frame
    /// reads. Draws and waits in bands of rows; between them, `stop` returns whether to stop, with
    /// [`EngineError::Stopped`].
    ///
    /// Fails if an input of the pass has been drawn over since ([`EngineError::Overwritten`]).
    pub fn count(
        &self,
        program: &CountingProgram,
        prices: &Prices,
        stop: &mut dyn FnMut() -> bool,
    ) -> Result<PassCounts, EngineError> {
        let none = || EngineError::NoSuchPass(program.pass.title());
        let running = self.running().ok_or_else(none)?;
        running.check_is_on(&program.pass)?;
        let index = running.program.draws.iter().position(|draw| draw.id == program.pass).ok_or_else(none)?;
        let draw = &running.program.plan.draws[index];
        let target = &running.targets[draw.targets.start];
        let size = target.size();
        let layers = running.program.plan.layers(index);
        let filters = filters(running, index);
        let table = &*program.table;
        let weights = table.blocks.iter().map(|block| prices.of_block(block, &filters)).collect();
        let mut tally = Tally::new(table, prices, weights);
        let drawn = draw.region.map_or(Some(whole(size)), |region| region.within(size));
        let drawer = Drawer::new(self, running, index, program, size)?;
        let bytes_per_row = u64::from(size.0) * 4 * table.counters.max(1) as u64;
        let rows = (BAND_BYTES / bytes_per_row).max(1) as u32;
        let rows = (rows / BAND_ALIGN).max(1) * BAND_ALIGN;
        for layer in 0..layers {
            for first in (0..size.1).step_by(rows as usize) {
                if stop() {
                    return Err(EngineError::Stopped);
                }
                let rows = rows.min(size.1 - first);
                let counters = drawer.band(layer, first, rows)?;
                let drawn = drawn.unwrap_or(Region { x: 0, y: 0, width: 0, height: 0 });
                let up = |y: u32| y.clamp(first, first + rows) - first;
                let drawn = [drawn.x..drawn.x + drawn.width, up(drawn.y)..up(drawn.y + drawn.height)];
                let drawn = drawn.map(|range| range.start as usize..range.end as usize);
                tally.add(&Band { counters, width: size.0 as usize, rows: rows as usize, drawn });
            }
        }
        self.gpu().take_error("counting")?;
        let Tally { runs, lanes, loops, discarded, costs, pixels, .. } = tally;
        let divergence =
            tiles(size, layers, &costs).map(|tile| if tile.mean > 0.0 { tile.most / tile.mean } else { 1.0 });
        Ok(PassCounts {
            pass: program.pass.clone(),
            size,
            layers,
            steps: running.program.plan.steps_of(index),
            table: Arc::clone(&program.table),
            pixels,
            runs,
            lanes,
            loops,
            discarded,
            divergence: divergence.map(|most| most as f32).collect(),
            costs,
            filters,
            prices: prices.clone(),
        })
    }
}

fn whole((width, height): (u32, u32)) -> Region {
    Region { x: 0, y: 0, width, height }
}

/// Returns how the channels of a draw are filtered.
fn filters(running: &Running, index: usize) -> Vec<TextureFilter> {
    let compiled = &running.program.draws[index];
    let filter = |channel: usize| {
        let read = running.program.plan.draws[index].reads[channel].as_ref();
        let texture = texture_of(running, (compiled, index), channel, true).ok().flatten();
        TextureFilter {
            kind: read.map_or(Filter::Nearest, |read| read.sampler.filter),
            is_float: texture.is_some_and(|texture| texture.shape.format.is_float()),
        }
    };
    (0..MAX_CHANNELS).map(filter).collect()
}

/// The targets and bindings of the draws.
struct Drawer<'a> {
    engine: &'a Engine,
    running: &'a Running,
    index: usize,
    program: &'a CountingProgram,
    targets: Option<CounterTargets>,
    /// For each draw the channels.
    channels: Vec<wgpu::BindGroup>,
    size: (u32, u32),
}

impl<'a> Drawer<'a> {
    fn new(
        engine: &'a Engine,
        running: &'a Running,
        index: usize,
        program: &'a CountingProgram,
        size: (u32, u32),
    ) -> Result<Self, EngineError> {
        let most = program.draws.iter().map(|draw| draw.counters.len().div_ceil(4)).max();
        let targets = most.map(|count| CounterTargets::new(engine.gpu(), count, size)).transpose()?;
        let (compiled, draw): (&CompiledDraw, _) = (&running.program.draws[index], &running.program.plan.draws[index]);
        let textures = (0..MAX_CHANNELS)
            .map(|channel| texture_of(running, (compiled, index), channel, true))
            .collect::<Result<Vec<Option<&Texture>>, _>>()?;
        let group = |draws: &super::program::CountingDraw| {
            let layout = &draws.pipeline.pipeline.layouts[CHANNEL_GROUP as usize];
            channel_group_of(&engine.shared, compiled, draw, layout, |channel| textures[channel])
        };
        let channels = program.draws.iter().map(group).collect();
        Ok(Self { engine, running, index, program, targets, channels, size })
    }

    /// Draws and reads the counters of full rows of a layer.
    fn band(&self, layer: u32, first: u32, rows: u32) -> Result<Vec<Vec<u32>>, EngineError> {
        let gpu = self.engine.gpu();
        let Some(targets) = &self.targets else { return Ok(Vec::new()) };
        let compiled = &self.running.program.draws[self.index];
        let mut all = Vec::with_capacity(self.program.table.counters);
        for (draw, channels) in self.program.draws.iter().zip(&self.channels) {
            let count = draw.counters.len().div_ceil(4);
            let place = (self.index, layer);
            let uniforms = uniform_group(gpu, compiled, (0, &draw.pipeline), place, &self.running.uniforms);
            let mut encoder =
                gpu.device.create_command_encoder(&wgpu::CommandEncoderDescriptor { label: Some("counting") });
            let descriptor = wgpu::RenderPassDescriptor {
                label: Some("counting"),
                color_attachments: &targets.attachments(count),
                ..Default::default()
            };
            gpu.pass(&mut encoder, descriptor, |pass| {
                pass.set_scissor_rect(0, first, self.size.0, rows);
                pass.set_pipeline(&draw.pipeline.pipeline.raw);
                pass.set_bind_group(UNIFORM_GROUP, &uniforms, &[]);
                pass.set_bind_group(CHANNEL_GROUP, channels, &[]);
                pass.draw(0..3, 0..1);
            });
            gpu.queue.submit([encoder.finish()]);
            let read = targets.read(gpu, count, first, rows)?;
            for n in 0..draw.counters.len() {
                all.push(read[n / 4].iter().map(|texel| texel[n % 4]).collect());
            }
        }
        Ok(all)
    }
}
